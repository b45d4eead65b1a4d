// SPDX-License-Identifier: Apache-2.0
// Is a baked glb as valid as the scene that it came from? Khronos' validator judges both.
//   node validate_glb.mjs INPUT OUTPUT [INPUT OUTPUT ...]
// Exits 1 when an output has an error, or a kind of warning, that its input did not have. What compression hid from the
// validator counts as the input's: it cannot look into meshopt or Draco, but it can once we have decoded them.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import process from 'node:process';
import validator from 'gltf-validator';

const severityError = 0;
const severityWarning = 1;
const compressions = ['EXT_meshopt_compression', 'KHR_meshopt_compression', 'KHR_draco_mesh_compression'];

async function validate(file) {
  const folder = path.dirname(file);
  return validator.validateBytes(new Uint8Array(readFileSync(file)), {
    uri: path.basename(file),
    maxIssues: 0, // no limit
    externalResourceFunction: async (uri) => new Uint8Array(readFileSync(path.join(folder, decodeURIComponent(uri)))),
  });
}

/** Code -> the messages with it. */
function byCode(report, severity) {
  const codes = new Map();
  for (const message of report.issues.messages) {
    if (message.severity !== severity) continue;
    if (!codes.has(message.code)) codes.set(message.code, []);
    codes.get(message.code).push(message);
  }
  return codes;
}

function isHidden(message, input) {
  const isAboutData = /^\/accessors\//.test(message.pointer ?? '') && message.code.startsWith('ACCESSOR_');
  return isAboutData && (input.info.extensionsUsed ?? []).some((name) => compressions.includes(name));
}

/** The complaints about the output that are not the input's. */
function newComplaints(input, output) {
  const complaints = [];
  for (const severity of [severityError, severityWarning]) {
    const known = byCode(input, severity);
    for (const [code, messages] of byCode(output, severity)) {
      if (known.has(code)) continue;
      complaints.push(...messages.filter((message) => !isHidden(message, input)));
    }
  }
  return complaints;
}

const files = process.argv.slice(2);
if (files.length === 0 || files.length % 2 !== 0) {
  console.error('usage: node validate_glb.mjs INPUT OUTPUT [INPUT OUTPUT ...]');
  process.exit(2);
}
let failed = 0;
for (let i = 0; i < files.length; i += 2) {
  const [input, output] = await Promise.all([validate(files[i]), validate(files[i + 1])]);
  const complaints = newComplaints(input, output);
  const count = (report) => `${report.issues.numErrors} errors, ${report.issues.numWarnings} warnings`;
  console.log(`${complaints.length === 0 ? 'ok  ' : 'FAIL'} ${files[i + 1]}: ${count(output)} (input: ${count(input)})`);
  for (const { code, message, pointer } of complaints.slice(0, 20)) console.log(`     ${code} ${pointer}: ${message}`);
  if (complaints.length > 20) console.log(`     ... and ${complaints.length - 20} more`);
  if (complaints.length > 0) ++failed;
}
console.log(`${files.length / 2 - failed} passed, ${failed} failed`);
process.exit(failed > 0 ? 1 : 0);
