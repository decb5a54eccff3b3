// The 3-D views' data, unpacked: what view3d_json.cpp and view3d_pack.cpp wrote.

const view3dBlock = document.getElementById('view3d-data');
const views3d = view3dBlock ? JSON.parse(view3dBlock.textContent) : null;

const kQuantum = 65535;
const kFloatsOfPlace = 7;  // position, direction, radius
const kCulled = 0;
const kFar = 1;
const kLeastNear = 2;

/** Reads rows as RowPacker wrote them: differences along the row, or from the row before. */
function rowReader(bytes) {
  let next = 0;
  const summed = (row, before, mask) => {
    if (before) row.forEach((value, i) => { row[i] = (value + before[i]) & mask; });
    else for (let i = 1; i < row.length; ++i) row[i] = (row[i] + row[i - 1]) & mask;
    return row;
  };
  return {
    bytes(count, before) {
      const across = bytes[next++] === 1;
      const row = bytes.slice(next, next + count);
      next += count;
      return summed(row, across ? before : null, 0xff);
    },
    words(count, before) {
      const across = bytes[next++] === 1;
      const row = new Uint16Array(count);
      for (let i = 0; i < count; ++i) row[i] = bytes[next + i] | bytes[next + count + i] << 8;
      next += 2 * count;
      return summed(row, across ? before : null, 0xffff);
    },
  };
}

/** Rows of `frames` frames, each packed against the one before. */
function course(frames, read) {
  const rows = [];
  for (let f = 0; f < frames; ++f) rows.push(read(rows[f - 1]));
  return rows;
}

/** Three values a vertex, for each frame, from green and the differences of red and blue from it. */
function readColors(reader, frames, vertices, unpack) {
  const [green, red, blue] = [0, 1, 2].map(() => course(frames, (before) => reader.bytes(vertices, before)));
  return green.map((row, f) => {
    const colors = new Float32Array(3 * vertices);
    row.forEach((g, i) => {
      colors[3 * i] = unpack((g + red[f][i]) & 0xff);
      colors[3 * i + 1] = unpack(g);
      colors[3 * i + 2] = unpack((g + blue[f][i]) & 0xff);
    });
    return colors;
  });
}

/** Points of `frames` frames in the object's own frame [m]. */
function readPoints(reader, frames, count, {lo, size}) {
  const axes = [0, 1, 2].map(() => course(frames, (before) => reader.words(count, before)));
  return axes[0].map((_, f) => {
    const points = new Float32Array(3 * count);
    for (let axis = 0; axis < 3; ++axis) axes[axis][f].forEach((value, i) => { points[3 * i + axis] = lo[axis] + size[axis] * value / kQuantum; });
    return points;
  });
}

/**
 * {triangles, positions, truth, poses, frames, rigs: [{error, lights, samples, boxes}]}; what changes is an array over the view's
 * frames. Errors are relative, truth is in W/m².
 */
async function unpackView(view) {
  const reader = rowReader(await inflate(view.data));
  const {vertices, frames: {length: frames}} = view;
  const triangles = reader.words(3 * view.triangles);
  const positions = readPoints(reader, view.rigid ? 1 : frames, vertices, view);
  const truth = readColors(reader, frames, vertices, (byte) => view.truth_max * (byte / 255) ** 2);
  const rigs = view.rigs.map((rig) => {
    const signed = (byte) => (byte << 24 >> 24) / 127;
    const error = readColors(reader, frames, vertices, (byte) => rig.error_max * signed(byte) * Math.abs(signed(byte)));
    const lights = course(frames, (before) => reader.bytes(view.lights, before));
    return {error, lights, samples: readPoints(reader, frames, rig.samples, view), boxes: rig.boxes};
  });
  return {triangles, truth, rigs, poses: view.poses, frames: view.frames, positions: view.frames.map((_, f) => positions[view.rigid ? 0 : f])};
}

/** Where the scene's lights are: place(light, frame) gives {position, direction, radius}. */
async function unpackPlaces(scene) {
  const {buffer} = await inflate(scene.places);
  const floats = new Float32Array(buffer);
  return (light, frame) => {
    const place = floats.subarray(kFloatsOfPlace * (light * scene.frames.length + frame));
    return {position: place.slice(0, 3), direction: place.slice(3, 6), radius: place[6]};
  };
}

/** The share of a light that is evaluated exactly. */
const nearShare = (byte) => Math.max(0, (byte - kLeastNear) / (255 - kLeastNear));
