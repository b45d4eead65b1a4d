// SPDX-License-Identifier: Apache-2.0
// A loaded glb -> a Bake: its lights in the scene, its receivers dimmed by its map.
import { noteOf } from 'surimi-glb';
import { Bake } from './bake.js';
import { takeMap } from './carrier.js';
import { findMonitors } from './find_monitors.js';

/**
 * `modulate(material, bake, { texture, placement, own })` makes a material dim its lights and returns { setTexture,
 * dispose }. `placement` is the texture as the file puts it on this very material: which UVs read it, and how they are
 * transformed. texture null: nothing but the monitor `own` is masked.
 */
export async function readBake(gltf, parser, modulate) {
  const bake = new Bake();
  for (const scene of gltf.scenes) scene.updateMatrixWorld(true);
  const receivers = findReceivers(gltf.scenes);
  const names = [...receivers.values()].map((note) => note.channels);
  for (const { monitor, channel } of findMonitors(gltf.scenes, parser, names)) {
    bake.monitors.push(monitor);
    for (const light of monitor.lights) bake.setChannel(light, channel);
    for (const material of monitor.materials) bake.addModulation(modulate(material, bake, { texture: null, placement: null, own: monitor }), null);
  }
  for (const [material, note] of receivers) {
    const texture = await takeMap(material, note, parser);
    if (texture === null) {
      console.warn(`surimi-three: the map of the material "${material.name}" was lost; its surfaces have no shadows`);
      continue;
    }
    const page = bake.addPage(note.page ?? 0, texture);
    const use = { texture: page.texture, placement: texture, own: null };
    bake.addModulation(modulate(material, bake, use), page);
  }
  return bake;
}

/** Material -> its note, for all materials that surfaces use. */
function findReceivers(scenes) {
  const receivers = new Map();
  for (const scene of scenes)
    scene.traverse((object) => {
      for (const material of object.isMesh ? [object.material].flat() : []) {
        const note = noteOf(material.userData);
        if (note !== null) receivers.set(material, note);
      }
    });
  return receivers;
}
