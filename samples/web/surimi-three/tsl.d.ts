// SPDX-License-Identifier: Apache-2.0
export { SurimiPlugin, Bake, Monitor, loadExrMap } from './index.js';
