// SPDX-License-Identifier: Apache-2.0
// What a baked glb brought into a scene of Babylon.js.
import { BakedLights } from 'surimi-glb';

export class Bake extends BakedLights {
  /** The texture takes over the set of coordinates of the page. */
  setMap(texture, number = 0) {
    texture.coordinatesIndex = this.pageOf(number)?.texture.coordinatesIndex ?? texture.coordinatesIndex;
    super.setMap(texture, number);
  }
}
