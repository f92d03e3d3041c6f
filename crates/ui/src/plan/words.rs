//! The prediction in a few numbers and sentences.

use pilotage_core::frames::{GroundPoint, LocalFrame};
use pilotage_core::landmark::Landmark;
use pilotage_core::plan::RoutePrediction;

use crate::units::Units;

/// Figures of a prediction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictionFigures {
    /// Largest standard deviation of the longer axis, metres.
    pub sigma: f64,
    /// Distance along the path at which that is, metres.
    pub distance: f64,
    /// Place of the largest standard deviation.
    pub place: GroundPoint,
    /// Largest half width of the 95 % corridor, metres.
    pub across: f64,
    /// Longest dead reckoning, seconds.
    pub dead_reckoning: f64,
    /// Distance along the path at which it ends, metres.
    pub dead_reckoning_ends: f64,
    /// Stretches over the limit.
    pub stretches: usize,
    /// Their length together, metres.
    pub over: f64,
    /// Length of the path, metres.
    pub length: f64,
}

impl PredictionFigures {
    /// Figures of `prediction`; `None` without a sample.
    pub fn of(prediction: &RoutePrediction) -> Option<Self> {
        let samples = &prediction.samples;
        let worst = samples
            .iter()
            .max_by(|a, b| a.corridor.sigma_major.total_cmp(&b.corridor.sigma_major))?;
        let blind = samples
            .iter()
            .max_by(|a, b| a.dead_reckoning.total_cmp(&b.dead_reckoning))?;
        let across = samples.iter().map(|s| s.corridor.across);
        let over = &prediction.over_limit;
        Some(Self {
            sigma: worst.corridor.sigma_major,
            distance: worst.distance,
            place: worst.position,
            across: across.fold(0.0, f64::max),
            dead_reckoning: blind.dead_reckoning,
            dead_reckoning_ends: blind.distance,
            stretches: over.len(),
            over: over.iter().map(|s| s.end - s.begin).sum(),
            length: samples.last().map_or(0.0, |s| s.distance),
        })
    }

    /// In sentences.
    pub fn sentences(&self, limit: f64, landmarks: &[&Landmark], units: Units) -> Vec<String> {
        let far = |metres: f64| distance_text(metres, units);
        let short = |metres: f64| units.short(metres);
        let near = nearest(landmarks, &self.place, units);
        let mut list = vec![
            format!(
                "Largest error: {} (1σ), {} along{near}.",
                short(self.sigma),
                far(self.distance)
            ),
            format!(
                "Longest dead reckoning: {:.0} s, until {}.",
                self.dead_reckoning,
                far(self.dead_reckoning_ends)
            ),
        ];
        list.push(match self.stretches {
            0 => format!("Nowhere over your limit of {}.", short(limit)),
            1 => format!(
                "Over your limit of {} for {}.",
                short(limit),
                far(self.over)
            ),
            n => format!(
                "Over your limit of {} on {n} stretches, {} together.",
                short(limit),
                far(self.over)
            ),
        });
        list
    }
}

/// A long distance as people read it.
pub fn distance_text(metres: f64, units: Units) -> String {
    let (factor, unit) = long(units, metres);
    let value = metres * factor;
    if unit == "m" || unit == "ft" {
        format!("{value:.0} {unit}")
    } else {
        format!("{value:.2} {unit}")
    }
}

/// Factor from metres to the unit for distances along a route up to `longest`, and its name.
pub fn long(units: Units, longest: f64) -> (f64, &'static str) {
    match units {
        Units::Metric if longest < 2000.0 => (1.0, "m"),
        Units::Metric => (1e-3, "km"),
        Units::Aviation => (1.0 / 1852.0, "NM"),
    }
}

/// Latitude and longitude of a place; empty in a world without a place on the globe.
pub fn place_words(place: &GroundPoint, frame: Option<&LocalFrame>) -> String {
    let Some(frame) = frame else {
        return String::new();
    };
    let place = frame.geodetic_from_ground(place);
    let side = |degrees: f64, letters: [char; 2]| {
        let letter = letters[usize::from(degrees < 0.0)];
        format!("{letter} {:.5}°", degrees.abs())
    };
    let latitude = side(place.latitude.to_degrees(), ['N', 'S']);
    let longitude = side(place.longitude.to_degrees(), ['E', 'W']);
    format!("{latitude} {longitude}")
}

/// Position of a place relative to the landmark nearest to it, in words.
fn nearest(landmarks: &[&Landmark], place: &GroundPoint, units: Units) -> String {
    let away = |l: &&&Landmark| l.reference.distance(place);
    let near = landmarks.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
    near.map_or_else(String::new, |l| {
        let (factor, unit) = units.length();
        format!(", {:.0} {unit} from {}", away(&l) * factor, l.name)
    })
}
