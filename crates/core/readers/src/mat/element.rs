//! Elements of a MATLAB file: tag, length, data.

use std::borrow::Cow;
use std::io::Read;

use flate2::bufread::ZlibDecoder;

/// Bytes of the header before the first element.
const HEADER: usize = 128;
/// Most bytes that one compressed element is unpacked to.
pub const MOST: u64 = 1 << 30;
/// Bytes in which an array tells its class, its size and its name.
const HEADED: usize = 512;
/// Type of a compressed element.
const COMPRESSED: u32 = 15;
/// Type of an element that is an array.
pub const ARRAY: u32 = 14;

/// An element.
#[derive(Clone, Debug)]
pub struct MatElement<'a> {
    /// Type of its data.
    pub kind: u32,
    /// Its data.
    pub data: Cow<'a, [u8]>,
    /// Whether numbers have their largest byte first.
    pub is_big: bool,
}

/// A number of two or four bytes.
pub fn number(bytes: &[u8], is_big: bool) -> u32 {
    let one = |value: u32, byte: &u8| value << 8 | u32::from(*byte);
    if is_big {
        bytes.iter().fold(0, one)
    } else {
        bytes.iter().rev().fold(0, one)
    }
}

/// The elements of a file in their order.
#[derive(Debug, Default)]
pub struct MatElements<'a> {
    /// Those that were read, unpacked where they are compressed.
    pub all: Vec<MatElement<'a>>,
    /// The beginnings of those that were left out, as they are too large once they are unpacked.
    pub too_large: Vec<MatElement<'a>>,
    /// Whether the file is cut off or damaged behind them.
    pub is_damaged: bool,
}

/// The elements of a file one after the other, without those of `most` bytes or more once they are unpacked; `None` if it is
/// no such file. Ends before what is cut off or damaged.
pub fn elements(bytes: &[u8], most: u64) -> Option<MatElements<'_>> {
    let mark = bytes.get(126..HEADER)?;
    let is_big = match mark {
        b"IM" => false,
        b"MI" => true,
        _ => return None,
    };
    let version = number(bytes.get(124..126)?, is_big);
    if version >> 8 != 1 {
        return None;
    }
    let (packed, is_whole) = split(&bytes[HEADER..], is_big);
    let mut found = MatElements {
        is_damaged: !is_whole,
        ..MatElements::default()
    };
    for element in packed {
        if element.kind != COMPRESSED {
            found.all.push(element);
            continue;
        }
        let mut data = Vec::new();
        let decoder = ZlibDecoder::new(element.data.as_ref());
        let unpacked = decoder.take(most).read_to_end(&mut data);
        if unpacked.is_ok() && data.len() as u64 == most {
            let head = data.get(8..).unwrap_or_default();
            let head = &head[..head.len().min(HEADED)];
            found.too_large.push(MatElement {
                kind: ARRAY,
                data: Cow::Owned(head.to_vec()),
                is_big,
            });
            continue;
        }
        let Some(inner) = split(&data, is_big)
            .0
            .into_iter()
            .next()
            .filter(|_| unpacked.is_ok())
        else {
            found.is_damaged = true;
            break;
        };
        found.all.push(MatElement {
            kind: inner.kind,
            data: Cow::Owned(inner.data.into_owned()),
            is_big,
        });
    }
    Some(found)
}

/// The elements within others.
pub fn inside<'a>(element: &'a MatElement<'_>) -> Vec<MatElement<'a>> {
    split(&element.data, element.is_big).0
}

