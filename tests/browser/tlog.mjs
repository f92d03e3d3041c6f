// Telemetry logs of made-up flights: each message of MAVLink 2 behind the time at which it was received.

/** Checksum of MAVLink (X.25), the extra byte of a message's definition included. */
function checksum(bytes, extra) {
  let crc = 0xffff;
  for (const byte of [...bytes, extra]) {
    let x = (byte ^ crc) & 0xff;
    x ^= (x << 4) & 0xff;
    crc = ((crc >> 8) ^ (x << 8) ^ (x << 3) ^ (x >> 4)) & 0xffff;
  }
  return crc;
}

// Number, extra byte of the checksum, and the fields in the order of the wire.
const MESSAGES = {
  HEARTBEAT: [0, 50, ["u4", "u1", "u1", "u1", "u1", "u1"]],
  GPS_RAW_INT: [24, 24, ["u8", "i4", "i4", "i4", "u2", "u2", "u2", "u2", "u1", "u1"]],
  ATTITUDE: [30, 39, ["u4", "f4", "f4", "f4", "f4", "f4", "f4"]],
  GLOBAL_POSITION_INT: [33, 104, ["u4", "i4", "i4", "i4", "i4", "i2", "i2", "i2", "u2"]],
  VFR_HUD: [74, 20, ["f4", "f4", "f4", "f4", "i2", "u2"]],
};

const WRITE = {
  u1: (b, at, v) => b.writeUInt8(v, at),
  u2: (b, at, v) => b.writeUInt16LE(v, at),
  u4: (b, at, v) => b.writeUInt32LE(v, at),
  u8: (b, at, v) => b.writeBigUInt64LE(BigInt(v), at),
  i2: (b, at, v) => b.writeInt16LE(v, at),
  i4: (b, at, v) => b.writeInt32LE(v, at),
  f4: (b, at, v) => b.writeFloatLE(v, at),
};

let sequence = 0;

function message(name, system, microseconds, values) {
  const [number, extra, kinds] = MESSAGES[name];
  const payload = Buffer.alloc(kinds.reduce((sum, kind) => sum + Number(kind[1]), 0));
  let at = 0;
  kinds.forEach((kind, i) => {
    WRITE[kind](payload, at, kind[0] === "f" ? values[i] : Math.round(values[i]));
    at += Number(kind[1]);
  });
  const head = Buffer.from([payload.length, 0, 0, sequence++ & 0xff, system, 1, number & 0xff, number >> 8, 0]);
  const crc = checksum(Buffer.concat([head, payload]), extra);
  const time = Buffer.alloc(8);
  time.writeBigUInt64BE(BigInt(Math.round(microseconds)));
  return Buffer.concat([time, Buffer.from([0xfd]), head, payload, Buffer.from([crc & 0xff, crc >> 8])]);
}

/**
 * A telemetry log of airplanes that fly straight on at 20 m/s and 100 m for a minute; each is
 * {system, latitude, longitude (degrees), heading (radians)}.
 */
export function tlog(vehicles) {
  const pieces = [];
  const began = 1.7e15;
  for (let tick = 0; tick < 300; tick++) {
    for (const { system, latitude, longitude, heading } of vehicles) {
      const seconds = tick / 5;
      const now = began + 1e6 * seconds;
      const add = (name, values) => pieces.push(message(name, system, now, values));
      const boot = 1000 * (10 + seconds);
      const [north, east] = [20 * seconds * Math.cos(heading), 20 * seconds * Math.sin(heading)];
      const lat = 1e7 * (latitude + north / 111_200);
      const lon = 1e7 * (longitude + east / (111_300 * Math.cos((Math.PI / 180) * latitude)));
      const [vn, ve] = [2000 * Math.cos(heading), 2000 * Math.sin(heading)];
      const course = (18_000 / Math.PI) * heading;
      if (tick % 5 === 0) add("HEARTBEAT", [10, 1, 3, 0x81, 4, 3]);
      add("GPS_RAW_INT", [1000 * boot, lat, lon, 500_000, 80, 120, 2000, course, 3, 12]);
      add("GLOBAL_POSITION_INT", [boot, lat + 30, lon, 500_000, 100_000, vn, ve, 0, course]);
      add("ATTITUDE", [boot, 0.01 * Math.sin(seconds), 0.03 + 0.01 * Math.cos(seconds), heading + 0.02 * Math.sin(seconds / 3), 0.001, 0.002, 0.003 * Math.cos(seconds)]);
      add("VFR_HUD", [20 + 0.3 * Math.sin(seconds), 20, 500, 0.1, course / 100, 55]);
    }
  }
  return Buffer.concat(pieces);
}
