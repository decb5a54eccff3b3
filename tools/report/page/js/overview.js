// What belongs to no single object: all objects against all rigs, and budgets that objects share.

/** The sentence with the rig it names in its colour. */
function verdictSentence(object) {
  const {spec} = object.verdict;
  const sentence = object.verdict.sentence.replaceAll(' %', '\u00a0%');
  const at = sentence.indexOf(spec);
  if (at < 0) return element('p', {class: 'verdict'}, sentence);
  const name = element('strong', {class: 'spec'}, swatch(colorOf(spec)), spec);
  return element('p', {class: 'verdict'}, sentence.slice(0, at), name, sentence.slice(at + spec.length));
}

function comparisons() {
  return [...(report.objects.length > 1 ? [matrix()] : []), ...report.scenes.flatMap(budgetCards)];
}

/** RMS of every rig on every object, and the geometric mean of each rig measured on all of them. */
function matrix() {
  const body = element('tbody');
  const foot = element('tfoot');
  const kind = choice('Error', errorKinds, (error) => settings.set({error}));
  const head = element('thead', {}, element('tr', {}, element('th', {scope: 'col', class: 'name'}, 'RMS error, %'),
    ...specs.map((spec) => element('th', {scope: 'col', class: 'spec'}, swatch(colorOf(spec)), spec))));
  settings.watch(({error}) => {
    kind.show(error);
    body.replaceChildren(...report.objects.map((object, i) => matrixRow(object, i, error)));
    foot.replaceChildren(element('tr', {}, element('th', {scope: 'row', class: 'name'}, 'Geometric mean'),
      ...specs.map((spec) => element('td', {}, geometricMean(spec, error)))));
  }, 'error');
  return element('section', {class: 'card', 'aria-label': 'All objects and rigs'},
    element('div', {class: 'bar'}, element('h2', {}, 'All objects, all rigs'), kind.node),
    element('div', {class: 'scroller', tabindex: '0', role: 'region', 'aria-label': 'Errors of all objects'},
      element('table', {class: 'matrix'}, head, body, foot)),
    element('p', {class: 'hint'}, 'The least error of each object is bold; the deeper the colour, the larger an error beside it.'));
}

function matrixRow(object, index, error) {
  const values = specs.map((spec) => object.rigs.find((rig) => rig.spec === spec)?.[error].rms);
  const least = Math.min(...values.filter((value) => value !== undefined));
  const cells = values.map((value) => {
    if (value === undefined) return element('td', {}, '–');
    const cell = element('td', {class: value === least ? 'least' : null}, figure(100 * value));
    // No colour for the least error of the row, full colour from four times as much on.
    const excess = value > 0 ? Math.log(value / Math.max(least, 1e-12)) / Math.log(4) : 0;
    cell.style.setProperty('--heat', `${Math.round(52 * Math.min(1, excess))}%`);
    return cell;
  });
  return element('tr', {}, element('th', {scope: 'row', class: 'name'},
    element('a', {href: `#object-${index}`}, object.name),
    element('span', {class: 'where', title: sceneTitle(sceneOf(object))}, sceneTitle(sceneOf(object), true))), ...cells);
}

function geometricMean(spec, error) {
  const values = report.objects.flatMap((object) => object.rigs.filter((rig) => rig.spec === spec)).map((rig) => rig[error].rms);
  if (values.length < report.objects.length || values.some((value) => value <= 0)) return '–';
  return figure(100 * Math.exp(values.reduce((sum, value) => sum + Math.log(value), 0) / values.length));
}
