// Pictures side by side under one magnifying glass: what is zoomed, moved or pointed at in one is so in all.

const kMostZoom = 32;
const kZoomStep = 1.25;
const kCrispFrom = 6;      // screen pixels a picture's pixel needs to be shown as a square
const kScrollRest = 400;   // ms after the page has scrolled in which the wheel goes on scrolling it
const kWipeReach = 22;     // pixels either side of the divider that take hold of it

let lastScroll = -Infinity;
addEventListener('scroll', () => { lastScroll = performance.now(); }, {passive: true});

/**
 * Panes share `lens`: {zoom, x, y}, x and y the shares of the picture in the middle of each, and `point`: [column, row] shares
 * pointed at, or null. onPoint() follows the pointer and the arrow keys; size() is that of the pictures in pixels.
 */
function makePanes({size, onPoint}) {
  const panes = [];
  const lens = {zoom: 1, x: 0.5, y: 0.5};
  let point = null;
  let scheduled = false;
  const level = element('output', {class: 'zoom-level'}, '1×');

  function changed() {
    const half = 0.5 / lens.zoom;
    lens.x = Math.min(1 - half, Math.max(half, lens.x));
    lens.y = Math.min(1 - half, Math.max(half, lens.y));
    level.textContent = `${Number(lens.zoom.toPrecision(2))}×`;
    panes.forEach((pane) => pane.node.classList.toggle('zoomed', lens.zoom > 1));
    redraw();
  }
  function redraw() {
    if (scheduled) return;
    scheduled = true;
    requestAnimationFrame(() => {
      scheduled = false;
      panes.forEach((pane) => pane.draw());
    });
  }
  /** Keeps the share [x, y] of the picture where it is on the screen. */
  function zoomAt(factor, [x, y] = [lens.x, lens.y]) {
    const zoom = Math.min(kMostZoom, Math.max(1, lens.zoom * factor));
    lens.x = x + (lens.x - x) * lens.zoom / zoom;
    lens.y = y + (lens.y - y) * lens.zoom / zoom;
    lens.zoom = zoom;
    changed();
  }
  function fit() {
    Object.assign(lens, {zoom: 1, x: 0.5, y: 0.5});
    changed();
  }
  function pointAt(where) {
    point = where;
    onPoint(point);
    redraw();
  }
  /** By pixels of the picture; the glass follows. */
  function step(columns, rows) {
    const {width, height} = size();
    const [x, y] = point ?? [lens.x, lens.y];
    const inside = (share, by, count) => (Math.min(count - 1, Math.max(0, Math.floor(share * count) + by)) + 0.5) / count;
    const next = [inside(x, columns, width), inside(y, rows, height)];
    const half = 0.5 / lens.zoom;
    lens.x = Math.min(next[0] + half, Math.max(next[0] - half, lens.x));
    lens.y = Math.min(next[1] + half, Math.max(next[1] - half, lens.y));
    changed();
    pointAt(next);
  }
  function onKey(event) {
    const far = event.shiftKey ? 10 : 1;
    const steps = {ArrowLeft: [-far, 0], ArrowRight: [far, 0], ArrowUp: [0, -far], ArrowDown: [0, far]};
    const actions = {'+': () => zoomAt(kZoomStep, point ?? undefined), '=': () => zoomAt(kZoomStep, point ?? undefined),
      '-': () => zoomAt(1 / kZoomStep, point ?? undefined), 0: fit, Escape: () => pointAt(null)};
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (steps[event.key]) step(...steps[event.key]);
    else if (actions[event.key]) actions[event.key]();
    else return;
    event.preventDefault();
  }

  const button = (label, name, action) => element('button', {type: 'button', class: 'quiet', 'aria-label': name, title: name, on: {click: action}}, label);
  const controls = element('div', {class: 'zoom', role: 'group', 'aria-label': 'Zoom'},
    button('−', 'Zoom out', () => zoomAt(1 / kZoomStep ** 2)), level, button('+', 'Zoom in', () => zoomAt(kZoomStep ** 2)), button('Fit', 'Show the whole picture', fit));

  return {
    controls, redraw, pointAt,
    point: () => point,
    add(name) {
      const pane = makePane(name, {lens, point: () => point, size, zoomAt, changed, pointAt, onKey});
      panes.push(pane);
      return pane;
    },
  };
}

