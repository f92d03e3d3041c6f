//! Pictures and the kernels that work on them.
//!
//! Pixel coordinates are continuous: x right, y down, origin at the outer corner of the top-left
//! pixel, so that pixel (column c, row r) has its centre at (c + ½, r + ½). Everything in Pilotage
//! uses this convention; OpenCV's (centres at integers) differs by half a pixel.

mod correlation;
mod image;
mod integral;
mod peak;
mod pyramid;
mod simd;

pub use correlation::{SearchSpectrum, Template};
pub use image::{Gray, Picture, Raster, Rgb, Rgba, luminance};
pub use integral::IntegralImage;
pub use peak::{Peak, highest_peak, refine_peak, rival_peak};
pub use pyramid::{Pyramid, bilinear};
