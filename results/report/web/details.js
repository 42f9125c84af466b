// One problem: how each solver came along, and its convergence curves.
import { Figure, Shown } from './figure.js';
import { element } from './dom.js';
import { formatEta, formatTime } from './format.js';

const decade = (value, round) => 10 ** round(Math.log10(value));

// An axis over decades around all values.
function axis(label, quantity, values) {
  const low = decade(Math.max(1e-18, Math.min(...values)), Math.floor);
  const high = Math.max(decade(Math.max(...values), Math.ceil), 10 * low);
  const count = Math.round(Math.log10(high / low));
  const every = Math.ceil(count / 8);
  const ticks = [];
  for (let k = 0; k <= count; k += every) {
    const value = Number((low * 10 ** k).toPrecision(3));
    ticks.push([value, quantity === 'time' ? formatTime(value).replace(/\.00?(?= )/, '') : formatEta(value).replace('.0', '')]);
  }
  return { label, quantity, scale: 'log10', low, high, falling: false, ticks };
}

export class ProblemDetails {
  constructor(rows, series, viewIndex) {
    this.rows = rows;
    this.series = series;
    this.viewIndex = viewIndex;
    this.row = -1;
    this.node = element('div', { class: 'details', hidden: true });
  }

  show(row) {
    this.row = row;
    const { data } = this.rows;
    const view = this.viewIndex(data.name[row]);
    this.node.hidden = false;
    this.node.replaceChildren(
      element('h3', {}, data.name[row]),
      element('p', { class: 'reading' }, `${this.rows.family(row)}, ${data.cones[row]} cones; solved by ${this.rows.solved[row]} of ${this.rows.ran[row]}. `,
        view < 0 ? null : element('button', { type: 'button', onclick: () => globalThis.conebench.showView?.(view) }, 'Show it in space')),
      this.#figure(row) ?? element('p', { class: 'reading' }, 'Its convergence curves are not in this page: only those of the hardest problems are, and none where solvers stopped on their own tests. They are in the journal.'),
      this.#table(row));
    this.figure?.draw();
    this.node.scrollIntoView({ block: 'nearest', behavior: 'smooth' });
  }

  #table(row) {
    const { rows } = this;
    const lines = rows.solvers.map((name, column) => {
      const status = rows.status(row, column);
      if (status === null) return null;
      return element('tr', {}, element('th', { scope: 'row' }, element('code', {}, name)),
        element('td', {}, formatTime(rows.time(row, column))), element('td', {}, formatEta(rows.eta(row, column))),
        element('td', {}, String(rows.iterations(row, column))), element('td', {}, status));
    });
    const head = ['solver', 'time to the tolerance', 'verified eta', 'iterations', 'how it ended'];
    return element('div', { class: 'scroll', tabindex: 0 }, element('table', {},
      element('thead', {}, element('tr', {}, ...head.map((text) => element('th', { scope: 'col' }, text)))),
      element('tbody', {}, ...lines)));
  }

  #figure(row) {
    this.figure = null;
    const curves = this.rows.data.curves[row];
    if (!curves) return null;
    const series = curves
      .map(([solver, x, y]) => ({ ...this.series.find((one) => one.name === this.rows.data.solvers[solver]), note: '', x: x.map((t) => Math.max(t, 1e-7)), y: y.map((eta) => Math.max(eta, 1e-18)) }))
      .sort((a, b) => this.rows.solvers.indexOf(a.name) - this.rows.solvers.indexOf(b.name));
    const variant = {
      choice: '',
      title: 'Convergence on this problem',
      x: axis('solver time [s]', 'time', series.flatMap((one) => one.x)),
      y: axis('verified eta, best so far [-]', 'eta', series.flatMap((one) => one.y)),
      series,
    };
    const node = element('figure', { class: 'plot', id: 'details-convergence' },
      element('figcaption', {}, element('h4', {}, variant.title)), element('div', { class: 'drawings' }));
    this.figure = new Figure(node, { id: 'convergence', mark: 'lines', variants: [variant] }, new Shown());
    return node;
  }
}
