//! Engine for every kind of filter.

use nalgebra::{DMatrix, DVector, SVector};

use super::door::{CorrectedStep, Engine, MeasurementModel, PredictedStep};
use crate::navigator::Estimate;
use pilotage_base::frames::GroundPoint;
use pilotage_estimation::estimator::{Estimator, Expectation, StateModel};
use pilotage_estimation::filter::{FilterError, SigmaPoints};
use pilotage_estimation::vehicle::{ControlInput, StateComponent, VehicleModel};

/// A filter with its vehicle model.
#[derive(Clone)]
pub struct FilterEngine<const N: usize, V, F> {
    filter: F,
    model: V,
    heading_bias_index: Option<usize>,
    /// The first of the map's two components.
    map_error_index: Option<usize>,
    depends_on: Vec<usize>,
    /// Inputs between what is measured and now, with their lengths in seconds, the latest first.
    past: Vec<(ControlInput, f64)>,
}

impl<const N: usize, V: VehicleModel<N>, F: Estimator<N>> FilterEngine<N, V, F> {
    pub fn new(filter: F, model: V) -> Self {
        let mut engine = Self {
            heading_bias_index: model.index_of(StateComponent::HeadingBias),
            map_error_index: model.index_of(StateComponent::MapErrorNorth),
            filter,
            model,
            depends_on: Vec::new(),
            past: Vec::new(),
        };
        engine.depends_on = engine.measured_components();
        engine
    }

    /// The components on which what is measured now depends.
    fn measured_components(&self) -> Vec<usize> {
        let of_map = self.map_error_index.into_iter().flat_map(|i| [i, i + 1]);
        let own = [0, 1].into_iter().chain(self.heading_bias_index);
        own.chain(of_map).collect()
    }

    fn measure<'a>(
        &self,
        model: &'a MeasurementModel<'a>,
    ) -> impl Fn(&SVector<f64, N>) -> Option<DVector<f64>> + 'a + use<'a, N, V, F>
    where
        V: Clone + 'a,
    {
        let (vehicle, bias_index) = (self.model.clone(), self.heading_bias_index);
        let (past, map_error_index) = (self.past.clone(), self.map_error_index);
        move |x| {
            let bias = bias_index.map_or(0.0, |i| x[i]);
            model(on_map(was_at(&vehicle, &past, x), map_error_index, x), bias)
        }
    }
}

/// Place at which the map shows what is at `position`: what cameras see is compared with the map.
fn on_map<const N: usize>(
    position: GroundPoint,
    map_error_index: Option<usize>,
    x: &SVector<f64, N>,
) -> GroundPoint {
    match map_error_index {
        None => position,
        Some(i) => GroundPoint::new(position.north + x[i], position.east + x[i + 1]),
    }
}

/// Position of a vehicle of state `x` before the inputs of `past`, the latest first, if nothing unexpected
/// happened since.
fn was_at<const N: usize, V: VehicleModel<N>>(
    vehicle: &V,
    past: &[(ControlInput, f64)],
    x: &SVector<f64, N>,
) -> GroundPoint {
    let back = |x, (input, dt): &(ControlInput, f64)| vehicle.propagate(&x, input, -dt);
    vehicle.position(&past.iter().fold(*x, back))
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
        let layout = self.model.layout().into_iter();
        layout
            .map(|component| (component.key().to_owned(), component.unit().to_owned()))
            .collect()
    }

    fn heading_bias(&self) -> f64 {
        self.heading_bias_index
            .map_or(0.0, |i| self.filter.belief().mean[i])
    }

    fn predict(&mut self, input: &ControlInput, dt: f64) -> Result<PredictedStep, FilterError> {
        let step = self.filter.predict(&self.model, input, dt)?;
        Ok(PredictedStep {
            before: (&step.before).into(),
            after: (&step.after).into(),
            sigma_before: matrix(&step.sigma_points_before),
            sigma_after: matrix(&step.sigma_points_after),
        })
    }

    fn look_back(&mut self, past: Vec<(ControlInput, f64)>) {
        self.depends_on = if past.is_empty() {
            self.measured_components()
        } else {
            (0..N).collect()
        };
        self.past = past;
    }

    fn seen_from(&self) -> GroundPoint {
        let mean = self.filter.belief().mean;
        let seen_from = was_at(&self.model, &self.past, &mean);
        on_map(seen_from, self.map_error_index, &mean)
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
        DVector::from_column_slice(self.model.propagate(&state, input, dt).as_slice())
    }

    fn expect(
        &self,
        model: &MeasurementModel<'_>,
        noise: &DMatrix<f64>,
    ) -> Result<Expectation, FilterError> {
        let model = StateModel {
            of: &self.measure(model),
            depends_on: &self.depends_on,
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
        let measure = self.measure(model);
        let model = StateModel {
            of: &measure,
            depends_on: &self.depends_on,
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
