// Error over time, one line a rig, and under it on the same time axis what rigs choose and what the truth itself does. The
// legend says the figures of the moment pointed at.

const kTimeMargin = {left: 46, right: 10};

const errorOfFrame = (frame, kind) => frame[`${kind}_rms`];
const estimateOfFrame = (frame, kind) => (kind === 'spatial' ? frame.estimate : frame.total_estimate) ?? null;
/** Does the rig take other numbers of SH vectors or near lights in other frames? */
const choosesOverTime = (rig) => rig.frames.some((frame) => frame.near.length > 0 || frame.sh_vectors !== rig.frames[0].sh_vectors);

/** `frames`: pictured frames, marked on the time axis; a click goes to the nearest. */
function timeChart(object, frames, store) {
  const hidden = new Set();
  const place = element('div', {class: 'plot time', tabindex: '0', role: 'group',
    'aria-label': `Error over time of ${object.name}. Left and right arrow keys move through the frames.`});
  const line = element('div', {class: 'moment', hidden: true});
  const flag = element('span', {class: 'flag'});
  line.append(flag);
  const spoken = element('p', {class: 'unseen', 'aria-live': 'polite'});
  const kind = choice('Error', errorKinds, (error) => settings.set({error}));
  const scaleChoice = choice('Scale', [{value: 'log', label: 'Log'}, {value: 'linear', label: 'Linear'}], (scale) => settings.set({scale}));
  const legend = timeLegend(object, hidden, () => drawing.again());
  const behind = tableBehind(`Error over time of ${object.name}`, () => timeRows(object, settings.get().error));
  let panels = [];
  const drawing = drawToWidth(place, (width) => {
    panels = timePanels(object, width, settings.get(), object.rigs.filter((rig) => !hidden.has(rig.spec)), store.get().rig, frames);
    place.replaceChildren(...panels.map(({node}) => node), line);
    point(store.get());
  });

  /** The line at the moment, and the figures of it. */
  function point({cursor, rig}) {
    line.hidden = cursor === null || !panels.length;
    legend.say(cursor, rig, settings.get().error);
    for (const panel of panels) panel.say(cursor);
    if (line.hidden) return;
    const {time} = object.truth[cursor];
    const x = panels[0].x(time);
    line.style.left = `${x}px`;
    flag.textContent = seconds(time);
    flag.classList.toggle('flip', x > place.clientWidth - 60);
  }

  pointInTime(place, object, store, (event) => panels[0]?.timeAt(event.clientX - place.getBoundingClientRect().left), spoken);
  place.addEventListener('click', () => {
    const {cursor} = store.get();
    if (cursor !== null && frames.length) store.set({frame: nearestIndex(frames, object.truth[cursor].time)});
  });
  settings.watch(({error, scale}) => {
    kind.show(error);
    scaleChoice.show(scale);
    drawing.again();
    legend.say(store.get().cursor, store.get().rig, error);
    behind.again();
  }, 'error', 'scale');
  store.watch(() => drawing.again(), 'rig');
  store.watch(point, 'cursor', 'rig');
  return element('div', {class: 'card over-time'}, element('div', {class: 'bar'}, element('h3', {}, 'Error over time'), kind.node, scaleChoice.node),
    legend.node, place, spoken,
    element('p', {class: 'hint'}, 'Where an error moves while the truth stands still, light pops. Dashed: what the chosen rig takes its own error for.', frames.length ? ' Triangles mark the frames that have pictures; click to see the nearest.' : null),
    behind.node);
}

/** The pointer and the arrow keys move the moment that an object's store holds. `timeOf(event)` is the time under the pointer. */
function pointInTime(place, object, store, timeOf, spoken) {
  const move = (cursor) => {
    if (store.get().cursor !== cursor) store.set({cursor});
  };
  const under = (event) => {
    const time = timeOf(event);
    if (time !== undefined) move(nearestIndex(object.truth, time));
  };
  place.addEventListener('pointermove', under);
  place.addEventListener('pointerdown', under);
  // A finger that is lifted leaves the moment where it was.
  place.addEventListener('pointerleave', (event) => {
    if (event.pointerType !== 'touch') move(null);
  });
  place.addEventListener('blur', () => move(null));
  place.addEventListener('keydown', (event) => {
    const last = object.truth.length - 1;
    const {cursor, rig} = store.get();
    const next = {ArrowLeft: (cursor ?? 1) - 1, ArrowRight: (cursor ?? -1) + 1, PageDown: (cursor ?? 0) + 10, PageUp: (cursor ?? 0) - 10, Home: 0, End: last}[event.key];
    if (event.key === 'Escape') move(null);
    if (next === undefined) return;
    event.preventDefault();
    const at = Math.min(last, Math.max(0, next));
    move(at);
    const shown = object.rigs.find(({spec}) => spec === rig);
    if (spoken && shown) spoken.textContent = `${seconds(object.truth[at].time)}: ${shown.spec} ${percent(errorOfFrame(frameAt(shown, object, at), settings.get().error))}`;
  });
}

