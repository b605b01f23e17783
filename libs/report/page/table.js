// Sortable tables, one per scene.

function formatNumber(x) {
  if (x === null || x === undefined || Number.isNaN(x)) return "";
  if (x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e6)) return x.toExponential(2);
  return String(Number(x.toPrecision(4)));
}

// Median for times, mean for the rest, a number parameter; as ssphh::report::shown.
function shownValue(cell, name) {
  const v = cell.values[name];
  if (v) return name.endsWith("seconds") ? v.median : v.mean;
  const parameter = cell.parameters[name];
  return parameter === undefined || parameter === "" || Number.isNaN(Number(parameter)) ? null : Number(parameter);
}

function publishedValue(cell, title) {
  const row = report.published.rows.find((r) => r.scene === cell.scene && r.method === cell.label);
  return row && title in row.values ? row.values[title] : null;
}

function element(name, text, className) {
  const e = document.createElement(name);
  if (text !== undefined) e.textContent = text;
  if (className) e.className = className;
  return e;
}

function valueCell(cell, column, best) {
  const x = shownValue(cell, column.value), v = cell.values[column.value], published = publishedValue(cell, column.title);
  const td = element("td", formatNumber(x));
  if (x !== null && x === best) td.className = "best";
  if (v && v.count > 1) td.append(element("small", "± " + formatNumber(v.deviation)));
  if (published !== null) td.append(element("small", "published " + formatNumber(published)));
  return td;
}

function sceneTable(scene, cells) {
  const table = element("table"), head = table.createTHead().insertRow(), body = table.createTBody();
  const bests = report.columns.map((column) => {
    const numbers = cells.filter((c) => !c.reference).map((c) => shownValue(c, column.value)).filter((x) => x !== null);
    return !column.better || numbers.length < 2 ? undefined : column.better < 0 ? Math.min(...numbers) : Math.max(...numbers);
  });
  const titles = ["method", ...report.columns.map((c) => c.title + (c.unit ? ` [${c.unit}]` : ""))];
  titles.forEach((title, index) => {
    const th = head.appendChild(element("th", title));
    th.scope = "col", th.tabIndex = 0;
    const sort = () => sortTable(table, cells, index, th);
    th.addEventListener("click", sort);
    th.addEventListener("keydown", (e) => e.key === "Enter" && sort());
  });
  for (const cell of cells) {
    const row = body.insertRow();
    row.dataset.cell = report.cells.indexOf(cell);
    if (cell.reference) row.className = "reference";
    const name = row.appendChild(element("td", cell.label));
    if (cell.about) name.title = cell.about;
    if (cell.failure) name.append(element("small", "failed", "failed"));
    report.columns.forEach((column, i) => row.append(valueCell(cell, column, bests[i])));
    if (hasPictures(cell)) {
      row.style.cursor = "pointer";
      row.addEventListener("click", () => (Object.assign(state, { scene, b: cell.label }), update()));
    }
  }
  return table;
}

function sortTable(table, cells, index, th) {
  const down = th.getAttribute("aria-sort") === "ascending";
  for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
  th.setAttribute("aria-sort", down ? "descending" : "ascending");
  const key = (row) => {
    const cell = report.cells[row.dataset.cell];
    return index === 0 ? cell.label : shownValue(cell, report.columns[index - 1].value);
  };
  const rows = [...table.tBodies[0].rows].sort((r, s) => {
    const a = key(r), b = key(s);
    if (a === null || b === null) return (a === null) - (b === null);  // without a number: last
    return (down ? -1 : 1) * (typeof a === "string" ? a.localeCompare(b, "en", { numeric: true }) : a - b);
  });
  table.tBodies[0].append(...rows);
}

function buildTables() {
  for (const scene of report.scenes) {
    const cells = report.cells.filter((c) => c.scene === scene.name);
    if (!cells.length) continue;
    const box = element("div", undefined, "scroll");
    box.append(sceneTable(scene.name, cells));
    byId("tables").append(element("h3", scene.title), box);
  }
  if (report.published.source) byId("tables").append(element("p", "published: " + report.published.source, "quiet"));
}
