//! Conclusions of the navigator, step by step, as arrays.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArray3};
use pilotage_core::navigator::{Estimate, Run, StepReport, Summary, decode_run, encode_run};
use pilotage_disk::files::write_whole;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{python_value, rows, squares, vector};
use crate::error::refusal;
use crate::interruption::unless_interrupted;

/// Conclusions of the navigator over a flight: one row of every array for each step.
///
/// The first two components of the state are metres north and east of the world's origin.
#[pyclass(name = "Run", module = "pilotage", frozen)]
pub struct PythonRun {
    run: Arc<Run>,
    summary: Option<Summary>,
    /// Sentences about what was assumed of the flight or left out.
    #[pyo3(get)]
    notes: Vec<String>,
}

impl PythonRun {
    /// A run with its summary, and what was assumed of its flight.
    pub fn new(run: Run, summary: Option<Summary>, notes: Vec<String>) -> Self {
        Self {
            run: Arc::new(run),
            summary,
            notes,
        }
    }

    fn each(&self, of: impl Fn(&StepReport) -> f64) -> Vec<f64> {
        self.run.steps.iter().map(of).collect()
    }

    fn means<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&StepReport) -> &Estimate,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let steps = self.run.steps.iter();
        let values = steps.flat_map(|step| of(step).mean.as_slice()).copied();
        rows(py, self.run.state_names.len(), values.collect())
    }

    fn covariances<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&StepReport) -> &Estimate,
    ) -> PyResult<Bound<'py, PyArray3<f64>>> {
        // Symmetric: columns are rows.
        let steps = self.run.steps.iter();
        let values = steps.flat_map(|step| of(step).covariance.as_slice());
        let shape = (self.run.steps.len(), self.run.state_names.len());
        squares(py, shape, values.copied().collect())
    }

    fn joint(&self, of: impl Fn(&pilotage_core::navigator::JointReport) -> f64) -> Vec<f64> {
        self.each(|step| {
            let joint = step.frame.as_ref().and_then(|frame| frame.joint.as_ref());
            joint.map_or(f64::NAN, &of)
        })
    }
}

/// Reads a run that `pilotage replay --out FILE`, the page or `Run.save` wrote.
#[pyfunction]
pub fn read_run(py: Python<'_>, path: PathBuf) -> PyResult<PythonRun> {
    let run = unless_interrupted(py, move |_| {
        let name = path.display().to_string();
        let bytes = std::fs::read(&path).map_err(|e| format!("{name}: {e}"))?;
        Ok(decode_run(&name, &bytes)?)
    })?;
    Ok(PythonRun::new(run, None, Vec::new()))
}

#[pymethods]
impl PythonRun {
    /// Name of the run, for people.
    #[getter]
    fn name(&self) -> &str {
        &self.run.name
    }

    /// Components of the state: (name, SI unit).
    #[getter]
    fn state_names(&self) -> Vec<(String, String)> {
        self.run.state_names.clone()
    }

    /// Ends of the steps, seconds in the flight's time base.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.each(|step| step.time))
    }

    /// Estimates after the corrections: steps × components.
    #[getter]
    fn mean<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.means(py, |step| &step.after)
    }

    /// Covariances after the corrections: steps × components × components.
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        self.covariances(py, |step| &step.after)
    }

    /// Estimates after the predictions, before the corrections.
    #[getter]
    fn predicted_mean<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.means(py, |step| &step.predicted)
    }

    /// Covariances after the predictions, before the corrections.
    #[getter]
    fn predicted_covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        self.covariances(py, |step| &step.predicted)
    }

    /// Positions by dead reckoning alone, metres north and east.
    #[getter]
    fn dead_reckoned<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let steps = self.run.steps.iter();
        let places = steps.flat_map(|step| [step.dead_reckoned.north, step.dead_reckoned.east]);
        rows(py, 2, places.collect())
    }

    /// Normalized innovation squared of the correction by the picture of each step; NaN where there was none.
    #[getter]
    fn nis<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.joint(|joint| joint.nis))
    }

    /// Degrees of freedom of `nis`; NaN where there was no correction.
    #[getter]
    fn degrees_of_freedom<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.joint(|joint| joint.degrees_of_freedom as f64))
    }

    /// Number of landmarks that corrected the estimate in each step.
    #[getter]
    fn landmarks_used<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        let steps = self.run.steps.iter();
        let used = steps.map(|s| s.frame.as_ref().map_or(0, |f| f.accepted().count() as u32));
        vector(py, used.collect())
    }

    /// Corrections by aids beside pictures, by the aid's name: arrays `times`, `nis`, `degrees_of_freedom`, `accepted`.
    #[getter]
    fn updates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let steps = self.run.steps.iter();
        let all: Vec<_> = steps
            .flat_map(|step| step.updates.iter().map(|update| (step.time, update)))
            .collect();
        let told = PyDict::new(py);
        for (_, first) in &all {
            if told.contains(&first.aid)? {
                continue;
            }
            let of_aid: Vec<_> = all.iter().filter(|(_, u)| u.aid == first.aid).collect();
            let arrays = PyDict::new(py);
            let times = of_aid.iter().map(|(time, _)| *time).collect();
            arrays.set_item("times", vector::<f64>(py, times))?;
            let nis = of_aid.iter().map(|(_, update)| update.nis).collect();
            arrays.set_item("nis", vector::<f64>(py, nis))?;
            let degrees = of_aid.iter().map(|(_, u)| u.degrees_of_freedom as u32);
            arrays.set_item("degrees_of_freedom", vector::<u32>(py, degrees.collect()))?;
            let accepted = of_aid.iter().map(|(_, update)| update.is_accepted());
            arrays.set_item("accepted", vector::<bool>(py, accepted.collect()))?;
            told.set_item(&first.aid, arrays)?;
        }
        Ok(told)
    }

    /// Summary as `pilotage replay` prints it, a dictionary; None of a run that was read from a file.
    #[getter]
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        python_value(py, &self.summary)
    }

    /// Settings of the navigator that made the run, a dictionary.
    #[getter]
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        python_value(py, &self.run.settings)
    }

    /// Writes the run, whole or not at all, for `read_run` and the page.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let write = || {
            let bytes = encode_run(&self.run).map_err(|e| format!("{}: {e}", path.display()))?;
            write_whole(&path, bytes)
        };
        py.detach(write).map_err(refusal)
    }

    fn __len__(&self) -> usize {
        self.run.steps.len()
    }

    fn __repr__(&self) -> String {
        format!("<Run {:?}: {} steps>", self.run.name, self.run.steps.len())
    }
}