const frameAt = (rig, object, index) => rig.frames[nearestIndex(rig.frames, object.truth[index].time)];

/** Buttons that show and hide rigs, each with its error: of the whole run, or at the moment. */
function timeLegend(object, hidden, onToggle) {
  const entries = object.rigs.map((rig) => {
    const value = element('span', {class: 'value'});
    const button = element('button', {type: 'button', 'aria-pressed': 'true', on: {click: () => {
      if (!hidden.delete(rig.spec)) hidden.add(rig.spec);
      button.setAttribute('aria-pressed', String(!hidden.has(rig.spec)));
      onToggle();
    }}}, swatch(colorOf(rig.spec)), rig.spec, value);
    return {rig, button, value};
  });
  return {
    node: element('div', {class: 'legend', role: 'group', 'aria-label': 'Rigs shown'}, ...entries.map(({button}) => button)),
    say(cursor, chosen, kind) {
      for (const {rig, button, value} of entries) {
        value.textContent = percent(cursor === null || !rig.frames.length ? rig[kind].rms : errorOfFrame(frameAt(rig, object, cursor), kind));
        button.classList.toggle('chosen', rig.spec === chosen);
      }
    },
  };
}

/** One chart under another: [{node, x(time), timeAt(pixel), say(cursor)}]. */
function timePanels(object, width, {error, scale}, rigs, chosen, frames) {
  const {truth} = object;
  const ordered = [...rigs].sort((a, b) => (a.spec === chosen) - (b.spec === chosen));  // the chosen one is drawn last
  const rows = (of, get) => of.flatMap((rig) => rig.frames.map((frame) => ({spec: rig.spec, time: frame.time, value: get(frame)})));
  const errors = rows(ordered, (frame) => errorOfFrame(frame, error));
  const estimating = ordered.find((rig) => rig.spec === chosen && rig.frames.every((frame) => estimateOfFrame(frame, error) !== null));
  const estimates = estimating ? rows([estimating], (frame) => estimateOfFrame(frame, error)) : [];
  const jumps = rows(ordered, (frame) => frame.jump ?? null);
  const choosing = ordered.filter(choosesOverTime);
  const moves = truth.map(({time, movement}) => ({time, value: movement}));
  const lines = (data, className, options = {}) => Plot.line(data, {x: 'time', y: 'value', z: 'spec', stroke: ({spec}) => colorOf(spec), className,
    strokeWidth: ({spec}) => (spec === chosen ? 2.8 : 1.4), strokeDasharray: ({spec}) => dashOf(spec), strokeLinejoin: 'round', ...options});
  const ofChosen = (index, get) => {
    const rig = rigs.find(({spec}) => spec === chosen);
    return rig && index !== null ? `${chosen}: ${get(frameAt(rig, object, index))}` : '';
  };
  const panel = timePanel(width, [truth[0].time, truth[truth.length - 1].time]);
  const errorScale = scale === 'log' ? logScale([...errors, ...estimates]) : linearScale([...errors, ...estimates]);
  const low = errorScale.domain[0];
  const list = [
    {title: `${error} RMS, %`, height: 250, y: errorScale, className: 'errors', marks: [
      lines(errors.map(above(low)), 'error-lines'),
      estimates.length ? lines(estimates.map(above(low)), 'estimate-line', {strokeWidth: 2, strokeDasharray: '5 4'}) : null,
      Plot.dot(frames, {x: 'time', y: () => low, symbol: 'triangle', fill: ({exact}) => (exact === false ? 'var(--muted)' : 'var(--accent)'), r: ({exact}) => (exact === false ? 2.5 : 4), dy: 4, className: 'pictured', clip: false}),
    ]},
  ];
  if (jumps.some(({value}) => value > 0)) {
    list.push({title: 'largest jump of the error from frame to frame, %', height: 96, y: logScale(jumps), className: 'jumps',
      say: (index) => ofChosen(index, ({jump}) => (jump === null ? '–' : percent(jump))), marks: (y) => [lines(jumps.map(above(y.domain[0])), 'jump-lines')]});
  }
  if (choosing.length) {
    const vectors = rows(choosing, (frame) => frame.sh_vectors);
    const near = rows(choosing, (frame) => frame.near.length);
    const step = {curve: 'step-after'};
    list.push({title: 'SH vectors (solid) and near lights (dotted)', height: 84, y: {...linearScale([...vectors, ...near]), tickFormat: tickLabel}, className: 'choices',
      say: (index) => ofChosen(index, (frame) => `${frame.sh_vectors} SH vectors; near: ${frame.near.join(', ') || 'none'}`),
      marks: [lines(vectors, 'vectors-line', step), lines(near, 'near-line', {...step, strokeDasharray: '1.5 3'})]});
  }
  const moving = moves.some(({value}) => value !== null);
  list.push({title: moving ? 'movement of the truth: RMS change from frame to frame, %' : 'movement of the truth: no two frames follow on each other', height: moving ? 70 : 0, y: linearScale(moves), className: 'movement',
    say: (index) => (index === null || truth[index].movement === null ? '' : percent(truth[index].movement)),
    marks: [Plot.areaY(moves, {x: 'time', y: 'value', fill: 'var(--muted)', fillOpacity: 0.22}), Plot.line(moves, {x: 'time', y: 'value', stroke: 'var(--text)', strokeWidth: 1.4, className: 'truth-line'})]});
  list.push({title: 'mean irradiance of the truth, W/m²', height: 70, y: {...linearScale(truth.map(({mean_irradiance: value}) => ({value}))), tickFormat: tickLabel}, className: 'irradiance',
    say: (index) => (index === null ? '' : `${figure(truth[index].mean_irradiance)} W/m²`),
    marks: [Plot.line(truth, {x: 'time', y: 'mean_irradiance', stroke: 'var(--text)', strokeWidth: 1.4})]});
  return list.map((entry, i) => panel(entry, i === list.length - 1));
}

