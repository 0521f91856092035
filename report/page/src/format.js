// Numbers for people. Unknown ones (null) are a dash.

export const UNKNOWN = '–';
const MINUS = '−';

const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);

/** `digits` significant ones, without an exponent where that is short: 0.00204, 1.43, 2.1e−5. */
export function significant(value, digits = 3) {
  if (!isNumber(value)) return UNKNOWN;
  const size = Math.abs(value);
  let text;
  if (value === 0) text = '0';
  else if (size >= 1e-3 && size < 1e5) {
    const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
    text = value.toFixed(Math.min(decimals, 20));
  } else text = value.toExponential(digits - 1).replace('e+', 'e');
  return text.replaceAll('-', MINUS);
}

/** Three digits, or what it is if no number: for values of pixels. */
export function pixelValue(value) {
  if (Number.isNaN(value)) return 'NaN';
  if (!Number.isFinite(value)) return value > 0 ? '∞' : `${MINUS}∞`;
  return significant(value);
}

/** With the prefixes k, M, G, T: counts of rays, of points. */
export function count(value) {
  if (!isNumber(value)) return UNKNOWN;
  const prefixes = ['', 'k', 'M', 'G', 'T'];
  let index = 0;
  while (Math.abs(value) >= 999.5 && index < prefixes.length - 1) {
    value /= 1000;
    index += 1;
  }
  return index === 0 ? String(value) : `${significant(value)} ${prefixes[index]}`;
}

export const mebibytes = (value) => (isNumber(value) ? significant(value / 2 ** 20) : UNKNOWN);

/** A share in percent, to 1e-4 at the finest: less is a part of a pixel. */
export function percent(value) {
  if (!isNumber(value)) return UNKNOWN;
  const text =
    Math.abs(value) < 1e-4
      ? (value * 100).toFixed(4).replace(/\.?0+$/, '')
      : significant(value * 100);
  return text === '0' && value !== 0 ? '<0.0001' : text;
}

/** "+1.5", with a sign always. */
export function stops(value) {
  return (
    (value > 0 ? '+' : value < 0 ? MINUS : '±') +
    Math.abs(value)
      .toFixed(2)
      .replace(/\.?0+$/, '')
  );
}
