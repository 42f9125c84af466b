// What is around a drawing: choices, downloads, legend, the box that follows the pointer, keys.
import { drawCurves, valueAt } from './curves.js';
import { dotText, drawDots } from './dots.js';
import { element, save, swatch } from './dom.js';
import { curvesImage, saveImage } from './image.js';
import { csvLine, formatValue } from './format.js';
import { onTheme } from './palette.js';
import { comparedAnew } from './profile.js';

const MOST_LINES = 12; // of the box
const KEY_STEP = 0.01; // of the axis

/** Which solvers are hidden, in all plots of a group. */
export class Shown {
  #hidden = new Set();
  #listeners = new Set();
  has(name) {
    return !this.#hidden.has(name);
  }
  toggle(name) {
    if (!this.#hidden.delete(name)) this.#hidden.add(name);
    this.#tell();
  }
  /** Only this one; of it alone, all again. */
  only(name, all) {
    const alone = all.every((other) => this.has(other) === (other === name));
    this.#hidden = new Set(alone ? [] : all.filter((other) => other !== name));
    this.#tell();
  }
  listen(listener) {
    this.#listeners.add(listener);
  }
  #tell() {
    for (const listener of this.#listeners) listener();
  }
}

function csvOf(variant, mark) {
  const lines = [csvLine(['series', variant.x.label, mark === 'dots' ? 'row' : variant.y.label, 'low', 'high'])];
  for (const series of variant.series) {
    series.x.forEach((x, i) => {
      const y = mark === 'dots' ? variant.y.ticks[Math.round(series.y[i])][1] : series.y[i];
      lines.push(csvLine([series.name, x, y, series.low?.[i], series.high?.[i]]));
    });
  }
  return `${lines.join('\r\n')}\r\n`;
}

export class Figure {
  /** `node`: the <figure>; `plot`: its data; `shown`: of the group. */
  constructor(node, plot, shown) {
    this.node = node;
    this.plot = plot;
    this.shown = shown;
    this.choice = 0;
    this.svgs = [...node.querySelectorAll('svg')];
    this.drawing = null;
    this.#build();
    onTheme(() => this.drawing?.redraw());
    shown.listen(() => (this.dependsOnOthers ? this.#compareAnew() : this.#update()));
    new ResizeObserver(() => this.#fit()).observe(this.host);
  }

  get variant() {
    return this.anew ?? this.plot.variants[this.choice];
  }
  // Of a performance profile: it depends on who is compared.
  get dependsOnOthers() {
    return this.plot.variants[this.choice].series.some((series) => series.times !== undefined);
  }
  get rowsAreLegend() {
    return this.plot.mark === 'dots' && this.variant.series.length === this.variant.y.ticks.length;
  }

  #build() {
    const stock = element('div', { hidden: true }, ...this.svgs);
    this.tip = element('div', { class: 'tip', hidden: true });
    this.said = element('p', { class: 'said', 'aria-live': 'polite' });
    this.host = element('div', {
      class: 'drawing',
      tabindex: 0,
      role: 'application',
      'aria-roledescription': 'plot',
      onkeydown: (event) => this.#key(event),
      onblur: () => this.drawing?.leave(),
    });
    this.legend = element('div', { class: 'legend' });
    this.node.querySelector('.drawings').replaceWith(
      this.#toolbar(),
      element('div', { class: 'stage' }, this.host, this.tip),
      this.legend,
      this.said,
      stock,
    );
    this.#describe();
    this.#drawLegend();
  }

  #toolbar() {
    const bar = element('div', { class: 'toolbar' });
    if (this.plot.variants.length > 1) {
      this.tabs = this.plot.variants.map((variant, i) =>
        element('button', { type: 'button', 'aria-pressed': String(i === 0), onclick: () => this.#choose(i) }, variant.choice.replace('<=', '≤')));
      bar.append(element('div', { class: 'tabs', role: 'group', 'aria-label': 'What is shown' }, ...this.tabs));
    }
    const name = `conebench-${this.node.id}`;
    bar.append(
      element('div', { class: 'downloads' },
        element('button', { type: 'button', class: 'quiet', 'aria-label': 'Download this plot as SVG', onclick: () => saveImage(this.#image(), name) }, 'SVG'),
        element('button', { type: 'button', class: 'quiet', 'aria-label': 'Download these numbers as CSV', onclick: () => save(`${name}.csv`, 'text/csv', csvOf(this.variant, this.plot.mark)) }, 'CSV')),
    );
    return bar;
  }

  #image() {
    const made = this.anew ? null : this.svgs[this.choice];
    return made ?? curvesImage(this.variant, this.plot.mark);
  }

  #describe() {
    this.host.setAttribute('aria-label',
      `${this.variant.title}. Across: ${this.variant.x.label}; up: ${this.variant.y.label}. Arrow keys read values.`);
  }

  // With all of them shown it is what stands in the data.
  #takeShown() {
    const all = this.plot.variants[this.choice];
    const has = (name) => this.shown.has(name);
    const compared = !this.dependsOnOthers || all.series.every((series) => has(series.name));
    this.anew = compared ? null : comparedAnew(all, has);
  }

  // The buttons stay, so that a double click is one.
  #compareAnew() {
    this.#takeShown();
    this.variant.series.forEach((series, i) => {
      const note = this.entries?.[i].querySelector('small');
      if (note) note.textContent = series.note;
    });
    if (this.drawing) this.draw();
    this.#update();
  }

  #choose(index) {
    this.choice = index;
    this.#takeShown();
    this.tabs.forEach((tab, i) => tab.setAttribute('aria-pressed', String(i === index)));
    this.#describe();
    this.#drawLegend();
    this.draw();
  }

  #drawLegend() {
    if (this.rowsAreLegend) return;
    const names = this.variant.series.map((series) => series.name);
    this.entries = this.variant.series.map((series, i) =>
      element('button', {
        type: 'button',
        title: 'Click: hide or show; double click: only this one',
        onclick: () => this.shown.toggle(series.name),
        ondblclick: () => this.shown.only(series.name, names),
        onpointerenter: () => this.drawing?.focus(i),
        onpointerleave: () => this.drawing?.focus(null),
      }, swatch(series, this.plot.mark), series.name, series.note ? element('small', {}, series.note) : null));
    this.legend.replaceChildren(...this.entries);
    this.#update();
  }

  #update() {
    this.variant.series.forEach((series, i) => {
      const shown = this.shown.has(series.name);
      this.entries?.[i].setAttribute('aria-pressed', String(shown));
      if (!this.rowsAreLegend) this.drawing?.show(i, shown);
    });
  }

