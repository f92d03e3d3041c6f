//! Engine for every kind of filter.

use nalgebra::{DMatrix, DVector, SVector};

use super::door::{CorrectedStep, Engine, MeasurementModel, PredictedStep};
use crate::navigator::Estimate;
use pilotage_base::frames::GroundPoint;
use pilotage_estimation::estimator::{Estimator, Expectation, StateModel};
use pilotage_estimation::filter::{FilterError, SigmaPoints};
use pilotage_estimation::vehicle::{
    ControlInput, Kinematics, KinematicsPart, KinematicsReader, VehicleModel,
};

/// A filter with its vehicle model.
#[derive(Clone)]
pub struct FilterEngine<const N: usize, V, F> {
    filter: F,
    vehicle: Observed<V>,
}

/// A vehicle model as measurement models see it.
#[derive(Clone)]
struct Observed<V> {
    model: V,
    reader: KinematicsReader,
    /// Readings at the moment of what is measured.
    input: ControlInput,
    /// Inputs between what is measured and now, with their lengths in seconds, the latest first.
    past: Vec<(ControlInput, f64)>,
}

impl<const N: usize, V: VehicleModel<N>, F: Estimator<N>> FilterEngine<N, V, F> {
    pub fn new(filter: F, model: V) -> Self {
        let vehicle = Observed {
            reader: KinematicsReader::of(&model.layout()),
            model,
            input: ControlInput::default(),
            past: Vec::new(),
        };
        Self { filter, vehicle }
    }
}

impl<V> Observed<V> {
    /// The components on which what is measured now of this part depends.
    fn components<const N: usize>(&self, part: KinematicsPart) -> Vec<usize> {
        if part == KinematicsPart::Pose && self.past.is_empty() {
            self.reader.pose_components().collect()
        } else {
            (0..N).collect()
        }
    }

    /// Kinematics in the state `x`, the position as it was before the inputs of the past if nothing unexpected
    /// happened since.
    fn kinematics<const N: usize>(&self, x: &SVector<f64, N>, part: KinematicsPart) -> Kinematics
    where
        V: VehicleModel<N>,
    {
        let back = |x, (input, dt): &(ControlInput, f64)| self.model.propagate(&x, input, -dt);
        let then = self.past.iter().fold(*x, back);
        self.reader.read(&self.model, part, (x, &then), &self.input)
    }
}

fn matrix<const N: usize>(points: &SigmaPoints<N>) -> DMatrix<f64> {
    let columns: Vec<DVector<f64>> = points
        .iter()
        .map(|p| DVector::from_column_slice(p.as_slice()))
        .collect();
    DMatrix::from_columns(&columns)
}

impl<const N: usize, V, F> Engine for FilterEngine<N, V, F>
where
    V: VehicleModel<N> + Clone + Send + 'static,
    F: Estimator<N> + 'static,
{
    fn state(&self) -> Estimate {
        (&self.filter.belief()).into()
    }

    fn components(&self) -> Vec<(String, String)> {
        let layout = self.vehicle.model.layout().into_iter();
        layout
            .map(|component| (component.key().to_owned(), component.unit().to_owned()))
            .collect()
    }

    fn heading_bias(&self) -> f64 {
        let mean = self.filter.belief().mean;
        self.vehicle.reader.heading_bias(&mean).unwrap_or(0.0)
    }

    fn predict(&mut self, input: &ControlInput, dt: f64) -> Result<PredictedStep, FilterError> {
        let step = self.filter.predict(&self.vehicle.model, input, dt)?;
        Ok(PredictedStep {
            before: (&step.before).into(),
            after: (&step.after).into(),
            sigma_before: matrix(&step.sigma_points_before),
            sigma_after: matrix(&step.sigma_points_after),
        })
    }

    fn speed_by_heading(&self, input: &ControlInput) -> f64 {
        let (mean, model) = (self.filter.belief().mean, &self.vehicle.model);
        let over_ground = model.ground_velocity(&mean, input);
        let through_air = over_ground.zip(model.wind(&mean)).map(|(v, wind)| v - wind);
        through_air.map_or(0.0, |velocity| velocity.norm())
    }

    fn look_back(&mut self, past: Vec<(ControlInput, f64)>) {
        self.vehicle.past = past;
    }

    fn look_now(&mut self, input: &ControlInput) {
        self.vehicle.input = *input;
        self.vehicle.past.clear();
    }

    fn seen_from(&self) -> GroundPoint {
        let mean = self.filter.belief().mean;
        self.vehicle.kinematics(&mean, KinematicsPart::Pose).on_map
    }

    fn another(&self) -> Box<dyn Engine> {
        Box::new(self.clone())
    }

    fn faded(&self, factor: f64) -> Result<Box<dyn Engine>, FilterError> {
        let mut faded = self.clone();
        faded.filter.fade(factor)?;
        Ok(Box::new(faded))
    }

    fn dead_reckon(&self, state: &DVector<f64>, input: &ControlInput, dt: f64) -> DVector<f64> {
        let state = SVector::<f64, N>::from_column_slice(state.as_slice());
        DVector::from_column_slice(self.vehicle.model.propagate(&state, input, dt).as_slice())
    }

    fn expect(
        &self,
        model: &MeasurementModel<'_>,
        noise: &DMatrix<f64>,
    ) -> Result<Expectation, FilterError> {
        let vehicle = &self.vehicle;
        let model = StateModel {
            of: &|x| (model.of)(&vehicle.kinematics(x, model.part)),
            depends_on: &vehicle.components::<N>(model.part),
        };
        self.filter.expect(&model, noise)
    }

    fn correct(
        &mut self,
        model: &MeasurementModel<'_>,
        noise: &DMatrix<f64>,
        measurement: &DVector<f64>,
    ) -> Result<CorrectedStep, FilterError> {
        let sigma_before = matrix(&self.filter.measurement_points());
        let vehicle = &self.vehicle;
        let model = StateModel {
            of: &|x| (model.of)(&vehicle.kinematics(x, model.part)),
            depends_on: &vehicle.components::<N>(model.part),
        };
        let step = self.filter.correct(&model, noise, measurement)?;
        Ok(CorrectedStep {
            gain: step.gain,
            innovation: step.innovation,
            innovation_covariance: step.innovation_covariance,
            sigma_before,
            sigma_after: matrix(&self.filter.points()),
            after: (&step.after).into(),
        })
    }
}
