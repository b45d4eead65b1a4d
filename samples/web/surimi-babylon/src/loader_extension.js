// SPDX-License-Identifier: Apache-2.0
// The part of Babylon's glTF loader that reads what `surimi bake` wrote.
import { noteOf } from 'surimi-glb';
import { Bake } from './bake.js';
import { findMonitors } from './find_monitors.js';
import { VisibilityPlugin } from './visibility_plugin.js';

export const name = 'SURIMI_visibility_map';

const bakes = new WeakMap();

/** The Bake that a root node (meshes[0] of the loader's result) came with; undefined: the file was not baked. */
export function bakeOf(root) {
  return bakes.get(root);
}

export class SurimiExtension {
  constructor(loader) {
    this.name = name;
    this.enabled = true;
    this.order = 100; // before KHR_materials_clearcoat, which must not see the map
    this.loader = loader;
    this.anchors = new Map();
    this.receivers = [];
  }

  dispose() {
    this.loader = null;
    this.receivers = [];
  }

  /** Loads the map as a texture of colours, so that sRGB is decoded before it is filtered. */
  loadMaterialPropertiesAsync(context, material, babylonMaterial) {
    const note = noteOf(material.extras);
    if (note === null) return null;
    if (!this.anchors.has(material)) this.anchors.set(material, takeAnchor(material));
    const anchor = this.anchors.get(material);
    if (anchor === null) {
      console.warn(`surimi-babylon: the map of the material "${material.name}" was lost; its surfaces have no shadows`);
      return null;
    }
    const info = { ...anchor, nonColorData: note.encoding !== 'srgb' };
    return Promise.all([
      this.loader.loadMaterialPropertiesAsync(context, material, babylonMaterial),
      this.loader.loadTextureInfoAsync(`${context}/extras/visibilityMap`, info, (texture) => {
        texture.gammaSpace = note.encoding === 'srgb'; // false where the hardware decodes
        texture.name = `${babylonMaterial.name} (visibility)`;
        this.receivers.push({ material: babylonMaterial, note, texture });
      }),
    ]);
  }

  /** Everything is in the scene: makes the lights. */
  async onReady() {
    const { gltf, rootBabylonMesh: root } = this.loader;
    const bake = new Bake();
    const names = this.receivers.map(({ note }) => note.channels);
    for (const { monitor, channel } of findMonitors(gltf, root.getScene(), names)) {
      bake.monitors.push(monitor);
      for (const light of monitor.lights) bake.setChannel(light, channel);
      for (const material of monitor.materials) {
        const use = { texture: null, placement: null, own: monitor };
        bake.addModulation(new VisibilityPlugin(material, bake, use), null);
      }
    }
    for (const { material, note, texture } of this.receivers) {
      const page = bake.addPage(note.page ?? 0, texture);
      const use = { texture: page.texture, placement: texture, own: null };
      bake.addModulation(new VisibilityPlugin(material, bake, use), page);
    }
    if (bake.monitors.length > 0) bakes.set(root, bake);
  }
}

/** The texture use of the layer that is switched off; the loader sees the layer no more. */
function takeAnchor(material) {
  const extensions = material.extensions ?? {};
  const { KHR_materials_clearcoat: coat, KHR_materials_sheen: cloth } = extensions;
  if (coat?.clearcoatTexture && (coat.clearcoatFactor ?? 0) === 0) {
    delete extensions.KHR_materials_clearcoat;
    return coat.clearcoatTexture;
  }
  if (cloth?.sheenColorTexture && (cloth.sheenColorFactor ?? [0]).every((factor) => factor === 0)) {
    delete extensions.KHR_materials_sheen;
    return cloth.sheenColorTexture;
  }
  return null;
}
