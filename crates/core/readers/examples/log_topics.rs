//! Prints the topics of a flight log: rows, span of time, fields.
//!
//! `cargo run -p pilotage-readers --example log_topics -- FLIGHT.ulg`

use pilotage_readers::bytes::MemoryBytes;
use pilotage_readers::log::read_log;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("which log?")?;
    let source = MemoryBytes::new(&path, std::fs::read(&path)?);
    let log = read_log(&source)?.ok_or_else(|| format!("{path} is no log that is known here"))?;
    for topic in &log.topics {
        let fields: Vec<&str> = topic
            .fields
            .iter()
            .map(|field| field.name.as_str())
            .collect();
        let span = topic.times.first().zip(topic.times.last());
        let span = span.map_or_else(String::new, |(from, to)| {
            format!(" {from:.2} s to {to:.2} s")
        });
        println!(
            "{}: {} rows{span}: {}",
            topic.name,
            topic.times.len(),
            fields.join(", ")
        );
    }
    let report = &log.report;
    println!(
        "{} bytes read, {} skipped in {} places",
        report.bytes, report.skipped_bytes, report.skipped_places
    );
    Ok(())
}
