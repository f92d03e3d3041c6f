//! Place of an aircraft on the map, as a filter believes it.

use nalgebra::{Matrix2, Vector2};

use super::Estimate;
use super::engine::{map_error, place_in_state};
use pilotage_estimation::vehicle::StateComponent;
use pilotage_mission::settings::NavigatorSettings;

/// Knowledge of where the map shows what is below the aircraft: its position and the error of the map together.
#[derive(Clone, Copy, Debug)]
pub struct PlaceOnMap {
    /// Place of the map's error north in the state, that east follows; `None` where they are no states.
    index: Option<usize>,
    /// Variance per axis of the map's error that is no state, m².
    beyond: f64,
}

impl PlaceOnMap {
    /// By a filter with these settings, on a map that is good to `map_deviation`, metres per axis.
    pub fn of(settings: &NavigatorSettings, map_deviation: f64) -> Self {
        let of_state = map_error(settings).map_or(0.0, |error| error.deviation.powi(2));
        Self {
            index: place_in_state(settings, StateComponent::MapErrorNorth),
            beyond: (map_deviation.powi(2) - of_state).max(0.0),
        }
    }

    /// Variance per axis of the map's error that is no state of the filter, m².
    pub fn beyond_state(&self) -> f64 {
        self.beyond
    }

    /// Mean, north and east.
    pub fn mean(&self, believed: &Estimate) -> Vector2<f64> {
        let of_map = |i: usize| Vector2::new(believed.mean[i], believed.mean[i + 1]);
        believed.position().to_vector() + self.index.map_or_else(Vector2::zeros, of_map)
    }

    /// Covariance of it, m², with the map's error that is no state.
    pub fn covariance(&self, believed: &Estimate) -> Matrix2<f64> {
        let own = self.covariance_with(believed, 0);
        let of_map = self.index.map(|i| self.covariance_with(believed, i));
        own + of_map.unwrap_or_else(Matrix2::zeros) + Matrix2::identity() * self.beyond
    }

    /// Covariance of the state's components `index` and the one after it (rows) with the place (columns: north, east).
    pub fn covariance_with(&self, believed: &Estimate, index: usize) -> Matrix2<f64> {
        let with = |i: usize| {
            believed
                .covariance
                .fixed_view::<2, 2>(index, i)
                .into_owned()
        };
        with(0) + self.index.map_or_else(Matrix2::zeros, with)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;
    use pilotage_mission::settings::VehicleChoice;
    use pilotage_vision::registration::FollowSettings;

    #[test]
    fn a_place_on_the_map_is_the_position_and_the_error_of_the_map_as_they_are_known_together() {
        let mut settings = NavigatorSettings {
            whole_frames: Some(FollowSettings {
                map_deviation: 3.0,
                ..FollowSettings::default()
            }),
            ..NavigatorSettings::default()
        };
        // North, east, two of the wind, and two of the map: each axis is known to 3 m, and so is the map, but the sum
        // of the two to half a metre: 9 + 9 - 2 · 8.875 = 0.25.
        let mut covariance = DMatrix::identity(6, 6) * 9.0;
        for (i, j) in [(0, 4), (1, 5)] {
            covariance[(i, j)] = -8.875;
            covariance[(j, i)] = -8.875;
        }
        covariance[(2, 4)] = 0.3;
        covariance[(4, 2)] = 0.3;
        let believed = Estimate {
            mean: DVector::from_vec(vec![10.0, 20.0, 1.0, 2.0, 6.0, -4.0]),
            covariance,
        };
        let place = PlaceOnMap::of(&settings, 3.0);
        assert_eq!(place.mean(&believed), Vector2::new(16.0, 16.0));
        let off = place.covariance(&believed) - Matrix2::identity() * 0.25;
        assert!(off.amax() < 1e-12, "{off}");
        assert_eq!(
            place.covariance_with(&believed, 2),
            Matrix2::new(0.3, 0.0, 0.0, 0.0)
        );
        // A height that is estimated leaves no room for the map in the largest model: its error stands beside the position.
        settings.estimates_height = true;
        settings.vehicle = VehicleChoice::AirplaneFull;
        let place = PlaceOnMap::of(&settings, 3.0);
        assert_eq!(place.mean(&believed), Vector2::new(10.0, 20.0));
        let off = place.covariance(&believed) - Matrix2::identity() * 18.0;
        assert!(off.amax() < 1e-12, "{off}");
    }
}
