// SPDX-License-Identifier: Apache-2.0

/** R, G, B of the map. */
export type Channel = 0 | 1 | 2;

/** extras.visibilityMap of a material. */
export interface Note {
  channels: (string | null)[];
  encoding?: 'srgb' | 'linear';
  page?: number;
  file?: string;
  texCoord?: number;
}

export function noteOf(extras: unknown): Note | null;
export function channelOf(node: object, names: Note['channels'][]): Channel | null;

export interface AreaLight {
  width: number;
  height: number;
  color: number[];
  /** Nits. */
  intensity: number;
}
export function areaLightOf(node: object, json: object): AreaLight | null;

/** width along x, height along y of `matrix` (16 numbers by columns), front towards -z. */
export interface Rectangle {
  matrix: number[];
  width: number;
  height: number;
  isExact: boolean;
}
export function rectanglesOf(
  position: (vertex: number) => number[], indices: ArrayLike<number>, matrix: ArrayLike<number>): Rectangle[];
export function scaledRectangle(
  node: ArrayLike<number>, width: number, height: number, isLight: boolean): Rectangle;
export function turned(rectangle: Rectangle): Rectangle;

export interface Page<Texture> {
  /** extras.visibilityMap.page; 0 where there is one map. */
  readonly number: number;
  readonly texture: Texture;
}

/** What a baked glb brought into the scene. */
export class BakedLights<Light, Monitor, Texture> {
  /** By channel; rectangles of EXT_lights_area that were not baked come last. */
  monitors: Monitor[];
  pages: Page<Texture>[];
  /** false: the lights shine through everything, as without a map. */
  enabled: boolean;
  /** All lights of all monitors. */
  readonly lights: Light[];
  /** null: the light is not in the map and stays as the engine makes it. */
  channelOf(light: Light): Channel | null;
  /** For lights of your own that stand where a monitor stood. */
  setChannel(light: Light, channel: Channel | null): void;
  /** Shows another map in place of a page, laid out in the same way; the one before is not disposed of. */
  setMap(texture: Texture, number?: number): void;
  /** Gives the materials back to the engine, takes the lights out of the scene and frees the maps that are shown. */
  dispose(): void;
}
