//! Breaks logs as power cuts, bad storage and malice do.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Damage to a file. Places are parts of the file's length, so that they fit any.
#[derive(Clone, Debug)]
pub enum Damage {
    /// A bit is turned over.
    Flip(f64, u8),
    /// Bytes are replaced.
    Write(f64, Vec<u8>),
    /// Bytes come in between.
    Insert(f64, Vec<u8>),
    /// The file ends here.
    Truncate(f64),
    /// Bytes in between are lost.
    Lose(f64, f64),
    /// Bytes between the first two places stand there twice, the second time at the third place.
    Repeat(f64, f64, f64),
    /// The file goes on as another one does from its second place on.
    Splice(f64, f64),
}

/// Does the damage. `other` is what splices go on with.
pub fn apply(bytes: &mut Vec<u8>, damage: &Damage, other: &[u8]) {
    let place = |part: f64, length: usize| ((part * length as f64) as usize).min(length);
    let length = bytes.len();
    let span = |a: f64, b: f64| {
        let (a, b) = (place(a, length), place(b, length));
        a.min(b)..a.max(b)
    };
    match damage {
        Damage::Flip(at, bit) => {
            if let Some(byte) = bytes.get_mut(place(*at, length)) {
                *byte ^= 1 << (bit & 7);
            }
        }
        Damage::Write(at, new) => {
            let old = bytes[place(*at, length)..].iter_mut();
            old.zip(new).for_each(|(old, new)| *old = *new);
        }
        Damage::Insert(at, new) => {
            let at = place(*at, length);
            bytes.splice(at..at, new.iter().copied());
        }
        Damage::Truncate(at) => bytes.truncate(place(*at, length)),
        Damage::Lose(a, b) => {
            bytes.drain(span(*a, *b));
        }
        Damage::Repeat(a, b, at) => {
            let again = bytes[span(*a, *b)].to_vec();
            let at = place(*at, length);
            bytes.splice(at..at, again);
        }
        Damage::Splice(at, from) => {
            bytes.truncate(place(*at, length));
            bytes.extend(&other[place(*from, other.len())..]);
        }
    }
}

/// Bytes that readers may stumble over: limits, marks of formats, words of text.
const STUMBLES: [&[u8]; 28] = [
    &[0],
    &[0x7f],
    &[0x80],
    &[0xff],
    &[0xff, 0xff],
    &[0, 0, 0, 0x80],
    &[0xff; 8],
    &[0, 0, 0xc0, 0x7f],
    &[0xa3, 0x95],
    &[0xa3, 0x95, 0x80],
    &[0xa3],
    &[0xfe, 0xff],
    &[0xfd, 0],
    b"ULog",
    b"#",
    b"Z",
    b"a",
    b"\n",
    b"\r\n",
    b",",
    b", ",
    b",,,,",
    b"nan",
    b"-1e999",
    b"99999999999999999999999999999999999999999",
    b"AUTO",
    b"FMT, ",
    b"\xc2\xb0",
];

/// Something that may happen to a file of which `seams` are places between its messages, as parts of its
/// length.
pub fn draw(random: &mut ChaCha8Rng, seams: &[f64]) -> Damage {
    let place = |random: &mut ChaCha8Rng| {
        let anywhere = random.random::<f64>();
        match seams.get((random.random::<f64>() * 2.0 * seams.len() as f64) as usize) {
            Some(seam) => *seam,
            None => anywhere,
        }
    };
    let at = place(random);
    match random.random_range(0..12_u8) {
        0..3 => Damage::Flip(random.random(), random.random()),
        3 => Damage::Flip(
            (at + random.random_range(0.0..0.02)).min(1.0),
            random.random(),
        ),
        4..6 => Damage::Write(random.random(), bytes(random)),
        6 => Damage::Write(at, bytes(random)),
        7 => Damage::Insert(at, bytes(random)),
        8 => Damage::Truncate(random.random()),
        9 => Damage::Lose(at, near(at, random)),
        10 => Damage::Repeat(at, near(at, random), place(random)),
        _ => Damage::Splice(at, random.random()),
    }
}

/// A place not far away.
fn near(at: f64, random: &mut ChaCha8Rng) -> f64 {
    (at + random.random_range(-0.2..0.2)).clamp(0.0, 1.0)
}

fn bytes(random: &mut ChaCha8Rng) -> Vec<u8> {
    if random.random_range(0..4_u8) == 0 {
        let count = random.random_range(1..20_usize);
        return (0..count).map(|_| random.random()).collect();
    }
    STUMBLES[random.random_range(0..STUMBLES.len())].to_vec()
}
