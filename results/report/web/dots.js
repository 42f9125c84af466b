// Dots with intervals in rows, as SVG.
import { formatValue } from './format.js';
import { svgElement } from './dom.js';

const ROW = 30;
const SHARED_ROW = 50; // where several solvers have dots
const TOP = 6;
const BELOW = 46;

function position(axis) {
  const scale = axis.scale === 'linear' ? (v) => v : (v) => Math.log2(Math.max(v, 1e-300));
  const low = scale(axis.low);
  const high = scale(axis.high);
  return (value) => Math.min(1, Math.max(0, (scale(value) - low) / (high - low)));
}

function shortened(text, characters) {
  return text.length <= characters ? text : `${text.slice(0, characters - 1)}…`;
}

/** All dots of a variant, row by row, left to right. */
function dotsOf(variant) {
  const dots = [];
  variant.series.forEach((series, index) => {
    series.x.forEach((x, i) => {
      dots.push({ series, index, x, row: series.y[i], low: series.low?.[i] ?? null, high: series.high?.[i] ?? null });
    });
  });
  return dots.sort((a, b) => a.row - b.row || a.x - b.x);
}

/** `onDot(dot, left, top)` when one is pointed at or focused, `onDot(null)` when none is. */
export function drawDots(host, variant, onDot) {
  const names = variant.y.ticks.map(([, label]) => label);
  const rowHeight = variant.series.length === names.length ? ROW : SHARED_ROW;
  const height = TOP + rowHeight * names.length + BELOW;
  const dots = dotsOf(variant);
  let svg = null;
  let circles = [];
  let current = -1;
  const hidden = new Set();

  function choose(index) {
    current = index;
    circles.forEach((circle, i) => circle.classList.toggle('chosen', i === index));
    if (index < 0) onDot(null);
    else onDot(dots[index], Number(circles[index].getAttribute('cx')), Number(circles[index].getAttribute('cy')));
  }

  function draw(width) {
    const characters = Math.max(10, Math.floor((0.42 * width) / 7.8));
    const longest = Math.min(characters, Math.max(...names.map((name) => name.length)));
    const left = 14 + 7.8 * longest;
    const right = width - 24;
    const place = position(variant.x);
    const x = (value) => left + (right - left) * place(value);
    const y = (row) => TOP + rowHeight * (row + 0.5);
    const every = width < 520 && variant.x.ticks.length > 5 ? 2 : 1;
    const parts = names.flatMap((name, row) => [
      svgElement('line', { x1: left, x2: right, y1: y(row), y2: y(row), class: 'grid' }),
      svgElement('text', { x: left - 8, y: y(row) + 4, 'text-anchor': 'end' },
        svgElement('title', {}, name), shortened(name, characters)),
    ]);
    const bottom = TOP + rowHeight * names.length;
    variant.x.ticks.forEach(([value, label], i) => {
      if (i % every !== 0) return;
      parts.push(
        svgElement('line', { x1: x(value), x2: x(value), y1: TOP, y2: bottom, class: 'grid' }),
        svgElement('text', { x: x(value), y: bottom + 17, 'text-anchor': 'middle' }, label),
      );
    });
    parts.push(svgElement('text', { x: (left + right) / 2, y: bottom + 38, 'text-anchor': 'middle' }, variant.x.label));
    circles = [];
    dots.forEach((dot, i) => {
      const gone = hidden.has(dot.series.name) ? ' gone' : '';
      if (dot.low !== null) {
        parts.push(svgElement('line', {
          x1: x(dot.low), x2: x(dot.high ?? variant.x.high), y1: y(dot.row), y2: y(dot.row),
          class: `interval s${dot.series.colour}${gone}`,
        }));
      }
      const circle = svgElement('circle', {
        cx: x(dot.x), cy: y(dot.row), r: 6, class: `dot s${dot.series.colour}${gone}`,
      });
      circle.addEventListener('pointerenter', () => choose(i));
      circle.addEventListener('pointerleave', () => choose(-1));
      circles.push(circle);
      parts.push(circle);
    });
    const next = svgElement('svg', { viewBox: `0 0 ${width} ${height}`, width, height, class: 'dots', 'aria-hidden': 'true' }, ...parts);
    if (svg) svg.replaceWith(next);
    else host.append(next);
    svg = next;
  }

  draw(host.clientWidth);
  return {
    resize: draw,
    redraw: () => {},
    focus: (index) => circles.forEach((circle, i) =>
      circle.classList.toggle('faded', index !== null && dots[i].index !== index)),
    show: (index, shown) => {
      if (shown) hidden.delete(variant.series[index].name);
      else hidden.add(variant.series[index].name);
      draw(svg.clientWidth || host.clientWidth);
    },
    step: (by) => choose(Math.min(dots.length - 1, Math.max(0, current + by))),
    leave: () => choose(-1),
    destroy: () => svg.remove(),
  };
}

export function dotText(dot, variant) {
  const value = formatValue(variant.x.quantity, dot.x);
  const interval =
    dot.low === null
      ? ''
      : `, 95 % interval ${formatValue(variant.x.quantity, dot.low)} to ${dot.high === null ? 'no limit' : formatValue(variant.x.quantity, dot.high)}`;
  return { name: dot.series.name, row: variant.y.ticks[Math.round(dot.row)][1], value: value + interval };
}
