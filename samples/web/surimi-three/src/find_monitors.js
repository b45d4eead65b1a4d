// SPDX-License-Identifier: Apache-2.0
// Which nodes of a glb are monitors, and the lights that stand for them.
import { Color, Matrix4, RectAreaLight, Vector3 } from 'three';
import { Monitor } from './monitor.js';
import { rectanglesOf } from './rectangles.js';

const channelNames = ['R', 'G', 'B'];

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
  return found.sort((a, b) => (a.channel ?? channelNames.length) - (b.channel ?? channelNames.length));
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

/** extras.monitor decides; tools that drop extras keep names, and those that drop names keep extras. */
function channelOf(node, names) {
  const mark = node.extras?.monitor;
  if (channelNames.includes(mark)) return channelNames.indexOf(mark);
  if (mark !== undefined || node.name === undefined) return null;
  for (const channels of names) if (channels.includes(node.name)) return channels.indexOf(node.name);
  return null;
}

/** EXT_lights_area faces -z, and of a node's scale only the largest part counts, for both sides. */
function areaLightOf(node, json) {
  const light = json.extensions?.EXT_lights_area?.lights?.[node.extensions?.EXT_lights_area?.light];
  if (light?.type !== 'rect') return null;
  const height = light.size ?? 1;
  const color = new Color().setRGB(...(light.color ?? [1, 1, 1]));
  return { width: height * (light.rect?.aspect ?? 1), height, color, intensity: light.intensity ?? 1000 };
}

function makeMonitor(object, node, areaLight, parser) {
  const meshes = screenMeshes(object, parser);
  for (const mesh of meshes) mesh.material = mesh.material.clone(); // it alone changes its colour
  const materials = meshes.map((mesh) => mesh.material);
  const size = node.extras?.monitor_size;
  let rectangles = meshes.flatMap(rectanglesOf);
  if (areaLight !== null) rectangles = [scaledRectangle(object, areaLight.width, areaLight.height, true)];
  else if (rectangles.length === 0 && Array.isArray(size)) rectangles = [scaledRectangle(object, size[0], size[1], false)];
  if (rectangles.some((rectangle) => !rectangle.isExact))
    console.warn(`surimi-three: parts of the monitor "${node.name}" are no rectangles; lights of equal area stand for them`);
  if (node.extras?.monitor_two_sided === true) rectangles.push(...rectangles.map(turned));
  const { color, intensity } = areaLight ?? radianceOf(materials);
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

/** A rectangle in the node's plane of x and y; of light: scaled by the largest part, facing -z, else +z. */
function scaledRectangle(object, width, height, isLight) {
  const x = new Vector3();
  const y = new Vector3();
  const z = new Vector3();
  object.matrixWorld.extractBasis(x, y, z);
  const scales = [x.length(), y.length(), z.length()];
  const largest = Math.max(...scales);
  const [scaleX, scaleY] = isLight ? [largest, largest] : scales;
  x.normalize();
  z.addScaledVector(x, -z.dot(x)).normalize();
  y.crossVectors(z, x);
  const center = new Vector3().setFromMatrixPosition(object.matrixWorld);
  const matrix = new Matrix4().makeBasis(x, y, z).setPosition(center);
  const rectangle = { matrix, width: width * scaleX, height: height * scaleY, isExact: true };
  return isLight ? rectangle : turned(rectangle);
}

/** The same rectangle, facing the other way. */
function turned({ matrix, ...rest }) {
  return { matrix: matrix.clone().multiply(new Matrix4().makeRotationY(Math.PI)), ...rest };
}

function radianceOf(materials) {
  const shining = materials.find((material) => material.emissive);
  return { color: shining?.emissive ?? new Color(1, 1, 1), intensity: shining?.emissiveIntensity ?? 1 };
}

/** The light hangs on the node, so that it moves and hides with the screen. */
function addLight(object, rectangle, color, intensity) {
  const light = new RectAreaLight(color, intensity, rectangle.width, rectangle.height);
  light.matrix.copy(object.matrixWorld).invert().multiply(rectangle.matrix);
  light.matrixAutoUpdate = false;
  object.add(light);
  light.updateMatrixWorld(true);
  return light;
}
