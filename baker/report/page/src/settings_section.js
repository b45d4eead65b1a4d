// SPDX-License-Identifier: Apache-2.0
// What to type to get the same again, and how to tell that it is the same.
import { element, section, table } from './elements.js';
import { bytes } from './numbers.js';

function block(id, title, text) {
  const copy = element('button', { type: 'button', onclick: async () => {
    await navigator.clipboard.writeText(text);
    copy.textContent = 'Copied';
  } }, 'Copy');
  return element('div', { class: 'code' }, element('h3', {}, title), copy, element('pre', { id, tabindex: '0' }, text));
}

function monitorTable({ monitors }) {
  return table('Monitors', ['channel', 'name', 'found by', 'area', 'radiance R, G, B'], monitors.map((monitor) => [
    monitor.channel, monitor.name, monitor.reason, `${Number(monitor.areaSquareMetres.toPrecision(3))} m\u00b2`,
    `${monitor.radiance.map((x) => Number(x.toPrecision(3))).join(', ')} nits`,
  ]));
}

export function settingsSection({ manifest, command, toml, name, program }) {
  return section('settings', 'To get the same again', 'Same scene, same settings, same program on the same instruction set: the same bytes, whatever the number of threads.',
    block('command', 'Command', command), block('toml', `${name}.surimi.toml`, toml), monitorTable(manifest),
    table('Files and their hashes (64-bit FNV-1a)', ['file', 'size', 'hash'], [
      [manifest.scene.file, 'the scene', manifest.scene.hash],
      ...manifest.outputs.map((output) => [output.file, bytes(output.bytes), output.hash])]),
    element('p', { class: 'quiet' }, `Baked by ${manifest.generator}, reported by ${program}. This page loads nothing from elsewhere.`));
}
