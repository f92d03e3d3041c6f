//! The method of Pilotage without a screen: frames, pictures, cameras, filter, vehicles, imagery,
//! landmarks, flights, the navigator, a world to try it in, detectors trained in it, and studies.
//!
//! Modules are listed from the bottom up; a lower one never imports a higher one, and none of them
//! reaches a screen, a clock, a file system or a thread. `cargo xtask test` checks both.

pub mod alignment;
pub mod camera;
pub mod exchange;
pub mod filter;
pub mod flight;
pub mod frames;
pub mod imagery;
pub mod instruments;
pub mod landmark;
pub mod mission;
pub mod navigator;
pub mod plan;
pub mod raster;
pub mod registration;
pub mod simulate;
pub mod study;
pub mod training;
pub mod vehicle;
