// How large errors are and how often: the chosen rig in full, the others as lines.

const histogramKinds = [
  {value: 'absolute', label: 'Size', title: 'Absolute errors on a logarithmic axis'},
  {value: 'signed', label: 'Signed', title: 'Too dark to the left, too bright to the right'},
];

function errorHistogram(object, store) {
  const {rigs, chosen} = brokenDown(object, 'histogram');
  if (!rigs.length) return null;
  const view = makeStore({kind: 'absolute', bin: null});
  const kind = choice('Errors', histogramKinds, (value) => view.set({kind: value, bin: null}));
  const of = rigName();
  const title = element('p', {class: 'panel-title'});
  const place = element('div', {class: 'plot histogram', tabindex: '0', role: 'group', 'aria-label': 'Histogram of errors; arrow keys go from bin to bin'});
  const readout = element('p', {class: 'hint', 'aria-live': 'polite'});
  let drawn = null;

  const say = () => {
    const bin = drawn?.bins[view.get().bin];
    drawn?.mark(bin);
    readout.replaceChildren(...(bin ? [element('b', {}, bin.name), `: ${sharePercent(bin.share)} of all samples, channels and frames; ${sharePercent(bin.below)} lie below`] : [drawn?.summary ?? '']));
  };
  const drawing = drawToWidth(place, (width) => {
    drawn = drawHistogram(rigs, chosen(store.get()), width, view.get().kind);
    place.replaceChildren(drawn.root);
    say();
  });
  const reach = (event) => {
    const x = event.clientX - place.getBoundingClientRect().left;
    const at = drawn.bins.findIndex((bin) => x >= bin.left && x < bin.right);
    view.set({bin: at < 0 ? null : at});
  };
  place.addEventListener('pointermove', reach);
  place.addEventListener('pointerdown', reach);
  place.addEventListener('pointerleave', (event) => {
    if (event.pointerType !== 'touch') view.set({bin: null});
  });
  place.addEventListener('blur', () => view.set({bin: null}));
  place.addEventListener('keydown', (event) => {
    const last = drawn.bins.length - 1;
    const at = view.get().bin;
    const next = {ArrowRight: at === null ? 0 : at + 1, ArrowLeft: at === null ? last : at - 1, Home: 0, End: last, Escape: null}[event.key];
    if (next === undefined) return;
    event.preventDefault();
    view.set({bin: next === null ? null : Math.min(last, Math.max(0, next))});
  });
  const behind = tableBehind(`Errors of ${object.name} by size`, () => [['Rig', 'p50', 'p90', 'p99', 'Max'],
    ...rigs.map((rig) => [rig.spec, percent(rig.histogram.p50), percent(rig.histogram.p90), percent(rig.histogram.p99), percent(rig.total.max)])]);

  view.watch(({kind: value}) => {
    kind.show(value);
    title.textContent = value === 'absolute' ? 'Share of all errors in bins of equal ratio, %, against their size, %' : 'Share of all errors in equal bins, %, against the error, %';
    drawing.again();
  }, 'kind');
  view.watch(say, 'bin');
  store.watch((values) => {
    of.show(chosen(values));
    drawing.again();
  }, 'rig');
  return element('div', {class: 'card by-size'}, element('div', {class: 'bar'}, element('h3', {}, 'How errors are distributed'), of.node, kind.node), title, place, readout, behind.node);
}

const sumOf = (values) => values.reduce((sum, value) => sum + value, 0);

/** Bins [{from, to, share, below}] of one rig. What is smaller than the first bin of absolute errors is `beneath`. */
function absoluteBins({histogram: {absolute}}) {
  const all = sumOf(absolute.counts) || 1;
  let below = 0;
  return absolute.counts.map((n, i) => {
    const edge = (k) => absolute.least * 10 ** (k / absolute.per_decade);
    const bin = {from: edge(i), to: edge(i + 1), share: n / all, below: below / all};
    below += n;
    return bin;
  });
}

function signedBins({histogram}) {
  const {counts, limit, below: under, above} = histogram.signed;
  const all = (sumOf(counts) + under + above) || 1;
  const edge = (k) => limit * (2 * k / counts.length - 1);
  let below = under;
  return counts.map((n, i) => {
    const bin = {from: edge(i), to: edge(i + 1), share: n / all, below: below / all};
    below += n;
    return bin;
  });
}

/** What the axis shows: bins that hold a thousandth of some rig’s errors, four decades of them at most. */
function shownRange(rigs, bins) {
  const enough = (bin) => bin.share > 0.001;
  const every = rigs.map((rig) => bins(rig).slice(1).filter(enough)).filter((some) => some.length);
  if (!every.length) return [1e-4, 1];
  const low = Math.min(...every.map((some) => some[0].from)), high = Math.max(...every.map((some) => some[some.length - 1].to));
  return [Math.max(low, high / 1e4), high];
}

