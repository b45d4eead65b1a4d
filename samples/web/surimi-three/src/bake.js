// SPDX-License-Identifier: Apache-2.0
// What a baked glb brought into a scene of three.js.
import { BakedLights } from 'surimi-glb';

export class Bake extends BakedLights {
  /** The texture takes over the set of coordinates of the page. */
  setMap(texture, number = 0) {
    texture.channel = this.pageOf(number)?.texture.channel ?? texture.channel;
    super.setMap(texture, number);
  }
}
