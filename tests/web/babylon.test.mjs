// SPDX-License-Identifier: Apache-2.0
// surimi-babylon in headless Chromium.
import assert from 'node:assert/strict';
import { after, before, describe, it } from 'node:test';
import { launch, open } from './browser.mjs';
import { bakedFolder } from './scene/bakes.mjs';

const rounding = 5e-6; // of floats, at radiances of some nits

describe('Babylon.js', () => {
  let browser, page, complaints;
  before(async () => {
    browser = await launch();
    ({ page, complaints } = await open(browser, 'babylon.js', await bakedFolder()));
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

  it('changes nothing diffuse with a white map', async () => {
    const { difference, brightest } = await run('whiteMap');
    assert.equal(difference, 0);
    assert.ok(brightest > 0.5);
  });

  it('shows one monitor with a map of one channel', async () => {
    assert.deepEqual((await run('oneChannel')).differences, [0, 0, 0]);
  });

  it('adds up single lights, and nothing is below 0', async () => {
    const { sum, shadows, least } = await run('singleLights');
    assert.ok(sum < rounding, `${sum}`);
    assert.ok(shadows > 0.3);
    assert.ok(least >= 0);
  });

  it('keeps channels when a light is hidden', async () => {
    assert.equal((await run('hiddenLight')).difference, 0);
  });

  it('keeps channels when the order of lights changes', async () => {
    assert.ok((await run('changedOrder')).difference < rounding);
  });

  it('leaves lights without a channel alone', async () => {
    const { difference, brightest } = await run('unchartedLight');
    assert.ok(difference < rounding, `${difference}`);
    assert.ok(brightest > 0.05, `${brightest}`);
  });

  it('notices another map', async () => {
    const { half, swapped, again } = await run('swappedMap');
    assert.ok(half < rounding);
    assert.ok(swapped > 0.1);
    assert.equal(again, 0);
  });

  it('follows the radiance of a monitor', async () => {
    assert.ok((await run('changedRadiance')).difference < rounding);
  });

  it('lights a monitor by others, not by itself', async () => {
    const { own, other } = await run('ownMonitor');
    assert.equal(own, 0);
    assert.ok(other > 0.05, `${other}`);
  });

  it('shows each page on its own surfaces', async () => {
    const { pages, parts } = await run('twoPages');
    assert.deepEqual(pages, [0, 1]);
    assert.ok(parts < rounding);
  });

  it('takes its lights out of the scene when disposed of', async () => {
    assert.deepEqual(await run('disposed'), { dark: 0, lights: 0 });
  });
});
