// Puts the page together.

function sceneText() {
  const clip = study.clip && `clip ${study.clip}`;
  const lights = study.lights_from && `lights of ${study.lights_from}`;
  return [study.scene, clip, lights].filter(Boolean).join(', ');
}

function overview() {
  const objects = study.objects;
  const machine = `${study.machine.cpu || 'unknown processor'}, ${study.machine.vector}`;
  const facts = element('p', {class: 'facts'});
  settings.watch(({object}) => {
    const {name, triangles, samples, lights, points} = objects[object];
    facts.textContent = [name, plural(triangles, 'triangle'), plural(lights, 'light'), plural(points.length, 'measured point'), `${plural(samples, 'surface sample')} in ${plural(study.frames.length, 'frame')}`, machine].join(' · ');
  });
  return element('div', {}, element('h1', {}, 'What accuracy costs in time'), element('p', {class: 'subtitle'}, sceneText()), facts);
}

function chartCard() {
  const spatialHint = element('p', {class: 'hint', hidden: true}, 'Spatial errors of different numbers of bands are errors against different things: compare them within one.');
  settings.watch(({error, bands}) => { spatialHint.hidden = !(error.startsWith('spatial') && bands.length > 1); });
  return element('section', {class: 'card', id: 'chart'}, objectChoice(), axisControls(), familyLegend(),
    element('div', {class: 'with-detail'}, chart(), detail()),
    element('p', {class: 'hint'}, 'Down and to the left is better. The dashed line is the front: nothing shown beats the points on it in both. Shapes say how many lights are evaluated exactly at every point. Point at a mark, or go from mark to mark with the arrow keys (up and down: along the front); a click or Enter keeps it.'),
    spatialHint, filterControls());
}

/** How far `auto` is from the front, by what it aims at. */
function autoCard() {
  const place = element('div');
  settings.watch(({object}) => {
    if (place.dataset.object === String(object)) return;
    place.dataset.object = object;
    const {points, auto} = study.objects[object];
    const rows = auto.map(({point, distances}) => ({point: points[point], distances})).filter(({point}) => point.near === 'auto');
    place.replaceChildren();
    if (!rows.length) return;
    const cell = (distances, cost, error) => {
      const found = distances.find((d) => d.cost === cost && d.error === error);
      if (!found) return element('td', {}, '–');
      const ratios = [found.cost_ratio, found.error_ratio].map((ratio) => ratio ?? Infinity);
      const nearest = Math.min(...ratios);
      const text = nearest <= 1.0005 ? 'on the front' : Number.isFinite(nearest) ? `${percent(nearest - 1)} ${ratios[0] <= ratios[1] ? 'dearer' : 'worse'}` : 'no error left to others';
      return element('td', {class: nearest > 1.1 ? 'beyond' : null}, text);
    };
    const table = element('table', {}, element('thead', {}, element('tr', {}, element('th', {scope: 'col', class: 'name'}, 'Rig and target'), element('th', {scope: 'col'}, 'of the error aimed at'),
      ...['Cost model', 'Shading, CPU', 'Frame'].map((title) => element('th', {scope: 'col'}, title)))),
    element('tbody', {}, ...rows.map(({point, distances}) => {
      const error = point.target.startsWith('--total') ? 'total_rms' : 'spatial_rms';
      return element('tr', {}, element('th', {scope: 'row', class: 'name'}, element('code', {}, `${point.spec} ${point.target}`)), element('td', {}, percent(point[error])),
        cell(distances, 'modelled_ns_per_point', error), cell(distances, 'shade_ns_per_point', error), cell(distances, 'frame_us', error));
    })));
    place.replaceChildren(element('section', {class: 'card', id: 'auto'}, element('h2', {}, 'How far auto is from the front'),
      element('p', {class: 'hint'}, 'The least change of either cost or error that would take it there, among everything measured in the same bands. `auto` weighs by the cost model, which knows neither its own fit nor a clock.'),
      element('div', {class: 'scroller', tabindex: '0', role: 'region', 'aria-label': 'How far auto is from the front'}, table)));
  });
  return place;
}

function meaning() {
  const terms = [
    ['Total error', 'Rig and near lights against exact irradiance, over the mean light of all points and frames: what is seen. RMS over everything, or the largest.'],
    ['Spatial error', 'The rig against SH of the same bands projected at every point: what the rig itself adds.'],
    ['± behind an error', `Its standard error for want of the frames between the ${study.frames.length} looked at. A largest error is the largest of these frames.`],
    ['Fit', `Pose, bounds, choice of near lights, projection and fit of one object. One thread, the least of ${study.repetitions} interleaved repetitions, mean of ${study.timed_frames.length} frames, data in the caches.`],
    ['Shading', 'One point with rig and near lights, by scalar code on one thread; on the GPU net of reading points and writing results, near lights measured beside one rig and added to the others.'],
    ['Near lights', 'Evaluated exactly at every point instead of entering the rig. Auto: as many as the target asks for. Cheap and corrector are other forms of near_light.h.'],
  ];
  return element('section', {class: 'card', id: 'meaning'}, element('h2', {}, 'What the figures mean'), element('dl', {class: 'terms'}, ...terms.map(([term, text]) => element('div', {}, element('dt', {}, term), element('dd', {}, text)))),
    ...(study.notes.length ? [element('h3', {}, 'Notes'), element('ul', {class: 'notes'}, ...study.notes.map((note) => element('li', {}, note)))] : []));
}

function colophon() {
  return element('footer', {}, `Rigel ${study.version}. Times were taken on ${study.machine.cpu || 'an unknown processor'} (${study.machine.vector}, ${plural(study.machine.threads, 'hardware thread')})${study.gpu ? ` and ${study.gpu}` : ''}; read them beside each other, not beside those of another machine. Made in ${Math.round(study.seconds)} s by`,
    element('code', {}, study.command));
}

setUpTheme();
document.title = `What accuracy costs: ${study.scene}`;
const sections = [overview(), chartCard(), pointTable(), autoCard(), meaning(), colophon()];
document.getElementById('content').replaceChildren(...sections);
for (const [id, label] of [['chart', 'Chart'], ['table', 'Table'], ['auto', 'auto'], ['meaning', 'Meaning']]) {
  if (document.getElementById(id)) document.getElementById('nav').append(element('a', {href: `#${id}`}, label));
}
