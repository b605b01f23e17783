// Line charts as SVG.

const chartColors = ["#1f77b4", "#d9822b", "#3a9d5d", "#b3478f", "#7d6cc9", "#8a7148", "#c64b46", "#4aa3a2"];

function svg(name, attributes, text) {
  const e = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  if (text !== undefined) e.textContent = text;
  return e;
}

// One line per scene, method and all parameters but the one along x.
function seriesOf(chart) {
  const lines = new Map();
  for (const cell of report.cells) {
    const x = shownValue(cell, chart.x), y = shownValue(cell, chart.y);
    if (cell.reference || x === null || y === null || (chart.log_x && x <= 0) || (chart.log_y && y <= 0)) continue;
    const others = Object.entries(cell.parameters).filter(([k]) => k !== chart.x && k !== chart.y).map(([k, v]) => `${k} ${v}`);
    const name = [report.scenes.length > 1 ? cell.scene : "", cell.method, ...others].filter(Boolean).join(", ");
    if (!lines.has(name)) lines.set(name, []);
    lines.get(name).push([x, y]);
  }
  for (const points of lines.values()) points.sort((a, b) => a[0] - b[0]);
  return lines;
}

function axis(values, log, from, to) {
  const f = log ? Math.log10 : (x) => x;
  let low = Math.min(...values.map(f)), high = Math.max(...values.map(f));
  if (!log && low > 0 && low < 0.5 * high) low = 0;
  if (high - low < 1e-12) low -= 0.5, high += 0.5;
  const step = log ? Math.max(1, Math.ceil((high - low) / 6)) : [1, 2, 5, 10].map((m) => m * 10 ** Math.floor(Math.log10((high - low) / 5))).find((s) => (high - low) / s <= 6);
  low = Math.floor(low / step + 1e-9) * step, high = Math.ceil(high / step - 1e-9) * step;
  const ticks = [];
  for (let t = low; t <= high + step * 1e-6; t += step) ticks.push(log ? 10 ** t : t);
  return { ticks, at: (x) => from + ((f(x) - low) / (high - low)) * (to - from) };
}

function drawChart(chart) {
  const lines = seriesOf(chart), points = [...lines.values()].flat();
  if (!points.length) return null;
  const width = 640, height = 300 + 16 * lines.size;
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img", "aria-label": chart.title });
  const x = axis(points.map((p) => p[0]), chart.log_x, 64, width - 16), y = axis(points.map((p) => p[1]), chart.log_y, 250, 34);
  root.append(svg("text", { x: 8, y: 16, class: "title" }, chart.title));
  for (const t of x.ticks) {
    root.append(svg("line", { x1: x.at(t), x2: x.at(t), y1: 34, y2: 250, class: "axis" }));
    root.append(svg("text", { x: x.at(t), y: 266, "text-anchor": "middle" }, formatNumber(t)));
  }
  for (const t of y.ticks) {
    root.append(svg("line", { x1: 64, x2: width - 16, y1: y.at(t), y2: y.at(t), class: "axis" }));
    root.append(svg("text", { x: 58, y: y.at(t) + 4, "text-anchor": "end" }, formatNumber(t)));
  }
  root.append(svg("text", { x: width - 16, y: 282, "text-anchor": "end" }, chart.x));
  [...lines].forEach(([name, line], i) => {
    const color = chartColors[i % chartColors.length];
    root.append(svg("polyline", { points: line.map((p) => `${x.at(p[0])},${y.at(p[1])}`).join(" "), fill: "none", stroke: color, "stroke-width": 2 }));
    for (const p of line) {
      const dot = svg("circle", { cx: x.at(p[0]), cy: y.at(p[1]), r: 3.5, fill: color });
      dot.append(svg("title", {}, `${name}: ${formatNumber(p[0])}, ${formatNumber(p[1])}`));
      root.append(dot);
    }
    root.append(svg("rect", { x: 64, y: 290 + 16 * i, width: 12, height: 3, fill: color }));
    root.append(svg("text", { x: 82, y: 295 + 16 * i }, name));
  });
  return root;
}

function buildCharts() {
  for (const chart of report.charts) {
    const drawing = drawChart(chart);
    if (!drawing) continue;
    const figure = element("figure");
    figure.append(drawing);
    byId("chart-list").append(figure);
    byId("charts").hidden = false;
  }
}
