// SPDX-License-Identifier: Apache-2.0
// A part of a PBR material's shader: multiplies each area light by its channel of the map.
import { MaterialPluginBase } from '@babylonjs/core/Materials/materialPluginBase.js';
import { ShaderStore } from '@babylonjs/core/Engines/shaderStore.js';
import { RectAreaLight } from '@babylonjs/core/Lights/rectAreaLight.js';

const mostLights = 16; // of a material: masks in the uniform buffer
const masks = [...Array(mostLights).keys()].map((i) => `visibilityMask${i}`);
const unshadowed = [0, 0, 0, 1];
const arguments_ = 'clearcoatOut.specularEnvironmentR0,reflectivityOut.colorReflectanceF90';
const diffuseCall = 'info.diffuse=computeAreaDiffuseLighting(preInfo,diffuse{X}.rgb);';
const specularCall = `info.specular=computeAreaSpecularLighting(preInfo,light{X}.vLightSpecular.rgb,${arguments_});`;

/** The pattern of a call in the shader, in which {X} is the light's number, for the plugin manager. */
function patternOf(call) {
  return `!${call.replace(/[.()]/g, '\\$&').replace('{X}', '(\\d+)')}`;
}

function checkShader() {
  const shader = ShaderStore.IncludesShadersStore.lightFragment;
  for (const call of [diffuseCall, specularCall])
    if (shader !== undefined && !shader.includes(call))
      throw new Error(
        `surimi-babylon: Babylon's shader of lights does not have "${call}", so the map cannot be applied; use a ` +
          'version of surimi-babylon that knows this Babylon, or one of Babylon that it names as peer',
      );
}

export class VisibilityPlugin extends MaterialPluginBase {
  /**
   * `placement` is the texture as the file puts it on this very material: which UVs read it, and how they are
   * transformed. texture null: nothing but the monitor `own` is masked.
   */
  constructor(material, bake, { texture, placement, own }) {
    super(material, 'SurimiVisibility', 200, { SURIMI_VISIBILITY: false, SURIMI_ENCODED: false });
    this.bake = bake;
    this.texture = texture;
    this.placement = placement;
    this.own = own;
    this.isOn = true;
    this.registerForExtraEvents = true; // masks are of the mesh, not of the material
    this.doNotSerialize = true;
    material.maxSimultaneousLights = mostLights; // four panels and a lamp are more than the four of Babylon
    this._enable(true);
    this.markAllDefinesAsDirty();
  }

  getClassName() {
    return 'SurimiVisibilityPlugin';
  }

  setTexture(texture) {
    this.texture = texture;
    this.markAllDefinesAsDirty();
  }

  /** The material's shader is Babylon's again. */
  dispose() {
    this.isOn = false;
    this.texture = null;
    this.markAllDefinesAsDirty();
  }

  prepareDefinesBeforeAttributes(defines) {
    defines.SURIMI_VISIBILITY = this.isOn;
    defines.SURIMI_ENCODED = this.texture?.gammaSpace ?? false;
    if (!this.isOn || this.texture === null) return;
    defines._needUVs = true;
    defines[`MAINUV${this.placement.coordinatesIndex + 1}`] = true;
  }

  isReadyForSubMesh() {
    return this.texture === null || this.texture.isReadyOrNotBlocking();
  }

  getSamplers(samplers) {
    if (this.texture !== null) samplers.push('visibilitySampler');
  }

  getActiveTextures(textures) {
    if (this.texture !== null) textures.push(this.texture);
  }

  hasTexture(texture) {
    return this.texture === texture;
  }

  getUniforms() {
    const uniforms = [...masks.map((mask) => [mask, 4, 'vec4']), ['visibilityMatrix', 16, 'mat4']];
    return {
      ubo: uniforms.map(([uniform, size, type]) => ({ name: uniform, size, type })),
      fragment: uniforms.map(([uniform, , type]) => `uniform ${type} ${uniform};`).join('\n'),
    };
  }

  hardBindForSubMesh(uniforms, scene, engine, subMesh) {
    if (!this.isOn) return;
    const lights = subMesh.getMesh().lightSources;
    masks.forEach((mask, i) => {
      const isArea = lights[i] instanceof RectAreaLight;
      uniforms.updateFloat4(mask, ...(isArea ? this.bake.maskOf(lights[i], this.own) : unshadowed));
    });
    if (this.texture === null) return;
    uniforms.updateMatrix('visibilityMatrix', this.placement.getTextureMatrix());
    uniforms.setTexture('visibilitySampler', this.texture);
  }

  getCustomCode(shaderType) {
    if (shaderType !== 'fragment') return null;
    checkShader();
    const hasMap = this.texture !== null;
    const coordinates = `visibilityMatrix*vec4(vMainUV${(this.placement?.coordinatesIndex ?? 0) + 1},1.0,0.0)`;
    const fetched = `vec3 surimiCode=texture2D(visibilitySampler,vec2(${coordinates})).rgb;`;
    const decoded = '#ifdef SURIMI_ENCODED\nsurimiCode=toLinearSpace(surimiCode);\n#endif';
    const read = `${fetched}\n${decoded}\nvec4 surimiVisibility=vec4(surimiCode,1.0);`;
    const guarded = (call, dimmed) => `#ifdef SURIMI_VISIBILITY\n${dimmed}\n#else\n${call.replace('{X}', '$1')}\n#endif`;
    // Babylon's own mixes F0 and F90 by the light's colour, which goes below 0 for lights above 1 nit.
    const specular = specularCall.replace('computeArea', 'computeOpenPBRArea').replace('{X}', '$1');
    const dim = 'dot(surimiVisibility,visibilityMask$1);';
    return {
      CUSTOM_FRAGMENT_DEFINITIONS: hasMap ? '#ifdef SURIMI_VISIBILITY\nuniform sampler2D visibilitySampler;\n#endif' : '',
      CUSTOM_FRAGMENT_BEFORE_LIGHTS: `#ifdef SURIMI_VISIBILITY\n${hasMap ? read : 'vec4 surimiVisibility=vec4(0.0,0.0,0.0,1.0);'}\n#endif`,
      [patternOf(diffuseCall)]: guarded(diffuseCall, `${diffuseCall.replace('{X}', '$1')}info.diffuse*=${dim}`),
      [patternOf(specularCall)]: guarded(specularCall, `${specular}info.specular*=${dim}`),
    };
  }
}
