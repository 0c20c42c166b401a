// SPDX-License-Identifier: MIT
// Tables and curves of planners beside one another: exploration_json is what they show.

const results = JSON.parse(document.querySelector("script.results").textContent);
const planners = [...new Set(results.rows.map((row) => row.planner))];
const hidden = new Set();
const isTimed = results.rows.some((row) => row.duration_s);
const shown = { abscissa: isTimed ? "seconds" : "metres" };  // seconds only where runs are timed
const drawn = [];  // by world: what draws its plot again

function made(name, attributes, ...children) {
  const element = Object.assign(document.createElement(name), attributes);
  element.append(...children);
  return element;
}

// More planners than colours: the second round is dashed.
function styleOf(planner) {
  const place = planners.indexOf(planner);
  const round = Math.floor(place / kRunColours.length);
  return { colour: kRunColours[place % kRunColours.length], dash: ["none", "7 3", "2 3"][round % 3] };
}

// --- curves ----------------------------------------------------------------------------------------------------
function abscissaIn(world) {
  const timed = results.runs.some((run) => run.world === world && run.curve.some((point) => point[1] !== null));
  return shown.abscissa === "seconds" && timed ? { place: 1, label: "time [s]" } : { place: 0, label: "path [m]" };
}

// The share that a run knew at `x`; after its end what it knew last.
function knownAt(curve, place, x) {
  let low = 0;
  let high = curve.length;  // points before `low` are at or below x, points from `high` on above it
  while (low < high) {
    const middle = (low + high) >> 1;
    if (curve[middle][place] <= x) low = middle + 1; else high = middle;
  }
  return low === 0 ? 0 : curve[low - 1][2];
}

function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  return 0.5 * (sorted[Math.floor((sorted.length - 1) / 2)] + sorted[Math.ceil((sorted.length - 1) / 2)]);
}

function drawWorld(plot, world) {
  const { place, label } = abscissaIn(world);
  const runs = results.runs.filter((run) => run.world === world && !hidden.has(run.planner) && run.curve.length > 0);
  const furthest = Math.max(...runs.map((run) => run.curve[run.curve.length - 1][place]), 1);
  plot.begin([0, furthest], [0, 100], label, " %");
  for (const run of runs) {
    plot.curve(run.curve.map((point) => point[place]), run.curve.map((point) => 100 * point[2]), styleOf(run.planner).colour);
    plot.element.lastChild.classList.add("single");
  }
  for (const planner of planners) {
    const own = runs.filter((run) => run.planner === planner).map((run) => run.curve);
    if (own.length === 0) continue;
    const ends = own.map((curve) => curve[curve.length - 1][place]);
    const last = Math.max(...ends);
    const xs = Array.from({ length: 301 }, (_, i) => last * i / 300);
    const { colour, dash } = styleOf(planner);
    plot.curve(xs, xs.map((x) => 100 * median(own.map((curve) => knownAt(curve, place, x)))), colour);
    plot.element.lastChild.classList.add("median");
    plot.element.lastChild.setAttribute("stroke-dasharray", dash);
  }
}

// --- tables ----------------------------------------------------------------------------------------------------
function numberText(value, digits) {
  return value === null ? "never" : value.toFixed(digits);
}

function figureCell(spread, digits, runs) {
  const cell = made("td", { textContent: spread ? numberText(spread.median, digits) : "–" });
  if (spread && runs > 1) {
    cell.append(made("small", { textContent: `${numberText(spread.q1, digits)} … ${numberText(spread.q3, digits)}` }));
  }
  return cell;
}

