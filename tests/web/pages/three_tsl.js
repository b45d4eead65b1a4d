// SPDX-License-Identifier: Apache-2.0
// The cases on WebGPURenderer with its WebGL2 backend.
import * as three from 'three/webgpu';
import { SurimiPlugin, loadExrMap } from 'surimi-three/tsl';
import { cases } from './three_cases.js';
import { height, width } from './three_stage.js';

const renderer = new three.WebGPURenderer({ forceWebGL: true });
renderer.setSize(width, height, false);
const ready = renderer.init();

async function read(scene, camera, target) {
  await ready;
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  renderer.setRenderTarget(null);
  return renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height);
}

const kit = { three, Plugin: SurimiPlugin, loadExrMap, read };
window.runCase = (name) => cases[name](kit);
