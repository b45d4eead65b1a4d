// SPDX-License-Identifier: Apache-2.0
// A loaded glb -> a Bake: its lights in the scene, its receivers dimmed by its map.
import { Bake } from './bake.js';
import { noteOf, takeMap } from './carrier.js';
import { findMonitors } from './find_monitors.js';

/**
 * `modulate(material, bake, texture, own)` makes a material dim its lights and returns { setTexture, dispose }; texture
 * null: nothing but the monitor `own` is masked.
 */
export async function readBake(gltf, parser, modulate) {
  const bake = new Bake();
  for (const scene of gltf.scenes) scene.updateMatrixWorld(true);
  const receivers = findReceivers(gltf.scenes);
  const names = [...receivers.values()].map((note) => note.channels);
  for (const { monitor, channel } of findMonitors(gltf.scenes, parser, names)) {
    bake.monitors.push(monitor);
    for (const light of monitor.lights) bake.setChannel(light, channel);
    for (const material of monitor.materials) bake.addModulation(modulate(material, bake, null, monitor));
  }
  for (const [material, note] of receivers) {
    const texture = await takeMap(material, note, parser);
    if (texture === null) {
      console.warn(`surimi-three: the map of the material "${material.name}" was lost; its surfaces have no shadows`);
      continue;
    }
    const page = pageOf(bake, note.page ?? 0, texture);
    const modulation = modulate(material, bake, page.texture, null);
    page.modulations.push(modulation);
    bake.addModulation(modulation);
  }
  return bake;
}

/** Material -> its note, for all materials that surfaces use. */
function findReceivers(scenes) {
  const receivers = new Map();
  for (const scene of scenes)
    scene.traverse((object) => {
      for (const material of object.isMesh ? [object.material].flat() : []) {
        const note = noteOf(material);
        if (note !== null) receivers.set(material, note);
      }
    });
  return receivers;
}

/** Materials of one page share one texture, whatever copies the loader made. */
function pageOf(bake, number, texture) {
  let page = bake.pages.find((candidate) => candidate.number === number);
  if (page === undefined) {
    page = { number, texture, modulations: [] };
    bake.pages.push(page);
  }
  return page;
}