function tableOf(rows) {
  const columns = results.columns.filter(({ key }) => rows.some((row) => row[key]));
  const titles = ["world", "planner", "ended", ...columns.map(({ title }) => title), "collisions", "plan, ms", "plan 99th, ms"];
  const table = made("table", {});
  table.createTHead().insertRow().append(...titles.map((title) => made("th", { textContent: title })));
  const body = table.createTBody();
  rows.forEach((row, i) => {
    const line = body.insertRow();
    line.dataset.planner = row.planner;
    line.classList.toggle("first", i > 0 && rows[i - 1].world !== row.world);
    const planner = made("td", { textContent: row.planner });
    planner.style.color = styleOf(row.planner).colour;
    line.append(made("td", { textContent: row.world }), planner,
      made("td", { textContent: Object.entries(row.outcomes).map(([outcome, count]) => `${count} ${outcome}`).join(", ") }));
    for (const { key, digits } of columns) {
      const cell = figureCell(row[key], digits, row.runs);
      if (key === "to_bound" && row[key] && !row.bounds_met) cell.prepend("≤ ");
      cell.dataset.column = key;
      line.append(cell);
    }
    line.append(made("td", { textContent: row.collisions }),
      ...[row.plan_p50_ms, row.plan_p99_ms].map((ms) => made("td", { textContent: ms === null ? "–" : ms.toFixed(1) })));
  });
  // The least seconds and metres in each world, among planners whose every run ended by itself.
  for (const key of ["duration_s", "path_m"]) {
    for (const world of new Set(rows.map((row) => row.world))) {
      const able = rows.filter((row) => row.world === world && row[key] && !row.outcomes.budget && !row.outcomes.blocked);
      const least = Math.min(...able.map((row) => row[key].median));
      rows.forEach((row, i) => {
        if (!able.includes(row) || row[key].median !== least) return;
        const cell = body.rows[i].querySelector(`[data-column=${key}]`);
        if (cell) cell.classList.add("best");
      });
    }
  }
  return made("div", { className: "scroll" }, table);
}

// --- start -----------------------------------------------------------------------------------------------------
function addPlanner(planner) {
  const { colour, dash } = styleOf(planner);
  const box = made("input", { type: "checkbox", checked: true, name: planner });
  box.addEventListener("change", () => {
    if (box.checked) hidden.delete(planner); else hidden.add(planner);
    for (const line of document.querySelectorAll("tr[data-planner]")) line.hidden = hidden.has(line.dataset.planner);
    drawn.forEach((draw) => draw());
  });
  const swatch = svg("svg", { viewBox: "0 0 26 10" });
  svg("line", { x1: 1, x2: 25, y1: 5, y2: 5, stroke: colour, "stroke-width": 3, "stroke-dasharray": dash }, swatch);
  document.getElementById("planners").append(made("label", {}, box, swatch, planner));
}

function addClass({ name, about, command, worlds }) {
  const rows = results.rows.filter((row) => worlds.includes(row.world));
  const plots = made("div", { className: "plots" });
  document.querySelector("main").append(made("h2", { textContent: name }), made("p", { textContent: about }),
    made("p", {}, made("code", { textContent: command })), plots, tableOf(rows));
  for (const world of new Set(rows.map((row) => row.world))) {
    const element = svg("svg", { class: "plot" });
    element.dataset.world = world;
    plots.append(made("figure", {}, made("figcaption", {}, made("h3", { textContent: world }), "cells known rightly"), element));
    const plot = new Plot(element, () => {});
    drawn.push(() => drawWorld(plot, world));
  }
}

const starts = new Set(results.runs.map((run) => run.start)).size;
document.getElementById("title").textContent = `${planners.length} planner${planners.length === 1 ? "" : "s"} side by side, `
  + `${starts} start${starts === 1 ? "" : "s"}: medians, quartiles, and each run thin`;
planners.forEach(addPlanner);
results.classes.forEach(addClass);
const choice = document.getElementById("abscissa");
choice.hidden = !isTimed;
for (const button of choice.children) {
  button.setAttribute("aria-pressed", button.value === shown.abscissa);
  button.addEventListener("click", () => {
    shown.abscissa = button.value;
    for (const other of choice.children) other.setAttribute("aria-pressed", other === button);
    drawn.forEach((draw) => draw());
  });
}
addEventListener("resize", () => drawn.forEach((draw) => draw()));
drawn.forEach((draw) => draw());
document.body.dataset.ready = "true";
