// The large view: one picture, a wipe between two, two side by side, or all; zoomed and moved in step.

const maps = [
  ["picture", "picture"], ["absolute", "absolute"], ["signed", "signed"], ["relmse", "relMSE"],
  ["flip", "FLIP"], ["pixelated", "pixelated"],
];
const layouts = [["one", "one"], ["wipe", "wipe"], ["side", "side by side"], ["all", "all"]];

const state = {
  scene: "", b: "", a: "", layer: "", map: "picture", layout: "one", flipped: false,
  exposure: 0, curve: "clip", mapStops: 0, zoom: 1, x: 0.5, y: 0.5, wipe: 0.5,
};

const byId = (id) => document.getElementById(id);
const hasPictures = (cell) => cell.pictures.length > 0;
const cellsOf = (scene) => report.cells.filter((c) => c.scene === scene && hasPictures(c));
const cellOf = (name) => cellsOf(state.scene).find((c) => c.label === name);
let panes = [];
let drawn = Promise.resolve();  // the last redraw, for those who wait for it

// What a pane shows. Maps compare with `a`; the picture compared with itself is shown as it is.
function paneContent(cell) {
  const map = state.map === "picture" || !cell || cell.label === state.a ? "picture" : state.map;
  return { cell, map };
}

function paneList() {
  const a = cellOf(state.a), b = cellOf(state.b);
  if (state.layout === "all") return cellsOf(state.scene).map((c) => ({ show: paneContent(c) }));
  if (state.layout === "side") return [{ show: paneContent(a) }, { show: paneContent(b) }];
  if (state.layout === "wipe") return [{ show: paneContent(b), under: paneContent(a) }];
  return [{ show: paneContent(state.flipped ? a : b) }];
}

// Columns that make the pictures largest on four fifths of the window, and no higher than they need.
function layOut(count, aspect) {
  const stage = byId("stage"), width = stage.clientWidth, height = Math.max(240, 0.8 * window.innerHeight);
  const size = (n) => Math.min(width / n, (aspect * height) / Math.ceil(count / n));
  let best = 1;
  for (let n = 2; n <= count; ++n) if (size(n) > size(best) + 1e-6) best = n;
  stage.style.gridTemplateColumns = `repeat(${best}, 1fr)`;
  stage.style.height = `${Math.min(height, Math.ceil(count / best) * (width / best / aspect))}px`;
}

const painted = new Map();  // ImageBitmaps' stand-ins: canvases by what they show

async function paint({ cell, map }) {
  const key = [cell.scene, cell.label, state.layer, map, map === "picture" ? state.exposure + state.curve : state.a + state.mapStops].join("|");
  if (painted.has(key)) return painted.get(key);
  const b = await picture(cell, state.layer);
  if (!b) return null;
  let image, scale = 0;
  if (map === "picture") {
    image = paintPicture(b, toneTable(state.exposure, state.curve));
  } else {
    const errors = await errorsOf(cell, map);
    if (!errors) return null;
    scale = (map === "flip" ? 1 : automaticScale(errors)) * 2 ** -state.mapStops;
    image = paintMap(errors, b.width, b.height, scale, map === "signed" ? "diverging" : "inferno");
  }
  const canvas = new OffscreenCanvas(b.width, b.height);
  canvas.getContext("2d").putImageData(image, 0, 0);
  const result = { canvas, scale };
  painted.set(key, result);
  if (painted.size > 24) painted.delete(painted.keys().next().value);
  return result;
}

// One number per pixel, or null where the map does not exist (FLIP is against the reference only).
async function errorsOf(cell, map) {
  const a = await picture(cellOf(state.a), state.layer), b = await picture(cell, state.layer);
  if (!a || !b || a.width !== b.width || a.height !== b.height) return null;
  if (map !== "flip") return errorMap(map, a, b, report.block);
  const flip = cellOf(state.a).reference && (await picture(cell, state.layer, "flip"));
  return flip ? Float32Array.from(flip.values, (v) => v / 255) : null;
}

function makePane(content) {
  const element = document.createElement("div");
  element.className = "pane";
  const canvas = element.appendChild(document.createElement("canvas"));
  const label = (entry, side) => {
    const name = element.appendChild(document.createElement("span"));
    name.className = "name " + side;
    name.textContent = entry.cell ? (entry.map === "picture" ? "" : entry.map + " error: ") + entry.cell.label : "no picture";
  };
  if (content.under) label(content.under, ""), label(content.show, "right");
  else label(content.show, "");
  const pane = { ...content, element, canvas };
  listenToPointer(pane);
  return pane;
}

// Where the image lies in the pane, in device pixels.
function placement(pane, width, height) {
  const ratio = window.devicePixelRatio || 1;
  const w = Math.max(1, Math.round(pane.element.clientWidth * ratio));
  const h = Math.max(1, Math.round(pane.element.clientHeight * ratio));
  const scale = Math.min(w / width, h / height) * state.zoom;
  return { w, h, scale, left: w / 2 - state.x * width * scale, top: h / 2 - state.y * height * scale };
}

