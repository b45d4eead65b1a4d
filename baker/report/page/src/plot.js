// SPDX-License-Identifier: Apache-2.0
// Plots in the colours of the page, as wide as there is room.
import uPlot from 'uplot';
import { css, palette } from './color_maps.js';
import { element } from './elements.js';

/** Colours and dashes of the lines of a plot: eight colours, then the same dashed, then dotted. */
export function lineStyle(index) {
  const colors = [palette.blue, palette.vermilion, palette.green, palette.purple, palette.orange, palette.sky];
  const dashes = [[], [8, 4], [2, 3]];
  return { stroke: css(colors[index % colors.length]), dash: dashes[Math.floor(index / colors.length) % dashes.length], width: 2 };
}

export function axis(label, options = {}) {
  const color = (name) => () => getComputedStyle(document.documentElement).getPropertyValue(name);
  return {
    label, stroke: color('--ink'), grid: { stroke: color('--line'), width: 1 }, ticks: { stroke: color('--line'), width: 1 },
    labelSize: 24, size: 58, ...options,
  };
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
