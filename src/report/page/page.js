// SPDX-License-Identifier: MIT
// Brings the runs of this page together: scenes, curves, numbers and one moment in time.

const kStages = [
  { key: "insert", name: "insert", colour: "#56b4e9" }, { key: "survey", name: "survey", colour: "#009e73" },
  { key: "choose", name: "choose", colour: "#e69f00" }, { key: "path", name: "path", colour: "#cc79a7" },
  { key: "other", name: "plan, rest", colour: "#7f8ea3" },
];

const runs = [...document.querySelectorAll("script.run")].map((element) => JSON.parse(element.textContent));
const several = runs.length > 1;
const $ = (id) => document.getElementById(id);
const scenes = [];
const state = { now: 1, abscissa: "view", playing: false, slice: null };
const length = Math.max(...runs.map((run) => run.report.cycles.length), 1);

function baseName(path) {
  return String(path).split("/").pop().replace(/\.[a-z0-9]+$/i, "") || "?";
}

function titleOf({ report }) {
  return `${report.planner} ${report.command === "reconstruct" ? "looks at" : "in"} ${baseName(report.world)}`;
}

function percent(share, digits = 1) {
  return share === null || share === undefined ? "–" : `${(100 * share).toFixed(digits)} %`;
}

// What a run is measured by where the truth is known: what was seen of an object, or the world's cells.
function shareOf(cycle) {
  return cycle.seen_coverage ?? cycle.coverage ?? null;
}

// Cubic metres known after a view: what there is to tell of a run of which nobody knows the truth.
function knownOf({ replay }, i) {
  return replay ? replay.known_cells[i] * replay.cell_m ** 3 : null;
}

// What the first plot shows of a run at a cycle: shares in percent where anything is measured, else cubic metres.
function progressOf(run, i) {
  return measured() ? percentOrNull(shareOf(run.report.cycles[i])) : knownOf(run, i);
}

function measured() {
  return runs.some((run) => run.report.cycles.some((cycle) => shareOf(cycle) !== null));
}

// Runs that differ in their seed alone: one colour, and one row of the table.
function groupOf(run) {
  return `${run.report.planner} in ${baseName(run.report.world)}, ${run.report.resolution_m} m`;
}

function prepare(run, index) {
  let ms = 0;
  run.seconds = run.report.cycles.map((cycle) => {
    ms += cycle.insert_ms + cycle.plan_ms;
    return cycle.time_s ?? ms / 1000;  // the robot's time where the run was timed, else the computer's
  });
  const groups = [...new Set(runs.map(groupOf))];
  run.colour = several ? kRunColours[groups.indexOf(groupOf(run)) % kRunColours.length] : kRunColours[0];
  run.index = index;
}

function isTimed(run) {
  return run.report.cycles.some((cycle) => typeof cycle.time_s === "number");
}

function abscissaOf(run, i) {
  if (state.abscissa === "view") return run.report.cycles[i].view;
  return state.abscissa === "metres" ? run.report.cycles[i].path_length_m : run.seconds[i];
}

