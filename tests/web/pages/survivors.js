// SPDX-License-Identifier: Apache-2.0
// What is left of a bake in a file that another tool wrote: what is found in it, and its picture.
import * as three from 'three';
import { SurimiPlugin } from 'surimi-three';
import { brightest, difference } from './images.js';
import { Stage, height, width } from './three_stage.js';

const renderer = new three.WebGLRenderer();

async function read(scene, camera, target) {
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const pixels = new Float32Array(4 * width * height);
  return renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height, pixels);
}

const kit = { three: { ...three, RenderTarget: three.WebGLRenderTarget }, Plugin: SurimiPlugin, read };

/** The largest difference to the picture of `original`, and what the plugin found. */
window.judge = async (file, original) => {
  const [stage, before] = [await new Stage(kit).load(file), await new Stage(kit).load(original)];
  const [image, expected] = [await stage.render(), await before.render()];
  const { bake } = stage;
  const monitors = bake.monitors.map(({ lights }) => [bake.channelOf(lights[0]), lights.length]);
  bake.enabled = false;
  const shadows = difference(image, await stage.render());
  return { monitors, pages: bake.pages.length, shadows, difference: difference(image, expected), brightest: brightest(expected) };
};
