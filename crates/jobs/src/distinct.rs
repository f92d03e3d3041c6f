//! Distinctness of a box of the map, with a sentence for people.

use pilotage_core::frames::GroundRect;
use pilotage_core::imagery::Imagery;
use pilotage_core::landmark::{PatchDistinctness, TemplateSettings, distinctness};

use serde::{Deserialize, Serialize};

use super::order::{Order, Reads, Urgency, WorkerRole, keys_of};
use super::running::once;
use super::{Distinctness, JobEvent, MapSource, RunningJob, WorkerState};

/// Score of the strongest look-alike up to which a box stands out clearly.
const CLEARLY_DISTINCT: f64 = 0.55;

/// Compares the box with the map within `radius` metres.
fn examine(map: &dyn Imagery, bounds: GroundRect, radius: f64) -> Distinctness {
    let found = distinctness(map, &bounds, radius);
    let verdict = verdict(&found, &bounds, radius);
    Distinctness {
        bounds,
        radius,
        surface: found.surface,
        surface_rect: found.surface_rect,
        look_alike: found.look_alike,
        contrast: found.contrast,
        flat: found.flat,
        verdict,
    }
}

fn verdict(found: &PatchDistinctness, bounds: &GroundRect, radius: f64) -> String {
    if found.flat {
        return format!(
            "Too flat to match: its grey values vary by only {:.1} of 255.",
            found.contrast
        );
    }
    let Some((place, score)) = found.look_alike else {
        return format!("Nothing within {radius:.0} m of it on this map looks like it.");
    };
    let center = bounds.center();
    let (north, east) = (place.north - center.north, place.east - center.east);
    let at = format!("{:.0} m {}", north.hypot(east), compass(north, east));
    let limit = TemplateSettings::default().greatest_ambiguity;
    if score >= limit {
        format!("Ambiguous: a place {at} of it looks nearly the same (score {score:.2}).")
    } else if score > CLEARLY_DISTINCT {
        format!(
            "Its strongest look-alike on this map, {at} of it, scores {score:.2} against its 1."
        )
    } else {
        format!("Its strongest look-alike on this map, {at} of it, scores only {score:.2}.")
    }
}

/// The nearest of the eight winds.
fn compass(north: f64, east: f64) -> &'static str {
    const NAMES: [&str; 8] = [
        "north",
        "north-east",
        "east",
        "south-east",
        "south",
        "south-west",
        "west",
        "north-west",
    ];
    let eighth = std::f64::consts::FRAC_PI_4;
    let index = (east.atan2(north) / eighth).round().rem_euclid(8.0) as usize;
    NAMES[index % 8]
}

/// Question how distinct a box of the map is: event `Distinctness`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DistinctnessOrder {
    /// The map.
    pub map: MapSource,
    /// The box.
    pub bounds: GroundRect,
    /// Reach around it within which look-alikes are sought, metres.
    pub radius: f64,
}

impl Order for DistinctnessOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        Some((
            &self.map,
            Reads::Areas(vec![self.bounds.grown(self.radius)]),
        ))
    }

    fn is_small(&self) -> bool {
        self.map.is_small()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            let map = worker.map(&self.map)?;
            let found = examine(map.as_ref(), self.bounds, self.radius);
            emit(JobEvent::Distinctness(Box::new(found)));
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_winds_are_named_clockwise_from_north() {
        assert_eq!(compass(10.0, 0.1), "north");
        assert_eq!(compass(-3.0, 3.0), "south-east");
        assert_eq!(compass(0.0, -5.0), "west");
        assert_eq!(compass(4.0, -4.0), "north-west");
    }

    #[test]
    fn a_look_alike_is_told_with_its_distance_and_direction() {
        let found = PatchDistinctness {
            surface: pilotage_core::raster::Raster::filled(1, 1, 0.0),
            surface_rect: GroundRect::centered(
                pilotage_core::frames::GroundPoint::new(0.0, 0.0),
                1.0,
                1.0,
            ),
            look_alike: Some((pilotage_core::frames::GroundPoint::new(0.0, 40.0), 0.91)),
            contrast: 30.0,
            flat: false,
        };
        let text = verdict(&found, &found.surface_rect, 120.0);
        assert_eq!(
            text,
            "Ambiguous: a place 40 m east of it looks nearly the same (score 0.91)."
        );
    }
}
