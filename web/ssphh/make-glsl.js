// Writes src/three/lookup.glsl.ts: the lookup in GLSL as libs/runtime has it for all shaders. node make-glsl.js [FOLDER OF SHADERS]
import { readFileSync, writeFileSync } from 'node:fs';

const shaders = process.argv[2] ?? new URL('../../libs/runtime/shaders', import.meta.url).pathname;
const text = ['sections', 'points', 'probes', 'lookup'].map(part => readFileSync(`${shaders}/${part}.glsl`, 'utf8')).join('');
if (/[`\\]|\$\{/.test(text)) throw new Error('the shaders hold a character that has a meaning in a template');
writeFileSync(new URL('src/three/lookup.glsl.ts', import.meta.url),
  `/** Made by make-glsl.js of libs/runtime/shaders. */\nexport const lookupGlsl = /* glsl */ \`${text}\`;\n`);
