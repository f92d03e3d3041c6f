// Writes small GeoTIFF files: one strip, uncompressed, WGS 84 / UTM zone 15 north.

const sizes = { 1: 1, 2: 1, 3: 2, 4: 4, 12: 8 };

function values(kind, list) {
  const bytes = Buffer.alloc(list.length * sizes[kind]);
  list.forEach((value, i) => {
    if (kind === 3) bytes.writeUInt16LE(value, 2 * i);
    else if (kind === 4) bytes.writeUInt32LE(value, 4 * i);
    else if (kind === 12) bytes.writeDoubleLE(value, 8 * i);
    else bytes.writeUInt8(value, i);
  });
  return bytes;
}

/**
 * The file's bytes. `pixel(x, y)` gives the samples of a pixel: three of a colour, or the one
 * height, in metres. Changes to `tags` (number: [kind, values], or null for none) break it on purpose.
 */
export function geotiff({ width, height, gsd, east, north, pixel, heights = false, tags = {} }) {
  const samples = heights ? 1 : 3;
  const bytes = heights ? 2 : 1;
  const pixels = Buffer.alloc(width * height * samples * bytes);
  for (let y = 0, at = 0; y < height; y += 1) {
    for (let x = 0; x < width; x += 1) {
      for (const sample of pixel(x, y)) at = heights ? pixels.writeInt16LE(sample, at) : pixels.writeUInt8(sample, at);
    }
  }
  const all = {
    256: [4, [width]], 257: [4, [height]], 258: [3, Array(samples).fill(8 * bytes)], 259: [3, [1]],
    262: [3, [heights ? 1 : 2]], 273: [4, [8]], 277: [3, [samples]], 278: [4, [height]], 279: [4, [pixels.length]],
    339: [3, Array(samples).fill(heights ? 2 : 1)],
    33550: [12, [gsd, gsd, 0]], 33922: [12, [0, 0, 0, east, north, 0]],
    34735: [3, [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32615]],
    ...tags,
  };
  const entries = Object.entries(all).filter(([, value]) => value).map(([tag, [kind, list]]) => [Number(tag), kind, list]).sort((a, b) => a[0] - b[0]);
  const directory = 8 + pixels.length + (pixels.length % 2);
  const after = directory + 2 + 12 * entries.length + 4;
  const table = Buffer.alloc(2 + 12 * entries.length + 4);
  table.writeUInt16LE(entries.length, 0);
  const beyond = [];
  let offset = after;
  entries.forEach(([tag, kind, list], i) => {
    const at = 2 + 12 * i;
    const body = values(kind, list);
    table.writeUInt16LE(tag, at);
    table.writeUInt16LE(kind, at + 2);
    table.writeUInt32LE(list.length, at + 4);
    if (body.length <= 4) body.copy(table, at + 8);
    else { table.writeUInt32LE(offset, at + 8); beyond.push(body); offset += body.length; }
  });
  const header = Buffer.from([0x49, 0x49, 42, 0, 0, 0, 0, 0]);
  header.writeUInt32LE(directory, 4);
  return Buffer.concat([header, pixels, Buffer.alloc(pixels.length % 2), table, ...beyond]);
}

/** Fields in several greens with a road and a red square in the north-west. */
export function country(width, height) {
  return (x, y) => {
    if (x > 0.1 * width && x < 0.2 * width && y > 0.1 * height && y < 0.2 * height) return [190, 50, 40];
    if (Math.abs(x - 0.6 * y - 0.2 * width) < 5) return [200, 195, 180];
    const field = (Math.floor(x / 90) * 7 + Math.floor(y / 70) * 3) % 5;
    return [70 + 14 * field + (x * 13 + y * 7) % 9, 105 + 9 * field + (x * 5 + y * 11) % 9, 60 + 6 * field];
  };
}
