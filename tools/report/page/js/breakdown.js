// What the three views of a rig's error have in common: its causes, body parts and histogram follow the rig that is chosen.

/** Rigs of the object that have `field`, and the chosen one of them (the first where another is chosen). */
function brokenDown(object, field) {
  const rigs = object.rigs.filter((rig) => rig[field]);
  return {rigs, chosen: ({rig}) => rigs.find(({spec}) => spec === rig) ?? rigs[0]};
}

/** The chosen rig beside a card's title. */
function rigName() {
  const node = element('span', {class: 'of-rig'});
  return {node, show: (rig) => node.replaceChildren(swatch(colorOf(rig.spec)), rig.spec)};
}

/** A name that fits `width` pixels of a label, by its beginning. */
function shortened(name, width) {
  const most = Math.max(3, Math.floor(width / 6.7));
  return name.length > most ? `${[...name].slice(0, most - 1).join('')}…` : name;
}

/** A share: 0.4 %, < 0.01 %, -23 %. */
function sharePercent(share) {
  const size = Math.abs(share);
  if (size > 0 && size < 1e-4) return '< 0.01\u00a0%';
  return `${share < 0 ? '−' : ''}${size >= 0.1 ? Math.round(100 * size) : Number((100 * size).toPrecision(size >= 0.01 ? 2 : 1))}\u00a0%`;
}

const signedPercent = (value) => `${value < 0 ? '−' : '+'}${(100 * Math.abs(value)).toFixed(2)}\u00a0%`;

/** One of `nodes` is a tab stop; arrow keys go from one to the next, Enter and space call `choose(i)`. */
function walkWithKeys(place, nodesNow, choose) {
  place.addEventListener('keydown', (event) => {
    const nodes = nodesNow();
    const at = nodes.indexOf(document.activeElement);
    if (at < 0) return;
    const next = {ArrowRight: at + 1, ArrowDown: at + 1, ArrowLeft: at - 1, ArrowUp: at - 1, Home: 0, End: nodes.length - 1}[event.key];
    if (event.key === 'Enter' || event.key === ' ') choose?.(at);
    else if (next === undefined) return;
    event.preventDefault();
    if (!nodes[next]) return;
    nodes[at].setAttribute('tabindex', '-1');
    nodes[next].setAttribute('tabindex', '0');
    nodes[next].focus();
  });
}

/** Transparent rows over a chart of bars, for pointer and keyboard: one of [{label, y, height}] each. */
function barRows(root, width, rows) {
  return rows.map(({label, y, height}, i) => {
    const node = svgElement('rect', {class: 'bar-row', x: 0, y, width, height, rx: 5, role: 'button', tabindex: i ? '-1' : '0', 'aria-label': label});
    root.append(node);
    return node;
  });
}
