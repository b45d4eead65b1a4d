// SPDX-License-Identifier: Apache-2.0
// Which nodes of a loaded glTF are monitors, and the lights that stand for them.
import { RectAreaLight } from '@babylonjs/core/Lights/rectAreaLight.js';
import { Color3 } from '@babylonjs/core/Maths/math.color.js';
import { Matrix, Quaternion, Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { TransformNode } from '@babylonjs/core/Meshes/transformNode.js';
import { channelOf, rectanglesOf, scaledRectangle, turned } from 'surimi-glb';
import { Monitor } from './monitor.js';

const last = 3; // in the order of channels: what has none

/** [{ monitor, channel }] of all nodes that extras.monitor marks or that the maps name; Babylon reads EXT_lights_area. */
export function findMonitors(gltf, scene, names) {
  const found = [];
  for (const node of gltf.nodes ?? []) {
    const channel = channelOf(node, names);
    if (channel === null || !node._babylonTransformNode) continue;
    const monitor = makeMonitor(node, scene);
    if (monitor.lights.length > 0) found.push({ monitor, channel });
    else console.warn(`surimi-babylon: the monitor "${node.name}" has no surface to shine from`);
  }
  return found.sort((a, b) => (a.channel ?? last) - (b.channel ?? last));
}

function makeMonitor(node, scene) {
  const object = node._babylonTransformNode;
  const world = object.computeWorldMatrix(true);
  const own = scene.lights.filter((light) => light instanceof RectAreaLight && light.parent?.parent === object);
  const meshes = screenMeshes(node, object);
  for (const mesh of meshes) mesh.material = mesh.material.clone(`${mesh.material.name} of ${object.name}`);
  const materials = meshes.map((mesh) => mesh.material);
  if (own.length > 0) return new Monitor(object.name, object, materials, own); // EXT_lights_area
  const size = node.extras?.monitor_size;
  let rectangles = meshes.flatMap(rectanglesOfMesh);
  if (rectangles.length === 0 && Array.isArray(size)) rectangles = [scaledRectangle(world.asArray(), ...size, false)];
  if (rectangles.some((rectangle) => !rectangle.isExact))
    console.warn(`surimi-babylon: parts of the monitor "${node.name}" are no rectangles; lights of equal area stand for them`);
  if (node.extras?.monitor_two_sided === true) rectangles.push(...rectangles.map(turned));
  const { emissiveColor: color = Color3.White(), emissiveIntensity: intensity = 1 } = materials[0] ?? {};
  const lights = rectangles.map((rectangle) => addLight(object, rectangle, scene));
  const monitor = new Monitor(object.name, object, materials, lights);
  if (lights.length > 0) monitor.setRadiance(color, intensity);
  return monitor;
}

/** The node's own meshes, else those below it; where some shine, only those. */
function screenMeshes(node, object) {
  const own = (node._primitiveBabylonMeshes ?? []).filter((mesh) => mesh.material);
  const meshes = own.length > 0 ? own : object.getChildMeshes().filter((mesh) => mesh.material);
  const shining = meshes.filter(({ material }) => material.emissiveColor && !material.emissiveColor.equals(Color3.Black()));
  return shining.length > 0 ? shining : meshes;
}

function rectanglesOfMesh(mesh) {
  const positions = mesh.getVerticesData('position');
  const indices = mesh.getIndices() ?? [];
  const corners = indices.length > 0 ? indices : [...Array(positions.length / 3).keys()];
  const position = (vertex) => [...positions.slice(3 * vertex, 3 * vertex + 3)];
  return rectanglesOf(position, corners, mesh.computeWorldMatrix(true).asArray());
}

/** The light hangs on the node, so that it moves and hides with the screen. Babylon's matrices act from the right. */
function addLight(object, rectangle, scene) {
  const carrier = new TransformNode(`${object.name}_light`, scene);
  carrier.parent = object;
  const local = Matrix.FromArray(rectangle.matrix).multiply(Matrix.Invert(object.getWorldMatrix()));
  carrier.rotationQuaternion = new Quaternion();
  local.decompose(carrier.scaling, carrier.rotationQuaternion, carrier.position);
  const light = new RectAreaLight(object.name, Vector3.Zero(), rectangle.width, rectangle.height, scene);
  light.parent = carrier;
  return light;
}
