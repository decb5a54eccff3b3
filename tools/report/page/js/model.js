// The data of the page: report.json as the program wrote it, the numbers of pictures, and what follows from both.

const report = JSON.parse(document.getElementById('report-data').textContent);
const embedded = JSON.parse(document.getElementById('picture-data').textContent);

/** Every spec of the report has one colour and dash, the same for all objects. */
const kColors = 10;
const specs = [...new Set(report.objects.flatMap((object) => object.rigs.map((rig) => rig.spec)))];
const colorOf = (spec) => `var(--rig-${specs.indexOf(spec) % kColors})`;
const dashOf = (spec) => (specs.indexOf(spec) < kColors ? null : '6 3');

const errorKinds = [
  {value: 'total', label: 'Total', title: 'Against exact irradiance: what is seen'},
  {value: 'spatial', label: 'Spatial', title: 'Against SH projected at every point: what the rig alone adds'},
];

const costs = [
  {value: 'bytes', label: 'Bytes', axis: 'bytes of coefficients', get: (rig) => rig.bytes},
  {value: 'projections', label: 'Projections', axis: 'SH projections per light', get: (rig) => rig.projections},
  {value: 'fit', label: 'Fit', axis: 'fit, µs per frame', get: (rig) => rig.fit_us},
  {value: 'modelled', label: 'Modelled', axis: 'modelled ns per point', get: (rig) => rig.modelled_ns_per_point},
  {value: 'shade', label: 'Shade', axis: 'shading, ns per point', get: (rig) => rig.shade_ns_per_point},
];
const costNamed = (name) => costs.find((cost) => cost.value === name);

/** What a reader chooses once for the whole page. */
const anyNear = report.objects.some((object) => object.rigs.some((rig) => rig.near_lights > 0));
const settings = makeStore({error: 'total', cost: anyNear ? 'modelled' : 'bytes', scale: 'log'});  // bytes know nothing of near lights

/** Rigs that no other rig beats in both cost and error, cheapest first. */
function paretoRigs(rigs, costOf, errorOf) {
  const byCost = [...rigs].sort((a, b) => costOf(a) - costOf(b) || errorOf(a) - errorOf(b));
  let least = Infinity;
  return byCost.filter((rig) => {
    const better = errorOf(rig) < least;
    if (better) least = errorOf(rig);
    return better;
  });
}

const currentPareto = (rigs, {cost, error}) => paretoRigs(rigs, costNamed(cost).get, (rig) => rig[error].rms);

/** The frames of an object that have pictures, in the order of time; pixels.js unpacks them. */
const pictureFrames = (objectIndex) => embedded.objects[objectIndex] ?? [];

/** The entry of `rows` whose time is nearest. */
function nearestIndex(rows, time) {
  let best = 0;
  rows.forEach((row, i) => {
    if (Math.abs(row.time - time) < Math.abs(rows[best].time - time)) best = i;
  });
  return best;
}

const sceneOf = (object) => report.scenes[object.scene_index];
/** In full, or with the file's name alone. */
const sceneTitle = (scene, short) => [short ? scene.scene.split('/').pop() : scene.scene, scene.clip && `clip ${scene.clip}`, scene.lights_from && `lights of ${scene.lights_from}`]
  .filter(Boolean).join(', ');
