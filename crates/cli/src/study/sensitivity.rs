//! `pilotage study sensitivity`: errors that walk at random, added to one instrument at a time.

use std::path::PathBuf;

use pilotage_core::plan::{SensitivityRow, TestedInstrument};
use pilotage_jobs::{JobEvent, SensitivityOrder};

use crate::CommandResult;
use crate::files::write_whole;
use crate::workers::{self, Lent};

/// Arguments of `pilotage study sensitivity`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Flights for each deviation of each instrument.
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..))]
    runs: u64,
    /// File for the errors of all runs, as JSON.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Makes the study that the arguments ask for.
pub fn run(arguments: &Arguments) -> CommandResult {
    let Arguments { runs, out } = arguments;
    let orders: Vec<SensitivityOrder> = TestedInstrument::ALL
        .into_iter()
        .flat_map(|instrument| {
            let deviations = instrument.deviations().into_iter();
            deviations.map(move |deviation| SensitivityOrder {
                instrument,
                deviation,
                runs: *runs,
            })
        })
        .collect();
    println!(
        "{:10} {:>12} {:>9} {:>9} {:>19} {:>9} {:>8}",
        "instrument", "step", "flights", "median m", "95 % of it, m", "worst m", "given up"
    );
    let mut rows: Vec<SensitivityRow> = Vec::with_capacity(orders.len());
    workers::run(orders, &Lent::default(), &mut |_, event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::Figures(_) => {
                let row: SensitivityRow = event.read_figures()?;
                println!("{}", line(&row));
                rows.push(row);
            }
            _ => {}
        }
        Ok(())
    })?;
    if let Some(path) = out {
        write_whole(path, serde_json::to_string_pretty(&rows)?)?;
    }
    Ok(())
}

/// A line of the table.
fn line(row: &SensitivityRow) -> String {
    let step = match row.instrument {
        TestedInstrument::Airspeed => format!("{:.2} m/s", row.deviation),
        _ => format!("{:.1}°", row.deviation.to_degrees()),
    };
    let flown = row.flown();
    let metres = |value: Option<f64>| value.map_or("-".to_owned(), |metres| format!("{metres:.2}"));
    let interval = row.interval().map_or("-".to_owned(), |[low, high]| {
        format!("{low:.2} to {high:.2}")
    });
    format!(
        "{:10} {step:>12} {:>9} {:>9} {interval:>19} {:>9} {:>8}",
        row.instrument.label(),
        flown.len(),
        metres(row.median()),
        metres(flown.last().copied()),
        row.rms.len() - flown.len(),
    )
}
