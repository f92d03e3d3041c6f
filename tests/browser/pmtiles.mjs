// A small PMTiles archive (version 3) for journeys.

/** An archive of the one tile of zoom 0, a PNG of 128 to 16,383 bytes, with who made it. */
export function pmtiles(tile) {
  const about = Buffer.from(JSON.stringify({ attribution: "<b>&copy; Whoever</b>" }));
  // One entry: tile 0, a run of 1, its length in two groups of seven bits, the first offset.
  const root = Buffer.from([1, 0, 1, (tile.length & 0x7f) | 0x80, tile.length >> 7, 1]);
  const header = Buffer.alloc(127);
  header.write("PMTiles\x03", "latin1");
  const described = 127 + root.length;
  const data = described + about.length;
  [[127, root.length], [described, about.length], [data, 0], [data, tile.length]].flat()
    .forEach((value, i) => header.writeBigUInt64LE(BigInt(value), 8 + 8 * i));
  // Neither compressed; PNG; zoom 0 only.
  Buffer.from([1, 1, 2, 0, 0]).copy(header, 97);
  [-92.1, 46.84, -92.06, 46.87].forEach((degrees, i) => header.writeInt32LE(Math.round(degrees * 1e7), 102 + 4 * i));
  return Buffer.concat([header, root, about, tile]);
}
