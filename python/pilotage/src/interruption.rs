//! Work that whoever waits for it may interrupt.

use pilotage_disk::workers::{GoesOn, while_waited_for};
use pyo3::prelude::*;

use crate::error::refusal;

/// Does work without Python's lock, which may ask whether it goes on.
///
/// Ctrl+C, or a notebook's "interrupt kernel", ends the waiting within some 20 ms, whatever the work is at; work that does not
/// ask is left to itself, and what it comes to is dropped.
///
/// # Errors
/// The refusal in words where the work fails; `KeyboardInterrupt`, or whatever a handler of signals raises, where somebody
/// interrupts it.
pub fn unless_interrupted<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(GoesOn<'_>) -> Result<T, Box<dyn std::error::Error>> + Send + 'static,
) -> PyResult<T> {
    // A failure cannot pass from one thread to another, its words can.
    let work = move |goes_on: GoesOn<'_>| work(goes_on).map_err(|failure| failure.to_string());
    // A path to the method is of one lifetime only.
    #[allow(clippy::redundant_closure_for_method_calls)]
    let mut waits = || Python::attach(|py| py.check_signals());
    let done = py.detach(|| while_waited_for(work, &mut waits))?;
    done.map_err(refusal)
}
