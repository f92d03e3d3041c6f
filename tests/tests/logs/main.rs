//! Logs that are damaged or come in pieces.

mod damaged;
mod in_pieces;
