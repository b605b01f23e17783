"use strict";
// Pictures out of the page: the reverse of pack() in libs/report/src/packed_image.cpp.

const report = JSON.parse(document.getElementById("data").textContent);

// Decoded pictures by id, the least recently used first; a full HD picture takes 12 MB.
const decoded = new Map();
const mostDecoded = 40;

// 15 bits in every letter from U+3400, most significant first.
function bytesOf(text, count) {
  const bytes = new Uint8Array(count);
  for (let i = 0, at = 0, bits = 0, have = 0; i < text.length; ++i) {
    bits = (bits << 15) | (text.charCodeAt(i) - 0x3400);
    for (have += 15; have >= 8 && at < count; ) bytes[at++] = bits >> (have -= 8);
    bits &= (1 << have) - 1;
  }
  return bytes;
}

async function inflate(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// In place, all modulo 2^16, as Uint16Array does by itself.
function undoDifferences(v, width, height, channels) {
  for (let pixel = 1; pixel < width * height; ++pixel) {
    const before = (pixel % width ? pixel - 1 : pixel - width) * channels;
    for (let c = 0; c < channels; ++c) v[pixel * channels + c] += v[before + c];
  }
  if (channels === 3) {
    for (let i = 0; i < v.length; i += 3) {
      v[i] += v[i + 1];
      v[i + 2] += v[i + 1];
    }
  }
}

async function unpackValues(picture) {
  const planes = await inflate(bytesOf(document.getElementById(picture.id).textContent, picture.bytes));
  const { width, height, channels } = picture;
  const pixels = width * height, count = pixels * channels;
  if (planes.length !== 2 * count) throw new Error(picture.id + ": wrong length");
  const values = new Uint16Array(count);
  for (let c = 0; c < channels; ++c) {
    for (let p = 0, low = c * pixels, i = c; p < pixels; ++p, ++low, i += channels)
      values[i] = planes[low] | (planes[count + low] << 8);
  }
  undoDifferences(values, width, height, channels);
  return values;
}

// { width, height, channels, values } of a cell's picture in a layer, or its map; null when there is none.
function picture(cell, layer, map = "") {
  const entry = cell && cell.pictures.find((p) => p.layer === layer && p.map === map);
  if (!entry) return Promise.resolve(null);
  let promise = decoded.get(entry.id);
  decoded.delete(entry.id);
  if (!promise) promise = unpackValues(entry).then((values) => ({ ...entry, values }));
  decoded.set(entry.id, promise);
  if (decoded.size > mostDecoded) decoded.delete(decoded.keys().next().value);
  return promise;
}
