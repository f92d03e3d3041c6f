//! Flight in a wandering wind with looks at landmarks, truth and filter side by side.

use nalgebra::{SMatrix, SVector, Vector2};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{Gaussian, SmootherLink, Ukf, UnscentedSettings};
use pilotage_estimation::vehicle::{AirData, AirplaneWind, ControlInput, VehicleModel};

use super::NormalDraws;

/// Airspeed of the flight, m/s.
pub const CRUISE: f64 = 20.0;

/// Motion of an airplane without any noise, in a wind that is known.
pub fn noiseless_airplane() -> AirplaneWind {
    AirplaneWind {
        air_data: AirData {
            airspeed_noise_density: 0.0,
            heading_noise_density: 0.0,
            position_noise_density: 0.0,
            ..AirData::default()
        },
        wind_noise_density: 0.0,
        start_wind_deviation: 0.0,
        ..AirplaneWind::default()
    }
}

/// Flight to the north by airspeed and heading, its wind unknown at the start, with looks that tell its place.
///
/// Truth moves as `real` says, noise included; the filter believes that it moves as `believed` says.
#[derive(Clone, Debug)]
pub struct LookedFlight {
    /// Seed of everything random.
    pub seed: u64,
    /// Motion as it is.
    pub real: AirplaneWind,
    /// Motion as the filter has it.
    pub believed: AirplaneWind,
    /// Length of a step, seconds.
    pub step: f64,
    /// Number of steps.
    pub steps: usize,
    /// Steps from one look to the next; 0 for none.
    pub every: usize,
    /// Steps without looks, from the first to before the second.
    pub blind: [usize; 2],
    /// Standard deviation of a look, metres on each axis, in truth and in the filter.
    pub look: f64,
}

/// Step of such a flight, after the look if there was one.
#[derive(Clone, Debug)]
pub struct LookedStep {
    /// Seconds since the start.
    pub time: f64,
    /// Truth: north, east (m), wind north, east (m/s).
    pub truth: SVector<f64, 4>,
    /// Belief of the filter.
    pub belief: Gaussian<4>,
    /// NIS of the look, where there was one.
    pub nis: Option<f64>,
    /// Link of the smoother from the step before to this one.
    pub link: SmootherLink<4>,
}

/// Standard deviation of the place at the start, metres on each axis.
pub const START: f64 = 3.0;

impl LookedFlight {
    /// Flies it; ends early where the filter fails.
    pub fn fly(&self) -> Vec<LookedStep> {
        let mut draws = NormalDraws::seeded(self.seed);
        let prior = self.believed.prior(GroundPoint::new(0.0, 0.0), START);
        let input = ControlInput::new(CRUISE, Attitude::level(0.0));
        let noise = SMatrix::<f64, 2, 2>::identity() * (self.look * self.look);
        let mut truth = prior.mean + draws.spread(&prior.covariance);
        let mut flown = Vec::with_capacity(self.steps);
        let Ok(mut filter) = Ukf::new(prior, UnscentedSettings::default()) else {
            return flown;
        };
        for number in 1..=self.steps {
            let unforeseen = self.real.process_noise(&truth, &input, self.step);
            truth = self.real.propagate(&truth, &input, self.step) + draws.spread(&unforeseen);
            let added = self
                .believed
                .process_noise(filter.mean(), &input, self.step);
            let moved = filter.predict(|x| self.believed.propagate(x, &input, self.step), &added);
            let Ok(prediction) = moved else {
                return flown;
            };
            let link = SmootherLink::of(&prediction, filter.weights());
            let seen = place(&truth) + draws.vector() * self.look;
            let nis = self.looks(number).then(|| take(&mut filter, seen, &noise));
            flown.push(LookedStep {
                time: number as f64 * self.step,
                truth,
                belief: filter.state(),
                nis: nis.flatten(),
                link,
            });
        }
        flown
    }

    fn looks(&self, step: usize) -> bool {
        let blind = (self.blind[0]..self.blind[1]).contains(&step);
        self.every > 0 && step.is_multiple_of(self.every) && !blind
    }
}

fn place(state: &SVector<f64, 4>) -> Vector2<f64> {
    state.fixed_rows::<2>(0).into_owned()
}

/// Takes a look into the belief, and gives its NIS.
fn take(filter: &mut Ukf<4>, seen: Vector2<f64>, noise: &SMatrix<f64, 2, 2>) -> Option<f64> {
    let expected = filter.predict_measurement(|x| Some(place(x)), noise).ok()?;
    Some(filter.correct(&expected, &seen).ok()?.nis)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flight_without_looks_drifts_as_its_filter_says() {
        let flight = LookedFlight {
            seed: 1,
            real: AirplaneWind::default(),
            believed: AirplaneWind::default(),
            step: 1.0,
            steps: 20,
            every: 0,
            blind: [0, 0],
            look: 5.0,
        };
        let mut nees = 0.0;
        for seed in 0..60 {
            let steps = LookedFlight {
                seed,
                ..flight.clone()
            }
            .fly();
            let last = steps.last().unwrap();
            assert_eq!((steps.len(), last.nis), (20, None));
            nees += last.belief.nees(&last.truth).unwrap() / 60.0;
        }
        // Four on average; of 60 independent runs the mean keeps within 1.1 in all but 1 of 400 cases.
        assert!((nees - 4.0).abs() < 1.1, "{nees}");
    }
}
