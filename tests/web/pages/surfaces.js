// SPDX-License-Identifier: Apache-2.0
// Which pixels of a picture lie within a surface, so that two renderers must agree there: in the 3 x 3 around them is
// one object, its normals differ by less than 10 degrees, and its depth bends by less than 1 %.
import { DoubleSide, ShaderMaterial } from 'three';

const leastCosine = Math.cos((10 * Math.PI) / 180);
const mostBend = 0.01; // of the depth
const components = 5;

const vertexShader = `
  varying vec3 vSeenNormal;
  varying float vDepth;
  void main() {
    vec4 seen = modelViewMatrix * vec4( position, 1.0 );
    vSeenNormal = normalMatrix * normal;
    vDepth = - seen.z;
    gl_Position = projectionMatrix * seen;
  }`;
const fragmentShader = `
  varying vec3 vSeenNormal;
  varying float vDepth;
  uniform float number;
  void main() {
    vec3 n = normalize( vSeenNormal ) * ( gl_FrontFacing ? 1.0 : - 1.0 );
    gl_FragColor = vec4( n.xy, vDepth, number );
  }`;

/** Renders objects, normals and depths with `read(scene, camera)`; [x of the normal, y, z, depth, object] a pixel. */
async function readSurfaces(meshes, read) {
  const restore = meshes.map((mesh) => [mesh, mesh.material]);
  meshes.forEach((mesh, i) => {
    const side = mesh.material.side ?? DoubleSide;
    mesh.material = new ShaderMaterial({ vertexShader, fragmentShader, side, uniforms: { number: { value: i + 1 } } });
  });
  const pixels = await read();
  for (const [mesh, material] of restore) mesh.material = material;
  const surfaces = new Float32Array((pixels.length / 4) * components);
  for (let i = 0; i < pixels.length / 4; ++i) {
    const [x, y, depth, object] = pixels.subarray(4 * i, 4 * i + 4);
    surfaces.set([x, y, Math.sqrt(Math.max(1 - x * x - y * y, 0)), depth, object], components * i);
  }
  return surfaces;
}

/** One entry a pixel: the number of the mesh that fills it and its neighbours, from 1; 0: none does. */
export async function interiorOf(meshes, width, height, read) {
  const surfaces = await readSurfaces(meshes, read);
  const at = (x, y) => surfaces.subarray(components * (y * width + x), components * (y * width + x + 1));
  const isWithin = (x, y) => {
    const here = at(x, y);
    for (const [dx, dy] of [[1, 0], [0, 1], [1, 1], [1, -1]]) {
      const [a, b] = [at(x - dx, y - dy), at(x + dx, y + dy)];
      if (a[4] !== here[4] || b[4] !== here[4]) return false;
      for (const other of [a, b])
        if (here[0] * other[0] + here[1] * other[1] + here[2] * other[2] < leastCosine) return false;
      if (Math.abs(a[3] + b[3] - 2 * here[3]) > mostBend * here[3]) return false;
    }
    return here[4] > 0;
  };
  const interior = new Uint16Array(width * height);
  for (let y = 1; y < height - 1; ++y)
    for (let x = 1; x < width - 1; ++x) if (isWithin(x, y)) interior[y * width + x] = at(x, y)[4];
  return interior;
}
