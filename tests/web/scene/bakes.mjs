// SPDX-License-Identifier: Apache-2.0
// The room of the tests, baked once: one/ on one map, two/ on two.
import { execFileSync } from 'node:child_process';
import { copyFileSync, existsSync, mkdirSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import process from 'node:process';
import { writeRoom } from './room.mjs';

const table = fileURLToPath(new URL('../../../samples/web/surimi-babylon/areaLightsLTC.bin', import.meta.url));

/** The folder with room.glb, one/ and two/; environment: SURIMI the program, SURIMI_WEB_WORK the folder. */
export async function bakedFolder() {
  const folder = path.resolve(process.env.SURIMI_WEB_WORK);
  if (existsSync(path.join(folder, 'two'))) return folder;
  mkdirSync(folder, { recursive: true });
  copyFileSync(table, path.join(folder, 'areaLightsLTC.bin'));
  const scene = path.join(folder, 'room.glb');
  await writeRoom(scene);
  const bake = (name, ...options) =>
    execFileSync(process.env.SURIMI, ['bake', scene, '-o', path.join(folder, name), '--quality', 'draft', '--quiet', ...options]);
  bake('one', '--size', '256');
  bake('two', '--size', '192', '--atlases', '2');
  return folder;
}
