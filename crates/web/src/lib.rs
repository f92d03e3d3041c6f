//! The page and its workers.
#![cfg(target_arch = "wasm32")]
