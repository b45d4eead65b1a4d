// SPDX-License-Identifier: Apache-2.0
// What the bake took, stage by stage, and what decided the texels.
import { css } from './color_maps.js';
import { element, section, table } from './elements.js';
import { errorHistogram } from './histogram.js';
import { methodMeanings, titleOf } from './map_section.js';
import { bytes, count, percent, rays, seconds, short } from './numbers.js';

function share(part) {
  return element('div', { class: 'meter', title: percent(part) }, element('i', { style: `width: ${100 * part}%` }));
}

function stageTable({ run, rays: traced }) {
  const total = run.stages.reduce((sum, stage) => sum + stage.seconds, 0);
  return table('Stages: wall clock, share of the whole, rays traced, peak of memory up to then',
    ['stage', 'time', 'share', 'rays', 'memory'],
    run.stages.map(({ stage, seconds: time, peakBytes }) => [
      stage, seconds(time), share(total > 0 ? time / total : 0), traced[stage] ? rays(traced[stage]) : '\u2013', bytes(peakBytes),
    ]));
}

function methodTable(manifest, { channel, name }) {
  const methods = manifest.evidence[channel]?.methods;
  if (!methods) return null;
  const all = Object.values(methods).reduce((sum, method) => sum + method.texels, 0);
  const costs = manifest.run.monitors?.[channel]?.methods ?? {};
  return table(`${channel} ${name}: what decided its texels`, ['method', 'texels', 'share', 'points', 'rays', 'CPU time', 'for a point'],
    Object.entries(methods).filter(([, method]) => method.texels > 0).map(([key, method]) => [
      element('span', { title: methodMeanings[key]?.[0] ?? null },
        element('i', { class: 'swatch', style: `background: ${css(methodMeanings[key]?.[1] ?? [128, 128, 128])}` }), titleOf(key)),
      count(method.texels), share(method.texels / all), rays(method.points), rays(method.rays),
      costs[key] ? seconds(costs[key].seconds) : '\u2013', costs[key] ? `${short(costs[key].microsecondsPerPoint)} \u00b5s` : '\u2013',
    ]));
}

export function costSection({ manifest }) {
  const histograms = manifest.monitors
    .filter(({ channel }) => manifest.evidence[channel]?.errorHistogram)
    .map((monitor) => errorHistogram(monitor, manifest.evidence[monitor.channel].errorHistogram));
  return section('cost', 'What it took', 'Nothing is spent on what the scene does not call for: each block of texels gets the cheapest method that keeps the error.',
    stageTable(manifest), ...manifest.monitors.map((monitor) => methodTable(manifest, monitor)).filter((part) => part !== null),
    ...histograms);
}
