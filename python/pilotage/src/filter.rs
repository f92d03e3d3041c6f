//! The unscented Kalman filter by itself.

use numpy::{PyArray1, PyArray2};
use pilotage_core::filter::{Gate, Redraw, UnscentedSettings};
use pyo3::prelude::*;

use crate::arrays::{Matrix, Vector, numbers, numbers_of_rows, rows, vector};
use crate::error::filter_refusal;
use crate::model_of_state::Asked;
use crate::sized_filter::{Belief, CorrectionOfFilter, MOST, Measured, SizedFilter, sized_filter};
use crate::vehicle::{PythonControls, PythonVehicle};

/// Unscented Kalman filter over 1 to 12 components (DeAngelo 2016, Table 3), in square root form.
///
/// The covariance stays symmetric and positive whatever `alpha` is. `redraw` says whether the sigma points of a
/// measurement are drawn anew after the process noise was added, else the propagated ones are used (eq. 16).
#[pyclass(name = "Ukf", module = "pilotage")]
pub struct PythonUkf {
    filter: Box<dyn SizedFilter>,
}

impl PythonUkf {
    fn size(&self) -> usize {
        self.filter.size()
    }
}

#[pymethods]
impl PythonUkf {
    #[new]
    #[pyo3(signature = (mean, covariance, *, alpha = 1.0, beta = 2.0, kappa = 0.0, redraw = true))]
    fn new(
        mean: Vector<'_>,
        covariance: Matrix<'_>,
        alpha: f64,
        beta: f64,
        kappa: f64,
        redraw: bool,
    ) -> PyResult<Self> {
        let mean: Vec<f64> = mean.as_array().to_vec();
        let shape = (mean.len(), mean.len());
        let belief = Belief {
            covariance: numbers_of_rows(&covariance, shape, "covariance")?,
            mean,
        };
        let settings = UnscentedSettings {
            alpha,
            beta,
            redraw: if redraw {
                Redraw::AfterProcessNoise
            } else {
                Redraw::CarriedThrough
            },
        };
        let made = sized_filter(&belief, settings, kappa).ok_or_else(|| {
            let found = belief.mean.len();
            filter_refusal(format!("the mean has {found} components; give 1 to {MOST}"))
        })?;
        Ok(Self {
            filter: made.map_err(filter_refusal)?,
        })
    }

    /// Mean of the present belief.
    #[getter]
    fn mean<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.filter.belief().mean)
    }

    /// Covariance of the present belief.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        rows(py, self.size(), self.filter.belief().covariance)
    }

    /// Sigma points of the present belief, one a row, the centre first (2 n + 1 × n).
    #[getter]
    fn sigma_points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        rows(py, self.size(), self.filter.points())
    }

    /// Replaces the belief.
    fn reset(&mut self, mean: Vector<'_>, covariance: Matrix<'_>) -> PyResult<()> {
        let size = self.size();
        let belief = Belief {
            mean: numbers(&mean, size, "mean")?,
            covariance: numbers_of_rows(&covariance, (size, size), "covariance")?,
        };
        self.filter.reset(&belief).map_err(filter_refusal)
    }

    /// Moves the belief through `process` and adds `process_noise` (n × n, may be singular).
    ///
    /// `process` is a function from a state to the state after the step, both arrays of n, or a matrix n × n.
    fn predict(&mut self, process: &Bound<'_, PyAny>, process_noise: Matrix<'_>) -> PyResult<()> {
        let size = self.size();
        let noise = numbers_of_rows(&process_noise, (size, size), "process_noise")?;
        let asked = Asked::new(process, (size, size), "process")?;
        let done = self.filter.predict(&|state| asked.of(state), &noise);
        asked.judge(done.map_err(filter_refusal))
    }

    /// Moves the belief as a vehicle model moves with `controls` for `dt` seconds, with the model's process noise.
    fn predict_vehicle(
        &mut self,
        vehicle: &PythonVehicle,
        controls: &PythonControls,
        dt: f64,
    ) -> PyResult<()> {
        vehicle.predict(self.filter.as_mut(), controls, dt)
    }

    /// Corrects the belief by the values `measured` (m), with `noise` (m × m).
    ///
    /// `measurement` is a function from a state to the values that are expected in it, or a matrix m × n. With `gate`, a
    /// probability, a measurement that lies beyond so many of the sound ones leaves the belief as it is.
    #[pyo3(signature = (measured, measurement, noise, *, gate = None))]
    fn correct(
        &mut self,
        measured: Vector<'_>,
        measurement: &Bound<'_, PyAny>,
        noise: Matrix<'_>,
        gate: Option<f64>,
    ) -> PyResult<PythonCorrection> {
        let values: Vec<f64> = measured.as_array().to_vec();
        let size = values.len();
        let noise = numbers_of_rows(&noise, (size, size), "noise")?;
        if let Some(share) = gate.filter(|share| !(*share > 0.0 && *share < 1.0)) {
            return Err(filter_refusal(format!(
                "gate={share} is no probability between 0 and 1"
            )));
        }
        let asked = Asked::new(measurement, (size, self.size()), "measurement")?;
        let taken = self.filter.correct(&Measured {
            values: &values,
            model: &|state| asked.of(state),
            noise: &noise,
            gate: gate.map(|confidence| Gate { confidence }),
        });
        let taken = asked.judge(taken.map_err(filter_refusal))?;
        Ok(PythonCorrection {
            taken,
            states: self.size(),
        })
    }

    fn __repr__(&self) -> String {
        format!("<Ukf of {} components>", self.size())
    }
}

/// Correction of a filter, or what its gate refused.
#[pyclass(name = "Correction", module = "pilotage", frozen)]
pub struct PythonCorrection {
    taken: CorrectionOfFilter,
    states: usize,
}

#[pymethods]
impl PythonCorrection {
    /// Measurement minus expectation (m).
    #[getter]
    fn innovation<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.taken.innovation.clone())
    }

    /// Innovation covariance, noise included (m × m).
    #[getter]
    fn innovation_covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let size = self.taken.innovation.len();
        rows(py, size, self.taken.innovation_covariance.clone())
    }

    /// Kalman gain (n × m), or None where the gate refused the measurement.
    #[getter]
    fn gain<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        let size = self.taken.innovation.len();
        let gain = self.taken.gain.clone();
        gain.map(|gain| rows(py, size, gain)).transpose()
    }

    /// Normalized innovation squared.
    #[getter]
    fn nis(&self) -> f64 {
        self.taken.nis
    }

    /// Largest normalized innovation squared that the gate lets through; infinite without one.
    #[getter]
    fn limit(&self) -> f64 {
        self.taken.limit
    }

    /// Whether it corrected the belief.
    #[getter]
    fn accepted(&self) -> bool {
        self.taken.gain.is_some()
    }

    fn __repr__(&self) -> String {
        let (nis, accepted) = (self.taken.nis, self.accepted());
        let (states, values) = (self.states, self.taken.innovation.len());
        format!(
            "<Correction of {states} components by {values}: nis {nis:.3}, accepted {accepted}>"
        )
    }
}
