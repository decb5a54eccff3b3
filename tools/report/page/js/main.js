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
  const parts = [];
  if (frames.length) parts.push(gallery(object, frames, store));
  const view3d = view3dCard(object, index, store);
  if (view3d) parts.push(view3d);
  if (object.rigs.length) {
    parts.push(rigTable(object, store));
    const charts = element('div', {class: 'charts'});
    if (object.truth.length > 1) charts.append(timeChart(object, frames, store));
    if (object.rigs.length > 1) charts.append(costChart(object, store));
    parts.push(charts);
    parts.push(...errorBreakdown(object, store));
    if (object.rigs.some((rig) => rig.lights.length)) parts.push(lightTable(object, store));
  }
  section.append(objectBar(object, index, parts), element('p', {class: 'facts'}, facts), ...(object.verdict ? [verdictSentence(object)] : []), ...parts);
  return section;
}

setUpTheme();
document.title = `Rigel report: ${[...new Set(report.objects.map((object) => object.name))].join(', ')}`;
document.getElementById('content').replaceChildren(summary(), ...comparisons(), ...report.objects.map(objectSection), ...report.scenes.filter((scene) => scene.disks).map(diskSection), ...report.scenes.map(sceneNotes), meaning(), colophon());
fillNavigation();
if (location.hash) document.getElementById(location.hash.slice(1))?.scrollIntoView();
