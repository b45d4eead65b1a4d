// SPDX-License-Identifier: Apache-2.0
// The glb of a bake is valid, and map and monitors outlive the tools that people run on glbs.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { after, before, describe, it } from 'node:test';
import validator from 'gltf-validator';
import { launch, open } from './browser.mjs';
import { toolFolder, tools } from './scene/tools.mjs';

const allowed = { copy: 0, optimize: 1e-5, prune: 1e-5, gltfpack: 1e-5 }; // of the brightest; all but copy reorder vertices

describe('a baked glb', () => {
  let browser, page, complaints, folder;
  before(async () => {
    folder = await toolFolder();
    browser = await launch();
    ({ page, complaints } = await open(browser, 'survivors.js', folder));
  });
  after(() => browser?.close());

  for (const name of ['original', ...tools])
    it(`is valid: ${name}`, async () => {
      const bytes = new Uint8Array(readFileSync(path.join(folder, `${name}.glb`)));
      const { issues } = await validator.validateBytes(bytes);
      assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages));
      assert.equal(issues.numWarnings, 0, JSON.stringify(issues.messages));
    });

  for (const name of tools)
    it(`shows the same after ${name}`, async () => {
      const result = await page.evaluate((file) => window.judge(file, '/original.glb'), `/${name}.glb`);
      assert.deepEqual(complaints, []);
      assert.deepEqual(result.monitors, [[0, 1], [1, 2], [2, 1]]);
      assert.equal(result.pages, 1);
      assert.ok(result.shadows > 0.3, `${result.shadows}`);
      assert.ok(result.difference <= allowed[name] * result.brightest, JSON.stringify(result));
    });
});
