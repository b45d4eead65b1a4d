// SPDX-License-Identifier: Apache-2.0
// Which nodes of a glb are monitors, and the lights that stand for them.
import { Color, Matrix4, RectAreaLight, Vector3 } from 'three';
import { areaLightOf, channelOf, rectanglesOf, scaledRectangle, turned } from 'surimi-glb';
import { Monitor } from './monitor.js';

const last = 3; // in the order of channels: what has none

/**
 * [{ monitor, channel }] of all nodes that extras.monitor marks or that the maps name, and of the other rectangles of
 * EXT_lights_area (channel null). `names` are the lists of channels of the materials. Matrices must be up to date.
 */
export function findMonitors(scenes, parser, names) {
  const found = [];
  for (const { object, index } of nodesOf(scenes, parser)) {
    const node = parser.json.nodes[index];
    const channel = channelOf(node, names);
    const areaLight = areaLightOf(node, parser.json);
    if (channel === null && areaLight === null) continue;
    const monitor = makeMonitor(object, node, areaLight, parser);
    if (monitor.lights.length > 0) found.push({ monitor, channel });
    else console.warn(`surimi-three: the monitor "${node.name}" has no surface to shine from`);
  }
  return found.sort((a, b) => (a.channel ?? last) - (b.channel ?? last));
}

function nodesOf(scenes, parser) {
  const nodes = [];
  for (const scene of scenes)
    scene.traverse((object) => {
      const index = parser.associations.get(object)?.nodes;
      if (index !== undefined) nodes.push({ object, index });
    });
  return nodes;
}

function makeMonitor(object, node, areaLight, parser) {
  const meshes = screenMeshes(object, parser);
  for (const mesh of meshes) mesh.material = mesh.material.clone(); // it alone changes its colour
  const materials = meshes.map((mesh) => mesh.material);
  const size = node.extras?.monitor_size;
  let rectangles = meshes.flatMap(rectanglesOfMesh);
  if (areaLight !== null) rectangles = [scaledRectangle(object.matrixWorld.elements, areaLight.width, areaLight.height, true)];
  else if (rectangles.length === 0 && Array.isArray(size)) rectangles = [scaledRectangle(object.matrixWorld.elements, ...size, false)];
  if (rectangles.some((rectangle) => !rectangle.isExact))
    console.warn(`surimi-three: parts of the monitor "${node.name}" are no rectangles; lights of equal area stand for them`);
  if (node.extras?.monitor_two_sided === true) rectangles.push(...rectangles.map(turned));
  const { color, intensity } = areaLight ? { ...areaLight, color: new Color(...areaLight.color) } : radianceOf(materials);
  const lights = rectangles.map((rectangle) => addLight(object, rectangle, color, intensity));
  return new Monitor(node.name ?? object.name, object, materials, lights);
}

/** The node's own meshes, else those below it; where some shine, only those. */
function screenMeshes(object, parser) {
  const isOwn = (mesh) => mesh === object || (mesh.parent === object && !('nodes' in (parser.associations.get(mesh) ?? {})));
  const all = [];
  object.traverse((mesh) => {
    if (mesh.isMesh) all.push(mesh);
  });
  const own = all.filter(isOwn);
  const meshes = own.length > 0 ? own : all;
  const shining = meshes.filter((mesh) => mesh.material.emissive && mesh.material.emissive.getHex() !== 0);
  return shining.length > 0 ? shining : meshes;
}

function rectanglesOfMesh({ geometry: { index, attributes }, matrixWorld }) {
  const indices = index ? index.array : [...Array(attributes.position.count).keys()];
  const position = (vertex) => new Vector3().fromBufferAttribute(attributes.position, vertex).toArray();
  return rectanglesOf(position, indices, matrixWorld.elements);
}

function radianceOf(materials) {
  const shining = materials.find((material) => material.emissive);
  return { color: shining?.emissive ?? new Color(1, 1, 1), intensity: shining?.emissiveIntensity ?? 1 };
}

/** The light hangs on the node, so that it moves and hides with the screen. */
function addLight(object, rectangle, color, intensity) {
  const light = new RectAreaLight(color, intensity, rectangle.width, rectangle.height);
  light.matrix.copy(object.matrixWorld).invert().multiply(new Matrix4().fromArray(rectangle.matrix));
  light.matrixAutoUpdate = false;
  object.add(light);
  light.updateMatrixWorld(true);
  return light;
}