// --- numbers ---------------------------------------------------------------------------------------------------
function showNumbers() {
  const { report } = runs[0];
  const rows = [
    ["outcome", "outcome", report.outcome, report.outcome], ["views", "views", report.views, report.views],
    ["path_length_m", "path", report.path_length_m, `${report.path_length_m.toFixed(1)} m`],
    ["duration_s", "duration", report.duration_s, `${(report.duration_s ?? 0).toFixed(1)} s`],
    ["turned_deg", "turned", report.turned_deg, `${(report.turned_deg ?? 0).toFixed(0)} degrees`],
    ["coverage", "coverage", report.coverage, percent(report.coverage, 2)],
    ["seen_coverage", "seen", report.seen_coverage, percent(report.seen_coverage, 2)],
    ["seen_observable", "seen of what can be", report.seen_observable, percent(report.seen_observable, 2)],
    ["surface_coverage", "surface", report.surface_coverage, percent(report.surface_coverage, 2)],
    ["collisions", "collisions", report.collisions, report.collisions],
    ["time_ms.insert.median", "insert, median", report.time_ms.insert.median, milliseconds(report.time_ms.insert.median)],
    ["time_ms.plan.median", "plan, median", report.time_ms.plan.median, milliseconds(report.time_ms.plan.median)],
    ["resolution_m", "cell", report.resolution_m, `${report.resolution_m} m`],
    ["seed", "seed", report.seed, report.seed],
  ];
  for (const [key, name, value, text] of rows) {
    if (value === null || value === undefined) continue;
    const cell = document.createElement("div");
    const term = document.createElement("dt");
    const number = document.createElement("dd");
    term.textContent = name;
    number.textContent = text;
    number.dataset.key = key;
    number.dataset.value = JSON.stringify(value);
    cell.append(term, number);
    $("numbers").append(cell);
  }
}

function milliseconds(value) {
  return value === null || value === undefined ? "–" : `${+value.toPrecision(3)} ms`;
}

function quartiles(values) {
  const sorted = values.filter((v) => v !== null && v !== undefined).sort((a, b) => a - b);
  if (sorted.length === 0) return null;
  const at = (share) => {
    const place = share * (sorted.length - 1);
    const low = Math.floor(place);
    return sorted[low] + (place - low) * (sorted[Math.min(low + 1, sorted.length - 1)] - sorted[low]);
  };
  return { q1: at(0.25), median: at(0.5), q3: at(0.75) };
}

// One row per planner and world: medians over seeds, quartiles below.
function showTable() {
  const groups = new Map();
  for (const run of runs) {
    groups.set(groupOf(run), [...(groups.get(groupOf(run)) || []), run]);
  }
  const columns = [
    ["views", (r) => r.report.views, (v) => v.toFixed(0)], ["path [m]", (r) => r.report.path_length_m, (v) => v.toFixed(1)],
    ["coverage", (r) => r.report.seen_coverage ?? r.report.coverage, (v) => percent(v, 2)],
    ["turned [°]", (r) => r.report.turned_deg, (v) => v.toFixed(0)],
    [runs.some(isTimed) ? "time [s]" : "computing [s]", (r) => r.report.duration_s ?? r.seconds[r.seconds.length - 1],
      (v) => v.toFixed(1)],
    ["plan [ms]", (r) => r.report.time_ms.plan.median, (v) => String(+v.toPrecision(3))],
  ];
  const table = document.createElement("table");
  const head = table.createTHead().insertRow();
  ["planner", "runs", ...columns.map(([name]) => name)].forEach((name) => {
    const th = document.createElement("th");
    th.textContent = name;
    head.append(th);
  });
  const body = table.createTBody();
  for (const [name, members] of groups) {
    const row = body.insertRow();
    row.dataset.group = name;
    const first = row.insertCell();
    first.textContent = name;
    first.style.color = members[0].colour;
    row.insertCell().textContent = members.length;
    for (const [column, valueOf, text] of columns) {
      const cell = row.insertCell();
      const spread = quartiles(members.map(valueOf));
      cell.textContent = spread ? text(spread.median) : "–";
      cell.dataset.column = column;
      cell.dataset.value = spread ? spread.median : "";
      if (spread && members.length > 1) {
        const small = document.createElement("small");
        small.textContent = `${text(spread.q1)} … ${text(spread.q3)}`;
        cell.append(small);
      }
    }
  }
  $("table").append(table);
}

// --- curves ----------------------------------------------------------------------------------------------------
let plots = {};

function stagesOf(run, i) {
  const cycle = run.report.cycles[i];
  const stages = run.replay && run.replay.cycles[i] && run.replay.cycles[i].stages;
  const [survey, choose, path] = stages && cycle.plan_ms > 0 ? stages : [0, 0, 0];
  return { insert: cycle.insert_ms, survey, choose, path, other: Math.max(0, cycle.plan_ms - survey - choose - path) };
}

