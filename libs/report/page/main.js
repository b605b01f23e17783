// Controls, keys and the parts of the page that only tell.

const keys = [
  ["1 … 9, 0", "the method of that number; 0: what is compared against"],
  ["Space, F", "flip between the method and what is compared against"],
  ["X", "swap the two"],
  ["O W S A", "one picture, wipe, side by side, all"],
  ["[ ]", "map before, map after"],
  ["− +", "exposure half a stop down, up; with a map its white"],
  ["N P", "next, previous scene"],
  ["wheel, drag", "zoom, move; double click or R: whole picture"],
  ["?", "this list"],
];

function buttons(box, entries, current, choose) {
  box.replaceChildren(...entries.map(([value, text, key, disabled]) => {
    const button = element("button");
    button.type = "button", button.disabled = Boolean(disabled);
    button.setAttribute("aria-pressed", value === current);
    if (key) button.append(element("kbd", key));
    button.append(text);
    button.addEventListener("click", () => choose(value));
    return button;
  }));
}

function options(select, entries, current) {
  select.replaceChildren(...entries.map(([value, text]) => {
    const option = element("option", text);
    option.value = value, option.selected = value === current;
    return option;
  }));
}

const change = (values) => (Object.assign(state, values), update());
const methodsOf = (scene) => cellsOf(scene).filter((c) => c.label !== state.a);

function chooseScene(name) {
  const cells = cellsOf(name), scene = report.scenes.find((s) => s.name === name);
  const reference = cells.find((c) => c.reference) || cells[0];
  const keep = (label, otherwise) => (cells.some((c) => c.label === label) ? label : otherwise.label);
  const a = keep(state.a, reference), others = cells.filter((c) => c.label !== a);
  change({ scene: name, a, b: keep(state.b, others[0] || reference), exposure: scene.exposure, zoom: 1, x: 0.5, y: 0.5, flipped: false });
}

function drawRamp() {
  const canvas = byId("ramp"), context = canvas.getContext("2d");
  const table = ramps[state.map === "signed" ? "diverging" : "inferno"];
  canvas.hidden = state.map === "picture";
  for (let x = 0; x < canvas.width; ++x) {
    const i = 3 * Math.round((rampSize * x) / (canvas.width - 1));
    context.fillStyle = `rgb(${table[i]},${table[i + 1]},${table[i + 2]})`;
    context.fillRect(x, 0, 1, canvas.height);
  }
}

// Everything that depends on the state.
function update() {
  const cells = cellsOf(state.scene), shown = report.scenes.filter((s) => cellsOf(s.name).length);
  buttons(byId("scenes"), shown.map((s) => [s.name, s.title]), state.scene, chooseScene);
  const numbered = methodsOf(state.scene).map((c, i) => [c.label, c.label, i < 9 ? String(i + 1) : ""]);
  const against = cellOf(state.a) ? [[state.a, state.a, "0"]] : [];
  buttons(byId("methods"), [...against, ...numbered], state.flipped ? state.a : state.b, (b) => change({ b, flipped: false }));
  buttons(byId("maps"), maps.map(([value, text]) => [value, text, "", value !== "picture" && cells.length < 2]), state.map, (map) => change({ map }));
  buttons(byId("layouts"), layouts, state.layout, (layout) => change({ layout, flipped: false }));
  options(byId("against"), cells.map((c) => [c.label, c.label]), state.a);
  options(byId("layer"), ["", ...report.layers].map((l) => [l, l || "all"]), state.layer);
  byId("layer-box").hidden = !report.layers.length;
  byId("exposure").value = state.exposure;
  byId("exposure-text").textContent = (state.exposure > 0 ? "+" : "") + Number(state.exposure).toFixed(2) + " EV";
  byId("curve").value = state.curve;
  byId("scale").value = -state.mapStops;
  byId("scale-box").hidden = state.map === "picture";
  drawRamp();
  drawn = Promise.all([redraw(), drawInsets()]);
}

