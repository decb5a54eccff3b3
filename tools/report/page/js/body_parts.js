// Errors of the chosen rig by body part: glTF node, or the joint that moves the surface most, as they hang together.

const bodyMeasures = [
  {value: 'rms', label: 'RMS', title: 'RMS error of the part', axis: 'Total RMS, %; dashed: of the whole object'},
  {value: 'mean', label: 'Mean', title: 'Signed mean: too bright or too dark', axis: 'Mean signed error, %; above 0 too bright'},
  {value: 'max', label: 'Max', title: 'Largest error', axis: 'Largest error, %'},
  {value: 'share', label: 'Share', title: 'Share of the squared error, beside the share of the area', axis: 'Share of the squared error, %; tick: share of the area'},
];

function bodyPartErrors(object, store) {
  const {rigs, chosen} = brokenDown(object, 'body_parts');
  if (!rigs.some((rig) => rig.body_parts.length > 1)) return null;
  const view = makeStore({measure: 'rms'});
  const measure = choice('Error', bodyMeasures, (value) => view.set({measure: value}));
  const of = rigName();
  const title = element('p', {class: 'panel-title'});
  const place = element('div', {class: 'plot body-parts'});
  const readout = element('p', {class: 'hint', 'aria-live': 'polite'});
  let rows = [];

  const say = (part) => readout.replaceChildren(...(part ? [element('b', {}, part.name), `: ${describePart(part)}`] :
    ['Nodes and joints, each with what hangs from it below and to the right. Small ones are taken together with what they hang from.']));
  const drawing = drawToWidth(place, (width) => {
    const rig = chosen(store.get());
    const parts = rig.body_parts;
    const focused = rows.indexOf(document.activeElement);
    const {root, boxes} = drawBodyParts(rig, width, view.get().measure);
    rows = barRows(root, width, boxes.map((box, i) => ({...box, label: `${parts[i].name}: ${describePart(parts[i])}`})));
    rows.forEach((node, i) => {
      node.setAttribute('role', 'img');
      fillIn(node, {on: {focus: () => say(parts[i]), blur: () => say(null), pointerenter: () => say(parts[i]), pointerleave: () => say(null)}}, []);
    });
    place.replaceChildren(root);
    if (focused >= 0) rows[Math.min(focused, rows.length - 1)].focus();
  });
  walkWithKeys(place, () => rows);
  const behind = tableBehind(`Errors of ${object.name} by body part`, () => [['Part', 'Hangs from', 'Nodes', 'Samples', 'Area', 'RMS', 'Max', 'Mean', 'Share of squared error'],
    ...chosen(store.get()).body_parts.map((part, i, all) => [part.name, part.parent === null ? '–' : all[part.parent].name, count(part.nodes), count(part.samples),
      sharePercent(part.area), percent(part.rms), percent(part.max), signedPercent(part.mean), sharePercent(part.share)])]);

  view.watch(({measure: value}) => {
    measure.show(value);
    title.textContent = bodyMeasures.find((one) => one.value === value).axis;
    drawing.again();
  }, 'measure');
  store.watch((values) => {
    of.show(chosen(values));
    drawing.again();
    behind.again();
  }, 'rig');
  say(null);
  return element('div', {class: 'card by-part'}, element('div', {class: 'bar'}, element('h3', {}, 'Error by body part'), of.node, measure.node), title, place, readout, behind.node);
}

function describePart(part) {
  return `RMS ${percent(part.rms)}, max ${percent(part.max)}, on average ${(100 * Math.abs(part.mean)).toFixed(2)}\u00a0% too ${part.mean < 0 ? 'dark' : 'bright'}; ` +
    `${sharePercent(part.share)} of the squared error on ${sharePercent(part.area)} of the area (${plural(part.samples, 'sample')}${part.nodes > 1 ? `, ${plural(part.nodes, 'node')}` : ''})`;
}

function depthOf(parts, i) {
  return parts[i].parent === null ? 0 : 1 + depthOf(parts, parts[i].parent);
}

function drawBodyParts(rig, width, measure) {
  const parts = rig.body_parts;
  const all = parts.flatMap((part) => (measure === 'share' ? [part.share, part.area] : [part[measure]]));
  const narrow = width < 420;
  const margin = {left: narrow ? 138 : 172, right: measure === 'mean' ? 70 : 58, top: 4, bottom: 26};
  const row = 22;
  const height = margin.top + margin.bottom + row * parts.length;
  const bars = parts.map((part, i) => ({i, value: part[measure], color: measure === 'mean' && part.mean < 0 ? 'var(--dark-side)' : 'var(--error)'}));
  const root = Plot.plot({
    width, height, marginLeft: margin.left, marginRight: margin.right, marginTop: margin.top, marginBottom: margin.bottom, style: chartStyle,
    x: {domain: [Math.min(0, ...all) * 1.04, Math.max(1e-6, ...all) * 1.04], label: null, ticks: narrow ? 3 : 5, tickFormat: percentTick},
    y: {type: 'band', domain: parts.map((part, i) => i), padding: 0, axis: null},
    color: {type: 'identity'},
    marks: [
      Plot.gridX({ticks: narrow ? 3 : 5, ...gridStyle}),
      Plot.barX(bars, {x: 'value', y: 'i', fill: 'color', insetTop: 4, insetBottom: 4, className: 'pieces'}),
      Plot.ruleX([0], {stroke: 'var(--muted)'}),
      ...(measure === 'rms' ? [Plot.ruleX([rig.total.rms], {stroke: 'var(--text)', strokeDasharray: '3 3'})] : []),
    ],
  });
  root.setAttribute('role', 'group');
  root.setAttribute('aria-label', 'Error by body part; arrow keys go from part to part');
  const x = root.scale('x').apply;
  const boxes = parts.map((part, i) => {
    const y = margin.top + row * i;
    const indent = 4 + (narrow ? 5 : 9) * Math.min(6, depthOf(parts, i));
    root.append(svgElement('text', {class: 'bar-name', 'text-anchor': 'start', x: indent, y: y + 15, 'aria-hidden': 'true'}, shortened(part.name, margin.left - indent - 6)),
      svgElement('text', {class: 'bar-figure', x: width - 2, y: y + 15, 'text-anchor': 'end', 'aria-hidden': 'true'},
        measure === 'share' ? sharePercent(part.share) : measure === 'mean' ? signedPercent(part.mean) : percent(part[measure])));
    if (measure === 'share') root.append(svgElement('line', {class: 'total-tick', x1: x(part.area), x2: x(part.area), y1: y + 2, y2: y + row - 2}));
    return {y, height: row};
  });
  return {root, boxes};
}
