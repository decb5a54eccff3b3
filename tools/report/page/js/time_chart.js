// Error over time, one line a rig, and under it on the same time axis what rigs choose and what the truth itself does.

const kErrorHeight = 280;
const kTruthHeight = 74;
const kChoiceHeight = 84;
const kChartLeft = 58;
const kChartRight = 14;

/** `frames`: pictured frames, marked on the time axis; a click goes to the nearest. */
function timeChart(object, frames, store) {
  const hidden = new Set();
  const place = element('div', {class: 'plot', tabindex: '0', role: 'group',
    'aria-label': `Error over time of ${object.name}. Left and right arrow keys move through the frames.`});
  const readout = element('div', {class: 'readout', 'aria-live': 'polite', hidden: true});
  const kind = choice('Error', errorKinds, (error) => settings.set({error}));
  const scaleChoice = choice('Scale', [{value: 'log', label: 'Log'}, {value: 'linear', label: 'Linear'}], (scale) => settings.set({scale}));
  const legend = element('div', {class: 'legend', role: 'group', 'aria-label': 'Rigs shown'}, ...object.rigs.map((rig) => {
    const button = element('button', {type: 'button', 'aria-pressed': 'true', on: {click: () => {
      if (!hidden.delete(rig.spec)) hidden.add(rig.spec);
      button.setAttribute('aria-pressed', String(!hidden.has(rig.spec)));
      drawing.again();
    }}}, swatch(colorOf(rig.spec)), rig.spec);
    return button;
  }));
  let cursor = null;  // index into object.truth
  let layout = null;
  const drawing = drawToWidth(place, (width) => {
    layout = timeLayout(object, width, settings.get(), object.rigs.filter((rig) => !hidden.has(rig.spec)), store.get().rig);
    place.replaceChildren(drawTime(object, layout, frames), readout);
    moveCursor(cursor);
  });

  function moveCursor(index) {
    cursor = index;
    place.querySelector('.cursor')?.remove();
    readout.hidden = index === null || !layout;
    if (readout.hidden) return;
    const x = layout.x(object.truth[index].time);
    place.querySelector('svg').append(svgElement('line', {class: 'cursor', x1: x, x2: x, y1: layout.error.top, y2: layout.irradiance.bottom}));
    readout.replaceChildren(...readoutLines(object, index, layout));
    readout.classList.toggle('flip', x > layout.width / 2);
    readout.style.left = `${x}px`;
  }

  place.addEventListener('pointermove', (event) => {
    if (layout) moveCursor(nearestIndex(object.truth, layout.timeAt(event.clientX - place.getBoundingClientRect().left)));
  });
  place.addEventListener('pointerleave', () => moveCursor(null));
  place.addEventListener('blur', () => moveCursor(null));
  place.addEventListener('click', () => {
    if (cursor !== null && frames.length) store.set({frame: nearestIndex(frames, object.truth[cursor].time)});
  });
  place.addEventListener('keydown', (event) => {
    const last = object.truth.length - 1;
    const next = {ArrowLeft: (cursor ?? 1) - 1, ArrowRight: (cursor ?? -1) + 1, Home: 0, End: last}[event.key];
    if (event.key === 'Escape') moveCursor(null);
    if (next === undefined) return;
    event.preventDefault();
    moveCursor(Math.min(last, Math.max(0, next)));
  });
  settings.watch(({error, scale}) => {
    kind.show(error);
    scaleChoice.show(scale);
    drawing.again();
  });
  store.watch(() => drawing.again(), 'rig');
  return element('div', {class: 'card'}, element('div', {class: 'bar'}, element('h3', {}, 'Error over time'), kind.node, scaleChoice.node),
    legend, place,
    element('p', {class: 'hint'}, 'Where an error moves while the truth stands still, light pops. Dashed: what the chosen rig takes its own error for. ', frames.length ? 'Triangles mark the frames that have pictures; click to see the nearest.' : null));
}

