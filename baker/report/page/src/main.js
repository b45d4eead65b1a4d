// SPDX-License-Identifier: Apache-2.0
// The report, from the data that the program wrote into the page.
import { atlasFacts } from './atlas_section.js';
import { costSection } from './cost_section.js';
import { differenceSection } from './difference_section.js';
import { element } from './elements.js';
import { liveSection } from './live_section.js';
import { heatSection, mapSection, Panels } from './map_section.js';
import { decodePage } from './pictures.js';
import { settingsSection } from './settings_section.js';
import { studySection } from './study_section.js';
import { verdict } from './verdict.js';

const report = JSON.parse(document.getElementById('data').textContent);

function header() {
  const root = document.documentElement;
  const isDark = () => (root.dataset.theme ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light')) === 'dark';
  return element('header', {},
    element('div', {}, element('h1', {}, report.name), element('p', {}, `Visibility map of ${report.manifest.scene.file}`)),
    element('button', { type: 'button', id: 'theme', onclick: () => {
      root.dataset.theme = isDark() ? 'light' : 'dark';
    } }, 'Light / dark'));
}

function contents(sections) {
  return element('nav', { 'aria-label': 'Contents' }, ...sections.map((part) =>
    element('a', { href: `#${part.id}` }, part.querySelector('h2').textContent)));
}

const decoded = report.pages.map(decodePage);
const panels = new Panels(report, decoded);
const heat = heatSection(report, panels);
heat.append(atlasFacts(report));
const sections = [liveSection(report, decoded), mapSection(report, panels), heat, differenceSection(report, panels),
  studySection(report), costSection(report), settingsSection(report)];
document.documentElement.dataset.zoom = 'fit';
document.getElementById('report').append(header(), verdict(report), contents(sections), ...sections);
panels.show().then(() => {
  document.documentElement.dataset.state = 'ready';
});