/** A logarithmic axis has no room for 0: what is 0 runs along its end. */
const above = (low) => (row) => ({...row, value: row.value === null ? null : Math.max(row.value, low)});

function logScale(rows) {
  const domain = logDomain(rows.map(({value}) => value));
  return {type: 'log', domain, ticks: logTicks(domain), tickFormat: percentTick};
}

function linearScale(rows) {
  return {type: 'linear', domain: linearDomain(rows.map(({value}) => value ?? 0)), ticks: 3, tickFormat: percentTick};
}

/** Makes panels of one width and time axis. The last one has the axis's labels. */
function timePanel(width, times) {
  return ({title, height, y, marks, className, say}, isLast) => {
    const value = element('span', {class: 'value'});
    const caption = element('figcaption', {class: 'panel-title'}, title, value);
    const root = height === 0 ? null : Plot.plot({
      width, height: height + (isLast ? 34 : 4), marginLeft: kTimeMargin.left, marginRight: kTimeMargin.right, marginTop: 8, marginBottom: isLast ? 38 : 8, style: chartStyle,
      x: {domain: times, label: isLast ? 'time, s' : null, labelArrow: 'none', labelAnchor: 'right', ticks: Math.max(3, Math.round(width / 90)), axis: isLast ? 'bottom' : null, tickFormat: tickLabel},
      y: {...y, label: null}, color: {type: 'identity'}, symbol: {type: 'identity'}, r: {type: 'identity'},
      marks: [Plot.gridY({ticks: y.ticks, ...gridStyle}), ...(typeof marks === 'function' ? marks(y) : marks)],
    });
    root?.setAttribute('aria-hidden', 'true');
    const span = [kTimeMargin.left, width - kTimeMargin.right];
    const share = (time) => (times[1] > times[0] ? (time - times[0]) / (times[1] - times[0]) : 0.5);
    return {
      node: element('figure', {class: `panel ${className}`}, caption, root),
      x: (time) => span[0] + share(time) * (span[1] - span[0]),
      timeAt: (pixel) => times[0] + (times[1] - times[0]) * (pixel - span[0]) / (span[1] - span[0]),
      say: (index) => {
        value.textContent = say?.(index) ?? '';
      },
    };
  };
}

function timeRows(object, kind) {
  const {truth, rigs} = object;
  return [['Time, s', ...rigs.map((rig) => `${rig.spec}, ${kind} RMS, %`), 'Truth moves, %', 'Mean irradiance, W/m²'],
    ...truth.map((frame, i) => [frame.time.toFixed(2), ...rigs.map((rig) => (rig.frames.length ? figure(100 * errorOfFrame(frameAt(rig, object, i), kind)) : '–')),
      frame.movement === null ? '–' : figure(100 * frame.movement), figure(frame.mean_irradiance)])];
}
