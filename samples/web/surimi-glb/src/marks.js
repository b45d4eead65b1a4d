// SPDX-License-Identifier: Apache-2.0
// What nodes and materials of a baked glb are marked with.

const channelNames = ['R', 'G', 'B'];

/** extras.visibilityMap of a material's extras where it names channels; null: nothing was baked for the material. */
export function noteOf(extras) {
  const note = extras?.visibilityMap;
  if (typeof note === 'string')
    console.warn('surimi: another tool made a text of a mark, so the map is lost; bake the scene again');
  return Array.isArray(note?.channels) ? note : null;
}

/**
 * The channel of a node of the JSON that is a monitor, null for others. extras.monitor decides; tools that drop extras
 * keep names, and those that drop names keep extras. `names` are the lists of channels of the materials.
 */
export function channelOf(node, names) {
  const mark = node.extras?.monitor;
  if (channelNames.includes(mark)) return channelNames.indexOf(mark);
  if (mark !== undefined || !node.name) return null; // unused channels have no name either
  for (const channels of names) if (channels.includes(node.name)) return channels.indexOf(node.name);
  return null;
}

/** The rectangle of EXT_lights_area on a node: { width, height, color: [r, g, b], intensity in nits }, or null. */
export function areaLightOf(node, json) {
  const light = json.extensions?.EXT_lights_area?.lights?.[node.extensions?.EXT_lights_area?.light];
  if (light?.type !== 'rect') return null;
  const height = light.size ?? 1;
  const width = height * (light.rect?.aspect ?? 1);
  return { width, height, color: light.color ?? [1, 1, 1], intensity: light.intensity ?? 1000 };
}
