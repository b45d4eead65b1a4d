// SPDX-License-Identifier: Apache-2.0
// surimi-three in headless Chromium, on WebGLRenderer and on WebGPURenderer.
import assert from 'node:assert/strict';
import { after, before, describe, it } from 'node:test';
import { launch, open } from './browser.mjs';
import { bakedFolder } from './scene/bakes.mjs';

const rounding = 2e-6; // of floats, at radiances of some nits

for (const [name, script] of Object.entries({ WebGLRenderer: 'three_webgl.js', WebGPURenderer: 'three_tsl.js' })) {
  describe(name, () => {
    let browser, page, complaints;
    before(async () => {
      browser = await launch();
      ({ page, complaints } = await open(browser, script, await bakedFolder()));
    });
    after(() => browser?.close());
    const run = async (name) => {
      const result = await page.evaluate((which) => window.runCase(which), name);
      assert.deepEqual(complaints, []);
      return result;
    };

    it('finds monitors, their panels and channels', async () => {
      const { monitors, pages } = await run('found');
      assert.deepEqual(monitors, [
        { name: 'Monitor_R', channel: 0, sizes: [[1, 1.6]] },
        { name: 'Monitor_G', channel: 1, sizes: [[1, 1], [1, 1]] },
        { name: 'Monitor_B', channel: 2, sizes: [[0.8, 1.4]] },
      ]);
      assert.equal(pages, 1);
    });

    it('changes nothing with a white map', async () => {
      const { difference, brightest } = await run('whiteMap');
      assert.equal(difference, 0);
      assert.ok(brightest > 0.5);
    });

    it('shows one monitor with a map of one channel', async () => {
      assert.deepEqual((await run('oneChannel')).differences, [0, 0, 0]);
    });

    it('multiplies each light with its channel, diffuse and specular', async () => {
      const { differences, sum, shadows } = await run('singleLights');
      for (const difference of differences) assert.ok(difference < rounding, `${differences}`);
      assert.ok(sum < rounding, `${sum}`);
      assert.ok(shadows > 0.3);
    });

    it('keeps channels when a light is hidden', async () => {
      assert.equal((await run('hiddenLight')).difference, 0);
      assert.equal((await run('lightOnOtherLayer')).difference, 0);
    });

    it('keeps channels when the order of lights changes', async () => {
      assert.ok((await run('changedOrder')).difference < rounding);
    });

    it('leaves lights without a channel alone', async () => {
      const { difference, brightest } = await run('unchartedLight');
      assert.ok(difference < rounding, `${difference}`);
      assert.ok(brightest > 0.3);
    });

    it('notices another map', async () => {
      const { half, swapped, again } = await run('swappedMap');
      assert.ok(half < rounding);
      assert.ok(swapped > 0.1);
      assert.equal(again, 0);
    });

    it('can be switched off and on', async () => {
      const { off, on } = await run('switchedOff');
      assert.equal(off, 0);
      assert.equal(on, 0);
    });

    it('follows the radiance of a monitor', async () => {
      const { brighter, shown } = await run('changedRadiance');
      assert.ok(brighter < rounding, `${brighter}`);
      assert.deepEqual(shown[0], [0, 0, 0]);
      assert.deepEqual(shown[1], [0, 0, 1]);
      assert.ok(shown[2][0] > 0.9, 'another monitor of the same material keeps its colour');
    });

    it('lights a monitor by others, not by itself', async () => {
      const { own, other } = await run('ownMonitor');
      assert.equal(own, 0);
      assert.ok(other > 0.05, `${other}`);
    });

    it('gives everything back when disposed of', async () => {
      const { dark, difference } = await run('disposed');
      assert.equal(dark, 0);
      assert.equal(difference, 0);
    });

    it('shows each page on its own surfaces', async () => {
      const { pages, shadows, parts } = await run('twoPages');
      assert.deepEqual(pages, [0, 1]);
      assert.ok(shadows > 0.3);
      assert.ok(parts < rounding);
    });

    it('shows the map in half floats', async () => {
      const { difference, brightest } = await run('halfFloatMap');
      assert.ok(difference > 0 && difference < 0.01 * brightest, `${difference} of ${brightest}`);
    });
  });
}
