// SPDX-License-Identifier: Apache-2.0
// The tables of area lights from a file of your own, since Babylon fetches them from its servers.
import { RawTexture } from '@babylonjs/core/Materials/Textures/rawTexture.js';
import { Texture } from '@babylonjs/core/Materials/Textures/texture.js';

const side = 64;
const halfFloats = 2; // Constants.TEXTURETYPE_HALF_FLOAT
const texelHalves = 8; // four of each texture

/** Call before the first area light is made. `url`: areaLightsLTC.bin of this package, or Babylon's own of that name. */
export async function loadLtc(scene, url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`surimi-babylon: ${url} cannot be read (${answer.status})`);
  const halves = new Uint16Array(await answer.arrayBuffer());
  if (halves.length !== side * side * texelHalves)
    throw new Error(`surimi-babylon: ${url} is no table of area lights: ${halves.length} numbers`);
  const textureOf = (isOfPart) => {
    const data = halves.filter((_, i) => isOfPart(i % texelHalves));
    const engine = scene.getEngine();
    const filter = Texture.BILINEAR_SAMPLINGMODE;
    const texture = RawTexture.CreateRGBATexture(data, side, side, engine, false, false, filter, halfFloats);
    texture.wrapU = texture.wrapV = Texture.CLAMP_ADDRESSMODE;
    return texture;
  };
  const half = texelHalves / 2;
  scene._ltcTextures = { LTC1: textureOf((i) => i < half), LTC2: textureOf((i) => i >= half) };
  scene.onDisposeObservable.addOnce(() => Object.values(scene._ltcTextures).forEach((texture) => texture.dispose()));
}
