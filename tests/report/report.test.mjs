// SPDX-License-Identifier: Apache-2.0
// Reports that `surimi bake` and `surimi report` wrote, in headless Chromium, from disk. SURIMI is the program.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { after, before, describe, it } from 'node:test';
import { differenceOf, errorOf, linearCodeOf } from '../../baker/report/page/src/pictures.js';
import { changed, launch, look, open, press, set } from './browser.mjs';
import { hostileName, writeRoom } from './room.mjs';

const program = process.env.SURIMI;
const folder = mkdtempSync(path.join(tmpdir(), 'surimi-report-'));
const run = (...words) => execFileSync(program, words, { cwd: folder, encoding: 'utf8' });
const monitors = ['R', 'G', 'B'];
const rounding = 0.55; // of codes: half, and a little for the shader's floats

const study = {
  reading: 'What it means.', scene: { file: 'room.glb' },
  techniques: [['surimi', 'ours'], ['sampling', 'rays'], ['approximation', 'depth map']].map(([family, label], t) => ({
    id: label, label, family,
    points: [1, 2, 3].map((n) => ({ setting: `n = ${n}`, secondsPerTexel: (t + 1) * 10 ** (n - 6), raysPerTexel: 10 ** n, rmse: 0.1 ** n, p999: 0.1, largest: 0.2 })),
  })),
};

