// SPDX-License-Identifier: MIT
// Curves as SVG.

function svg(name, attributes, parent) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (parent) parent.appendChild(element);
  return element;
}

// About `count` round numbers that span [lo, hi].
function ticks(lo, hi, count) {
  const rough = (hi - lo) / count || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= rough);
  const list = [];
  for (let i = Math.ceil(lo / step - 1e-9); i * step <= hi + 1e-9 * step; ++i) list.push(i * step);
  return list;
}

function short(value) {
  if (Math.abs(value) >= 10000) return `${+(value / 1000).toPrecision(3)}k`;
  return String(+value.toPrecision(4));
}

// A plot with axes; `xLabel` stands at the end of its axis, `unit` behind each y. Clicking calls `onPick` with the value of x.
class Plot {
  constructor(element, onPick) {
    this.element = element;
    element.addEventListener("pointerdown", (event) => {
      if (!this.span) return;
      const box = element.getBoundingClientRect();
      const share = (event.clientX - box.left - this.left) / (this.width - this.left - this.right);
      onPick(this.span[0] + share * (this.span[1] - this.span[0]));
    });
  }

  begin(xSpan, ySpan, xLabel, unit) {
    const box = this.element.getBoundingClientRect();
    Object.assign(this, { width: box.width, height: box.height, left: 52, right: 10, top: 8, bottom: 20 });
    this.span = xSpan[1] > xSpan[0] ? xSpan : [xSpan[0], xSpan[0] + 1];
    this.ySpan = ySpan[1] > ySpan[0] ? ySpan : [ySpan[0], ySpan[0] + 1];
    this.element.textContent = "";
    this.element.setAttribute("viewBox", `0 0 ${this.width} ${this.height}`);
    for (const y of ticks(...this.ySpan, 4)) {
      svg("line", { class: "grid", x1: this.left, x2: this.width - this.right, y1: this.y(y), y2: this.y(y) },
        this.element);
      svg("text", { x: this.left - 6, y: this.y(y) + 4, "text-anchor": "end" }, this.element).textContent =
        short(y) + unit;
    }
    for (const x of ticks(...this.span, 5)) {
      if (this.x(x) > this.width - this.right - 8 * xLabel.length) continue;
      svg("text", { x: this.x(x), y: this.height - 6, "text-anchor": "middle" }, this.element).textContent = short(x);
    }
    svg("text", { x: this.width - this.right, y: this.height - 6, "text-anchor": "end" }, this.element)
      .textContent = xLabel;
  }

  x(value) {
    return this.left + (value - this.span[0]) / (this.span[1] - this.span[0]) * (this.width - this.left - this.right);
  }

  y(value) {
    const height = this.height - this.top - this.bottom;
    return this.top + (1 - (value - this.ySpan[0]) / (this.ySpan[1] - this.ySpan[0])) * height;
  }

  curve(xs, ys, colour) {
    let pen = "M";
    let way = "";
    xs.forEach((x, i) => {
      if (ys[i] === null || ys[i] === undefined) { pen = "M"; return; }
      way += `${pen}${this.x(x).toFixed(1)} ${this.y(ys[i]).toFixed(1)}`;
      pen = "L";
    });
    svg("path", { class: "curve", d: way, stroke: colour }, this.element);
  }

  // Columns one upon the other: `stacks[k][i]` is part k of column i.
  columns(xs, stacks, colours) {
    const wide = Math.max(1, (this.width - this.left - this.right) / Math.max(xs.length, 1) - 0.6);
    xs.forEach((x, i) => {
      let sum = 0;
      stacks.forEach((stack, k) => {
        if (!(stack[i] > 0)) return;
        const [below, above] = [this.y(sum), this.y(sum + stack[i])];
        sum += stack[i];
        svg("rect", {
          x: Math.max(this.left, this.x(x) - wide / 2), y: above, width: wide, height: Math.max(0, below - above),
          fill: colours[k],
        }, this.element);
      });
    });
  }

  // The moment that is shown: a line, and a dot on each curve.
  mark(x, dots) {
    if (this.marks) this.marks.remove();
    this.marks = svg("g", {}, this.element);
    if (x !== null) {
      svg("line", { class: "now", x1: this.x(x), x2: this.x(x), y1: this.top, y2: this.height - this.bottom },
        this.marks);
    }
    for (const dot of dots) {
      if (dot.y === null || dot.y === undefined) continue;
      svg("circle", { cx: this.x(dot.x), cy: this.y(dot.y), r: 4, fill: dot.colour, stroke: "#11151c" }, this.marks);
    }
  }
}