function drawPane(pane) {
  const front = pane.image, size = (front || pane.underImage || {}).canvas;
  if (!size) return;
  const place = placement(pane, size.width, size.height);
  if (pane.canvas.width !== place.w) pane.canvas.width = place.w;
  if (pane.canvas.height !== place.h) pane.canvas.height = place.h;
  const context = pane.canvas.getContext("2d");
  context.clearRect(0, 0, place.w, place.h);
  context.imageSmoothingEnabled = place.scale < 1;
  context.imageSmoothingQuality = "high";
  const put = (image) => image && context.drawImage(image.canvas, place.left, place.top, size.width * place.scale, size.height * place.scale);
  put(front);
  if (!pane.under) return;
  const edge = state.wipe * place.w;
  context.save();
  context.beginPath(), context.rect(0, 0, edge, place.h), context.clip();
  context.clearRect(0, 0, edge, place.h);
  put(pane.underImage);
  context.restore();
  context.fillStyle = "#fffc";
  context.fillRect(edge - 1, 0, 2, place.h);
}

const drawAll = () => panes.forEach(drawPane);

async function redraw() {
  const list = paneList(), mine = list;
  redraw.latest = mine;
  const sizes = (list[0].show.cell || { pictures: [] }).pictures[0] || { width: 16, height: 9 };
  panes = list.map(makePane);
  const stage = byId("stage"), fresh = panes;
  layOut(fresh.length, sizes.width / sizes.height);
  for (const pane of fresh) {
    pane.image = pane.show.cell && (await paint(pane.show));
    pane.underImage = pane.under && pane.under.cell && (await paint(pane.under));
    if (redraw.latest !== mine) return;
  }
  stage.replaceChildren(...fresh.map((p) => p.element));
  for (const pane of fresh) {
    if (!pane.image && pane.show.cell)
      pane.element.querySelector(".name").textContent = "no such map: " + (pane.show.map === "flip" ? "FLIP is measured against the reference" : "sizes differ, or the light is not there");
  }
  drawAll();
  const mapped = fresh.find((p) => p.show.map !== "picture" && p.image);
  byId("scale-text").textContent = mapped ? mapped.image.scale.toPrecision(3) : "";
}

// The pixel under a point of a pane, or null outside.
function pixelAt(pane, event) {
  const size = (pane.image || {}).canvas;
  if (!size) return null;
  const ratio = window.devicePixelRatio || 1, box = pane.element.getBoundingClientRect();
  const place = placement(pane, size.width, size.height);
  const x = Math.floor(((event.clientX - box.left) * ratio - place.left) / place.scale);
  const y = Math.floor(((event.clientY - box.top) * ratio - place.top) / place.scale);
  return x >= 0 && y >= 0 && x < size.width && y < size.height ? { x, y } : null;
}

async function readPixel({ x, y }) {
  const numbers = async (cell) => {
    const p = await picture(cell, state.layer);
    if (!p || x >= p.width || y >= p.height) return null;
    const i = (y * p.width + x) * p.channels;
    return Array.from(p.values.subarray(i, i + p.channels), (h) => halfTable[h]);
  };
  const a = await numbers(cellOf(state.a)), b = await numbers(cellOf(state.b));
  const row = (name, v) => name.padEnd(34).slice(0, 34) + v.map((n) => n.toPrecision(5).padStart(13)).join("");
  const lines = [`pixel ${x}, ${y}`];
  if (a) lines.push(row(state.a, a));
  if (b && state.b !== state.a) lines.push(row(state.b, b));
  if (a && b && state.b !== state.a) lines.push(row("difference", b.map((n, c) => n - a[c])));
  byId("readout").textContent = lines.join("\n");
}

function zoomBy(factor, pane, event) {
  const size = (pane && pane.image && pane.image.canvas) || null;
  const zoom = Math.min(200, Math.max(0.5, state.zoom * factor));
  if (size && event) {  // what is under the pointer stays there
    const ratio = window.devicePixelRatio || 1, box = pane.element.getBoundingClientRect();
    const place = placement(pane, size.width, size.height);
    const dx = (event.clientX - box.left) * ratio - place.w / 2, dy = (event.clientY - box.top) * ratio - place.h / 2;
    const grown = place.scale * (zoom / state.zoom);
    state.x += dx / size.width * (1 / place.scale - 1 / grown);
    state.y += dy / size.height * (1 / place.scale - 1 / grown);
  }
  state.zoom = zoom;
  drawAll();
}

function listenToPointer(pane) {
  const { element } = pane;
  let last = null, wiping = false;
  element.addEventListener("wheel", (e) => (e.preventDefault(), zoomBy(1.0015 ** -e.deltaY, pane, e)), { passive: false });
  element.addEventListener("dblclick", resetView);
  element.addEventListener("pointerdown", (e) => {
    const box = element.getBoundingClientRect();
    wiping = pane.under && Math.abs((e.clientX - box.left) / box.width - state.wipe) < 0.03;
    last = e;
    element.setPointerCapture(e.pointerId);
  });
  element.addEventListener("pointerup", () => (last = null));
  element.addEventListener("pointermove", (e) => {
    const box = element.getBoundingClientRect(), pixel = pixelAt(pane, e);
    if (pixel) readPixel(pixel);
    if (!last || !pane.image) return;
    if (wiping) {
      state.wipe = clamp01((e.clientX - box.left) / box.width);
    } else {
      const size = pane.image.canvas, ratio = window.devicePixelRatio || 1;
      const { scale } = placement(pane, size.width, size.height);
      state.x -= ((e.clientX - last.clientX) * ratio) / (scale * size.width);
      state.y -= ((e.clientY - last.clientY) * ratio) / (scale * size.height);
    }
    last = e;
    drawAll();
  });
}

function resetView() {
  Object.assign(state, { zoom: 1, x: 0.5, y: 0.5 });
  drawAll();
}