function drawCurves() {
  const ends = runs.map((run) => abscissaOf(run, run.report.cycles.length - 1));
  const label = { view: "views", metres: "path [m]", seconds: isTimed(runs[0]) ? "time [s]" : "computing [s]" }[state.abscissa];
  const from = state.abscissa === "view" ? 1 : 0;
  const progress = runs.map((run) => run.report.cycles.map((_, i) => progressOf(run, i)));
  $("coverage-title").textContent = !measured() ? "Known volume"
    : (runs[0].report.seen_coverage ?? null) === null ? "Cells known rightly" : "Surface seen";
  plots.coverage.begin([from, Math.max(...ends)], [0, measured() ? 100 : Math.max(...progress.flat(), 0)], label,
    measured() ? " %" : " m³");
  runs.forEach((run, k) => {
    plots.coverage.curve(run.report.cycles.map((_, i) => abscissaOf(run, i)), progress[k], run.colour);
  });
  const most = Math.max(...runs.flatMap((run) => run.report.cycles.map((cycle) => cycle.frontier_cells)));
  $("frontier").parentElement.hidden = most === 0;  // a planner that counts none
  plots.frontier.begin([from, Math.max(...ends)], [0, most], label, "");
  for (const run of runs) {
    plots.frontier.curve(run.report.cycles.map((_, i) => abscissaOf(run, i)),
      run.report.cycles.map((cycle) => cycle.frontier_cells), several ? run.colour : "#f0524f");
  }
  drawTimes();
}

function percentOrNull(share) {
  return share === null || share === undefined ? null : 100 * share;
}

function drawTimes() {
  const totals = runs.flatMap((run) => run.report.cycles.map((cycle) => cycle.insert_ms + cycle.plan_ms));
  plots.times.begin([0.5, length + 0.5], [0, Math.max(...totals, 1)], "views", " ms");
  $("times-key").textContent = "";
  if (several) {
    for (const run of runs) {
      plots.times.curve(run.report.cycles.map((cycle) => cycle.view),
        run.report.cycles.map((cycle) => cycle.insert_ms + cycle.plan_ms), run.colour);
    }
    return;
  }
  const stages = runs[0].report.cycles.map((_, i) => stagesOf(runs[0], i));
  const used = kStages.filter(({ key }) => stages.some((stage) => stage[key] > 0));
  plots.times.columns(runs[0].report.cycles.map((cycle) => cycle.view),
    used.map(({ key }) => stages.map((stage) => stage[key])), used.map(({ colour }) => colour));
  for (const { name, colour } of used) {
    const entry = document.createElement("span");
    const swatch = document.createElement("i");
    swatch.style.background = colour;
    entry.append(swatch, name);
    $("times-key").append(entry);
  }
}

function markCurves() {
  const dots = (valueOf) => runs.filter((run) => run.report.cycles.length > 0).map((run) => {
    const i = Math.min(state.now, run.report.cycles.length) - 1;
    return { x: abscissaOf(run, i), y: valueOf(run, i), colour: run.colour };
  });
  const coverage = dots(progressOf);
  const line = (list) => (several ? null : list[0].x);
  plots.coverage.mark(line(coverage), coverage);
  const frontier = dots((run, i) => run.report.cycles[i].frontier_cells);
  if (!several) frontier[0].colour = "#f0524f";
  plots.frontier.mark(line(frontier), frontier);
  plots.times.mark(state.now, []);
}

// The view whose abscissa comes next to `x` in the longest run.
function pickView(x) {
  const run = runs.find((r) => r.report.cycles.length === length);
  let best = 0;
  run.report.cycles.forEach((_, i) => {
    if (Math.abs(abscissaOf(run, i) - x) < Math.abs(abscissaOf(run, best) - x)) best = i;
  });
  seek(best + 1);
}

