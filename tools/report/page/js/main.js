// Puts the page together.

/**
 * All views of an object share its store: `rig` is the spec chosen; `frame` the pictured frame shown (an index into `frames`); `cursor`
 * the moment that all views over time point at (an index into object.truth), null while there is none.
 */
function objectSection(object, index) {
  const frames = pictureFrames(index);
  const store = makeStore({rig: object.verdict?.spec ?? null, frame: 0, cursor: null});
  const section = element('section', {class: 'object', id: `object-${index}`}, element('h2', {}, object.name),
    element('p', {class: 'facts'}, [sceneTitle(sceneOf(object)), plural(object.triangles, 'triangle'), plural(object.samples, 'surface sample'),
      plural(sceneOf(object).frames, 'frame'), `mean irradiance ${figure(object.mean_irradiance)} W/m²`].join(' · ')));
  if (object.verdict && report.objects.length > 1) section.append(verdictSentence(object));
  if (frames.length) section.append(gallery(object, frames, store));
  if (!object.rigs.length) return section;
  section.append(rigTable(object, store));
  const charts = element('div', {class: 'charts'});
  if (object.truth.length > 1) charts.append(timeChart(object, frames, store));
  if (object.rigs.length > 1) charts.append(costChart(object, store));
  section.append(charts);
  if (object.rigs.some((rig) => rig.lights.length)) section.append(lightTable(object, store));
  return section;
}

setUpTheme();
document.title = `Rigel report: ${[...new Set(report.objects.map((object) => object.name))].join(', ')}`;
fillNavigation();
document.getElementById('content').replaceChildren(overview(), ...report.objects.map(objectSection), ...report.scenes.filter((scene) => scene.disks).map(diskSection), ...report.scenes.map(sceneNotes), meaning(), colophon());
if (location.hash) document.getElementById(location.hash.slice(1))?.scrollIntoView();