let browser;
before(async () => {
  writeRoom(path.join(folder, 'room.glb'));
  run('bake', 'room.glb', '--size', '64', '--error', '0.02', '--uv-quality', 'draft', '--quiet', '-o', 'out');
  cpSync(path.join(folder, 'out'), path.join(folder, 'reference'), { recursive: true });
  run('bake', 'room.glb', '--size', '64', '--method', 'mc', '--samples', '16', '--uv-quality', 'draft', '--quiet', '--no-report', '-o', 'rough');
  writeFileSync(path.join(folder, 'rough', 'study.json'), JSON.stringify(study));
  run('report', 'rough', '--reference', 'reference/room.lightmaps.exr');
  browser = await launch();
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

const pageOf = (bake, options) => open(browser, path.join(folder, bake, 'room.report.html'), options);

/** Radiance before the filmic curve and the sRGB codes, in units of the exposure. */
function radianceOf(code) {
  const s = code / 255;
  const y = s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4;
  const [a, b, c] = [2.51 - 2.43 * y, 0.03 - 0.59 * y, -0.14 * y];
  return (-b + Math.sqrt(b * b - 4 * a * c)) / (2 * a);
}

function codeOf(x) {
  const y = Math.min(1, (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14));
  return 255 * (y <= 0.0031308 ? 12.92 * y : 1.055 * y ** (1 / 2.4) - 0.055);
}

/** At edges of shapes the samples of a pixel are averaged after the curve, so that nothing adds up there. */
function isSmooth({ width, data }, i) {
  return [-4, 4, -4 * width, 4 * width].every((step) => Math.abs((data[i + step] ?? data[i]) - data[i]) < 8);
}

const panelsOf = (...kinds) => kinds.flatMap((kind) => monitors.map((channel) => `${kind}-${channel}`));

describe('surimi bake', () => {
  it('writes the report unless told otherwise', () => {
    const pages = (...words) => {
      const written = run('bake', 'room.glb', '--size', '32', '--error', '0.1', '--uv-quality', 'draft', '--quiet', '-o', 'again', ...words);
      return written.split('\n').filter((line) => line.endsWith('.html'));
    };
    assert.deepEqual(pages('--no-report'), []);
    assert.deepEqual(pages('--memory', '4096'), []);
    assert.deepEqual(pages(), ['again/room.report.html']);
  });
});

describe('codes', () => {
  it('mean to the page what they mean to the program', async () => {
    const { page } = await pageOf('out');
    const { codes } = await page.evaluate(() => JSON.parse(document.getElementById('data').textContent));
    await page.close();
    const steps = codes.stepsPerOctave;
    assert.deepEqual([0, 1, 2, 2 + steps * codes.errorOctaves].map((code) => errorOf(code, codes)), [null, 0, 2 ** -codes.errorOctaves, 1]);
    assert.deepEqual([0, 128, 129, 128 - 1 - steps * codes.differenceOctaves].map((code) => differenceOf(code, codes)),
      [null, 0, 2 ** -codes.differenceOctaves, -1]);
    assert.deepEqual([0, 1, 128, 255].map((code) => linearCodeOf(code, 1, 3)), [null, 1, 2, 3]);
  });
});

describe('a report opened from disk', () => {
  let page, complaints, first;
  before(async () => {
    ({ page, complaints } = await pageOf('rough'));
    first = await look(page);
  });
  after(() => page.close());

  it('shows every picture', () => {
    assert.deepEqual(Object.keys(first).sort(), ['density', 'map-RGB', 'stretch', 'view',
      ...panelsOf('map', 'error', 'state', 'method', 'difference')].sort());
    for (const [id, { data }] of Object.entries(first)) assert.ok(new Set(data).size > 2, `${id} shows something`);
  });

  it('asks for nothing and complains about nothing', () => {
    assert.deepEqual(complaints, []);
  });

  it('draws its plots', async () => {
    for (const id of ['accuracy', 'histogram-R', 'estimates-G'])
      assert.ok(await page.locator(`#${id} canvas`).count() === 1, id);
  });

  it('reads names as text', async () => {
    assert.equal(await page.evaluate(() => window.hacked), undefined);
    assert.equal(await page.locator('#map figcaption strong').first().textContent(), `R ${hostileName}`);
    assert.equal(await page.locator('img').count(), 0);
  });

  it('reads texels out', async () => {
    await page.locator('#map-R').hover({ position: { x: 40, y: 40 } });
    assert.match(await page.locator('#map .readout').textContent(), /^texel \(\d+, \d+\) · R = /);
  });

  it('fits a phone', async () => {
    for (const width of [320, 390]) {
      await page.setViewportSize({ width, height: 800 });
      await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth); // plots follow a frame later
    }
    await page.setViewportSize({ width: 500, height: 700 });
  });

  it('changes no picture between light and dark', async () => {
    const before = await look(page);
    await page.locator('#theme').click();
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
    assert.deepEqual(changed(before, await look(page)), []);
  });
});

describe('the controls of the map', () => {
  let page, complaints;
  before(async () => ({ page, complaints } = await pageOf('rough')));
  after(() => {
    assert.deepEqual(complaints, []);
    return page.close();
  });

  it('draw outlines over the pictures of the map alone, where charts end', async () => {
    const before = await look(page);
    await press(page, 'map', 'Outlines');
    const after = await look(page);
    const expected = Object.keys(before).filter((id) => id !== 'view').sort();
    assert.deepEqual(changed(before, after), expected);
    const places = ({ data: a }, { data: b }) => a.map((_, i) => Number(a[i] !== b[i])).reduce((sum, n) => sum + n, 0);
    assert.ok(places(before['map-R'], after['map-R']) < before['map-R'].data.length / 2);
    await press(page, 'map', 'Outlines');
    assert.deepEqual(changed(before, await look(page)), []);
  });

  it('show the channels as one colour', async () => {
    assert.ok(await page.locator('#map-R').isVisible() && !(await page.locator('#map-RGB').isVisible()));
    await press(page, 'map', 'R, G, B in one');
    assert.ok(!(await page.locator('#map-R').isVisible()) && await page.locator('#map-RGB').isVisible());
    await press(page, 'map', 'Each in grey');
  });

  it('enlarge', async () => {
    const before = await look(page);
    await press(page, 'map', '4:1');
    assert.equal((await page.locator('#map-R').boundingBox()).width, 256);
    await press(page, 'map', 'Fit');
    assert.deepEqual(changed(before, await look(page)), []);
  });
});

describe('the live view', () => {
  let page, complaints;
  before(async () => ({ page, complaints } = await pageOf('out')));
  after(() => {
    assert.deepEqual(complaints, []);
    return page.close();
  });
  const view = async () => (await look(page)).view;
  const only = async (on) => {
    for (const index of monitors.keys()) {
      const box = page.locator(`#monitor-${index}`);
      await box.setChecked(on === null || on === index);
    }
  };

  it('compares without and with shadows along a border', async () => {
    const both = await view();
    await press(page, 'live', 'With the map');
    const shadowed = await view();
    await press(page, 'live', 'Without');
    const unshadowed = await view();
    await press(page, 'live', 'Both');
    assert.ok(!shadowed.data.equals(unshadowed.data));
    const half = both.width / 2;
    for (let i = 0; i < both.data.length; ++i) {
      const x = (i >> 2) % both.width;
      if (x < half - 1) assert.equal(both.data[i], unshadowed.data[i]);
      if (x > half + 1) assert.equal(both.data[i], shadowed.data[i]);
    }
    await set(page, 'split', 0);
    assert.deepEqual((await view()).data, shadowed.data);
    await set(page, 'split', 1);
    assert.deepEqual((await view()).data, unshadowed.data);
    await set(page, 'split', 0.5);
    assert.deepEqual((await view()).data, both.data);
  });

  it('only ever gets darker by the map', async () => {
    await press(page, 'live', 'Without');
    const unshadowed = await view();
    await press(page, 'live', 'With the map');
    const shadowed = await view();
    let darker = 0;
    for (let i = 0; i < shadowed.data.length; ++i) {
      assert.ok(shadowed.data[i] <= unshadowed.data[i]);
      darker += Number(shadowed.data[i] < unshadowed.data[i] - 20);
    }
    assert.ok(darker > 300);
  });

  it('adds up to what single monitors show', async () => {
    await press(page, 'live', 'With the map');
    await set(page, 'exposure', -1);
    const all = await view();
    const singles = [];
    for (const index of monitors.keys()) {
      await only(index);
      singles.push(await view());
    }
    assert.ok(!singles[0].data.equals(singles[1].data) && !singles[1].data.equals(singles[2].data));
    await only(null);
    assert.deepEqual((await view()).data, all.data);
    await set(page, 'exposure', 0);
    let checked = 0;
    for (let i = 0; i < all.data.length; ++i) {
      if (i % 4 === 3 || all.data[i] > 250 || ![all, ...singles].every((picture) => isSmooth(picture, i))) continue;
      const sum = (off) => singles.reduce((total, { data }) => total + radianceOf(Math.max(0, data[i] + off)), 0);
      const [low, high] = [codeOf(sum(-rounding)) - rounding, codeOf(sum(rounding)) + rounding];
      assert.ok(low <= all.data[i] && all.data[i] <= high, `${all.data[i]} is not in ${low} to ${high} at ${i}`);
      checked += Number(all.data[i] > 10);
    }
    assert.ok(checked > 5000, `${checked}`);
  });

  it('shows monitors that are off as black', async () => {
    await only(3);
    const { data } = await view();
    for (let i = 0; i < data.length; ++i) assert.equal(data[i], i % 4 === 3 ? 255 : 0);
    await only(null);
  });

  const knobs = { 'color-1': ['#ff0000', null], 'intensity-2': [2, 0], exposure: [1.5, 0] };
  for (const [id, [other, own]] of Object.entries(knobs))
    it(`${id} changes the view and nothing else`, async () => {
      const before = await look(page);
      const value = own ?? await page.locator(`#${id}`).inputValue();
      await set(page, id, other);
      assert.deepEqual(changed(before, await look(page)), ['view']);
      await set(page, id, value);
      const now = await look(page);
      const largest = now.view.data.reduce((most, byte, i) => Math.max(most, Math.abs(byte - before.view.data[i])), 0);
      assert.ok(largest <= (own === null ? 3 : 0), `${largest}`); // a colour picker has 8 bits
    });

  it('overrides roughness and gives it back', async () => {
    const before = await look(page);
    await press(page, 'live', 'Roughness as in the scene');
    await set(page, 'roughness', 0.1);
    assert.deepEqual(changed(before, await look(page)), ['view']);
    await set(page, 'roughness', 0.6); // what the room has
    assert.deepEqual(changed(before, await look(page)), []);
    await press(page, 'live', 'Roughness as in the scene');
    assert.deepEqual(changed(before, await look(page)), []);
  });

  it('turns, and goes back', async () => {
    const before = await look(page);
    await page.locator('#view').scrollIntoViewIfNeeded();
    const box = await page.locator('#view').boundingBox();
    await page.mouse.move(box.x + 100, box.y + 100);
    await page.mouse.down();
    await page.mouse.move(box.x + 220, box.y + 130, { steps: 4 });
    await page.mouse.up();
    assert.deepEqual(changed(before, await look(page)), ['view']);
    await page.locator('#reset-view').click();
    assert.deepEqual(changed(before, await look(page)), []);
  });
});

describe('a report of what is left of a bake', () => {
  it('says what is missing, and shows the rest', async () => {
    for (const name of ['room.lightmaps.exr', 'room.baked.glb']) rmSync(path.join(folder, 'reference', name));
    run('report', 'reference');
    const { page, complaints } = await pageOf('reference');
    const seen = await look(page);
    assert.deepEqual(Object.keys(seen).sort(), ['map-RGB', ...panelsOf('map', 'error', 'state', 'method')].sort());
    assert.ok(!(await page.locator('#error-R').isVisible()));
    assert.match(await page.locator('.warnings').textContent(), /room\.lightmaps\.exr is not beside the manifest/);
    assert.match(await page.locator('#live').textContent(), /no live view/);
    assert.deepEqual(complaints, []);
    await page.close();
  });
});
