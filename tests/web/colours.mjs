// Mean colours of a picture about places: node colours.mjs PLAYWRIGHT PICTURE X,Y..., in shares of its width and height. Prints "R G B" (0 to 255), a line for each.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [playwright, picture, ...places] = process.argv.slice(2);
const { chromium } = (await import(pathToFileURL(join(playwright, 'index.js')))).default;
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox'] });
const page = await browser.newPage();
const found = await page.evaluate(async ([png, at]) => {
  const image = new Image(), canvas = document.createElement('canvas'), side = 9;
  image.src = `data:image/png;base64,${png}`;
  await image.decode();
  canvas.width = image.width, canvas.height = image.height;
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  return at.map(([x, y]) => {
    const { data } = context.getImageData(Math.round(x * image.width) - side / 2, Math.round(y * image.height) - side / 2, side, side);
    return [0, 1, 2].map(c => Math.round(data.reduce((sum, value, i) => sum + (i % 4 === c ? value : 0), 0) / side / side)).join(' ');
  });
}, [readFileSync(picture).toString('base64'), places.map(place => place.split(',').map(Number))]);
console.log(found.join('\n'));
await browser.close();
