// Pictures: rig and truth under a wipe, alternating or side by side, what is wrong in false colours, and the numbers under the
// cursor. All of it is drawn from the numbers of pixels.js.


const compareModes = [
  {value: 'wipe', label: 'Wipe', title: 'Rig left of a divider, truth right of it'},
  {value: 'flicker', label: 'Flicker', title: 'Rig and truth in turn'},
  {value: 'side', label: 'Side by side'},
];
const pictureKinds = [
  {value: 'shaded', label: 'Shaded', title: 'As the camera sees it'},
  {value: 'clay', label: 'Clay', title: 'The light alone, on grey'},
  {value: 'false', label: 'False colour', title: 'Irradiance by colours'},
];
const errorPictures = [
  {value: 'signed', label: 'Signed', title: 'Luminance: orange where the rig is too bright, blue where it is too dark'},
  {value: 'absolute', label: 'Absolute', title: 'Root mean square over the three channels'},
  {value: 'flip', label: 'FLIP', title: 'How large the difference looks when the two pictures alternate, 0 to 1, at this exposure (Andersson and others 2020)'},
];
const errorUnits = [{value: 'relative', label: '% of mean', title: 'Of the mean irradiance of the truth, over the object and all frames'}, {value: 'absolute', label: 'W/m²'}];
/** Tops of the scale of errors, relative: 1, 2, 5 in each decade. */
const errorTops = [-3, -2, -1, 0, 1].flatMap((exponent) => [1, 2, 5].map((step) => Number((step * 10 ** exponent).toPrecision(1))));

