// SPDX-License-Identifier: Apache-2.0
// A picture of the map with its title and its scale.
import { css, gradient } from './color_maps.js';
import { element } from './elements.js';

/**
 * A panel that shows one number for each texel. `colorAt(i)` gives the colour of pixel i; painting waits until the panel
 * is seen or printed. `probe(i or null)` is told what the pointer is over.
 */
export class Panel {
  #colorAt;
  #canvas;
  #isPainted = false;
  #isWanted = false;

  constructor({ id, title, meaning, legend, probe }) {
    this.#canvas = element('canvas', {
      id, role: 'img', 'aria-label': `${title}: ${meaning}`, tabindex: '0',
      onpointermove: (event) => probe(this.#pixelAt(event)), onpointerleave: () => probe(null),
    });
    this.element = element('figure', { class: 'panel' },
      element('figcaption', {}, element('strong', {}, title), element('span', {}, meaning)),
      element('div', { class: 'frame' }, this.#canvas), legend);
    new IntersectionObserver((entries, observer) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      observer.disconnect();
      this.#want();
    }, { rootMargin: '600px' }).observe(this.element);
    addEventListener('beforeprint', () => this.#want());
  }

  show(width, height, colorAt) {
    this.#canvas.width = width;
    this.#canvas.height = height;
    this.#canvas.style.setProperty('--width', width);
    this.#colorAt = colorAt;
    this.#isPainted = false;
    if (this.#isWanted) this.#paint();
  }

  #want() {
    this.#isWanted = true;
    if (!this.#isPainted && this.#colorAt) this.#paint();
  }

  #paint() {
    const { width, height } = this.#canvas;
    const image = new ImageData(width, height);
    for (let i = 0, k = 0; i < width * height; ++i) {
      const [r, g, b] = this.#colorAt(i);
      image.data[k++] = r;
      image.data[k++] = g;
      image.data[k++] = b;
      image.data[k++] = 255;
    }
    this.#canvas.getContext('2d').putImageData(image, 0, 0);
    this.#isPainted = true;
  }

  #pixelAt(event) {
    const box = this.#canvas.getBoundingClientRect();
    const { width, height } = this.#canvas;
    const x = Math.min(width - 1, Math.max(0, Math.floor(((event.clientX - box.left) / box.width) * width)));
    const y = Math.min(height - 1, Math.max(0, Math.floor(((event.clientY - box.top) / box.height) * height)));
    return { x, y, i: y * width + x };
  }
}

/** A scale with words under its ends and middle. */
export function scaleLegend(colors, labels, note = null) {
  return element('div', { class: 'legend' },
    element('div', { class: 'bar', style: `background: ${gradient(colors)}` }),
    element('div', { class: 'ticks' }, ...labels.map((label) => element('span', {}, label))),
    note === null ? null : element('small', {}, note));
}

/** Colours with names: [[colour, name, title]]. */
export function keyLegend(entries) {
  return element('ul', { class: 'legend key' }, ...entries.map(([color, name, title]) =>
    element('li', { title }, element('i', { style: `background: ${css(color)}` }), name)));
}
