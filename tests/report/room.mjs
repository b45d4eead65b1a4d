// SPDX-License-Identifier: Apache-2.0
// A room of three monitors over a floor with a plate between, as glb. The name of a monitor would run as a script, were
// it ever read as HTML.
import { writeFileSync } from 'node:fs';

export const hostileName = 'TV</script><img src=x onerror="hacked = 1"><script>hacked = 1</script>';

/** Four corners, counter-clockwise seen from the front: [x, y, z] each. */
const quads = [
  { name: 'Floor', corners: [[-2, 0, 2], [2, 0, 2], [2, 0, -2], [-2, 0, -2]], emissive: [0, 0, 0] },
  { name: 'Plate', corners: [[-0.5, 0.7, 0.5], [0.5, 0.7, 0.5], [0.5, 0.7, -0.5], [-0.5, 0.7, -0.5]], emissive: [0, 0, 0] },
  { name: hostileName, monitor: 'R', corners: [[-1.6, 0.6, 0.7], [-1.6, 0.6, -0.7], [-1.6, 1.6, -0.7], [-1.6, 1.6, 0.7]], emissive: [1, 0.6, 0.4] },
  { name: 'Monitor_G', monitor: 'G', corners: [[1.6, 0.6, -0.7], [1.6, 0.6, 0.7], [1.6, 1.6, 0.7], [1.6, 1.6, -0.7]], emissive: [0.4, 1, 0.6] },
  { name: 'Monitor_B', monitor: 'B', corners: [[-0.7, 0.6, -1.6], [0.7, 0.6, -1.6], [0.7, 1.6, -1.6], [-0.7, 1.6, -1.6]], emissive: [0.4, 0.6, 1] },
];

const floatType = 5126;
const shortType = 5123;

function padded(buffer, filler) {
  return Buffer.concat([buffer, Buffer.alloc((4 - (buffer.length % 4)) % 4, filler)]);
}

/** Where a camera stands that looks at the middle of the plate: columns right, up, back, eye. */
const eye = [1.3, 1.7, 2.6];
function cameraMatrix() {
  const unit = (v) => v.map((x) => x / Math.hypot(...v));
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const back = unit([eye[0], eye[1] - 0.5, eye[2]]);
  const right = unit(cross([0, 1, 0], back));
  return [...right, 0, ...cross(back, right), 0, ...back, 0, ...eye, 1];
}

/** `file`: where to write it. */
export function writeRoom(file) {
  const json = {
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [] }], nodes: [], meshes: [], materials: [], accessors: [], bufferViews: [],
  };
  const parts = [];
  let size = 0;
  const addAccessor = (array, componentType, type, count, extra) => {
    const bytes = padded(Buffer.from(array.buffer), 0);
    json.bufferViews.push({ buffer: 0, byteOffset: size, byteLength: array.byteLength });
    json.accessors.push({ bufferView: json.bufferViews.length - 1, componentType, type, count, ...extra });
    parts.push(bytes);
    size += bytes.length;
    return json.accessors.length - 1;
  };
  for (const { name, corners, emissive, monitor } of quads) {
    const bound = (pick) => [0, 1, 2].map((c) => Math.fround(pick(...corners.map((corner) => corner[c]))));
    const POSITION = addAccessor(new Float32Array(corners.flat()), floatType, 'VEC3', 4, { min: bound(Math.min), max: bound(Math.max) });
    const indices = addAccessor(new Uint16Array([0, 1, 2, 0, 2, 3]), shortType, 'SCALAR', 6, {});
    json.materials.push({
      name, doubleSided: true, emissiveFactor: emissive,
      pbrMetallicRoughness: { baseColorFactor: [0.7, 0.7, 0.7, 1], metallicFactor: 0, roughnessFactor: 0.6 },
    });
    json.meshes.push({ primitives: [{ attributes: { POSITION }, indices, material: json.materials.length - 1 }] });
    json.nodes.push({ name, mesh: json.meshes.length - 1, ...(monitor ? { extras: { monitor } } : {}) });
    json.scenes[0].nodes.push(json.nodes.length - 1);
  }
  json.cameras = [{ type: 'perspective', perspective: { yfov: 0.9, znear: 0.01 } }];
  json.scenes[0].nodes.push(json.nodes.length);
  json.nodes.push({ name: 'Camera', camera: 0, matrix: cameraMatrix() });
  json.buffers = [{ byteLength: size }];
  const text = padded(Buffer.from(JSON.stringify(json)), ' ');
  const words = (...values) => Buffer.from(new Uint32Array(values).buffer);
  writeFileSync(file, Buffer.concat([
    words(0x46546c67, 2, 28 + text.length + size, text.length, 0x4e4f534a), text, words(size, 0x004e4942), ...parts,
  ]));
}
