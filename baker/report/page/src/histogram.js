// SPDX-License-Identifier: Apache-2.0
// How many texels have which value, as bars on a logarithmic scale of counts.
import uPlot from 'uplot';
import { css, palette } from './color_maps.js';
import { axis, decades, plot } from './plot.js';
import { count, short } from './numbers.js';

/** `counts[i]` texels lie at `places[i]`; `xAxis` is { label, quantity, nameOf(place) }. */
export function histogram(id, label, places, counts, xAxis) {
  const half = (0.6 * (places.at(-1) - places[0])) / Math.max(1, places.length - 1);
  const options = {
    height: 240,
    cursor: { drag: { x: false, y: false } },
    scales: { x: { time: false, range: (_, low, high) => [low - half, high + half] }, y: { distr: 3, range: (_, low, high) => [0.5, Math.max(10, 2 * high)] } },
    axes: [axis(xAxis.label, { values: (_, splits) => splits.map(xAxis.nameOf), space: 58 }),
      axis('texels', { splits: decades, filter: (_, splits) => splits, values: (_, splits) => splits.map(count), size: 76 })],
    series: [{ label: xAxis.quantity, value: (_, place) => (place === null ? '' : xAxis.nameOf(place)) }, {
      label: 'texels', stroke: css(palette.blue), fill: css(palette.sky), width: 1,
      paths: uPlot.paths.bars({ size: [0.9, 60] }), points: { show: false },
      value: (_, n) => (n === null ? '0' : count(n)),
    }],
  };
  return plot(id, label, options, [places, counts.map((n) => (n > 0 ? n : null))]);
}

/** The estimates of a channel: a bar for each power of two, the first for what is exact. */
export function errorHistogram({ channel, name }, { below, texels }) {
  const nameOf = (place) => {
    if (!Number.isInteger(place) || place < 0 || place >= below.length) return '';
    return place === 0 ? 'exact' : `< ${short(below[place], 2)}`;
  };
  return histogram(`estimates-${channel}`, `Distribution of the estimated errors of ${name}`,
    below.map((_, i) => i), texels, { label: `estimated error of V, ${channel} ${name}`, quantity: 'error', nameOf });
}
