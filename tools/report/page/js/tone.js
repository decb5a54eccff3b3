// From numbers to colours: the tone map of the PNG files (tone_map.cpp), and false colours.

const kBackdrop = [0.0040, 0.0044, 0.0056];
const kOffObject = 112;  // grey of 255 where a picture of errors shows none
const kKept = 40;        // drawn pictures that are kept, of all objects together
const kClay = 0.5;       // base colour of everything where light alone is shown

const srgbDecoded = (s) => (s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4);
/** Linear values at which the next byte of sRGB begins. */
const srgbSteps = Float64Array.from({length: 255}, (_, byte) => srgbDecoded((byte + 0.5) / 255));
const kSrgbCells = 4096;
/** The byte at the lower end of each cell of linear values. */
const srgbCells = Uint8Array.from({length: kSrgbCells + 1}, (_, cell) => srgbSteps.findLastIndex((step) => cell / kSrgbCells >= step) + 1);

function encodeSrgb(linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  let byte = srgbCells[Math.floor(linear * kSrgbCells)];
  while (byte < 255 && linear >= srgbSteps[byte]) ++byte;
  return byte;
}

function softShoulder(x) {
  if (!(x > 0)) return 0;
  return x <= 0.7 ? x : 0.7 + 0.3 * (1 - Math.exp((0.7 - x) / 0.3));
}

/** The object under this irradiance as the camera sees it; `clay` leaves its colours away. */
function shadedPicture(numbers, irradiance, exposure, clay) {
  const {width, height, share, cover, object, others, reflectance, surroundings} = numbers;
  const image = new ImageData(width, height);
  for (let i = 0; i < width * height; ++i) {
    const on = object.places[i];
    const around = others.places[i];
    for (let c = 0; c < 3; ++c) {
      let radiance = around >= 0 ? surroundings[c][around] : 0;
      if (on >= 0) radiance += irradiance[c][on] * (clay ? kClay / Math.PI * share[i] / 255 : reflectance[c][on]);
      image.data[4 * i + c] = encodeSrgb(softShoulder(radiance * exposure) + (1 - cover[i] / 255) * kBackdrop[c]);
    }
    image.data[4 * i + 3] = 255;
  }
  return image;
}

/** A table of 256 colours, three bytes each, blended from "#rrggbb" stops. */
function colorTable(stops) {
  const table = new Uint8ClampedArray(3 * 256);
  const channel = (stop, c) => parseInt(stops[stop].slice(1 + 2 * c, 3 + 2 * c), 16);
  for (let i = 0; i < 256; ++i) {
    const at = i / 255 * (stops.length - 1);
    const stop = Math.min(Math.floor(at), stops.length - 2);
    for (let c = 0; c < 3; ++c) table[3 * i + c] = channel(stop, c) + (at - stop) * (channel(stop + 1, c) - channel(stop, c));
  }
  return table;
}

/** Both rise evenly in lightness away from zero; blue and orange are told apart by all kinds of colour vision. */
const heatColors = embedded.colors;
const signedColors = ['#cbeaff', '#7cc0f4', '#3c8fd6', '#1d5f9e', '#143a60', '#18181b', '#58300f', '#96501a', '#d07a2a', '#f3ac5a', '#ffe7c0'];
const heatTable = colorTable(heatColors);
const signedTable = colorTable(signedColors);

/** valueAt(place) in [0, 1] picks the colour of each pixel of the object. */
function falseColorPicture({width, height, share, object}, table, valueAt) {
  const image = new ImageData(width, height);
  for (let i = 0; i < width * height; ++i) {
    const on = object.places[i];
    const mix = share[i] / 255;
    const entry = on >= 0 ? 3 * Math.round(255 * Math.min(1, Math.max(0, valueAt(on, i)))) : 0;
    for (let c = 0; c < 3; ++c) image.data[4 * i + c] = kOffObject + (on >= 0 ? mix * (table[entry + c] - kOffObject) : 0);
    image.data[4 * i + 3] = 255;
  }
  return image;
}

/** The same where every pixel has a value, 1 at `top`. */
function wholePicture({width, height}, table, values, top) {
  const image = new ImageData(width, height);
  values.forEach((value, i) => {
    const entry = 3 * Math.round(255 * Math.min(1, value / top));
    image.data.set([table[entry], table[entry + 1], table[entry + 2], 255], 4 * i);
  });
  return image;
}

const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
const luminanceAt = (planes, i) => luminance(planes[0][i], planes[1][i], planes[2][i]);

/** Luminance of irradiance. */
function irradianceColors(numbers, irradiance, top) {
  return falseColorPicture(numbers, heatTable, (i) => luminanceAt(irradiance, i) / top);
}

/** The difference of luminance: grey-black where there is none, orange where the rig is too bright, blue where too dark. */
function signedErrorColors(numbers, irradiance, top) {
  return falseColorPicture(numbers, signedTable, (i) => 0.5 + 0.5 * (luminanceAt(irradiance, i) - luminanceAt(numbers.truth, i)) / top);
}

/** Root mean square over the channels of the difference, as the heat maps in files. */
function absoluteErrorColors(numbers, irradiance, top) {
  const square = (c, i) => (irradiance[c][i] - numbers.truth[c][i]) ** 2;
  return falseColorPicture(numbers, heatTable, (i) => Math.sqrt((square(0, i) + square(1, i) + square(2, i)) / 3) / top);
}

const drawnPictures = new Map();
/** The ImageData that `draw` gives for a key as a canvas, drawn once while it is kept, with the mean that it may have. */
function drawnOnce(key, draw) {
  let canvas = drawnPictures.get(key);
  drawnPictures.delete(key);
  if (!canvas) {
    const image = draw();
    canvas = element('canvas', {width: image.width, height: image.height});
    canvas.getContext('2d').putImageData(image, 0, 0);
    canvas.mean = image.mean;
  }
  drawnPictures.set(key, canvas);
  if (drawnPictures.size > kKept) drawnPictures.delete(drawnPictures.keys().next().value);
  return canvas;
}

/** A bar of colours and its ticks: show(colors, labels). */
function colorScale() {
  const ramp = element('div', {class: 'ramp', 'aria-hidden': 'true'});
  const ticks = element('div', {class: 'ticks'});
  return {
    node: element('div', {class: 'scale'}, ramp, ticks),
    show(colors, labels) {
      ramp.style.background = `linear-gradient(to right, ${colors.join(', ')})`;
      ticks.replaceChildren(...labels.map((label) => element('span', {}, label)));
    },
  };
}
