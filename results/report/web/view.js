// The view of a problem in space: what is shown, by which colours, and what the pointer says.
import { element, save } from './dom.js';
import { csvLine, formatEta } from './format.js';
import { onTheme } from './palette.js';
import { Scene3d } from './scene.js';
import { QUANTITIES, shadingOf, valuesOf } from './shading.js';
import { Shape } from './shape.js';
import { flatProjection, sketch } from './sketch.js';

const select = (label, options, onchange) => {
  const box = element('select', { onchange: () => onchange(Number(box.value)) });
  for (const [value, text] of options) box.append(element('option', { value }, text));
  return element('label', {}, `${label} `, box);
};

class SpaceView {
  constructor(place, views) {
    this.views = views;
    this.shown = { bodies: true, contacts: true, chains: true, cohesive: true };
    this.answer = 0;
    this.quantity = QUANTITIES[0];
    this.controls = element('div', { class: 'view-controls' });
    this.choices = element('div', { class: 'view-controls' });
    this.stage = element('div', {
      class: 'view-stage', tabindex: 0, role: 'application', 'aria-roledescription': '3D view',
      onkeydown: (event) => this.#key(event),
      onpointermove: (event) => this.#point(event),
      onpointerleave: () => this.#tell(-1),
    });
    this.tip = element('div', { class: 'tip', hidden: true });
    this.said = element('p', { class: 'said', 'aria-live': 'polite' });
    this.scale = element('div', { class: 'scale' });
    this.text = element('p', { class: 'reading' });
    place.replaceChildren(this.controls, this.choices, this.text,
      element('div', { class: 'stage' }, this.stage, this.tip), this.scale, this.said,
      element('p', { class: 'reading' }, 'Drag to turn, wheel or pinch to come nearer. Keys: arrows turn, + and - zoom, n and p go from contact to contact.'));
    this.#buildControls();
    try {
      this.scene = new Scene3d(this.stage, this.#width(), this.#height());
    } catch {
      this.scene = null; // no WebGL: a drawing that stands still
    }
    this.show(0);
    onTheme(() => this.#paint());
    new ResizeObserver(() => this.#fit()).observe(this.stage);
  }

  #width() {
    return Math.max(200, this.stage.clientWidth);
  }
  #height() {
    return Math.round(Math.min(560, Math.max(320, 0.62 * this.#width())));
  }
  get view() {
    return this.views[this.index];
  }

  #buildControls() {
    this.problems = select('Problem', this.views.map((view, i) => [i, view.name]), (i) => this.show(i));
    const toggle = (key, text) => element('label', {},
      element('input', { type: 'checkbox', checked: true, onchange: (event) => {
        this.shown[key] = event.target.checked;
        this.#paint();
      } }), ` ${text}`);
    this.controls.append(this.problems, toggle('bodies', 'bodies'), toggle('contacts', 'contacts'),
      toggle('chains', 'force chains'), toggle('cohesive', 'cohesive (ringed)'),
      element('div', { class: 'downloads' },
        element('button', { type: 'button', class: 'quiet', onclick: () => this.#saveSvg() }, 'SVG'),
        element('button', { type: 'button', class: 'quiet', onclick: () => this.#saveCsv() }, 'CSV')));
  }

  show(index) {
    this.index = index;
    this.answer = 0;
    this.contact = -1;
    this.problems.querySelector('select').value = index;
    const { view } = this;
    this.shape = new Shape(view);
    this.scene?.setShape(this.shape);
    const quantities = QUANTITIES.filter((q) => !q.ofBoth || view.answers.length > 1);
    if (!quantities.includes(this.quantity)) [this.quantity] = quantities;
    const colours = select('Colour', quantities.map((q, i) => [i, q.title]), (i) => {
      this.quantity = quantities[i];
      this.#paint();
    });
    colours.querySelector('select').value = quantities.indexOf(this.quantity);
    this.choices.replaceChildren(
      select('Answer of', view.answers.map((answer, i) => [i, `${answer.solver} (eta ${formatEta(answer.eta)})`]), (i) => {
        this.answer = i;
        this.#paint();
      }), colours);
    const cohesive = view.cohesive.filter((c) => c).length;
    this.text.textContent = `${view.name}: ${this.shape.count} ${this.shape.bodies.length > 0 ? 'contacts' : 'nodes'}, ${cohesive} cohesive. ${view.answers.length > 1 ? 'Two answers may differ in their forces and both be right: forces are not unique, rates are compared.' : 'Only one solver left an answer.'}`;
    this.stage.setAttribute('aria-label', `${view.name} in space. Arrow keys turn it, n and p read the contacts.`);
    this.#paint();
  }

  #paint() {
    const { view } = this;
    this.shading = shadingOf(view, this.answer, this.quantity);
    this.values = valuesOf(view, this.answer, this.quantity);
    this.colours = this.values.map(this.shading.colourOf);
    this.forces = view.answers[this.answer].force;
    this.scale.replaceChildren(
      element('b', {}, `${this.quantity.title}${this.shading.unit ? ` [${this.shading.unit}]` : ''}`),
      ...this.shading.entries.map(([shade, label]) => {
        const dot = element('i', {});
        dot.style.background = shade;
        return element('span', {}, dot, label);
      }));
    if (this.scene) this.scene.paint(this.colours, this.forces, this.shown);
    else this.stage.replaceChildren(this.#sketch());
  }

  #sketch() {
    const aspect = this.#width() / this.#height();
    const project = this.scene ? (p) => this.scene.project(p) : flatProjection(this.shape, aspect);
    return sketch(this.shape, project, aspect, this.colours, this.forces, this.shown);
  }

  #fit() {
    this.scene?.resize(this.#width(), this.#height());
  }

  #key(event) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    if (event.key in turns) this.scene?.turn(...turns[event.key]);
    else if (event.key === '+' || event.key === '=') this.scene?.zoom(0.85);
    else if (event.key === '-') this.scene?.zoom(1 / 0.85);
    else if (event.key === 'n' || event.key === 'p') {
      const by = event.key === 'n' ? 1 : -1;
      this.#tell((this.contact + by + this.shape.count) % this.shape.count);
      this.said.textContent = this.tip.textContent;
    } else return;
    event.preventDefault();
  }

  #point(event) {
    if (!this.scene || event.buttons !== 0) return;
    const box = this.stage.getBoundingClientRect();
    this.#tell(this.scene.contactAt((event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height));
  }

  #tell(contact) {
    this.contact = contact;
    this.tip.hidden = contact < 0;
    if (contact < 0) return;
    const { view, shape } = this;
    const line = (quantity) => {
      const shading = shadingOf(view, this.answer, quantity);
      return element('div', {}, element('span', {}, quantity.title), element('b', {}, shading.textOf(valuesOf(view, this.answer, quantity)[contact])));
    };
    this.tip.replaceChildren(
      element('strong', {}, `${shape.bodies.length > 0 ? 'contact' : 'node'} ${contact}: ${shape.bodiesText(contact)}${view.cohesive[contact] ? ', cohesive' : ''}`),
      ...QUANTITIES.filter((q) => q === this.quantity || ['state', 'force', 'eta_of_cone'].includes(q.id)).map(line));
    const [x, y] = this.scene ? this.scene.project(shape.contacts[contact]) : [0, 0];
    this.tip.style.left = `${Math.max(0, Math.min(x * this.#width() + 14, this.#width() - this.tip.offsetWidth - 4))}px`;
    this.tip.style.top = `${Math.max(4, Math.min(y * this.#height() + 14, this.#height() - this.tip.offsetHeight - 4))}px`;
  }

  #saveSvg() {
    save(`conebench-${this.view.name}.svg`, 'image/svg+xml', new XMLSerializer().serializeToString(this.#sketch()));
  }

  #saveCsv() {
    const { view, shape } = this;
    const used = QUANTITIES.filter((q) => !q.ofBoth || view.answers.length > 1);
    const lines = [csvLine(['contact', 'x [m]', 'y [m]', 'z [m]', 'cohesive', ...used.map((q) => `${q.title} [${q.unit(view) || '-'}]`)])];
    shape.contacts.forEach((p, i) => {
      lines.push(csvLine([i, ...p, view.cohesive[i], ...used.map((q) => {
        const value = valuesOf(view, this.answer, q)[i];
        return q.category ? shadingOf(view, this.answer, q).textOf(value) : value;
      })]));
    });
    save(`conebench-${view.name}.csv`, 'text/csv', `${lines.join('\r\n')}\r\n`);
  }
}

globalThis.conebench.data.then((data) => {
  const place = document.querySelector('.views');
  const view = new SpaceView(place, data.views);
  globalThis.conebench.showView = (index) => {
    view.show(index);
    place.scrollIntoView({ block: 'start', behavior: 'smooth' });
  };
});
