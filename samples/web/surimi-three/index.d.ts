// SPDX-License-Identifier: Apache-2.0
import type { Color, ColorRepresentation, LoadingManager, Material, Object3D, RectAreaLight, Texture } from 'three';
import { BakedLights } from 'surimi-glb';
import type { GLTF, GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';

/** GLTFLoader plugin: makes the lights of a baked glb and dims them by its map. gltf.userData.surimi is the Bake. */
export class SurimiPlugin implements GLTFLoaderPlugin {
  constructor(parser: GLTFParser);
  readonly name: string;
  afterRoot(gltf: GLTF): Promise<void>;
}

/** What a baked glb brought into the scene. */
export class Bake extends BakedLights<RectAreaLight, Monitor, Texture> {}

/** A screen, and the area lights that stand for it: one for each flat part. */
export class Monitor {
  readonly name: string;
  readonly node: Object3D;
  readonly materials: Material[];
  readonly lights: RectAreaLight[];
  /** Linear; radiance in nits is color * intensity. */
  readonly color: Color;
  readonly intensity: number;
  /** What the lights shine with and the screen shows. The map stays right. */
  setRadiance(color: ColorRepresentation, intensity: number): void;
}

/** NAME.visibility.exr: the map in half floats, for Bake.setMap. */
export function loadExrMap(url: string, manager?: LoadingManager): Promise<Texture>;
