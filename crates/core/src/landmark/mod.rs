//! landmark
