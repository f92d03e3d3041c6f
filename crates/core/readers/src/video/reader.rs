//! From picture to picture through a file.

use super::avi::{Avi, AviChunk};
use super::jpeg::{End, Scan, size};
use crate::log::ReadReport;

/// Longest picture, in bytes.
const LONGEST: usize = 64 << 20;
/// Bytes that are put beside those that wait at one time.
const PIECE: usize = 1 << 16;
/// First bytes of every JPEG: its mark and that of its first segment.
const BEGINNING: [u8; 3] = [0xff, 0xd8, 0xff];

/// Place of a picture in its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlacedPicture {
    /// Number of the picture in the video, counted from zero; numbers of pictures that are missing are left out.
    pub number: u64,
    /// First byte.
    pub offset: u64,
    /// Bytes.
    pub length: usize,
}

/// Pictures of a video.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VideoIndex {
    /// Its pictures in order.
    pub pictures: Vec<PlacedPicture>,
    /// Pictures a second, where the file says so.
    pub rate: Option<f64>,
    /// Width and height of the first picture, pixels.
    pub size: Option<(usize, usize)>,
    /// Report of the bytes read and skipped.
    pub report: ReadReport,
}

/// Whether a file that begins so holds JPEGs one after another: AVI with motion JPEG, the pictures by themselves, or
/// with lines of text between them as cameras send them. A single JPEG begins so as well.
pub fn is_motion_jpeg(head: &[u8]) -> bool {
    let is_avi = head.starts_with(b"RIFF") && head.get(8..12) == Some(b"AVI ");
    if is_avi {
        return head
            .windows(4)
            .any(|word| word.eq_ignore_ascii_case(b"MJPG"));
    }
    let is_sent = head.starts_with(b"--") && head.windows(10).any(|word| word == b"image/jpeg");
    head.starts_with(&BEGINNING) || is_sent
}

/// Notes where the pictures of a file lie, which it is fed piece by piece.
///
/// Whatever the bytes are, it never panics and never stops for good; what makes no sense is skipped up to the next
/// picture and noted.
#[derive(Default)]
pub struct MotionJpegReader {
    index: VideoIndex,
    /// Bytes that came and are not done with, behind `done` bytes that are.
    waiting: Vec<u8>,
    done: usize,
    offset: u64,
    form: FilmForm,
    scan: Scan,
}

#[derive(Default)]
enum FilmForm {
    #[default]
    Unknown,
    Avi(Avi),
    Bare,
}

enum FilmStep {
    Wait,
    Took(usize),
}

impl MotionJpegReader {
    /// Takes the next bytes of the file, of any number.
    pub fn feed(&mut self, bytes: &[u8]) {
        for piece in bytes.chunks(PIECE) {
            if self.done >= self.waiting.len() - self.done {
                self.waiting.drain(..self.done);
                self.done = 0;
            }
            self.waiting.extend_from_slice(piece);
            self.index.report.bytes += piece.len() as u64;
            self.walk(false);
        }
    }

    /// Index of the file's pictures, after its end.
    pub fn finish(mut self) -> VideoIndex {
        self.walk(true);
        self.index
    }

    /// Index of the pictures found so far.
    pub fn so_far(&self) -> &VideoIndex {
        &self.index
    }

    fn walk(&mut self, over: bool) {
        let waiting = std::mem::take(&mut self.waiting);
        while self.done < waiting.len() {
            let bytes = &waiting[self.done..];
            let took = match self.step(bytes, over) {
                FilmStep::Took(count) => count.clamp(1, bytes.len()),
                FilmStep::Wait if over => {
                    self.skip(bytes.len(), "the file ends too early");
                    bytes.len()
                }
                FilmStep::Wait => break,
            };
            self.done += took;
            self.offset += took as u64;
            self.scan = Scan::default();
        }
        self.waiting = waiting;
    }

    fn step(&mut self, bytes: &[u8], over: bool) -> FilmStep {
        match &mut self.form {
            FilmForm::Unknown => {
                if bytes.len() < 12 && !over {
                    return FilmStep::Wait;
                }
                let is_avi = bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"AVI ");
                self.form = if is_avi {
                    FilmForm::Avi(Avi::default())
                } else {
                    FilmForm::Bare
                };
                self.step(bytes, over)
            }
            FilmForm::Avi(_) => self.step_avi(bytes, over),
            FilmForm::Bare => self.step_bare(bytes, over),
        }
    }

    fn skip(&mut self, bytes: usize, cause: &str) {
        self.index.report.skip(self.offset, bytes as u64, cause);
    }

    fn used(&mut self, bytes: usize) -> FilmStep {
        self.index.report.used_bytes += bytes as u64;
        FilmStep::Took(bytes)
    }

    fn picture(&mut self, number: u64, offset: u64, jpeg: &[u8]) {
        if self.index.size.is_none() {
            self.index.size = size(jpeg);
        }
        self.index.report.messages += 1;
        self.index.pictures.push(PlacedPicture {
            number,
            offset,
            length: jpeg.len(),
        });
    }

    fn step_avi(&mut self, bytes: &[u8], over: bool) -> FilmStep {
        let FilmForm::Avi(avi) = &mut self.form else {
            return FilmStep::Wait;
        };
        match avi.next(bytes, over) {
            AviChunk::Later => FilmStep::Wait,
            AviChunk::Passed(count) => {
                self.index.rate = avi.rate();
                self.used(count)
            }
            AviChunk::Picture {
                number,
                data,
                whole,
            } => {
                let (Some(jpeg), true) = (bytes.get(data.clone()), data.len() <= LONGEST) else {
                    return FilmStep::Wait;
                };
                if jpeg.starts_with(&BEGINNING) {
                    let offset = self.offset + data.start as u64;
                    self.picture(number, offset, jpeg);
                    return self.used(whole);
                }
                self.skip(whole, "a picture that is no JPEG");
                FilmStep::Took(whole)
            }
            AviChunk::Broken(count) => {
                self.skip(count, "no chunk of an AVI begins here");
                FilmStep::Took(count)
            }
        }
    }

    fn step_bare(&mut self, bytes: &[u8], over: bool) -> FilmStep {
        let Some(start) = bytes.windows(3).position(|b| b == BEGINNING) else {
            // The last two may be the beginning of the next picture.
            let count = if over {
                bytes.len()
            } else {
                bytes.len().saturating_sub(2)
            };
            return if count == 0 {
                FilmStep::Wait
            } else {
                self.between(&bytes[..count])
            };
        };
        if start > 0 {
            return self.between(&bytes[..start]);
        }
        match self.scan.end(bytes) {
            End::At(length) => {
                let number = self.index.pictures.len() as u64;
                self.picture(number, self.offset, &bytes[..length]);
                self.used(length)
            }
            End::Later if bytes.len() <= LONGEST && !over => FilmStep::Wait,
            End::Later => {
                self.skip(2, "a picture without an end");
                FilmStep::Took(2)
            }
            End::Broken(count) => {
                self.skip(count, "a broken picture");
                FilmStep::Took(count)
            }
        }
    }

    /// Passes over what stands between pictures: text that a camera sends, or nonsense.
    fn between(&mut self, bytes: &[u8]) -> FilmStep {
        let is_text = |b: &u8| b.is_ascii_graphic() || b.is_ascii_whitespace() || *b == 0;
        let begins_with_text = is_text(&bytes[0]);
        let count = bytes
            .iter()
            .take_while(|b| is_text(b) == begins_with_text)
            .count();
        if begins_with_text {
            return self.used(count);
        }
        self.skip(count, "no picture begins here");
        FilmStep::Took(count)
    }
}
