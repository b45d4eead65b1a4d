// SPDX-License-Identifier: Apache-2.0
// The two textures that ltc_textures writes -> the file that Babylon.js loads: eight half floats a texel.
//   node ltc_halves.mjs LTC_TEXTURES_OUTPUT ../../samples/web/surimi-babylon/areaLightsLTC.bin
import { readFileSync, writeFileSync } from 'node:fs';
import process from 'node:process';
import { DataUtils } from 'three';

/** Bytes in, bytes out. */
export function asHalves(bytes) {
  const floats = new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length / 4);
  const halves = new Uint16Array(floats.length);
  for (let i = 0; i < floats.length / 8; ++i)
    for (let k = 0; k < 8; ++k)
      halves[8 * i + k] = DataUtils.toHalfFloat(floats[k < 4 ? 4 * i + k : floats.length / 2 + 4 * i + k - 4]);
  return Buffer.from(halves.buffer);
}

if (process.argv.length === 4) writeFileSync(process.argv[3], asHalves(readFileSync(process.argv[2])));