// --- time ------------------------------------------------------------------------------------------------------
function seek(now) {
  state.now = Math.min(Math.max(Math.round(now), 1), length);
  $("slider").value = state.now;
  for (const scene of scenes) scene.seek(state.now);
  if (state.slice) {
    state.slice.input.value = scenes[0].views[scenes[0].now - 1].pose[2];
    state.slice.update();
  }
  markCurves();
  const run = runs.find((r) => r.report.cycles.length === length);
  const cycle = run.report.cycles[state.now - 1];
  const share = shareOf(cycle);
  $("moment").value = several ? `view ${state.now}`
    : `view ${cycle.view} of ${length} · ${cycle.path_length_m.toFixed(1)} m` +
      (share === null ? "" : ` · ${percent(share)}`);
}

function play(on) {
  state.playing = on;
  $("play").innerHTML = on ? "&#10074;&#10074;" : "&#9654;";
  $("play").setAttribute("aria-label", on ? "Pause" : "Play");
  if (on && state.now >= length) seek(1);
  state.since = performance.now();
}

function frame(time) {
  const { seconds } = runs[0];
  const pause = isTimed(runs[0]) && state.now < seconds.length
    ? 1000 * (seconds[state.now] - seconds[state.now - 1])  // at true speed
    : Math.max(60, 14000 / length);  // a whole run in about a quarter of a minute
  if (state.playing && time - state.since > pause) {
    state.since = isTimed(runs[0]) ? Math.max(state.since + pause, time - 1000) : time;
    seek(state.now + 1);
    if (state.now >= length) play(false);
  }
  for (const scene of scenes) scene.draw();
  requestAnimationFrame(frame);
}

// --- legend ----------------------------------------------------------------------------------------------------
const kLayers = [
  ["surfaces", "surfaces", null], ["frontiers", "frontiers", "#f0524f"],
  ["voids", "voids, where they touch free space", "#a78bfa"], ["path", "path travelled", "#56b4e9"],
  ["plan", "path planned", "#f2b134"], ["sensor", "sensor", "#ffffff"],
  ["ground", "ground, grid of 1 m", "#2c3646"], ["candidates", "candidate views, by utility", "utility"], ["field", "field, down its slope", "field"],
];

function element(name, attributes, ...children) {
  const made = Object.assign(document.createElement(name), attributes);
  made.append(...children);
  return made;
}

function addSlider(form, text, span, value, onInput) {
  const shown = element("output", {});
  const input = element("input", { type: "range", min: span[0], max: span[1], step: (span[1] - span[0]) / 200 || 1 });
  input.value = value;
  input.setAttribute("aria-label", text);
  const update = () => {
    shown.value = `${(+input.value).toFixed(2)} m`;
    onInput(+input.value);
  };
  input.addEventListener("input", update);
  form.append(element("div", { className: "range" }, element("span", {}, text), shown, input));
  update();
  return { input, update };
}

function addLegend() {
  const form = $("layers");
  form.addEventListener("submit", (event) => event.preventDefault());
  for (const [name, text, colour] of kLayers) {
    if (!scenes.some((scene) => scene.layers[name])) continue;
    const box = element("input", { type: "checkbox", checked: true, name });
    box.addEventListener("change", () => scenes.forEach((scene) => scene.setShown(name, box.checked)));
    const swatch = element("span", { className: "swatch" });
    swatch.style.background = colour === null ? rampGradient("height") : kRamps[colour] ? rampGradient(colour) : colour;
    const words = name === "ground" ? text.replace("1", scenes[0].groundStep) : text;
    form.append(element("label", {}, box, swatch, words));
    if (name === "surfaces") addColouring(form, swatch);
  }
  const low = Math.min(...scenes.map((scene) => scene.low.z));
  const high = Math.max(...scenes.map((scene) => scene.high.z));
  addSlider(form, "hide above", [low, high], high, (z) => scenes.forEach((s) => s.setCut(z >= high ? 1e9 : z)));
  if (scenes.some((scene) => scene.layers.field)) {
    // The slice goes where the sensor is until a hand moves it.
    const slice = addSlider(form, "field at", [low, high], low, (z) => scenes.forEach((s) => s.setSlice(z)));
    slice.input.addEventListener("pointerdown", () => { state.slice = null; });
    slice.input.addEventListener("keydown", () => { state.slice = null; });
    state.slice = slice;
  }
  $("legend").open = innerWidth > 900 && !several;
}

