// SPDX-License-Identifier: Apache-2.0
// The baked room after other people's tools: tools/NAME.glb.
import { execFileSync } from 'node:child_process';
import { copyFileSync, existsSync, mkdirSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { bakedFolder } from './bakes.mjs';

const programs = path.join(path.dirname(fileURLToPath(import.meta.url)), '..', 'node_modules', '.bin');
const runs = {
  copy: ['gltf-transform', (from, to) => ['copy', from, to]],
  optimize: ['gltf-transform', (from, to) =>
    ['optimize', from, to, '--texture-compress', 'false', '--compress', 'false', '--join', 'false', '--prune-attributes', 'false',
      '--simplify', 'false', '--palette', 'false']],
  prune: ['gltf-transform', (from, to) => // then some materials read the map by TEXCOORD_0, others by TEXCOORD_1
    ['optimize', from, to, '--texture-compress', 'false', '--compress', 'false', '--join', 'false', '--simplify', 'false',
      '--palette', 'false']],
  gltfpack: ['gltfpack', (from, to) => ['-kn', '-km', '-ke', '-vtf', '-noq', '-i', from, '-o', to]],
};

/** The folder; `tools/original.glb` is the bake itself. */
export async function toolFolder() {
  const folder = path.join(await bakedFolder(), 'tools');
  if (existsSync(folder)) return folder;
  mkdirSync(folder);
  const original = path.join(folder, 'original.glb');
  copyFileSync(path.join(folder, '..', 'one', 'room.baked.glb'), original);
  for (const [name, [program, options]] of Object.entries(runs))
    execFileSync(path.join(programs, program), options(original, path.join(folder, `${name}.glb`)), { stdio: 'pipe' });
  return folder;
}

export const tools = Object.keys(runs);
