// Error against cost, both logarithmic: one labelled point a rig and the front of those that nothing beats.

const kCostHeight = 420;

function costChart(object, store) {
  const place = element('div', {class: 'plot'});
  const costChoice = choice('Cost', costs.map(({value, label, axis}) => ({value, label, title: axis})), (cost) => settings.set({cost}));
  const kind = choice('Error', errorKinds, (error) => settings.set({error}));
  const drawing = drawToWidth(place, (width) => place.replaceChildren(drawCost(object, width, settings.get(), store)));
  settings.watch(({cost, error}) => {
    costChoice.show(cost);
    kind.show(error);
    drawing.again();
  });
  store.watch(({rig}) => markPoint(place, rig), 'rig');
  return element('div', {class: 'card'}, element('div', {class: 'bar'}, element('h3', {}, 'Error against cost'), costChoice.node, kind.node), place,
    element('p', {class: 'hint'}, 'Down and to the left is better. The line joins the rigs that no other beats in both.'));
}

function markPoint(place, spec) {
  for (const point of place.querySelectorAll('.point')) point.setAttribute('aria-pressed', String(point.dataset.spec === spec));
}

function drawCost(object, width, choices, store) {
  const cost = costNamed(choices.cost);
  const errorOf = (rig) => rig[choices.error].rms;
  const box = {left: 52, right: width - 16, top: 22, bottom: kCostHeight - 42};
  const x = makeScale('log', logDomain(object.rigs.map(cost.get), 1.5), [box.left, box.right]);
  const y = makeScale('log', logDomain(object.rigs.map(errorOf), 1.4), [box.bottom, box.top]);
  const root = svgElement('svg', {width, height: kCostHeight, role: 'group', 'aria-label': `${choices.error} RMS against ${cost.axis}`});
  root.append(...leftAxis(y, box, (tick) => tickLabel(100 * tick), 5), ...bottomAxis(x, box, tickLabel, 5, true),
    svgElement('text', {class: 'axis-title', x: 0, y: 13}, `${choices.error} RMS, %`),
    svgElement('text', {class: 'axis-title', x: box.right, y: kCostHeight - 6, 'text-anchor': 'end'}, cost.axis));
  const front = paretoRigs(object.rigs, cost.get, errorOf);
  root.append(svgElement('polyline', {class: 'front', points: polyline(staircase(front.map((rig) => [x(cost.get(rig)), y(errorOf(rig))]), box))}));
  const points = object.rigs.map((rig) => ({rig, x: x(cost.get(rig)), y: y(errorOf(rig)), optimal: front.includes(rig)}));
  const taken = points.map((point) => ({left: point.x - 7, right: point.x + 7, top: point.y - 7, bottom: point.y + 7}));
  for (const point of points) root.append(drawPoint(point, placeLabel(point, taken, box), cost, errorOf(point.rig), store));
  markPoint(root, store.get().rig);
  return root;
}

/** What the front rules out lies above and to the right of this line, from the top edge to the right edge. */
function staircase(points, box) {
  const path = [];
  points.forEach(([x, y], i) => path.push([x, i ? points[i - 1][1] : box.top], [x, y]));
  if (points.length) path.push([box.right, points[points.length - 1][1]]);
  return path;
}

/** The side of the point where its label meets least of what is there; the room is then taken. */
function placeLabel({rig, x, y}, taken, box) {
  const width = 7 * rig.spec.length;
  const sides = [
    {x: x + 11, y: y - 6, anchor: 'start'}, {x: x + 11, y: y + 14, anchor: 'start'}, {x: x - 11, y: y - 6, anchor: 'end'},
    {x: x - 11, y: y + 14, anchor: 'end'}, {x, y: y - 13, anchor: 'middle'}, {x, y: y + 22, anchor: 'middle'},
    {x: x + 11, y: y - 20, anchor: 'start'}, {x: x - 11, y: y - 20, anchor: 'end'}, {x: x - 11, y: y + 28, anchor: 'end'},
  ].map((side) => {
    const left = side.anchor === 'start' ? side.x : side.anchor === 'end' ? side.x - width : side.x - width / 2;
    const area = {left, right: left + width, top: side.y - 11, bottom: side.y + 3};
    const outside = Math.max(0, box.left - area.left) + Math.max(0, area.right - box.right) + Math.max(0, box.top - area.top) + Math.max(0, area.bottom - box.bottom);
    return {...side, area, cost: 1000 * outside + taken.reduce((sum, other) => sum + overlap(area, other), 0)};
  });
  const best = sides.reduce((a, b) => (b.cost < a.cost ? b : a));
  taken.push(best.area);
  return best;
}

function overlap(a, b) {
  return Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left)) * Math.max(0, Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top));
}

function drawPoint({rig, x, y, optimal}, label, cost, error, store) {
  const description = `${rig.spec}: ${percent(error)}, ${figure(cost.get(rig))} ${cost.axis}`;
  const choose = () => store.set({rig: rig.spec});
  const dot = svgElement('circle', {cx: x, cy: y, r: optimal ? 6.5 : 5});
  dot.style.fill = colorOf(rig.spec);
  return svgElement('g', {
    class: optimal ? 'point optimal' : 'point', tabindex: '0', role: 'button', 'aria-label': description, 'data-spec': rig.spec,
    on: {click: choose, keydown: (event) => {
      if (event.key !== 'Enter' && event.key !== ' ') return;
      event.preventDefault();
      choose();
    }},
  }, svgElement('title', {}, description), svgElement('circle', {class: 'target', cx: x, cy: y, r: 14}), dot,
  svgElement('text', {x: label.x, y: label.y, 'text-anchor': label.anchor}, rig.spec));
}
