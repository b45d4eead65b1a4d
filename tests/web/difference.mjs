// SPDX-License-Identifier: Apache-2.0
// Measures how far surimi-three is from `surimi preview --model three` on a baked glb, and writes both pictures.
//   SURIMI=surimi node difference.mjs BAKED.glb LTC_TEXTURES_OUTPUT FOLDER
import { copyFileSync, mkdirSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import process from 'node:process';
import { launch, open } from './browser.mjs';
import { preview } from './scene/preview.mjs';

const [glb, table, folder] = process.argv.slice(2);
if (folder === undefined) {
  console.error('usage: SURIMI=surimi node difference.mjs BAKED.glb LTC_TEXTURES_OUTPUT FOLDER');
  process.exit(2);
}
mkdirSync(folder, { recursive: true });
copyFileSync(glb, path.join(folder, 'room.glb'));
copyFileSync(table, path.join(folder, 'ltc.bin'));
preview(folder, 'room.glb', 'room.exr', 480, 270);

const common = { glb: '/room.glb', picture: '/room.exr' };
const ways = {
  'as users see it': common,
  'with our table': { ...common, table: '/ltc.bin' },
  'without mipmaps and widened highlights': { ...common, table: '/ltc.bin', plain: true },
  'and on a grid 9 times finer': { ...common, table: '/ltc.bin', plain: true, finer: 9 },
};
const browser = await launch();
console.log('| three.js | pixels | RMS | 99.9 % | largest | where |\n|---|--:|--:|--:|--:|---|');
for (const [name, options] of Object.entries(ways)) {
  const { page } = await open(browser, 'compare.js', folder);
  page.setDefaultTimeout(0);
  const { pixels, rms, most, largest, worst, pictures } = await page.evaluate((asked) => window.compare(asked), options);
  const row = [name, pixels, ...[rms, most, largest].map((value) => value.toFixed(5)), `${worst[0].of} (${worst[0].at})`];
  console.log(`| ${row.join(' | ')} |`);
  for (const [kind, url] of Object.entries(pictures))
    writeFileSync(path.join(folder, `${name.replaceAll(' ', '-')}.${kind}.png`), Buffer.from(url.split(',')[1], 'base64'));
  await page.close();
}
await browser.close();
