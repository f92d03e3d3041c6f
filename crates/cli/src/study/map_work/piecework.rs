//! Work on a map that is cut into pieces.

use std::path::PathBuf;

use pilotage_jobs::{JobEvent, Order};

use super::named_file::NamedFile;
use crate::workers::{self, Lent};

/// Outcome of all pieces: a file, and words for people.
pub struct PieceworkOutcome {
    /// Name of the file.
    pub name: &'static str,
    /// Its content.
    pub bytes: Vec<u8>,
    /// Words on it.
    pub words: String,
}

/// Work on a map in pieces, each of which is the same to the bit whoever does it.
pub trait Piecework {
    /// Number of the pieces.
    fn pieces(&self) -> u64;

    /// Files that were read to begin.
    fn read(&self) -> &[PathBuf];

    /// Pictures of a flight that it looks at beside those.
    ///
    /// # Errors
    /// Where one cannot be read, in words.
    fn pictures(&self) -> Result<Vec<NamedFile>, String> {
        Ok(Vec::new())
    }

    /// Does these pieces; `keep` takes each.
    ///
    /// # Errors
    /// Whatever fails in a piece, or `keep` says.
    fn carry_out(
        &self,
        wanted: &[u64],
        threads: usize,
        keep: &mut dyn FnMut(u64, Vec<u8>) -> Result<(), String>,
    ) -> Result<(), String>;

    /// Sums up all pieces, in the order of their numbers.
    ///
    /// # Errors
    /// Pieces that cannot be read, or that come to nothing.
    fn conclude(
        &self,
        pieces: Vec<Vec<u8>>,
    ) -> Result<PieceworkOutcome, Box<dyn std::error::Error>>;
}

/// Bytes of the event that has what a piece came to; `None` of all others.
pub type BytesOf = dyn Fn(JobEvent) -> Option<Result<Vec<u8>, String>>;

/// Does an order for each wanted piece; `keep` takes what `of` makes of the event that has it, once it is done. An order that
/// fails after it said what its piece came to has done it.
///
/// # Errors
/// Whatever fails in an order, or `keep` says.
pub fn order_each<O: Order + Send>(
    wanted: &[u64],
    (order, of): (&dyn Fn(u64) -> O, &BytesOf),
    (threads, lent): (usize, &Lent),
    keep: &mut dyn FnMut(u64, Vec<u8>) -> Result<(), String>,
) -> Result<(), String> {
    let orders = wanted.iter().map(|piece| order(*piece)).collect();
    let mut is_kept = vec![false; wanted.len()];
    workers::run_as_done(threads, orders, lent, &mut |number, event| {
        if let JobEvent::Failed(why) = event {
            return if is_kept[number] {
                Ok(())
            } else {
                Err(format!("piece {}: {why}", wanted[number]))
            };
        }
        let Some(bytes) = of(event) else {
            return Ok(());
        };
        is_kept[number] = true;
        keep(wanted[number], bytes?)
    })
}
