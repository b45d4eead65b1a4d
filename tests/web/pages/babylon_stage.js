// SPDX-License-Identifier: Apache-2.0
// A baked glb on a stage of Babylon.js.
import { Engine } from '@babylonjs/core/Engines/engine.js';
import { ImportMeshAsync } from '@babylonjs/core/Loading/sceneLoader.js';
import { RawTexture } from '@babylonjs/core/Materials/Textures/rawTexture.js';
import { RenderTargetTexture } from '@babylonjs/core/Materials/Textures/renderTargetTexture.js';
import { Color4 } from '@babylonjs/core/Maths/math.color.js';
import { Scene } from '@babylonjs/core/scene.js';
import '@babylonjs/loaders/glTF/2.0/index.js';
import { bakeOf, loadLtc, registerSurimi } from 'surimi-babylon';

export const width = 180;
export const height = 120;
const floats = 1; // Constants.TEXTURETYPE_FLOAT
const nearest = 1;

registerSurimi();
const canvas = Object.assign(document.createElement('canvas'), { width, height });
const engine = new Engine(canvas, false);

export class Stage {
  async load(file) {
    this.scene = new Scene(engine);
    this.scene.clearColor = new Color4(0, 0, 0, 1);
    this.scene.imageProcessingConfiguration.applyByPostProcess = true; // leaves the picture linear
    await loadLtc(this.scene, '/areaLightsLTC.bin');
    const result = await ImportMeshAsync(file, this.scene);
    this.meshes = result.meshes;
    this.bake = bakeOf(result.meshes[0]);
    [this.scene.activeCamera] = this.scene.cameras;
    this.target = new RenderTargetTexture('target', { width, height }, this.scene, {
      generateMipMaps: false, type: floats, samplingMode: nearest,
    });
    this.target.renderList = this.meshes;
    this.scene.customRenderTargets.push(this.target);
    this.target.activeCamera = this.scene.activeCamera;
    return this;
  }

  screens() {
    return this.meshes.filter((mesh) => mesh.name.startsWith('Monitor'));
  }

  async render() {
    for (let tries = 0; !(this.scene.isReady(true) && this.target.isReadyForRendering()); ++tries) {
      if (tries > 500) throw new Error('the scene does not get ready');
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
    this.scene.render(); // uniforms of lights are written once a frame
    return new Float32Array((await this.target.readPixels()).buffer);
  }

  async renderOnly(channel) {
    const { lights } = this.bake;
    const intensities = lights.map((light) => light.intensity);
    for (const light of lights) if (this.bake.channelOf(light) !== channel) light.intensity = 0;
    const image = await this.render();
    lights.forEach((light, i) => (light.intensity = intensities[i]));
    return image;
  }

  plainMap(...rgb) {
    const data = new Float32Array([...rgb, 1]);
    const texture = RawTexture.CreateRGBATexture(data, 1, 1, this.scene, false, false, nearest, floats);
    texture.gammaSpace = false;
    return texture;
  }

  setMaps(texture) {
    for (const page of this.bake.pages) this.bake.setMap(texture, page.number);
  }

  /** The shaders are Babylon's own from here on. */
  useStock() {
    for (const { material } of this.meshes) material?.pluginManager?.getPlugin('SurimiVisibility')?.dispose();
  }
}
