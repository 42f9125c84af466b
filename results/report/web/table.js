// All problems in a table that holds only the rows in sight.
import { element, save } from './dom.js';
import { csvLine, formatEta, formatNumber, formatTime } from './format.js';
import { ProblemDetails } from './details.js';
import { METRICS, OUTCOMES, Rows } from './rows.js';

const ROW_HEIGHT = 32; // as in the style sheet
const AROUND = 12; // rows drawn beyond the window

const STATUS_TEXT = {
  iteration_limit: 'iterations',
  time_limit: 'time',
  killed_time: 'killed: time',
  killed_memory: 'killed: memory',
  not_finite: 'not finite',
  bad_output: 'bad output',
  bad_abi: 'bad ABI',
};

const select = (label, options, onchange) =>
  element('label', {}, `${label} `, element('select', { onchange }, ...options.map(([value, text]) => element('option', { value }, text))));

export class ProblemTable {
  constructor(place, data, viewIndex) {
    const ranked = data.plots.find((plot) => plot.id === 'solved').variants[0].series;
    this.rows = new Rows(data.problems, ranked.map((series) => series.name));
    this.series = ranked;
    this.sort = 'name';
    this.falling = false;
    this.metric = 'time';
    this.filter = { text: '', family: '', outcome: 'all', least: null, most: null, fails: '' };
    this.details = new ProblemDetails(this.rows, ranked, viewIndex);
    this.#build(place);
    this.#refresh();
  }

