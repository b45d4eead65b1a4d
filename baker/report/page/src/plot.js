// SPDX-License-Identifier: Apache-2.0
// Plots in the colours of the page, as wide as there is room.
import uPlot from 'uplot';
import { css, palette } from './color_maps.js';
import { element } from './elements.js';

const lineColors = [palette.blue, palette.vermilion, palette.green, palette.purple, palette.orange, palette.sky];
const lineKinds = [{ dash: [], width: 3 }, { dash: [10, 5], width: 2 }, { dash: [2, 4], width: 2 }];
const markerKinds = ['solid', 'dashed', 'dotted'];

/** The line of member `index` of a group of lines: a group shares a dash, its members differ in colour. */
export function lineStyle(group, index) {
  return { stroke: css(lineColors[index % lineColors.length]), ...lineKinds[group % lineKinds.length] };
}

export function axis(label, options = {}) {
  const color = (name) => () => getComputedStyle(document.documentElement).getPropertyValue(name);
  return {
    label, stroke: color('--ink'), grid: { stroke: color('--line'), width: 1 }, ticks: { stroke: color('--line'), width: 1 },
    labelSize: 24, size: 58, ...options,
  };
}

/** How the lines of a group are framed in the legend, as CSS has it. */
export function markerStyle(group) {
  return markerKinds[group % markerKinds.length];
}

/** Gridlines of a logarithmic axis at powers of ten alone. */
export function decades(_, __, low, high) {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (___, i) => Number(`1e${first + i}`));
}

/** An element that holds a plot; `options` and `data` as uPlot takes them, without width. */
export function plot(id, label, options, data) {
  const holder = element('div', { id, class: 'plot', role: 'img', 'aria-label': label });
  let chart = null;
  new ResizeObserver(() => {
    const width = Math.floor(holder.clientWidth);
    if (width === 0) return;
    if (chart === null) chart = new uPlot({ ...options, width }, data, holder);
    else if (chart.width !== width) chart.setSize({ width, height: options.height });
  }).observe(holder);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => chart?.redraw(false, true));
  new MutationObserver(() => chart?.redraw(false, true)).observe(document.documentElement, { attributeFilter: ['data-theme'] });
  return holder;
}
