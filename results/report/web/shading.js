// What contacts can be coloured by, and the colours. Cividis-like for amounts: readable without
// colour vision, and light is more on either theme's ground.
import { colour } from './palette.js';
import { formatEta, formatNumber } from './format.js';

const STOPS = [
  [0, [0, 34, 78]], [0.15, [26, 56, 111]], [0.3, [71, 81, 107]], [0.45, [104, 105, 111]],
  [0.6, [140, 132, 116]], [0.75, [183, 164, 105]], [0.9, [229, 200, 77]], [1, [254, 232, 56]],
];
const DECADES = 8; // of a logarithmic scale, below the largest value

export const STATES = ['open', 'stick', 'slide'];
const STATE_COLOURS = ['ink-soft', 's0', 's1'];

export const QUANTITIES = [
  { id: 'state', title: 'status', unit: () => '', category: true },
  { id: 'force', title: 'force', unit: (view) => view.force_unit },
  { id: 'normal_force', title: 'normal force (pull < 0)', unit: (view) => view.force_unit },
  { id: 'eta_of_cone', title: 'eta of the contact', unit: () => '-', log: true },
  { id: 'penetration', title: 'penetration rate', unit: (view) => view.rate_unit, log: true },
  { id: 'cone_violation', title: 'force outside the friction cone', unit: (view) => view.force_unit, log: true },
  { id: 'work', title: 'work of force on rate', unit: (view) => `${view.force_unit} ${view.rate_unit}`, log: true },
  { id: 'misalignment', title: 'friction against sliding', unit: () => 'rad' },
  { id: 'rate_difference', title: 'difference of the rates', unit: (view) => view.rate_unit, log: true, ofBoth: true },
  { id: 'force_difference', title: 'difference of the forces', unit: (view) => view.force_unit, log: true, ofBoth: true },
];

export function valuesOf(view, answer, quantity) {
  return quantity.ofBoth ? view[quantity.id] : view.answers[answer][quantity.id];
}

function ramp(share) {
  const at = Math.min(1, Math.max(0, share));
  let i = 1;
  while (i + 1 < STOPS.length && STOPS[i][0] < at) ++i;
  const [from, a] = STOPS[i - 1];
  const [to, b] = STOPS[i];
  const t = (at - from) / (to - from);
  return `rgb(${a.map((v, k) => Math.round(v + t * (b[k] - v))).join(' ')})`;
}

/** {colourOf(value), textOf(value), entries: [[colour, label], ...]}: entries make the legend. */
export function shadingOf(view, answer, quantity) {
  const values = valuesOf(view, answer, quantity);
  if (quantity.category) {
    const colours = STATE_COLOURS.map((name) => colour(name));
    return {
      colourOf: (value) => colours[value],
      textOf: (value) => STATES[value],
      entries: STATES.map((state, i) => [colours[i], `${state}: ${values.filter((value) => value === i).length}`]),
    };
  }
  const finite = values.filter((value) => value !== null);
  const high = Math.max(...finite, 0);
  const low = quantity.log ? high * 10 ** -DECADES : Math.min(...finite, 0);
  const width = high - low;
  const share = quantity.log
    ? (value) => (value <= low ? 0 : 1 + Math.log10(value / high) / DECADES)
    : (value) => (width === 0 ? 0 : (value - low) / width);
  const unit = quantity.unit(view);
  const write = (value) => (quantity.log && value !== 0 ? formatEta(value) : formatNumber(value));
  const entries = [0, 0.25, 0.5, 0.75, 1].map((at) => {
    const value = quantity.log ? high * 10 ** (DECADES * (at - 1)) : low + at * width;
    return [ramp(at), (at === 0 && quantity.log ? '≤ ' : '') + write(value)];
  });
  return {
    colourOf: (value) => (value === null || high === 0 ? colour('ink-soft') : ramp(share(value))),
    textOf: (value) => `${write(value)} ${unit}`,
    entries: high === 0 && low === 0 ? [[colour('ink-soft'), `0 ${unit} everywhere`]] : entries,
    unit,
  };
}
