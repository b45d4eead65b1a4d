// SPDX-License-Identifier: Apache-2.0
// A small room as glb: floor, two walls, a box, a pillar and a ball, three monitors and a camera. One monitor has two
// panels at an angle, one is a mirrored and unevenly scaled quad that shares its material with another one.
import { Document, NodeIO } from '@gltf-transform/core';
import { KHRMaterialsEmissiveStrength } from '@gltf-transform/extensions';
import { encodePng } from './png.mjs';

/** Corners counter-clockwise seen from the front, as [x, y, z]; uv over the whole quad. */
function quads(...corners) {
  const mesh = { positions: [], normals: [], uvs: [], indices: [] };
  for (const [a, b, c, d] of corners) {
    const first = mesh.positions.length / 3;
    const u = b.map((v, k) => v - a[k]);
    const v = d.map((w, k) => w - a[k]);
    const cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...cross);
    for (const corner of [a, b, c, d]) {
      mesh.positions.push(...corner);
      mesh.normals.push(...cross.map((n) => n / length));
    }
    mesh.uvs.push(0, 1, 1, 1, 1, 0, 0, 0);
    mesh.indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
  return mesh;
}

function box([x0, y0, z0], [x1, y1, z1]) {
  return quads(
    [[x0, y0, z1], [x1, y0, z1], [x1, y1, z1], [x0, y1, z1]],
    [[x1, y0, z0], [x0, y0, z0], [x0, y1, z0], [x1, y1, z0]],
    [[x1, y0, z1], [x1, y0, z0], [x1, y1, z0], [x1, y1, z1]],
    [[x0, y0, z0], [x0, y0, z1], [x0, y1, z1], [x0, y1, z0]],
    [[x0, y1, z1], [x1, y1, z1], [x1, y1, z0], [x0, y1, z0]],
  );
}

function ball(center, radius, rings, sectors) {
  const mesh = { positions: [], normals: [], uvs: [], indices: [] };
  for (let i = 0; i <= rings; ++i)
    for (let j = 0; j <= sectors; ++j) {
      const polar = (Math.PI * i) / rings;
      const around = (2 * Math.PI * j) / sectors;
      const n = [Math.sin(polar) * Math.sin(around), Math.cos(polar), Math.sin(polar) * Math.cos(around)];
      mesh.positions.push(...n.map((c, k) => center[k] + radius * c));
      mesh.normals.push(...n);
      mesh.uvs.push(j / sectors, i / rings);
    }
  for (let i = 0; i < rings; ++i)
    for (let j = 0; j < sectors; ++j) {
      const a = i * (sectors + 1) + j;
      const b = a + sectors + 1;
      if (i > 0) mesh.indices.push(a, b, a + 1);
      if (i < rings - 1) mesh.indices.push(a + 1, b, b + 1);
    }
  return mesh;
}

class RoomBuilder {
  constructor() {
    this.document = new Document();
    this.buffer = this.document.createBuffer();
    this.scene = this.document.createScene();
    this.strength = this.document.createExtension(KHRMaterialsEmissiveStrength);
  }

  material(name, color, roughness, metallic) {
    const material = this.document.createMaterial(name);
    return material.setBaseColorFactor([...color, 1]).setRoughnessFactor(roughness).setMetallicFactor(metallic);
  }

  screen(name, color, nits) {
    const strength = this.strength.createEmissiveStrength().setEmissiveStrength(nits);
    const material = this.material(name, [0, 0, 0], 1, 0).setEmissiveFactor(color);
    return material.setExtension('KHR_materials_emissive_strength', strength);
  }

  accessor(type, array) {
    return this.document.createAccessor().setType(type).setArray(array).setBuffer(this.buffer);
  }

