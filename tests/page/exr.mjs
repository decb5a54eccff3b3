// Reads OpenEXR files as Rigel writes them: scan lines of HALF or FLOAT channels, ZIP compressed.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {inflateSync} from 'node:zlib';

const kHalf = 1, kZip = 3, kZipLines = 16;

export function halfToNumber(bits) {
  const [sign, exponent, digits] = [bits & 0x8000 ? -1 : 1, bits >> 10 & 31, bits & 1023];
  if (exponent === 31) return digits ? NaN : sign * Infinity;
  return sign * (exponent ? 2 ** (exponent - 15) * (1 + digits / 1024) : 2 ** -24 * digits);
}

/** {width, height, channels: {name: Float64Array of width * height}} */
export function readExr(path) {
  const file = readFileSync(path);
  assert.equal(file.readUInt32LE(0), 20000630, `${path} is no OpenEXR file`);
  let at = 8;
  const text = () => {
    const end = file.indexOf(0, at);
    const found = file.toString('latin1', at, end);
    at = end + 1;
    return found;
  };
  const found = [];
  let box, compression;
  for (let name; (name = text());) {
    text();
    const end = at + 4 + file.readInt32LE(at);
    at += 4;
    if (name === 'channels') {
      while (file[at]) {
        found.push({name: text(), isHalf: file.readInt32LE(at) === kHalf});
        at += 16;
      }
    }
    if (name === 'dataWindow') box = [0, 4, 8, 12].map((offset) => file.readInt32LE(at + offset));
    if (name === 'compression') compression = file[at];
    at = end;
  }
  assert.equal(compression, kZip);
  const [width, height] = [box[2] - box[0] + 1, box[3] - box[1] + 1];
  const channels = Object.fromEntries(found.map(({name}) => [name, new Float64Array(width * height)]));
  const lineBytes = width * found.reduce((sum, {isHalf}) => sum + (isHalf ? 2 : 4), 0);
  for (let block = 0; block * kZipLines < height; ++block) {
    const start = Number(file.readBigUInt64LE(at + 8 * block));
    const first = file.readInt32LE(start) - box[1];
    const size = file.readInt32LE(start + 4);
    const lines = Math.min(kZipLines, height - first);
    const data = unzipped(file.subarray(start + 8, start + 8 + size), lines * lineBytes);
    let offset = 0;
    for (let y = first; y < first + lines; ++y) {
      for (const {name, isHalf} of found) {
        for (let x = 0; x < width; ++x, offset += isHalf ? 2 : 4) {
          channels[name][y * width + x] = isHalf ? halfToNumber(data.readUInt16LE(offset)) : data.readFloatLE(offset);
        }
      }
    }
  }
  return {width, height, channels};
}

/** zlib, then differences summed up, then the two halves interleaved; blocks that would not shrink stand as they are. */
function unzipped(block, size) {
  if (block.length === size) return block;
  const sums = inflateSync(block);
  for (let i = 1; i < sums.length; ++i) sums[i] = sums[i - 1] + sums[i] - 128 & 255;
  const data = Buffer.alloc(size);
  for (let i = 0; i < size; ++i) data[i] = sums[(i & 1 ? size + 1 >> 1 : 0) + (i >> 1)];
  return data;
}
