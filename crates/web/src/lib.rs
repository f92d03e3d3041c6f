//! The page: with `crates/worker`, the only crate that knows the browser.
//!
//! `www/main.js` makes a `WebHandle`.
#![cfg(target_arch = "wasm32")]

mod app;
mod browser;
mod fetched;
mod frame_times;
mod graphics;
mod handle;
mod host;
mod lent;
mod message;
mod port;

pub use handle::WebHandle;
