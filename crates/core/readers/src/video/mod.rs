//! Pictures out of videos that are JPEGs one after another: AVI with motion JPEG, `.mjpeg` files, streams of
//! cameras.
//!
//! A [`MotionJpegReader`] is fed the file piece by piece and notes where its pictures lie; [`MotionJpeg`] hands
//! them out. Other videos need a decoder, which the page borrows from its browser: whoever has the pictures and
//! their times makes them frames of a flight by [`with_pictures`].

mod avi;
mod huffman;
mod jpeg;
mod motion_jpeg;
mod pictures;
mod reader;
#[cfg(test)]
mod tests;

pub use motion_jpeg::{MotionJpeg, VideoError, open_motion_jpeg};
pub use pictures::{VideoClock, with_pictures};
pub use reader::{MotionJpegReader, PlacedPicture, VideoIndex, is_motion_jpeg};
