// Shows a folder of `ssphh web` in Chromium, uses it as people do, and leaves pictures: node check.mjs PLAYWRIGHT FOLDER OUT WIDTH HEIGHT
// [TIME...]. What is wrong is printed, and the exit code is 1. Pictures: OUT-CAMERA.png, OUT-tTIME.png of the first camera, OUT-page.png,
// OUT-wipe.png, OUT-phone.png; with a lamp that can be dragged OUT-lamp.png, whose camera and place OUT-lamp.json holds.
import { createReadStream, existsSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { join, extname } from 'node:path';
import { pathToFileURL } from 'node:url';

const [playwright, folder, out, width, height, ...times] = process.argv.slice(2);
const { chromium } = (await import(pathToFileURL(join(playwright, 'index.js')))).default;
const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.json': 'application/json', '.svg': 'image/svg+xml',
  '.png': 'image/png', '.glb': 'model/gltf-binary' };
const server = createServer((request, answer) => {
  const file = join(folder, decodeURIComponent(new URL(request.url, 'http://host').pathname).replace(/\/$/, '/index.html'));
  if (!existsSync(file)) return answer.writeHead(404).end();
  answer.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
  createReadStream(file).pipe(answer);
});
await new Promise(ready => server.listen(0, '127.0.0.1', ready));
const home = `http://127.0.0.1:${server.address().port}/`, manifest = JSON.parse(readFileSync(join(folder, 'scene.json')));
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
let faults = 0, checks = 0;
const expect = (is, what) => {
  ++checks;
  if (is) return;
  ++faults;
  console.log(`WRONG: ${what}`);
};

async function open(options, before, address = '') {
  const page = await (await browser.newContext(options)).newPage();
  page.setDefaultTimeout(60000);
  page.on('console', m => expect(!['error', 'warning'].includes(m.type()) || /GPU stall|swiftshader/i.test(m.text()), `console: ${m.text()}`));
  page.on('pageerror', e => expect(false, `script: ${e.message}`));
  page.on('request', r => expect(r.url().startsWith(home) || r.url().startsWith(`blob:${home}`), `a request leaves the host: ${r.url()}`));
  page.on('requestfailed', r => expect(false, `not loaded: ${r.url()}`));
  if (before) await page.addInitScript(before);
  await page.goto(home + address);
  await page.waitForSelector('body[data-drawn], body[data-failed]');
  return page;
}
const settle = page => page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));
async function picture(page, file) {
  await page.evaluate(() => {
    document.activeElement?.blur();  // no ring around it
    document.getElementById('panel').hidden = document.getElementById('handles').hidden = true;
  });
  await settle(page);
  const shot = await page.screenshot(file ? { path: `${out}-${file}.png` } : {});
  await page.evaluate(() => { document.getElementById('panel').hidden = document.getElementById('handles').hidden = false; });
  return shot;
}
const slide = (page, selector, value) => page.evaluate(([s, v]) => {
  const input = document.querySelector(s);
  input.value = v;
  input.dispatchEvent(new Event('input'));
}, [selector, String(value)]);

const page = await open({ viewport: { width: Number(width), height: Number(height) } });
expect(await page.isHidden('#message'), `the page says: ${await page.textContent('#message')}`);
for (const [i, camera] of manifest.cameras.entries()) {
  if (i >= 9) break;  // there are no more digits
  await page.keyboard.press(String(i + 1));
  await picture(page, camera.name.replace(/[^A-Za-z0-9-]/g, '-'));
}
await page.keyboard.press('1');
const first = await picture(page);

