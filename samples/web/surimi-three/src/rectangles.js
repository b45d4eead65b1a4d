// SPDX-License-Identifier: Apache-2.0
// Triangles of a screen -> the rectangles that area lights can be.
import { Matrix4, Vector3 } from 'three';

const flat = 0.9999; // cosine of the angle between triangles of one part: 0.8 degrees
const fullness = 0.98; // a rectangle is filled by its triangles to this share; exporters round less than that

/**
 * The rectangles of a mesh in the world: [{ matrix, width, height, isExact }], one for each flat connected part.
 * `matrix` is a rotation and a place; the front is -z of it, as that of RectAreaLight. A part that is no rectangle gets
 * one of its area around its centre, and isExact false. Matrices of the world must be up to date.
 */
export function rectanglesOf(mesh) {
  return flatParts(trianglesOf(mesh)).map(rectangleAround);
}

/** Corners in the world and normals on the front, which mirrored nodes do not turn (glTF 2.0, 3.7.4). */
function trianglesOf(mesh) {
  const { index, attributes } = mesh.geometry;
  const side = mesh.matrixWorld.determinant() < 0 ? -1 : 1;
  const count = index ? index.count : attributes.position.count;
  const triangles = [];
  for (let i = 0; i + 2 < count; i += 3) {
    const local = [0, 1, 2].map((k) => cornerAt(attributes.position, index ? index.getX(i + k) : i + k));
    const keys = local.map((corner) => corner.toArray().join());
    const corners = local.map((corner) => corner.applyMatrix4(mesh.matrixWorld));
    const normal = corners[1].clone().sub(corners[0]).cross(corners[2].clone().sub(corners[0])).multiplyScalar(side);
    const area = normal.length() / 2;
    if (area > 0) triangles.push({ keys, corners, normal: normal.normalize(), area });
  }
  return triangles;
}

function cornerAt(position, vertex) {
  return new Vector3().fromBufferAttribute(position, vertex);
}

/** Triangles that share an edge and a plane, together. */
function flatParts(triangles) {
  const part = triangles.map((_, i) => i);
  const root = (i) => {
    while (part[i] !== i) i = part[i] = part[part[i]];
    return i;
  };
  const known = new Map();
  triangles.forEach((triangle, i) => {
    for (const edge of edgesOf(triangle)) {
      const others = known.get(edge.key) ?? [];
      for (const other of others) if (triangles[other].normal.dot(triangle.normal) > flat) part[root(other)] = root(i);
      known.set(edge.key, [...others.slice(-3), i]); // a broken mesh may have any number of triangles at an edge
    }
  });
  const parts = new Map();
  triangles.forEach((triangle, i) => parts.set(root(i), [...(parts.get(root(i)) ?? []), triangle]));
  return [...parts.values()];
}

/** The three edges, with keys that do not know a direction. */
function edgesOf({ keys, corners }) {
  return [0, 1, 2].map((k) => {
    const next = (k + 1) % 3;
    return { key: [keys[k], keys[next]].sort().join(' '), along: corners[next].clone().sub(corners[k]) };
  });
}

/** The longest edge that belongs to one triangle alone. */
function longestOutline(triangles) {
  const uses = new Map();
  for (const triangle of triangles)
    for (const edge of edgesOf(triangle)) uses.set(edge.key, { ...edge, count: (uses.get(edge.key)?.count ?? 0) + 1 });
  const outline = [...uses.values()].filter((edge) => edge.count === 1);
  const edges = outline.length > 0 ? outline : [...uses.values()];
  return edges.reduce((longest, edge) => (edge.along.lengthSq() > longest.along.lengthSq() ? edge : longest)).along;
}

function rectangleAround(triangles) {
  const area = triangles.reduce((sum, triangle) => sum + triangle.area, 0);
  const front = triangles.reduce((sum, { normal, area: weight }) => sum.addScaledVector(normal, weight), new Vector3());
  const z = front.normalize().negate();
  const edge = longestOutline(triangles);
  const x = edge.addScaledVector(z, -edge.dot(z)).normalize();
  const y = z.clone().cross(x);
  const corners = triangles.flatMap((triangle) => triangle.corners);
  const [left, right] = extent(corners, x);
  const [bottom, top] = extent(corners, y);
  const box = (right - left) * (top - bottom);
  const isExact = area > fullness * box;
  const shrink = isExact ? 1 : Math.sqrt(area / box);
  const depth = corners.reduce((sum, corner) => sum + corner.dot(z), 0) / corners.length;
  const center = x.clone().multiplyScalar((left + right) / 2);
  center.addScaledVector(y, (bottom + top) / 2).addScaledVector(z, depth);
  const matrix = new Matrix4().makeBasis(x, y, z).setPosition(center);
  return { matrix, width: (right - left) * shrink, height: (top - bottom) * shrink, isExact };
}

function extent(corners, direction) {
  const heights = corners.map((corner) => corner.dot(direction));
  return heights.reduce(([low, high], h) => [Math.min(low, h), Math.max(high, h)], [Infinity, -Infinity]);
}
