//! A small convolutional network that gives the probability of road for each pixel of half a metre.
//!
//! Nine tenths of its work are products of pixels with small matrices, at one and two metres per pixel; convolutions
//! are depthwise (3 by 3, dilated), so that a pixel is judged by some 45 m around it in every direction.

mod input;
mod plan;
mod run;
mod simd;
mod tensor;

pub use input::{INPUT_CHANNELS, network_input};
pub use plan::{NETWORK_STEPS, NetworkStep, weight_count};
pub use run::RoadNetwork;
pub use simd::{depthwise, matrix_product};
pub use tensor::ChannelGrid;
