// SPDX-License-Identifier: Apache-2.0
// The picture of surimi-three against that of `surimi preview --model three`, pixel by pixel.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { after, before, describe, it } from 'node:test';
import { launch, open } from './browser.mjs';
import { asHalves } from './ltc_halves.mjs';
import { bakedFolder } from './scene/bakes.mjs';
import { preview } from './scene/preview.mjs';

describe('three.js and preview --model three', () => {
  let browser, folder;
  before(async () => {
    folder = await bakedFolder();
    browser = await launch();
  });
  after(() => browser?.close());
  const compare = async (options) => {
    const { page, complaints } = await open(browser, 'compare.js', folder);
    const result = await page.evaluate((asked) => window.compare(asked), options);
    assert.deepEqual(complaints, []);
    await page.close();
    return result;
  };
  const glb = '/one/room.baked.glb';

  it('agree within surfaces, but for the rounding of pixels', async () => {
    preview(folder, glb, 'compared.exr', 120, 80);
    const plain = { glb, picture: '/compared.exr', table: '/ltc.bin', plain: true };
    const { pixels, rms, most, largest, worst } = await compare({ ...plain, finer: 27 });
    assert.ok(pixels > 5000);
    assert.ok(rms < 5e-4, `${rms}`);
    assert.ok(most < 3e-3, `${most}`);
    assert.ok(largest < 2e-2, JSON.stringify(worst[0]));
  });

  it('differ by the fit of the lobes with the table that three.js has', async () => {
    preview(folder, glb, 'compared.exr', 120, 80);
    const { rms } = await compare({ glb, picture: '/compared.exr', plain: true, finer: 9 });
    assert.ok(rms > 5e-4 && rms < 3e-2, `${rms}`);
  });

  it('Babylon.js gets the table that preview has', () => {
    const here = path.dirname(fileURLToPath(import.meta.url));
    const shipped = readFileSync(path.join(here, '../../samples/web/surimi-babylon/areaLightsLTC.bin'));
    assert.ok(asHalves(readFileSync(path.join(folder, 'ltc.bin'))).equals(shipped));
  });
});
