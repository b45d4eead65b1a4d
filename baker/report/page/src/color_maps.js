// SPDX-License-Identifier: Apache-2.0
// Colours for numbers. Lightness rises steadily in scales, and categories are those of Okabe and Ito (2008), so both
// survive every kind of colour vision; scales also survive printing in grey.

function parse(hex) {
  return [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16));
}

/** 256 colours along the given ones. */
function scale(...stops) {
  const colors = stops.map(parse);
  return Array.from({ length: 256 }, (_, i) => {
    const place = (i / 255) * (colors.length - 1);
    const k = Math.min(Math.floor(place), colors.length - 2);
    return colors[k].map((from, c) => Math.round(from + (colors[k + 1][c] - from) * (place - k)));
  });
}

// Viridis and magma of van der Walt and Smith (2015), at nine places.
export const viridis = scale('440154', '472d7b', '3b528b', '2c728e', '21918c', '28ae80', '5ec962', 'addc30', 'fde725');
export const magma = scale('000004', '1d1147', '51127c', '832681', 'b73779', 'e75263', 'fc8961', 'fec488', 'fcfdbf');
/** Below, nothing, above. */
export const balance = scale('003f66', '0072b2', '7fb8d8', 'f7f7f7', 'eaae7f', 'd55e00', '7a3600');
export const greys = scale('000000', 'ffffff');

/** Where there is no value. */
export const nothing = parse('59636e');

export const palette = {
  blue: parse('0072b2'), sky: parse('56b4e9'), green: parse('009e73'), yellow: parse('f0e442'),
  orange: parse('e69f00'), vermilion: parse('d55e00'), purple: parse('cc79a7'),
};

export function css([r, g, b]) {
  return `rgb(${r} ${g} ${b})`;
}

/** A scale as a CSS gradient, from left to right. */
export function gradient(colors) {
  const stops = Array.from({ length: 17 }, (_, i) => css(colors[Math.round((i / 16) * 255)]));
  return `linear-gradient(to right, ${stops.join(', ')})`;
}
