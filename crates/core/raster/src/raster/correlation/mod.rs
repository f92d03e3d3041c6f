//! Zero-mean normalized cross-correlation of a template with a picture.
//!
//! The surface is OpenCV's `TM_CCOEFF_NORMED`,
//!
//! ```text
//!                Σ (T(i,j) - T̄) (I(x+i, y+j) - Ī(x,y))
//! R(x,y) = ---------------------------------------------------
//!           sqrt( Σ (T(i,j) - T̄)²  Σ (I(x+i, y+j) - Ī(x,y))² )
//! ```
//!
//! with one difference: where the window or the template is flat, so that the quotient means
//! nothing, R is 0 (OpenCV answers 1 for a flat template).
//!
//! Because the template is free of its mean, the numerator is a plain cross-correlation. Small ones
//! run directly on vector registers, large ones through a Fourier transform; [`cost`] decides.

mod channels;
mod cost;
mod flatness;
mod fourier;
mod normalize;
mod search;
mod surface;
mod template;
#[cfg(test)]
mod tests;
mod whole;

pub use channels::{ChannelSearch, ChannelSurface, ChannelTemplate};
pub use search::SearchSpectrum;
pub use template::Template;
