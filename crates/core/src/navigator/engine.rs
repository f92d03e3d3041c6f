//! The filter behind one door, whatever the size of its state.

use nalgebra::{DMatrix, DVector, Dyn, SVector};

use super::{Estimate, NavigatorSettings, VehicleChoice};
use crate::filter::{FilterError, Redraw, SigmaPoints, Ukf, UnscentedSettings};
use crate::frames::GroundPoint;
use crate::vehicle::{
    AirData, AirDataBiases, AirplaneFull, AirplaneWind, AirplaneWindGust, ConstantVelocity,
    ControlInput, Gusts, RandomWalk, ThesisNoise, VehicleModel, VehicleSettings, VehicleVisitor,
};

/// What a measurement model may know of a state: position and the heading's bias, radians.
pub type MeasurementModel<'a> = dyn Fn(GroundPoint, f64) -> Option<DVector<f64>> + 'a;

/// A prediction, for the report.
pub struct PredictedStep {
    pub before: Estimate,
    pub after: Estimate,
    pub sigma_before: DMatrix<f64>,
    pub sigma_after: DMatrix<f64>,
}

/// What a measurement should be.
pub struct Expectation {
    pub mean: DVector<f64>,
    pub covariance: DMatrix<f64>,
}

/// A correction, for the report.
pub struct CorrectedStep {
    pub gain: DMatrix<f64>,
    pub innovation: DVector<f64>,
    pub innovation_covariance: DMatrix<f64>,
    pub sigma_before: DMatrix<f64>,
    pub sigma_after: DMatrix<f64>,
    pub after: Estimate,
}

/// A filter with its vehicle model.
pub trait Engine: Send {
    fn state(&self) -> Estimate;

    /// Names and units of the state's components.
    fn components(&self) -> Vec<(String, String)>;

    /// Bias of the heading in the present state, radians; zero without such a state.
    fn heading_bias(&self) -> f64;

    fn predict(&mut self, input: &ControlInput, dt: f64) -> Result<PredictedStep, FilterError>;

    /// The same filter with `factor` times its covariance.
    fn faded(&self, factor: f64) -> Result<Box<dyn Engine>, FilterError>;

    /// Moves a state by the process model alone.
    fn dead_reckon(&self, state: &DVector<f64>, input: &ControlInput, dt: f64) -> DVector<f64>;

    fn expect(
        &self,
        model: &MeasurementModel<'_>,
        noise: &DMatrix<f64>,
    ) -> Result<Expectation, FilterError>;

    fn correct(
        &mut self,
        model: &MeasurementModel<'_>,
        noise: &DMatrix<f64>,
        measurement: &DVector<f64>,
    ) -> Result<CorrectedStep, FilterError>;
}

#[derive(Clone)]
struct UkfEngine<const N: usize, V: VehicleModel<N>> {
    filter: Ukf<N>,
    model: V,
    heading_bias_index: Option<usize>,
}

impl<const N: usize, V: VehicleModel<N>> UkfEngine<N, V> {
    fn measure<'a>(
        &'a self,
        model: &'a MeasurementModel<'a>,
    ) -> impl Fn(&SVector<f64, N>) -> Option<DVector<f64>> + 'a {
        move |x| {
            let bias = self.heading_bias_index.map_or(0.0, |i| x[i]);
            model(self.model.position(x), bias)
        }
    }
}

fn matrix<const N: usize>(points: &SigmaPoints<N>) -> DMatrix<f64> {
    let columns: Vec<DVector<f64>> = points
        .iter()
        .map(|p| DVector::from_column_slice(p.as_slice()))
        .collect();
    DMatrix::from_columns(&columns)
}

