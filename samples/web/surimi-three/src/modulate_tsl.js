// SPDX-License-Identifier: Apache-2.0
// WebGPURenderer: RectAreaLights that ask the material whose surface they light for its map.
import { RectAreaLightNode, Vector4 } from 'three/webgpu';
import { dot, texture as textureNode, uniform, uv, vec3, vec4 } from 'three/tsl';

/** As three's own, but for materials that a bake has to do with. */
export class VisibilityRectAreaLightNode extends RectAreaLightNode {
  static get type() {
    return 'VisibilityRectAreaLightNode';
  }

  setupDirectRectArea(builder) {
    const data = super.setupDirectRectArea(builder);
    const visibilityOf = builder.material.surimiVisibilityOf;
    if (!visibilityOf) return data;
    return { ...data, lightColor: data.lightColor.mul(visibilityOf(this.light)) };
  }
}

let modulationCount = 0;

/** Where a texture is read by the material that it belongs to. */
function coordinatesOf(placement) {
  if (placement.matrixAutoUpdate) placement.updateMatrix();
  return uniform(placement.matrix).mul(vec3(uv(placement.channel), 1)).xy;
}

/** See readBake. Nodes hold the texture, since three looks for changes of a material's nodes, not of other properties. */
export function modulateForNodes(material, bake, { texture, placement, own }) {
  const mapNode = texture === null ? null : textureNode(texture, coordinatesOf(placement));
  const map = mapNode === null ? vec4(0, 0, 0, 1) : vec4(mapNode.rgb, 1);
  const masks = new WeakMap();
  const maskNodeOf = (light) => {
    if (!masks.has(light)) {
      const mask = uniform(new Vector4());
      mask.onRenderUpdate(() => mask.value.fromArray(bake.maskOf(light, own)));
      masks.set(light, mask);
    }
    return masks.get(light);
  };
  const { customProgramCacheKey } = material;
  const number = ++modulationCount; // materials with the same key would share one map
  material.visibilityNode = mapNode;
  material.surimiVisibilityOf = (light) => dot(map, maskNodeOf(light));
  material.customProgramCacheKey = () => `${customProgramCacheKey.call(material)} surimi ${number}`;
  material.needsUpdate = true;
  return {
    setTexture(next) {
      mapNode.value = next;
    },
    dispose() {
      delete material.visibilityNode;
      delete material.surimiVisibilityOf;
      material.customProgramCacheKey = customProgramCacheKey;
      material.needsUpdate = true;
    },
  };
}
