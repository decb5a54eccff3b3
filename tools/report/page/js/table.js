// All rigs of an object with all their figures, sortable by any column.

const columns = [
  {key: 'spec', title: 'Rig', get: (rig) => rig.spec},
  {key: 'total', title: 'Total RMS', unit: '%', get: (rig) => rig.total.rms, format: (value) => figure(100 * value), bar: true, hint: 'Error against exact irradiance'},
  {key: 'totalMax', title: 'max', unit: '%', get: (rig) => rig.total.max, format: (value) => figure(100 * value)},
  {key: 'spatial', title: 'Spatial RMS', unit: '%', get: (rig) => rig.spatial.rms, format: (value) => figure(100 * value), bar: true, hint: 'Error the rig adds to SH projected at every point'},
  {key: 'spatialMax', title: 'max', unit: '%', get: (rig) => rig.spatial.max, format: (value) => figure(100 * value)},
  {key: 'estimate', title: 'Estimate', unit: '%', get: (rig) => rig.estimate, format: (value) => value === null ? '–' : figure(100 * value), hint: 'What the rig itself, which does not know the truth, takes its spatial RMS for'},
  {key: 'jump', title: 'Max jump', unit: '%', get: (rig) => rig.max_jump, format: (value) => value === null ? '–' : figure(100 * value), motion: true, hint: 'Largest change of the error from one frame to the next'},
  {key: 'fit', title: 'Fit', unit: 'µs', get: (rig) => rig.fit_us, format: figure, explain: stageTimes, hint: 'Median over frames of all that has to be computed once a frame'},
  {key: 'shade', title: 'Shade', unit: 'ns/point', get: (rig) => rig.shade_ns_per_point, format: figure},
  {key: 'modelled', title: 'Modelled', unit: 'ns/point', get: (rig) => rig.modelled_ns_per_point, format: figure, hint: 'Shading a point by the cost model, which depends on no clock'},
  {key: 'bytes', title: 'Size', unit: 'bytes', get: (rig) => rig.bytes, format: count, hint: 'The float32 coefficients'},
  {key: 'half', title: 'Half floats add', unit: '%', get: (rig) => rig.half_float ? rig.half_float.rms : null, format: (value) => value === null ? '–' : figure(100 * value), device: true, hint: 'RMS of what coefficients in half floats would change, at half the size'},
  {key: 'k', title: 'SH vectors', unit: 'K', get: (rig) => rig.sh_vectors, format: meanCount, hint: 'SH vectors evaluated at a point; a rig that chooses their number: mean over the frames'},
  {key: 'near', title: 'Near lights', unit: 'a frame', get: (rig) => rig.near_lights, format: meanCount, hint: 'Lights evaluated exactly at every point, in part or in full: mean over the frames'},
  {key: 's', title: 'Projections', unit: 'per light', get: (rig) => rig.projections, format: count, hint: 'SH projections of every light, each frame; a value with its gradient counts 4'},
  {key: 'condition', title: 'Condition', get: (rig) => rig.condition, format: figure, hint: 'Worst condition number of the fit; 1 where nothing is solved'},
];

/** "project 7.8 µs, fit 2.0 µs" */
function stageTimes(rig) {
  return Object.entries(rig.stages).map(([name, time]) => `${name} ${figure(time)} µs`).join(', ');
}

function rigTable(object, store) {
  const shown = columns.filter((column) => (!column.motion || object.truth.length > 1) && (!column.device || report.device));
  const body = element('tbody');
  const picks = new Map();
  const {heads, sorted} = sortableHeads(shown, () => draw());
  const hint = element('p', {class: 'hint'});

  function draw() {
    const pareto = new Set(currentPareto(object.rigs, settings.get()));
    picks.clear();
    body.replaceChildren(...sorted(object.rigs).map((rig) => {
      const pick = element('button', {type: 'button', class: 'pick', on: {click: () => store.set({rig: rig.spec})}}, swatch(colorOf(rig.spec)), rig.spec);
      picks.set(rig.spec, pick);
      return rigRow(rig, object, shown, pareto.has(rig), pick);
    }));
    mark(store.get());
    const {cost, error} = settings.get();
    hint.replaceChildren(element('span', {class: 'mark', 'aria-hidden': 'true'}, '◆'),
      ` no other rig has both less ${error} RMS and less cost (${costNamed(cost).axis}). Click a header to sort.`);
  }

  /** Rows stay in place, so that the button just pressed keeps the focus. */
  function mark({rig}) {
    for (const [spec, pick] of picks) {
      pick.setAttribute('aria-pressed', String(spec === rig));
      pick.closest('tr').classList.toggle('chosen', spec === rig);
    }
  }

  settings.watch(draw, 'cost', 'error');
  store.watch(mark, 'rig');
  return element('div', {class: 'card all-rigs'}, element('h3', {}, 'All rigs'),
    element('div', {class: 'scroller', tabindex: '0', role: 'region', 'aria-label': `Figures of all rigs of ${object.name}`},
      element('table', {class: 'rigs'}, element('thead', {}, element('tr', {}, ...heads)), body)), hint);
}

function rigRow(rig, object, shown, isPareto, pick) {
  const cells = shown.map((column) => {
    if (column.key === 'spec') {
      return element('th', {scope: 'row', class: 'name'}, pick,
        isPareto ? element('span', {class: 'mark', title: 'Pareto-optimal'}, '◆', element('span', {class: 'unseen'}, ' Pareto-optimal')) : null,
        object.rigs.length > 1 && object.verdict?.advised && object.verdict.spec === rig.spec ? element('span', {class: 'badge'}, 'advised') : null);
    }
    const cell = element('td', {class: column.bar ? 'barred' : null, title: column.explain?.(rig)}, column.format(column.get(rig)));
    if (column.bar) {
      const largest = Math.max(...object.rigs.map(column.get));
      cell.style.setProperty('--share', largest > 0 ? `${100 * column.get(rig) / largest}%` : '0%');
    }
    return cell;
  });
  return element('tr', {class: isPareto ? 'pareto' : null}, ...cells);
}
