// SPDX-License-Identifier: Apache-2.0
// The first thing to know: is the map what was asked for, what speaks against it, and what it took.
import { css, palette } from './color_maps.js';
import { element, fact, facts, table } from './elements.js';
import { bytes, count, percent, seconds, short } from './numbers.js';
import { states } from './pictures.js';

export const stateMeanings = {
  covered: ['measured: its visibility was computed', palette.sky],
  unlit: ['faces away from the monitor: no light to shadow; filled from neighbours', palette.orange],
  inside: ['enclosed by other geometry: never seen; filled from neighbours', palette.purple],
  filled: ['gutter around charts: filled so that bilinear reads stay clean', palette.green],
  empty: ['no chart here or near', [89, 99, 110]],
};

function breachesOf(manifest) {
  return manifest.monitors.flatMap(({ channel, name }) =>
    (manifest.evidence[channel]?.promise?.breaches ?? []).map((breach) => `${channel} ${name}: ${breach}`));
}

function stateBar(manifest, { channel, name }) {
  const counts = manifest.texels[channel] ?? {};
  const total = states.reduce((sum, state) => sum + (counts[state] ?? 0), 0);
  if (total === 0) return null;
  const shown = ['covered', 'unlit', 'inside', 'filled', 'empty'].filter((state) => counts[state] > 0);
  return element('div', { class: 'states' },
    element('strong', {}, `${channel} ${name}`),
    element('div', { class: 'stack', 'aria-hidden': 'true' }, ...shown.map((state) => element('i', {
      style: `flex-grow: ${counts[state]}; background: ${css(stateMeanings[state][1])}`,
    }))),
    element('ul', { class: 'key' }, ...shown.map((state) => element('li', { title: stateMeanings[state][0] },
      element('i', { style: `background: ${css(stateMeanings[state][1])}` }),
      `${state} ${count(counts[state])} (${percent(counts[state] / total)})`))));
}

/** The errors of the only monitor, each with what it means. */
function errorFacts({ promise, errors, audit }) {
  return [
    promise ? fact('Within the error', percent(1 - promise.shareAbove),
      'of the measured texels, by their own estimates; 99.9 % are promised') : null,
    errors ? fact('Estimated RMS error', short(errors.rms),
      `of visibility (0 to 1), over the measured texels; mean ${short(errors.mean)}, largest ${short(errors.max)}`) : null,
    audit ? fact('Audited RMS error', short(audit.rmse),
      `${count(audit.texels)} random texels against brute force; 95 % interval ${intervalOf(audit)}; largest ${short(audit.largest)}`) : null,
  ].filter((child) => child !== null);
}

function intervalOf(audit) {
  return audit.rmseInterval.map((end) => short(end)).join(' to ');
}

/** The errors of several monitors, a row for each. */
function errorTable(all) {
  const isAudited = all.some(({ audit }) => audit);
  const rows = all.map(({ channel, name, promise, errors, audit }) => [
    `${channel} ${name}`, promise ? percent(1 - promise.shareAbove) : '\u2013',
    ...['rms', 'mean', 'max'].map((key) => (errors ? short(errors[key]) : '\u2013')),
    ...(isAudited ? (audit ? [`${short(audit.rmse)} (${intervalOf(audit)})`, short(audit.largest), count(audit.texels)] : ['\u2013', '\u2013', '\u2013']) : []),
  ]);
  return table('Errors of visibility (0: dark, 1: all light arrives), over the measured texels' +
    `${isAudited ? '; audited: random texels against brute force, with the 95 % interval' : ', as estimated'}; 99.9 % within the error are promised`,
  ['monitor', 'within the error', 'RMS', 'mean', 'largest', ...(isAudited ? ['audited RMS', 'audited largest', 'audited texels'] : [])], rows);
}

function errorsOf(manifest) {
  return manifest.monitors.map(({ channel, name }) => {
    const evidence = manifest.evidence[channel];
    return { channel, name, promise: evidence?.promise, audit: evidence?.audit, errors: manifest.error[channel] };
  });
}

function warnings(report, breaches) {
  const all = [...new Set([...breaches, ...report.complaints, ...report.manifest.warnings])];
  if (all.length === 0) return element('p', { class: 'quiet' }, 'No warnings.');
  return element('ul', { class: 'warnings' }, ...all.map((text) => element('li', {}, text)));
}

function notes(manifest) {
  if (manifest.notes.length === 0) return null;
  const line = ({ what, count: times, where }) =>
    `${what}${times > 1 ? ` (${count(times)} times)` : ''}${where ? `, first at ${where}` : ''}`;
  return element('details', {}, element('summary', {}, 'What reading the scene dropped or repaired'),
    element('ul', {}, ...manifest.notes.map((note) => element('li', {}, line(note)))));
}

export function verdict(report) {
  const { manifest } = report;
  const breaches = breachesOf(manifest);
  const isKept = breaches.length === 0;
  const total = manifest.run.stages.reduce((sum, stage) => sum + stage.seconds, 0);
  const peak = Math.max(...manifest.run.stages.map((stage) => stage.peakBytes));
  const rays = Object.values(manifest.rays).reduce((sum, n) => sum + n, 0);
  const error = manifest.settings.error;
  const errors = errorsOf(manifest);
  const isAudited = errors.some(({ audit }) => audit);
  return element('section', { id: 'verdict', 'aria-label': 'Verdict' },
    element('p', { class: `verdict ${isKept ? 'kept' : 'broken'}` },
      element('b', { 'aria-hidden': 'true' }, isKept ? '\u2713' : '\u2717'),
      element('span', {}, isKept ? `The error asked for is kept${isAudited ? ', and an audit agrees' : ''}: ` :
        'The error asked for is not kept: ',
      `${short(error)} of visibility, ${manifest.map.width} \u00d7 ${manifest.map.height} texels` +
        `${report.pages.length > 1 ? ` on each of ${report.pages.length} maps` : ''}, ` +
        `${manifest.monitors.length} monitor${manifest.monitors.length > 1 ? 's' : ''}, in ${seconds(total)}.`)),
    warnings(report, breaches),
    facts(
      fact('Error asked for', short(error), 'how far the visibility of a texel (0: dark, 1: all light arrives) may be off'),
      ...(errors.length === 1 ? errorFacts(errors[0]) : []),
      ...(isAudited ? [] : [fact('Audited error', 'none', 'add --audit 1000 to check random texels by brute force')]),
      fact('Time', seconds(total), 'of the bake, all stages, wall clock'),
      fact('Rays', count(rays), 'traced to find what stands between texels and monitors'),
      fact('Memory', bytes(peak), 'at its peak'),
      fact('Density', `${short(manifest.map.texelsPerMetre)} /m`, 'texels per metre of charts that nothing weighs')),
    errors.length > 1 ? errorTable(errors) : '',
    element('h3', {}, 'Texels by state'),
    ...manifest.monitors.map((monitor) => stateBar(manifest, monitor)).filter((bar) => bar !== null),
    notes(manifest) ?? '');
}
