// SPDX-License-Identifier: Apache-2.0
// A monitor: a screen that is seen, and the area lights that stand for it.

export class Monitor {
  /** `materials` are those of the screen, its own alone, so that colours can be changed. */
  constructor(name, node, materials, lights) {
    this.name = name;
    this.node = node;
    this.materials = materials;
    this.lights = lights;
  }

  /** Linear colour of the light; radiance is color * intensity, in nits. */
  get color() {
    return this.lights[0].diffuse;
  }

  get intensity() {
    return this.lights[0].intensity;
  }

  /** What the lights shine with and the screens show. Only radiance changes, so the map stays right. */
  setRadiance(color, intensity) {
    for (const light of this.lights) {
      light.diffuse = color.clone();
      light.specular = color.clone();
      light.intensity = intensity;
    }
    for (const material of this.materials) {
      material.emissiveColor = color.clone();
      material.emissiveIntensity = intensity;
    }
  }

  /** Takes the lights out of the scene; the screen stays. */
  dispose() {
    for (const light of this.lights) light.parent.dispose(); // the node that carries it, and it
    this.lights = [];
  }
}
