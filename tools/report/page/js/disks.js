// Disk lights of a scene: what each method costs and errs, and which one each disk used, and why.

/** Two digits, however small, and never as a power of ten. */
const small = (relative) => (relative > 0 ? (100 * relative).toFixed(Math.min(9, Math.max(0, 1 - Math.floor(Math.log10(100 * relative))))) : '0');

const diskColumns = [
  {title: 'SH RMS', unit: '% of their norm', get: (row) => row.sh?.rms},
  {title: 'max', unit: '%', get: (row) => row.sh?.max},
  {title: 'Irradiance RMS', unit: '% of the peak', get: (row) => row.irradiance.rms},
  {title: 'max', unit: '%', get: (row) => row.irradiance.max, bar: true},
  {title: 'Time', unit: 'ns', get: (row) => row.ns, format: figure},
];

function diskMethods(disks) {
  const largest = Math.max(...disks.methods.map((row) => row.irradiance.max));
  const rows = disks.methods.map((row) => element('tr', {}, element('th', {scope: 'row', class: 'name'}, row.method, element('span', {class: 'where'}, ` ${row.meaning}`)),
    ...diskColumns.map(({get, format, bar}) => {
      const value = get(row);
      const cell = element('td', {class: bar ? 'barred' : null}, value === undefined ? '–' : (format ?? small)(value));
      if (bar) cell.style.setProperty('--share', `${100 * value / largest}%`);
      return cell;
    })));
  const head = element('tr', {}, element('th', {scope: 'col', class: 'name'}, 'Method'),
    ...diskColumns.map(({title, unit}) => element('th', {scope: 'col'}, element('span', {}, title), element('small', {class: 'unit'}, unit))));
  return element('div', {class: 'scroller', tabindex: '0', role: 'region', 'aria-label': 'Methods for disk lights'},
    element('table', {class: 'disk-methods'}, element('thead', {}, head), element('tbody', {}, ...rows)));
}

/** The disks under one rig of one object at a time: near ones first. */
function diskUses(disks) {
  const keyOf = (use) => `${use.object}, ${use.rig}`;
  const keys = [...new Set(disks.uses.map(keyOf))];
  const several = new Set(disks.uses.map((use) => use.object)).size > 1;
  const body = element('tbody');
  const chooser = choice('Rig', keys.map((key) => ({value: key, label: several ? key : disks.uses.find((use) => keyOf(use) === key).rig})), show);

  function show(key) {
    chooser.show(key);
    const rank = (use) => (use.method.startsWith('near') ? 0 : use.method === 'none' ? 2 : 1);
    const uses = disks.uses.filter((use) => keyOf(use) === key).sort((a, b) => rank(a) - rank(b));
    body.replaceChildren(...uses.map((use) => element('tr', {}, element('th', {scope: 'row', class: 'name'}, use.light),
      element('td', {class: 'text'}, use.method), element('td', {class: 'why'}, use.why))));
  }

  if (keys.length) show(keys[keys.length - 1]);
  return [element('div', {class: 'bar'}, element('h3', {}, 'Which method, and why'), keys.length > 1 ? chooser.node : null),
    element('div', {class: 'scroller tall', tabindex: '0', role: 'region', 'aria-label': 'Disk lights and their methods'},
      element('table', {class: 'light-use lights'}, element('thead', {}, element('tr', {}, ...['Disk', 'Method', 'Why'].map((title) => element('th', {scope: 'col'}, title)))), body))];
}

function diskSection(scene) {
  const {disks} = scene;
  return element('section', {class: 'card disks'}, element('h2', {}, 'Disk lights'), element('p', {class: 'facts'}, sceneTitle(scene)),
    element('p', {class: 'verdict'}, disks.choice), diskMethods(disks),
    element('p', {class: 'hint'}, `Measured at ${count(disks.pairs)} pairs of a disk and a surface sample that it lights, over the clip. SH: of the coefficients, relative to their norm. Irradiance: of a Lambert surface, relative to the peak over all normals that the disk gives at the point; methods that give SH include what their bands cannot hold. Time: one disk and point after another, without SIMD, the least of seven rounds.`),
    ...diskUses(disks));
}
