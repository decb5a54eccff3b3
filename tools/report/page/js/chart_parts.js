// What the charts by Observable Plot have in common: the page's colours, ticks, domains, room for names, and drawing again
// when the width changes.

const chartStyle = {background: 'transparent', color: 'var(--muted)', fontFamily: 'inherit', fontSize: '12px', overflow: 'visible'};
const gridStyle = {stroke: 'var(--rule)', strokeOpacity: 1};

/** Short tick labels: 0.1, 5, 20, 12k, 3M. */
function tickLabel(value) {
  if (value >= 1e6) return `${Number((value / 1e6).toPrecision(3))}M`;
  if (value >= 1e4) return `${Number((value / 1e3).toPrecision(3))}k`;
  return String(Number(value.toPrecision(3)));
}
const percentTick = (value) => tickLabel(100 * value);

/** 1-2-5 steps, fewer where there are many decades; every second or third decade where there are very many. */
function logTicks([low, high]) {
  const decades = Math.log10(high / low);
  const factors = decades > 3.5 ? [1] : decades > 1.6 ? [1, 3] : [1, 2, 5];
  const step = Math.ceil(decades / 7);
  const ticks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high); ++e) if (e % step === 0) ticks.push(...factors.map((factor) => factor * 10 ** e));
  return ticks.filter((tick) => tick >= low && tick <= high);
}

/** From `margin` below the least of the positive values to as much above the largest; a decade where there is none. */
function logDomain(values, margin = 1.25) {
  const positive = values.filter((value) => value > 0);
  return positive.length ? [Math.min(...positive) / margin, Math.max(...positive) * margin] : [1, 10];
}

const linearDomain = (values) => [0, Math.max(0, ...values) * 1.06 || 1];

/** What a front of points {x, y} rules out lies above and to the right of this line. */
function stairsOf(front, top, right) {
  const path = [];
  front.forEach(({x, y}, i) => path.push({x, y: i ? front[i - 1].y : top}, {x, y}));
  if (front.length) path.push({x: right, y: front[front.length - 1].y});
  return path;
}

/** The side of a point at (px, py) where its name meets least of what is there; the room is then taken. */
function placeName(name, {px, py}, taken, box) {
  const width = 6.6 * name.length;
  const places = [[11, -6], [11, 14], [-11 - width, -6], [-11 - width, 14], [-width / 2, -13], [-width / 2, 22], [11, -20], [-11 - width, -20], [-11 - width, 28]].map(([dx, dy]) => {
    const area = {left: px + dx, right: px + dx + width, top: py + dy - 11, bottom: py + dy + 3};
    const outside = Math.max(0, box.left - area.left) + Math.max(0, area.right - box.right) + Math.max(0, box.top - area.top) + Math.max(0, area.bottom - box.bottom);
    return {x: px + dx, y: py + dy, area, cost: 1000 * outside + taken.reduce((sum, other) => sum + overlap(area, other), 0)};
  });
  const best = places.reduce((a, b) => (b.cost < a.cost ? b : a));
  taken.push(best.area);
  return best;
}

function overlap(a, b) {
  return Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left)) * Math.max(0, Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top));
}

/** Calls `draw(width)` now and whenever the width of `node` has changed. */
function drawToWidth(node, draw) {
  let width = 0;
  const update = () => {
    if (node.clientWidth === width || node.clientWidth === 0) return;
    width = node.clientWidth;
    draw(width);
  };
  new ResizeObserver(() => requestAnimationFrame(update)).observe(node);
  requestAnimationFrame(update);
  return {
    again() {
      if (width) draw(width);
    },
  };
}

/** The figures behind a chart, made when they are first looked at. */
function tableBehind(label, makeRows) {
  const place = element('div', {class: 'scroller tall', tabindex: '0', role: 'region', 'aria-label': label});
  const node = element('details', {class: 'behind'}, element('summary', {}, 'Figures as a table'), place);
  const fill = () => {
    const [head, ...rows] = makeRows();
    place.replaceChildren(element('table', {}, element('thead', {}, element('tr', {}, ...head.map((cell) => element('th', {scope: 'col'}, cell)))),
      element('tbody', {}, ...rows.map(([first, ...cells]) => element('tr', {}, element('th', {scope: 'row'}, first), ...cells.map((cell) => element('td', {}, cell)))))));
  };
  node.addEventListener('toggle', () => {
    if (node.open) fill();
  });
  return {
    node,
    again() {
      if (node.open) fill();
    },
  };
}
