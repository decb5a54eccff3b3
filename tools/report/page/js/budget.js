// A frame's time shared by the objects of a scene: what each got of it, and what it gave up for the others.

const budgetColumns = [
  {title: 'Time', unit: 'µs a frame', get: (rig) => rig.budget.us, alone: (alone) => alone.us, format: figure},
  {title: 'Allowed', unit: 'error, %', get: (rig) => rig.budget.granted, alone: (alone) => alone.granted, format: (value) => figure(100 * value)},
  {title: 'Total RMS', unit: '%', get: (rig) => rig.total.rms, alone: (alone) => alone.total, format: (value) => figure(100 * value), bar: true},
  {title: 'SH vectors', unit: 'a frame', get: (rig) => rig.sh_vectors, alone: (alone) => alone.sh_vectors, format: meanCount},
  {title: 'Near lights', unit: 'a frame', get: (rig) => rig.near_lights, alone: (alone) => alone.near_lights, format: meanCount},
];

/** One card for each budget of a scene that objects share. */
function budgetCards(scene, sceneIndex) {
  const sharing = (spec) => report.objects.flatMap((object, index) => {
    const rig = object.scene_index === sceneIndex && object.rigs.find((candidate) => candidate.spec === spec && candidate.budget?.alone);
    return rig ? [{object, index, rig}] : [];
  });
  return scene.budgets.map((budget) => ({budget, rows: sharing(budget.spec)})).filter(({rows}) => rows.length)
    .map(({budget, rows}) => budgetCard(scene, budget, rows));
}

function budgetCard(scene, budget, rows) {
  const losers = rows.filter(({rig}) => rig.budget.gave_up).length;
  const outcome = losers === 0 ? 'The time is enough for all: no object gives anything up.' :
    `${losers} of ${plural(rows.length, 'object')} ${losers === 1 ? 'gives' : 'give'} something up for the others: beside each figure is what it would be with the whole frame to itself.`;
  const head = element('tr', {}, element('th', {scope: 'col', class: 'name'}, 'Object'),
    ...budgetColumns.map(({title, unit}) => element('th', {scope: 'col'}, element('span', {}, title), element('small', {class: 'unit'}, unit))));
  const largest = Math.max(...rows.map(({rig}) => rig.total.rms));
  return element('div', {class: 'card budget'},
    element('h2', {}, `What a frame of ${figure(budget.budget_us)} µs holds`),
    element('p', {class: 'facts'}, `${sceneTitle(scene, true)} · `, swatch(colorOf(budget.spec)), ` ${budget.spec} · ${figure(budget.mean_us)} µs on average, ${figure(budget.most_us)} µs at most`,
      budget.frames_over ? ` · too long in ${plural(budget.frames_over, 'frame')}` : null,
      budget.goal === null ? null : ` · no object takes more than an error of ${percent(budget.goal)} needs`),
    element('p', {class: 'verdict'}, outcome),
    element('div', {class: 'scroller', tabindex: '0', role: 'region', 'aria-label': `The frame's time, object by object, for ${budget.spec}`},
      element('table', {}, element('thead', {}, head), element('tbody', {}, ...rows.map((row) => budgetRow(row, largest))))),
    element('p', {class: 'hint'}, 'Time goes where it lowers the largest error: the error allowed is the same for all who give up. Time is modelled, for the points that a frame shades.'));
}

function budgetRow({object, index, rig}, largest) {
  const cells = budgetColumns.map(({get, alone, format, bar}) => {
    const [here, there] = [format(get(rig)), format(alone(rig.budget.alone))];
    const cell = element('td', {class: bar ? 'barred' : null}, here, element('span', {class: 'alone'}, here === there ? '' : `alone ${there}`));
    if (bar) cell.style.setProperty('--share', largest > 0 ? `${100 * get(rig) / largest}%` : '0%');
    return cell;
  });
  return element('tr', {title: `gave up ${rig.budget.given_up}`}, element('th', {scope: 'row', class: 'name'}, element('a', {href: `#object-${index}`}, object.name)), ...cells);
}
