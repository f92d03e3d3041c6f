//! Sentences on what was assumed of files or left out.

use std::sync::Arc;

use pilotage_core::flight::Flight;
use pilotage_core::frames::GroundRect;
use pilotage_core::imagery::{Imagery, Window};
use pilotage_core::mission::Mission;
use pilotage_core::raster::{Raster, Rgba};
use pilotage_core::text::by_count;
use pilotage_core::training::evaluation::HeldOutFrames;
use pilotage_disk::planned_flight::PlannedFlight;

use crate::maps::MapOnDisk;

/// Tells them to whoever sits at the terminal, beside what the command prints.
pub fn tell(notes: &[String]) {
    for note in notes {
        eprintln!("note: {note}");
    }
}

/// Sentences on the trained detectors of a mission that may have learned from pictures of a flight: on those they do better
/// than elsewhere.
pub fn learned_from(mission: &Mission, flight: &Flight) -> Vec<String> {
    let used = mission.landmarks.iter();
    let used = used.filter(|it| it.enabled && it.is_trained() && it.detector_in_use().is_some());
    let learned = used.filter_map(|landmark| {
        let count = HeldOutFrames::of(flight, &mission.labels, landmark.id).learned;
        let pictures = by_count(count, "picture", "pictures");
        (count > 0).then(|| {
            format!(
                "the detector of \"{}\" may have learned from {count} labelled {pictures} of this very flight: on others it may find less",
                landmark.name
            )
        })
    });
    learned.collect()
}

/// A map that tells which of its parts could not be read, and were taken as empty, when the command lets go of it.
struct ToldMap(Arc<dyn Imagery>);

impl Imagery for ToldMap {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn bounds(&self) -> GroundRect {
        self.0.bounds()
    }

    fn native_gsd(&self) -> f64 {
        self.0.native_gsd()
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        self.0.window(window)
    }

    fn window_so_far(&self, window: &Window) -> (Raster<Rgba>, bool) {
        self.0.window_so_far(window)
    }

    fn source(&self) -> Option<&dyn Imagery> {
        Some(&self.0)
    }
}

impl Drop for ToldMap {
    fn drop(&mut self) {
        tell(&self.0.problems());
    }
}

/// The map, once its notes are told; which of its parts cannot be read is told when the command lets go of it.
pub fn told(opened: MapOnDisk) -> Arc<dyn Imagery> {
    tell(&opened.notes);
    Arc::new(ToldMap(opened.map))
}

/// The ground of a plan and its map, as [`told`] has it.
pub fn told_ground(mut ground: PlannedFlight) -> PlannedFlight {
    tell(&ground.notes);
    ground.map = Arc::new(ToldMap(ground.map));
    ground
}

#[cfg(test)]
mod tests {
    use pilotage_core::landmark::DetectorChoice;
    use pilotage_core::mission::FrameLabels;
    use pilotage_core::simulate::Scenario;

    use super::*;
    use crate::scenario::{DayChoice, options};
    use crate::workers::Lent;
    use pilotage_jobs::FlightSource;

    #[test]
    fn a_flight_that_its_mission_has_labelled_is_told_where_the_detector_was_trained() {
        let name = "distinct-400ft-calm";
        let source = FlightSource::Simulated(options(name, 1, DayChoice::Other));
        let open = Lent::default().worker().flight(&source).expect("a flight");
        let flight = Flight::clone(&open.borrow().flight);
        let mut mission = Scenario::named(name).expect("a scenario").mission();
        let first = mission.landmarks[0].id;
        mission.labels = vec![FrameLabels {
            frame: flight.frames[0].name.clone(),
            size: (640, 480),
            absent: vec![first],
            ..FrameLabels::default()
        }];
        assert!(
            learned_from(&mission, &flight).is_empty(),
            "none is trained"
        );
        let landmark = &mut mission.landmarks[0];
        let trained = serde_json::json!({"bounds": landmark.bounds});
        landmark.keep_trained_text(Some(&trained.to_string()));
        landmark.choose_detector(DetectorChoice::Cascade);
        let told = learned_from(&mission, &flight);
        assert_eq!(told.len(), 1);
        assert!(
            told[0].contains("from 1 labelled picture of this very flight"),
            "{told:?}"
        );
    }
}