impl<const N: usize, V: VehicleModel<N> + Clone + Send + 'static> Engine for UkfEngine<N, V> {
    fn state(&self) -> Estimate {
        estimate(&self.filter.state())
    }

    fn components(&self) -> Vec<(String, String)> {
        let names = self
            .model
            .state_names()
            .into_iter()
            .zip(self.model.state_units());
        names
            .map(|(name, unit)| (name.to_owned(), unit.to_owned()))
            .collect()
    }

    fn heading_bias(&self) -> f64 {
        self.heading_bias_index
            .map_or(0.0, |i| self.filter.mean()[i])
    }

    fn predict(&mut self, input: &ControlInput, dt: f64) -> Result<PredictedStep, FilterError> {
        let noise = self.model.noise_of_belief(&self.filter.state(), input, dt);
        let model = &self.model;
        let step = self
            .filter
            .predict(|x| model.propagate(x, input, dt), &noise)?;
        Ok(PredictedStep {
            before: estimate(&step.before),
            after: estimate(&step.after),
            sigma_before: matrix(&step.sigma_points_before),
            sigma_after: matrix(&step.sigma_points_after),
        })
    }

    fn faded(&self, factor: f64) -> Result<Box<dyn Engine>, FilterError> {
        let mut faded = self.clone();
        let mut belief = self.filter.state();
        belief.covariance *= factor;
        faded.filter.reset(&belief)?;
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
        let predicted = self
            .filter
            .predict_measurement::<Dyn>(self.measure(model), noise)?;
        Ok(Expectation {
            mean: predicted.mean,
            covariance: predicted.innovation_covariance,
        })
    }

    fn correct(
        &mut self,
        model: &MeasurementModel<'_>,
        noise: &DMatrix<f64>,
        measurement: &DVector<f64>,
    ) -> Result<CorrectedStep, FilterError> {
        let sigma_before = matrix(&self.filter.measurement_points());
        let predicted = self
            .filter
            .predict_measurement::<Dyn>(self.measure(model), noise)?;
        let step = self.filter.correct(&predicted, measurement)?;
        Ok(CorrectedStep {
            gain: DMatrix::from_column_slice(N, measurement.len(), step.gain.as_slice()),
            innovation: step.innovation,
            innovation_covariance: step.innovation_covariance,
            sigma_before,
            sigma_after: matrix(&self.filter.sigma_points()),
            after: estimate(&step.after),
        })
    }
}

fn estimate<const N: usize>(belief: &crate::filter::Gaussian<N>) -> Estimate {
    Estimate {
        mean: DVector::from_column_slice(belief.mean.as_slice()),
        covariance: DMatrix::from_column_slice(N, N, belief.covariance.as_slice()),
    }
}

/// The vehicle model that the settings ask for.
pub fn vehicle(settings: &NavigatorSettings) -> VehicleSettings {
    let p = &settings.process;
    let air_data = AirData {
        airspeed_noise_density: p.airspeed,
        heading_noise_density: p.heading,
        position_noise_density: p.position,
        ..AirData::default()
    };
    let gusts = Gusts {
        deviation: p.gust,
        per_wind: p.gust_per_wind,
        correlation_time: p.gust_time,
    };
    let start_wind_deviation = settings.start.wind;
    match settings.vehicle {
        VehicleChoice::AirplaneWind => VehicleSettings::AirplaneWind(AirplaneWind {
            air_data,
            wind_noise_density: p.wind,
            start_wind_deviation,
            thesis_noise: p.thesis_per_step.then_some(ThesisNoise::DistinctLandmarks),
        }),
        VehicleChoice::AirplaneGust => VehicleSettings::AirplaneWindGust(AirplaneWindGust {
            air_data,
            wind_noise_density: p.wind,
            start_wind_deviation,
            gusts,
        }),
        VehicleChoice::AirplaneFull => VehicleSettings::AirplaneFull(AirplaneFull {
            air_data,
            wind_noise_density: p.wind,
            start_wind_deviation,
            gusts,
            biases: AirDataBiases {
                start_airspeed_bias_deviation: p.airspeed_bias,
                start_heading_bias_deviation: p.heading_bias,
                airspeed_bias_noise_density: 0.0,
                heading_bias_noise_density: 0.0,
            },
        }),
        VehicleChoice::RandomWalk => VehicleSettings::RandomWalk(RandomWalk {
            position_noise_density: p.position,
        }),
        VehicleChoice::ConstantVelocity => VehicleSettings::ConstantVelocity(ConstantVelocity {
            velocity_noise_density: p.acceleration,
            start_velocity_deviation: start_wind_deviation,
        }),
    }
}

/// A filter at the start of a flight.
pub fn engine(
    settings: &NavigatorSettings,
    position: GroundPoint,
    deviation: f64,
) -> Result<Box<dyn Engine>, FilterError> {
    struct Build {
        unscented: UnscentedSettings,
        position: GroundPoint,
        deviation: f64,
    }
    impl VehicleVisitor for Build {
        type Output = Result<Box<dyn Engine>, FilterError>;

        fn visit<const N: usize, V>(self, model: V) -> Self::Output
        where
            V: VehicleModel<N> + Clone + Send + Sync + 'static,
        {
            let prior = model.prior(self.position, self.deviation);
            let heading_bias_index = model
                .state_names()
                .iter()
                .position(|n| *n == "heading bias");
            let filter = Ukf::new(prior, self.unscented)?;
            Ok(Box::new(UkfEngine {
                filter,
                model,
                heading_bias_index,
            }))
        }
    }
    vehicle(settings).visit(Build {
        unscented: UnscentedSettings {
            alpha: settings.alpha,
            beta: settings.beta,
            redraw: if settings.redraw {
                Redraw::AfterProcessNoise
            } else {
                Redraw::CarriedThrough
            },
        },
        position,
        deviation,
    })
}