function addColouring(form, swatch) {
  const select = element("select", { ariaLabel: "Colour of surfaces" },
    element("option", { value: "height" }, "coloured by height"),
    element("option", { value: "time" }, "coloured by the view that saw them"));
  const ramp = element("span", { className: "ramp" });
  const ends = element("span", { className: "ends" });
  const update = () => {
    const byTime = select.value === "time";
    scenes.forEach((scene) => scene.setColouring(byTime));
    ramp.style.background = swatch.style.background = rampGradient(select.value);
    const text = byTime ? ["first view", "last"]
      : [`${scenes[0].low.z.toFixed(1)} m`, `${scenes[0].high.z.toFixed(1)} m`];
    ends.replaceChildren(...text.map((t) => element("span", {}, t)));
  };
  select.addEventListener("change", update);
  form.append(select, ramp, ends);
  update();
}

// --- start -----------------------------------------------------------------------------------------------------
async function addScenes() {
  const shown = runs.filter((run) => run.replay).slice(0, 6);
  const columns = Math.ceil(Math.sqrt(shown.length));
  $("scenes").style.gridTemplateColumns = `repeat(${Math.max(columns, 1)}, minmax(0, 1fr))`;
  for (const run of shown) {
    const container = element("div", { className: "scene" });
    if (several) {
      const name = element("span", { className: "name" }, `${titleOf(run)}, seed ${run.report.seed}`);
      name.style.color = run.colour;
      container.append(name);
    }
    $("scenes").append(container);
    const scene = new Scene(container, run);
    await scene.build();
    scenes.push(scene);
  }
  if (shown.length === 0) {
    $("legend").hidden = true;
    $("notice").hidden = false;
    $("notice").textContent = "No record lies beside the report: there is nothing to replay.";
  }
}

async function start() {
  runs.forEach(prepare);
  document.body.classList.toggle("several", several);
  document.title = several ? `vantage: ${runs.length} runs` : `vantage: ${titleOf(runs[0])}`;
  $("title").textContent = several ? `${runs.length} runs side by side` : titleOf(runs[0]);
  $("reason").textContent = several ? "" : `${runs[0].report.outcome}: ${runs[0].report.reason}`;
  if (several) showTable(); else showNumbers();
  plots = { coverage: new Plot($("coverage"), pickView), frontier: new Plot($("frontier"), pickView),
    times: new Plot($("times"), seek) };
  $("slider").max = length;
  $("slider").addEventListener("input", () => { play(false); seek(+$("slider").value); });
  $("play").addEventListener("click", () => play(!state.playing));
  for (const button of $("abscissa").children) {
    button.addEventListener("click", () => {
      state.abscissa = button.value;
      for (const other of $("abscissa").children) other.setAttribute("aria-pressed", other === button);
      drawCurves();
      markCurves();
    });
  }
  addEventListener("resize", () => { drawCurves(); markCurves(); });
  addEventListener("keydown", (event) => {
    if (event.target.matches("input[type=range], select, button")) return;
    if (event.key === " ") { event.preventDefault(); play(!state.playing); }
    if (event.key === "ArrowRight") seek(state.now + 1);
    if (event.key === "ArrowLeft") seek(state.now - 1);
  });
  drawCurves();
  await addScenes();
  if (scenes.length > 0) addLegend();
  seek(length);
  requestAnimationFrame(frame);
  document.body.dataset.ready = "true";
}

start().catch((error) => {
  $("notice").hidden = false;
  $("notice").textContent = `This view could not be set up: ${error.message}`;
  console.error(error);
});
