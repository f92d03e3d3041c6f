//! Lines that say what is being done and how long it took.

use std::{
    io::{self, Write},
    time::Instant,
};

use crate::failure::Failure;

/// Does `work`, with a line before it that names it and one after it with its duration.
pub fn step<T>(name: &str, work: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
    println!("{name} …");
    flush();
    let start = Instant::now();
    let result = work()?;
    println!("{name}: {:.1} s", start.elapsed().as_secs_f64());
    flush();
    Ok(result)
}

/// Hands everything printed so far to whoever reads it.
pub fn flush() {
    // A closed pipe is no reason to stop building.
    let _ = io::stdout().flush();
}
