//! The uncertainty along a planned route, as a job.

use pilotage_core::frames::LocalFrame;
use pilotage_core::plan::{
    PlannedLandmark, PredictionRequest, RoutePrediction, cruise, longest_flight, planned_aircraft,
};
use pilotage_core::simulate::{FlightPlan, SensorSpec, world_origin};

use super::order::{Order, Urgency, WorkerRole};
use super::{Advance, JobEvent, PlannedPath, PredictionOrder, RunningJob, WorkerState};

/// Time between two records of a simulated flight, seconds, and a little more.
const RECORD: f64 = 0.06;

/// A prediction as a job.
pub struct Predict(pub PredictionOrder);

impl RunningJob for Predict {
    fn advance(
        &mut self,
        _: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let begun = clock();
        let prediction = self.0.predict()?;
        emit(JobEvent::Prediction {
            prediction: Box::new(prediction),
            computed: clock() - begun,
        });
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl PlannedPath {
    /// The flight that is planned.
    pub fn plan(&self) -> FlightPlan {
        let mut airframe = planned_aircraft();
        airframe.cruise = self.airspeed.unwrap_or(airframe.cruise);
        airframe.bank_limit = self.bank.unwrap_or(airframe.bank_limit);
        FlightPlan {
            name: String::new(),
            way_points: self.way_points.clone(),
            height: self.height,
            targets: self.targets.clone(),
            wind: self.wind.velocity(),
            longest: self.longest(),
            airframe,
            sensors: SensorSpec {
                frame_rate: self.rate(),
                ..SensorSpec::default()
            },
            camera: self.camera.clone(),
            frame_on_globe: LocalFrame::new(world_origin()),
            ground_down: self.ground_down,
        }
    }

    /// Pictures a second that are taken.
    fn rate(&self) -> f64 {
        self.frame_rate.unwrap_or_else(Self::usual_frame_rate)
    }

    /// Longest time for which it is flown, seconds.
    fn longest(&self) -> f64 {
        longest_flight(&self.way_points, self.airspeed.unwrap_or_else(cruise))
    }
}

impl PredictionOrder {
    /// The landmarks, with what is expected of them.
    pub fn planned_landmarks(&self) -> Vec<PlannedLandmark> {
        let planned = self.landmarks.iter();
        let planned = planned.map(|(landmark, detection)| PlannedLandmark {
            landmark: landmark.clone(),
            detection: detection.clone(),
        });
        planned.collect()
    }

    /// Whether the flight that a prediction is of was broken off before its end, as the wind is too strong to get on.
    pub fn is_stopped(&self, prediction: &RoutePrediction) -> bool {
        let (rate, longest) = (self.path.rate(), self.path.longest());
        let last = prediction.samples.last();
        last.is_some_and(|last| last.time + 1.0 / rate + RECORD >= longest)
    }

    /// Predicts.
    ///
    /// # Errors
    /// Why nothing can be predicted, in words.
    pub fn predict(&self) -> Result<RoutePrediction, String> {
        self.predict_while(&mut || true)
    }

    /// As [`Self::predict`], as long as `goes_on`, which is asked before each wind.
    ///
    /// # Errors
    /// Why nothing can be predicted, in words, or that nobody wants it to go on.
    pub fn predict_while(
        &self,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<RoutePrediction, String> {
        let (plan, landmarks) = (self.path.plan(), self.planned_landmarks());
        let request = PredictionRequest {
            plan: &plan,
            settings: &self.navigator,
            landmarks: &landmarks,
            wind_deviation: self.navigator.start.wind,
            worlds: self.worlds,
            seed: self.seed,
            limit: self.limit,
        };
        let prediction = request.predict_while(goes_on);
        prediction.map_err(|error| error.to_string())
    }
}

impl Order for PredictionOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn is_small(&self) -> bool {
        true
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(Predict(self))
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::camera::CameraModel;
    use pilotage_core::flight::{Flight, Frame, StartFix};
    use pilotage_core::frames::GroundPoint;
    use pilotage_core::plan::{DetectionStatistics, ExpectedDetection};
    use pilotage_core::simulate::{Scenario, Wind};

    use super::*;

    /// Prediction over the landmarks of a scenario, each found in six pictures of ten, with so many pictures a second.
    fn predicted(frame_rate: Option<f64>) -> RoutePrediction {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mission = scenario.mission();
        let path = PlannedPath {
            frame_rate,
            ..PlannedPath::level(scenario.route.clone(), scenario.height, Scenario::camera())
        };
        let found = DetectionStatistics::everywhere(ExpectedDetection {
            recognised: 1.0,
            per_frame: 0.6,
            covariance: nalgebra::Matrix4::identity() * 0.01,
        });
        let landmarks = mission.landmarks.iter();
        let order = PredictionOrder {
            landmarks: landmarks.map(|it| (it.clone(), found.clone())).collect(),
            worlds: 16,
            ..PredictionOrder::along(path, &mission)
        };
        order.predict().unwrap()
    }

    #[test]
    fn a_camera_that_takes_fewer_pictures_is_predicted_with_a_wider_corridor() {
        let mean = |prediction: &RoutePrediction| {
            let across = prediction.samples.iter().map(|it| it.corridor.across);
            across.sum::<f64>() / prediction.samples.len() as f64
        };
        let usual = predicted(None);
        assert_eq!(predicted(Some(2.0)), usual);
        let slow = predicted(Some(1.0 / 3.0));
        let ratio = usual.samples.len() as f64 / slow.samples.len() as f64;
        assert!((ratio - 6.0).abs() < 0.2, "one of six pictures: {ratio}");
        let (usual, slow) = (mean(&usual), mean(&slow));
        assert!(slow > 1.2 * usual, "{slow} {usual}");
    }

    #[test]
    fn a_flight_that_the_wind_stops_is_told_from_one_that_comes_to_its_end() {
        let mission = Scenario::named("distinct-400ft-calm").unwrap().mission();
        let places = [0.0, 800.0].map(|north| GroundPoint::new(north, 0.0));
        let is_stopped = |speed: f64| {
            let path = PlannedPath {
                wind: Wind { from: 0.0, speed },
                ..PlannedPath::level(places.to_vec(), 120.0, Scenario::camera())
            };
            let order = PredictionOrder {
                worlds: 2,
                ..PredictionOrder::along(path, &mission)
            };
            let prediction = order.predict().unwrap();
            order.is_stopped(&prediction)
        };
        // Northward at 18.9 m/s: nothing, ten and more than all of it from ahead.
        assert_eq!([0.0, 10.0, 25.0].map(is_stopped), [false, false, true]);
    }

    #[test]
    fn the_rate_of_a_flights_pictures_is_that_of_most_pairs() {
        let taken = |times: &[f64]| {
            let frames = times.iter().map(|time| Frame {
                time: *time,
                name: String::new(),
                stored_turn: 0.0,
            });
            PlannedPath::frame_rate_of(&Flight {
                name: String::new(),
                frame_on_globe: None,
                camera: CameraModel::pinhole(640, 480, 1.0),
                ground_down: 0.0,
                channels: Vec::new(),
                frames: frames.collect(),
                start: StartFix {
                    time: 0.0,
                    position: GroundPoint::default(),
                    standard_deviation: 1.0,
                },
                truth: None,
            })
        };
        // Every four seconds, and none in a turn.
        let slow = taken(&[0.0, 4.0, 8.0, 12.0, 40.0, 44.0]);
        assert_eq!(slow, Some(0.25));
        assert_eq!(PlannedPath::sparse(slow), slow);
        assert_eq!(PlannedPath::sparse(taken(&[0.0, 0.5, 1.0])), None);
        assert_eq!(PlannedPath::sparse(taken(&[0.0, 0.04, 0.08])), None);
        assert_eq!(taken(&[3.0]), None);
    }
}