/** One picture, or two under a wipe: show({source, tag, over?, overTag?}), canvases of the same proportions. */
function makePane(name, {lens, point, size, zoomAt, changed, pointAt, onKey}) {
  const canvas = element('canvas');
  const tags = [element('span', {class: 'tag left', hidden: true}), element('span', {class: 'tag right', hidden: true})];
  const divider = element('div', {class: 'divider', 'aria-hidden': 'true', hidden: true});
  const node = element('div', {class: 'stage', tabindex: '0', role: 'group', 'aria-label': `${name}. Arrow keys move the pixel that is read out, plus and minus zoom, 0 shows all.`, on: {keydown: onKey}},
    canvas, divider, ...tags);
  let shown = null;
  let wipe = 0.5;
  let onWipe = () => {};

  /** CSS pixels of the picture's left upper corner, and of the whole picture. */
  function place() {
    const [width, height] = [node.clientWidth, node.clientHeight];
    return {left: width * (0.5 - lens.x * lens.zoom), top: height * (0.5 - lens.y * lens.zoom), width: width * lens.zoom, height: height * lens.zoom};
  }
  const shareAt = (clientX, clientY) => {
    const box = node.getBoundingClientRect();
    const at = place();
    return [(clientX - box.left - at.left) / at.width, (clientY - box.top - at.top) / at.height];
  };
  const within = ([x, y]) => (x >= 0 && x < 1 && y >= 0 && y < 1 ? [x, y] : null);

  function draw() {
    const ratio = devicePixelRatio;
    const [width, height] = [Math.round(node.clientWidth * ratio), Math.round(node.clientHeight * ratio)];
    if (!width || !shown?.source) return;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
    const pen = canvas.getContext('2d');
    const {left, top, width: wide, height: high} = place();
    const picture = [left * ratio, top * ratio, wide * ratio, high * ratio];
    pen.imageSmoothingEnabled = wide / shown.source.width < kCrispFrom;
    pen.imageSmoothingQuality = 'high';
    pen.drawImage(shown.source, ...picture);
    if (shown.over) {
      pen.save();
      pen.beginPath();
      pen.rect(0, 0, wipe * width, height);
      pen.clip();
      pen.drawImage(shown.over, ...picture);
      pen.restore();
    }
    if (point()) drawPoint(pen, picture, ratio);
  }

  /** A frame round the pixel, light within dark, large enough to be seen. */
  function drawPoint(pen, [left, top, wide, high], ratio) {
    const {width, height} = size();
    const cell = Math.max(wide / width, 7 * ratio);
    const x = left + wide * (Math.floor(point()[0] * width) + 0.5) / width;
    const y = top + high * (Math.floor(point()[1] * height) + 0.5) / height;
    for (const [color, grow] of [['#000', 1.5 * ratio], ['#fff', 0]]) {
      pen.lineWidth = 1.5 * ratio;
      pen.strokeStyle = color;
      pen.strokeRect(x - cell / 2 - grow, y - cell / 2 - grow, cell + 2 * grow, cell + 2 * grow);
    }
  }

  function placeWipe(share) {
    wipe = Math.min(1, Math.max(0, share));
    node.style.setProperty('--wipe', `${100 * wipe}%`);
    tags[0].classList.toggle('hidden', Boolean(shown?.over) && wipe < 0.12);
    tags[1].classList.toggle('hidden', Boolean(shown?.over) && wipe > 0.88);
    onWipe(wipe);
    draw();
  }

  node.addEventListener('wheel', (event) => {
    const zoomsOut = event.deltaY > 0;
    if (!event.ctrlKey && (performance.now() - lastScroll < kScrollRest || (zoomsOut && lens.zoom === 1))) return;
    event.preventDefault();
    const notches = event.deltaY / (event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 100 : 3);
    zoomAt(kZoomStep ** Math.min(3, Math.max(-3, -notches)), shareAt(event.clientX, event.clientY));
  }, {passive: false});
  node.addEventListener('pointermove', (event) => {
    if (event.pointerType === 'mouse' && !fingers.size) pointAt(within(shareAt(event.clientX, event.clientY)));
  });

  // Moves are followed on the document, so that a drag goes on outside the picture. Two fingers pinch.
  const fingers = new Map();
  node.addEventListener('pointerdown', (down) => {
    if (down.button !== 0) return;
    const box = node.getBoundingClientRect();
    const fromDivider = Math.abs(down.clientX - box.left - wipe * box.width);
    const wipes = Boolean(shown?.over) && !fingers.size && (lens.zoom === 1 || fromDivider <= kWipeReach);
    fingers.set(down.pointerId, [down.clientX, down.clientY]);
    const spread = () => {
      const [a, b] = [...fingers.values()];
      return {middle: b ? [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] : a, apart: b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0};
    };
    const follow = (event) => {
      if (!fingers.has(event.pointerId)) return;
      if (wipes && fingers.size === 1) return placeWipe((event.clientX - box.left) / box.width);
      const before = spread();
      fingers.set(event.pointerId, [event.clientX, event.clientY]);
      const after = spread();
      if (before.apart && after.apart) zoomAt(after.apart / before.apart, shareAt(...after.middle));
      const at = place();
      lens.x -= (after.middle[0] - before.middle[0]) / at.width;
      lens.y -= (after.middle[1] - before.middle[1]) / at.height;
      changed();
    };
    const stop = (event) => {
      if (event.pointerId !== down.pointerId) return;
      fingers.delete(down.pointerId);
      document.removeEventListener('pointermove', follow);
      document.removeEventListener('pointerup', stop);
      document.removeEventListener('pointercancel', stop);
    };
    document.addEventListener('pointermove', follow);
    document.addEventListener('pointerup', stop);
    document.addEventListener('pointercancel', stop);
    pointAt(within(shareAt(down.clientX, down.clientY)));
    if (wipes) follow(down);
  });
  new ResizeObserver(() => requestAnimationFrame(draw)).observe(node);

  return {
    node, draw, placeWipe,
    wipe: () => wipe,
    watchWipe(listener) { onWipe = listener; },
    show(what) {
      shown = what;
      const wiped = Boolean(what.over);
      const texts = wiped ? [what.overTag, what.tag] : [what.tag, null];
      tags.forEach((tag, i) => {
        tag.hidden = !texts[i];
        tag.textContent = texts[i] ?? '';
      });
      divider.hidden = !wiped;
      node.classList.toggle('wiped', wiped);
      node.style.aspectRatio = `${what.source.width} / ${what.source.height}`;
      placeWipe(wipe);
    },
  };
}