/** `store` holds {rig, frame} of the object; frames as pictureFrames() gives them. */
function gallery(object, frames, store) {
  if (!canUnpack) {
    return element('div', {class: 'card gallery'}, element('h3', {}, 'Pictures'),
      element('p', {class: 'hint'}, 'This browser cannot unpack the pictures (it has no DecompressionStream). They are in the folder images beside this page.'));
  }
  const index = report.objects.indexOf(object);
  const look = makeStore({mode: 'wipe', picture: 'shaded', error: 'signed', unit: 'relative', stops: 0, top: errorTops.findIndex((top) => top >= Math.max(...frames.map((frame) => frame.heat_scale)) * 0.999)});
  const rigOf = (spec) => Math.max(0, object.rigs.findIndex((rig) => rig.spec === spec));
  const exposureOf = (frame) => frame.exposure * 2 ** look.get().stops;

  let visible = false;  // nothing is unpacked before it is near the window
  let shown = null;  // {frame, rig, numbers, irradiance}: what the panes show
  const values = valueTable(object);
  const panes = makePanes({size: () => shown?.numbers ?? {width: 4, height: 3}, onPoint: (point) => values.show(shown, point)});
  const compare = panes.add('Rig and truth');
  const second = panes.add('Truth');
  const wrong = panes.add('Error of the rig');
  const errorScale = colorScale();
  const irradianceScale = colorScale();
  const figures = element('dl', {class: 'figures'});
  const sheet = contactSheet(object, store, {picture: paint, paintError});

  /** Canvas of the truth (rig -1) or of a rig. */
  function paint(frame, rig, numbers, irradiance) {
    const {picture, stops} = look.get();
    return drawnOnce([index, frame.frame, rig, picture, stops].join(), () => (picture === 'false'
      ? irradianceColors(numbers, irradiance, irradianceTop()) : shadedPicture(numbers, irradiance, exposureOf(frame), picture === 'clay')));
  }
  function paintError(frame, rig, numbers, irradiance) {
    const {error, top} = look.get();
    if (error === 'flip') return paintFlip(frame, rig, numbers, irradiance);
    const draw = error === 'signed' ? signedErrorColors : absoluteErrorColors;
    return drawnOnce([index, frame.frame, rig, error, top].join(), () => draw(numbers, irradiance, errorTops[top] * object.mean_irradiance));
  }
  /** Of the pictures as they are shown: shaded, or as clay. Smaller ones are taken to be seen from as much further away. */
  function paintFlip(frame, rig, numbers, irradiance) {
    const {picture, stops, top} = look.get();
    const clay = picture === 'clay';
    return drawnOnce([index, frame.frame, rig, 'flip', clay, stops, top].join(), () => {
      const pixelsPerDegree = kPixelsPerDegree * numbers.width / Math.max(...frames.map(({width}) => width));
      const seen = (planes) => seenPicture(shadedPicture(numbers, planes, exposureOf(frame), clay), pixelsPerDegree);
      const truth = seenTruth(numbers, [clay, stops].join(), () => seen(numbers.truth));
      const errors = flipErrors(truth, seen(irradiance));
      const image = wholePicture(numbers, heatTable, errors, errorTops[top]);
      return Object.assign(image, {mean: meanOnObject(numbers, errors)});
    });
  }
  /** Of the false colours of irradiance: what the truth exceeds at one pixel in a hundred of the frame shown first. */
  let usualTop = 1;
  const irradianceTop = () => usualTop * 2 ** -look.get().stops;

  // Later requests overtake earlier ones whose numbers are not there yet.
  let wanted = 0;
  async function show() {
    const request = ++wanted;
    const {rig: spec, frame: at} = store.get();
    const frame = frames[at];
    const rig = rigOf(spec);
    const [numbers, irradiance] = await Promise.all([frameNumbers(frame), irradianceOf(frame, rig)]);
    if (request !== wanted) return;
    if (!shown) {
      usualTop = roundTop(numbers.truth);
      look.set({});
    }
    shown = {frame, rig, numbers, irradiance};
    draw();
    if (!player.isPlaying()) sheet.show(frame, rig);
  }
  function draw() {
    if (!shown) return;
    const {frame, rig, numbers, irradiance} = shown;
    const {mode, error} = look.get();
    const {spec} = object.rigs[rig];
    const truth = {source: paint(frame, -1, numbers, numbers.truth), tag: 'truth'};
    const own = {source: paint(frame, rig, numbers, irradiance), tag: spec};
    beside.hidden = mode !== 'side';
    compare.show(mode === 'wipe' ? {...truth, over: own.source, overTag: spec} : mode === 'flicker' && flicker.showsTruth() ? truth : own);
    if (mode === 'side') second.show(truth);
    const source = paintError(frame, rig, numbers, irradiance);
    wrong.show({source, tag: {signed: 'rig − truth', absolute: '|rig − truth|', flip: `FLIP, mean ${source.mean?.toFixed(3)}`}[error]});
    viewer.dataset.mode = mode;
    values.show(shown, panes.point());
  }

  const player = makePlayer(frames, {
    ready: (i) => Promise.all([frameNumbers(frames[i]), irradianceOf(frames[i], rigOf(store.get().rig))]),
    onFrame: (frame) => store.set({frame, cursor: nearestIndex(object.truth, frames[frame].time)}),
  });
  const flicker = makeFlicker(draw);
  const wipeRange = element('input', {type: 'range', min: 0, max: 100, step: 1, value: 50, 'aria-label': 'Wipe: how much of the picture shows the rig', on: {input: () => compare.placeWipe(wipeRange.value / 100)}});
  compare.watchWipe((share) => {
    wipeRange.value = Math.round(100 * share);
    wipeRange.setAttribute('aria-valuetext', `${Math.round(100 * share)} per cent rig`);
  });

  const rigChoice = choice('Rig', object.rigs.map(({spec}) => ({value: spec, label: spec, color: colorOf(spec)})), (rig) => store.set({rig}));
  const modes = choice('Compare', compareModes, (mode) => look.set({mode}));
  const kinds = choice('Picture', pictureKinds, (picture) => look.set({picture}));
  const errors = choice('Error', errorPictures, (error) => look.set({error}));
  const units = choice('Unit', errorUnits, (unit) => look.set({unit}));
  const exposure = knob('Exposure', {min: -6, max: 6, step: 0.25, value: 0}, (stops) => look.set({stops}), (stops) => `${stops > 0 ? '+' : stops < 0 ? '−' : '±'}${Math.abs(stops).toFixed(2)} EV`);
  const top = knob('Scale', {min: 0, max: errorTops.length - 1, step: 1, value: look.get().top}, (value) => look.set({top: value}), (value) => errorText(errorTops[value]));
  const errorText = (relative) => (look.get().error === 'flip' ? tickLabel(relative) : look.get().unit === 'relative' ? `${tickLabel(100 * relative)}\u00a0%` : `${figure(relative * object.mean_irradiance)}\u00a0W/m²`);

  const beside = element('figure', {class: 'second', hidden: true}, second.node);
  const viewer = element('div', {class: 'viewer'},
    element('figure', {class: 'compare'}, compare.node, element('div', {class: 'under'}, wipeRange, flicker.node, irradianceScale.node)),
    beside,
    element('figure', {class: 'wrong'}, wrong.node, element('div', {class: 'under'}, errorScale.node)));

  look.watch(({mode, picture, error, unit, stops, top: at}) => {
    modes.show(mode);
    kinds.show(picture);
    errors.show(error);
    units.show(unit);
    units.node.hidden = error === 'flip';
    exposure.show(stops);
    top.show(at);
    wipeRange.hidden = mode !== 'wipe';
    flicker.run(mode === 'flicker');
    irradianceScale.node.hidden = picture !== 'false';
    irradianceScale.show(heatColors, [0, 0.25, 0.5, 0.75, 1].map((share) => (share === 1 ? '≥\u00a0' : '') + (share ? `${tickLabel(share * irradianceTop())}${share === 1 ? '\u00a0W/m²' : ''}` : '0')));
    const largest = errorTops[at];
    const steps = error === 'signed' ? [-1, -0.5, 0, 0.5, 1] : [0, 0.25, 0.5, 0.75, 1];
    errorScale.show(error === 'signed' ? signedColors : heatColors, steps.map((share) => (share === -1 ? '≤\u00a0−' : share === 1 ? '≥\u00a0' : share < 0 ? '−' : '') + (share ? errorText(Math.abs(share) * largest) : '0')));
    draw();
    if (shown) sheet.show(shown.frame, shown.rig);
  });
  store.watch(({rig, frame}) => {
    rigChoice.show(object.rigs[rigOf(rig)].spec);
    player.show(frame);
    figures.replaceChildren(...pictureFigures(object, frames[frame], rigOf(rig)));
    if (visible) show();
  }, 'rig', 'frame');
  const node = element('div', {class: 'card gallery'},
    element('div', {class: 'bar'}, element('h3', {}, 'Pictures'), rigChoice.node),
    element('div', {class: 'tools'}, toolGroup(modes.node, kinds.node, exposure.node), toolGroup(errors.node, units.node, top.node), panes.controls),
    viewer, frames.length > 1 ? player.node : null,
    element('p', {class: 'hint'}, 'Wheel, pinch, + and − zoom all pictures alike; drag moves them. Point or tap to read a pixel; arrow keys go on from there.'),
    element('div', {class: 'readings'}, values.node, figures), sheet.node);
  new IntersectionObserver((entries) => {
    const now = entries[entries.length - 1].isIntersecting;
    if (now && !visible) {
      visible = true;
      show();
    } else if (!now && visible) {
      visible = false;
      player.stop();
    }
  }, {rootMargin: '400px'}).observe(node);
  return node;
}

