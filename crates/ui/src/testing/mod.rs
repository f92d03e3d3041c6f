//! A screen in memory for tests of the interface, and of views alone.

pub(crate) mod canvas;
