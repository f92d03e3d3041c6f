//! Pictures and the kernels that work on them.
//!
//! Pixel coordinates are continuous: x right, y down, origin at the outer corner of the top-left
//! pixel, so that pixel (column c, row r) has its centre at (c + ½, r + ½). Everything in Pilotage
//! uses this convention; OpenCV's (centres at integers) differs by half a pixel.

mod blur;
mod codec;
mod correlation;
mod gradient;
mod halve;
mod image;
mod integral;
mod orientation;
mod peak;
mod pool;
mod pyramid;
mod simd;
mod warp;

pub use blur::{blur_interleaved, box_blur, gaussian_blur, gaussian_blur_colour, wide_blur};
pub use codec::{
    CodecError, decode_picture, decode_picture_with_coverage, encode_jpeg, encode_png,
    encode_png_with_coverage,
};
pub use correlation::{ChannelSearch, ChannelSurface, ChannelTemplate, SearchSpectrum, Template};
pub use gradient::Gradient;
pub use image::{Gray, Picture, Raster, Rgb, Rgba, luminance};
pub use integral::IntegralImage;
pub use orientation::{DIRECTIONS, OrientationField};
pub use peak::{Peak, highest_peak, refine_peak, rival_peak};
pub use pyramid::{PYRAMID_LEVELS, Pyramid, bilinear};
pub use warp::{PixelValue, warp_projective, warp_similar};
