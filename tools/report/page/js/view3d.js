// The 3-D view of an object: the card with its controls. What it draws is in view3d_stage, view3d_surface and view3d_lights.

const kLiveViews = 2;  // browsers keep few WebGL contexts, for all pages together
const liveViews = [];
const kViewParts = [
  {value: 'box', label: 'Box', title: 'The rig’s box in this frame'},
  {value: 'samples', label: 'Samples', title: 'Where the rig projects light'},
  {value: 'lights', label: 'Lights', title: 'A ring marks lights that are evaluated apart from the rig, in full or in part'},
];

/** The card, or null where the report holds no view of the object. */
function view3dCard(object, index, store) {
  const packed = views3d?.objects[index];
  const scene = views3d?.scenes[object.scene_index];
  if (!scene || !object.rigs.length) return null;
  if (!packed) return element('p', {class: 'hint'}, 'No 3-D view: the report has room for the objects whose rigs are most wrong.');
  const moments = packed.frames.map((frame) => scene.frames[frame]);  // indices into object.truth
  const state = {surface: 'absolute', scale: null, moment: 0, parts: new Set(kViewParts.map(({value}) => value)), rig: 0};

  const message = element('p', {class: 'view3d-message'}, 'Unpacking…');
  const readout = element('div', {class: 'readout view3d-readout', hidden: true});
  const labels = element('div', {class: 'view3d-labels', 'aria-hidden': 'true'});
  const spoken = element('p', {class: 'unseen', 'aria-live': 'polite'});
  const surfaces = choice('Surface', kSurfaces, (surface) => change({surface}));
  const rigs = choice('Rig', object.rigs.map(({spec}) => ({value: spec, label: spec, color: colorOf(spec)})), (rig) => store.set({rig}));
  const parts = viewParts(state.parts, () => change({}));
  const legend = viewLegend((steps) => change({scale: roundScale(state.scale, steps)}));
  const time = timeControls(object, moments, (moment) => {
    store.set({cursor: moments[moment]});
    change({moment});
  });
  const tools = element('div', {class: 'view3d-tools'},
    element('button', {type: 'button', class: 'quiet', title: 'The object fills the view (Home)', on: {click: () => frameObject()}}, 'Object'),
    element('button', {type: 'button', class: 'quiet', title: 'Shows the lights around it too', on: {click: () => frameLights()}}, 'Lights'));
  let live = null;
  let opening = false;
  let unpacked = null;
  let canvas = freshCanvas();
  const frame = element('div', {class: 'view3d-frame'}, canvas, labels, readout, tools, message);

  function change(changes) {
    Object.assign(state, changes);
    draw();
  }

  function draw() {
    surfaces.show(state.surface);
    time.show(state.moment);
    if (!live) return;
    const {view, stage, surface, lights} = live;
    state.scale ??= errorScale(view.rigs[state.rig]);
    legend.show(state.surface, state.scale);
    surface.show(state.moment, state.rig, state.surface, state.scale);
    surface.box.visible = state.parts.has('box');
    surface.dots.visible = state.parts.has('samples');
    lights.node.visible = state.parts.has('lights');
    const {middle, bottom} = worldMiddle(view, state.moment);
    stage.follow(middle, bottom);
    lights.show(state.moment, view.frames[state.moment], state.rig, middle);
    readout.hidden = true;
    canvas.setAttribute('aria-label', describe());
    stage.redraw();
  }

  /** A canvas whose context was given up gets no other. */
  function freshCanvas() {
    const node = element('canvas', {tabindex: '0', role: 'img', class: 'view3d-canvas', 'aria-label': `3-D view of ${object.name}`});
    followPointer(node, readout, () => live, (hit) => hoverLines(hit, object.rigs[state.rig]));
    node.addEventListener('keydown', (event) => {
      if (!live || event.ctrlKey || event.metaKey || event.altKey) return;
      const act = {ArrowLeft: () => live.stage.orbit(-kOrbitStep, 0), ArrowRight: () => live.stage.orbit(kOrbitStep, 0),
        ArrowUp: () => live.stage.orbit(0, kOrbitStep), ArrowDown: () => live.stage.orbit(0, -kOrbitStep), '+': () => live.stage.zoom(1 / kDollyStep),
        '=': () => live.stage.zoom(1 / kDollyStep), '-': () => live.stage.zoom(kDollyStep), Home: frameObject, ' ': () => time.toggle()}[event.key];
      if (!act) return;
      event.preventDefault();
      act();
    });
    return node;
  }

  const frameObject = () => live?.stage.reset(boxCorners(live.view, state.moment));
  const frameLights = () => live?.stage.reset([...boxCorners(live.view, state.moment), ...live.lights.places(live.radius)]);

  /** What is to be seen, in words. */
  function describe() {
    const rig = object.rigs[state.rig];
    const figures = rig.frames[moments[state.moment]];
    const near = live.lights.lights.filter((light) => light.near > 0);
    const what = {absolute: `size of the error of ${rig.spec}`, signed: `signed error of ${rig.spec}`, rig: `lit by ${rig.spec}`, truth: 'lit by the truth'}[state.surface];
    return `3-D view of ${object.name}: ${what}, ${seconds(object.truth[moments[state.moment]].time)}. Total RMS ${percent(figures.total_rms)}; `
      + `${plural(live.lights.lights.length, 'light')}, near: ${near.map((light) => light.row.name).join(', ') || 'none'}. Arrow keys turn it, plus and minus zoom.`;
  }

  async function open() {
    if (live || opening) return;
    opening = true;
    try {
      if (typeof DecompressionStream === 'undefined') throw new Error('This browser cannot unpack the 3-D view.');
      const context = webglContext(canvas);
      if (!context) throw new Error('This browser draws no WebGL: the 3-D view stays empty. All its figures are elsewhere on this page.');
      unpacked ??= {view: await unpackView(packed), place: await unpackPlaces(scene)};
      live = assemble(context);
      message.hidden = true;
      liveViews.push({close, frame});
      if (liveViews.length > kLiveViews) liveViews.find((other) => other.frame !== frame).close();
      paint();
      draw();
      frameObject();
    } catch (error) {
      message.hidden = false;
      message.textContent = error.message;
      for (const node of [tools, parts.node, legend.node]) node.hidden = true;
    }
    opening = false;
  }

  function assemble(context) {
    const {view, place} = unpacked;
    const radius = objectRadius(view);
    const surface = surfaceView(view, object.mean_irradiance);
    const lights = lightsView(view, scene, place, sceneOf(object).lights, radius);
    const stage = makeStage(canvas, context, radius, (camera, height) => {
      lights.fit(camera, height);
      surface.fit(camera, height, radius);
      placeLabels(labels, camera, state.parts.has('lights') ? lights.lights : []);
    });
    stage.scene.add(surface.node, lights.node);
    return {view, stage, surface, lights, radius};
  }

  function close() {
    liveViews.splice(liveViews.findIndex((other) => other.frame === frame), 1);
    live.stage.dispose();
    live = null;
    const fresh = freshCanvas();
    canvas.replaceWith(fresh);
    canvas = fresh;
    message.hidden = false;
    message.textContent = 'Closed to spare memory; opens when it is scrolled to.';
  }

  function paint() {
    if (!live) return;
    live.surface.paint(frame);
    live.lights.paint(frame);
    live.stage.paint(frame);
  }

  store.watch(({rig, cursor}) => {
    const chosen = Math.max(0, object.rigs.findIndex((candidate) => candidate.spec === rig));
    rigs.show(object.rigs[chosen].spec);
    const moment = cursor === null ? state.moment : nearestMoment(moments, cursor);
    if (chosen === state.rig && moment === state.moment && live) return;
    change({rig: chosen, moment});
    if (live) spoken.textContent = describe();
  }, 'rig', 'cursor');
  state.moment = worstMoment(object, moments, state.rig);
  time.show(state.moment);
  new IntersectionObserver((entries) => {
    if (entries.some((entry) => entry.isIntersecting)) open();
  }, {rootMargin: '200px'}).observe(frame);
  new MutationObserver(paint).observe(document.documentElement, {attributeFilter: ['data-theme']});
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', paint);
  return element('div', {class: 'card view3d'}, element('div', {class: 'bar'}, element('h3', {}, '3-D view'), surfaces.node, object.rigs.length > 1 ? rigs.node : null),
    frame, element('div', {class: 'view3d-below'}, legend.node, parts.node), time.node, spoken,
    element('p', {class: 'hint'}, viewFacts(object, packed, scene, moments)));
}

