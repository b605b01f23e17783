// Shows a folder of `ssphh web` in Chromium, uses it as people do, and leaves pictures: node check.mjs PLAYWRIGHT FOLDER OUT WIDTH HEIGHT
// [TIME...]. What is wrong is printed, and the exit code is 1. Pictures: OUT-CAMERA.png, OUT-tTIME.png of the first camera, OUT-page.png,
// OUT-wipe.png, OUT-phone.png.
import { createReadStream, existsSync, readFileSync } from 'node:fs';
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

async function open(options, before) {
  const page = await (await browser.newContext(options)).newPage();
  page.setDefaultTimeout(60000);
  page.on('console', m => expect(!['error', 'warning'].includes(m.type()) || /GPU stall|swiftshader/i.test(m.text()), `console: ${m.text()}`));
  page.on('pageerror', e => expect(false, `script: ${e.message}`));
  page.on('request', r => expect(r.url().startsWith(home) || r.url().startsWith(`blob:${home}`), `a request leaves the host: ${r.url()}`));
  page.on('requestfailed', r => expect(false, `not loaded: ${r.url()}`));
  if (before) await page.addInitScript(before);
  await page.goto(home);
  await page.waitForSelector('body[data-drawn], body[data-failed]');
  return page;
}
const settle = page => page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done)))));
async function picture(page, file) {
  await page.evaluate(() => {
    document.activeElement?.blur();  // no ring around it
    document.getElementById('panel').hidden = true;
  });
  await settle(page);
  const shot = await page.screenshot(file ? { path: `${out}-${file}.png` } : {});
  await page.evaluate(() => { document.getElementById('panel').hidden = false; });
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
await page.keyboard.press('h');
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
