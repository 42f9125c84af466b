// Plots as SVG files: what C++ made, or, of plots that only the page makes, curves drawn here.
import { save, svgElement } from './dom.js';

const COLOURS = ['0072b2', 'd55e00', '009e73', 'cc79a7', 'e69f00', '56b4e9', '000', '8c6d00'];
const STYLE = [
  '.panel{fill:#fff}.grid{stroke:#d9d9d9}.frame{stroke:#595959;fill:none}',
  '.c{fill:none;stroke-width:2.2}.dot{fill:currentColor}',
  '.d1{stroke-dasharray:7 3}.d2{stroke-dasharray:2 3}.d3{stroke-dasharray:9 3 2 3}',
  ...COLOURS.map((c, i) => `.s${i}{stroke:#${c};color:#${c}}`),
].join('');

/** Saves an image with the colours that a light page has. */
export function saveImage(svg, name) {
  const copy = svg.cloneNode(true);
  const { width, height } = svg.viewBox.baseVal;
  copy.setAttribute('width', width);
  copy.setAttribute('height', height);
  copy.prepend(svgElement('style', {}, STYLE));
  save(`${name}.svg`, 'image/svg+xml', new XMLSerializer().serializeToString(copy));
}

const [LEFT, TOP, WIDTH, HEIGHT] = [74, 48, 480, 320];

/** Curves as results/svg_plot.cpp draws them, without those that have no points. */
export function curvesImage({ title, x: xAxis, y: yAxis, series: all }, mark) {
  const series = all.filter((one) => one.x.length > 0);
  const share = (axis, value) =>
    axis.scale === 'linear'
      ? (value - axis.low) / (axis.high - axis.low)
      : Math.log10(value / axis.low) / Math.log10(axis.high / axis.low);
  const x = (value) => LEFT + WIDTH * share(xAxis, value);
  const y = (value) => TOP + HEIGHT * (1 - share(yAxis, value));
  const line = (x1, y1, x2, y2, name) => svgElement('line', { x1, y1, x2, y2, class: name });
  const text = (at, up, anchor, words) => svgElement('text', { x: at, y: up, 'text-anchor': anchor }, words);
  const right = LEFT + WIDTH;
  const bottom = TOP + HEIGHT;
  const path = (one) =>
    mark === 'steps'
      ? `M${LEFT} ${y(yAxis.low).toFixed(1)}${one.x.map((value, k) => `H${x(value).toFixed(1)}V${y(one.y[k]).toFixed(1)}`).join('')}H${right}`
      : one.x.map((value, k) => `${k === 0 ? 'M' : 'L'}${x(value).toFixed(1)} ${y(one.y[k]).toFixed(1)}`).join('');
  const name = (one) => `c s${one.colour} d${one.dash}`;
  const total = Math.max(bottom + 58, TOP + 22 * (series.length + 1));
  return svgElement('svg', { viewBox: `0 0 ${right + 290} ${total}`, 'font-family': 'sans-serif', 'font-size': 13 },
    svgElement('title', {}, title),
    svgElement('rect', { width: '100%', height: '100%', class: 'panel' }),
    text(LEFT, 28, 'start', title),
    ...yAxis.ticks.flatMap(([value, label]) => [line(LEFT, y(value), right, y(value), 'grid'), text(LEFT - 8, y(value) + 4, 'end', label)]),
    ...xAxis.ticks.flatMap(([value, label]) => [line(x(value), TOP, x(value), bottom, 'grid'), text(x(value), bottom + 18, 'middle', label)]),
    svgElement('rect', { x: LEFT, y: TOP, width: WIDTH, height: HEIGHT, class: 'frame' }),
    text(LEFT + WIDTH / 2, bottom + 40, 'middle', xAxis.label),
    svgElement('text', { transform: `translate(16 ${TOP + HEIGHT / 2}) rotate(-90)`, 'text-anchor': 'middle' }, yAxis.label),
    ...series.flatMap((one, i) => [
      svgElement('path', { d: path(one), class: name(one) }),
      line(right + 24, TOP + 8 + 22 * i, right + 54, TOP + 8 + 22 * i, name(one)),
      text(right + 62, TOP + 12 + 22 * i, 'start', one.name),
    ]));
}
