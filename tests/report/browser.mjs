// SPDX-License-Identifier: Apache-2.0
// A headless Chromium that opens reports from disk, and what a test sees of them.
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const patience = 120_000; // milliseconds; machines that test are busy
const flags = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

export function launch() {
  return chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', headless: true, args: flags });
}

/** Opens a report and waits until it is drawn. `complaints` gets all that went wrong, and requests to anywhere else. */
export async function open(browser, file, options = {}) {
  const page = await browser.newPage({ viewport: { width: 500, height: 700 }, ...options }); // small: the CPU draws it
  page.setDefaultTimeout(patience);
  const complaints = [];
  const own = pathToFileURL(file).href;
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('console', (message) => complaints.push(`${message.type()}: ${message.text()}`));
  page.on('request', (request) => {
    if (request.url() !== own && !/^(blob|data):/.test(request.url())) complaints.push(`request to ${request.url()}`);
  });
  await page.goto(own);
  await page.waitForFunction(() => document.documentElement.dataset.state === 'ready');
  await page.waitForFunction(() => ['ready', 'none'].includes(document.getElementById('live').dataset.state));
  await page.evaluate(prepare);
  return { page, complaints };
}

/** Defines window.look(), which draws everything and returns the bytes of each canvas by id, as Base64. */
function prepare() {
  dispatchEvent(new Event('beforeprint'));
  const isPlot = (canvas) => canvas.id === '';
  const nextFrames = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))));
  window.pixelsOf = (canvas) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height);
    const context = copy.getContext('2d', { willReadFrequently: true });
    context.drawImage(canvas, 0, 0);
    return context.getImageData(0, 0, canvas.width, canvas.height).data;
  };
  window.look = async () => {
    await nextFrames();
    const entries = [...document.querySelectorAll('canvas')].filter((canvas) => !isPlot(canvas)).map((canvas) => {
      let text = '';
      for (const byte of window.pixelsOf(canvas)) text += String.fromCharCode(byte);
      return [canvas.id, { width: canvas.width, height: canvas.height, bytes: btoa(text) }];
    });
    return Object.fromEntries(entries);
  };
}

/** { id: { width, height, data } } of all pictures of the page. */
export async function look(page) {
  const seen = await page.evaluate(() => window.look());
  for (const picture of Object.values(seen)) picture.data = Buffer.from(picture.bytes, 'base64');
  return seen;
}

/** Moves a slider, or picks a colour. */
export async function set(page, id, value) {
  await page.evaluate(([which, next]) => {
    const input = document.getElementById(which);
    input.value = next;
    input.dispatchEvent(new Event('input'));
  }, [id, value]);
}

/** Chooses or toggles the label with this text, in the part with this id. */
export async function press(page, part, text) {
  await page.locator(`#${part} label`, { hasText: text }).first().click();
}

/** Ids of the pictures that differ. */
export function changed(before, after) {
  return Object.keys(after).filter((id) => !before[id] || !before[id].data.equals(after[id].data)).sort();
}
