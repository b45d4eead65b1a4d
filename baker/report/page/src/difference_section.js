// SPDX-License-Identifier: Apache-2.0
// The map against a reference, where one was given.
import { element, fact, facts, section } from './elements.js';
import { histogram } from './histogram.js';
import { differencePanel } from './map_section.js';
import { count, percent, short } from './numbers.js';

function numbersOf({ channel, name }, numbers, asked) {
  const { largest } = numbers;
  return element('div', {}, element('h3', {}, `${channel} ${name}`), facts(
    fact('RMS difference', short(numbers.rmse), `of visibility, over ${count(numbers.texels)} texels that both measured`),
    fact('Mean difference', short(numbers.bias), 'below 0: this map is darker'),
    fact('Beyond the error asked for', percent(numbers.shareBeyond), `of those texels differ by more than ${short(asked)}`),
    fact('99 % within', short(numbers.p99), 'of visibility'),
    fact('99.9 % within', short(numbers.p999), 'of visibility'),
    fact('Largest', short(largest.difference), `at texel (${largest.x}, ${largest.y})${largest.page > 0 ? ` of map ${largest.page + 1}` : ''}`)));
}

function bars({ channel, name }, { range, texels }) {
  const width = (2 * range) / texels.length;
  const places = texels.map((_, i) => -range + (i + 0.5) * width);
  return histogram(`histogram-${channel}`, `Distribution of the signed difference of ${name}`, places, texels,
    { label: `map \u2212 reference, ${channel} ${name}`, quantity: 'difference', nameOf: (place) => short(place, 2) });
}

export function differenceSection(report, panels) {
  const { reference, manifest } = report;
  if (!reference)
    return section('difference', 'Against a reference', 'No reference was given. Bake the same scene with a smaller error ' +
      'and the same UVs, then: surimi report OUT --reference REFERENCE/NAME.lightmaps.exr');
  const compared = manifest.monitors.filter(({ channel }) => reference.channels[channel]);
  return section('difference', 'Against a reference', `Compared with ${reference.files.join(', ')}.`,
    ...compared.map((monitor) => numbersOf(monitor, reference.channels[monitor.channel], manifest.settings.error)),
    panels.readout(),
    element('div', { class: 'panels' }, ...compared.map((monitor) =>
      differencePanel(report, panels, monitor, reference.channels[monitor.channel].histogram.range))),
    ...compared.map((monitor) => bars(monitor, reference.channels[monitor.channel].histogram)),
    element('p', { class: 'quiet' }, 'Texels by signed difference, on a logarithmic scale; the bars at the ends hold all beyond.'));
}
