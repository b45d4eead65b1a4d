// SPDX-License-Identifier: Apache-2.0
// The same glb from the same camera: what surimi-three shows beside a picture of `surimi preview`.
import * as three from 'three';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { RectAreaLightUniformsLib } from 'three/addons/lights/RectAreaLightUniformsLib.js';
import { SurimiPlugin } from 'surimi-three';
import { interiorOf } from './surfaces.js';

const darkest = 0.01; // differences are relative to a pixel's radiance, but at least to this share of the mean
const side = 64; // of the LTC textures

/** The textures of ltc_textures in place of three's own. */
async function useTable(url) {
  const values = new Float32Array(await (await fetch(url)).arrayBuffer());
  const texels = values.length / 2;
  [0, 1].forEach((part) => {
    const data = values.slice(part * texels, (part + 1) * texels);
    const texture = new three.DataTexture(data, side, side, three.RGBAFormat, three.FloatType);
    texture.minFilter = texture.magFilter = three.LinearFilter;
    texture.needsUpdate = true;
    three.UniformsLib[`LTC_FLOAT_${part + 1}`] = texture;
  });
}

/**
 * The pixels in the middle of `finer` x `finer`, an odd number, of a picture that much larger: rasterizers round
 * corners to sixteenths of a pixel (SwiftShader), and three widens highlights by what normals differ between pixels.
 */
async function readCenters(renderer, scene, camera, width, height, finer) {
  const rows = Math.floor(height / finer) * finer || finer;
  const target = new three.WebGLRenderTarget(width * finer, rows, { type: three.FloatType });
  renderer.setRenderTarget(target);
  const centers = new Float32Array(4 * width * height);
  const strip = new Float32Array(4 * width * finer * rows);
  const middle = (finer - 1) / 2;
  for (let top = 0; top < height * finer; top += rows) {
    camera.setViewOffset(width * finer, height * finer, 0, top, width * finer, rows);
    renderer.render(scene, camera);
    await renderer.readRenderTargetPixelsAsync(target, 0, 0, width * finer, rows, strip);
    for (let row = middle; row < rows && top + row < height * finer; row += finer) // from the top, as in the view
      for (let x = 0; x < width; ++x) {
        const from = 4 * ((rows - 1 - row) * width * finer + x * finer + middle);
        const to = 4 * ((height - 1 - (top + row - middle) / finer) * width + x);
        centers.set(strip.subarray(from, from + 4), to);
      }
  }
  target.dispose();
  return centers;
}

/**
 * Without what depends on the size of a pixel or on the precision of the hardware: three adds to the roughness of bent
 * surfaces, and textures of 8 bits are filtered in fixed point and from mipmaps.
 */
function makePlain({ scene, userData }) {
  const chunk = three.ShaderChunk.lights_physical_fragment;
  three.ShaderChunk.lights_physical_fragment = chunk.replace('material.roughness += geometryRoughness;', '');
  scene.traverse(({ material }) => {
    for (const key of Object.keys(material ?? {})) if (material[key]?.isTexture) material[key] = asFloats(material[key]);
  });
  for (const { number, texture } of userData.surimi.pages) userData.surimi.setMap(asFloats(texture), number);
}

const floats = new Map();

