//! From unpacked bytes to samples.

use super::{SampleKind, TiffLayout};

/// Samples of a tile, pixel by pixel.
#[derive(Clone, Debug, PartialEq)]
pub enum TileSamples {
    /// 8 bits, and fewer.
    U8(Vec<u8>),
    /// 8 bits with a sign.
    I8(Vec<i8>),
    /// 16 bits, and 9 to 15.
    U16(Vec<u16>),
    /// 16 bits with a sign.
    I16(Vec<i16>),
    /// 32 bits.
    U32(Vec<u32>),
    /// 32 bits with a sign.
    I32(Vec<i32>),
    /// 64 bits.
    U64(Vec<u64>),
    /// 64 bits with a sign.
    I64(Vec<i64>),
    /// Real numbers of 16 or 32 bits; the former fit into the latter exactly.
    F32(Vec<f32>),
    /// Real numbers of 64 bits.
    F64(Vec<f64>),
}

/// A decoded tile or strip; its right and lower margin may lie outside the image.
#[derive(Clone, Debug, PartialEq)]
pub struct Chunk {
    /// Pixels of a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Samples of a pixel.
    pub samples_per_pixel: usize,
    /// All samples, row by row, those of a pixel together.
    pub samples: TileSamples,
}

impl TileSamples {
    /// Number of samples.
    pub fn len(&self) -> usize {
        match self {
            Self::U8(v) => v.len(),
            Self::I8(v) => v.len(),
            Self::U16(v) => v.len(),
            Self::I16(v) => v.len(),
            Self::U32(v) => v.len(),
            Self::I32(v) => v.len(),
            Self::U64(v) => v.len(),
            Self::I64(v) => v.len(),
            Self::F32(v) => v.len(),
            Self::F64(v) => v.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Value of a sample as a real number, whole numbers beyond 2⁵³ rounded; panics outside.
    pub fn real(&self, index: usize) -> f64 {
        match self {
            Self::U8(v) => f64::from(v[index]),
            Self::I8(v) => f64::from(v[index]),
            Self::U16(v) => f64::from(v[index]),
            Self::I16(v) => f64::from(v[index]),
            Self::U32(v) => f64::from(v[index]),
            Self::I32(v) => f64::from(v[index]),
            Self::U64(v) => v[index] as f64,
            Self::I64(v) => v[index] as f64,
            Self::F32(v) => f64::from(v[index]),
            Self::F64(v) => v[index],
        }
    }

    /// Interleaves the samples of several planes of the same length.
    pub(super) fn interleaved(planes: Vec<Self>) -> Option<Self> {
        /// Takes the vectors of one variant out of `planes` and weaves them.
        macro_rules! weave {
            ($variant:ident) => {{
                let planes: Option<Vec<_>> = planes
                    .into_iter()
                    .map(|p| match p {
                        Self::$variant(v) => Some(v),
                        _ => None,
                    })
                    .collect();
                let planes = planes?;
                let length = planes.iter().map(Vec::len).min()?;
                let mut woven = Vec::with_capacity(length * planes.len());
                for i in 0..length {
                    woven.extend(planes.iter().map(|p| p[i]));
                }
                Some(Self::$variant(woven))
            }};
        }
        match planes.first()? {
            Self::U8(_) => weave!(U8),
            Self::I8(_) => weave!(I8),
            Self::U16(_) => weave!(U16),
            Self::I16(_) => weave!(I16),
            Self::U32(_) => weave!(U32),
            Self::I32(_) => weave!(I32),
            Self::U64(_) => weave!(U64),
            Self::I64(_) => weave!(I64),
            Self::F32(_) => weave!(F32),
            Self::F64(_) => weave!(F64),
        }
    }
}

/// The samples of `rows` rows of `width` pixels in `bytes`, which has exactly their length.
pub(super) fn from_bytes(layout: &TiffLayout, mut bytes: Vec<u8>, width: usize) -> TileSamples {
    let together = layout.samples_together();
    let row = layout.kind.row_bytes(width * together);
    let is_little_endian = layout.is_little_endian;
    if layout.predictor == 3 {
        let size = layout.kind.bits() / 8;
        for row in bytes.chunks_exact_mut(row) {
            undo_real_differences(row, together, size);
        }
        // What comes out of the predictor begins with the most significant byte.
        return match layout.kind {
            SampleKind::F64 => TileSamples::F64(words(&bytes, false, f64::from_bits)),
            SampleKind::F16 => TileSamples::F32(words(&bytes, false, half)),
            _ => TileSamples::F32(words(&bytes, false, |w: u32| f32::from_bits(w))),
        };
    }
    let step = (layout.predictor == 2).then_some((width * together, together));
    /// Words of the bytes, differences undone.
    macro_rules! whole {
        ($word:ty, $sample:ty) => {{
            let mut samples: Vec<$word> = words(&bytes, is_little_endian, |w: $word| w);
            if let Some((row, together)) = step {
                for row in samples.chunks_exact_mut(row.max(1)) {
                    for i in together..row.len() {
                        row[i] = row[i].wrapping_add(row[i - together]);
                    }
                }
            }
            samples
        }};
    }
    match layout.kind {
        SampleKind::Bits(bits) => {
            let rows = bytes.chunks_exact(row.max(1));
            let samples = rows.flat_map(|row| (0..width * together).map(|i| of_bits(row, i, bits)));
            if bits <= 8 {
                TileSamples::U8(samples.map(|sample| sample as u8).collect())
            } else {
                TileSamples::U16(samples.collect())
            }
        }
        SampleKind::U8 => TileSamples::U8(whole!(u8, u8)),
        SampleKind::I8 => TileSamples::I8(whole!(u8, i8).into_iter().map(|v| v as i8).collect()),
        SampleKind::U16 => TileSamples::U16(whole!(u16, u16)),
        SampleKind::I16 => {
            TileSamples::I16(whole!(u16, i16).into_iter().map(|v| v as i16).collect())
        }
        SampleKind::U32 => TileSamples::U32(whole!(u32, u32)),
        SampleKind::I32 => {
            TileSamples::I32(whole!(u32, i32).into_iter().map(|v| v as i32).collect())
        }
        SampleKind::U64 => TileSamples::U64(whole!(u64, u64)),
        SampleKind::I64 => {
            TileSamples::I64(whole!(u64, i64).into_iter().map(|v| v as i64).collect())
        }
        SampleKind::F16 => TileSamples::F32(whole!(u16, f32).into_iter().map(half).collect()),
        SampleKind::F32 => {
            TileSamples::F32((whole!(u32, f32).into_iter()).map(f32::from_bits).collect())
        }
        SampleKind::F64 => {
            TileSamples::F64((whole!(u64, f64).into_iter()).map(f64::from_bits).collect())
        }
    }
}

/// The sample of `bits` bits, 1 to 15, with that index in a row.
fn of_bits(row: &[u8], index: usize, bits: u8) -> u16 {
    let first = index * usize::from(bits);
    // Up to three bytes hold a sample.
    let window = (0..3).fold(0_u32, |sum, i| {
        sum << 8 | u32::from(row.get(first / 8 + i).copied().unwrap_or(0))
    });
    let shift = 24 - first % 8 - usize::from(bits);
    (window >> shift & ((1 << bits) - 1)) as u16
}

/// The real number whose sixteen bits are `bits`: one sign, five of the exponent with the bias 15, ten
/// of the fraction (IEEE 754, binary16).
fn half(bits: u16) -> f32 {
    let fraction = f32::from(bits & 0x3ff) / 1024.0;
    let size = match bits >> 10 & 0x1f {
        0 => fraction * 2.0_f32.powi(-14),
        31 if fraction == 0.0 => f32::INFINITY,
        31 => f32::NAN,
        exponent => (1.0 + fraction) * 2.0_f32.powi(i32::from(exponent) - 15),
    };
    if bits & 0x8000 == 0 { size } else { -size }
}

/// A number of some bytes.
trait Word: Copy {
    /// Bytes of the number.
    const SIZE: usize;
    /// The number from its bytes.
    fn from_slice(bytes: &[u8], is_little_endian: bool) -> Self;
}

/// Implements [`Word`] for whole numbers.
macro_rules! word {
    ($($kind:ty),*) => {$(
        impl Word for $kind {
            const SIZE: usize = size_of::<$kind>();
            fn from_slice(bytes: &[u8], is_little_endian: bool) -> Self {
                let mut own = [0; size_of::<$kind>()];
                own.copy_from_slice(bytes);
                if is_little_endian {
                    Self::from_le_bytes(own)
                } else {
                    Self::from_be_bytes(own)
                }
            }
        }
    )*};
}

word!(u8, u16, u32, u64);

fn words<W: Word, T>(bytes: &[u8], is_little_endian: bool, make: impl Fn(W) -> T) -> Vec<T> {
    (bytes.chunks_exact(W::SIZE))
        .map(|word| make(W::from_slice(word, is_little_endian)))
        .collect()
}

/// Undoes the predictor of reals in one row: differences of bytes, most significant bytes of all
/// samples first (Adobe's technical note 3 on TIFF).
fn undo_real_differences(row: &mut [u8], together: usize, size: usize) {
    for i in together..row.len() {
        row[i] = row[i].wrapping_add(row[i - together]);
    }
    let count = row.len() / size;
    let planes = row.to_vec();
    for sample in 0..count {
        for byte in 0..size {
            row[sample * size + byte] = planes[byte * count + sample];
        }
    }
}
