// SPDX-License-Identifier: Apache-2.0
// The live view with its controls; where there is none, why, and pictures.
import { Color } from 'three';
import { choice, element, section, slider, toggle } from './elements.js';
import { LiveView } from './live_view.js';
import { bytes, short } from './numbers.js';

const lead = 'The scene as three.js shows it with the map: one texture read in place of shadow rays. ' +
  'Drag to turn, scroll to come nearer, drag with the right button to move. Colours and intensities are free: the map ' +
  'does not change with them.';

function whyNoScene(report) {
  if (!report.scene) return 'There is no live view: the baked glb is not there.';
  if (!report.scene.glb)
    return `There is no live view: packed, the scene would add ${bytes(report.scene.bytes)} to this page, and ` +
      `${bytes(report.scene.mostBytes)} is the most. These pictures were made by the CPU renderer of Surimi.`;
  return null;
}

/** Two pictures, one over the other, with a border that moves. */
function stills({ unshadowed, shadowed }) {
  const before = element('img', { src: unshadowed, alt: 'The scene lit without shadows', class: 'before' });
  const frame = element('div', { class: 'stage stills', style: '--split: 50%' },
    element('img', { src: shadowed, alt: 'The scene lit with the map' }), before, element('div', { class: 'border' }));
  return element('div', {}, frame, slider('split', 'Without shadows | with the map',
    { min: 0, max: 100, step: 0.5, value: 50 }, (x) => `${short(x)} %`,
    (x) => frame.style.setProperty('--split', `${x}%`)));
}

function hexOf(color) {
  return `#${color.getHexString()}`;
}

function monitorControls(view, index) {
  const { monitor, color, intensity } = view.shines[index];
  const brightest = Math.max(color.r, color.g, color.b) || 1;
  const shown = new Color().copy(color).multiplyScalar(1 / brightest); // a colour picker knows colours up to 1
  view.shines[index].color = shown;
  view.shines[index].intensity = intensity * brightest;
  const picker = element('input', {
    type: 'color', id: `color-${index}`, value: hexOf(shown),
    oninput: () => view.setMonitor(index, { color: picker.value }),
  });
  return element('div', { class: 'monitor' },
    toggle(`monitor-${index}`, monitor.name, true, (isOn) => view.setMonitor(index, { isOn })),
    element('label', { for: picker.id, class: 'color' }, 'Colour', picker),
    slider(`intensity-${index}`, 'Intensity', { min: -4, max: 4, step: 0.25, value: 0 },
      (stops) => `${short(intensity * brightest * 2 ** stops)} nits`, (stops) => view.setMonitor(index, { stops })));
}

function roughnessControl(view) {
  let isOwn = true;
  let value = 0.3;
  const apply = () => view.setRoughness(isOwn ? null : value);
  const knob = slider('roughness', 'Roughness', { min: 0.05, max: 1, step: 0.01, value }, (x) => short(x, 2), (x) => {
    value = x;
    apply();
  });
  const input = knob.querySelector('input');
  input.disabled = true;
  return element('div', {}, toggle('own-roughness', 'Roughness as in the scene', true, (isOn) => {
    isOwn = isOn;
    input.disabled = isOn;
    apply();
  }), knob);
}

function makeControls(view, stage) {
  const border = element('input', {
    type: 'range', id: 'split', min: 0, max: 1, step: 0.001, value: 0.5, 'aria-label': 'Border between without and with shadows',
    oninput: () => {
      stage.style.setProperty('--split', `${100 * border.valueAsNumber}%`);
      view.setSplit(border.valueAsNumber);
    },
  });
  const setMode = (mode) => {
    stage.dataset.mode = mode;
    view.setMode(mode);
  };
  return element('div', { class: 'controls live' },
    element('div', {}, choice('mode', 'Shadows', [['both', 'Both'], ['map', 'With the map'], ['none', 'Without']], 'both', setMode),
      element('div', { class: 'slider' }, element('label', { for: 'split' }, 'Border'), border)),
    ...view.shines.map((_, index) => monitorControls(view, index)),
    element('div', {}, roughnessControl(view),
      slider('exposure', 'Exposure', { min: -5, max: 5, step: 0.25, value: 0 },
        (stops) => `${stops > 0 ? '+' : ''}${stops} EV`, (stops) => view.setExposure(stops)),
      element('button', { type: 'button', id: 'reset-view', onclick: () => view.resetCamera() }, 'Back to the first view')));
}

/** What the copy of the scene leaves out. */
function remarks(report) {
  const all = ['three.js computes area lights without cutting them at the horizon, so surfaces that a monitor grazes are ' +
    'a little brighter than in truth; surimi preview shows both.'];
  if (!report.scene.hasTextures)
    all.push('To keep this page small, textures are replaced by their mean colours, and normal maps are left out.');
  if (report.codes.reduction > 1)
    all.push(`The map is shown at 1/${report.codes.reduction} of its resolution; thin shadows are softer than in your engine.`);
  return element('p', { class: 'quiet' }, all.join(' '));
}

/** A drag on the border moves it; elsewhere the scene turns. */
function letBorderBeDragged(stage, handle) {
  handle.addEventListener('pointerdown', (event) => {
    handle.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  handle.addEventListener('pointermove', (event) => {
    if (!handle.hasPointerCapture(event.pointerId)) return;
    const box = stage.getBoundingClientRect();
    const knob = document.getElementById('split');
    knob.value = (event.clientX - box.left) / box.width;
    knob.dispatchEvent(new Event('input'));
  });
}

export function liveSection(report, decoded) {
  const why = whyNoScene(report);
  if (why !== null) {
    const part = section('live', 'The room', why, report.view?.stills ? stills(report.view.stills) : '');
    part.dataset.state = 'none';
    return part;
  }
  const canvas = element('canvas', { id: 'view', role: 'img', 'aria-label': 'The baked scene, lit by its monitors' });
  const handle = element('div', { class: 'border', title: 'Drag: without shadows on the left, with the map on the right' });
  const stage = element('div', { class: 'stage', style: '--split: 50%', 'data-mode': 'both' }, canvas, handle,
    element('span', { class: 'tag left' }, 'without shadows'), element('span', { class: 'tag right' }, 'with the map'));
  const whole = section('live', 'The room', lead, stage);
  start(report, decoded, stage, canvas)
    .then((controls) => {
      letBorderBeDragged(stage, handle);
      whole.append(controls, remarks(report));
      whole.dataset.state = 'ready';
    })
    .catch((error) => {
      stage.replaceChildren(element('p', {}, `The live view needs WebGL 2, which this browser does not offer (${error.message}).`));
      whole.dataset.state = 'failed';
    });
  return whole;
}

async function start(report, decoded, stage, canvas) {
  const view = new LiveView(canvas, report);
  const maps = await Promise.all(decoded);
  await view.load(maps.map((pictures) => pictures.map));
  new ResizeObserver(() => view.draw()).observe(canvas);
  view.setExposure(0);
  return makeControls(view, stage);
}