  /** Draws, if it can be seen; the first time when the reader comes near. */
  draw() {
    if (this.host.clientWidth === 0) return;
    this.drawing?.destroy();
    this.width = this.host.clientWidth;
    this.drawing =
      this.plot.mark === 'dots'
        ? drawDots(this.host, this.variant, (dot, left, top) => this.#tellDot(dot, left, top))
        : drawCurves(this.host, this.variant, this.plot.mark, this.width < 520 ? 300 : 380,
            (x, left, top, chart) => this.#tellCurves(x, left, top, chart));
    this.drawing.area?.addEventListener('pointerleave', () => this.drawing.leave());
    this.#update();
  }

  #fit() {
    if (!this.drawing) return;
    const width = this.host.clientWidth;
    if (width === 0 || width === this.width) return;
    this.width = width;
    if (this.plot.mark === 'dots') this.drawing.resize(width);
    else this.draw();
  }

  #key(event) {
    const steps = { ArrowLeft: -1, ArrowRight: 1, ArrowDown: 1, ArrowUp: -1 };
    if (event.key === 'Escape') this.drawing?.leave();
    if (!(event.key in steps) || !this.drawing) return;
    event.preventDefault();
    this.byKey = true;
    const by = steps[event.key];
    if (this.plot.mark === 'dots') this.drawing.step(by);
    else if (event.key === 'ArrowLeft' || event.key === 'ArrowRight') {
      const step = (event.shiftKey ? 5 : 1) * KEY_STEP;
      this.drawing.moveTo(Math.min(1, Math.max(0, this.drawing.share() + by * step)));
    }
    this.byKey = false;
  }

  #tellCurves(x, left, top, chart) {
    if (x === null) {
      this.#hide();
      return;
    }
    const { x: xAxis, y: yAxis, series } = this.variant;
    const values = series
      .map((one, i) => ({ one, i, y: valueAt(one, x, this.plot.mark, xAxis, yAxis) }))
      .filter(({ one, y }) => y !== null && this.shown.has(one.name))
      .sort((a, b) => b.y - a.y);
    if (yAxis.quantity !== 'share' || yAxis.scale !== 'linear') values.reverse();
    const near = values.reduce(
      (best, value) => {
        const distance = Math.abs(chart.valToPos(value.y, 'y') - top);
        return distance < best.distance ? { distance, index: value.i } : best;
      },
      { distance: Infinity, index: null },
    );
    this.drawing?.focus(near.index);
    const at = `${xAxis.label.replace(/ \[.*/, '')}: ${formatValue(xAxis.quantity, x)}`;
    const lines = values.slice(0, MOST_LINES).map(({ one, i, y }) =>
      element('div', { class: i === near.index ? 'near' : '' }, swatch(one, this.plot.mark), element('span', {}, one.name),
        element('b', {}, formatValue(yAxis.quantity, y))));
    const more = values.length - lines.length;
    this.#showTip([element('strong', {}, at), ...lines, more > 0 ? element('div', {}, `and ${more} more`) : null],
      left + chart.bbox.left / devicePixelRatio, chart.bbox.top / devicePixelRatio);
    if (this.byKey) {
      this.said.textContent = `${at}. ${values.slice(0, 3).map(({ one, y }) => `${one.name} ${formatValue(yAxis.quantity, y)}`).join(', ')}`;
    }
  }

  #tellDot(dot, left, top) {
    if (!dot) {
      this.#hide();
      return;
    }
    const text = dotText(dot, this.variant);
    this.#showTip([element('strong', {}, text.row === text.name ? text.name : `${text.row}: ${text.name}`), element('div', {}, text.value)], left, top);
    if (this.byKey) this.said.textContent = `${text.row}: ${text.name} ${text.value}`;
  }

  #showTip(parts, left, top) {
    this.tip.replaceChildren(...parts.filter((part) => part !== null));
    this.tip.hidden = false;
    const room = this.host.clientWidth - this.tip.offsetWidth;
    this.tip.style.left = `${Math.max(0, left + 16 > room ? Math.min(room, left - this.tip.offsetWidth - 16) : left + 16)}px`;
    this.tip.style.top = `${top + 8}px`;
  }

  #hide() {
    this.tip.hidden = true;
    this.drawing?.focus(null);
  }
}
