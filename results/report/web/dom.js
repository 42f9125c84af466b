// Small helpers over the DOM. Styles are set through properties, never as attributes: the page's
// policy forbids those.

const SVG = 'http://www.w3.org/2000/svg';

function fill(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else if (value !== null && value !== false) node.setAttribute(name, value === true ? '' : value);
  }
  node.append(...children.filter((child) => child !== null));
  return node;
}

/** element('p', {class: 'note', onclick: f}, 'text', child) */
export function element(name, attributes, ...children) {
  return fill(document.createElement(name), attributes, children);
}

export function svgElement(name, attributes, ...children) {
  return fill(document.createElementNS(SVG, name), attributes, children);
}

/** Lets the browser save a text as a file. */
export function save(name, type, text) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  const link = element('a', { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** A line or a dot in a series' colour, as in the plots. */
export function swatch(series, mark) {
  const shape =
    mark === 'dots'
      ? svgElement('circle', { cx: 14, cy: 5, r: 4.5, class: `dot s${series.colour}` })
      : svgElement('line', { x1: 0, y1: 5, x2: 28, y2: 5, class: `c s${series.colour} d${series.dash}` });
  return svgElement('svg', { class: 'swatch', viewBox: '0 0 28 10', width: 28, height: 10, 'aria-hidden': 'true' }, shape);
}
