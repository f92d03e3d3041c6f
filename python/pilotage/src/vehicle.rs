//! Vehicle models by themselves, and readings of instruments.

use nalgebra::{SVector, Vector2};
use numpy::{PyArray1, PyArray2};
use pilotage_core::filter::Ukf;
use pilotage_core::frames::{Attitude, GroundPoint};
use pilotage_core::vehicle::{
    ControlInput, VehicleModel, VehicleSettings, VehicleVisitor, all_vehicles,
};
use pilotage_estimation::estimator::Estimator;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, Value};

use crate::arrays::{Matrix, Vector, numbers, python_value, rows, vector};
use crate::error::{filter_refusal, refusal};
use crate::sized_filter::{Belief, SizedFilter};

/// Arrays of a mean and a covariance.
type MeanAndCovariance<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>);

/// Readings of the vehicle's own instruments at a moment: m/s, radians, radians a second.
#[pyclass(name = "Controls", module = "pilotage", frozen)]
pub struct PythonControls(ControlInput);

#[pymethods]
impl PythonControls {
    /// `airspeed` is true airspeed, `heading` clockwise from north, `ground_velocity` north and east where something other
    /// than satellites measures it, `heading_deviation` the standard deviation of a heading that is held from earlier, for
    /// `heading_held` seconds, and `tilt_deviation` that of roll and pitch that are not read.
    #[new]
    #[pyo3(signature = (
        *,
        airspeed = None,
        heading = 0.0,
        roll = 0.0,
        pitch = 0.0,
        turn_rate = 0.0,
        ground_velocity = None,
        heading_deviation = 0.0,
        heading_held = 0.0,
        tilt_deviation = 0.0,
    ))]
    fn new(
        airspeed: Option<f64>,
        heading: f64,
        roll: f64,
        pitch: f64,
        turn_rate: f64,
        ground_velocity: Option<(f64, f64)>,
        heading_deviation: f64,
        heading_held: f64,
        tilt_deviation: f64,
    ) -> Self {
        let yaw = heading;
        Self(ControlInput {
            airspeed,
            attitude: Attitude { roll, pitch, yaw },
            turn_rate,
            ground_velocity: ground_velocity.map(|(north, east)| Vector2::new(north, east)),
            heading_deviation,
            heading_held,
            tilt_deviation,
        })
    }

    fn __repr__(&self) -> String {
        format!("{:?}", self.0)
    }
}

/// Names of the vehicle models.
#[pyfunction]
pub fn vehicle_models() -> Vec<&'static str> {
    let vehicles = all_vehicles();
    vehicles.iter().map(VehicleSettings::key).collect()
}

/// Model of how a vehicle moves, by its name, with changes to its settings: `Vehicle("airplane-wind", wind=0.2)`.
#[pyclass(name = "Vehicle", module = "pilotage", frozen)]
pub struct PythonVehicle(VehicleSettings);

impl PythonVehicle {
    /// Moves the belief of a filter as this vehicle moves.
    pub fn predict(
        &self,
        filter: &mut dyn SizedFilter,
        controls: &PythonControls,
        dt: f64,
    ) -> PyResult<()> {
        let (input, size) = (&controls.0, filter.size());
        self.0.visit(Predict { filter, input, dt }).ok_or_else(|| {
            let (key, states) = (self.0.key(), self.0.state_components().len());
            filter_refusal(format!(
                "the filter has {size} components where {key} has {states}"
            ))
        })?
    }

    /// Answer to a question about each of the states, which are rows of an array, or one array.
    fn of_states(&self, states: &Matrix<'_>, of: Answer<'_>) -> PyResult<Vec<f64>> {
        let size = self.0.state_components().len();
        let array = states.as_array();
        if array.ncols() != size {
            let (key, found) = (self.0.key(), array.ncols());
            return Err(refusal(format!(
                "the states have {found} components where {key} has {size}"
            )));
        }
        let values: Vec<f64> = array.iter().copied().collect();
        Ok(self.0.visit(Each { values, of }))
    }
}

struct Predict<'a> {
    filter: &'a mut dyn SizedFilter,
    input: &'a ControlInput,
    dt: f64,
}

impl VehicleVisitor for Predict<'_> {
    /// None where the filter has another size.
    type Output = Option<PyResult<()>>;

    fn visit<const N: usize, V>(self, model: V) -> Self::Output
    where
        V: VehicleModel<N> + Clone + Send + Sync + 'static,
    {
        let filter = self.filter.as_any_mut().downcast_mut::<Ukf<N>>()?;
        let moved = Estimator::predict(filter, &model, self.input, self.dt);
        Some(moved.map(drop).map_err(filter_refusal))
    }
}

