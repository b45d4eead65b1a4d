// SPDX-License-Identifier: Apache-2.0
// A picture of `surimi preview` as three.js would show the scene: one sample in the middle of each pixel.
import { execFileSync } from 'node:child_process';
import path from 'node:path';
import process from 'node:process';

/** FOLDER/name, an EXR, of FOLDER/glb from its first camera. */
export function preview(folder, glb, name, width, height) {
  const options = ['--model', 'three', '--samples', '1', '--size', width, height, '--quiet'];
  execFileSync(process.env.SURIMI, ['preview', path.join(folder, glb), '-o', path.join(folder, name), ...options.map(String)]);
}