function step(list, current, by) {
  const values = list.map((x) => (Array.isArray(x) ? x[0] : x));
  return values[(values.indexOf(current) + by + values.length) % values.length];
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || /^(INPUT|SELECT)$/.test(event.target.tagName)) return;
  const key = event.key.toLowerCase(), scenes = report.scenes.map((s) => s.name).filter((s) => cellsOf(s).length);
  const layout = { o: "one", w: "wipe", s: "side", a: "all" }[key];
  if (/^[1-9]$/.test(key)) {
    const cell = methodsOf(state.scene)[Number(key) - 1];
    if (cell) change({ b: cell.label, flipped: false });
  } else if (key === "0") change({ flipped: true, layout: "one" });
  else if (key === " " || key === "f") change({ flipped: !state.flipped, layout: "one" });
  else if (key === "x") change({ a: state.b, b: state.a, flipped: false });
  else if (layout) change({ layout, flipped: false });
  else if (key === "[" || key === "]") change({ map: step(maps, state.map, key === "[" ? -1 : 1) });
  else if (key === "+" || key === "=" || key === "-") brighten(key === "-" ? -0.5 : 0.5);
  else if (key === "n" || key === "p") chooseScene(step(scenes, state.scene, key === "n" ? 1 : -1));
  else if (key === "r") resetView();
  else if (key === "?" || key === "h") byId("help").showModal();
  else return;
  event.preventDefault();
}

function brighten(stops) {
  if (state.map === "picture") change({ exposure: Math.max(-10, Math.min(10, state.exposure + stops)) });
  else change({ mapStops: Math.max(-6, Math.min(6, state.mapStops + stops)) });
}

function buildHelp() {
  const table = element("table");
  for (const [key, what] of keys) {
    const row = table.insertRow();
    row.append(element("th"), element("td", what));
    row.cells[0].append(element("kbd", key));
  }
  byId("help").append(element("h2", "Keys"), table);
  byId("help").addEventListener("click", () => byId("help").close());
  byId("help-button").addEventListener("click", () => byId("help").showModal());
}

function buildFailures() {
  for (const cell of report.cells.filter((c) => c.failure)) {
    const details = element("details");
    details.open = true;
    details.append(element("summary", `${cell.scene}, ${cell.label}`, "failed"), element("pre", cell.failure, "log"));
    byId("failures").append(details);
    byId("failures").hidden = false;
  }
}

function buildCommands() {
  const box = element("details"), table = element("table", undefined, "commands"), seen = new Set();
  box.append(element("summary", "every command, with its time and largest memory"));
  for (const cell of report.cells) {
    for (const run of cell.steps.filter((s) => !seen.has(s.key))) {
      seen.add(run.key);
      const row = table.insertRow(), name = row.insertCell();
      name.append(element("code", "ssphh " + run.command), element("small", `${run.key} · ${run.started} · ${run.machine}`, "quiet"));
      row.append(element("td", `${run.seconds.toFixed(2)} s`), element("td", `${Math.round(run.peak_bytes / 2 ** 20)} MiB`));
    }
  }
  box.append(table);
  return box;
}

function buildProvenance() {
  const list = element("dl"), p = report.provenance;
  const add = (name, value) => value && list.append(element("dt", name), element("dd", value));
  add("command", p.command), add("ssphh", `${p.version}, build ${p.build}`), add("work tree", p.commit), add("machine", p.machine), add("written", p.created);
  for (const [name, value] of Object.entries(report.variables)) add(name, value);
  for (const scene of report.scenes) add(scene.title, scene.hash && `content ${scene.hash}`);
  byId("provenance").append(list, buildCommands());
}

function start() {
  byId("about").textContent = report.about;
  byId("facts").textContent = `${report.provenance.machine} · ssphh ${report.provenance.version} · ${report.provenance.created}`;
  byId("notes").append(...report.notes.map((note) => element("li", note)));
  buildTables(), buildCharts(), buildFailures(), buildProvenance(), buildHelp();
  const first = report.scenes.find((s) => cellsOf(s.name).length);
  if (!first) return;
  byId("pictures").hidden = false;
  byId("exposure").addEventListener("input", (e) => change({ exposure: Number(e.target.value) }));
  byId("scale").addEventListener("input", (e) => change({ mapStops: -Number(e.target.value) }));
  byId("curve").addEventListener("change", (e) => change({ curve: e.target.value }));
  byId("layer").addEventListener("change", (e) => change({ layer: e.target.value }));
  byId("against").addEventListener("change", (e) => change({ a: e.target.value, b: state.b === e.target.value ? state.a : state.b }));
  document.addEventListener("keydown", onKey);
  window.addEventListener("resize", () => (drawn = redraw()));
  chooseScene(first.name);
}

start();
