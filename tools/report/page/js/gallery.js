// Pictures: rig against truth under a wipe, the difference beside it, all rigs of the frame as a contact sheet.

const kWipeStep = 2;      // per cent of the width for an arrow key
const kSheetColumns = 6;  // at most; rows are filled evenly

/** `store` holds {rig, frame} of the object; frames as pictureFrames() gives them. */
function gallery(object, frames, store) {
  const labels = [...new Set(frames.flatMap((frame) => frame.pictures.map((picture) => picture.label)))].filter((label) => label !== 'truth');
  const frameChoice = choice('Frame', frames.map((frame, i) => ({value: i, label: seconds(frame.time), title: `frame ${frame.frame}`})),
    (frame) => store.set({frame}));
  const rigChoice = choice('Rig', labels.map((label) => ({value: label, label, color: colorOf(label)})), (rig) => store.set({rig}));
  const wipe = wipeView();
  const heat = heatView();
  const figures = element('dl', {class: 'figures'});
  const sheet = contactSheet(store);
  store.watch(({rig, frame}) => {
    const {pictures, time} = frames[frame];
    const truth = pictures.find((picture) => picture.label === 'truth');
    const shown = pictures.find((picture) => picture.label === rig) ?? pictures.find((picture) => picture !== truth);
    frameChoice.show(frame);
    rigChoice.show(shown?.label);
    wipe.show(truth, shown);
    heat.show(shown);
    figures.replaceChildren(...pictureFigures(object, shown, time));
    sheet.show(frames[frame], shown?.label);
  }, 'rig', 'frame');
  return element('div', {class: 'card gallery'},
    element('div', {class: 'bar'}, element('h3', {}, 'Pictures'), frames.length > 1 ? frameChoice.node : null, rigChoice.node),
    element('div', {class: 'viewer'}, wipe.node, heat.node), figures, sheet.node);
}

function wipeView() {
  const truthImage = element('img', {alt: '', draggable: 'false'});
  const rigImage = element('img', {alt: '', draggable: 'false', class: 'over'});
  const rigTag = element('span', {class: 'tag left'});
  const truthTag = element('span', {class: 'tag right'}, 'truth');
  const stage = element('div', {class: 'stage'}, truthImage, rigImage, element('div', {class: 'divider', 'aria-hidden': 'true'}), rigTag, truthTag);
  const range = element('input', {type: 'range', min: 0, max: 100, step: 'any', value: 50, 'aria-label': 'Wipe: how much of the picture shows the rig'});
  const place = (value) => {
    const share = Math.min(100, Math.max(0, value));
    range.value = share;
    range.setAttribute('aria-valuetext', `${Math.round(share)} per cent rig`);
    stage.style.setProperty('--wipe', `${share}%`);
    rigTag.classList.toggle('hidden', share < 12);
    truthTag.classList.toggle('hidden', share > 88);
  };
  range.addEventListener('input', () => place(Number(range.value)));
  range.addEventListener('keydown', (event) => {
    const step = {ArrowLeft: -kWipeStep, ArrowDown: -kWipeStep, ArrowRight: kWipeStep, ArrowUp: kWipeStep}[event.key];
    if (step === undefined) return;
    event.preventDefault();
    place(Number(range.value) + step);
  });
  // Moves are followed on the document, so that a drag goes on outside the picture.
  stage.addEventListener('pointerdown', (down) => {
    if (down.button !== 0) return;
    const follow = (event) => {
      const box = stage.getBoundingClientRect();
      place(100 * (event.clientX - box.left) / box.width);
    };
    const stop = () => {
      document.removeEventListener('pointermove', follow);
      document.removeEventListener('pointerup', stop);
      document.removeEventListener('pointercancel', stop);
    };
    document.addEventListener('pointermove', follow);
    document.addEventListener('pointerup', stop);
    document.addEventListener('pointercancel', stop);
    follow(down);
  });
  place(50);
  return {
    node: element('figure', {class: 'wipe'}, stage, range,
      element('figcaption', {}, 'Rig on the left, truth on the right. Drag over the picture, or use the arrow keys on the slider.')),
    show(truth, rig) {
      setPicture(truthImage, truth?.image, 'exact irradiance');
      setPicture(rigImage, rig?.image, `lit by ${rig?.label}`);
      rigTag.textContent = rig?.label ?? '';
    },
  };
}

