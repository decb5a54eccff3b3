// What became of each light under the rig chosen: sortable, with a strip over time and the reason in words.

const kLightsShown = 20;
const kRoles = [
  {name: 'near', text: 'near: evaluated exactly at every point'},
  {name: 'blended', text: 'blended: in part'},
  {name: 'far', text: 'far: in the rig'},
  {name: 'culled', text: 'culled: gives nothing'},
];

const lightColumns = [
  {key: 'name', title: 'Light', get: (light) => light.name, text: true},
  {key: 'course', title: 'Over time', motion: true, draw: courseCell},
  {key: 'near', title: 'Near', unit: 'frames', get: (light) => light.near_frames, format: count, downFirst: true},
  {key: 'blended', title: 'Blended', unit: 'frames', get: (light) => light.blend_frames, format: count, downFirst: true},
  {key: 'culled', title: 'Culled', unit: 'frames', get: (light) => light.culled_frames, format: count, downFirst: true},
  {key: 'bound', title: 'Bound', unit: '%', get: (light) => light.bound, format: (value) => figure(100 * value), downFirst: true, hint: 'Of the error of leaving it in the rig, anywhere on the object: the largest over the frames'},
  {key: 'share', title: 'Share', unit: '%', get: (light) => light.share, format: (value) => figure(100 * value), bar: true, downFirst: true, hint: 'Of the light that the object receives, mean over the frames'},
  {key: 'why', title: 'Why', draw: (light) => element('td', {class: 'why'}, light.why)},
];

/** Those that were near longest come first, then those with the largest bounds: what a reader looks for. */
const byWeight = (a, b) => b.near_frames - a.near_frames || b.blend_frames - a.blend_frames || b.bound - a.bound;

function lightTable(object, store) {
  const moving = object.truth.length > 1;
  const shown = lightColumns.filter((column) => !column.motion || moving);
  const body = element('tbody');
  let all = false;
  let rig = null;
  const rigs = choice('Rig', object.rigs.map(({spec}) => ({value: spec, label: spec, color: colorOf(spec)})), (spec) => store.set({rig: spec}));
  const summary = element('p', {class: 'hint'});
  const more = element('button', {type: 'button', class: 'quiet more', on: {click: () => {
    all = !all;
    draw();
  }}});
  const search = element('input', {type: 'search', class: 'search', placeholder: 'Name or type', 'aria-label': 'Lights whose name or type has these letters', on: {input: () => draw()}});
  const {heads, sorted} = sortableHeads(shown, () => draw());
  if (moving) heads[1].append(courseAxis(object));
  const table = element('table', {class: 'light-use'}, element('thead', {}, element('tr', {}, ...heads)), body);

  function draw() {
    const wanted = search.value.trim().toLowerCase();
    const lights = sorted(rig.lights, byWeight).filter(({name, type}) => !wanted || `${name} ${type}`.toLowerCase().includes(wanted));
    const top = Math.max(...rig.lights.map((light) => light.bound), 1e-9);
    const largest = Object.fromEntries(shown.filter(({bar}) => bar).map((bar) => [bar.key, Math.max(...rig.lights.map(bar.get), 1e-9)]));
    body.replaceChildren(...lights.slice(0, all ? lights.length : kLightsShown).map((light) => lightRow(light, shown, {top, largest})));
    if (!lights.length) body.append(element('tr', {}, element('td', {class: 'text', colspan: shown.length}, 'No light has these letters in its name or type.')));
    more.hidden = lights.length <= kLightsShown;
    more.textContent = all ? `Show the first ${kLightsShown}` : `Show all ${plural(lights.length, 'light')}`;
    point(store.get());
  }

  /** The moment as a line through all strips, and the weight of each light that is ever near. */
  function point({cursor}) {
    table.classList.toggle('pointing', cursor !== null);
    if (cursor === null) return;
    table.style.setProperty('--moment', `${100 * (cursor + 0.5) / object.truth.length}%`);
    for (const now of body.querySelectorAll('.now')) now.textContent = weightText(now.light, cursor);
  }

  if (moving) {
    pointInTime(body, object, store, (event) => {
      const strip = event.target.closest('.course-strip');
      if (!strip) return undefined;
      const box = strip.getBoundingClientRect();
      const at = Math.floor(object.truth.length * (event.clientX - box.left) / box.width);
      return object.truth[Math.min(object.truth.length - 1, Math.max(0, at))].time;
    });
    store.watch(point, 'cursor');
  }
  store.watch(({rig: spec}) => {
    const chosen = object.rigs.find((candidate) => candidate.spec === spec) ?? object.rigs[0];
    if (chosen === rig) return;
    rig = chosen;
    rigs.show(rig.spec);
    summary.textContent = rig.asked
      ? `${rig.spec} with ${rig.asked}: ${plural(Number(rig.near_lights.toFixed(1)), 'near light')} a frame on average. The longest near come first, then the largest bounds.`
      : `${rig.spec} leaves every light in the rig. Lights near the object can be evaluated apart: --near 2, or --near auto.`;
    draw();
  }, 'rig');
  return element('div', {class: 'card'}, element('div', {class: 'bar'}, element('h3', {}, 'Lights'), object.rigs.length > 1 ? rigs.node : null,
    object.rigs.some(({lights}) => lights.length > kLightsShown) ? search : null),
    summary, moving ? courseLegend() : null,
    element('div', {class: 'scroller', tabindex: '0', role: 'region', 'aria-label': `Lights of ${object.name}`}, table), more);
}

function lightRow(light, shown, scales) {
  return element('tr', {}, ...shown.map((column) => {
    if (column.draw) return column.draw(light, scales);
    const value = column.get(light);
    if (column.key === 'name') return element('th', {scope: 'row', class: 'name', title: value}, value, element('span', {class: 'where'}, light.type));
    const cell = element('td', {class: column.bar ? 'barred' : column.text ? 'text' : null}, column.format ? column.format(value) : value);
    if (column.bar) cell.style.setProperty('--share', `${100 * value / scales.largest[column.key]}%`);
    return cell;
  }));
}

function courseLegend() {
  return element('div', {class: 'legend roles', 'aria-hidden': 'true'}, ...kRoles.map(({name, text}) => element('span', {class: 'entry'}, element('span', {class: `swatch role-${name}`}), text)),
    element('span', {class: 'entry'}, element('span', {class: 'swatch bound-line'}), 'bound, logarithmic'));
}

/** The first moment, the last, and one between. */
function courseAxis({truth}) {
  const at = [0, Math.floor((truth.length - 1) / 2), truth.length - 1];
  return element('span', {class: 'course-axis', 'aria-hidden': 'true'}, ...[...new Set(at)].map((index) => element('small', {}, seconds(truth[index].time))));
}

const kBoundDecades = 3;
const kBoundHeight = 14;
const kStripHeight = 12;

/** The light's role in a frame, or its weight where it is near in part. */
function weightText(light, frame) {
  let end = 0;
  const [, role] = light.roles.find(([length]) => (end += length) > frame) ?? [0, ''];
  return role === 'blended' ? `${figure(100 * light.weights[frame])}\u00a0% near` : role;
}

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
    strip.append(svgElement('polyline', {class: 'bound-line', points: light.bounds.map((bound, i) => `${i + 0.5},${y(bound).toFixed(1)}`).join(' ')}));
  }
  const now = Object.assign(element('span', {class: 'now', 'aria-hidden': 'true'}), {light});
  return element('td', {class: 'course-cell'}, element('div', {class: 'course-strip'}, strip, now));
}
