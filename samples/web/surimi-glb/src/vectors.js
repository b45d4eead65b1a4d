// SPDX-License-Identifier: Apache-2.0
// Vectors as [x, y, z], matrices as 16 numbers by columns, as in glTF.

export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scaled = (a, factor) => [a[0] * factor, a[1] * factor, a[2] * factor];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.hypot(...a);
export const normalized = (a) => scaled(a, 1 / length(a));
export const sum = (vectors) => vectors.reduce((total, v) => total.map((t, i) => t + v[i]), [0, 0, 0]);

/** Column 0, 1, 2: where the axes go; 3: the origin. */
export const column = (matrix, i) => [matrix[4 * i], matrix[4 * i + 1], matrix[4 * i + 2]];
export const transformed = (matrix, a) =>
  sum([scaled(column(matrix, 0), a[0]), scaled(column(matrix, 1), a[1]), scaled(column(matrix, 2), a[2]), column(matrix, 3)]);
/** Positive or negative, as the matrix keeps or mirrors windings. */
export const handedness = (matrix) => dot(cross(column(matrix, 0), column(matrix, 1)), column(matrix, 2));
