// SPDX-License-Identifier: Apache-2.0
// The GLTFLoader plugin for WebGPURenderer, both of its backends.
import { RectAreaLight, RectAreaLightNode } from 'three/webgpu';
import { RectAreaLightTexturesLib } from 'three/addons/lights/RectAreaLightTexturesLib.js';
import { readBake } from './src/read_bake.js';
import { VisibilityRectAreaLightNode, modulateForNodes } from './src/modulate_tsl.js';

let isPrepared = false;

/** All RectAreaLights become VisibilityRectAreaLightNodes, which are three's own wherever no bake is concerned. */
function prepareOnce() {
  if (isPrepared) return;
  RectAreaLight.registerNode(VisibilityRectAreaLightNode);
  RectAreaLightNode.setLTC(RectAreaLightTexturesLib.init());
  isPrepared = true;
}

/** Makes the lights of a baked glb and dims them by its map; gltf.userData.surimi is the Bake. */
export class SurimiPlugin {
  constructor(parser) {
    this.name = 'SURIMI_visibility_map';
    this.parser = parser;
    prepareOnce();
  }

  async afterRoot(gltf) {
    gltf.userData.surimi = await readBake(gltf, this.parser, modulateForNodes);
  }
}

export { Bake } from './src/bake.js';
export { Monitor } from './src/monitor.js';
export { loadExrMap } from './src/load_exr_map.js';
