// Puts the page together.

/**
 * All views of an object share its store: `rig` is the spec chosen; `frame` the pictured frame shown (an index into `frames`); `cursor`
 * the moment that all views over time point at (an index into object.truth), null while there is none.
 */
function objectSection(object, index) {
  const frames = pictureFrames(index);
  const store = makeStore({rig: object.verdict?.spec ?? null, frame: Math.max(0, frames.findIndex(({exact}) => exact)), cursor: null});
  const section = element('section', {class: 'object', id: `object-${index}`, 'aria-labelledby': `object-${index}-name`});
  const facts = [sceneTitle(sceneOf(object)), plural(object.triangles, 'triangle'), plural(object.samples, 'surface sample'),
    plural(sceneOf(object).frames, 'frame'), `mean irradiance ${figure(object.mean_irradiance)} W/m²`].join(' · ');
  const row = (name, ...cards) => (cards.some(Boolean) ? element('div', {class: `charts ${name}`}, ...cards) : null);
  const some = object.rigs.length > 0;
  const moving = object.truth.length > 1;
  const parts = [
    frames.length ? gallery(object, frames, store) : null,
    some ? rigTable(object, store) : null,
    row('cost-and-causes', object.rigs.length > 1 ? costChart(object, store) : null, errorParts(object, store)),
    some && moving ? timeChart(object, frames, store) : null,
    row('halves', bodyPartErrors(object, store), errorHistogram(object, store)),
    view3dCard(object, index, store),
    object.rigs.some((rig) => rig.lights.length) ? lightTable(object, store) : null,
  ].filter(Boolean);
  section.append(objectBar(object, index, parts), element('p', {class: 'facts'}, facts), ...(object.verdict ? [verdictSentence(object)] : []), ...parts);
  return section;
}

setUpTheme();
document.title = `Rigel report: ${[...new Set(report.objects.map((object) => object.name))].join(', ')}`;
document.getElementById('content').replaceChildren(summary(), ...comparisons(), ...report.objects.map(objectSection), ...report.scenes.filter((scene) => scene.disks).map(diskSection), ...report.scenes.map(sceneNotes), meaning(), colophon());
fillNavigation();
if (location.hash) document.getElementById(location.hash.slice(1))?.scrollIntoView();
