// What both charts are made of: scales, ticks, axes, and drawing again when the width changes.

/** A linear or logarithmic map from `domain` to pixels. Values at or below zero go to the low end of a logarithmic one. */
function makeScale(kind, [low, high], [start, end]) {
  const warp = kind === 'log' ? (value) => Math.log10(Math.max(value, low)) : (value) => value;
  const [a, b] = [warp(low), warp(high)];
  const map = (value) => start + (end - start) * (b === a ? 0.5 : (warp(value) - a) / (b - a));
  return Object.assign(map, {kind, low, high});
}

/** Round numbers within the scale: 1-2-5 steps; on a logarithmic scale of several decades 1, 10, 100 alone. */
function ticksOf({kind, low, high}, wanted) {
  const ticks = [];
  if (kind === 'log') {
    const decades = Math.log10(high / low);
    const factors = decades > 3.5 ? [1] : decades > 1.6 ? [1, 3] : [1, 2, 5];
    for (let exponent = Math.floor(Math.log10(low)); exponent <= Math.ceil(Math.log10(high)); ++exponent) {
      ticks.push(...factors.map((factor) => factor * 10 ** exponent));
    }
  } else if (high > low) {
    const rough = (high - low) / wanted;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough);
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high * (1 + 1e-9); ++i) ticks.push(i * step);
  } else {
    ticks.push(low);
  }
  return ticks.filter((tick) => tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9));
}

/** The domain of positive values with a margin, for a logarithmic scale; a decade around 1 where there is none. */
function logDomain(values, margin = 1.25) {
  const positive = values.filter((value) => value > 0);
  if (!positive.length) return [0.1, 10];
  return [Math.min(...positive) / margin, Math.max(...positive) * margin];
}

const linearDomain = (values) => [0, Math.max(...values) * 1.06 || 1];

/** Grid lines and labels of a vertical axis at the left edge of `box`. */
function leftAxis(scale, box, format, wanted) {
  return ticksOf(scale, wanted).map((tick) => {
    const y = scale(tick);
    return svgElement('g', {}, svgElement('line', {class: 'grid', x1: box.left, x2: box.right, y1: y, y2: y}),
      svgElement('text', {class: 'tick', x: box.left - 8, y: y + 4, 'text-anchor': 'end'}, format(tick)));
  });
}

function bottomAxis(scale, box, format, wanted, withGrid) {
  return ticksOf(scale, wanted).map((tick) => {
    const x = scale(tick);
    return svgElement('g', {}, svgElement('line', {class: 'grid', x1: x, x2: x, y1: withGrid ? box.top : box.bottom, y2: box.bottom + 4}),
      svgElement('text', {class: 'tick', x, y: box.bottom + 18, 'text-anchor': 'middle'}, format(tick)));
  });
}

/** Short tick labels: 0.1, 5, 20, 1k, 20k. */
function tickLabel(value) {
  if (value >= 1e6) return `${Number((value / 1e6).toPrecision(3))}M`;
  if (value >= 1e4) return `${Number((value / 1e3).toPrecision(3))}k`;
  return String(Number(value.toPrecision(3)));
}

const polyline = (points) => points.map(([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`).join(' ');

/** Calls `draw(width)` now and whenever the width of `node` has changed. */
function drawToWidth(node, draw) {
  let width = 0;
  const update = () => {
    if (node.clientWidth === width || node.clientWidth === 0) return;
    width = node.clientWidth;
    draw(width);
  };
  new ResizeObserver(() => requestAnimationFrame(update)).observe(node);
  requestAnimationFrame(update);
  return {
    again() {
      if (width) draw(width);
    },
  };
}
