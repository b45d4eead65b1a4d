// SPDX-License-Identifier: Apache-2.0
// What a map does to the picture, case by case, for both of three's renderers. Each case returns numbers to be judged.
import { brightest, difference, grey, product, sum } from './images.js';
import { Stage } from './three_stage.js';

const file = '/one/room.baked.glb';
const channels = [0, 1, 2];

/** The baked room with the plugin, and the same room and lights without it. */
async function pair(kit) {
  const stage = await new Stage(kit).load(file);
  const stock = new Stage(kit);
  const lights = await stock.loadStock(file, stage);
  const channelOf = (light) => stage.bake.channelOf(stage.bake.lights[lights.indexOf(light)]);
  return { stage, bake: stage.bake, stock, lights, channelOf };
}

const onlyOf = (stage) => (channel) =>
  stage.renderOnly(stage.bake.lights, (light) => stage.bake.channelOf(light), channel);

export const cases = {
  async found(kit) {
    const { bake } = await new Stage(kit).load(file);
    const monitors = bake.monitors.map(({ name, lights }) => ({
      name,
      channel: bake.channelOf(lights[0]),
      sizes: lights.map((light) => [light.width, light.height].map((side) => Number(side.toFixed(4))).sort()),
    }));
    return { monitors, pages: bake.pages.length };
  },

  async whiteMap(kit) {
    const { stage, stock } = await pair(kit);
    stage.setMaps(stage.plainMap(1, 1, 1));
    const image = await stage.render();
    return { difference: difference(image, await stock.render()), brightest: brightest(image) };
  },

  async oneChannel(kit) {
    const { stage, stock, lights, channelOf } = await pair(kit);
    const differences = [];
    for (const channel of channels) {
      stage.setMaps(stage.plainMap(...channels.map((c) => Number(c === channel))));
      differences.push(difference(await stage.render(), await stock.renderOnly(lights, channelOf, channel)));
    }
    return { differences };
  },

  async singleLights(kit) {
    const { stage, stock, lights, channelOf } = await pair(kit);
    const visibility = await visibilityImage(kit, stage);
    const shadowed = [];
    const differences = [];
    for (const channel of channels) {
      const stockImage = await stock.renderOnly(lights, channelOf, channel);
      shadowed.push(await onlyOf(stage)(channel));
      differences.push(difference(shadowed[channel], product(stockImage, grey(visibility, channel))));
    }
    const all = await stage.render();
    return { differences, sum: difference(all, sum(shadowed)), shadows: difference(all, await stock.render()) };
  },

  async hiddenLight(kit) {
    const { bake, ...stages } = await pair(kit);
    const without = await stages.stage.renderOnly(bake.lights, (light) => Number(light !== bake.lights[0]), 1);
    bake.lights[0].visible = false;
    return { difference: difference(await stages.stage.render(), without) };
  },

  async lightOnOtherLayer(kit) {
    const { stage, bake } = await pair(kit);
    const without = await stage.renderOnly(bake.lights, (light) => Number(light !== bake.lights[0]), 1);
    bake.lights[0].layers.set(5);
    return { difference: difference(await stage.render(), without) };
  },

  async changedOrder(kit) {
    const { stage, bake } = await pair(kit);
    const before = await stage.render();
    const [first] = bake.monitors;
    first.node.parent.add(first.node); // to the end of the list
    bake.lights.at(-1).castShadow = true; // which three sorts to the front
    return { difference: difference(await stage.render(), before) };
  },

  async unchartedLight(kit) {
    const { stage, stock, lights } = await pair(kit);
    for (const [at, { scene }] of [stage, stock].entries()) {
      const lamp = new kit.three.RectAreaLight(0xffffff, 3, 1, 0.5);
      lamp.position.set(0, 2.4, 1);
      lamp.lookAt(0, 0, 1);
      at === 0 ? scene.children.unshift(lamp) : scene.add(lamp);
    }
    stage.setMaps(stage.plainMap(0, 0, 0));
    const image = await stage.render();
    for (const light of lights) light.intensity = 0;
    return { difference: difference(image, await stock.render()), brightest: brightest(image) };
  },

  async swappedMap(kit) {
    const { stage, bake } = await pair(kit);
    const own = bake.pages[0].texture;
    const before = await stage.render();
    stage.setMaps(stage.plainMap(0.5, 0.5, 0.5));
    const half = await stage.render();
    stage.setMaps(own);
    const again = await stage.render();
    bake.enabled = false;
    const without = await stage.render();
    return {
      half: difference(half, product(without, 0.5)),
      swapped: difference(half, before),
      again: difference(again, before),
    };
  },

  async switchedOff(kit) {
    const { stage, bake, stock } = await pair(kit);
    const shadowed = await stage.render();
    bake.enabled = false;
    const off = difference(await stage.render(), await stock.render());
    bake.enabled = true;
    return { off, on: difference(await stage.render(), shadowed) };
  },

  async changedRadiance(kit) {
    const { stage, bake } = await pair(kit);
    const before = await stage.render();
    for (const monitor of bake.monitors) monitor.setRadiance(monitor.color, 2 * monitor.intensity);
    const brighter = difference(await stage.render(), product(before, 2));
    const [red, green] = bake.monitors;
    red.setRadiance(new kit.three.Color(0, 0, 0), 1);
    green.setRadiance(new kit.three.Color(0, 0, 1), 1);
    return { brighter, shown: stage.screens().map(({ material }) => material.emissive.toArray()) };
  },

  async ownMonitor(kit) {
    const stage = await new Stage(kit).load(file);
    for (const monitor of stage.bake.monitors)
      for (const material of monitor.materials) {
        material.color.setRGB(1, 1, 1);
        material.emissiveIntensity = 0;
      }
    for (const mesh of stage.meshes()) mesh.visible = mesh.name.startsWith('Monitor');
    stage.bake.monitors[2].node.visible = stage.bake.monitors[1].node.visible = false;
    const own = brightest(await stage.render());
    stage.bake.monitors[2].node.visible = true; // which faces the first one
    return { own, other: brightest(await stage.render()) };
  },

  async disposed(kit) {
    const { stage, bake, stock } = await pair(kit);
    const lights = bake.lights.map((light) => light.clone().copy(light, false));
    const places = bake.lights.map((light) => light.matrixWorld.clone());
    await stage.render();
    bake.dispose();
    const dark = brightest(await stage.render());
    lights.forEach((light, i) => {
      light.matrix.copy(places[i]);
      light.matrixAutoUpdate = false;
      stage.scene.add(light);
    });
    return { dark, difference: difference(await stage.render(), await stock.render()) };
  },

  async twoPages(kit) {
    const stage = await new Stage(kit).load('/two/room.baked.glb');
    const pages = stage.bake.pages.map((page) => page.number).sort();
    for (const { material } of stage.screens()) material.visible = false;
    const before = await stage.render();
    stage.bake.enabled = false;
    const unshadowed = await stage.render();
    stage.bake.enabled = true;
    const [black, white] = [stage.plainMap(0, 0, 0), stage.plainMap(1, 1, 1)];
    stage.bake.setMap(black, 0);
    stage.bake.setMap(white, 1);
    const second = await stage.render();
    stage.bake.setMap(white, 0);
    stage.bake.setMap(black, 1);
    const first = await stage.render();
    return { pages, shadows: difference(before, unshadowed), parts: difference(sum([first, second]), unshadowed) };
  },

  async halfFloatMap(kit) {
    const { stage, bake } = await pair(kit);
    const before = await stage.render();
    bake.setMap(await kit.loadExrMap('/one/room.visibility.exr'));
    return { difference: difference(await stage.render(), before), brightest: brightest(before) };
  },
};

/** What the map says at each pixel: the same scene, unlit, with the map as its colour, without the screens. */
async function visibilityImage(kit, stage) {
  const restore = stage.meshes().map((mesh) => [mesh, mesh.material]);
  const [{ texture }] = stage.bake.pages;
  for (const [mesh] of restore) {
    mesh.material = new kit.three.MeshBasicMaterial({ map: texture });
    mesh.material.visible = !mesh.name.startsWith('Monitor');
  }
  const image = await stage.render();
  for (const [mesh, material] of restore) mesh.material = material;
  return image;
}
