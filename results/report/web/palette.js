// The colours of the style sheet, resolved for canvases, in whichever theme is shown.
import { element } from './dom.js';

const DASHES = [[], [7, 3], [2, 3], [9, 3, 2, 3]];

let probe = null;

/** A custom property of the style sheet as a colour that a canvas takes. */
export function colour(name) {
  if (!probe) {
    probe = element('span', { hidden: true });
    document.body.append(probe);
  }
  probe.style.color = `var(--${name})`;
  return getComputedStyle(probe).color;
}

export const seriesColour = (series) => colour(`s${series.colour}`);
export const dash = (series) => DASHES[series.dash];

const listeners = new Set();

/** Called when the theme changes, from outside or by the button. */
export function onTheme(listener) {
  listeners.add(listener);
}

function darkIsShown() {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
}

export function startTheme(button) {
  const tell = () => {
    button.textContent = darkIsShown() ? 'Light' : 'Dark';
    button.setAttribute('aria-label', `Switch to ${darkIsShown() ? 'light' : 'dark'} colours`);
    for (const listener of listeners) listener();
  };
  button.addEventListener('click', () => {
    document.documentElement.dataset.theme = darkIsShown() ? 'light' : 'dark';
    tell();
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', tell);
  tell();
}
