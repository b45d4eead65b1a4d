// SPDX-License-Identifier: Apache-2.0
// The map, channel by channel, and what its texels are.
import { balance, greys, magma, nothing, palette, viridis } from './color_maps.js';
import { choice, element, section, toggle } from './elements.js';
import { short } from './numbers.js';
import { keyLegend, Panel, scaleLegend } from './panel.js';
import { differenceOf, errorOf, linearCodeOf, linearOf, methodOf, methods, stateOf, states } from './pictures.js';
import { stateMeanings } from './verdict.js';

const outlineColors = { smooth: palette.vermilion, other: palette.sky };

/** As people write it. */
export function titleOf(name) {
  return name === 'monteCarlo' ? 'Monte Carlo' : name;
}

export const methodMeanings = {
  none: ['no light to measure', nothing],
  certificate: ['one facet hides the whole monitor', palette.blue],
  ray: ['nothing in the way: one ray a point', palette.sky],
  split: ['exact: the part of the monitor that is seen, cut out', palette.green],
  scanline: ['exact along lines across the monitor', palette.yellow],
  monteCarlo: ['many random rays', palette.vermilion],
};

/** What all panels of the page share: which page they show, whether outlines lie over them, and the read-out. */
export class Panels {
  constructor(report, decoded) {
    this.report = report;
    this.decoded = decoded;
    this.page = 0;
    this.hasOutlines = false;
    this.all = [];
    this.readouts = [];
  }

  /** `paint(pictures)` returns the function that colours pixel i, or nothing where the picture is missing. */
  add(options, paint) {
    const panel = new Panel({ ...options, probe: (place) => this.#tell(place) });
    this.all.push({ panel, paint });
    return panel.element;
  }

  async show() {
    this.pictures = await this.decoded[this.page];
    const first = Object.values(this.pictures)[0];
    if (!first) return;
    for (const { panel, paint } of this.all) {
      const colorAt = paint(this.pictures);
      panel.element.hidden = !colorAt;
      if (colorAt) panel.show(first.width, first.height, this.hasOutlines ? this.#outlined(colorAt) : colorAt);
    }
  }

  #outlined(colorAt) {
    const { atlas } = this.pictures;
    if (!atlas) return colorAt;
    return (i) => {
      const side = atlas.data[4 * i + 2];
      return side === 0 ? colorAt(i) : side === 255 ? outlineColors.smooth : outlineColors.other;
    };
  }

  readout() {
    const line = element('output', { class: 'readout', 'aria-live': 'off' }, 'Point at a texel to read its numbers.');
    this.readouts.push(line);
    return line;
  }

  #tell(place) {
    const text = place === null ? 'Point at a texel to read its numbers.' : this.#describe(place);
    for (const line of this.readouts) line.textContent = text;
  }

  #describe({ x, y, i }) {
    const { codes, manifest, atlas: numbers } = this.report;
    const { map, state, error, difference, atlas } = this.pictures;
    const parts = [`texel (${x * codes.reduction}, ${y * codes.reduction})`];
    for (const { channel } of manifest.monitors) {
      const k = 4 * i + 'RGB'.indexOf(channel);
      const words = [map ? `${channel} = ${short(linearOf(map.data[k]))}` : channel];
      const estimate = error ? errorOf(error.data[k], codes) : null;
      if (estimate !== null) words.push(`\u00b1 ${short(estimate, 2)}`);
      const off = difference ? differenceOf(difference.data[k], codes) : null;
      if (off !== null) words.push(`off by ${short(off, 2)}`);
      if (state) words.push(states[stateOf(state.data[k])], titleOf(methods[methodOf(state.data[k])]));
      parts.push(words.join(' '));
    }
    const density = atlas ? linearCodeOf(atlas.data[4 * i], 0, numbers.densityHigh) : null;
    if (density !== null)
      parts.push(`${short(density)} texels/m`, `stretch ${short(linearCodeOf(atlas.data[4 * i + 1], 1, numbers.stretchHigh))}`);
    return parts.join(' \u00b7 ');
  }
}

function scaleColor(colors, value, low, high) {
  return colors[Math.round(255 * Math.min(1, Math.max(0, (value - low) / (high - low))))];
}

function channelPanels(report, panels) {
  return report.manifest.monitors.map(({ channel, name }) => {
    const c = 'RGB'.indexOf(channel);
    return panels.add({
      id: `map-${channel}`, title: `${channel} ${name}`, meaning: 'share of its light that arrives',
      legend: scaleLegend(greys, ['0: dark', '0.21', '1: all of it'], 'as stored: steps that look equal'),
    }, ({ map }) => map && ((i) => greys[map.data[4 * i + c]]));
  });
}

