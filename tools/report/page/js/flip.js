// FLIP (P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", 2020) of what is on the screen; flip.cpp has the same formulas for the figures of report.json.

const kPixelsPerDegree = 3840 * Math.PI / 180;  // of a screen of 3840 pixels as wide as it is far away

const kToXyz = [[10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794], [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
  [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382]];
const kFromXyz = [[3.241003275, -1.537398934, -0.498615861], [-0.969224334, 1.875930071, 0.041554224], [0.055639423, -0.204011202, 1.057148933]];
const kWhite = kToXyz.map(([r, g, b]) => r + g + b);

/** Weights from -radius to radius, the positive ones made to sum to 1, the negative ones to -1. */
function normalKernel(radius, weight) {
  const kernel = Float64Array.from({length: 2 * radius + 1}, (_, i) => weight(i - radius));
  const positive = kernel.reduce((sum, w) => sum + Math.max(w, 0), 0);
  const negative = kernel.reduce((sum, w) => sum - Math.min(w, 0), 0);
  return kernel.map((w) => (w > 0 ? w / positive : w < 0 ? w / negative : 0));
}

/** Along lines of `count` pixels `step` apart; the pixels at the border are repeated. */
function convolvedLines(plane, kernel, count, step, lines, lineStep) {
  const radius = kernel.length >> 1;
  const out = new Float32Array(plane.length);
  const padded = new Float32Array(count + 2 * radius);
  for (let line = 0; line < lines; ++line) {
    const start = line * lineStep;
    for (let i = -radius; i < count + radius; ++i) padded[i + radius] = plane[start + step * Math.min(count - 1, Math.max(0, i))];
    for (let i = 0; i < count; ++i) {
      let sum = 0;
      for (let k = 0; k < kernel.length; ++k) sum += kernel[k] * padded[i + k];
      out[start + i * step] = sum;
    }
  }
  return out;
}

/** What a viewer sees of an ImageData: {l, a, b, edge, point}, planes. */
function seenPicture({data, width, height}, pixelsPerDegree) {
  const filtered = (plane, alongX, alongY) => convolvedLines(convolvedLines(plane, alongX, width, 1, height, width), alongY, height, width, width, 1);
  const count = width * height;
  const [y, redGreen, blueYellow] = [0, 1, 2].map(() => new Float32Array(count));
  const decoded = Float64Array.from({length: 256}, (_, byte) => srgbDecoded(byte / 255));
  const xyz = (r, g, b, row) => (kToXyz[row][0] * r + kToXyz[row][1] * g + kToXyz[row][2] * b) / kWhite[row];
  for (let i = 0; i < count; ++i) {
    const [r, g, b] = [decoded[data[4 * i]], decoded[data[4 * i + 1]], decoded[data[4 * i + 2]]];
    y[i] = xyz(r, g, b, 1);
    redGreen[i] = xyz(r, g, b, 0) - y[i];
    blueYellow[i] = y[i] - xyz(r, g, b, 2);
  }

  // The eye's contrast sensitivity: terms [a, b] of a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
  const reach = Math.ceil(3 * Math.sqrt(0.04 / (2 * Math.PI ** 2)) * pixelsPerDegree);
  const seenThrough = (terms, plane) => {
    const parts = terms.map(([a, b]) => {
      const gaussian = (x) => Math.exp(-((Math.PI * x / pixelsPerDegree) ** 2) / b);
      let sum = 0;
      for (let x = -reach; x <= reach; ++x) sum += gaussian(x);
      const kernel = normalKernel(reach, gaussian);
      return {weight: a * Math.sqrt(Math.PI / b) * sum ** 2, plane: filtered(plane, kernel, kernel)};
    });
    const total = parts.reduce((sum, {weight}) => sum + weight, 0);
    return parts[0].plane.map((_, i) => parts.reduce((sum, part) => sum + part.weight * part.plane[i], 0) / total);
  };
  const seenY = seenThrough([[1, 0.0047]], y);
  const seenRedGreen = seenThrough([[1, 0.0053]], redGreen);
  const seenBlueYellow = seenThrough([[34.1, 0.04], [13.5, 0.025]], blueYellow);
  const [l, a, b] = [0, 1, 2].map(() => new Float32Array(count));
  for (let i = 0; i < count; ++i) {
    const x = (seenY[i] + seenRedGreen[i]) * kWhite[0];
    const z = (seenY[i] - seenBlueYellow[i]) * kWhite[2];
    const [red, green, blue] = kFromXyz.map((row) => Math.min(1, Math.max(0, row[0] * x + row[1] * seenY[i] * kWhite[1] + row[2] * z)));
    [l[i], a[i], b[i]] = huntLab(xyz(red, green, blue, 0), xyz(red, green, blue, 1), xyz(red, green, blue, 2));
  }

  // Edges and points: derivatives of a Gaussian as wide as the eye's detectors of 0.082 degrees.
  const deviation = 0.5 * 0.082 * pixelsPerDegree;
  const radius = Math.ceil(3 * deviation);
  const gaussian = (x) => Math.exp(-(x * x) / (2 * deviation ** 2));
  const smooth = normalKernel(radius, gaussian);
  const slope = normalKernel(radius, (x) => -x * gaussian(x));
  const bend = normalKernel(radius, (x) => (x * x / deviation ** 2 - 1) * gaussian(x));
  const strength = (kernel) => {
    const across = filtered(y, kernel, smooth);
    const down = filtered(y, smooth, kernel);
    return across.map((value, i) => Math.hypot(value, down[i]));
  };
  return {l, a, b, edge: strength(slope), point: strength(bend)};
}

/** L* a* b* of X, Y, Z over white's, with less chroma the darker it is (Hunt). */
function huntLab(x, y, z) {
  const f = (t) => (t > 216 / 24389 ? Math.cbrt(t) : t * 841 / 108 + 4 / 29);
  const l = 116 * f(y) - 16;
  return [l, 0.01 * l * 500 * (f(x) - f(y)), 0.01 * l * 200 * (f(y) - f(z))];
}

const colorDistance = (dl, da, db) => (Math.abs(dl) + Math.hypot(da, db)) ** 0.7;
const kLargestDistance = (() => {
  const [green, blue] = [1, 2].map((c) => huntLab(...kToXyz.map((row, i) => row[c] / kWhite[i])));
  return colorDistance(...green.map((value, i) => value - blue[i]));
})();

/** FLIP in [0, 1] a pixel of two pictures as seenPicture() gives them. */
function flipErrors(p, q) {
  const knee = 0.4 * kLargestDistance;
  return p.l.map((_, i) => {
    const distance = colorDistance(p.l[i] - q.l[i], p.a[i] - q.a[i], p.b[i] - q.b[i]);
    const color = distance < knee ? 0.95 / knee * distance : 0.95 + (distance - knee) / (kLargestDistance - knee) * 0.05;
    const feature = Math.sqrt(Math.max(Math.abs(p.edge[i] - q.edge[i]), Math.abs(p.point[i] - q.point[i])) / Math.SQRT2);
    return color ** (1 - feature);
  });
}

/** A picture of the truth, seen once for all rigs of a frame: of each frame the last is kept. */
function seenTruth(numbers, key, see) {
  if (numbers.seen?.key !== key) numbers.seen = {key, picture: see()};
  return numbers.seen.picture;
}
