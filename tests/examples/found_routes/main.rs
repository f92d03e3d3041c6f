//! `cargo run --release -p pilotage-tests --example found_routes -- [COUNTIES] [FLIGHTS] [BUDGET] [stated|pictures]`:
//! finds a route in each of so many counties, flies it and the straight line, prints a table.

use std::process::ExitCode;
use std::time::Instant;

use pilotage_tests::routes::{Case, FlownRoute, RouteSight, expectations};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize, usual: f64| {
        let stated = arguments.get(at).and_then(|t| t.parse().ok());
        stated.unwrap_or(usual)
    };
    let (counties, flights, budget) = (number(0, 10.0), number(1, 50.0), number(2, 1.3));
    let seen = match arguments.get(3).map(String::as_str) {
        Some("pictures") => RouteSight::Pictures,
        _ => RouteSight::AsStated,
    };
    match table(counties as u64, flights as u64, budget, seen) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("{why}");
            ExitCode::FAILURE
        }
    }
}

fn table(counties: u64, flights: u64, budget: f64, seen: RouteSight) -> Result<(), String> {
    let expected = expectations()?;
    for (name, e) in &expected {
        eprintln!("{name:24} {:.2}", e.probability());
    }
    println!(
        "| county | villages | line, km | found, km | way-points | time | worst σ, line → found, m | \
         largest error, line → found, m | ratio | median largest, m |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    let mut kept = 0;
    for seed in 1..=counties {
        let begun = Instant::now();
        let case = Case::new(seed, &expected, budget)?;
        let found_in = begun.elapsed().as_secs_f64();
        let line = case.fly(&case.found.shortest, flights, seen)?;
        let found = case.fly(&case.found.surest, flights, seen)?;
        let ratio = found.largest_of_all() / line.largest_of_all();
        let time = found.time / line.time;
        kept += u64::from(ratio <= 0.5 && time <= 1.3);
        println!(
            "| {seed} | {} | {:.1} | {:.1} | {} | × {time:.2} | {:.0} → {:.0} | {:.0} → {:.0} | {ratio:.2} | {:.0} → {:.0} |",
            case.villages,
            1e-3 * line.route.length,
            1e-3 * found.route.length,
            found.route.way_points.len(),
            line.predicted_worst,
            found.predicted_worst,
            line.largest_of_all(),
            found.largest_of_all(),
            line.median_largest(),
            found.median_largest(),
        );
        let each = |f: &FlownRoute| {
            let mut all: Vec<i64> = f.largest.iter().map(|e| e.round() as i64).collect();
            all.sort_unstable();
            format!("{all:?}")
        };
        eprintln!(
            "county {seed}: found in {found_in:.1} s, flown in {:.0} s; blind {:.0} → {:.0} m; {:?}\n  line {}\n  found {}",
            begun.elapsed().as_secs_f64(),
            line.route.worst_blind,
            found.route.worst_blind,
            case.found.surest.way_points,
            each(&line),
            each(&found)
        );
    }
    println!(
        "\n{kept} of {counties} counties: largest error at most half for at most 30 % more time ({flights} flights each way)"
    );
    Ok(())
}