await page.keyboard.press('?');
expect(await page.isVisible('#help'), '? shows no keys');
await page.keyboard.press('Escape');
expect(await page.isHidden('#help'), 'Escape leaves the keys');
await page.focus('#view');
await page.keyboard.down('w');
await page.waitForTimeout(300);
await page.keyboard.up('w');
expect(!first.equals(await picture(page)), 'W does not walk');
await page.keyboard.press('r');
expect(first.equals(await picture(page)), 'R does not lead back');
await page.mouse.move(width / 3, height / 2);
await page.mouse.down();
await page.mouse.move(width / 3 + 40, height / 2 + 10, { steps: 3 });
await page.mouse.up();
expect(!first.equals(await picture(page)), 'dragging does not turn');
await page.keyboard.press('r');
await page.keyboard.press(']');
expect(!first.equals(await picture(page)), '] does not expose more');
await page.keyboard.press('r');
for (const group of manifest.lightmap.groups) {
  const lamp = `input[type=range][data-group=${JSON.stringify(group.name)}]`;
  await slide(page, lamp, 0);
  expect(await page.$eval(lamp, e => e.value) === '0', `${group.name} has no slider`);
}
const dark = await picture(page);
expect(dark.length < first.length / 2, 'without lamps it is not dark');
await page.keyboard.press('r');
expect(first.equals(await picture(page)), 'R does not light lamps again');
for (const time of times) {
  await slide(page, '#time', time);
  await picture(page, `t${time}`);
}
await page.keyboard.press('r');
await page.setViewportSize({ width: 960, height: 540 });  // wide enough for all controls
const unfolded = () => page.getAttribute('#fold', 'aria-expanded');
const atFirst = await unfolded();  // on a small screen they are away
await page.keyboard.press('h');
expect(await unfolded() !== atFirst, 'H takes no controls away and brings none');
if (await unfolded() === 'false') await page.keyboard.press('h');
await page.evaluate(() => document.activeElement?.blur());
await settle(page);
await page.screenshot({ path: `${out}-page.png` });
const stops = new Set();
for (let i = 0; i < 12; ++i) {
  await page.keyboard.press('Tab');
  stops.add(await page.evaluate(() => document.activeElement?.id ?? ''));
}
for (const id of ['camera', 'exposure', 'fold', 'help-button']) expect(stops.has(id), `Tab does not reach ${id}`);
if (manifest.cameras[0].truth) {
  await page.keyboard.press('t');
  await page.waitForFunction(() => document.getElementById('truth').naturalWidth > 0);
  expect(await page.isVisible('#truth'), 'T shows no truth');
  await slide(page, '#wipe-at', 0);
  const all = await picture(page);
  await slide(page, '#wipe-at', 50);
  const half = await picture(page, 'wipe');
  expect(!half.equals(all), 'the wipe does not wipe');
  await page.keyboard.press('t');
}

/** A place where the lamp may be, and the first camera that sees it within the middle of its picture. */
function seenPlace({ lattice }) {
  const boxes = readFileSync(join(folder, lattice.boxes)), [across, up] = lattice.planes.map(planes => planes.at(-1));
  for (const [camera, { world: w, yfov }] of manifest.cameras.entries()) {
    for (const [i, seen] of boxes.entries()) {
      if (!seen) continue;
      const at = [i % across, Math.floor(i / across) % up, Math.floor(i / across / up)].map((b, k) => lattice.origin[k] + lattice.box * (b + 0.6));
      const way = at.map((x, k) => x - w[12 + k]), along = column => way.reduce((sum, x, k) => sum + x * w[4 * column + k], 0);
      const ahead = -along(2), half = ahead * Math.tan(yfov / 2);
      if (ahead > 1 && Math.abs(along(0)) < 0.2 * half && Math.abs(along(1)) < 0.5 * half) return { camera, at };
    }
  }
  return undefined;
}

