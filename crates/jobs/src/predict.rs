//! The uncertainty along a planned route, as a job.

use pilotage_core::frames::LocalFrame;
use pilotage_core::plan::{
    PlannedLandmark, PredictionRequest, RoutePrediction, longest_flight, planned_aircraft,
};
use pilotage_core::simulate::{FlightPlan, SensorSpec, world_origin};

use super::order::{Order, Urgency, WorkerRole};
use super::{Advance, JobEvent, PlannedPath, PredictionOrder, RunningJob, WorkerState};

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
            longest: longest_flight(&self.way_points, airframe.cruise),
            airframe,
            sensors: SensorSpec::default(),
            camera: self.camera.clone(),
            frame_on_globe: LocalFrame::new(world_origin()),
            ground_down: self.ground_down,
        }
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

    /// Predicts.
    pub fn predict(&self) -> Result<RoutePrediction, String> {
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
        request.predict().map_err(|error| error.to_string())
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
