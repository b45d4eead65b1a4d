// SPDX-License-Identifier: Apache-2.0
// The GLTFLoader plugin for WebGLRenderer.
import { UniformsLib } from 'three';
import { RectAreaLightUniformsLib } from 'three/addons/lights/RectAreaLightUniformsLib.js';
import { readBake } from './src/read_bake.js';
import { modulateForWebGL } from './src/modulate_webgl.js';

/** Makes the lights of a baked glb and dims them by its map; gltf.userData.surimi is the Bake. */
export class SurimiPlugin {
  constructor(parser) {
    this.name = 'SURIMI_visibility_map';
    this.parser = parser;
    if (!UniformsLib.LTC_FLOAT_1) RectAreaLightUniformsLib.init();
  }

  async afterRoot(gltf) {
    gltf.userData.surimi = await readBake(gltf, this.parser, modulateForWebGL);
  }
}

export { Bake } from './src/bake.js';
export { Monitor } from './src/monitor.js';
export { loadExrMap } from './src/load_exr_map.js';