const toolGroup = (...tools) => element('div', {class: 'tool-group'}, ...tools);

/** The luminance that one pixel in a hundred exceeds, rounded up. */
function roundTop(planes) {
  const sorted = planes[0].map((_, i) => luminanceAt(planes, i)).sort();
  const value = sorted[Math.floor(0.99 * (sorted.length - 1))];
  if (!(value > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 1.5, 2, 3, 4, 6, 8, 10].map((step) => step * power).find((top) => top >= value * (1 - 1e-6));
}

const meanOnObject = ({share}, values) => {
  let [sum, count] = [0, 0];
  values.forEach((value, i) => {
    if (!share[i]) return;
    sum += value;
    ++count;
  });
  return count ? sum / count : 0;
};

/** A named slider with its value in words; a double click takes it back to where it began. */
function knob(name, {value, ...range}, onChange, text) {
  const input = element('input', {type: 'range', ...range, value, 'aria-label': name, title: 'Double click: back to the start', on: {
    input: () => onChange(Number(input.value)), dblclick: () => onChange(value),
  }});
  const output = element('output', {});
  return {
    node: element('label', {class: 'knob'}, element('span', {class: 'choice-label'}, name), input, output),
    show(now) {
      input.value = now;
      output.textContent = text(now);
      input.setAttribute('aria-valuetext', output.textContent);
    },
  };
}

function pictureFigures(object, frame, rigIndex) {
  const rig = object.rigs[rigIndex];
  const entries = [['This picture, RMS', percent(frame.rigs[rigIndex].rms)]];
  const {flip} = object.pictures.find((picture) => picture.frame === frame.frame && picture.label === rig.spec) ?? {};
  if (flip !== undefined) entries.push(['This picture, FLIP', flip.toFixed(3)]);
  if (rig.frames.length) {
    const measured = rig.frames[nearestIndex(rig.frames, frame.time)];
    entries.push(['This frame, spatial RMS', percent(measured.spatial_rms)], ['This frame, total RMS', percent(measured.total_rms)]);
  }
  entries.push(['All frames, spatial RMS', percent(rig.spatial.rms)], ['All frames, total RMS', percent(rig.total.rms)], ['All frames, total max', percent(rig.total.max)]);
  return entries.map(([term, value]) => element('div', {}, element('dt', {}, term), element('dd', {}, value)));
}
