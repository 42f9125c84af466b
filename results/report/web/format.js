// How numbers are written; the same as results/text.cpp and results/plot.cpp write them.

function threeDigits(value) {
  return value.toFixed(value < 9.995 ? 2 : value < 99.95 ? 1 : 0);
}

export function formatTime(seconds) {
  if (seconds === null || !Number.isFinite(seconds)) return '-';
  if (seconds < 0.9995e-6) return `${threeDigits(seconds * 1e9)} ns`;
  if (seconds < 0.9995e-3) return `${threeDigits(seconds * 1e6)} us`;
  if (seconds < 0.9995) return `${threeDigits(seconds * 1e3)} ms`;
  return `${threeDigits(seconds)} s`;
}

export function formatEta(eta) {
  if (eta === null || !Number.isFinite(eta)) return '-';
  const [digits, exponent] = eta.toExponential(1).split('e');
  return `${digits}e${exponent[0]}${exponent.slice(1).padStart(2, '0')}`;
}

export function formatNumber(value) {
  if (value === null || !Number.isFinite(value)) return '-';
  if (value === 0) return '0';
  return Math.abs(value) >= 1e-3 && Math.abs(value) < 1e5
    ? String(Number(value.toPrecision(3)))
    : formatEta(value);
}

export function formatValue(quantity, value) {
  if (value === null || value === undefined) return '-';
  switch (quantity) {
    case 'share':
      return `${Number((100 * value).toPrecision(3))} %`;
    case 'time':
      return formatTime(value);
    case 'eta':
      return formatEta(value);
    case 'count':
      return value.toFixed(0);
    default:
      return formatNumber(value);
  }
}

/** One line of CSV, RFC 4180. */
export function csvLine(cells) {
  return cells
    .map((cell) => {
      const text = cell === null || cell === undefined ? '' : String(cell);
      return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
    })
    .join(',');
}
