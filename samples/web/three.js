// SPDX-License-Identifier: Apache-2.0
// Shows a baked glb in three.js; the monitors are its only light.
import { ACESFilmicToneMapping, PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { SurimiPlugin } from 'surimi-three';

const [canvas, file, shadows] = ['canvas', 'file', 'shadows'].map((id) => document.getElementById(id));
const renderer = new WebGLRenderer({ canvas, antialias: true });
renderer.toneMapping = ACESFilmicToneMapping;
const loader = new GLTFLoader().register((parser) => new SurimiPlugin(parser));

async function show(url) {
  const gltf = await loader.loadAsync(url);
  const scene = new Scene().add(gltf.scene);
  const camera = gltf.cameras[0] ?? new PerspectiveCamera(50);
  if (!gltf.cameras[0]) camera.position.set(0, 1.6, 3);
  const controls = new OrbitControls(camera, canvas);
  camera.getWorldDirection(controls.target).multiplyScalar(3).add(camera.position);
  renderer.setAnimationLoop(() => {
    renderer.setSize(innerWidth, innerHeight, false);
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
    controls.update();
    gltf.userData.surimi.enabled = shadows.checked;
    renderer.render(scene, camera);
  });
}

file.addEventListener('change', () => show(URL.createObjectURL(file.files[0])));
