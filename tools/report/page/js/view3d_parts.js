// The controls round a 3-D view: its legend, what it shows, time and playback, and what is said under the pointer.

/** Buttons that turn parts of the view on and off; `shown` is a set of their values. */
function viewParts(shown, onChange) {
  const buttons = kViewParts.map(({value, label, title}) => element('button', {type: 'button', 'aria-pressed': 'true', title, on: {click: (event) => {
    if (!shown.delete(value)) shown.add(value);
    event.currentTarget.setAttribute('aria-pressed', String(shown.has(value)));
    onChange();
  }}}, label));
  return {node: element('div', {class: 'choice', role: 'group', 'aria-label': 'Parts shown'}, element('span', {class: 'choice-label', 'aria-hidden': 'true'}, 'Show'),
    element('div', {class: 'segments'}, ...buttons))};
}

/** The scale of colours, and buttons for a finer and a coarser one. */
function viewLegend(onStep) {
  const ramp = element('div', {class: 'ramp', 'aria-hidden': 'true'});
  const ticks = element('div', {class: 'ticks'});
  const caption = element('p', {class: 'choice-label'});
  const finer = element('button', {type: 'button', class: 'quiet', 'aria-label': 'Finer scale', title: 'Finer scale', on: {click: () => onStep(-1)}}, '−');
  const coarser = element('button', {type: 'button', class: 'quiet', 'aria-label': 'Coarser scale', title: 'Coarser scale', on: {click: () => onStep(1)}}, '+');
  const bar = element('div', {class: 'view3d-ramp'}, finer, element('div', {class: 'scale'}, ramp, ticks), coarser);
  return {
    node: element('div', {class: 'view3d-legend'}, caption, bar),
    show(surface, scale) {
      bar.hidden = !isError(surface);
      caption.textContent = {
        absolute: 'Error, % of the mean irradiance: RMS over colour', signed: 'Rig − truth, % of the mean irradiance: mean over colour',
        rig: 'Irradiance by rig and near lights, on white', truth: 'Exact irradiance, on white',
      }[surface];
      if (bar.hidden) return;
      const colors = surface === 'signed' ? kSignedColors : embedded.colors;
      ramp.style.background = `linear-gradient(to right, ${colors.join(', ')})`;
      const shares = surface === 'signed' ? [-1, -0.5, 0, 0.5, 1] : [0, 0.25, 0.5, 0.75, 1];
      ticks.replaceChildren(...shares.map((share) => {
        const size = tickLabel(100 * Math.abs(share) * scale);
        const sign = share < 0 ? '−' : share > 0 && surface === 'signed' ? '+' : '';
        return element('span', {}, share === 0 ? '0' : `${share === 1 ? '≥ ' : share === -1 ? '≤ ' : ''}${sign}${size}\u00a0%`);
      }));
    },
  };
}

/** Slider over the view's moments and playback at the speed of the clip. */
function timeControls(object, moments, onMove) {
  const last = moments.length - 1;
  const slider = element('input', {type: 'range', min: 0, max: last, step: 1, value: 0, 'aria-label': 'Frame of the 3-D view'});
  const label = element('span', {class: 'view3d-time'});
  const play = element('button', {type: 'button', class: 'quiet'});
  let timer = null;
  const at = (moment) => object.truth[moments[moment]].time;
  function stop() {
    clearTimeout(timer);
    timer = null;
    play.textContent = 'Play';
  }
  /** The next moment after as long as it is away; from the last on to the first. */
  function advance() {
    const moment = Number(slider.value);
    const next = moment === last ? 0 : moment + 1;
    const pause = moment === last ? at(1) - at(0) : at(next) - at(moment);
    timer = setTimeout(() => {
      onMove(next);
      if (slider.isConnected && timer !== null) advance();
    }, 1000 * Math.max(0.04, pause));
  }
  function toggle() {
    if (last === 0) return;
    if (timer !== null) return stop();
    advance();
    play.textContent = 'Pause';
  }
  play.addEventListener('click', toggle);
  slider.addEventListener('input', () => {
    stop();
    onMove(Number(slider.value));
  });
  document.addEventListener('visibilitychange', stop);
  stop();
  return {
    node: element('div', {class: 'view3d-play', hidden: last === 0}, play, slider, label),
    toggle,
    show(moment) {
      slider.value = moment;
      label.textContent = `${seconds(at(moment))} · frame ${Math.round(at(moment) * report.rate)}`;
      slider.setAttribute('aria-valuetext', `${seconds(at(moment))}, ${moment + 1} of ${moments.length}`);
    },
  };
}

