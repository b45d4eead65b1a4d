// SPDX-License-Identifier: Apache-2.0
// The cases on WebGLRenderer.
import * as three from 'three';
import { SurimiPlugin, loadExrMap } from 'surimi-three';
import { cases } from './three_cases.js';
import { height, width } from './three_stage.js';

const renderer = new three.WebGLRenderer();
renderer.setSize(width, height, false);

async function read(scene, camera, target) {
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  renderer.setRenderTarget(null);
  const pixels = new Float32Array(4 * width * height);
  await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height, pixels);
  return pixels;
}

const kit = { three: { ...three, RenderTarget: three.WebGLRenderTarget }, Plugin: SurimiPlugin, loadExrMap, read };
window.runCase = (name) => cases[name](kit);
