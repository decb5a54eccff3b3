// The numbers of the pictures: unpacked when they are first looked at. pixel_packing.h is the other side.

const canUnpack = typeof DecompressionStream === 'function';

/** The value of each half float by its bits. */
const halfFloats = Float32Array.from({length: 65536}, (_, bits) => {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = bits >> 10 & 31;
  const digits = bits & 1023;
  if (exponent === 31) return digits ? NaN : sign * Infinity;
  return exponent ? sign * 2 ** (exponent - 15) * (1 + digits / 1024) : sign * 2 ** -24 * digits;
});

async function inflate(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'))).arrayBuffer());
}

/** Where the value of each pixel stands in a plane: -1 where it has none. */
function placesOf(pixels, isCovered) {
  const places = new Int32Array(pixels).fill(-1);
  let count = 0;
  for (let i = 0; i < pixels; ++i) if (isCovered(i)) places[i] = count++;
  return {places, count};
}

const asSigned = (bits) => bits << 16 >> 16;

function medianPrediction(left, up, upLeft) {
  const [a, b, c] = [asSigned(left), asSigned(up), asSigned(upLeft)];
  if (c >= Math.max(a, b)) return Math.min(a, b);
  if (c <= Math.min(a, b)) return Math.max(a, b);
  return a + b - c;
}

/** Planes of red, green and blue; typed arrays take all sums modulo 65536. */
function unpackPlanes(bytes, {places, count}, width, base) {
  const planes = [0, 1, 2].map(() => new Uint16Array(count));
  let at = 0;
  for (const plane of [planes[1], planes[0], planes[2]]) {
    for (let i = 0, k = 0; i < places.length; ++i) {
      if (places[i] < 0) continue;
      const column = i % width;
      const left = column ? places[i - 1] : -1;
      const up = i >= width ? places[i - width] : -1;
      const upLeft = column && i >= width ? places[i - width - 1] : -1;
      const predicted = left >= 0 && up >= 0 && upLeft >= 0 ? medianPrediction(plane[left], plane[up], plane[upLeft])
        : left >= 0 ? plane[left] : up >= 0 ? plane[up] : 0;
      const code = bytes[at] << 8 | bytes[3 * count + at];
      ++at;
      plane[k++] = predicted + (code >>> 1 ^ -(code & 1));
    }
  }
  for (let i = 0; i < count; ++i) {
    planes[0][i] += planes[1][i];
    planes[2][i] += planes[1][i];
  }
  if (base) planes.forEach((plane, c) => plane.forEach((bits, i) => { plane[i] = bits + base[c][i]; }));
  return planes;
}

const numbersOf = (planes, dropped, scale) => planes.map((plane) => Float32Array.from(plane, (bits) => scale * halfFloats[bits << dropped]));

/** What all rigs of a frame share: {width, height, share, cover (255: all), object, others, reflectance, surroundings, truth}. */
async function unpackFrame(frame) {
  const {width, height, dropped} = frame;
  const pixels = width * height;
  const [coverage, ...streams] = await Promise.all([frame.coverage, frame.reflectance, frame.surroundings, frame.truth].map(inflate));
  const share = coverage.subarray(0, pixels);
  const cover = coverage.subarray(pixels);
  const object = placesOf(pixels, (i) => share[i] > 0);
  const others = placesOf(pixels, (i) => cover[i] > share[i]);
  const truthBits = unpackPlanes(streams[2], object, width);
  return {
    width, height, share, cover, object, others, truthBits,
    reflectance: numbersOf(unpackPlanes(streams[0], object, width), dropped, 1),
    surroundings: numbersOf(unpackPlanes(streams[1], others, width), frame.surroundings_dropped, 1),
    truth: numbersOf(truthBits, dropped, frame.scale),
  };
}

/** Unpacked at the first call. */
function frameNumbers(frame) {
  return frame.unpacked ??= unpackFrame(frame);
}

/** Irradiance of a rig by its index among the object's, W/m²: three planes over the object's pixels; of the truth for -1. */
function irradianceOf(frame, rig) {
  if (rig < 0) return frameNumbers(frame).then(({truth}) => truth);
  return frame.rigs[rig].unpacked ??= (async () => {
    const {object, width, truthBits} = await frameNumbers(frame);
    const planes = unpackPlanes(await inflate(frame.rigs[rig].irradiance), object, width, truthBits);
    return numbersOf(planes, frame.dropped, frame.scale);
  })();
}