const errorOfFrame = (frame, kind) => frame[`${kind}_rms`];
const estimateOfFrame = (frame, kind) => (kind === 'spatial' ? frame.estimate : frame.total_estimate) ?? null;
/** Does the rig take other numbers of SH vectors or near lights in other frames? */
const choosesOverTime = (rig) => rig.frames.some((frame) => frame.near.length > 0 || frame.sh_vectors !== rig.frames[0].sh_vectors);

function timeLayout(object, width, {error, scale}, rigs, chosen) {
  const times = object.truth.map((frame) => frame.time);
  const span = {left: kChartLeft, right: width - kChartRight};
  const panel = (top, height) => ({...span, top, bottom: top + height});
  const boxes = {error: panel(22, kErrorHeight)};
  const choosing = rigs.filter(choosesOverTime);
  if (choosing.length) boxes.choice = panel(boxes.error.bottom + 34, kChoiceHeight);
  boxes.movement = panel((boxes.choice ?? boxes.error).bottom + 34, kTruthHeight);
  boxes.irradiance = panel(boxes.movement.bottom + 34, kTruthHeight);
  const estimating = rigs.find((rig) => rig.spec === chosen && rig.frames.every((frame) => estimateOfFrame(frame, error) !== null));
  const values = rigs.flatMap((rig) => rig.frames.map((frame) => errorOfFrame(frame, error)))
    .concat(estimating ? estimating.frames.map((frame) => estimateOfFrame(frame, error)) : []);
  const counts = choosing.flatMap((rig) => rig.frames.flatMap((frame) => [frame.sh_vectors, frame.near.length]));
  const x = makeScale('linear', [times[0], times[times.length - 1]], [span.left, span.right]);
  const vertical = (kind, domain, box) => makeScale(kind, domain, [box.bottom, box.top]);
  return {
    ...boxes, width, rigs, choosing, estimating, chosen, kind: error, x,
    timeAt: (pixel) => x.low + (x.high - x.low) * (pixel - span.left) / (span.right - span.left),
    yError: vertical(scale, scale === 'log' ? logDomain(values) : linearDomain(values.concat(0)), boxes.error),
    yChoice: boxes.choice && vertical('linear', linearDomain(counts), boxes.choice),
    yMovement: vertical('linear', linearDomain(object.truth.map((frame) => frame.movement ?? 0)), boxes.movement),
    yIrradiance: vertical('linear', linearDomain(object.truth.map((frame) => frame.mean_irradiance)), boxes.irradiance),
    height: boxes.irradiance.bottom + 40,
  };
}

/** Frames in a row that have a movement: the first frame has none, nor has one that does not follow on the last. */
function movementRuns(truth) {
  const runs = [];
  truth.forEach((frame, i) => {
    if (frame.movement === null) return;
    if (!i || truth[i - 1].movement === null) runs.push([]);
    runs[runs.length - 1].push(frame);
  });
  return runs;
}

