// Where the error comes from: the squared error of every rig as a bar of its causes. Causes are not independent: what their
// squares are too much or too little is the interaction, and with it the parts add up.

const causes = {
  'truncation': {color: 'var(--cause-truncation)', label: 'SH truncation', what: 'what the bands of SH cannot hold, clamped at 0, against exact irradiance'},
  'spatial': {color: 'var(--cause-spatial)', label: 'Spatial', what: 'the rig against SH projected at every point'},
  'near form': {color: 'var(--cause-near)', label: 'Near form', what: 'near lights as shaders evaluate them against exact irradiance'},
  'light model': {color: 'var(--cause-light)', label: 'Light model', what: 'lights projected in float, disks by six nodes, against double'},
  'precision': {color: 'var(--cause-precision)', label: 'Precision', what: 'the rig in 32 bits against double'},
};

function errorParts(object, store) {
  const {rigs, chosen} = brokenDown(object, 'parts');
  if (!rigs.some((rig) => rig.parts.total > 0)) return null;
  const view = makeStore({scale: 'share'});
  const scale = choice('Bars', [
    {value: 'share', label: 'Shares', title: 'Every rig’s parts per its own total squared error'},
    {value: 'square', label: 'One scale', title: 'Squared errors of all rigs on one axis'},
  ], (value) => view.set({scale: value}));
  const advice = element('p', {class: 'verdict'});
  const legend = element('div', {class: 'cause-legend'});
  const place = element('div', {class: 'plot parts'});
  const readout = element('p', {class: 'hint', 'aria-live': 'polite'});
  const title = element('p', {class: 'panel-title'});
  let rows = [];

  const say = (rig) => readout.replaceChildren(...(rig ? [swatch(colorOf(rig.spec)), ' ', element('b', {}, rig.spec), `: ${describeParts(rig)}`] :
    ['Squares of the parts and their interaction add up to the square of the total RMS (the tick). Hatched: interaction; where causes cancel it is taken off.']));
  const mark = (values) => {
    const rig = chosen(values);
    rigs.forEach((other, i) => rows[i]?.setAttribute('aria-pressed', String(other === rig)));
    advice.replaceChildren(element('span', {class: 'spec'}, swatch(colorOf(rig.spec)), rig.spec), `: ${whatToDo(rig, object)}`);
    legend.replaceChildren(...legendOf(rig));
  };
  const drawing = drawToWidth(place, (width) => {
    const focused = rows.indexOf(document.activeElement);
    const {root, boxes} = drawParts(rigs, width, view.get().scale);
    rows = barRows(root, width, boxes.map((box, i) => ({...box, label: `${rigs[i].spec}: ${describeParts(rigs[i])}`})));
    rows.forEach((node, i) => fillIn(node, {on: {
      click: () => store.set({rig: rigs[i].spec}), focus: () => say(rigs[i]), blur: () => say(null), pointerenter: () => say(rigs[i]), pointerleave: () => say(null),
    }}, []));
    place.replaceChildren(root);
    mark(store.get());
    if (focused >= 0) rows[focused].focus();
  });
  walkWithKeys(place, () => rows, (i) => store.set({rig: rigs[i].spec}));
  const behind = tableBehind(`Causes of the error of ${object.name}`, () => partsTable(rigs));

  view.watch(({scale: value}) => {
    scale.show(value);
    title.textContent = value === 'share' ? 'Share of the squared total error, %; total RMS at the right' : 'Squared total error, %²; total RMS at the right';
    drawing.again();
  }, 'scale');
  store.watch(mark, 'rig');
  say(null);
  return element('div', {class: 'card error-parts'}, element('div', {class: 'bar'}, element('h3', {}, 'Where the error comes from'), scale.node),
    advice, legend, title, place, readout, behind.node);
}

const partOf = (rig, name) => rig.parts.causes.find(({cause}) => cause === name);
const knownCauses = (rig) => Object.keys(causes).map((name) => partOf(rig, name)).filter(Boolean);

