// The top of the page, which answers at a glance: which rig for each object, what it costs, what it loses, and why.

/** On a telephone rows are drawn as cards, which takes the meaning of rows and cells from them unless it is said. */
function setRoles(part) {
  const roles = {TABLE: 'table', THEAD: 'rowgroup', TBODY: 'rowgroup', TR: 'row', TD: 'cell'};
  for (const node of [part, ...part.querySelectorAll('*')]) {
    const role = node.tagName === 'TH' ? (node.scope === 'row' ? 'rowheader' : 'columnheader') : roles[node.tagName];
    if (role) node.setAttribute('role', role);
  }
}

const kRoomy = 5;  // objects; more than that are listed densely

const ofRig = (object, get) => (object.verdict ? get(object.rigs.find(({spec}) => spec === object.verdict.spec)) : null);
const relative = (value) => (value === null ? '–' : figure(100 * value));

const summaryColumns = [
  {key: 'name', title: 'Object', get: ({object}) => object.name, draw: objectCell},
  {key: 'rig', title: 'Rig to use', text: true, get: ({object}) => object.verdict?.spec ?? null, draw: adviceCell},
  {key: 'fit', title: 'Fit', unit: 'µs a frame', group: 'What it costs', rig: (rig) => rig.fit_us, format: figure, hint: 'Median over the frames of all that has to be computed once a frame'},
  {key: 'shade', title: 'Shading', unit: 'ns a point', group: 'What it costs', rig: (rig) => rig.shade_ns_per_point, format: figure, hint: 'Evaluating rig and near lights at one surface point'},
  {key: 'bytes', title: 'Size', unit: 'bytes', group: 'What it costs', rig: (rig) => rig.bytes, format: count, hint: 'The float32 coefficients'},
  {key: 'total', title: 'Total RMS', unit: '%', group: 'What it loses', rig: (rig) => rig.total.rms, format: relative, strong: true, hint: 'Error against exact irradiance'},
  {key: 'spatial', title: 'Spatial RMS', unit: '%', group: 'What it loses', rig: (rig) => rig.spatial.rms, format: relative, hint: 'Error that the rig adds to SH projected at every point'},
  {key: 'max', title: 'Total max', unit: '%', group: 'What it loses', rig: (rig) => rig.total.max, format: relative, hint: 'The largest error at any sample in any frame'},
  {key: 'jump', title: 'Popping', unit: 'max jump, %', group: 'What it loses', rig: (rig) => rig.max_jump, format: relative, hint: 'The largest change of the error from one frame to the next'},
  {key: 'why', title: 'Why', draw: ({object}) => element('td', {class: 'why', 'data-label': 'Why', title: object.verdict?.sentence}, element('span', {}, whyAdvised(object)))},
].map((column) => (column.rig ? {...column, get: ({object}) => ofRig(object, column.rig)} : column));

function objectCell({object, index}) {
  const view = portrait(index);
  return element('th', {scope: 'row', class: 'name'}, element('div', {class: 'who'}, view, element('div', {},
    element('a', {href: `#object-${index}`}, object.name),
    report.scenes.length > 1 ? element('span', {class: 'where', title: sceneTitle(sceneOf(object))}, sceneTitle(sceneOf(object), true)) : null)));
}

function adviceCell({object}) {
  if (!object.verdict) return element('td', {class: 'text', 'data-label': 'Rig to use'}, '–');
  const {spec, advised} = object.verdict;
  const rig = object.rigs.find((candidate) => candidate.spec === spec);
  return element('td', {class: 'text advice', 'data-label': 'Rig to use'}, element('strong', {class: 'spec'}, swatch(colorOf(spec)), spec),
    element('span', {class: 'where'}, advised ? `${plural(Number(meanCount(rig.sh_vectors)), 'SH vector')}${rig.near_lights ? `, ${meanCount(rig.near_lights)} near` : ''}` : 'none is advised'));
}

