// SPDX-License-Identifier: Apache-2.0
// Numbers as people read them.

function raised(exponent) {
  const digits = [...String(Math.abs(exponent))].map((digit) => '\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079'[digit]);
  return (exponent < 0 ? '\u207b' : '') + digits.join('');
}

/** Three significant digits, without exponents where they can be avoided. */
export function short(value, digits = 3) {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e-4 && size < 1e7) return String(Number(value.toPrecision(digits))).replace('-', '\u2212');
  const [factor, exponent] = value.toExponential(digits - 1).split('e');
  return `${Number(factor)} \u00d7 10${raised(Number(exponent))}`.replace('-', '\u2212');
}

/** Whole numbers in groups of three. */
export function count(value) {
  return String(Math.round(value)).replace(/\B(?=(\d{3})+(?!\d))/g, '\u202f');
}

export function percent(share) {
  if (share > 0.9 && share < 1) return `${Number((100 * share).toFixed(share > 0.999 ? 4 : 2))} %`;
  return `${short(100 * share)} %`;
}

export function seconds(value) {
  if (value >= 3600) return `${short(value / 3600)} h`;
  if (value >= 120) return `${short(value / 60)} min`;
  if (value >= 1) return `${short(value)} s`;
  if (value >= 1e-3) return `${short(1e3 * value)} ms`;
  return `${short(1e6 * value)} µs`;
}

export function bytes(value) {
  if (value >= 1 << 20) return `${short(value / (1 << 20))} MiB`;
  return value >= 1 << 10 ? `${short(value / (1 << 10))} KiB` : `${value} B`;
}

export function rays(value) {
  if (value >= 1e9) return `${short(value / 1e9)} G`;
  return value >= 1e6 ? `${short(value / 1e6)} M` : count(value);
}