/** "total RMS 5.12 %; of its square truncation 91 %, spatial 33 %, interaction −23 %; without truncation 2.93 %, ..." */
function describeParts(rig) {
  const {total, interaction} = rig.parts;
  if (!(total > 0)) return 'no error';
  const shown = knownCauses(rig).filter(({square}) => square > 1e-4 * total);
  const rest = shown.length < knownCauses(rig).length ? ', all others below 0.01 %' : '';
  return `total RMS ${percent(Math.sqrt(total))}; of its square ${shown.map(({cause, square}) => `${cause} ${sharePercent(square / total)}`).join(', ')}, interaction ${sharePercent(interaction / total)}${rest}. ` +
    `RMS without ${shown.map(({cause, without}) => `${cause} ${percent(Math.sqrt(without))}`).join(', without ')}; without the clamp at 0 ${percent(Math.sqrt(rig.parts.unclamped))}`;
}

function legendOf(rig) {
  const {total, interaction} = rig.parts;
  const entries = knownCauses(rig).map(({cause, square}) => ({mark: swatch(causes[cause].color), label: causes[cause].label, title: causes[cause].what, value: square}));
  entries.push({mark: element('span', {class: 'swatch hatched', 'aria-hidden': 'true'}), label: 'Interaction', title: 'twice the products of all pairs of causes: negative where they cancel', value: interaction});
  return entries.map(({mark, label, title, value}) => element('span', {class: 'entry', title}, mark, label,
    element('span', {class: 'value'}, total > 0 ? sharePercent(value / total) : '–')));
}

/** In a sentence or two, what the largest part asks for. */
function whatToDo(rig, object) {
  const {total} = rig.parts;
  if (!(total > 0)) return 'no error.';
  if (total < 1e-8) return `total RMS is ${percent(Math.sqrt(total))}: nothing is left to gain.`;
  const [first, second] = [...knownCauses(rig)].sort((a, b) => b.square - a.square);
  if (second.square > 0.6 * first.square) {
    return `${first.cause} and ${second.cause} weigh about the same (${sharePercent(first.square / total)} and ${sharePercent(second.square / total)} of the squared error). ` +
      `${helpFor(first.cause, rig, object)} ${helpFor(second.cause, rig, object)}`;
  }
  return `${first.cause} dominates; without it total RMS would be ${percent(Math.sqrt(first.without))} instead of ${percent(Math.sqrt(total))}. ${helpFor(first.cause, rig, object)}`;
}

function helpFor(cause, rig, object) {
  switch (cause) {
    case 'truncation':
      return `${moreNear(rig, true)}${moreBands(object)} would help against truncation, a larger rig would not.`;
    case 'spatial':
      return `${moreNear(rig, false)} or a larger rig would help against the spatial error, more bands would not.`;
    case 'near form':
      return 'On materials with wrap near lights are evaluated to 1 or 2\u00a0% of their peak: less wrap or fewer near lights would help.';
    case 'light model':
      return 'Lights are projected in 32 bits, disks by six nodes: nothing larger is wrong.';
    default:
      return 'The arithmetic of 32 bits is what is left: nothing larger is wrong.';
  }
}

/** What gives a rig more near lights: a number, or what it aims at. */
function moreNear(rig, truncation) {
  if (rig.asked.includes('--budget-us')) return 'More time (--budget-us)';
  if (rig.asked.includes('--total-error')) return 'A lower --total-error';
  if (rig.asked.includes('--error')) return truncation ? 'Aiming at the total error (--total-error), which sees truncation,' : 'A lower --error';
  return 'More near lights (--near)';
}

/** The fourth band of the Lambert kernel is 0. */
function moreBands(object) {
  const {bands} = report;
  if (bands >= 5) return '';
  if (bands === 3 && !sceneOf(object).effects.some((effect) => effect.endsWith('wrap'))) return ' or --bands\u00a05 (a fourth band holds nothing of Lambert)';
  return ` or --bands\u00a0${bands + 1}`;
}

/** Pieces of a rig's bar, in shares of `unit`: causes one after another, then the interaction up or back to the total. */
function piecesOf(rig, unit) {
  let end = 0;
  const pieces = knownCauses(rig).map(({cause, square}) => ({spec: rig.spec, x1: end, x2: end += square / unit, color: causes[cause].color}));
  return {spec: rig.spec, pieces, sum: end, total: rig.parts.total / unit};
}

