// A problem's geometry as the 3D view and its SVG draw it. No three.js here.

const point = (list, i) => [list[3 * i], list[3 * i + 1], list[3 * i + 2]];
const middle = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];

function boxOf(points) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const p of points) {
    for (let k = 0; k < 3; ++k) {
      low[k] = Math.min(low[k], p[k]);
      high[k] = Math.max(high[k], p[k]);
    }
  }
  const size = high.map((value, k) => value - low[k]);
  return { centre: low.map((value, k) => value + size[k] / 2), size, diagonal: Math.hypot(...size) || 1 };
}

export class Shape {
  constructor(view) {
    this.view = view;
    this.count = view.points.length / 3;
    this.contacts = Array.from({ length: this.count }, (_, i) => point(view.points, i));
    this.normals = view.frames.length === 3 * this.count ? this.contacts.map((_, i) => point(view.frames, i)) : null;
    this.bodies = [];
    for (let b = 0; 3 * b < view.body_positions.length; ++b) {
      this.bodies.push({ centre: point(view.body_positions, b), radius: view.body_radii[b] ?? 0 });
    }
    const touched = new Set(view.bodies_of_cone);
    this.touched = this.bodies.filter((_, b) => touched.has(b));
    this.box = boxOf([...this.contacts, ...this.touched.map((body) => body.centre)]);
    this.#sizes();
    this.#direction();
  }

  #sizes() {
    const radii = this.touched.map((body) => body.radius).filter((radius) => radius > 0);
    const flat = Math.min(...this.box.size) < 0.02 * this.box.diagonal;
    const spacing = this.box.diagonal / Math.max(2, this.count ** (flat ? 1 / 2 : 1 / 3));
    this.dot = radii.length > 0 ? 0.28 * middle(radii) : 0.3 * spacing;
    this.thickest = radii.length > 0 ? 0.36 * middle(radii) : 0.25 * spacing;
  }

  // A flat problem is looked at from the front.
  #direction() {
    const flat = this.box.size.map((size) => size < 0.02 * this.box.diagonal);
    if (flat[2]) [this.from, this.up] = [[0, 0, 1], [0, 1, 0]];
    else if (flat[1]) [this.from, this.up] = [[0, -1, 0], [0, 0, 1]];
    else [this.from, this.up] = [[0.45, -1, 0.4], [0, 0, 1]];
  }

  /** Where a force goes through contact i: from body to body, or from the contact to the one body;
   * null for a node of a medium. */
  chain(i) {
    const ends = [this.view.bodies_of_cone[2 * i], this.view.bodies_of_cone[2 * i + 1]]
      .filter((body) => body !== undefined && body >= 0)
      .map((body) => this.bodies[body]?.centre)
      .filter((centre) => centre !== undefined);
    if (ends.length === 0) return null;
    return ends.length === 2 ? ends : [this.contacts[i], ends[0]];
  }

  bodiesText(i) {
    const [a, b] = [this.view.bodies_of_cone[2 * i], this.view.bodies_of_cone[2 * i + 1]];
    if (a === undefined) return 'node';
    const name = (body) => (body < 0 ? 'wall' : `body ${body}`);
    return `${name(a)} on ${name(b)}`;
  }
}
