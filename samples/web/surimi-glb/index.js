// SPDX-License-Identifier: Apache-2.0
// What the integrations for engines share; knows glTF, but no engine.
export { BakedLights } from './src/baked_lights.js';
export { areaLightOf, channelOf, noteOf } from './src/marks.js';
export { rectanglesOf, scaledRectangle, turned } from './src/rectangles.js';
