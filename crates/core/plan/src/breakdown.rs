//! On what it depends whether a landmark is found: views counted by heading, attitude error and day.

use std::f64::consts::{FRAC_PI_2, TAU};

use serde::{Deserialize, Serialize};

use super::ViewResult;
use super::tally::{LookTally, tally_by};
use pilotage_mission::settings::SensorNoise;

/// Edges between small, usual and great attitude errors, standard deviations of roll and pitch: a third
/// of all errors lies between each pair, their length being Rayleigh's: √(-2 ln ⅔), √(-2 ln ⅓).
const THIRDS: [f64; 2] = [0.9005, 1.4823];

/// Views of a landmark, counted by what they differ in.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ViewBreakdown {
    /// By heading of the camera: within 45° of north, east, south and west.
    pub heading: Vec<LookTally>,
    /// By the tilt of which the filter did not know, from small to great.
    pub attitude_error: Vec<LookTally>,
    /// The two tilts between them, radians.
    pub edges: [f64; 2],
    /// By day.
    pub day: Vec<LookTally>,
}

impl ViewBreakdown {
    /// Counts `views` of `days` days, taken with those errors of the sensors.
    pub fn of(views: &[ViewResult], sensors: &SensorNoise, days: usize) -> Self {
        let deviation = sensors.roll.max(sensors.pitch);
        let edges = THIRDS.map(|third| third * deviation);
        let quarters: Vec<f64> = (0..=4)
            .map(|quarter| f64::from(quarter) * FRAC_PI_2)
            .collect();
        let from_quarter = |view: &ViewResult| (view.heading + 0.5 * FRAC_PI_2).rem_euclid(TAU);
        Self {
            heading: tally_by(views, &quarters, from_quarter),
            attitude_error: tally_by(views, &[0.0, edges[0], edges[1], f64::INFINITY], |view| {
                view.attitude_error
            }),
            edges,
            day: LookTally::by_day(views, days),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_vision::landmark::{Detection, Refusal, Sighting};

    fn view(day: usize, heading: f64, attitude_error: f64, covariance: f64) -> ViewResult {
        let detection = Detection {
            ground: pilotage_base::frames::GroundPoint::default(),
            covariance: nalgebra::Matrix4::identity() * covariance,
            score: 0.9,
            second_score: 0.1,
            probability: None,
            rotation: 0.0,
            scale: 1.0,
        };
        ViewResult {
            day,
            heading: heading.to_radians(),
            height: 100.0,
            tilt: 0.0,
            attitude_error,
            off_centre: 0.0,
            sighting: if covariance > 0.0 {
                Sighting::Found(detection)
            } else {
                Sighting::Refused(Refusal::LowScore, None)
            },
            error: None,
            wrong: false,
            lasting: None,
        }
    }

    #[test]
    fn a_view_counts_once_by_heading_by_error_and_by_day() {
        let views = [
            view(0, 350.0, 0.001, 0.04),
            view(0, 20.0, 0.012, 0.08),
            view(2, 181.0, 0.05, 0.0),
        ];
        let sensors = SensorNoise {
            roll: 0.01,
            pitch: 0.01,
            ..pilotage_mission::settings::NavigatorSettings::default().sensors
        };
        let counted = ViewBreakdown::of(&views, &sensors, 3);
        let looks = |tallies: &[LookTally]| tallies.iter().map(|t| t.looks).collect::<Vec<_>>();
        assert_eq!(looks(&counted.heading), [2, 0, 1, 0]);
        assert_eq!(looks(&counted.attitude_error), [1, 1, 1]);
        assert_eq!(looks(&counted.day), [2, 0, 1]);
        let north = counted.heading[0].covariance().unwrap();
        assert!((north[(0, 0)] - 0.06).abs() < 1e-12 && north[(0, 1)] == 0.0);
        assert_eq!(counted.day[2].share(), Some(0.0));
        assert_eq!(counted.day[2].covariance(), None);
    }
}