/** How much of the object and the run is drawn. */
function viewFacts(object, packed, scene, moments) {
  const of = (shown, all, noun) => (shown < all ? `${count(shown)} of ${plural(all, noun)}` : plural(all, noun));
  return [of(packed.triangles, object.triangles, 'triangle'), of(moments.length, object.truth.length, 'frame'),
    of(packed.lights, sceneOf(object).lights.length, 'light'), 'errors at its vertices, near lights settled', 'drag to turn, click then scroll to zoom'].join(' · ');
}

const nearestMoment = (moments, cursor) => moments.reduce((best, moment, i) => (Math.abs(moment - cursor) < Math.abs(moments[best] - cursor) ? i : best), 0);
const worstMoment = (object, moments, rig) => moments.reduce((worst, moment, i) =>
  (object.rigs[rig].frames[moment]?.total_rms > object.rigs[rig].frames[moments[worst]]?.total_rms ? i : worst), 0);

/** Half the diagonal of the object in its largest pose. */
function objectRadius(view) {
  return Math.max(1e-4, ...view.positions.map((points) => {
    const [lo, hi] = boundsOf(points);
    return Math.hypot(...hi.map((x, axis) => x - lo[axis])) / 2;
  }));
}

function boundsOf(points) {
  const lo = [Infinity, Infinity, Infinity];
  const hi = [-Infinity, -Infinity, -Infinity];
  points.forEach((x, i) => {
    lo[i % 3] = Math.min(lo[i % 3], x);
    hi[i % 3] = Math.max(hi[i % 3], x);
  });
  return [lo, hi];
}

/** The middle of the object's box in the world, and the height of its lowest vertex. */
function worldMiddle(view, frame) {
  const pose = view.poses[frame];
  const toWorld = (point, axis) => pose[axis] * point[0] + pose[3 + axis] * point[1] + pose[6 + axis] * point[2] + pose[9 + axis];
  const points = view.positions[frame];
  const [lo, hi] = boundsOf(points);
  const center = lo.map((x, axis) => (x + hi[axis]) / 2);
  let bottom = Infinity;
  for (let i = 0; i < points.length; i += 3) bottom = Math.min(bottom, toWorld(points.subarray(i, i + 3), 1));
  return {middle: [0, 1, 2].map((axis) => toWorld(center, axis)), bottom};
}

/** The corners of the object's box, as they lie in the world about its middle. */
function boxCorners(view, frame) {
  const [lo, hi] = boundsOf(view.positions[frame]);
  const half = hi.map((x, axis) => (x - lo[axis]) / 2);
  const pose = view.poses[frame];
  return Array.from({length: 8}, (_, i) => {
    const corner = half.map((x, axis) => (i >> axis & 1 ? x : -x));
    return [0, 1, 2].map((axis) => pose[axis] * corner[0] + pose[3 + axis] * corner[1] + pose[6 + axis] * corner[2]);
  });
}
