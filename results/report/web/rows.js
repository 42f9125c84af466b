// The problems as rows: what can be asked of them, filtered and sorted. No DOM here.

export const METRICS = [
  ['time', 'time'],
  ['ratio', 'time over the fastest'],
  ['eta', 'verified eta'],
  ['iterations', 'iterations'],
  ['status', 'how it ended'],
];

export const OUTCOMES = [
  ['all', 'any outcome'],
  ['none', 'nobody solves'],
  ['some', 'some solve, some fail'],
  ['every', 'everybody solves'],
];

export class Rows {
  /** `solvers`: names, in the order of columns. */
  constructor(data, solvers) {
    this.data = data;
    this.solvers = solvers;
    this.index = solvers.map((name) => data.solvers.indexOf(name));
    this.count = data.name.length;
    this.best = [];
    this.solved = [];
    this.ran = [];
    for (let row = 0; row < this.count; ++row) {
      let best = -1;
      let solved = 0;
      let ran = 0;
      this.index.forEach((s, column) => {
        if (data.status[s][row] !== null) ++ran;
        const time = data.time_s[s][row];
        if (time === null) return;
        ++solved;
        if (best < 0 || time < data.time_s[this.index[best]][row]) best = column;
      });
      this.best.push(best);
      this.solved.push(solved);
      this.ran.push(ran);
    }
  }

  time(row, column) {
    return this.data.time_s[this.index[column]][row];
  }
  eta(row, column) {
    return this.data.eta[this.index[column]][row];
  }
  iterations(row, column) {
    return this.data.iterations[this.index[column]][row];
  }
  /** The name of the status; null: not run. */
  status(row, column) {
    const code = this.data.status[this.index[column]][row];
    return code === null ? null : this.data.statuses[code];
  }
  family(row) {
    return this.data.families[this.data.family[row]];
  }
  bestTime(row) {
    return this.best[row] < 0 ? null : this.time(row, this.best[row]);
  }
  ratio(row, column) {
    const time = this.time(row, column);
    // Below a microsecond a clock says nothing.
    return time === null ? null : Math.max(time, 1e-6) / Math.max(this.bestTime(row), 1e-6);
  }

  value(row, column, metric) {
    switch (metric) {
      case 'ratio':
        return this.ratio(row, column);
      case 'eta':
        return this.eta(row, column);
      case 'iterations':
        return this.iterations(row, column);
      case 'status':
        return this.status(row, column);
      default:
        return this.time(row, column);
    }
  }

  #passes(row, filter) {
    const { text, family, outcome, least, most, fails } = filter;
    const cones = this.data.cones[row];
    if (text && !`${this.data.name[row]} ${this.family(row)}`.toLowerCase().includes(text.toLowerCase())) return false;
    if (family !== '' && this.family(row) !== family) return false;
    if (least !== null && cones < least) return false;
    if (most !== null && cones > most) return false;
    if (outcome === 'none' && this.solved[row] > 0) return false;
    if (outcome === 'every' && this.solved[row] < this.ran[row]) return false;
    if (outcome === 'some' && (this.solved[row] === 0 || this.solved[row] === this.ran[row])) return false;
    if (fails !== '') {
      const column = Number(fails);
      if (this.status(row, column) === null || this.time(row, column) !== null) return false;
    }
    return true;
  }

  #key(row, sort, metric) {
    switch (sort) {
      case 'name':
        return this.data.name[row];
      case 'family':
        return this.family(row);
      case 'cones':
        return this.data.cones[row];
      case 'solved':
        return this.solved[row];
      case 'best':
        return this.bestTime(row);
      default:
        return this.value(row, sort, metric);
    }
  }

  /** The rows that pass, sorted by `sort` (a name or a column); what has no value comes last. */
  chosen(filter, sort, falling, metric) {
    const rows = [];
    for (let row = 0; row < this.count; ++row) if (this.#passes(row, filter)) rows.push(row);
    const keys = new Map(rows.map((row) => [row, this.#key(row, sort, metric)]));
    const turn = falling ? -1 : 1;
    rows.sort((a, b) => {
      const x = keys.get(a);
      const y = keys.get(b);
      if (x === null || y === null) return (x === null) - (y === null) || a - b;
      const order = typeof x === 'string' ? x.localeCompare(y, 'en', { numeric: true }) : x - y;
      return turn * order || a - b;
    });
    return rows;
  }
}
