// What became of each light under the rig chosen: sortable, with a strip over time and the reason in words.

const kLightsShown = 20;
const kRoles = [
  {name: 'near', text: 'near: evaluated exactly at every point'},
  {name: 'blended', text: 'blended: in part'},
  {name: 'far', text: 'far: in the rig'},
  {name: 'culled', text: 'culled: gives nothing'},
];

const lightColumns = [
  {key: 'name', title: 'Light', get: (light) => light.name},
  {key: 'course', title: 'Over time', motion: true, draw: courseCell},
  {key: 'type', title: 'Type', get: (light) => light.type, text: true},
  {key: 'near', title: 'Near', unit: 'frames', get: (light) => light.near_frames, format: count},
  {key: 'blended', title: 'Blended', unit: 'frames', get: (light) => light.blend_frames, format: count},
  {key: 'culled', title: 'Culled', unit: 'frames', get: (light) => light.culled_frames, format: count},
  {key: 'bound', title: 'Bound', unit: '%', get: (light) => light.bound, format: (value) => figure(100 * value), hint: 'Of the error of leaving it in the rig, anywhere on the object: the largest over the frames'},
  {key: 'share', title: 'Share', unit: '%', get: (light) => light.share, format: (value) => figure(100 * value), bar: true, hint: 'Of the light that the object receives, mean over the frames'},
  {key: 'why', title: 'Why', draw: (light) => element('td', {class: 'why'}, light.why)},
];

/** Those that were near longest come first, then those with the largest bounds: what a reader looks for. */
const byWeight = (a, b) => b.near_frames - a.near_frames || b.blend_frames - a.blend_frames || b.bound - a.bound;

function lightTable(object, store) {
  const shown = lightColumns.filter((column) => !column.motion || object.truth.length > 1);
  const order = {key: null, down: false};
  const body = element('tbody');
  let all = false;
  let rig = null;
  const rigs = choice('Rig', object.rigs.map(({spec}) => ({value: spec, label: spec, color: colorOf(spec)})), (spec) => store.set({rig: spec}));
  const summary = element('p', {class: 'hint'});
  const more = element('button', {type: 'button', class: 'quiet more', on: {click: () => {
    all = !all;
    draw();
  }}});
  const headers = shown.map((column) => element('th', {scope: 'col', 'aria-sort': column.get ? 'none' : null, title: column.hint,
    class: column.key === 'name' ? 'name' : column.get && !column.text ? null : 'text'},
    column.get ? element('button', {type: 'button', class: 'sort', on: {click: () => sortBy(column)}},
      element('span', {}, column.title), column.unit ? element('small', {}, column.unit) : null) : column.title));

  /** Names rise first, figures fall first. */
  function sortBy(column) {
    const textual = column.text || column.key === 'name';
    order.down = order.key === column.key ? !order.down : !textual;
    order.key = column.key;
    draw();
  }

  function draw() {
    const column = shown.find((candidate) => candidate.key === order.key);
    const lights = [...rig.lights].sort(column ? (a, b) => (order.down ? -1 : 1) * compareValues(column.get(a), column.get(b)) : byWeight);
    const top = Math.max(...rig.lights.map((light) => light.bound), 1e-9);
    const largest = Object.fromEntries(shown.filter(({bar}) => bar).map((bar) => [bar.key, Math.max(...rig.lights.map(bar.get), 1e-9)]));
    headers.forEach((header, i) => {
      if (shown[i].get) header.setAttribute('aria-sort', shown[i].key !== order.key ? 'none' : order.down ? 'descending' : 'ascending');
    });
    body.replaceChildren(...lights.slice(0, all ? lights.length : kLightsShown).map((light) => lightRow(light, shown, {top, largest})));
    more.hidden = lights.length <= kLightsShown;
    more.textContent = all ? `Show the first ${kLightsShown}` : `Show all ${count(lights.length)} lights`;
  }

  store.watch(({rig: spec}) => {
    const chosen = object.rigs.find((candidate) => candidate.spec === spec) ?? object.rigs[0];
    if (chosen === rig) return;
    rig = chosen;
    rigs.show(rig.spec);
    summary.textContent = rig.asked
      ? `${rig.spec} with ${rig.asked}: ${figure(rig.near_lights)} near lights a frame on average.`
      : `${rig.spec} leaves every light in the rig. Lights near the object can be evaluated apart: --near 2, or --near auto.`;
    draw();
  }, 'rig');
  return element('div', {class: 'card'}, element('div', {class: 'bar'}, element('h3', {}, 'Lights'), object.rigs.length > 1 ? rigs.node : null),
    summary, object.truth.length > 1 ? courseLegend() : null,
    element('div', {class: 'scroller', tabindex: '0', role: 'region', 'aria-label': `Lights of ${object.name}`},
      element('table', {class: 'light-use'}, element('thead', {}, element('tr', {}, ...headers)), body)), more);
}

const compareValues = (x, y) => (typeof x === 'string' ? x.localeCompare(y, 'en', {numeric: true}) : x - y);

function lightRow(light, shown, scales) {
  return element('tr', {}, ...shown.map((column) => {
    if (column.draw) return column.draw(light, scales);
    const value = column.get(light);
    if (column.key === 'name') return element('th', {scope: 'row', class: 'name'}, value);
    const cell = element('td', {class: column.bar ? 'barred' : column.text ? 'text' : null}, column.format ? column.format(value) : value);
    if (column.bar) cell.style.setProperty('--share', `${100 * value / scales.largest[column.key]}%`);
    return cell;
  }));
}

function courseLegend() {
  return element('div', {class: 'legend roles', 'aria-hidden': 'true'}, ...kRoles.map(({name, text}) => element('span', {class: 'entry'}, element('span', {class: `swatch role-${name}`}), text)),
    element('span', {class: 'entry'}, element('span', {class: 'swatch bound-line'}), 'bound, logarithmic'));
}

const kBoundDecades = 3;
const kBoundHeight = 14;
const kStripHeight = 9;

/** The light's roles as a strip over the frames, coloured by its weight, and above it the bound over three decades. */
function courseCell(light, {top}) {
  const frames = light.roles.reduce((sum, [length]) => sum + length, 0);
  const strip = svgElement('svg', {class: 'course', viewBox: `0 0 ${frames} ${kBoundHeight + kStripHeight}`, preserveAspectRatio: 'none', role: 'img',
    'aria-label': light.roles.map(([length, role]) => `${role} ${plural(length, 'frame')}`).join(', ')});
  const rectangle = (x, width, role, opacity) => svgElement('rect', {class: `role-${role}`, x, y: kBoundHeight, width, height: kStripHeight, 'fill-opacity': opacity});
  let first = 0;
  for (const [length, role] of light.roles) {
    strip.append(rectangle(first, length, role === 'blended' ? 'far' : role));
    if (role === 'blended') {
      for (let i = first; i < first + length; ++i) strip.append(rectangle(i, 1, 'near', light.weights[i].toFixed(2)));
    }
    first += length;
  }
  if (light.bounds) {
    const y = (bound) => kBoundHeight - 1 - (kBoundHeight - 2) * Math.max(0, 1 + Math.log10(Math.max(bound, 1e-30) / top) / kBoundDecades);
    strip.append(svgElement('polyline', {class: 'bound-line', points: polyline(light.bounds.map((bound, i) => [i + 0.5, y(bound)]))}));
  }
  return element('td', {}, strip);
}
