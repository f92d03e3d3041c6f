//! Reads damaged files without end and looks for what must never happen.
//!
//! `cargo run --release -p pilotage-tests --example fuzz -- --reader Dataflash --executions 10000000`
//! takes small files, real and made, does one to eight things to each that power cuts, bad storage and malice
//! do, and reads it: no panic, every byte accounted for, memory in proportion, the same whole and in pieces. Each execution is drawn from its own number, so that `--first NUMBER --executions 1` repeats it.
//! What fails is kept in `target/fuzz`.

mod readers;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::time::{Duration, Instant};

use pilotage_tests::data::repository;
use pilotage_tests::logs::corpus::Sample;
use pilotage_tests::logs::damage::{apply, draw};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use readers::{FuzzedReader, all_readers};

/// Number of executions of which one is read in pieces, too.
const IN_PIECES: u64 = 8;
/// Longest file that is read, bytes: damage may repeat much.
const LONGEST: usize = 1 << 16;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut reader = None;
    let (mut executions, mut first) = (100_000_u64, 0_u64);
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let value = arguments.next().ok_or("every option has a value")?;
        match argument.as_str() {
            "--reader" => reader = Some(value),
            "--executions" => executions = value.parse()?,
            "--first" => first = value.parse()?,
            _ => return Err("say: --reader NAME [--executions N] [--first N]".into()),
        }
    }
    let readers = all_readers();
    let names: Vec<&str> = readers.iter().map(|reader| reader.name.as_str()).collect();
    let wanted = reader.ok_or_else(|| format!("say --reader and one of {}", names.join(", ")))?;
    let named = |reader: &&FuzzedReader| reader.name.eq_ignore_ascii_case(&wanted);
    let reader = readers.iter().find(named);
    let reader = reader.ok_or_else(|| format!("no reader {wanted}: {}", names.join(", ")))?;
    fuzz(reader, first, executions)
}

/// Totals of the executions.
#[derive(Default)]
struct Tally {
    bytes: u64,
    messages: u64,
    clean: u64,
    slowest: (Duration, u64),
}

fn fuzz(
    reader: &FuzzedReader,
    first: u64,
    executions: u64,
) -> Result<(), Box<dyn std::error::Error>> {
    let samples = (reader.samples)();
    if samples.is_empty() {
        return Err("there is no file of this format to begin with".into());
    }
    let lengths: Vec<_> = samples.iter().map(|sample| sample.bytes.len()).collect();
    println!(
        "{}: {executions} executions from {first} on, files of {lengths:?} bytes",
        reader.name
    );
    if std::env::var_os("RUST_BACKTRACE").is_none() {
        std::panic::set_hook(Box::new(|_| {}));
    }
    let begun = Instant::now();
    let mut tally = Tally::default();
    for number in first..first + executions {
        let (bytes, ends) = input(&samples, number);
        let start = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| (reader.execute)(&bytes, &ends)));
        let taken = start.elapsed();
        let failure = match outcome {
            Ok(Ok((messages, is_clean))) => {
                tally.messages += messages;
                tally.clean += u64::from(is_clean);
                None
            }
            Ok(Err(wrong)) => Some(wrong),
            Err(panic) => Some(format!("panic: {}", words(&*panic))),
        };
        if let Some(wrong) = failure {
            let place = keep(reader, number, &bytes)?;
            return Err(format!("execution {number}: {wrong}\nkept as {}", place.display()).into());
        }
        tally.bytes += bytes.len() as u64;
        tally.slowest = tally.slowest.max((taken, number));
        if (number + 1 - first).is_multiple_of(1_000_000) {
            println!(
                "{} million after {:.0} s",
                (number + 1 - first) / 1_000_000,
                begun.elapsed().as_secs_f64()
            );
        }
    }
    println!(
        "{executions} executions without a fault in {:.0} s: {:.1} GB, {} messages read, {} files still whole",
        begun.elapsed().as_secs_f64(),
        tally.bytes as f64 / 1e9,
        tally.messages,
        tally.clean,
    );
    let (time, number) = tally.slowest;
    println!(
        "the slowest was {number}: {:.2} ms",
        time.as_secs_f64() * 1e3
    );
    Ok(())
}

/// The damaged file of an execution, and where its pieces end if it is read in pieces.
fn input(samples: &[Sample], number: u64) -> (Vec<u8>, Vec<usize>) {
    let mut random = ChaCha8Rng::seed_from_u64(number);
    let sample = &samples[random.random_range(0..samples.len())];
    let other = &samples[random.random_range(0..samples.len())];
    let mut bytes = sample.bytes.clone();
    for _ in 0..random.random_range(1..=8_u8) {
        let damage = draw(&mut random, &sample.seams);
        apply(&mut bytes, &damage, &other.bytes);
        bytes.truncate(LONGEST);
    }
    let mut ends = Vec::new();
    if number.is_multiple_of(IN_PIECES) && !bytes.is_empty() {
        let count = random.random_range(1..12_u8);
        ends.extend((0..count).map(|_| random.random_range(0..bytes.len())));
        ends.sort_unstable();
    }
    (bytes, ends)
}

fn words(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().cloned();
    text.or_else(|| panic.downcast_ref::<&str>().map(ToString::to_string))
        .unwrap_or_default()
}

/// Keeps what failed for a closer look.
fn keep(reader: &FuzzedReader, number: u64, bytes: &[u8]) -> std::io::Result<PathBuf> {
    let folder = repository().join("target/fuzz");
    std::fs::create_dir_all(&folder)?;
    let place = folder.join(format!("{}-{number}", reader.name));
    std::fs::write(&place, bytes)?;
    Ok(place)
}
