// Parts of the picture, enlarged, method beside method.

async function drawInsets() {
  const scene = report.scenes.find((s) => s.name === state.scene), box = byId("insets");
  const cells = cellsOf(state.scene), wanted = state.scene + state.layer + state.exposure + state.curve;
  drawInsets.latest = wanted;
  const rows = [], tones = toneTable(state.exposure, state.curve);
  for (const inset of scene ? scene.insets : []) {
    const row = document.createElement("div");
    row.className = "inset-row";
    for (const cell of cells) {
      const p = await picture(cell, state.layer);
      if (drawInsets.latest !== wanted) return;
      if (p) row.append(insetFigure(cell, p, inset, tones));
    }
    const heading = document.createElement("h3");
    heading.textContent = inset.name;
    rows.push(heading, row);
  }
  box.replaceChildren(...rows);
}

function insetFigure(cell, p, inset, tones) {
  const [x0, y0, x1, y1] = inset.at;
  const left = Math.floor(x0 * p.width), top = Math.floor(y0 * p.height);
  const width = Math.max(1, Math.floor(x1 * p.width) - left), height = Math.max(1, Math.floor(y1 * p.height) - top);
  const part = { width, height, channels: p.channels, values: new Uint16Array(width * height * p.channels) };
  for (let y = 0; y < height; ++y) {
    const from = ((top + y) * p.width + left) * p.channels;
    part.values.set(p.values.subarray(from, from + width * p.channels), y * width * p.channels);
  }
  const figure = document.createElement("figure");
  const canvas = figure.appendChild(document.createElement("canvas"));
  canvas.width = width, canvas.height = height;
  canvas.getContext("2d").putImageData(paintPicture(part, tones), 0, 0);
  canvas.addEventListener("click", () => {
    Object.assign(state, { b: cell.label, x: (x0 + x1) / 2, y: (y0 + y1) / 2, zoom: Math.min(1 / (x1 - x0), 1 / (y1 - y0)) });
    update();
  });
  const prefix = state.layer ? state.layer + ":" : "", error = cell.values[prefix + "relmse@" + inset.name];
  const caption = figure.appendChild(document.createElement("figcaption"));
  caption.textContent = cell.label + (error ? ` · relMSE ${formatNumber(error.mean)}` : "");
  return figure;
}
