// The page's script: unpacks the data and puts what answers to mouse and keys in the place of what
// stands there.
import { Figure, Shown } from './figure.js';
import { ProblemTable } from './table.js';
import { startTheme } from './palette.js';

async function unpack(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return JSON.parse(await new Response(stream).text());
}

/** Draws a figure when it comes near the window. */
function whenNear(figures) {
  const of = new Map(figures.map((figure) => [figure.host, figure]));
  const watch = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) {
        if (!isIntersecting || target.clientWidth === 0) continue;
        watch.unobserve(target);
        of.get(target).draw();
      }
    },
    { rootMargin: '600px' },
  );
  for (const figure of figures) watch.observe(figure.host);
}

function startGroup(node, data, hasView) {
  const shown = new Shown();
  const figures = [];
  for (const plot of data.plots) {
    const figure = node.querySelector(`figure[data-plot="${plot.id}"]`);
    if (figure) figures.push(new Figure(figure, plot, shown));
  }
  whenNear(figures);
  const place = node.querySelector('.problems');
  if (place) new ProblemTable(place, data, hasView);
}

// One group of rules is shown at a time.
function startChoice(groups) {
  const choice = document.getElementById('group');
  const links = [...document.querySelectorAll('nav a[data-section]')];
  const show = (index) => {
    groups.forEach((node, i) => {
      node.hidden = i !== index;
    });
    for (const link of links) link.setAttribute('href', `#g${index}-${link.dataset.section}`);
  };
  choice?.addEventListener('change', () => show(Number(choice.value)));
  show(0);
}

// The section that is being read is marked in the navigation.
function startNavigation() {
  const links = new Map([...document.querySelectorAll('nav a')].map((link) => [link, () => document.querySelector(link.hash)]));
  const mark = () => {
    let current = null;
    for (const [link, target] of links) {
      const node = target();
      if (node && node.getBoundingClientRect().top < innerHeight * 0.3) current = link;
    }
    for (const link of links.keys()) link.toggleAttribute('aria-current', link === current);
  };
  addEventListener('scroll', mark, { passive: true });
  mark();
}

async function start() {
  document.documentElement.classList.add('scripts');
  startTheme(document.getElementById('theme'));
  const groups = [...document.querySelectorAll('.group')];
  startChoice(groups);
  startNavigation();
  const data = await unpack(document.getElementById('data').textContent);
  groups.forEach((node, i) => startGroup(node, data.groups[i], (name) => data.views.findIndex((view) => view.name === name)));
  return data;
}

// For the 3D view, which is a script of its own.
globalThis.conebench = { data: start() };