function drawHistogram(rigs, rig, width, kind) {
  const {p50, p90, p99} = rig.histogram;
  const absolute = kind === 'absolute';
  const binsOf = absolute ? absoluteBins : signedBins;
  const limit = rig.histogram.signed.limit;
  const range = absolute ? shownRange(rigs, binsOf) : [-limit, limit];
  const inside = (bin) => bin.from >= range[0] * (1 - 1e-9 * Math.sign(range[0])) && bin.to <= range[1] * (1 + 1e-9);
  const bins = binsOf(rig).filter(inside);
  // Bins of signed errors are as wide as each rig needs: only those of equal ratio compare.
  const others = absolute ? rigs.filter((other) => other !== rig).map((other) => ({spec: other.spec, bins: binsOf(other).filter(inside)})) : [];
  const top = 1.12 * Math.max(1e-6, ...bins.map(({share}) => share), ...others.flatMap((other) => other.bins.map(({share}) => share)));
  const margin = {left: 40, right: 12, top: 18, bottom: 28};
  const narrow = width < 420;
  const height = Math.round(Math.min(320, Math.max(240, 0.5 * width)));
  const ticks = absolute ? logTicks(range) : narrow ? 4 : 7;
  const middle = absolute ? (bin) => Math.sqrt(bin.from * bin.to) : (bin) => (bin.from + bin.to) / 2;
  const levels = absolute ? [['p50', p50], ['p90', p90], ['p99', p99]].filter(([, value]) => value > range[0] && value < range[1]) : [];
  const root = Plot.plot({
    width, height, marginLeft: margin.left, marginRight: margin.right, marginTop: margin.top, marginBottom: margin.bottom, style: chartStyle,
    x: {type: absolute ? 'log' : 'linear', domain: range, label: null, ticks, tickFormat: percentTick},
    y: {domain: [0, top], label: null, ticks: 4, tickFormat: percentTick},
    color: {type: 'identity'},
    marks: [
      Plot.gridY({ticks: 4, ...gridStyle}),
      Plot.rect(bins, {x1: 'from', x2: 'to', y1: 0, y2: 'share', fill: absolute ? colorOf(rig.spec) : (bin) => (bin.to <= 0 ? 'var(--dark-side)' : bin.from >= 0 ? 'var(--error)' : 'var(--muted)'), fillOpacity: 0.75, insetLeft: 0.5, insetRight: 0.5, className: 'pieces'}),
      ...others.map((other) => Plot.line(other.bins, {x: middle, y: 'share', stroke: colorOf(other.spec), strokeWidth: 1.2, strokeOpacity: 0.55, curve: 'monotone-x'})),
      Plot.ruleY([0], {stroke: 'var(--muted)'}),
      ...(absolute ? [] : [Plot.ruleX([0], {stroke: 'var(--muted)', strokeDasharray: '3 3'})]),
      Plot.ruleX(levels, {x: ([, value]) => value, stroke: 'var(--text)', strokeDasharray: '3 3'}),
    ],
  });
  root.setAttribute('aria-hidden', 'true');
  const x = root.scale('x').apply;
  levels.forEach(([name, value]) => root.append(svgElement('text', {class: 'bar-figure', x: x(value), y: 11, 'text-anchor': {p50: 'end', p90: 'middle', p99: 'start'}[name]}, name)));
  const shade = svgElement('rect', {class: 'bin-mark', y: margin.top, height: height - margin.top - margin.bottom, width: 0});
  root.append(shade);
  const named = bins.map((bin) => ({...bin, left: x(bin.from), right: x(bin.to), name: absolute ? `${percent(bin.from)} to ${percent(bin.to)}` : `${signedPercent(bin.from)} to ${signedPercent(bin.to)}`}));
  return {root, bins: named, summary: summaryOf(rig, bins, absolute), mark: (bin) => {
    shade.setAttribute('x', bin ? bin.left : 0);
    shade.setAttribute('width', bin ? bin.right - bin.left : 0);
  }};
}

function summaryOf(rig, bins, absolute) {
  const {p50, p90, p99, signed} = rig.histogram;
  if (absolute) {
    const smaller = bins.length ? bins[0].below : 0;
    return `Half of all errors are below ${percent(p50)}, 90 % below ${percent(p90)}, 99 % below ${percent(p99)}; the largest is ${percent(rig.total.max)}.` +
      `${smaller > 0.002 ? ` ${sharePercent(smaller)} are smaller than the axis shows.` : ''} Lines: the other rigs.`;
  }
  const all = (sumOf(signed.counts) + signed.below + signed.above) || 1;
  return `The axis ends at the 99th percentile of the size: ${sharePercent(signed.below / all)} of all errors are darker and ${sharePercent(signed.above / all)} brighter.`;
}
