// SPDX-License-Identifier: Apache-2.0
// Babylon.js: baked glbs light their rooms as they are loaded.
import { registerGLTFExtension } from '@babylonjs/loaders/glTF/2.0/glTFLoaderExtensionRegistry.js';
import { SurimiExtension, name } from './src/loader_extension.js';

/** Call once, before loading: from now on the glTF loader reads what `surimi bake` wrote. */
export function registerSurimi() {
  registerGLTFExtension(name, false, (loader) => new SurimiExtension(loader));
}

export { Bake } from './src/bake.js';
export { Monitor } from './src/monitor.js';
export { bakeOf } from './src/loader_extension.js';
export { loadLtc } from './src/load_ltc.js';
