// SPDX-License-Identifier: Apache-2.0
export { SurimiPlugin, Bake, Monitor, loadExrMap } from './index.js';
export type { Channel, Page } from './index.js';