function controls(report, panels, grid) {
  const composite = choice('composite', 'Channels', [['grey', 'Each in grey'], ['rgb', 'R, G, B in one']], 'grey', (value) => {
    grid.dataset.composite = value;
  });
  const parts = [
    report.manifest.monitors.length > 1 ? composite : '',
    choice('zoom', 'Size', [['fit', 'Fit'], ['1', '1:1'], ['4', '4:1']], 'fit', (value) => {
      document.documentElement.dataset.zoom = value;
    }),
    toggle('outlines', 'Outlines of charts', false, (isOn) => {
      panels.hasOutlines = isOn;
      panels.show();
    }),
  ];
  if (report.pages.length > 1)
    parts.push(choice('page', 'Map', report.pages.map((_, p) => [p, `${p + 1} of ${report.pages.length}`]), 0, (page) => {
      panels.page = page;
      panels.show();
    }));
  return element('div', { class: 'controls' }, ...parts);
}

export function mapSection(report, panels) {
  const composite = panels.add({
    id: 'map-RGB', title: 'All channels', meaning: 'R, G and B of the map as a colour',
    legend: keyLegend([[[255, 0, 0], 'R'], [[0, 255, 0], 'G'], [[0, 0, 255], 'B']].filter(([, channel]) =>
      report.manifest.monitors.some((monitor) => monitor.channel === channel))),
  }, ({ map }) => map && ((i) => map.data.subarray(4 * i, 4 * i + 3)));
  composite.classList.add('composite');
  const grid = element('div', { class: 'panels map', 'data-composite': 'grey' }, ...channelPanels(report, panels), composite);
  return section('map', 'The map', 'What the shader multiplies each monitor\u2019s light with. ' +
    'Unused channels are 1. Outlines: orange where a seam cuts a smooth surface, blue elsewhere.',
  controls(report, panels, grid), panels.readout(), grid);
}

function errorPanel(report, panels, { channel, name }) {
  const c = 'RGB'.indexOf(channel);
  const asked = report.manifest.settings.error;
  return panels.add({
    id: `error-${channel}`, title: `Error, ${channel} ${name}`, meaning: 'standard error of visibility, estimated',
    legend: scaleLegend(magma, [short(asked / 16), short(asked / 4), short(asked), short(4 * asked), short(16 * asked)],
      'logarithmic, with the error asked for in the middle; what lies beyond has the colours of the ends'),
  }, ({ error }) => error && ((i) => {
    const value = errorOf(error.data[4 * i + c], report.codes);
    return value === null ? nothing : scaleColor(magma, Math.log2(Math.max(value, 1e-9) / asked), -4, 4);
  }));
}

function categoryPanel(panels, options, names, meanings, of, c) {
  return panels.add({ ...options, legend: keyLegend(names.map((name) => [meanings[name][1], titleOf(name), meanings[name][0]])) },
    ({ state }) => state && ((i) => meanings[names[of(state.data[4 * i + c])]]?.[1] ?? nothing));
}

export function heatSection(report, panels) {
  const { atlas: numbers, manifest } = report;
  const rows = [];
  if (numbers)
    rows.push([
      panels.add({
        id: 'density', title: 'Density', meaning: 'texels per metre in the worst direction',
        legend: scaleLegend(viridis, ['0', short(numbers.densityHigh / 2), `${short(numbers.densityHigh)} /m`],
          '99 % of the area has at most the right end'),
      }, ({ atlas }) => atlas && ((i) => atlas.data[4 * i] === 0 ? nothing : viridis[atlas.data[4 * i]])),
      panels.add({
        id: 'stretch', title: 'Stretch', meaning: 'distortion against the chart\u2019s own density, worst direction',
        legend: scaleLegend(viridis, ['1: none', short((1 + numbers.stretchHigh) / 2), `${short(numbers.stretchHigh)} or more`]),
      }, ({ atlas }) => atlas && ((i) => atlas.data[4 * i + 1] === 0 ? nothing : viridis[atlas.data[4 * i + 1]])),
    ]);
  for (const monitor of manifest.monitors) {
    const { channel, name } = monitor;
    const c = 'RGB'.indexOf(channel);
    rows.push([errorPanel(report, panels, monitor),
      categoryPanel(panels, { id: `state-${channel}`, title: `State, ${channel} ${name}`, meaning: 'what each texel is' },
        states, stateMeanings, stateOf, c),
      categoryPanel(panels, { id: `method-${channel}`, title: `Method, ${channel} ${name}`, meaning: 'what decided its value' },
        methods, methodMeanings, methodOf, c)]);
  }
  return section('heat', 'Where and how well', 'Resolution, distortion, estimated error, state and method of every texel. ' +
    'Grey: no value there.', panels.readout(),
  ...rows.map((row) => element('div', { class: 'panels' }, ...row)));
}

export function differencePanel(report, panels, { channel, name }, range) {
  const c = 'RGB'.indexOf(channel);
  return panels.add({
    id: `difference-${channel}`, title: `${channel} ${name}`, meaning: 'this map minus the reference',
    legend: scaleLegend(balance, [`\u2212${short(range)}: darker`, '0', `+${short(range)}: brighter`],
      'grey: not compared'),
  }, ({ difference }) => difference && ((i) => {
    const value = differenceOf(difference.data[4 * i + c], report.codes);
    return value === null ? nothing : scaleColor(balance, value, -range, range);
  }));
}
