//! navigator
