//! Questions that a filter with its vehicle model can be asked, and its answers.

use nalgebra::{DMatrix, DVector};

use crate::navigator::Estimate;
use pilotage_base::frames::GroundPoint;
use pilotage_estimation::estimator::Expectation;
use pilotage_estimation::filter::FilterError;
use pilotage_estimation::vehicle::{ControlInput, Kinematics, KinematicsPart};

type MeasurementFunction<'a> = dyn Fn(&Kinematics) -> Option<DVector<f64>> + 'a;

/// Measurement of a vehicle as a function of how it moves; `None` where nothing can be.
pub struct MeasurementModel<'a> {
    pub of: Box<MeasurementFunction<'a>>,
    /// Part of the kinematics that the function looks at.
    pub part: KinematicsPart,
}

impl<'a> MeasurementModel<'a> {
    /// Of position and heading.
    pub fn of_pose(of: impl Fn(&Kinematics) -> Option<DVector<f64>> + 'a) -> Self {
        Self {
            of: Box::new(of),
            part: KinematicsPart::Pose,
        }
    }

    /// Of the velocity, too.
    pub fn of_motion(of: impl Fn(&Kinematics) -> Option<DVector<f64>> + 'a) -> Self {
        Self {
            of: Box::new(of),
            part: KinematicsPart::Motion,
        }
    }
}

/// A prediction, for the report.
#[derive(Clone)]
pub struct PredictedStep {
    pub before: Estimate,
    pub after: Estimate,
    pub sigma_before: DMatrix<f64>,
    pub sigma_after: DMatrix<f64>,
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

    /// Speed through the air that is made along the heading with these readings, m/s: zero where no heading carries the
    /// vehicle.
    fn speed_by_heading(&self, input: &ControlInput) -> f64;

    /// Takes what is measured for what was before the inputs of `past` (with their lengths in seconds, the
    /// latest first), from here on.
    fn look_back(&mut self, past: Vec<(ControlInput, f64)>);

    /// Takes what is measured for what is now, when the vehicle's own instruments read `input`, from here on.
    fn look_now(&mut self, input: &ControlInput);

    /// Position of the vehicle on the map when what is measured happened: the map's error is in it.
    fn seen_from(&self) -> GroundPoint;

    /// The same filter once more.
    fn another(&self) -> Box<dyn Engine>;

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
