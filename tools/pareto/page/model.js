// The data of the page: pareto.json as the program wrote it, what its figures are called, and fronts.

const study = JSON.parse(document.getElementById('pareto-data').textContent);

const families = ['constant', 'gradient', 'lattice', 'mixed', 'poly', 'invquad', 'auto', 'rbf', 'latticegrad', 'hermite'];
const familyColor = (family) => `var(--family-${families.includes(family) ? family : 'other'})`;

/** Marks by near lights: how many is a shape, so that colour is free for the family. */
const nearKinds = [
  {value: '0', label: 'none', mark: '●', symbol: 'circle'},
  {value: '1', label: '1', mark: '▲', symbol: 'triangle'},
  {value: '2', label: '2', mark: '■', symbol: 'square'},
  {value: '4', label: '4', mark: '◆', symbol: 'diamond'},
  {value: 'auto', label: 'auto', mark: '★', symbol: 'star'},
];
const symbolOf = (point) => (nearKinds.find((kind) => kind.value === point.near) ?? nearKinds[0]).symbol;

const errors = [
  {value: 'total_rms', label: 'Total RMS', axis: 'total RMS error, %', title: 'Against exact irradiance: what is seen'},
  {value: 'total_max', label: 'Total max', axis: 'largest total error, %', title: 'The largest difference from exact irradiance'},
  {value: 'spatial_rms', label: 'Spatial RMS', axis: 'spatial RMS error, %', title: 'Against SH of the same bands projected at every point: what the rig alone adds'},
  {value: 'spatial_max', label: 'Spatial max', axis: 'largest spatial error, %', title: 'The largest difference from SH projected at every point'},
];
const errorNamed = (name) => errors.find((error) => error.value === name);

const frameTime = (point, shaded) => (point.fit_us === null || point.shade_ns_per_point === null ? null : point.fit_us + point.shade_ns_per_point * shaded / 1000);
const costs = [
  {value: 'frame_us', label: 'Frame', axis: (shaded) => `fit and shading of ${count(shaded)} points, µs (CPU)`, title: 'Fit and shading of one object in one frame, on one core', get: frameTime},
  {value: 'fit_us', label: 'Fit', axis: () => 'fit of one object in one frame, µs', title: 'Everything before shading: pose, bounds, choice, projection, fit', get: (point) => point.fit_us},
  {value: 'shade_ns_per_point', label: 'Shading, CPU', axis: () => 'shading, ns a point (one core)', title: 'One point on one core', get: (point) => point.shade_ns_per_point},
  {value: 'gpu_ns_per_point', label: 'Shading, GPU', axis: () => `shading, ns a point (${study.gpu})`, title: study.gpu, get: (point) => point.gpu_ns_per_point},
  {value: 'modelled_ns_per_point', label: 'Cost model', axis: () => 'modelled shading, ns a point', title: 'What `auto` goes by: a constant model, so that its choices depend on no clock', get: (point) => point.modelled_ns_per_point},
  {value: 'bytes', label: 'Bytes', axis: () => 'bytes of coefficients', title: 'Of the frame with most SH vectors', get: (point) => point.bytes},
].filter((cost) => study.objects.some((object) => object.points.some((point) => cost.get(point, 1) !== null)));
const costNamed = (name) => costs.find((cost) => cost.value === name);

/** What may be left out: the values that occur, and which of them are shown at first. */
const distinct = (get) => [...new Set(study.objects.flatMap((object) => object.points.map(get)))];
const sorted = (values, order) => values.sort((a, b) => order.indexOf(a) - order.indexOf(b));
const filters = [
  {name: 'near', label: 'Near lights', get: (point) => point.near, all: sorted(distinct((point) => point.near), nearKinds.map((kind) => kind.value)), text: (value) => {
    const kind = nearKinds.find((candidate) => candidate.value === value);
    return kind ? `${kind.mark} ${kind.label}` : value;
  }},
  {name: 'bands', label: 'Bands', get: (point) => point.bands, all: distinct((point) => point.bands).sort(), start: (all) => [all.includes(3) ? 3 : all[0]], text: String},
  {name: 'fit', label: 'Fitted at', get: (point) => point.fit, all: sorted(distinct((point) => point.fit), ['', 'corners', 'numeric', 'gauss', 'lsq']),
    text: (value) => ({'': 'its own way', corners: 'corners', numeric: 'numeric', gauss: 'Gauss nodes', lsq: 'least squares'})[value]},
  {name: 'form', label: 'Near lights evaluated', get: (point) => point.near_form, all: sorted(distinct((point) => point.near_form), ['exact', 'cheap', 'corrector']), start: () => ['exact'], text: (value) => value},
  {name: 'storage', label: 'Coefficients', get: (point) => point.storage, all: sorted(distinct((point) => point.storage), ['float', 'half']), start: () => ['float'], text: (value) => ({float: '32 bits', half: '16 bits'})[value]},
].map((filter) => ({...filter, start: filter.start ? filter.start(filter.all) : filter.all}));

const settings = makeStore({
  object: 0, error: 'total_rms', cost: costs[0].value, shaded: study.points_per_frame, hidden: [], chosen: null, hovered: null,
  ...Object.fromEntries(filters.map((filter) => [filter.name, filter.start])),
});

/** What the settings let through, with its cost and error; the front of it, cheapest first. Equal points share a front. */
function visible(values) {
  const cost = costNamed(values.cost);
  const points = study.objects[values.object].points
    .filter((point) => !values.hidden.includes(point.family) && filters.every((filter) => values[filter.name].includes(filter.get(point))))
    .map((point) => ({point, x: cost.get(point, values.shaded), y: point[values.error]}))
    .filter(({x}) => x !== null);
  const front = [];
  for (const entry of [...points].sort((a, b) => a.x - b.x || a.y - b.y)) {
    const last = front.at(-1);
    if (!last || entry.y < last.y || (entry.y === last.y && entry.x === last.x)) front.push(entry);
  }
  for (const entry of front) entry.optimal = true;
  return {points, front};
}

/** "poly:6", "poly:6 near 2", "auto 5 %", "gradient near auto 5 %". */
function shortName(point) {
  const target = point.target && `${Number((100 * Number(point.target.split(' ')[1])).toPrecision(3))}\u00a0%${point.target.startsWith('--total') ? ' total' : ''}`;
  const near = point.near === '0' || (point.family === 'auto' && point.near === 'auto') ? '' : ` near ${point.near}`;
  const form = point.near_form === 'exact' ? '' : ` ${point.near_form}`;
  return point.spec + near + form + (target ? ` ${target}` : '') + (point.storage === 'half' ? ' half' : '');
}
