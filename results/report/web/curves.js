// Curves with axes, drawn by uPlot.
import uPlot from 'uplot';
import { colour, dash, seriesColour } from './palette.js';

const FONT = '12px system-ui, sans-serif';

const scaled = (axis, value) =>
  axis.scale === 'linear' ? value : axis.scale === 'log2' ? Math.log2(value) : Math.log10(value);

/** What a series is worth at x: held since its last point (steps), or between two points. */
export function valueAt(series, x, mark, xAxis, yAxis) {
  const n = series.x.length;
  let after = 0;
  while (after < n && series.x[after] <= x) ++after;
  if (after === 0) return mark === 'steps' ? yAxis.low : null;
  if (mark === 'steps') return series.y[after - 1];
  if (after === n) return x > series.x[n - 1] * 1.0001 ? null : series.y[n - 1];
  const from = scaled(xAxis, series.x[after - 1]);
  const to = scaled(xAxis, series.x[after]);
  const share = (scaled(xAxis, x) - from) / (to - from);
  const a = series.y[after - 1];
  const b = series.y[after];
  return yAxis.scale === 'linear' ? a + share * (b - a) : a * (b / a) ** share;
}

// uPlot wants one list of x for all. Steps begin and end with the axis.
function joined(variant, mark) {
  const { x: axis, y: yAxis } = variant;
  const tables = variant.series.map((series) => {
    const order = [...series.x.keys()].sort((a, b) => series.x[a] - series.x[b]);
    const x = order.map((i) => series.x[i]);
    const y = order.map((i) => series.y[i]);
    if (mark !== 'steps') return [x, y];
    if (x.length === 0 || x[0] > axis.low) {
      x.unshift(axis.low);
      y.unshift(yAxis.low);
    }
    if (x.at(-1) < axis.high) {
      x.push(axis.high);
      y.push(y.at(-1));
    }
    return [x, y];
  });
  // Of several points at one x the last counts.
  return uPlot.join(
    tables.map(([x, y]) => {
      const keep = x.map((value, i) => i + 1 === x.length || x[i + 1] !== value);
      return [x.filter((_, i) => keep[i]), y.filter((_, i) => keep[i])];
    }),
  );
}

function scaleOf(axis) {
  return {
    time: false,
    distr: axis.scale === 'linear' ? 1 : 3,
    log: axis.scale === 'log2' ? 2 : 10,
    dir: axis.falling ? -1 : 1,
    auto: false,
    range: () => [axis.low, axis.high],
  };
}

function axisOf(axis, side, narrow, size) {
  const every = narrow && side === 2 && axis.ticks.length > 5 ? 2 : 1;
  const ticks = axis.ticks.filter((_, i) => i % every === 0);
  return {
    side,
    size,
    scale: side === 2 ? 'x' : 'y',
    label: axis.label,
    labelSize: 22,
    labelFont: FONT,
    font: FONT,
    stroke: () => colour('ink-soft'),
    grid: { stroke: () => colour('grid'), width: 1 },
    ticks: { show: false },
    splits: () => ticks.map(([value]) => value),
    filter: (_, splits) => splits,
    values: () => ticks.map(([, label]) => label),
  };
}

function seriesOf(series, mark) {
  return {
    label: series.name,
    stroke: () => seriesColour(series),
    fill: undefined,
    width: 2,
    dash: dash(series),
    spanGaps: true,
    points: mark === 'lines' && series.x.length <= 40
      ? { show: true, size: 6, fill: () => seriesColour(series), filter: ownPoints }
      : { show: false },
    paths: mark === 'steps' ? uPlot.paths.stepped({ align: 1 }) : uPlot.paths.linear(),
  };
}

// Of a joined list only the points that the series itself has.
const ownPoints = (u, index) =>
  u.data[index].flatMap((value, i) => (value === null || value === undefined ? [] : [i]));

/**
 * Draws a variant of a plot into `host`; `onPoint(x, left, top)` follows the cursor, with x = null
 * when it leaves. Returns what the figure needs to steer it.
 */
export function drawCurves(host, variant, mark, height, onPoint) {
  const width = host.clientWidth;
  const narrow = width < 520;
  const longest = Math.max(...variant.y.ticks.map(([, label]) => label.length));
  const chart = new uPlot(
    {
      width,
      height,
      legend: { show: false },
      padding: [10, 26, 0, 0],
      focus: { alpha: 0.18 },
      cursor: {
        y: false,
        drag: { x: false, y: false },
        points: { show: false },
      },
      scales: { x: scaleOf(variant.x), y: scaleOf(variant.y) },
      axes: [axisOf(variant.x, 2, narrow, 34), axisOf(variant.y, 3, narrow, 14 + 7 * longest)],
      series: [{}, ...variant.series.map((series) => seriesOf(series, mark))],
      hooks: {
        setCursor: [
          (u) => {
            const { left, top } = u.cursor;
            if (left < 0) onPoint(null);
            else onPoint(u.posToVal(left, 'x'), left, top, u);
          },
        ],
      },
    },
    joined(variant, mark),
    host,
  );
  return {
    resize: (size) => chart.setSize({ width: size, height }),
    redraw: () => chart.redraw(false, true),
    focus: (index) => chart.setSeries(index === null ? null : index + 1, { focus: true }),
    show: (index, shown) => chart.setSeries(index + 1, { show: shown }),
    moveTo: (share) => chart.setCursor({ left: share * chart.over.clientWidth, top: chart.over.clientHeight / 2 }),
    leave: () => chart.setCursor({ left: -10, top: -10 }),
    share: () => Math.max(0, chart.cursor.left) / chart.over.clientWidth,
    heightOf: (value) => chart.valToPos(value, 'y'),
    area: chart.over,
    destroy: () => chart.destroy(),
  };
}
