//! Files that commands write, read by other people's programs.

mod export;
mod sobol;
mod study;
mod tracks;
