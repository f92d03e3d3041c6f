// Films with nothing but GoPro's track of places: a payload a second, each of ten places with their fix.

const words = (...numbers) => Buffer.concat(numbers.map((n) => { const b = Buffer.alloc(4); b.writeInt32BE(n | 0); return b; }));
const box = (kind, ...parts) => { const all = Buffer.concat(parts); return Buffer.concat([words(all.length + 8), Buffer.from(kind), all]); };

/** A piece of the track: its key, the kind of its values and the bytes of one, filled up to four bytes. */
function piece(key, kind, size, data) {
  const head = Buffer.from([...Buffer.from(key), kind.charCodeAt(0), size, (data.length / size) >> 8, (data.length / size) & 255]);
  return Buffer.concat([head, data, Buffer.alloc(-data.length & 3)]);
}

/** Ten places a second to the north at 10 m/s, 30 m above 47.3° N, 8.5° E at `second`. */
function payload(second) {
  const rows = Array.from({ length: 10 }, (_, i) => words(473000000 + 90 * (10 * second + i), 85000000, 450000, 10000, 1000));
  const stream = Buffer.concat([
    piece("GPSF", "L", 4, words(3)),
    piece("SCAL", "l", 4, words(10000000, 10000000, 1000, 1000, 100)),
    piece("GPS5", "l", 20, Buffer.concat(rows)),
  ]);
  return piece("DEVC", "\0", 1, piece("STRM", "\0", 1, stream));
}

/** The bytes of a film of so many seconds. */
export function gopro(seconds) {
  const head = box("ftyp", Buffer.from("mp41"));
  const payloads = Array.from({ length: seconds }, (_, second) => payload(second));
  const table = box("stbl",
    box("stsd", words(0, 1, 16), Buffer.from("gpmd"), Buffer.alloc(8)),
    box("stts", words(0, 1, seconds, 1000)),
    box("stsc", words(0, 1, 1, seconds, 1)),
    box("stsz", words(0, 0, seconds, ...payloads.map((p) => p.length))),
    box("stco", words(0, 1, head.length + 8)));
  const track = box("trak", box("mdia", box("mdhd", words(0, 0, 0, 1000, 0, 0)), box("minf", table)));
  return Buffer.concat([head, box("mdat", ...payloads), box("moov", track)]);
}
