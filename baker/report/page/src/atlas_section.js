// SPDX-License-Identifier: Apache-2.0
// How good the UVs are for a lightmap, in numbers.
import { element, fact, facts } from './elements.js';
import { count, percent, short } from './numbers.js';

function causes({ densityWeights }) {
  if (!densityWeights?.length) return null;
  const words = { unreached: 'no monitor faces or reaches it', far: 'far from every monitor', texelScale: 'as the user wants it', fullPage: 'it fills a page alone' };
  const line = (weight) => `${weight.surface}: ${weight.charts} charts, ${short(weight.areaSquareMetres)} m\u00b2, ` +
    `${weight.factor.map((x) => short(x)).join(' to ')} of the density (${words[weight.cause] ?? weight.cause})`;
  return element('details', {}, element('summary', {}, `${densityWeights.length} surfaces with another density`),
    element('ul', {}, ...densityWeights.map((weight) => element('li', {}, line(weight)))));
}

export function atlasFacts({ atlas, manifest }) {
  if (!atlas) return '';
  const { p1, p50, p99 } = atlas.texelsPerMetre;
  return element('div', {}, facts(
    fact('Median density', `${short(p50)} /m`, `texels per metre in the worst direction, median over the area; 98 % of it has ${short(p1)} to ${short(p99)}`),
    fact('Charts', count(atlas.charts), `of ${count(atlas.triangles)} triangles, ${short(atlas.squareMetres)} m\u00b2`),
    fact('Use of the map', percent(atlas.touchedShare), 'of the texels are touched by charts'),
    fact('Stretch', short(atlas.l2Stretch), 'L2 stretch of Sander et al. 2001; 1 is no distortion'),
    fact('Seams', `${short(atlas.smoothSeamMetres)} m`, `cut smooth surfaces, where they could show; ${short(atlas.seamMetres)} m in all`)),
  causes(manifest) ?? '');
}