/** In a few words; report.json has the sentence in full. */
function whyAdvised(object) {
  const {verdict, rigs, mean_irradiance: light} = object;
  if (!verdict) return '';
  if (!(light > 0)) return 'No light reaches it: no rig is better than another.';
  const others = rigs.filter(({spec}) => spec !== verdict.spec).sort((a, b) => a.total.rms - b.total.rms);
  if (!verdict.advised) return `No rig lights it well: even the least error is above ${Math.round(100 * report.usable_error)}\u00a0%, most likely because a light comes very close.`;
  if (!others.length) return 'The only rig measured.';
  const slack = `${Math.round(100 * report.verdict_slack)}\u00a0%`;
  if (verdict.spec === verdict.best) {
    const [next] = others;
    return `Least error of ${rigs.length} rigs; next is ${next.spec} with ${percent(next.total.rms)}, fitted in ${figure(next.fit_us)}\u00a0µs.`;
  }
  const best = rigs.find(({spec}) => spec === verdict.best);
  return `Cheapest to shade within ${slack} of the least error, which ${best.spec} has: ${percent(best.total.rms)}.`;
}

/** The table of answers: a row an object. */
function answers() {
  const moving = report.objects.some(({truth}) => truth.length > 1);
  const shown = summaryColumns.filter(({key}) => key !== 'jump' || moving);
  const rows = report.objects.map((object, index) => ({object, index}));
  const largest = Math.max(...rows.map((row) => ofRig(row.object, (rig) => rig.total.rms) ?? 0));
  const body = element('tbody');
  const {heads, sorted} = sortableHeads(shown, () => draw());
  const draw = () => {
    body.replaceChildren(...sorted(rows).map((row) => element('tr', {class: row.object.verdict?.advised ? null : 'unadvised'},
      ...shown.map((column) => column.draw?.(row) ?? answerCell(column, row, rows.length > 1 ? largest : 0)))));
    setRoles(body);
  };
  draw();
  const span = (name) => shown.filter(({group}) => group === name).length;
  const groups = element('tr', {class: 'groups', 'aria-hidden': 'true'}, element('td', {colspan: 2}), ...['What it costs', 'What it loses'].map((name) => element('td', {colspan: span(name)}, name)), element('td'));
  const head = element('thead', {class: rows.length > 1 ? null : 'single'}, groups, element('tr', {}, ...heads));
  const table = element('table', {class: rows.length > kRoomy ? 'answers dense' : 'answers'}, head, body);
  setRoles(table);
  return element('div', {class: 'scroller', tabindex: '0', role: 'region', 'aria-label': 'The rig to use for each object'}, table);
}

/** `largest` is what a bar of full length stands for; 0 where there is nothing to compare with. */
function answerCell({title, unit, get, format, strong}, row, largest) {
  const value = get(row);
  const cell = element('td', {class: strong ? (largest > 0 ? 'strong barred' : 'strong') : null, 'data-label': `${title}, ${unit}`}, value === null ? '–' : format(value));
  if (strong && largest > 0) cell.style.setProperty('--share', `${100 * (value ?? 0) / largest}%`);
  return cell;
}

function summary() {
  const scenes = [...new Set(report.scenes.map((scene) => sceneTitle(scene)))];
  return element('section', {class: 'summary', 'aria-labelledby': 'summary-title'},
    element('h1', {id: 'summary-title'}, report.objects.length === 1 ? 'Which rig to use' : 'Which rig to use for each object'),
    element('p', {class: 'facts'}, [
      scenes.slice(0, 3).join('; ') + (scenes.length > 3 ? ` and ${scenes.length - 3} more` : ''),
      plural(report.objects.length, 'object'), plural(specs.length, 'rig'), `${report.bands} SH bands`,
      report.rate === 30 ? null : `${figure(report.rate)} frames a second`, report.exposure === 1 ? null : `exposure ${figure(report.exposure)}`, `Rigel ${report.version}`,
    ].filter(Boolean).join(' · ')),
    element('div', {class: 'card'}, answers(),
      element('div', {class: 'command'}, element('span', {class: 'choice-label'}, 'To repeat it'), element('code', {}, report.command), copyButton(() => report.command))));
}
