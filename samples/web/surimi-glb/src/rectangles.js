// SPDX-License-Identifier: Apache-2.0
// Triangles of a screen -> the rectangles that area lights can be. A rectangle is { matrix, width, height, isExact }:
// `matrix` is a rotation and a place, 16 numbers by columns; width along x, height along y, the front is -z of it.
import { column, cross, dot, handedness, length, normalized, scaled, subtract, sum, transformed } from './vectors.js';

const flat = 0.9999; // cosine of the angle between triangles of one part: 0.8 degrees
const fullness = 0.98; // a rectangle is filled by its triangles to this share; exporters round less than that

/**
 * The rectangles of a mesh, one for each flat connected part. `position(i)` is the i-th vertex, `indices` name the
 * corners of triangles in the winding of glTF, `matrix` puts them into the world. A part that is no rectangle gets one
 * of its area around its centre, and isExact false.
 */
export function rectanglesOf(position, indices, matrix) {
  return flatParts(trianglesOf(position, indices, matrix)).map(rectangleAround);
}

/** A rectangle around a node's origin, in its x and y, facing +z, scaled with it. A light faces -z instead, and of the
 * node's scale only the largest part counts for it (EXT_lights_area). */
export function scaledRectangle(node, width, height, isLight) {
  const scales = [0, 1, 2].map((i) => length(column(node, i)));
  const largest = Math.max(...scales);
  const x = normalized(column(node, 0));
  const tilted = column(node, 2);
  const z = normalized(subtract(tilted, scaled(x, dot(tilted, x))));
  const matrix = placed(x, cross(z, x), z, column(node, 3));
  const [across, up] = isLight ? [largest, largest] : scales;
  const rectangle = { matrix, width: width * across, height: height * up, isExact: true };
  return isLight ? rectangle : turned(rectangle);
}

/** The same rectangle, facing the other way. */
export function turned({ matrix, ...rest }) {
  const x = scaled(column(matrix, 0), -1);
  const z = scaled(column(matrix, 2), -1);
  return { matrix: placed(x, column(matrix, 1), z, column(matrix, 3)), ...rest };
}

function placed(x, y, z, center) {
  return [...x, 0, ...y, 0, ...z, 0, ...center, 1];
}

/** Corners in the world and normals on the front, which mirrored nodes do not turn (glTF 2.0, 3.7.4). */
function trianglesOf(position, indices, matrix) {
  const side = handedness(matrix) < 0 ? -1 : 1;
  const triangles = [];
  for (let i = 0; i + 2 < indices.length; i += 3) {
    const local = [0, 1, 2].map((k) => position(indices[i + k]));
    const keys = local.map((corner) => corner.join());
    const corners = local.map((corner) => transformed(matrix, corner));
    const normal = scaled(cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0])), side);
    const area = length(normal) / 2;
    if (area > 0) triangles.push({ keys, corners, normal: normalized(normal), area });
  }
  return triangles;
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
      for (const other of others) if (dot(triangles[other].normal, triangle.normal) > flat) part[root(other)] = root(i);
      known.set(edge.key, [...others.slice(-3), i]); // a broken mesh may have any number of triangles at an edge
    }
  });
  const parts = new Map();
  triangles.forEach((triangle, i) => {
    const place = root(i);
    if (!parts.has(place)) parts.set(place, []);
    parts.get(place).push(triangle);
  });
  return [...parts.values()];
}

/** The three edges, with keys that do not know a direction. */
function edgesOf({ keys, corners }) {
  return [0, 1, 2].map((k) => {
    const next = (k + 1) % 3;
    return { key: [keys[k], keys[next]].sort().join(' '), along: subtract(corners[next], corners[k]) };
  });
}

/** The longest edge that belongs to one triangle alone. */
function longestOutline(triangles) {
  const uses = new Map();
  for (const edge of triangles.flatMap(edgesOf))
    uses.set(edge.key, { ...edge, count: (uses.get(edge.key)?.count ?? 0) + 1 });
  const outline = [...uses.values()].filter((edge) => edge.count === 1);
  const edges = outline.length > 0 ? outline : [...uses.values()];
  return edges.reduce((longest, edge) => (length(edge.along) > length(longest.along) ? edge : longest)).along;
}

function rectangleAround(triangles) {
  const area = triangles.reduce((total, triangle) => total + triangle.area, 0);
  const z = normalized(sum(triangles.map((triangle) => scaled(triangle.normal, -triangle.area))));
  const edge = longestOutline(triangles);
  const x = normalized(subtract(edge, scaled(z, dot(edge, z))));
  const y = cross(z, x);
  const corners = triangles.flatMap((triangle) => triangle.corners);
  const [left, right] = extent(corners, x);
  const [bottom, top] = extent(corners, y);
  const box = (right - left) * (top - bottom);
  const isExact = area > fullness * box;
  const shrink = isExact ? 1 : Math.sqrt(area / box);
  const depth = corners.reduce((total, corner) => total + dot(corner, z), 0) / corners.length;
  const center = sum([scaled(x, (left + right) / 2), scaled(y, (bottom + top) / 2), scaled(z, depth)]);
  const matrix = placed(x, y, z, center);
  return { matrix, width: (right - left) * shrink, height: (top - bottom) * shrink, isExact };
}

function extent(corners, direction) {
  const heights = corners.map((corner) => dot(corner, direction));
  return heights.reduce(([low, high], h) => [Math.min(low, h), Math.max(high, h)], [Infinity, -Infinity]);
}