const lamp = manifest.movable?.lamps[0], placed = lamp && seenPlace(lamp);
if (placed) {
  const name = encodeURIComponent(lamp.name), dragged = await open({ viewport: { width: Number(width), height: Number(height) } });
  const placeNow = async () => new URLSearchParams(new URL(dragged.url()).hash.slice(1)).get(lamp.name)?.split(',').map(Number);
  const ready = () => dragged.waitForFunction(() => document.getElementById('message').hidden);
  await dragged.keyboard.press(String(placed.camera + 1));
  const before = await picture(dragged);
  await dragged.evaluate(address => { location.hash = address; }, `${name}=${placed.at.join(',')}`);
  await dragged.waitForTimeout(500);
  await ready();
  const moved = await picture(dragged, 'lamp'), start = await placeNow();
  const rings = await dragged.$$eval('.handle:not([hidden])', all => all.map(ring => ring.dataset.lamp));
  expect(rings.includes(lamp.name), 'a lamp in the picture has no ring');
  expect(!moved.equals(before), 'the address moves no lamp');
  writeFileSync(`${out}-lamp.json`, JSON.stringify({ name: lamp.name, camera: manifest.cameras[placed.camera], at: start }));
  const handle = dragged.locator(`.handle[data-lamp=${JSON.stringify(lamp.name)}]`), box = await handle.boundingBox();
  const drag = async (x, y) => {
    const from = await handle.boundingBox();
    await dragged.mouse.move(from.x + from.width / 2, from.y + from.height / 2);
    await dragged.mouse.down();
    await dragged.mouse.move(from.x + from.width / 2 + x, from.y + from.height / 2 + y, { steps: 4 });
    await dragged.mouse.up();
    await settle(dragged);
  };
  await drag(20, 10);
  const there = await placeNow(), follows = await handle.boundingBox();
  expect(there.some((x, k) => Math.abs(x - start[k]) > 0.01), 'a mouse drags no lamp');
  expect(Math.hypot(follows.x - box.x, follows.y - box.y) < 24, 'a lamp does not follow the mouse');
  expect(!moved.equals(await picture(dragged)), 'a lamp that is dragged changes no light');
  await drag(5000, 0);
  const { lattice } = lamp, inside = (await placeNow()).every((x, k) => x >= lattice.origin[k] - 1e-3 && x <= lattice.origin[k] + lattice.box * lattice.planes[k].at(-1) + 1e-3);
  expect(inside, 'a lamp is dragged out of its room');
  await dragged.evaluate(address => { location.hash = address; }, `${name}=${placed.at.join(',')}`);
  await dragged.waitForTimeout(200);
  expect(moved.equals(await picture(dragged)), 'the same place does not give the same picture');
  const moves = [];
  for (const key of ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'PageUp', 'PageDown', 'Shift+ArrowLeft']) {
    const last = await placeNow();
    await handle.focus();
    await dragged.keyboard.press(key);
    await settle(dragged);
    moves.push(Math.hypot(...(await placeNow()).map((x, k) => x - last[k])));
  }
  expect(moves.filter(x => x > 0.05).length >= 3 && moves.every(x => x < 0.102), `keys move a lamp by ${moves.map(x => x.toFixed(3))} m`);
  expect(moves.at(-1) < 0.03, 'Shift does not move it by less');
  await dragged.keyboard.press('r');
  expect(before.equals(await picture(dragged)) && (await placeNow()) === undefined, 'R does not put the lamp back');
  const touched = await open({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 1 }, undefined, `#${name}=${placed.at.join(',')}`);
  await touched.waitForFunction(() => document.getElementById('message').hidden && location.hash.length > 1);
  expect((await touched.locator('.handle:not([hidden])').count()) > 0 || placed.camera > 0, 'a phone shows no ring');
}

const phone = await open({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true, deviceScaleFactor: 1 });
await phone.tap('#fold');
for (const id of ['camera', 'exposure', 'reset']) {
  const box = await (await phone.$(`#${id}`)).boundingBox();
  expect(box && box.x >= 0 && box.x + box.width <= 390, `${id} is not on a phone's screen`);
}
await settle(phone);
await phone.screenshot({ path: `${out}-phone.png` });

const old = await open({}, () => { HTMLCanvasElement.prototype.getContext = () => null; });
expect(/WebGL 2/.test(await old.textContent('#message')), 'without WebGL 2 the page does not say so');

await browser.close();
server.close();
console.log(`${checks} checks, ${faults} wrong`);
process.exit(faults ? 1 : 0);
