//! Chunks of an AVI file (RIFF), one after another.

use std::ops::Range;

/// Bytes of a chunk before its data: name and length.
const FRAME: usize = 8;
/// Longest chunk that is believed, bytes, but for those that hold others.
const LONGEST: u32 = 64 << 20;

/// Chunk at the beginning of some bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum AviChunk {
    /// More bytes are needed to tell.
    Later,
    /// So many bytes that are no picture.
    Passed(usize),
    /// A picture: its number in the video, where its data are, and all bytes of its chunk.
    Picture {
        number: u64,
        data: Range<usize>,
        whole: usize,
    },
    /// So many bytes that make no sense.
    Broken(usize),
}

/// State of reading a file.
#[derive(Clone, Debug, Default)]
pub(super) struct Avi {
    /// The stream whose pictures came first.
    video: Option<u8>,
    /// Seconds a picture: scale over rate of the stream, or microseconds of the file.
    scale: Option<(u32, u32)>,
    microseconds: u32,
    pictures: u64,
    /// Whether the next chunk has to be looked for.
    is_lost: bool,
}

impl Avi {
    /// Pictures a second, where the file says so.
    pub fn rate(&self) -> Option<f64> {
        let of_stream = self
            .scale
            .map(|(scale, rate)| f64::from(rate) / f64::from(scale));
        let of_file = (self.microseconds > 0).then(|| 1e6 / f64::from(self.microseconds));
        of_stream
            .or(of_file)
            .filter(|rate| rate.is_finite() && *rate > 0.0)
    }

    /// The chunk that begins here. Where `over`, no more bytes will come.
    pub fn next(&mut self, bytes: &[u8], over: bool) -> AviChunk {
        if self.is_lost {
            return self.search(bytes, over);
        }
        let Some((name, length)) = frame(bytes) else {
            return if over { self.lose() } else { AviChunk::Later };
        };
        if matches!(&name, b"RIFF" | b"LIST") {
            return self.list(bytes, over);
        }
        if !is_name(&name) || length > LONGEST {
            return self.lose();
        }
        // Chunks begin at even places.
        let end = FRAME + length as usize;
        let whole = end + end % 2;
        let Some(behind) = bytes.get(whole..) else {
            return self.short(bytes, end, over);
        };
        match frame(behind) {
            Some((next, _)) if !is_name(&next) => return self.lose(),
            None if !over => return AviChunk::Later,
            _ => {}
        }
        self.chunk(name, bytes, end, whole)
    }

    /// A chunk that the bytes there are do not hold with its padding.
    fn short(&mut self, bytes: &[u8], end: usize, over: bool) -> AviChunk {
        match frame(bytes) {
            _ if !over => AviChunk::Later,
            Some((name, _)) if bytes.len() >= end => self.chunk(name, bytes, end, bytes.len()),
            _ => self.lose(),
        }
    }

    fn chunk(&mut self, name: [u8; 4], bytes: &[u8], end: usize, whole: usize) -> AviChunk {
        let data = &bytes[FRAME..end];
        let word = |at: usize| {
            let bytes = data.get(at..at + 4).and_then(|b| b.first_chunk());
            bytes.map_or(0, |bytes| u32::from_le_bytes(*bytes))
        };
        match &name {
            b"avih" => self.microseconds = word(0),
            b"strh" if data.starts_with(b"vids") && self.scale.is_none() => {
                let (scale, rate) = (word(20), word(24));
                self.scale = (scale > 0 && rate > 0).then_some((scale, rate));
            }
            [tens @ b'0'..=b'9', ones @ b'0'..=b'9', b'd', b'c' | b'b'] => {
                let stream = 10 * (tens - b'0') + (ones - b'0');
                if *self.video.get_or_insert(stream) == stream {
                    let number = self.pictures;
                    self.pictures += 1;
                    // An empty one says that the picture before stays.
                    if data.is_empty() {
                        return AviChunk::Passed(whole);
                    }
                    return AviChunk::Picture {
                        number,
                        data: FRAME..end,
                        whole,
                    };
                }
            }
            _ => {}
        }
        AviChunk::Passed(whole)
    }

    /// A list, or the file itself: what is in it follows like anything else.
    fn list(&mut self, bytes: &[u8], over: bool) -> AviChunk {
        match bytes.get(FRAME..FRAME + 4) {
            Some(kind) if is_name(kind) => AviChunk::Passed(FRAME + 4),
            None if !over => AviChunk::Later,
            _ => self.lose(),
        }
    }

    fn lose(&mut self) -> AviChunk {
        self.is_lost = true;
        AviChunk::Broken(1)
    }

    /// Looks for the next chunk with a picture, or list of such.
    fn search(&mut self, bytes: &[u8], over: bool) -> AviChunk {
        let begins = |bytes: &[u8]| match frame(bytes) {
            Some(([a, b, b'd', b'c' | b'b'], length)) => {
                let is_number = a.is_ascii_digit() && b.is_ascii_digit();
                is_number && length <= LONGEST && bytes[FRAME..].starts_with(&[0xff, 0xd8, 0xff])
            }
            Some(([b'L', b'I', b'S', b'T'], _)) => {
                matches!(bytes.get(FRAME..FRAME + 4), Some(b"movi" | b"rec "))
            }
            _ => false,
        };
        let last = bytes.len().saturating_sub(if over { 0 } else { FRAME + 4 });
        match (0..last).find(|place| begins(&bytes[*place..])) {
            Some(0) => {
                self.is_lost = false;
                self.next(bytes, over)
            }
            Some(place) => {
                self.is_lost = false;
                AviChunk::Broken(place)
            }
            None if last == 0 => AviChunk::Later,
            None => AviChunk::Broken(last),
        }
    }
}

/// Name and length of the chunk that `bytes` begin with; `None` if more are needed.
fn frame(bytes: &[u8]) -> Option<([u8; 4], u32)> {
    let (name, rest) = bytes.split_first_chunk()?;
    Some((*name, u32::from_le_bytes(*rest.first_chunk()?)))
}

/// Whether it is made of the letters that names are made of.
fn is_name(name: &[u8]) -> bool {
    name.iter()
        .all(|b| b.is_ascii_alphanumeric() || *b == b' ' || *b == b'_')
}