  add(name, geometry, material) {
    const primitive = this.document.createPrimitive().setMaterial(material);
    primitive.setAttribute('POSITION', this.accessor('VEC3', new Float32Array(geometry.positions)));
    primitive.setAttribute('NORMAL', this.accessor('VEC3', new Float32Array(geometry.normals)));
    primitive.setAttribute('TEXCOORD_0', this.accessor('VEC2', new Float32Array(geometry.uvs)));
    primitive.setIndices(this.accessor('SCALAR', new Uint16Array(geometry.indices)));
    const node = this.document.createNode(name).setMesh(this.document.createMesh(name).addPrimitive(primitive));
    this.scene.addChild(node);
    return node;
  }
}

function addSurroundings(room) {
  const checks = (x, y) => ((x >> 2) + (y >> 2)) % 2 ? [200, 60, 40] : [230, 220, 190];
  const picture = room.document.createTexture('checks').setImage(encodePng(32, 32, checks)).setMimeType('image/png');
  const wood = room.material('Wood', [1, 1, 1], 0.6, 0).setBaseColorTexture(picture);
  wood.getBaseColorTextureInfo().setMinFilter(9729).setMagFilter(9729); // no mipmaps: preview has none either
  const paint = room.material('Paint', [0.7, 0.72, 0.68], 0.9, 0);
  room.add('Floor', quads([[-3, 0, 3], [3, 0, 3], [3, 0, -2], [-3, 0, -2]]), room.material('Floor', [0.5, 0.5, 0.5], 0.3, 0));
  room.add('Back', quads([[-3, 0, -2], [3, 0, -2], [3, 2.6, -2], [-3, 2.6, -2]]), paint);
  room.add('Left', quads([[-3, 0, 3], [-3, 0, -2], [-3, 2.6, -2], [-3, 2.6, 3]]), paint);
  room.add('Box', box([-0.7, 0, -0.5], [0.3, 0.8, 0.4]), wood);
  room.add('Pillar', box([1.3, 0, -0.3], [1.5, 1.7, -0.1]), room.material('Steel', [0.8, 0.8, 0.85], 0.45, 1));
  room.add('Ball', ball([0.9, 0.4, 1.2], 0.4, 16, 24), room.material('Brass', [0.9, 0.7, 0.35], 0.35, 1));
}

function addMonitors(room) {
  const warm = room.screen('Warm', [1, 0.35, 0.2], 9);
  const green = room.screen('Green', [0.3, 1, 0.45], 8);
  const panel = (x, z, dx, dz) => [[x, 0.5, z], [x + dx, 0.5, z + dz], [x + dx, 1.5, z + dz], [x, 1.5, z]];
  room.add('Monitor_R', quads(panel(-2, -1.9, 1.6, 0)), warm);
  room.add('Monitor_G', quads(panel(0.3, -1.8, 1, 0), panel(1.3, -1.8, 0.8, 0.6)), green);
  const unit = quads([[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0]]);
  const right = [0, -Math.SQRT1_2, 0, Math.SQRT1_2]; // its front looks to -x
  room.add('Monitor_B', unit, warm).setTranslation([2.8, 1.2, 0.6]).setRotation(right).setScale([-1.4, 0.8, 1]);
}

function addCamera(room) {
  const lens = room.document.createCamera('Eye').setType('perspective').setYFov(0.8).setAspectRatio(1.5).setZNear(0.1);
  const [pitch, turn] = [-0.28, 0.12];
  const [s, c] = [Math.sin(turn / 2), Math.cos(turn / 2)];
  const rotation = [c * Math.sin(pitch / 2), s * Math.cos(pitch / 2), -s * Math.sin(pitch / 2), c * Math.cos(pitch / 2)];
  room.scene.addChild(room.document.createNode('Eye').setCamera(lens).setTranslation([0.8, 2.2, 5]).setRotation(rotation));
}

/** Writes the room to a file. */
export async function writeRoom(path) {
  const room = new RoomBuilder();
  addSurroundings(room);
  addMonitors(room);
  addCamera(room);
  await new NodeIO().registerExtensions([KHRMaterialsEmissiveStrength]).write(path, room.document);
}
