// SPDX-License-Identifier: Apache-2.0
// Arithmetic on pictures: Float32Array of RGBA, linear.

function colors(image) {
  return image.filter((_, i) => i % 4 !== 3);
}

/** Largest difference of any colour. */
export function difference(a, b) {
  const [x, y] = [colors(a), colors(b)];
  return x.reduce((largest, value, i) => Math.max(largest, Math.abs(value - y[i])), 0);
}

export function brightest(image) {
  return colors(image).reduce((largest, value) => Math.max(largest, value), 0);
}

export function sum(images) {
  return images[0].map((_, i) => images.reduce((total, image) => total + image[i], 0));
}

/** image * factor, of pictures or with one number. */
export function product(image, factor) {
  return image.map((value, i) => value * (typeof factor === 'number' ? factor : factor[i]));
}

/** One channel of a picture as grey. */
export function grey(image, channel) {
  return image.map((_, i) => image[i - (i % 4) + channel]);
}
