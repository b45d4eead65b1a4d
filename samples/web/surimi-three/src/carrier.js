// SPDX-License-Identifier: Apache-2.0
// How a material carries the map: as the texture of a layer that is switched off. Here it is taken off.
import { ClampToEdgeWrapping, LinearFilter, LoaderUtils, NoColorSpace, SRGBColorSpace, TextureLoader } from 'three';

/**
 * Takes the map off a material, which then shows no trace of it, and returns the texture, ready for sampling; null
 * where there is none. Materials whose layers are all in use name a file, which is loaded from beside the glb.
 */
export async function takeMap(material, note, parser) {
  const texture = takeLayer(material) ?? (await loadFile(note, parser));
  if (texture === null) return null;
  texture.generateMipmaps = false; // small levels would mix charts; Blender asks for them
  texture.minFilter = LinearFilter;
  texture.colorSpace = note.encoding === 'srgb' ? SRGBColorSpace : NoColorSpace;
  texture.needsUpdate = true;
  return texture;
}

function takeLayer(material) {
  if (material.clearcoatMap && material.clearcoat === 0) {
    const texture = material.clearcoatMap;
    material.clearcoatMap = null;
    return texture;
  }
  if (material.sheenColorMap && material.sheenColor.getHex() === 0) {
    const texture = material.sheenColorMap;
    material.sheenColorMap = null;
    material.sheen = 0; // a black sheen shows nothing, but three would compute it
    return texture;
  }
  return null;
}

async function loadFile(note, parser) {
  if (typeof note.file !== 'string') return null;
  const loader = new TextureLoader(parser.options.manager).setCrossOrigin(parser.options.crossOrigin);
  const texture = await loader.loadAsync(LoaderUtils.resolveURL(note.file, parser.options.path));
  texture.flipY = false;
  texture.channel = note.texCoord ?? 1;
  texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
  return texture;
}