function setPicture(image, source, description) {
  image.hidden = !source;
  if (source && image.getAttribute('src') !== source) image.src = source;
  image.alt = description;
}

function heatView() {
  const image = element('img', {alt: '', draggable: 'false'});
  const tag = element('span', {class: 'tag top'}, 'difference');
  const ramp = element('div', {class: 'ramp', 'aria-hidden': 'true'});
  ramp.style.background = `linear-gradient(to right, ${embedded.colors.join(', ')})`;
  const ticks = element('div', {class: 'ticks'});
  const node = element('figure', {class: 'heat'}, element('div', {class: 'stage'}, image, tag), element('div', {class: 'scale'}, ramp, ticks),
    element('figcaption', {}, 'Difference from the truth, relative to the mean irradiance of the truth. One scale for all rigs of a frame.'));
  return {
    node,
    show(rig) {
      setPicture(image, rig?.error, `difference of ${rig?.label} from the truth`);
      // The top colour also stands for everything above it.
      ticks.replaceChildren(...(rig?.top ? [0, 0.25, 0.5, 0.75, 1] : []).map((share) => element('span', {},
        (share === 1 ? '≥ ' : '') + (share ? `${tickLabel(100 * share * rig.top)}\u00a0%` : '0'))));
    },
  };
}

function pictureFigures(object, picture, time) {
  if (!picture) return [];
  const entries = [['This picture, RMS', percent(picture.rms)]];
  const rig = object.rigs.find((candidate) => candidate.spec === picture.label);
  if (rig?.frames.length) {
    const frame = rig.frames[nearestIndex(rig.frames, time)];
    entries.push(['This frame, spatial RMS', percent(frame.spatial_rms)], ['This frame, total RMS', percent(frame.total_rms)]);
  }
  if (rig) {
    entries.push(['All frames, spatial RMS', percent(rig.spatial.rms)], ['All frames, total RMS', percent(rig.total.rms)],
      ['All frames, total max', percent(rig.total.max)]);
  }
  return entries.map(([term, value]) => element('div', {}, element('dt', {}, term), element('dd', {}, value)));
}

function contactSheet(store) {
  const kinds = [{value: 'image', label: 'Pictures'}, {value: 'error', label: 'Differences'}];
  const grid = element('div', {class: 'sheet'});
  let kind = 'image';
  let shownFrame = null;
  const kindChoice = choice('Show', kinds, (value) => {
    kind = value;
    draw(shownFrame);
    mark(store.get().rig);
  });
  function draw(frame) {
    shownFrame = frame;
    kindChoice.show(kind);
    const rows = Math.ceil(frame.pictures.length / kSheetColumns);
    grid.style.setProperty('--columns', Math.ceil(frame.pictures.length / rows));
    grid.replaceChildren(...frame.pictures.map((picture) => thumbnail(picture, kind, store)));
  }
  function mark(label) {
    for (const button of grid.querySelectorAll('button')) button.setAttribute('aria-pressed', String(button.dataset.label === label));
  }
  return {
    node: element('div', {class: 'contact'}, element('div', {class: 'bar'}, element('h4', {}, 'All rigs in this frame'), kindChoice.node), grid),
    show(frame, label) {
      if (frame !== shownFrame) draw(frame);  // else the buttons stay, and with them the focus
      mark(label);
    },
  };
}

function thumbnail(picture, kind, store) {
  const isTruth = picture.label === 'truth';
  const image = element('img', {src: (kind === 'error' && picture.error) || picture.image, alt: '', loading: 'lazy', draggable: 'false'});
  const caption = element('span', {class: 'caption'},
    element('span', {class: 'spec'}, isTruth ? null : swatch(colorOf(picture.label)), picture.label),
    element('span', {class: 'error'}, isTruth ? 'exact' : percent(picture.rms)));
  if (isTruth) return element('div', {class: 'thumbnail truth'}, image, caption);
  return element('button', {type: 'button', class: 'thumbnail', 'data-label': picture.label, on: {click: () => store.set({rig: picture.label})}},
    image, caption);
}