/// The elements one after the other, and whether they reach to the end.
fn split(mut bytes: &[u8], is_big: bool) -> (Vec<MatElement<'_>>, bool) {
    let mut elements = Vec::new();
    while let Some(tag) = bytes.get(..8) {
        let first = number(&tag[..4], is_big);
        // Small elements have type and length in four bytes and up to four bytes of data behind them.
        let (kind, start, length): (u32, usize, usize) = if first >> 16 == 0 {
            (first, 8, number(&tag[4..], is_big) as usize)
        } else {
            (first & 0xffff, 4, (first >> 16) as usize)
        };
        let Some(data) = start
            .checked_add(length)
            .and_then(|end| bytes.get(start..end))
        else {
            return (elements, false);
        };
        elements.push(MatElement {
            kind,
            data: Cow::Borrowed(data),
            is_big,
        });
        // Data is filled up to eight bytes, but for that which is compressed.
        let end = if start == 4 {
            8
        } else if kind == COMPRESSED {
            8 + length
        } else {
            8 + length.next_multiple_of(8)
        };
        bytes = bytes.get(end..).unwrap_or_default();
    }
    // Bytes too few for a tag say nothing, but for those that begin an array or a compressed element: it was cut off.
    let begins = number(&bytes[..bytes.len().min(4)], is_big);
    (elements, !matches!(begins, ARRAY | COMPRESSED))
}

impl MatElement<'_> {
    /// Its numbers, whatever they are stored as; `None` if it holds none.
    pub fn numbers(&self) -> Option<Vec<f64>> {
        let size = match self.kind {
            1 | 2 | 16 => 1,
            3 | 4 | 17 => 2,
            5..=7 | 18 => 4,
            9 | 12 | 13 => 8,
            _ => return None,
        };
        let one = |bytes: &[u8]| {
            let mut little = [0_u8; 8];
            for (place, byte) in little.iter_mut().zip(bytes) {
                *place = *byte;
            }
            if self.is_big {
                little[..size].reverse();
            }
            let whole = u64::from_le_bytes(little);
            match self.kind {
                1 => f64::from(little[0].cast_signed()),
                3 => f64::from((whole as u16).cast_signed()),
                5 => f64::from((whole as u32).cast_signed()),
                7 => f64::from(f32::from_bits(whole as u32)),
                9 => f64::from_bits(whole),
                12 => whole.cast_signed() as f64,
                _ => whole as f64,
            }
        };
        Some(self.data.chunks_exact(size).map(one).collect())
    }

    /// Its letters.
    pub fn text(&self) -> String {
        match self.kind {
            4 | 17 => {
                let letters = self.numbers().unwrap_or_default();
                let letters: Vec<u16> = letters.into_iter().map(|letter| letter as u16).collect();
                String::from_utf16_lossy(&letters)
            }
            _ => String::from_utf8_lossy(&self.data).into_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use flate2::Compression;
    use flate2::write::ZlibEncoder;

    use super::*;

    /// An element of doubles, compressed as version 7 writes them.
    fn compressed(numbers: &[f64]) -> Vec<u8> {
        let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        let length = bytes.len() as u32;
        let plain = [
            9_u32.to_le_bytes().as_slice(),
            &length.to_le_bytes(),
            &bytes,
        ]
        .concat();
        let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
        encoder.write_all(&plain).unwrap();
        let data = encoder.finish().unwrap();
        let length = data.len() as u32;
        [
            COMPRESSED.to_le_bytes().as_slice(),
            &length.to_le_bytes(),
            &data,
        ]
        .concat()
    }

    #[test]
    fn an_element_that_is_too_large_once_unpacked_takes_no_other_with_it() {
        let mut file = vec![b' '; HEADER];
        file[124..HEADER].copy_from_slice(&[0, 1, b'I', b'M']);
        file.extend(compressed(&[1.5; 200]));
        file.extend(compressed(&[2.5; 3]));
        let of = |most| {
            let found = elements(&file, most).unwrap();
            assert!(!found.is_damaged);
            (found.all.len(), found.too_large.len())
        };
        assert_eq!((of(MOST), of(200)), ((2, 0), (1, 1)));
        assert_eq!(elements(&file, 200).unwrap().all[0].data.len(), 24);
        file.truncate(file.len() - 4);
        assert!(elements(&file, MOST).unwrap().is_damaged);
    }
}
