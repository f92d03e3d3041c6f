//! A video of JPEGs, opened.

use std::sync::Arc;

use super::huffman::with_tables;
use super::reader::{MotionJpegReader, VideoIndex};
use pilotage_base::bytes::ByteSource;
use pilotage_flight::{FrameError, FrameSource, SharedFrames};
use pilotage_raster::raster::{Picture, decode_picture};

/// Bytes that are read at a time.
const PIECE: u64 = 4 << 20;

/// Why a video cannot be opened.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum VideoError {
    /// Its bytes cannot be had.
    #[error("{file}: {cause}")]
    Read {
        /// File.
        file: String,
        /// Why, in words.
        cause: String,
    },
    /// There is no picture in it.
    #[error("{file}: there is no JPEG picture in it")]
    NoPictures {
        /// File.
        file: String,
    },
}

/// The pictures of a video, read and decoded when they are asked for.
#[derive(Clone)]
pub struct MotionJpeg {
    source: Arc<dyn ByteSource>,
    index: Arc<VideoIndex>,
}

/// Looks through a file for its pictures, all at once.
pub fn open_motion_jpeg(source: Arc<dyn ByteSource>) -> Result<MotionJpeg, VideoError> {
    let mut reader = MotionJpegReader::default();
    let mut offset = 0;
    while offset < source.length() {
        let count = PIECE.min(source.length() - offset);
        let bytes = source.read(offset, count as usize);
        let bytes = bytes.map_err(|cause| VideoError::Read {
            file: source.name().to_owned(),
            cause,
        })?;
        reader.feed(&bytes);
        offset += count;
    }
    MotionJpeg::new(source, reader.finish())
}

impl MotionJpeg {
    /// The pictures of a file that was looked through.
    pub fn new(source: Arc<dyn ByteSource>, index: VideoIndex) -> Result<Self, VideoError> {
        if index.pictures.is_empty() {
            let file = source.name().to_owned();
            return Err(VideoError::NoPictures { file });
        }
        let index = Arc::new(index);
        Ok(Self { source, index })
    }

    /// Index of the video's pictures.
    pub fn index(&self) -> &VideoIndex {
        &self.index
    }

    /// Times of the pictures, seconds since the first, by the rate of the file or else `rate` a second.
    pub fn times(&self, rate: f64) -> Vec<f64> {
        let rate = self.index.rate.unwrap_or(rate);
        let first = self.index.pictures[0].number;
        let numbers = self
            .index
            .pictures
            .iter()
            .map(|picture| picture.number - first);
        numbers.map(|number| number as f64 / rate).collect()
    }

    fn name(&self, index: usize) -> String {
        format!("{}, picture {}", self.source.name(), index + 1)
    }
}

impl FrameSource for MotionJpeg {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        let bytes = self.encoded(index)?;
        decode_picture(&bytes).map_err(|cause| FrameError::Unreadable {
            name: self.name(index),
            cause: cause.to_string(),
        })
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        let place = self
            .index
            .pictures
            .get(index)
            .ok_or(FrameError::OutOfRange(index))?;
        let bytes = self.source.read(place.offset, place.length);
        let bytes = bytes.map_err(|cause| FrameError::Unreadable {
            name: self.name(index),
            cause,
        })?;
        Ok(with_tables(bytes))
    }

    fn another(&self) -> Option<SharedFrames> {
        Some(Box::new(self.clone()))
    }
}
