// SPDX-License-Identifier: Apache-2.0
// Shows a baked glb in Babylon.js; the monitors are its only light.
import { Engine } from '@babylonjs/core/Engines/engine.js';
import { ImportMeshAsync } from '@babylonjs/core/Loading/sceneLoader.js';
import { Scene } from '@babylonjs/core/scene.js';
import '@babylonjs/core/Helpers/sceneHelpers.js';
import '@babylonjs/loaders/glTF/2.0/index.js';
import { bakeOf, loadLtc, registerSurimi } from 'surimi-babylon';
import table from 'surimi-babylon/areaLightsLTC.bin';

const [canvas, file, shadows] = ['canvas', 'file', 'shadows'].map((id) => document.getElementById(id));
const engine = new Engine(canvas, true);
registerSurimi();

async function show(source) {
  const scene = new Scene(engine);
  await loadLtc(scene, `built/${table}`);
  const { meshes } = await ImportMeshAsync(source, scene);
  const bake = bakeOf(meshes[0]);
  if (scene.cameras.length === 0) scene.createDefaultCamera(true, true);
  [scene.activeCamera] = scene.cameras;
  scene.activeCamera.attachControl(canvas);
  engine.stopRenderLoop();
  engine.runRenderLoop(() => {
    engine.resize();
    if (bake) bake.enabled = shadows.checked;
    scene.render();
  });
}

file.addEventListener('change', () => show(file.files[0]));