/** The texture with linear floats, without mipmaps. */
function asFloats(texture) {
  if (texture.isDataTexture) return texture;
  if (floats.has(texture)) return floats.get(texture);
  const { width, height } = texture.image;
  const context = new OffscreenCanvas(width, height).getContext('2d');
  context.drawImage(texture.image, 0, 0);
  const isEncoded = texture.colorSpace === three.SRGBColorSpace;
  const linear = (v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
  const value = (code, i) => (isEncoded && i % 4 < 3 ? linear(code / 255) : code / 255);
  const data = Float32Array.from(context.getImageData(0, 0, width, height).data, value);
  const copy = new three.DataTexture(data, width, height, three.RGBAFormat, three.FloatType);
  for (const key of ['wrapS', 'wrapT', 'channel', 'rotation']) copy[key] = texture[key];
  for (const key of ['offset', 'repeat', 'center']) copy[key].copy(texture[key]);
  copy.minFilter = copy.magFilter = three.LinearFilter;
  copy.needsUpdate = true;
  floats.set(texture, copy);
  return copy;
}

/** 'diffuse' or 'specular' alone, as `preview --show` says; emission belongs to 'lit'. */
function showPart(root, part) {
  root.traverse(({ material }) => {
    if (!material?.emissive || part === 'lit') return;
    material.emissive.setScalar(0);
    if (part === 'diffuse') material.specularIntensity = 0;
    else if (material.metalness === 0) material.color.setScalar(0);
  });
}

/** Largest, 99.9 % and root of the mean square of the differences of pixels within surfaces, and where. */
function judge(ours, theirs, interior, names, width) {
  const inside = [...interior.keys()].filter((i) => interior[i] > 0);
  const mean = inside.reduce((total, i) => total + ours[4 * i] + ours[4 * i + 1] + ours[4 * i + 2], 0) / (3 * inside.length);
  const errors = inside.flatMap((i) =>
    [0, 1, 2].map((c) => {
      const [a, b] = [ours[4 * i + c], theirs[4 * i + c]];
      return { i, error: Math.abs(a - b) / Math.max(a, b, darkest * mean), a, b };
    }),
  );
  errors.sort((p, q) => q.error - p.error);
  const place = ({ i, error, a, b }) => ({ at: [i % width, Math.floor(i / width)], of: names[interior[i] - 1], error, a, b });
  const byMesh = {};
  for (const { i, error } of errors) byMesh[names[interior[i] - 1]] ??= error;
  return {
    pixels: inside.length,
    share: inside.length / interior.length,
    largest: errors[0].error,
    most: errors[Math.floor(errors.length / 1000)].error,
    rms: Math.sqrt(errors.reduce((total, { error }) => total + error * error, 0) / errors.length),
    worst: errors.slice(0, 5).map(place),
    byMesh,
  };
}

/** A picture as PNG for people: the shared exposure, sRGB. */
function developed(pixels, width, height, value) {
  const canvas = Object.assign(document.createElement('canvas'), { width, height });
  const context = canvas.getContext('2d');
  const image = context.createImageData(width, height);
  const code = (v) => 255 * (v < 0.0031308 ? 12.92 * v : 1.055 * Math.min(v, 1) ** (1 / 2.4) - 0.055);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x)
      for (let c = 0; c < 4; ++c)
        image.data[4 * ((height - 1 - y) * width + x) + c] = c === 3 ? 255 : code(value(4 * (y * width + x) + c));
  context.putImageData(image, 0, 0);
  return canvas.toDataURL('image/png');
}

/** `glb` and `picture` (EXR of its `camera`, none: the first) are URLs; `table` may replace three's LTC textures. */
window.compare = async ({ glb, picture, table, camera: name, enabled = true, part = 'lit', finer = 1, plain = false }) => {
  if (table) await useTable(table);
  else RectAreaLightUniformsLib.init();
  const theirs = await new EXRLoader().setDataType(three.FloatType).loadAsync(picture);
  const { width, height, data } = theirs.image;
  const gltf = await new GLTFLoader().register((parser) => new SurimiPlugin(parser)).loadAsync(glb);
  gltf.userData.surimi.enabled = enabled;
  if (plain) makePlain(gltf);
  showPart(gltf.scene, part);
  const scene = new three.Scene().add(gltf.scene);
  const camera = gltf.cameras.find((candidate) => candidate.name === name) ?? gltf.cameras[0];
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  const renderer = new three.WebGLRenderer();
  const read = () => readCenters(renderer, scene, camera, width, height, finer);
  const pixels = await read();
  const meshes = [];
  scene.traverse((object) => object.isMesh && meshes.push(object));
  const interior = await interiorOf(meshes, width, height, read);
  const result = judge(pixels, data, interior, meshes.map((mesh) => mesh.name), width);
  const shown = [pixels, data].map((image) => developed(image, width, height, (i) => image[i]));
  const differences = developed(pixels, width, height, (i) =>
    interior[i >> 2] > 0 ? Math.abs(pixels[i] - data[i]) / Math.max(pixels[i], data[i], 1e-3) / 0.01 : 0);
  return { ...result, pictures: { three: shown[0], ours: shown[1], differences } };
};