function drawParts(rigs, width, scale) {
  const bars = rigs.map((rig) => piecesOf(rig, scale === 'share' ? rig.parts.total || 1 : 1e-4));
  const narrow = width < 520;
  const margin = {left: narrow ? 114 : 128, right: 62, top: 6, bottom: 26};
  const row = 34;
  const height = margin.top + margin.bottom + row * bars.length;
  const hatch = `hatch-${drawParts.drawn = (drawParts.drawn ?? 0) + 1}`;
  const most = Math.max(...bars.map(({sum, total}) => Math.max(sum, total))) || 1;
  const middle = {insetTop: 6, insetBottom: 11};
  const ticks = narrow ? 3 : 8;
  const root = Plot.plot({
    width, height, marginLeft: margin.left, marginRight: margin.right, marginTop: margin.top, marginBottom: margin.bottom, style: chartStyle,
    x: {domain: [0, 1.02 * most], label: null, ticks, tickFormat: scale === 'share' ? percentTick : (value) => (value >= 1000 ? `${value / 1000}k` : tickLabel(value))},
    y: {type: 'band', domain: bars.map(({spec}) => spec), padding: 0, label: null, axis: null},
    color: {type: 'identity'},
    marks: [
      Plot.gridX({ticks, ...gridStyle}),
      Plot.barX(bars.flatMap(({pieces}) => pieces), {x1: 'x1', x2: 'x2', y: 'spec', fill: 'color', className: 'pieces', ...middle}),
      Plot.barX(bars.filter(({sum, total}) => total > sum), {x1: 'sum', x2: 'total', y: 'spec', fill: `url(#${hatch})`, stroke: 'var(--muted)', className: 'added', ...middle}),
      Plot.barX(bars.filter(({sum, total}) => total < sum), {x1: 'total', x2: 'sum', y: 'spec', fill: `url(#${hatch})`, stroke: 'var(--muted)', className: 'taken', insetTop: row - 12, insetBottom: 4}),
    ],
  });
  root.prepend(svgElement('defs', {}, svgElement('pattern', {id: hatch, width: 5, height: 5, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)'},
    svgElement('rect', {width: 5, height: 5, fill: 'var(--card)'}), svgElement('rect', {width: 2, height: 5, fill: 'var(--muted)'}))));
  root.setAttribute('role', 'group');
  root.setAttribute('aria-label', 'Causes of the squared error of each rig; arrow keys go from rig to rig, Enter chooses one');
  const x = root.scale('x').apply;
  bars.forEach(({spec, total}, i) => {
    const y = margin.top + row * i;
    const text = (at, anchor, value, name) => svgElement('text', {class: name, x: at, y: y + 20, 'text-anchor': anchor, 'aria-hidden': 'true'}, value);
    root.append(
      svgElement('line', {class: 'total-tick', x1: x(total), x2: x(total), y1: y + 2, y2: y + row - 3}),
      svgElement('rect', {x: 4, y: y + 11, width: 10, height: 10, rx: 3, fill: colorOf(spec)}),
      text(20, 'start', shortened(spec, margin.left - 24), 'bar-name'), text(width - 2, 'end', percent(Math.sqrt(rigs[i].parts.total)), 'bar-figure'));
  });
  return {root, boxes: bars.map((bar, i) => ({y: margin.top + row * i, height: row}))};
}

function partsTable(rigs) {
  const names = Object.keys(causes);
  const share = (rig, value) => (rig.parts.total > 0 ? sharePercent(value / rig.parts.total) : '–');
  return [['Rig', 'Total RMS', ...names.map((name) => causes[name].label), 'Interaction', ...names.slice(0, 2).map((name) => `RMS without ${name}`), 'RMS without clamp'],
    ...rigs.map((rig) => [rig.spec, percent(Math.sqrt(rig.parts.total)), ...names.map((name) => share(rig, partOf(rig, name)?.square ?? 0)), share(rig, rig.parts.interaction),
      ...names.slice(0, 2).map((name) => percent(Math.sqrt(partOf(rig, name)?.without ?? rig.parts.total))), percent(Math.sqrt(rig.parts.unclamped))])];
}
