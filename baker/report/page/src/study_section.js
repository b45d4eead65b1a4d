// SPDX-License-Identifier: Apache-2.0
// What accuracy costs on this scene, where a study lies beside the bake.
import uPlot from 'uplot';
import { element, section, table } from './elements.js';
import { rays, seconds, short } from './numbers.js';
import { axis, decades, lineStyle, markerStyle, plot } from './plot.js';

/** Lines through settings of each technique: seconds a texel against RMSE, both logarithmic. */
function accuracyPlot(study) {
  const shown = study.techniques
    .map((technique) => ({ ...technique, points: technique.points.filter((p) => p.secondsPerTexel > 0 && p.rmse > 0) }))
    .filter((technique) => technique.points.length > 0);
  const data = uPlot.join(shown.map(({ points }) => {
    const sorted = [...points].sort((a, b) => a.secondsPerTexel - b.secondsPerTexel);
    return [sorted.map((p) => p.secondsPerTexel), sorted.map((p) => p.rmse)];
  }));
  const families = [...new Set(shown.map(({ family }) => family))];
  const styleOf = (technique) => lineStyle(families.indexOf(technique.family),
    shown.filter(({ family }) => family === technique.family).indexOf(technique));
  const log = (format) => ({ splits: decades, filter: (_, splits) => splits, values: (_, splits) => splits.map((x) => format(x)) });
  return plot('accuracy', 'Error against time of every technique, both axes logarithmic', {
    height: 420,
    scales: { x: { time: false, distr: 3 }, y: { distr: 3 } },
    axes: [axis('CPU time for a texel', log(seconds)), axis('RMS error of visibility', { ...log(short), size: 70 })],
    cursor: { focus: { prox: 24 }, drag: { x: true, y: true } },
    focus: { alpha: 0.25 },
    legend: { markers: { width: 3, dash: (_, i) => (i > 0 ? markerStyle(families.indexOf(shown[i - 1].family)) : 'solid') } },
    series: [{ label: 'time', value: (_, x) => (x === null ? '' : seconds(x)) },
      ...shown.map((technique) => ({
        label: technique.label, ...styleOf(technique), spanGaps: true, points: { show: true, size: 6 },
        value: (_, y) => (y === null ? '\u2013' : short(y)),
      }))],
  }, data);
}

function numbersOf(study) {
  const rows = study.techniques.flatMap((technique) => technique.points.map((point) => [
    technique.label, point.setting, seconds(point.secondsPerTexel), rays(point.raysPerTexel), short(point.rmse), short(point.p999),
    short(point.largest),
  ]));
  return element('details', {}, element('summary', {}, 'The numbers as a table'),
    table('CPU time and rays for one texel and monitor; errors of visibility', ['technique', 'setting', 'time', 'rays', 'RMSE', '99.9 % within', 'largest'], rows));
}

export function studySection({ study, manifest }) {
  if (!study)
    return section('study', 'Accuracy against time', 'No study lies beside the bake. ' +
      `surimi study ${manifest.scene.file} --json > study.json measures what accuracy costs here, by every technique; then run surimi report again.`);
  const other = study.scene?.file !== manifest.scene.file ? ` It was made with another scene, ${study.scene?.file}.` : '';
  return section('study', 'Accuracy against time', 'Lower is more accurate, left is faster; each line is a technique at ' +
    `several settings (thick: the baker\u2019s own, dashed: sampling, dotted: approximations). Drag to enlarge, double click to go back; click a name to hide its line.${other}`,
  accuracyPlot(study), element('p', {}, study.reading ?? ''), numbersOf(study));
}
