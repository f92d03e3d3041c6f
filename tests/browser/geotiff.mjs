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

/**
 * A map of any size in a small file: uncompressed tiles of 512 pixels, of which the tables of all levels
 * point again and again at the same few. `pixel(tile, x, y)` gives three samples of one of them.
 */
export function repeatingGeotiff({ width, height, gsd, east, north, tiles, pixel }) {
  const side = 512;
  const pixels = Buffer.alloc(tiles * side * side * 3);
  for (let tile = 0, at = 0; tile < tiles; tile += 1) {
    for (let y = 0; y < side; y += 1) for (let x = 0; x < side; x += 1) for (const sample of pixel(tile, x, y)) at = pixels.writeUInt8(sample, at);
  }
  const parts = [Buffer.alloc(8), pixels];
  let length = 8 + pixels.length;
  const add = (bytes) => { const at = length; parts.push(bytes); length += bytes.length; return at; };
  const header = parts[0];
  header.write("II*\0", "latin1");
  let pointer = [header, 4];
  for (let factor = 1; ; factor *= 2) {
    const [w, h] = [Math.ceil(width / factor), Math.ceil(height / factor)];
    const [across, down] = [Math.ceil(w / side), Math.ceil(h / side)];
    const chosen = Array.from({ length: across * down }, (_, i) => (7 * (i % across) + 3 * Math.floor(i / across) + factor) % tiles);
    const place = { 33550: [12, [gsd, gsd, 0]], 33922: [12, [0, 0, 0, east, north, 0]], 34735: [3, [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32615]] };
    const all = {
      254: [4, [factor > 1 ? 1 : 0]], 256: [4, [w]], 257: [4, [h]], 258: [3, [8, 8, 8]], 259: [3, [1]], 262: [3, [2]], 277: [3, [3]],
      322: [3, [side]], 323: [3, [side]], 324: [4, chosen.map((tile) => 8 + tile * side * side * 3)], 325: [4, chosen.map(() => side * side * 3)],
      ...(factor > 1 ? {} : place),
    };
    const entries = Object.entries(all).map(([tag, [kind, list]]) => {
      const body = values(kind, list);
      const entry = Buffer.alloc(12);
      entry.writeUInt16LE(Number(tag), 0);
      entry.writeUInt16LE(kind, 2);
      entry.writeUInt32LE(list.length, 4);
      if (body.length <= 4) body.copy(entry, 8);
      else entry.writeUInt32LE(add(body.length % 2 ? Buffer.concat([body, Buffer.alloc(1)]) : body), 8);
      return entry;
    });
    const head = Buffer.alloc(2);
    head.writeUInt16LE(entries.length);
    const end = Buffer.alloc(4);
    pointer[0].writeUInt32LE(length, pointer[1]);
    add(Buffer.concat([head, ...entries]));
    add(end);
    pointer = [end, 0];
    if (across * down === 1) return Buffer.concat(parts);
  }
}
