// The same view as an SVG: to download, and where there is no WebGL.
import { svgElement } from './dom.js';

const WIDTH = 900;

/** `project(point)` gives [x, y, depth], from 0 to 1. */
export function sketch(shape, project, aspect, colours, forces, shown) {
  const height = WIDTH / aspect;
  const place = (p) => {
    const [x, y, depth] = project(p);
    return { x: (x * WIDTH).toFixed(1), y: (y * height).toFixed(1), depth };
  };
  // The size of a sphere there, from a point one radius aside.
  const [ax, ay] = project(shape.box.centre);
  const aside = shape.up[1] === 1 ? [1, 0, 0] : [shape.from[1] ? 1 : 0, 0, shape.from[1] ? 0 : 1];
  const [bx, by] = project(shape.box.centre.map((v, k) => v + aside[k] * 0.01 * shape.box.diagonal));
  const perUnit = Math.hypot((bx - ax) * WIDTH, (by - ay) * height) / (0.01 * shape.box.diagonal);

  const marks = [];
  const add = (depth, node) => marks.push({ depth, node });
  if (shown.bodies) {
    for (const { centre, radius } of shape.touched) {
      const { x, y, depth } = place(centre);
      add(depth + 1, svgElement('circle', { cx: x, cy: y, r: Math.max(1, (radius || shape.dot) * perUnit).toFixed(1), fill: '#8884', stroke: '#888', 'stroke-width': 0.5 }));
    }
  }
  const largest = Math.max(...forces) || 1;
  shape.contacts.forEach((contact, i) => {
    const at = place(contact);
    const ends = shown.chains ? shape.chain(i) : null;
    const thickness = 2 * shape.thickest * perUnit * Math.sqrt(Math.max(0, forces[i]) / largest);
    if (ends && thickness > 0.1) {
      const [a, b] = ends.map(place);
      add(at.depth, svgElement('line', { x1: a.x, y1: a.y, x2: b.x, y2: b.y, stroke: colours[i], 'stroke-width': thickness.toFixed(1), 'stroke-linecap': 'round' }));
    }
    const r = Math.max(1, shape.dot * perUnit);
    if (shown.contacts) add(at.depth - 1e-6, svgElement('circle', { cx: at.x, cy: at.y, r: r.toFixed(1), fill: colours[i] }));
    if (shown.cohesive && shape.view.cohesive[i]) {
      add(at.depth - 2e-6, svgElement('circle', { cx: at.x, cy: at.y, r: (1.7 * r).toFixed(1), fill: 'none', stroke: '#cc79a7', 'stroke-width': 1.5 }));
    }
  });
  marks.sort((a, b) => b.depth - a.depth);
  return svgElement('svg', { xmlns: 'http://www.w3.org/2000/svg', viewBox: `0 0 ${WIDTH} ${height.toFixed(0)}`, role: 'img' },
    svgElement('title', {}, shape.view.name), ...marks.map(({ node }) => node));
}

/** A projection without a camera: along shape.from. */
export function flatProjection(shape, aspect) {
  const { centre, diagonal } = shape.box;
  const scale = 0.9 / diagonal;
  const front = shape.up[1] === 1 ? (d) => [d[0], d[1], -d[2]] : (d) => [d[0] * 0.91 + d[1] * 0.41 * (shape.from[0] ? 1 : 0), d[2], d[1]];
  return (p) => {
    const [x, y, depth] = front(p.map((v, k) => v - centre[k]));
    return [0.5 + (x * scale) / Math.max(1, aspect), 0.5 - y * scale * Math.min(1, aspect), depth];
  };
}
