//! Results against values that were computed once by somebody else's program.

mod cascades;
mod kalman;