  #build(place) {
    this.count = element('output', { class: 'count' });
    this.head = element('thead');
    this.body = element('tbody');
    this.table = element('table', { class: 'all', 'aria-rowcount': this.rows.count + 1 }, this.#columns(), this.head, this.body);
    this.window = element('div', { class: 'window', tabindex: 0, role: 'group', 'aria-label': 'All problems', onscroll: () => this.#drawRows() }, this.table);
    place.replaceChildren(this.#filters(), this.count, this.#key(), this.window, this.details.node);
    new ResizeObserver(() => this.#drawRows()).observe(this.window);
  }

  #columns() {
    const widths = ['name', 'family', 'cones', 'solved', 'best', ...this.rows.solvers.map(() => 'solver')];
    return element('colgroup', {}, ...widths.map((name) => element('col', { class: `col-${name}` })));
  }

  #filters() {
    const change = (key, read) => (event) => {
      this.filter[key] = read(event.target.value);
      this.#refresh();
    };
    const number = (text) => (text === '' ? null : Number(text));
    const same = (text) => text;
    const families = [...this.rows.data.families].sort();
    const size = (label, key) =>
      element('label', {}, `${label} `, element('input', { type: 'number', min: 0, inputmode: 'numeric', oninput: change(key, number) }));
    return element('form', { class: 'filters', onsubmit: (event) => event.preventDefault() },
      element('label', {}, 'Search ', element('input', { type: 'search', placeholder: 'name or scene', oninput: change('text', same) })),
      select('Scene', [['', 'all'], ...families.map((name) => [name, name || '(none)'])], change('family', same)),
      select('Outcome', OUTCOMES, change('outcome', same)),
      select('Fails', [['', 'whoever'], ...this.rows.solvers.map((name, i) => [i, name])], change('fails', same)),
      size('Cones from', 'least'), size('to', 'most'),
      select('Show', METRICS, (event) => {
        this.metric = event.target.value;
        this.#refresh();
      }),
      element('button', { type: 'button', class: 'quiet', onclick: () => this.#save() }, 'CSV'));
  }

  #key() {
    const entry = (name, text) => element('span', {}, element('i', { class: `box ${name}` }), text);
    return element('p', { class: 'key' }, entry('r0', 'fastest'), entry('r1', 'within 2 times'),
      entry('r2', 'within 10 times'), entry('r3', 'slower'), entry('fail', 'failed'));
  }

  #drawHead() {
    const heads = [['name', 'problem'], ['family', 'scene'], ['cones', 'cones'], ['solved', 'solved by'], ['best', 'best'],
      ...this.rows.solvers.map((name, column) => [column, name])];
    this.head.replaceChildren(element('tr', { 'aria-rowindex': 1 }, ...heads.map(([sort, text]) => {
      const here = this.sort === sort;
      return element('th', { scope: 'col', class: sort === 'family' ? 'left' : null, 'aria-sort': here ? (this.falling ? 'descending' : 'ascending') : 'none' },
        element('button', { type: 'button', title: text, onclick: () => this.#sortBy(sort) }, text,
          element('span', { class: 'arrow', 'aria-hidden': 'true' }, here ? (this.falling ? '▼' : '▲') : '')));
    })));
  }

  #sortBy(sort) {
    this.falling = this.sort === sort ? !this.falling : sort === 'solved' || sort === 'cones' ? this.falling : false;
    this.sort = sort;
    this.#refresh();
    this.head.querySelector('[aria-sort$="ending"] button')?.focus();
  }

  #refresh() {
    this.chosen = this.rows.chosen(this.filter, this.sort, this.falling, this.metric);
    this.count.textContent = `${this.chosen.length} of ${this.rows.count} problems`;
    this.#drawHead();
    this.window.scrollTop = 0;
    this.drawn = null;
    this.#drawRows();
  }

  #drawRows() {
    const first = Math.max(0, Math.floor(this.window.scrollTop / ROW_HEIGHT) - AROUND);
    const last = Math.min(this.chosen.length, first + Math.ceil(this.window.clientHeight / ROW_HEIGHT) + 2 * AROUND);
    if (this.drawn === `${first} ${last}`) return;
    this.drawn = `${first} ${last}`;
    const space = (rows) => {
      const cell = element('td', { colspan: this.rows.solvers.length + 5 });
      cell.style.height = `${rows * ROW_HEIGHT}px`;
      return element('tr', { class: 'space', 'aria-hidden': 'true' }, cell);
    };
    this.body.replaceChildren(space(first),
      ...this.chosen.slice(first, last).map((row, i) => this.#row(row, first + i)),
      space(this.chosen.length - last));
  }

  #row(row, place) {
    const { rows } = this;
    const best = rows.best[row];
    return element('tr', { 'aria-rowindex': place + 2, class: row === this.details.row ? 'open' : null },
      element('th', { scope: 'row' }, element('button', { type: 'button', title: rows.data.name[row], onclick: () => this.#open(row) }, rows.data.name[row])),
      element('td', { class: 'left', title: rows.family(row) }, rows.family(row)),
      element('td', {}, String(rows.data.cones[row])),
      element('td', {}, `${rows.solved[row]}/${rows.ran[row]}`),
      element('td', {}, best < 0 ? '-' : formatTime(rows.bestTime(row))),
      ...rows.solvers.map((_, column) => this.#cell(row, column)));
  }

  #cell(row, column) {
    const { rows, metric } = this;
    const status = rows.status(row, column);
    if (status === null) return element('td', { class: 'absent' }, 'not run');
    const ratio = rows.ratio(row, column);
    const heat = ratio === null ? 'fail' : ratio <= 1 ? 'r0' : ratio <= 2 ? 'r1' : ratio <= 10 ? 'r2' : 'r3';
    const title = `${rows.solvers[column]}: ${status}, eta ${formatEta(rows.eta(row, column))}`;
    return element('td', { class: heat, title }, this.#text(row, column, status, ratio, metric));
  }

  #text(row, column, status, ratio, metric) {
    if (metric === 'eta') return formatEta(this.rows.eta(row, column));
    if (metric === 'iterations') return String(this.rows.iterations(row, column));
    if (metric === 'status') return STATUS_TEXT[status] ?? status;
    if (ratio === null) return status === 'converged' ? 'late' : STATUS_TEXT[status] ?? status;
    return metric === 'ratio' ? formatNumber(ratio) : formatTime(this.rows.time(row, column));
  }

  #open(row) {
    this.details.show(row);
    this.drawn = null;
    this.#drawRows();
  }

  #save() {
    const { rows, metric } = this;
    const unit = metric === 'time' ? ' [s]' : metric === 'status' ? '' : ' [-]';
    const lines = [csvLine(['problem', 'scene', 'cones', 'solved by', ...rows.solvers.map((name) => `${name}: ${metric}${unit}`)])];
    for (const row of this.chosen) {
      lines.push(csvLine([rows.data.name[row], rows.family(row), rows.data.cones[row], rows.solved[row],
        ...rows.solvers.map((_, column) => rows.value(row, column, metric))]));
    }
    save('conebench-problems.csv', 'text/csv', `${lines.join('\r\n')}\r\n`);
  }
}
