// SPDX-License-Identifier: Apache-2.0
import type { ColorRepresentation, Color, LoadingManager, Material, Object3D, RectAreaLight, Texture } from 'three';
import type { GLTF, GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';

/** GLTFLoader plugin: makes the lights of a baked glb and dims them by its map. gltf.userData.surimi is the Bake. */
export class SurimiPlugin implements GLTFLoaderPlugin {
  constructor(parser: GLTFParser);
  readonly name: string;
  afterRoot(gltf: GLTF): Promise<void>;
}

/** R, G, B of the map. */
export type Channel = 0 | 1 | 2;

export interface Page {
  /** extras.visibilityMap.page; 0 where there is one map. */
  readonly number: number;
  readonly texture: Texture;
}

/** What a baked glb brought into the scene. */
export class Bake {
  /** By channel; rectangles of EXT_lights_area that were not baked come last. */
  monitors: Monitor[];
  pages: Page[];
  /** false: the lights shine through everything, as without a map. */
  enabled: boolean;
  /** All lights of all monitors. */
  readonly lights: RectAreaLight[];
  /** null: the light is not in the map and stays as three makes it. */
  channelOf(light: RectAreaLight): Channel | null;
  /** For lights of your own that stand where a monitor stood. */
  setChannel(light: RectAreaLight, channel: Channel | null): void;
  /** Shows another map in place of a page, laid out in the same way; the one before is not disposed of. */
  setMap(texture: Texture, page?: number): void;
  /** Gives the materials back to three, takes the lights out of the scene and frees the maps that are shown. */
  dispose(): void;
}

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
