// SPDX-License-Identifier: Apache-2.0
// The baked scene in three.js, lit by its monitors, with and without the map.
import {
  ClampToEdgeWrapping, Color, CustomToneMapping, DataTexture, LinearFilter, PerspectiveCamera, RGBAFormat, Scene,
  ShaderChunk, SRGBColorSpace, UnsignedByteType, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { SurimiPlugin } from 'surimi-three';
import { bytesOf } from './pictures.js';

// The curve of `surimi preview` (Narkowicz 2015), so that both show the same.
const ownCurve = 'vec3 CustomToneMapping( vec3 color ) { return color; }';
const filmic = `vec3 CustomToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return clamp( color * ( 2.51 * color + 0.03 ) / ( color * ( 2.43 * color + 0.59 ) + 0.14 ), 0.0, 1.0 );
}`;

const fromPole = 0.02; // radians

async function unpack(uri) {
  const packed = new Blob([bytesOf(uri)]).stream();
  return new Response(packed.pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

function textureOf({ width, height, data }) {
  const texture = new DataTexture(data, width, height, RGBAFormat, UnsignedByteType);
  texture.colorSpace = SRGBColorSpace;
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
  texture.needsUpdate = true;
  return texture;
}

/** Draws whenever something changed; `maps` are the decoded pictures of the map by page. Throws without WebGL. */
export class LiveView {
  #scene = new Scene();
  #materials = [];
  #isAsked = false;

  constructor(canvas, report) {
    ShaderChunk.tonemapping_pars_fragment = ShaderChunk.tonemapping_pars_fragment.replace(ownCurve, filmic);
    this.report = report;
    this.split = 0.5;
    this.mode = 'both';
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true }); // kept for printing
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.toneMapping = CustomToneMapping;
    this.camera = new PerspectiveCamera((report.view.yfov * 180) / Math.PI, 16 / 9, 0.01, 1000);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.minPolarAngle = fromPole; // seen from straight above, turning would have no direction
    this.controls.maxPolarAngle = Math.PI - fromPole;
    this.controls.addEventListener('change', () => this.draw());
  }

  async load(maps) {
    const loader = new GLTFLoader().register((parser) => new SurimiPlugin(parser));
    const gltf = await loader.parseAsync(await unpack(this.report.scene.glb), '');
    this.bake = gltf.userData.surimi;
    for (const page of this.bake.pages)
      if (maps[page.number]) this.bake.setMap(textureOf(maps[page.number]), page.number);
    const screens = new Set(this.bake.monitors.flatMap((monitor) => monitor.materials));
    gltf.scene.traverse((object) => {
      if (object.isLight && !this.bake.lights.includes(object)) object.visible = false; // a bake is about monitors alone
      for (const material of object.isMesh ? [object.material].flat() : [])
        if (material.roughness !== undefined && !screens.has(material)) this.#materials.push(material);
    });
    this.#materials = [...new Set(this.#materials)].map((material) => ({
      material, roughness: material.roughness, roughnessMap: material.roughnessMap,
    }));
    this.shines = this.bake.monitors.map((monitor) => ({
      monitor, color: monitor.color.clone(), intensity: monitor.intensity, isOn: true, stops: 0,
    }));
    this.#scene.add(gltf.scene);
    this.resetCamera();
  }

  resetCamera() {
    const { eye, forward } = this.report.view;
    this.camera.position.set(...eye);
    const reach = this.#distanceToMonitors(new Vector3(...eye), new Vector3(...forward));
    this.controls.target.set(...eye).addScaledVector(new Vector3(...forward), reach);
    this.controls.update();
    this.draw();
  }

  /** Orbits should turn around something in the room. */
  #distanceToMonitors(eye, forward) {
    const distances = this.bake.lights.map((light) => light.getWorldPosition(new Vector3()).sub(eye).dot(forward));
    return Math.max(1, 0.5 * Math.max(...distances, 2));
  }

  setExposure(stops) {
    this.renderer.toneMappingExposure = this.report.view.exposure * 2 ** stops;
    this.draw();
  }

  /** null: as the scene has it. */
  setRoughness(roughness) {
    for (const own of this.#materials) {
      const map = roughness === null ? own.roughnessMap : null;
      if (own.material.roughnessMap !== map) own.material.needsUpdate = true;
      own.material.roughnessMap = map;
      own.material.roughness = roughness ?? own.roughness;
    }
    this.draw();
  }

  /** A monitor's colour (CSS) and intensity in stops against the scene's, and whether it is on. */
  setMonitor(index, { color, stops, isOn }) {
    const shine = this.shines[index];
    if (color !== undefined) shine.color = new Color(color);
    if (stops !== undefined) shine.stops = stops;
    if (isOn !== undefined) shine.isOn = isOn;
    shine.monitor.setRadiance(shine.color, shine.isOn ? shine.intensity * 2 ** shine.stops : 0);
    this.draw();
  }

  /** 'both': without shadows on the left of `split`, with the map on its right; 'map'; 'none'. */
  setMode(mode) {
    this.mode = mode;
    this.draw();
  }

  setSplit(split) {
    this.split = split;
    this.draw();
  }

  draw() {
    if (this.#isAsked) return;
    this.#isAsked = true;
    requestAnimationFrame(() => {
      this.#isAsked = false;
      this.#drawNow();
    });
  }

  #drawNow() {
    const { clientWidth: width, clientHeight: height } = this.renderer.domElement;
    if (width === 0 || height === 0) return;
    const ratio = this.renderer.getPixelRatio();
    const { width: wide, height: high } = this.renderer.domElement;
    if (wide !== Math.floor(width * ratio) || high !== Math.floor(height * ratio)) this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const border = Math.round(this.split * width);
    if (this.mode !== 'map') this.#drawPart(false, 0, this.mode === 'both' ? border : width);
    if (this.mode !== 'none') this.#drawPart(true, this.mode === 'both' ? border : 0, width);
    this.renderer.domElement.dispatchEvent(new Event('drawn'));
  }

  #drawPart(withMap, left, right) {
    if (right <= left) return;
    this.bake.enabled = withMap;
    this.renderer.setScissorTest(true);
    this.renderer.setScissor(left, 0, right - left, this.renderer.domElement.clientHeight);
    this.renderer.render(this.#scene, this.camera);
  }
}