function drawTime(object, layout, frames) {
  const {x, yError, yMovement, yIrradiance, kind, chosen, estimating} = layout;
  const root = svgElement('svg', {width: layout.width, height: layout.height, 'aria-hidden': 'true'});
  const title = (text, box) => svgElement('text', {class: 'axis-title', x: 0, y: box.top - 9}, text);
  const plotted = (rows, y, get) => rows.map((row) => [x(row.time), y(get(row))]);
  const moves = object.truth.some((frame) => frame.movement !== null);
  root.append(
    title(`${kind} RMS, % of mean irradiance`, layout.error), ...leftAxis(yError, layout.error, (tick) => tickLabel(100 * tick), 6),
    title(moves ? 'movement of the truth, RMS change per frame, %' : 'movement of the truth: no two frames follow on each other', layout.movement),
    ...(moves ? leftAxis(yMovement, layout.movement, (tick) => tickLabel(100 * tick), 3) : []),
    title('mean irradiance of the truth, W/m²', layout.irradiance), ...leftAxis(yIrradiance, layout.irradiance, tickLabel, 3),
    ...bottomAxis(x, layout.irradiance, tickLabel, Math.max(3, layout.width / 90), false),
    svgElement('text', {class: 'tick', x: layout.error.right, y: layout.height - 4, 'text-anchor': 'end'}, 'time, s'));
  for (const frame of frames) {
    const at = x(frame.time);
    const y = layout.error.bottom;
    root.append(svgElement('path', {class: 'pictured', d: `M${at} ${y + 1}l5 8h-10z`}));
  }
  const base = layout.movement.bottom;
  for (const run of movementRuns(object.truth)) {
    const movement = plotted(run, yMovement, (frame) => frame.movement);
    root.append(
      svgElement('polygon', {class: 'truth-area', points: polyline([[movement[0][0], base], ...movement, [movement[movement.length - 1][0], base]])}),
      svgElement('polyline', {class: 'truth-line', points: polyline(movement)}));
  }
  root.append(
    svgElement('polyline', {class: 'truth-line', points: polyline(plotted(object.truth, yIrradiance, (frame) => frame.mean_irradiance))}));
  for (const rig of layout.rigs) {
    const line = svgElement('polyline', {class: rig.spec === chosen ? 'line chosen' : 'line', 'stroke-dasharray': dashOf(rig.spec),
      points: polyline(plotted(rig.frames, yError, (frame) => errorOfFrame(frame, kind)))});
    line.style.stroke = colorOf(rig.spec);
    root.append(line);
  }
  if (estimating) {
    const line = svgElement('polyline', {class: 'estimate', points: polyline(plotted(estimating.frames, yError, (frame) => estimateOfFrame(frame, kind)))});
    line.style.stroke = colorOf(estimating.spec);
    root.append(line);
  }
  if (layout.choice) root.append(title('SH vectors (solid) and near lights (dotted)', layout.choice), ...drawChoices(layout));
  return root;
}

/** The numbers of SH vectors and of near lights of the rigs that choose them, as steps from frame to frame. */
function drawChoices({x, choice: box, choosing, yChoice, chosen}) {
  const steps = (frames, get) => frames.flatMap((frame, i) => (i ? [[x(frame.time), yChoice(get(frames[i - 1]))]] : []).concat([[x(frame.time), yChoice(get(frame))]]));
  const line = (rig, kind, get) => {
    const node = svgElement('polyline', {class: `${kind}${rig.spec === chosen ? ' chosen' : ''}`, points: polyline(steps(rig.frames, get))});
    node.style.stroke = colorOf(rig.spec);
    return node;
  };
  return [...leftAxis(yChoice, box, tickLabel, 3),
    ...choosing.flatMap((rig) => [line(rig, 'vectors-line', (frame) => frame.sh_vectors), line(rig, 'near-line', (frame) => frame.near.length)])];
}

function readoutLines(object, index, layout) {
  const {time, movement, mean_irradiance: mean} = object.truth[index];
  const line = (name, value, color) => element('div', {class: 'entry'}, color ? swatch(color) : null, element('span', {}, name), element('b', {}, value));
  const rows = layout.rigs.filter((rig) => rig.frames.length).map((rig) => ({spec: rig.spec, value: errorOfFrame(rig.frames[nearestIndex(rig.frames, time)], layout.kind)}));
  rows.sort((a, b) => b.value - a.value);
  const {estimating} = layout;
  const own = estimating?.frames[nearestIndex(estimating.frames, time)];
  const near = layout.choosing.find((rig) => rig.spec === layout.chosen)?.frames[nearestIndex(object.truth, time)];
  return [element('div', {class: 'when'}, seconds(time)), ...rows.map((row) => line(row.spec, percent(row.value), colorOf(row.spec))),
    own ? line(`${estimating.spec} estimates`, percent(estimateOfFrame(own, layout.kind)), colorOf(estimating.spec)) : null,
    near ? line(`near: ${near.near.join(', ') || 'none'}`, `K ${near.sh_vectors}`, colorOf(layout.chosen)) : null,
    line('truth moves', movement === null ? '–' : percent(movement)), line('mean irradiance', `${figure(mean)} W/m²`)].filter(Boolean);
}
