// SPDX-License-Identifier: Apache-2.0
// WebGLRenderer: a material whose shader multiplies each RectAreaLight by its channel of the map.
import { Matrix3, REVISION, ShaderChunk } from 'three';

const declaration = 'RectAreaLight rectAreaLight;';
const call = 'RE_Direct_RectArea( rectAreaLight,';
const vertexParts = ['#include <common>', '#include <uv_vertex>'];
const fragmentParts = ['#include <lights_pars_begin>', '#include <lights_fragment_begin>'];

/** See readBake. The material's own onBeforeCompile and onBeforeRender stay in force. */
export function modulateForWebGL(material, bake, { texture, placement, own }) {
  const set = placement?.channel ?? null;
  const uniforms = {
    visibilityMap: { value: texture },
    visibilityTransform: { value: new Matrix3() },
    visibilityMask: { value: [] },
  };
  const { onBeforeCompile, onBeforeRender, customProgramCacheKey } = material;
  material.onBeforeCompile = (shader, renderer) => {
    onBeforeCompile.call(material, shader, renderer);
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = set === null ? shader.vertexShader : passCoordinates(shader.vertexShader, set);
    shader.fragmentShader = dimLights(shader.fragmentShader, set !== null);
  };
  material.onBeforeRender = (renderer, scene, camera, geometry, object, group) => {
    onBeforeRender.call(material, renderer, scene, camera, geometry, object, group);
    const lights = lightsInOrder(renderer, scene.children.length > 0 ? scene : topOf(object), camera);
    uniforms.visibilityMask.value = lights.flatMap((light) => bake.maskOf(light, own));
    if (placement === null) return;
    if (placement.matrixAutoUpdate) placement.updateMatrix();
    uniforms.visibilityTransform.value.copy(placement.matrix);
  };
  material.customProgramCacheKey = () =>
    `${customProgramCacheKey.call(material)} surimi ${set ?? 'own'}`;
  material.needsUpdate = true;
  return {
    setTexture(next) {
      uniforms.visibilityMap.value = next;
    },
    dispose() {
      Object.assign(material, { onBeforeCompile, onBeforeRender, customProgramCacheKey });
      material.needsUpdate = true;
    },
  };
}

function replaceOnce(source, part, replacement) {
  if (source.split(part).length !== 2)
    throw new Error(
      `surimi-three: the shader of three r${REVISION} does not have "${part}" in one place, so the map cannot be ` +
        'applied; use a version of surimi-three that knows this three, or one of three that it names as peer',
    );
  return source.replace(part, replacement);
}

/** three declares the attributes of further sets only where its own maps read them. */
function passCoordinates(source, set) {
  const attribute = set === 0 ? 'uv' : `uv${set}`;
  const own = set === 0 ? '' : `#ifndef USE_UV${set}\n\tattribute vec2 ${attribute};\n#endif\n`;
  const [common, begin] = vertexParts;
  const declared = replaceOnce(source, common, `${common}\nuniform mat3 visibilityTransform;\nvarying vec2 vVisibilityUv;\n${own}`);
  return replaceOnce(declared, begin, `${begin}\nvVisibilityUv = ( visibilityTransform * vec3( ${attribute}, 1.0 ) ).xy;`);
}

function dimLights(source, hasMap) {
  const [parameters, lights] = fragmentParts;
  const map = hasMap ? 'varying vec2 vVisibilityUv;\nuniform sampler2D visibilityMap;\n' : '';
  const mask = '#if NUM_RECT_AREA_LIGHTS > 0\n\tuniform vec4 visibilityMask[ NUM_RECT_AREA_LIGHTS ];\n#endif';
  const read = hasMap ? 'vec4( texture2D( visibilityMap, vVisibilityUv ).rgb, 1.0 )' : 'vec4( 0.0, 0.0, 0.0, 1.0 )';
  const looped = replaceOnce(ShaderChunk.lights_fragment_begin, declaration, `${declaration}\n\tvec4 visibility = ${read};`);
  const dimmed = replaceOnce(looped, call, `rectAreaLight.color *= dot( visibility, visibilityMask[ i ] );\n\t\t${call}`);
  const declared = replaceOnce(source, parameters, `${parameters}\n${map}${mask}`);
  return replaceOnce(declared, lights, dimmed);
}

function topOf(object) {
  while (object.parent !== null) object = object.parent;
  return object;
}

/** The last answer of each renderer: materials ask once for each object, but lights change between frames only. */
const lastOrders = new WeakMap();

/** The RectAreaLights as the renderer numbers them: those it sees, in the order of the scene, shadow casters first. */
function lightsInOrder(renderer, root, camera) {
  const { frame } = renderer.info.render;
  const last = lastOrders.get(renderer);
  if (last?.frame === frame && last.root === root && last.camera === camera) return last.lights;
  const lights = [];
  root.traverseVisible((object) => {
    if (object.isRectAreaLight && object.layers.test(camera.layers)) lights.push(object);
  });
  lights.sort((a, b) => Number(b.castShadow) - Number(a.castShadow));
  lastOrders.set(renderer, { frame, root, camera, lights });
  return lights;
}
