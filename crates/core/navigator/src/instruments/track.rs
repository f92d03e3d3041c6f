//! Beliefs along the way.

use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use super::calibration::Calibration;
use super::prepared::Instruments;
use pilotage_base::frames::GroundPoint;
use pilotage_base::statistics::chi_square_quantile;
use pilotage_estimation::filter::Gaussian;
use pilotage_estimation::vehicle::{StateComponent, VehicleModel};

/// Belief at one time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeliefPoint {
    /// Seconds in the flight's time base, of the attitude.
    pub time: f64,
    /// Estimated position in the world frame, m.
    pub position: GroundPoint,
    /// Covariance of the position (north, east), m².
    pub covariance: Matrix2<f64>,
    /// Position by satellite navigation at that time minus the estimate (north, east), m, where known.
    pub error: Option<Vector2<f64>>,
    /// Steady wind: velocity of the air (north, east), m/s.
    pub wind: Vector2<f64>,
    /// Covariance of the wind, (m/s)².
    pub wind_covariance: Matrix2<f64>,
    /// True airspeed over measured airspeed, and its standard deviation; `None` for the plain filter.
    pub scale: Option<(f64, f64)>,
    /// Reading of the heading minus truth, and its standard deviation, radians; `None` for the plain filter.
    pub heading_bias: Option<(f64, f64)>,
    /// Whether satellite navigation was used at that time.
    pub is_aided: bool,
}

impl BeliefPoint {
    /// Reads a belief.
    pub(super) fn of<const N: usize>(
        belief: &Gaussian<N>,
        model: &impl VehicleModel<N>,
        time: f64,
        instruments: &Instruments,
        calibration: &Calibration,
    ) -> Self {
        let place = belief.marginal::<0, 2>();
        let of = |component| {
            let index = model.index_of(component)?;
            let deviation = belief.covariance[(index, index)].max(0.0).sqrt();
            Some((belief.mean[index], deviation))
        };
        let wind = model.wind_index();
        let wind_covariance = wind.map(|i| belief.covariance.fixed_view::<2, 2>(i, i).into_owned());
        let correction = calibration.heading_correction(time).angle();
        // What satellite navigation says of this time it says later.
        let there = instruments
            .readings
            .positions
            .at(time + calibration.delays.gps);
        Self {
            time,
            position: GroundPoint::new(place.mean.x, place.mean.y),
            covariance: place.covariance,
            error: there.map(|there| there - place.mean),
            wind: model.wind(&belief.mean).unwrap_or_default(),
            wind_covariance: wind_covariance.unwrap_or_default(),
            scale: of(StateComponent::AirspeedScale),
            heading_bias: of(StateComponent::HeadingBias)
                .map(|(bias, deviation)| (bias - correction, deviation)),
            is_aided: false,
        }
    }

    /// Longer half axis of the ellipse that holds the truth in 95 of 100 cases, m.
    pub fn radius(&self) -> f64 {
        let largest = self.covariance.symmetric_eigenvalues().max().max(0.0);
        (largest * chi_square_quantile(0.95, 2.0)).sqrt()
    }

    /// True if that ellipse holds the position by satellite navigation; `None` where that position is
    /// unknown.
    pub fn holds_truth(&self) -> Option<bool> {
        let error = self.error?;
        let inverse = self.covariance.try_inverse()?;
        Some((inverse * error).dot(&error) <= chi_square_quantile(0.95, 2.0))
    }
}

/// Beliefs of one way to navigate, along its track.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeliefTrack {
    /// Name of the way, as shown to people.
    pub label: String,
    /// In order of time.
    pub points: Vec<BeliefPoint>,
    /// Measurements that it refused, in words.
    pub findings: Vec<pilotage_flight::Finding>,
    /// Calibration of the instruments at the outage (or at the end).
    pub calibration: Calibration,
}

/// Error of a way to navigate, a while after the outage.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Growth {
    /// Seconds since the outage.
    pub since: f64,
    /// Distance from the position by satellite navigation, m, where known.
    pub error: Option<f64>,
    /// Longer half axis of the 95 % ellipse, m.
    pub radius: f64,
}

impl BeliefTrack {
    /// Error and doubt against the time since the outage, for the points within it (seconds by the stamps of satellite
    /// navigation, which come later than what they tell of).
    pub fn growth(&self, (from, to): (f64, f64)) -> Vec<Growth> {
        let growth = |p: &BeliefPoint| Growth {
            since: p.time + self.calibration.delays.gps - from,
            error: p.error.map(|e| e.norm()),
            radius: p.radius(),
        };
        let all = self.points.iter().map(growth);
        all.filter(|g| g.since >= 0.0 && g.since <= to - from)
            .collect()
    }
}
