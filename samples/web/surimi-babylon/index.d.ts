// SPDX-License-Identifier: Apache-2.0
import type { AbstractMesh, BaseTexture, Color3, Material, RectAreaLight, Scene, TransformNode } from '@babylonjs/core';
import { BakedLights } from 'surimi-glb';

/** Call once, before loading: from now on the glTF loader reads what `surimi bake` wrote. */
export function registerSurimi(): void;

/** The Bake that a root node (meshes[0] of the loader's result) came with. */
export function bakeOf(root: AbstractMesh): Bake | undefined;

/** The tables of area lights from a file of your own; call before the first area light is made. */
export function loadLtc(scene: Scene, url: string): Promise<void>;

/** What a baked glb brought into the scene. */
export class Bake extends BakedLights<RectAreaLight, Monitor, BaseTexture> {}

/** A screen, and the area lights that stand for it: one for each flat part. */
export class Monitor {
  readonly name: string;
  readonly node: TransformNode;
  readonly materials: Material[];
  readonly lights: RectAreaLight[];
  /** Linear; radiance in nits is color * intensity. */
  readonly color: Color3;
  readonly intensity: number;
  /** What the lights shine with and the screen shows. The map stays right. */
  setRadiance(color: Color3, intensity: number): void;
}
