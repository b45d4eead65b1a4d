// SPDX-License-Identifier: Apache-2.0
// A baked glb on a stage of three.js, whatever the renderer. `kit` is { three, Plugin, renderer, read(target) }.
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

export const width = 180;
export const height = 120;

export class Stage {
  constructor(kit) {
    this.kit = kit;
    this.target = new kit.three.RenderTarget(width, height, { type: kit.three.FloatType });
  }

  /** Loads the glb with the plugin. */
  async load(file) {
    await this.show(file, new GLTFLoader().register((parser) => new this.kit.Plugin(parser)));
    this.bake = this.gltf.userData.surimi;
    return this;
  }

  /** Loads the glb with three alone, with the same lights as `other`: the picture to be compared with. */
  async loadStock(file, other) {
    await this.show(file, new GLTFLoader());
    const lights = other.bake.lights.map((light) => {
      const copy = new this.kit.three.RectAreaLight(light.color, light.intensity, light.width, light.height);
      copy.matrix.copy(light.matrixWorld);
      copy.matrixAutoUpdate = false;
      this.scene.add(copy);
      return copy;
    });
    for (const { material } of this.screens()) material.visible = false;
    for (const { material } of other.screens()) material.visible = false;
    return lights;
  }

  async show(file, loader) {
    this.gltf = await loader.loadAsync(file);
    this.scene = new this.kit.three.Scene();
    this.scene.add(this.gltf.scene);
    [this.camera] = this.gltf.cameras;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  meshes() {
    const meshes = [];
    this.scene.traverse((object) => object.isMesh && meshes.push(object));
    return meshes;
  }

  screens() {
    return this.meshes().filter((mesh) => mesh.name.startsWith('Monitor'));
  }

  /** The picture as the target holds it: linear, floats, no tone mapping. */
  render() {
    return this.kit.read(this.scene, this.camera, this.target);
  }

  /** The picture with only the lights of one channel on. */
  async renderOnly(lights, channelOf, channel) {
    const intensities = lights.map((light) => light.intensity);
    for (const light of lights) if (channelOf(light) !== channel) light.intensity = 0;
    const image = await this.render();
    lights.forEach((light, i) => (light.intensity = intensities[i]));
    return image;
  }

  /** A map of one colour, linear in [0, 1]. */
  plainMap(...rgb) {
    const { DataTexture, FloatType, RGBAFormat } = this.kit.three;
    const texture = new DataTexture(new Float32Array([...rgb, 1]), 1, 1, RGBAFormat, FloatType);
    texture.needsUpdate = true;
    return texture;
  }

  setMaps(texture) {
    for (const page of this.bake.pages) this.bake.setMap(texture, page.number);
  }
}