/** Calls `lines(hit)` for what is under the pointer and shows them beside it. A finger: where it taps. */
function followPointer(canvas, readout, live, lines) {
  let pending = 0;
  const look = (event) => {
    pending = 0;
    const view = live();
    if (!view || event.buttons) return;
    const box = canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(2 * x / box.width - 1, 1 - 2 * y / box.height), view.stage.camera);
    const surface = view.surface.at(ray);
    const light = view.lights.node.visible ? view.lights.at(ray) : null;
    const hit = light && (!surface || light.distance < surface.distance) ? light : surface;
    readout.hidden = !hit;
    if (!hit) return;
    readout.replaceChildren(...lines(hit));
    readout.style.left = `${x}px`;
    readout.style.top = `${y + 12}px`;
    readout.classList.toggle('flip', x > box.width / 2);
  };
  canvas.addEventListener('pointermove', (event) => { pending ||= requestAnimationFrame(() => look(event)); });
  canvas.addEventListener('pointerup', (event) => { if (event.pointerType === 'touch') requestAnimationFrame(() => look(event)); });
  canvas.addEventListener('pointerdown', () => { readout.hidden = true; });
  canvas.addEventListener('pointerleave', (event) => { if (event.pointerType !== 'touch') readout.hidden = true; });
}

function hoverLines(hit, rig) {
  const line = (name, value) => element('div', {class: 'entry'}, element('span', {}, name), element('b', {}, value));
  if (hit.light) {
    const {row, index, near, culled} = hit.light;
    const role = culled ? 'culled' : near === 1 ? 'near' : near > 0 ? `near ${Math.round(100 * near)} %` : 'far: in the rig';
    return [element('div', {class: 'when'}, row.name), line(row.type, role), element('p', {class: 'where'}, row.summary), element('p', {class: 'where'}, rig.lights[index]?.why ?? '')];
  }
  const sign = hit.signed < 0 ? '−' : '+';
  return [element('div', {class: 'when'}, rig.spec), line('error, RMS over colour', percent(hit.absolute)), line('rig − truth, mean', `${sign}${percent(Math.abs(hit.signed))}`),
    line('exact irradiance', `${figure(hit.truth)} W/m²`)];
}

const kLabels = 6;
const kLabelSize = [90, 15];  // what a label keeps free of others, in pixels

/** Names beside the lights that are near, as far as they are in the picture and have room. */
function placeLabels(node, camera, lights) {
  const [width, height] = [node.clientWidth, node.clientHeight];
  const taken = [];
  const named = lights.filter((light) => light.near > 0).sort((a, b) => b.near - a.near).flatMap((light) => {
    const place = light.node.position.clone().project(camera);
    const [x, y] = [(0.5 + place.x / 2) * width, (0.5 - place.y / 2) * height];
    const seen = place.z < 1 && Math.abs(place.x) < 0.98 && Math.abs(place.y) < 0.96;
    if (!seen || taken.length === kLabels || taken.some((other) => Math.abs(other[0] - x) < kLabelSize[0] && Math.abs(other[1] - y) < kLabelSize[1])) return [];
    taken.push([x, y]);
    return [{name: light.row.name, x, y, aside: light.pixels + 5, flip: x > 0.8 * width}];
  });
  while (node.children.length > named.length) node.lastChild.remove();
  while (node.children.length < named.length) node.append(element('span'));
  named.forEach(({name, x, y, aside, flip}, i) => {
    const label = node.children[i];
    if (label.textContent !== name) label.textContent = name;
    label.style.transform = `translate(${Math.round(x + (flip ? -aside : aside))}px, ${Math.round(y)}px)${flip ? ' translateX(-100%)' : ''}`;
  });
}
