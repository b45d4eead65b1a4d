// SPDX-License-Identifier: Apache-2.0
// The room of the tests, baked once: one/ on one map, two/ on two.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync } from 'node:fs';
import path from 'node:path';
import { writeRoom } from './room.mjs';

/** The folder with room.glb, one/ and two/; environment: SURIMI the program, SURIMI_WEB_WORK the folder. */
export async function bakedFolder() {
  const folder = path.resolve(process.env.SURIMI_WEB_WORK);
  if (existsSync(path.join(folder, 'two'))) return folder;
  mkdirSync(folder, { recursive: true });
  const scene = path.join(folder, 'room.glb');
  await writeRoom(scene);
  const bake = (name, ...options) =>
    execFileSync(process.env.SURIMI, ['bake', scene, '-o', path.join(folder, name), '--quality', 'draft', '--quiet', ...options]);
  bake('one', '--size', '256');
  bake('two', '--size', '192', '--atlases', '2');
  return folder;
}
