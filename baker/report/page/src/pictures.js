// SPDX-License-Identifier: Apache-2.0
// The pictures of a report as numbers: what runtime and baker coded as bytes (baker/report/codes.h).

/** Bytes of a data URI. */
export function bytesOf(uri) {
  return Uint8Array.from(atob(uri.slice(uri.indexOf(',') + 1)), (c) => c.charCodeAt(0));
}

/** { width, height, data } with RGBA bytes as they are in the file: no colour management. */
export async function decode(uri) {
  const blob = new Blob([bytesOf(uri)], { type: 'image/png' });
  const bitmap = await createImageBitmap(blob, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
  const context = canvas.getContext('2d', { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0);
  bitmap.close();
  return context.getImageData(0, 0, canvas.width, canvas.height);
}

/** All pictures of a page of the map that are there, decoded. */
export async function decodePage(page) {
  const entries = Object.entries(page.pictures).map(async ([name, uri]) => [name, await decode(uri)]);
  return Object.fromEntries(await Promise.all(entries));
}

export function linearOf(code) {
  const encoded = code / 255;
  return encoded <= 0.04045 ? encoded / 12.92 : ((encoded + 0.055) / 1.055) ** 2.4;
}

/** null: no value; 0: below what is told apart. `codes` are those of the report. */
export function errorOf(code, { stepsPerOctave, errorOctaves }) {
  if (code === 0) return null;
  return code === 1 ? 0 : 2 ** ((code - 2) / stepsPerOctave - errorOctaves);
}

export function differenceOf(code, { stepsPerOctave, differenceOctaves }) {
  if (code === 0) return null;
  const step = code - 128;
  return step === 0 ? 0 : Math.sign(step) * 2 ** ((Math.abs(step) - 1) / stepsPerOctave - differenceOctaves);
}

export function linearCodeOf(code, low, high) {
  return code === 0 ? null : low + ((code - 1) / 254) * (high - low);
}

export const states = ['empty', 'covered', 'unlit', 'filled', 'inside'];
export const methods = ['none', 'certificate', 'ray', 'split', 'scanline', 'monteCarlo'];
export const stateOf = (code) => code & 7;
export const methodOf = (code) => code >> 3;
