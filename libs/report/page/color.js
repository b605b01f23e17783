// Half floats to colours. A half has 65536 values, so every curve is one table.

const halfTable = (() => {
  const table = new Float32Array(65536);
  for (let h = 0; h < 65536; ++h) {
    const sign = h & 0x8000 ? -1 : 1, exponent = (h >> 10) & 31, mantissa = h & 1023;
    table[h] = exponent === 0 ? sign * mantissa * 2 ** -24
      : exponent === 31 ? (mantissa ? NaN : sign * Infinity)
      : sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
  }
  return table;
})();

function srgb(x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
}

function filmic(x) {
  return (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
}

// 8-bit code of every half at an exposure; negative and NaN are 0, as in ssphh/image/tonemap.h.
function toneTable(exposure, curve) {
  const table = new Uint8Array(65536), factor = 2 ** exposure;
  for (let h = 0; h < 65536; ++h) {
    const x = halfTable[h] * factor;
    if (!(x > 0)) continue;
    const y = curve === "filmic" ? (x > 1e4 ? 1 : filmic(x)) : x;
    table[h] = Math.round(255 * srgb(Math.min(1, y)));
  }
  return table;
}

function clamp01(x) {
  return x < 0 ? 0 : x > 1 ? 1 : x;
}

// matplotlib's inferno, polynomial fit by Matt Zucker (CC0), as in ssphh/metrics/heat_map.h.
function inferno(t) {
  const poly = (c) => c.reduceRight((sum, x) => sum * t + x, 0);
  return [
    poly([0.0002189403691192265, 0.1065134194856116, 11.60249308247187, -41.70399613139459, 77.162935699427, -71.31942824499214, 25.13112622477341]),
    poly([0.001651004631001012, 0.5639564367884091, -3.972853965665698, 17.43639888205313, -33.40235894210092, 32.62606426397723, -12.24266895238567]),
    poly([-0.01948089843709184, 3.932712388889277, -15.9423941062914, 44.35414519872813, -81.80730925738993, 73.20951985803202, -23.07032500287172]),
  ].map(clamp01);
}

// Blue, white, red.
function diverging(t) {
  const ends = t < 0 ? [0.23, 0.3, 0.75] : [0.71, 0.016, 0.15];
  const a = Math.min(1, Math.abs(t));
  return ends.map((e) => 0.95 + (e - 0.95) * a);
}

const rampSize = 1024;
function rampTable(name) {
  const table = new Uint8Array(3 * (rampSize + 1));
  for (let i = 0; i <= rampSize; ++i) {
    const t = i / rampSize, color = name === "diverging" ? diverging(2 * t - 1) : inferno(t);
    color.forEach((x, c) => (table[3 * i + c] = Math.round(255 * x)));
  }
  return table;
}
const ramps = { inferno: rampTable("inferno"), diverging: rampTable("diverging") };

function paintPicture(p, tones) {
  const out = new Uint8ClampedArray(4 * p.width * p.height), { values, channels } = p;
  for (let i = 0, o = 0; o < out.length; i += channels, o += 4) {
    out[o] = tones[values[i]];
    out[o + 1] = tones[values[channels === 3 ? i + 1 : i]];
    out[o + 2] = tones[values[channels === 3 ? i + 2 : i]];
    out[o + 3] = 255;
  }
  return new ImageData(out, p.width, p.height);
}

// One error per pixel, channels averaged; the definitions of ssphh/metrics/compare.h.
function errorMap(kind, a, b, block) {
  const { width, height, channels } = a, n = width * height;
  const map = new Float32Array(n);
  for (let p = 0, i = 0; p < n; ++p) {
    let sum = 0;
    for (let c = 0; c < channels; ++c, ++i) {
      const r = halfTable[a.values[i]], d = halfTable[b.values[i]] - r;
      sum += kind === "signed" ? d : kind === "relmse" ? (d * d) / (r * r + 0.01) : Math.abs(d);
    }
    map[p] = sum / channels;
  }
  return kind === "pixelated" ? sumBlocks(map, width, height, block) : map;
}

// The paper's map: every pixel of a block gets the *sum* of the block's errors.
function sumBlocks(map, width, height, block) {
  const columns = Math.ceil(width / block), sums = new Float64Array(columns * Math.ceil(height / block));
  const at = (p) => Math.floor(Math.floor(p / width) / block) * columns + Math.floor((p % width) / block);
  for (let p = 0; p < map.length; ++p) if (Number.isFinite(map[p])) sums[at(p)] += map[p];
  return map.map((_, p) => sums[at(p)]);
}

// The 99th percentile of the magnitudes, estimated from every few pixels.
function automaticScale(map) {
  const sample = [];
  for (let p = 0; p < map.length; p += Math.max(1, Math.floor(map.length / 20000)))
    if (Number.isFinite(map[p])) sample.push(Math.abs(map[p]));
  sample.sort((a, b) => a - b);
  return sample[Math.floor(0.99 * (sample.length - 1))] || 1;
}

function paintMap(map, width, height, scale, ramp) {
  const out = new Uint8ClampedArray(4 * map.length), table = ramps[ramp];
  for (let p = 0, o = 0; p < map.length; ++p, o += 4) {
    const x = map[p] / scale, t = ramp === "diverging" ? 0.5 + 0.5 * x : x;
    if (Number.isFinite(x)) {
      const i = 3 * Math.round(rampSize * clamp01(t));
      out[o] = table[i], out[o + 1] = table[i + 1], out[o + 2] = table[i + 2];
    } else {
      out[o] = out[o + 2] = 255;  // not finite: magenta
    }
    out[o + 3] = 255;
  }
  return new ImageData(out, width, height);
}
