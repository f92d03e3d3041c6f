//! Pictures of the stops over two flights, for people to look at.
//!
//! `PILOTAGE_PICTURES=folder cargo test -p pilotage-ui learn::pictures` writes them.

use super::tour::Tour;
use crate::tokens::Tokens;
use crate::views::canvas;
use crate::views::pictures::ViewDocuments;

/// Draws every stop over what `documents` gives.
fn write_all(name: &str, documents: impl Fn() -> ViewDocuments) {
    if canvas::folder().is_none() {
        println!("skipped: PILOTAGE_PICTURES names no folder");
        return;
    }
    let documents = documents();
    for stop in 0..Tour::default().stops() {
        let mut tour = Tour::default();
        tour.go_to(stop);
        let name = format!("{name}-tour-{:02}", stop + 1);
        let (size, tokens) = ([352.0, 440.0], Tokens::dark());
        documents.write(&name, size, &tokens, 15.5, None, |ui, context| {
            tour.show(ui, context);
        });
    }
}

#[test]
fn the_stops_over_a_synthetic_flight_can_be_looked_at() {
    write_all("synthetic", ViewDocuments::synthetic);
}

#[test]
fn the_stops_over_a_built_in_scenario_can_be_looked_at() {
    write_all("flown", || ViewDocuments::flown("distinct-400ft-wind"));
}
