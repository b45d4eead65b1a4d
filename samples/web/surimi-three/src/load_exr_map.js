// SPDX-License-Identifier: Apache-2.0
// The map in half floats, NAME.visibility.exr, for those who want more than 8 bits: bake.setMap(await loadExrMap(url)).
import { ClampToEdgeWrapping, HalfFloatType, LinearFilter, NoColorSpace } from 'three';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';

/** The texture as glTF's coordinates want it: first row on top. */
export async function loadExrMap(url, manager = undefined) {
  const texture = await new EXRLoader(manager).setDataType(HalfFloatType).loadAsync(url);
  turnRows(texture.image);
  texture.colorSpace = NoColorSpace;
  texture.generateMipmaps = false;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
  texture.needsUpdate = true;
  return texture;
}

/** EXRLoader puts the last row first, and flipY is not for data on all backends. */
function turnRows({ data, height }) {
  const length = data.length / height;
  for (let low = 0, high = height - 1; low < high; ++low, --high) {
    const row = data.slice(low * length, (low + 1) * length);
    data.copyWithin(low * length, high * length, (high + 1) * length);
    data.set(row, high * length);
  }
}
