// All rigs in one frame, to look over and to choose from.

const kSheetColumns = 6;  // at most; rows are filled evenly

/** The truth and all rigs of a frame, small; a rig's picture chooses it. */
function contactSheet(object, store, paint) {
  const grid = element('div', {class: 'sheet'});
  const kinds = choice('Show', [{value: 'picture', label: 'Pictures'}, {value: 'paintError', label: 'Differences'}], (value) => {
    kind = value;
    draw();
  });
  let kind = 'picture';
  let frame = null;
  const count = object.rigs.length + 1;
  grid.style.setProperty('--columns', Math.ceil(count / Math.ceil(count / kSheetColumns)));
  const thumbnails = ['truth', ...object.rigs.map((rig) => rig.spec)].map((label, i) => thumbnail(label, i - 1, store));
  grid.append(...thumbnails.map(({node}) => node));

  async function draw() {
    kinds.show(kind);
    const drawn = frame;
    if (!drawn) return;
    const numbers = await frameNumbers(drawn);
    for (const {rig, canvas, error} of thumbnails) {
      const irradiance = await irradianceOf(drawn, rig);
      await new Promise((done) => setTimeout(done));  // FLIP of a full picture takes a while: others come in between
      if (drawn !== frame) return;
      const source = rig >= 0 || kind === 'picture' ? paint[kind](drawn, rig, numbers, irradiance) : paint.picture(drawn, rig, numbers, irradiance);
      Object.assign(canvas, {width: 280, height: Math.round(280 * source.height / source.width)});
      const pen = canvas.getContext('2d');
      pen.imageSmoothingQuality = 'high';
      pen.drawImage(source, 0, 0, canvas.width, canvas.height);
      const {flip} = object.pictures.find((picture) => picture.frame === drawn.frame && picture.label === object.rigs[rig]?.spec) ?? {};
      error.textContent = rig < 0 ? 'exact' : [percent(drawn.rigs[rig].rms), flip === undefined ? null : `FLIP\u00a0${flip.toFixed(3)}`].filter(Boolean).join(' · ');
    }
  }
  kinds.show(kind);
  return {
    node: element('div', {class: 'contact'}, element('div', {class: 'bar'}, element('h4', {}, 'All rigs in this frame'), kinds.node), grid),
    show(shown, chosen) {
      frame = shown;
      thumbnails.forEach(({node, rig}) => rig >= 0 && node.setAttribute('aria-pressed', String(rig === chosen)));
      draw();
    },
  };
}

function thumbnail(label, rig, store) {
  const canvas = element('canvas', {width: 280, height: 210});
  const error = element('span', {class: 'error'});
  const caption = element('span', {class: 'caption'}, element('span', {class: 'spec'}, rig < 0 ? null : swatch(colorOf(label)), label), error);
  const node = rig < 0 ? element('div', {class: 'thumbnail truth'}, canvas, caption)
    : element('button', {type: 'button', class: 'thumbnail', 'data-label': label, on: {click: () => store.set({rig: label})}}, canvas, caption);
  return {node, rig, canvas, error};
}
