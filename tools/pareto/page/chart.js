// Error against cost on logarithmic axes, drawn by Observable Plot; pointing, arrow keys and clicks choose a point.

const kReach = 28;  // px within which a point is taken for the one meant

function drawChart(width, height, {points, front}, values) {
  const drawn = points.filter(({x, y}) => x > 0 && y > 0);
  const stairs = front.filter(({x, y}) => x > 0 && y > 0);
  const xDomain = logDomain(drawn.map(({x}) => x));
  const yDomain = logDomain(drawn.map(({y}) => y));
  const narrow = width < 560;
  const rest = drawn.filter((entry) => !entry.optimal);
  const best = drawn.filter((entry) => entry.optimal);
  const dots = (entries, options) => Plot.dot(entries, {
    x: 'x', y: 'y', symbol: ({point}) => symbolOf(point), fill: ({point}) => familyColor(point.family), sort: null,
    ariaLabel: ({point, x, y}) => `${point.arguments}: ${percent(y)}, ${figure(x)}`, ...options,
  });
  const cost = costNamed(values.cost);
  const root = Plot.plot({
    width, height, marginLeft: narrow ? 40 : 52, marginRight: 14, marginTop: 30, marginBottom: 46,
    style: {...chartStyle, color: 'var(--text)'},
    x: {type: 'log', domain: xDomain, label: cost.axis(values.shaded), labelArrow: 'none', labelAnchor: 'right', ticks: logTicks(xDomain), tickFormat: tickLabel},
    y: {type: 'log', domain: yDomain, label: errorNamed(values.error).axis, labelArrow: 'none', ticks: logTicks(yDomain), tickFormat: percentTick},
    symbol: {type: 'identity'}, color: {type: 'identity'},
    marks: [
      Plot.gridX({ticks: logTicks(xDomain), ...gridStyle}), Plot.gridY({ticks: logTicks(yDomain), ...gridStyle}),
      Plot.line(stairsOf(stairs, yDomain[1], xDomain[1]), {x: 'x', y: 'y', className: 'stairs', stroke: 'var(--text)', strokeWidth: 1.2, strokeDasharray: '5 4'}),
      dots(rest, {className: 'point', r: narrow ? 2.4 : 3.2, fillOpacity: 0.5}),
      dots(best, {className: 'point', r: narrow ? 4 : 5, stroke: 'var(--text)', strokeWidth: 1.2}),
    ],
  });
  root.setAttribute('role', 'group');
  root.setAttribute('aria-label', `${errorNamed(values.error).axis} against ${cost.axis(values.shaded)}; arrow keys go from point to point`);
  const order = [...rest, ...best];
  const nodes = [...root.querySelectorAll('g[aria-label="dot"] > *')];
  const [toX, toY] = [root.scale('x').apply, root.scale('y').apply];
  order.forEach((entry, i) => Object.assign(entry, {node: nodes[i], px: toX(entry.x), py: toY(entry.y)}));
  nameFront(root, best, narrow, {left: narrow ? 40 : 52, right: width - 4, top: 30, bottom: height - 46});
  return {root, entries: order.sort((a, b) => a.x - b.x || a.y - b.y)};
}

/** Names beside the points of the front, where there is room. */
function nameFront(root, best, narrow, box) {
  const taken = best.map(({px, py}) => ({left: px - 7, right: px + 7, top: py - 7, bottom: py + 7}));
  const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  for (const {point, px, py} of [...best].sort((a, b) => a.x - b.x)) {
    const name = shortName(point);
    const width = 6.5 * name.length;
    // Below and to the left of a front there is nothing else.
    const places = [[-9 - width, 13], [-9 - width, -5], [-9 - width, 26], [-9 - width, 39], ...(narrow ? [] : [[9, -6], [9, 14]])]
      .map(([dx, dy]) => ({x: px + dx, y: py + dy, left: px + dx, right: px + dx + width, top: py + dy - 11, bottom: py + dy + 3}));
    const place = places.find((area) => area.left > box.left && area.right < box.right && area.top > box.top && area.bottom < box.bottom && !taken.some((other) => meet(area, other)));
    if (!place) continue;
    taken.push(place);
    root.append(svgElement('text', {class: 'front-name', x: place.x, y: place.y}, name));
  }
}

