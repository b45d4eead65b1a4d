// SPDX-License-Identifier: Apache-2.0
// What a baked glb brought into the scene: monitors, their lights, the pages of the map, and which light is dimmed by
// which channel.

// Dotted with (R, G, B, 1) of the map.
const channelMasks = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]];
const unshadowed = [0, 0, 0, 1];
const dark = [0, 0, 0, 0];

/** Monitors have `lights` and dispose(); pages { number, texture, modulations }; modulations setTexture and dispose. */
export class BakedLights {
  #channels = new Map();
  #modulations = [];

  constructor() {
    this.monitors = [];
    this.pages = [];
    this.enabled = true;
  }

  /** All lights that were made, in the order of the monitors. */
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
    else throw new RangeError(`surimi: channel ${channel} is none of 0, 1, 2 or null`);
  }

  /**
   * What a surface multiplies a light with: the dot product of these four numbers with (R, G, B, 1) of the map.
   * `own` is the monitor that the surface belongs to: it has no map, and does not light itself.
   */
  maskOf(light, own = null) {
    if (own !== null) return own.lights.includes(light) ? dark : unshadowed;
    const channel = this.channelOf(light);
    return this.enabled && channel !== null ? channelMasks[channel] : unshadowed;
  }

  /** Shows another map in place of a page, laid out in the same way; the one before is not disposed of. */
  setMap(texture, number = 0) {
    const page = this.pageOf(number);
    if (page === undefined) throw new RangeError(`surimi: the bake has no page ${number}`);
    page.texture = texture;
    for (const modulation of page.modulations) modulation.setTexture(texture);
  }

  /** undefined: there is none of this number. */
  pageOf(number) {
    return this.pages.find((page) => page.number === number);
  }

  /** For readers: another material that is dimmed; `page` null: a monitor's own. */
  addModulation(modulation, page) {
    this.#modulations.push(modulation);
    page?.modulations.push(modulation);
  }

  /** For readers: the page with this number; the first material's texture is read by all, each by its own UVs. */
  addPage(number, texture) {
    if (this.pageOf(number) === undefined) this.pages.push({ number, texture, modulations: [] });
    return this.pageOf(number);
  }

  /** Gives the materials back to the engine, takes the lights out of the scene and frees the maps that are shown. */
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
