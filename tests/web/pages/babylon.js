// SPDX-License-Identifier: Apache-2.0
// What a map does to the picture of Babylon.js, case by case. Each case returns numbers to be judged.
import { RectAreaLight } from '@babylonjs/core/Lights/rectAreaLight.js';
import { Color3 } from '@babylonjs/core/Maths/math.color.js';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Stage } from './babylon_stage.js';
import { brightest, difference, product, sum } from './images.js';

const file = '/one/room.baked.glb';
const channels = [0, 1, 2];

/** The room without its screens, which show their own light. */
async function litRoom(name = file) {
  const stage = await new Stage().load(name);
  for (const mesh of stage.screens()) mesh.isVisible = false;
  return stage;
}

const cases = {
  async found() {
    const { bake } = await new Stage().load(file);
    const monitors = bake.monitors.map(({ name, lights }) => ({
      name,
      channel: bake.channelOf(lights[0]),
      sizes: lights.map((light) => [light.width, light.height].map((side) => Number(side.toFixed(4))).sort()),
    }));
    return { monitors, pages: bake.pages.length };
  },

  async whiteMap() {
    const stage = await litRoom();
    for (const light of stage.bake.lights) light.specular = Color3.Black();
    stage.setMaps(stage.plainMap(1, 1, 1));
    const image = await stage.render();
    stage.useStock();
    return { difference: difference(image, await stage.render()), brightest: brightest(image) };
  },

  async oneChannel() {
    const stage = await litRoom();
    const differences = [];
    for (const channel of channels) {
      stage.setMaps(stage.plainMap(...channels.map((c) => Number(c === channel))));
      const image = await stage.render();
      stage.setMaps(stage.plainMap(1, 1, 1));
      differences.push(difference(image, await stage.renderOnly(channel)));
    }
    return { differences };
  },

  async singleLights() {
    const stage = await litRoom();
    const images = [];
    for (const channel of channels) images.push(await stage.renderOnly(channel));
    const all = await stage.render();
    stage.bake.enabled = false;
    return { sum: difference(all, sum(images)), shadows: difference(all, await stage.render()), least: Math.min(...all) };
  },

  async hiddenLight() {
    const stage = await litRoom();
    const { lights } = stage.bake;
    const { intensity } = lights[0];
    lights[0].intensity = 0;
    const without = await stage.render();
    lights[0].intensity = intensity;
    lights[0].setEnabled(false);
    return { difference: difference(await stage.render(), without) };
  },

  async changedOrder() {
    const stage = await litRoom();
    const before = await stage.render();
    stage.bake.lights.at(-1).renderPriority = 5;
    stage.scene.lights.reverse();
    for (const mesh of stage.meshes) mesh._resyncLightSources();
    return { difference: difference(await stage.render(), before) };
  },

  async unchartedLight() {
    const stage = await litRoom();
    const lamp = new RectAreaLight('lamp', new Vector3(0, 2, 4), 1, 0.5, stage.scene);
    lamp.specular = Color3.Black();
    lamp.intensity = 40;
    stage.setMaps(stage.plainMap(0, 0, 0));
    const image = await stage.render();
    for (const light of stage.bake.lights) light.setEnabled(false);
    stage.useStock();
    return { difference: difference(image, await stage.render()), brightest: brightest(image) };
  },

  async swappedMap() {
    const stage = await litRoom();
    const own = stage.bake.pages[0].texture;
    const before = await stage.render();
    stage.setMaps(stage.plainMap(0.5, 0.5, 0.5));
    const half = await stage.render();
    stage.setMaps(own);
    const again = await stage.render();
    stage.bake.enabled = false;
    const without = await stage.render();
    return { half: difference(half, product(without, 0.5)), swapped: difference(half, before), again: difference(again, before) };
  },

  async changedRadiance() {
    const stage = await litRoom();
    const before = await stage.render();
    for (const monitor of stage.bake.monitors) monitor.setRadiance(monitor.color, 2 * monitor.intensity);
    return { difference: difference(await stage.render(), product(before, 2)) };
  },

  async ownMonitor() {
    const stage = await new Stage().load(file);
    for (const mesh of stage.meshes) mesh.isVisible = mesh.name.startsWith('Monitor');
    for (const { material } of stage.screens()) {
      material.albedoColor = Color3.White();
      material.emissiveIntensity = 0;
    }
    const [first, second, third] = stage.bake.monitors;
    second.node.setEnabled(false);
    third.node.setEnabled(false);
    const own = brightest(await stage.render());
    third.node.setEnabled(true);
    return { own, other: brightest(await stage.render()), kept: first.lights.length };
  },

  async twoPages() {
    const stage = await litRoom('/two/room.baked.glb');
    stage.bake.enabled = false;
    const unshadowed = await stage.render();
    stage.bake.enabled = true;
    const [black, white] = [stage.plainMap(0, 0, 0), stage.plainMap(1, 1, 1)];
    const parts = [];
    for (const dark of [0, 1]) {
      for (const page of stage.bake.pages) stage.bake.setMap(page.number === dark ? black : white, page.number);
      parts.push(await stage.render());
    }
    return { pages: stage.bake.pages.map((page) => page.number).sort(), parts: difference(sum(parts), unshadowed) };
  },

  async disposed() {
    const stage = await litRoom();
    await stage.render();
    stage.bake.dispose();
    return { dark: brightest(await stage.render()), lights: stage.scene.lights.length };
  },
};

window.runCase = (name) => cases[name]();
