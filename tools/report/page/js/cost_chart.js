// Error against cost, both logarithmic: one named point a rig, and the front of those that nothing beats in both.

const kCostMargin = {left: 46, right: 16, top: 14, bottom: 44};

function costChart(object, store) {
  const place = element('div', {class: 'plot'});
  const costChoice = choice('Cost', costs.map(({value, label, axis}) => ({value, label, title: axis})), (cost) => settings.set({cost}));
  const kind = choice('Error', errorKinds, (error) => settings.set({error}));
  const title = element('p', {class: 'panel-title'});
  const readout = element('p', {class: 'hint', 'aria-live': 'polite'});
  const kHint = 'Down and to the left is better; the line joins the rigs that no other beats in both. The table of all rigs has the figures.';
  let points = [];

  const say = (point) => readout.replaceChildren(...(point ? [swatch(colorOf(point.rig.spec)), ' ', element('b', {}, point.rig.spec), `: ${describe(point)}`] : [kHint]));
  const describe = ({x, y}) => `${percent(y)} ${settings.get().error} RMS, ${figure(x)} ${costNamed(settings.get().cost).axis}`;
  const mark = ({rig}) => {
    for (const point of points) point.node.setAttribute('aria-pressed', String(point.rig.spec === rig));
  };
  const drawing = drawToWidth(place, (width) => {
    const hadFocus = points.findIndex(({node}) => node === document.activeElement);
    const {root, drawn} = drawCost(object, width, settings.get());
    points = drawn;
    const chosen = Math.max(0, points.findIndex(({rig}) => rig.spec === store.get().rig));
    points.forEach((point, i) => {
      fillIn(point.node, {
        role: 'button', tabindex: i === chosen ? '0' : '-1', 'data-spec': point.rig.spec, 'aria-label': `${point.rig.spec}: ${describe(point)}`,
        on: {click: () => store.set({rig: point.rig.spec}), focus: () => say(point), blur: () => say(null), pointerenter: () => say(point), pointerleave: () => say(null)},
      }, []);
    });
    place.replaceChildren(root);
    mark(store.get());
    if (hadFocus >= 0) points[hadFocus].node.focus();
  });

  walkWithKeys(place, () => points.map(({node}) => node), (i) => store.set({rig: points[i].rig.spec}));
  settings.watch(({cost, error}) => {
    costChoice.show(cost);
    kind.show(error);
    title.textContent = `${error} RMS, %, against ${costNamed(cost).axis}`;
    drawing.again();
  }, 'cost', 'error');
  store.watch(mark, 'rig');
  say(null);
  return element('div', {class: 'card cost'}, element('div', {class: 'bar'}, element('h3', {}, 'Error against cost'), costChoice.node, kind.node), title, place, readout);
}

/** The picture, and its points in order of cost with the node of each. */
function drawCost(object, width, choices) {
  const cost = costNamed(choices.cost);
  const all = object.rigs.map((rig) => ({rig, x: cost.get(rig), y: rig[choices.error].rms}));
  const front = currentPareto(object.rigs, choices);
  const [x, y] = [logDomain(all.map((point) => point.x), 1.4), logDomain(all.map((point) => point.y), 1.4)];
  // A logarithmic axis has no room for 0: what is 0 stands at its end.
  const at = (point) => ({...point, x: Math.max(point.x, x[0]), y: Math.max(point.y, y[0])});
  const points = all.map(at).map((point) => ({...point, optimal: front.includes(point.rig)})).sort((a, b) => a.x - b.x || b.y - a.y);
  const margin = kCostMargin;
  const height = Math.round(Math.min(400, Math.max(280, 0.75 * width)));
  const stairs = stairsOf(points.filter(({optimal}) => optimal), y[1], x[1]);
  const root = Plot.plot({
    width, height, marginLeft: margin.left, marginRight: margin.right, marginTop: margin.top, marginBottom: margin.bottom, style: chartStyle,
    x: {type: 'log', domain: x, label: cost.axis, labelArrow: 'none', labelAnchor: 'right', ticks: logTicks(x), tickFormat: tickLabel},
    y: {type: 'log', domain: y, label: null, ticks: logTicks(y), tickFormat: percentTick},
    color: {type: 'identity'},
    marks: [
      Plot.gridX({ticks: logTicks(x), ...gridStyle}), Plot.gridY({ticks: logTicks(y), ...gridStyle}),
      Plot.line(stairs, {x: 'x', y: 'y', className: 'front', stroke: 'var(--accent)', strokeWidth: 1.5, strokeDasharray: '5 4'}),
      Plot.dot(points, {x: 'x', y: 'y', className: 'points', r: ({optimal}) => (optimal ? 6.5 : 5), fill: ({rig}) => colorOf(rig.spec), stroke: ({optimal, rig}) => (optimal ? 'var(--accent)' : colorOf(rig.spec)), strokeWidth: 1.5, sort: null}),
    ],
    r: {type: 'identity'},
  });
  root.setAttribute('role', 'group');
  root.setAttribute('aria-label', `${choices.error} RMS against ${cost.axis}; arrow keys go from rig to rig, Enter chooses one`);
  const nodes = [...root.querySelectorAll('.points > *')];
  const box = {left: margin.left, right: width, top: 4, bottom: height - margin.bottom};
  const drawn = points.map((point, i) => ({...point, node: nodes[i], px: root.scale('x').apply(point.x), py: root.scale('y').apply(point.y)}));
  const taken = drawn.map(({px, py}) => ({left: px - 7, right: px + 7, top: py - 7, bottom: py + 7}));
  for (const point of drawn) {
    const place = placeName(point.rig.spec, point, taken, box);
    root.append(svgElement('text', {class: point.optimal ? 'point-name optimal' : 'point-name', x: place.x, y: place.y, 'aria-hidden': 'true'}, point.rig.spec));
  }
  return {root, drawn: drawn.map((point) => ({...point, ...all.find(({rig}) => rig === point.rig)}))};
}
