// SPDX-License-Identifier: Apache-2.0
// What a baked glb brought into the scene: monitors, their lights, the pages of the map, and which light is dimmed by
// which channel.
import { Vector4 } from 'three';

// Dotted with (R, G, B, 1) of the map.
const channelMasks = [new Vector4(1, 0, 0, 0), new Vector4(0, 1, 0, 0), new Vector4(0, 0, 1, 0)];
const unshadowed = new Vector4(0, 0, 0, 1);
const dark = new Vector4(0, 0, 0, 0);

export class Bake {
  #channels = new Map();
  #modulations = [];

  constructor() {
    this.monitors = [];
    this.pages = [];
    this.enabled = true;
  }

  /** All lights that the plugin made, in the order of the monitors. */
  get lights() {
    return this.monitors.flatMap((monitor) => monitor.lights);
  }

  /** 0, 1, 2 for R, G, B of the map; null: the light is not in the map and stays as it is. */
  channelOf(light) {
    return this.#channels.get(light) ?? null;
  }

  setChannel(light, channel) {
    if (channel === null) this.#channels.delete(light);
    else if (channel in channelMasks) this.#channels.set(light, channel);
    else throw new RangeError(`surimi-three: channel ${channel} is none of 0, 1, 2 or null`);
  }

  /**
   * What a surface multiplies a light with: the dot product of this mask with (R, G, B, 1) of the map.
   * `own` is the monitor that the surface belongs to: it has no map, and does not light itself.
   */
  maskOf(light, own = null) {
    if (own !== null) return own.lights.includes(light) ? dark : unshadowed;
    const channel = this.channelOf(light);
    return this.enabled && channel !== null ? channelMasks[channel] : unshadowed;
  }

  /** Shows another map in place of a page, laid out in the same way; the one before is not disposed of. */
  setMap(texture, page = 0) {
    const shown = this.pages.find((candidate) => candidate.number === page);
    if (shown === undefined) throw new RangeError(`surimi-three: the bake has no page ${page}`);
    texture.channel = shown.texture.channel;
    shown.texture = texture;
    for (const modulation of shown.modulations) modulation.setTexture(texture);
  }

  /** Called by the reader: `modulation` has setTexture(texture) and dispose(). */
  addModulation(modulation) {
    this.#modulations.push(modulation);
  }

  /** Gives the materials back to three, takes the lights out of the scene and frees the maps that are shown. */
  dispose() {
    for (const modulation of this.#modulations) modulation.dispose();
    for (const monitor of this.monitors) monitor.dispose();
    for (const page of this.pages) page.texture.dispose();
    this.#modulations = [];
    this.monitors = [];
    this.pages = [];
    this.#channels.clear();
  }
}