function chart() {
  const place = element('div', {class: 'plot pareto-plot'});
  const readout = element('div', {class: 'readout', hidden: true});
  const none = element('p', {class: 'hint', hidden: true});
  let current = {entries: []};
  let width = 0;

  const nearest = (event) => {
    const box = place.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    let best = null;
    let least = kReach ** 2;
    for (const entry of current.entries) {
      const distance = (entry.px - x) ** 2 + (entry.py - y) ** 2 - (entry.optimal ? 60 : 0);  // where two are close, the better one
      if (distance < least) [least, best] = [distance, entry];
    }
    return best;
  };
  const entryOf = (point) => current.entries.find((entry) => entry.point === point);

  const mark = ({chosen, hovered}) => {
    for (const entry of current.entries) {
      entry.node.classList.toggle('chosen', entry.point === chosen);
      entry.node.classList.toggle('hovered', entry.point === hovered);
    }
    const entry = hovered && entryOf(hovered);
    readout.hidden = !entry;
    if (!entry) return;
    const values = settings.get();
    readout.replaceChildren(element('div', {class: 'when'}, shortName(entry.point)),
      element('div', {}, `${percent(entry.y)} ${errorNamed(values.error).label.toLowerCase()}`),
      element('div', {}, `${figure(entry.x)} ${costNamed(values.cost).axis(values.shaded)}`));
    readout.style.left = `${entry.px}px`;
    readout.style.top = `${Math.max(0, entry.py - 30)}px`;
    readout.classList.toggle('flip', entry.px > width / 2);
  };

  const focusOn = (entry) => {
    for (const other of current.entries) other.node.tabIndex = -1;
    if (!entry) return;
    entry.node.tabIndex = 0;
  };
  const draw = (values) => {
    if (!width) return;
    const hadFocus = place.contains(document.activeElement);
    const shown = visible(values);
    current = drawChart(width, Math.min(600, Math.max(420, Math.round(0.62 * width))), shown, values);
    for (const entry of current.entries) {
      entry.node.setAttribute('role', 'button');
      entry.node.dataset.arguments = entry.point.arguments;
      entry.node.addEventListener('focus', () => settings.set({hovered: entry.point}));
      entry.node.addEventListener('blur', () => settings.set({hovered: null}));
    }
    const start = entryOf(values.chosen) ?? current.entries.find((entry) => entry.optimal);
    focusOn(start);
    place.replaceChildren(current.root, readout);
    if (hadFocus) start?.node.focus();
    const left = shown.points.length - current.entries.length;
    none.hidden = left === 0;
    none.textContent = `${plural(left, 'point')} without error or cost: a logarithmic axis has no room for 0. The table has them.`;
    mark(settings.get());
  };

  place.addEventListener('pointermove', (event) => {
    const entry = nearest(event);
    if (settings.get().hovered !== (entry?.point ?? null)) settings.set({hovered: entry?.point ?? null});
  });
  place.addEventListener('pointerleave', () => settings.set({hovered: null}));
  place.addEventListener('click', (event) => {
    const entry = nearest(event);
    if (entry) settings.set({chosen: entry.point});
  });
  place.addEventListener('keydown', (event) => {
    const index = current.entries.findIndex((entry) => entry.node === document.activeElement);
    if (index < 0) return;
    const best = current.entries.filter((entry) => entry.optimal);
    const along = best.indexOf(current.entries[index]);
    const next = {
      ArrowRight: current.entries[index + 1], ArrowLeft: current.entries[index - 1],
      ArrowDown: best[along < 0 ? 0 : along + 1], ArrowUp: best[along < 0 ? 0 : along - 1],
      Home: current.entries[0], End: current.entries.at(-1),
    }[event.key];
    if (event.key === 'Enter' || event.key === ' ') settings.set({chosen: current.entries[index].point});
    else if (!next) return;
    event.preventDefault();
    if (!next) return;
    focusOn(next);
    next.node.focus();
  });

  let shownFor = '';
  settings.watch((values) => {
    const {chosen, hovered, ...drawing} = values;
    const key = JSON.stringify(drawing);
    if (key !== shownFor) {
      shownFor = key;
      draw(values);
    } else {
      mark(values);
    }
  });
  const fit = () => {
    if (place.clientWidth === width || place.clientWidth === 0) return;
    width = place.clientWidth;
    draw(settings.get());
  };
  new ResizeObserver(() => requestAnimationFrame(fit)).observe(place);
  requestAnimationFrame(fit);
  return element('div', {}, place, none);
}