/// Question about a state.
#[derive(Clone, Copy)]
enum Answer<'a> {
    /// The state after so many seconds.
    Moved(&'a ControlInput, f64),
    /// Its slope with the state, row by row.
    Slope(&'a ControlInput, f64),
    /// Covariance of what is added, row by row.
    Noise(&'a ControlInput, f64),
}

struct Each<'a> {
    values: Vec<f64>,
    of: Answer<'a>,
}

impl VehicleVisitor for Each<'_> {
    type Output = Vec<f64>;

    fn visit<const N: usize, V>(self, model: V) -> Vec<f64>
    where
        V: VehicleModel<N> + Clone + Send + Sync + 'static,
    {
        let states = self.values.chunks_exact(N);
        let states = states.map(SVector::<f64, N>::from_column_slice);
        let answer = |state: SVector<f64, N>| -> Vec<f64> {
            match self.of {
                Answer::Moved(input, dt) => model.propagate(&state, input, dt).as_slice().to_vec(),
                Answer::Slope(input, dt) => {
                    let slope = model.transition(&state, input, dt);
                    slope.transpose().as_slice().to_vec()
                }
                Answer::Noise(input, dt) => {
                    model.process_noise(&state, input, dt).as_slice().to_vec()
                }
            }
        };
        states.flat_map(answer).collect()
    }
}

struct Prior(GroundPoint, f64);

impl VehicleVisitor for Prior {
    type Output = Belief;

    fn visit<const N: usize, V>(self, model: V) -> Belief
    where
        V: VehicleModel<N> + Clone + Send + Sync + 'static,
    {
        let prior = model.prior(self.0, self.1);
        Belief {
            mean: prior.mean.as_slice().to_vec(),
            covariance: prior.covariance.as_slice().to_vec(),
        }
    }
}

#[pymethods]
impl PythonVehicle {
    #[new]
    #[pyo3(signature = (model = "airplane-wind", **settings))]
    fn new(model: &str, settings: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let usual = VehicleSettings::from_key(model).ok_or_else(|| {
            let known = vehicle_models().join(", ");
            refusal(format!(
                "there is no vehicle model {model:?}; there are: {known}"
            ))
        })?;
        let Some(settings) = settings else {
            return Ok(Self(usual));
        };
        let text: String = settings
            .py()
            .import("json")?
            .call_method1("dumps", (settings,))?
            .extract()?;
        let changes: Map<String, Value> = serde_json::from_str(&text).map_err(refusal)?;
        let mut all = serde_json::to_value(usual).map_err(refusal)?;
        for (name, value) in changes {
            let Some(known) = setting(&mut all, &name) else {
                return Err(refusal(format!(
                    "{model} has no setting {name:?}; it has {all}"
                )));
            };
            *known = value;
        }
        let changed = serde_json::from_value(all);
        Ok(Self(changed.map_err(|e| refusal(format!("{model}: {e}")))?))
    }

    /// Name of the model.
    #[getter]
    fn model(&self) -> &'static str {
        self.0.key()
    }

    /// Description of its assumptions, in a sentence.
    #[getter]
    fn description(&self) -> &'static str {
        self.0.description()
    }

    /// Components of the state: (name, SI unit).
    #[getter]
    fn state_names(&self) -> Vec<(&'static str, &'static str)> {
        self.0.state_components()
    }

    /// Settings of the model, a dictionary.
    #[getter]
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        python_value(py, &self.0)
    }

    /// Belief at the start: (mean, covariance), with the position known to `deviation` metres on each axis.
    #[pyo3(signature = (north = 0.0, east = 0.0, *, deviation = 3.0))]
    fn prior<'py>(
        &self,
        py: Python<'py>,
        north: f64,
        east: f64,
        deviation: f64,
    ) -> PyResult<MeanAndCovariance<'py>> {
        let prior = self
            .0
            .visit(Prior(GroundPoint::new(north, east), deviation));
        let size = prior.mean.len();
        Ok((vector(py, prior.mean), rows(py, size, prior.covariance)?))
    }

    /// States after `dt` seconds if nothing unexpected happens; `states` has one a row.
    fn propagate<'py>(
        &self,
        py: Python<'py>,
        states: Matrix<'py>,
        controls: &PythonControls,
        dt: f64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let moved = self.of_states(&states, Answer::Moved(&controls.0, dt))?;
        rows(py, self.0.state_components().len(), moved)
    }

    /// Slope of `propagate` with the state (n × n).
    fn transition<'py>(
        &self,
        py: Python<'py>,
        state: Vector<'py>,
        controls: &PythonControls,
        dt: f64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.matrix(py, &state, Answer::Slope(&controls.0, dt))
    }

    /// Covariance of what unexpected things add to the state in `dt` seconds (n × n).
    fn process_noise<'py>(
        &self,
        py: Python<'py>,
        state: Vector<'py>,
        controls: &PythonControls,
        dt: f64,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.matrix(py, &state, Answer::Noise(&controls.0, dt))
    }

    fn __repr__(&self) -> String {
        format!("Vehicle({:?})", self.0.key())
    }
}

impl PythonVehicle {
    fn matrix<'py>(
        &self,
        py: Python<'py>,
        state: &Vector<'_>,
        of: Answer<'_>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let size = self.0.state_components().len();
        let values = numbers(state, size, "state")?;
        rows(py, size, self.0.visit(Each { values, of }))
    }
}

/// The setting of that name, at whatever depth.
fn setting<'a>(all: &'a mut Value, name: &str) -> Option<&'a mut Value> {
    let Value::Object(all) = all else { return None };
    if name != "model" && all.contains_key(name) {
        return all.get_mut(name);
    }
    all.values_mut().find_map(|value| setting(value, name))
}
