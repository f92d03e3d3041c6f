//! Logs of other programs, and tables, as they were written.

use std::path::PathBuf;
use std::sync::Arc;

use pilotage_core::flight::log::Log;
use pilotage_disk::opening::{OpenedPath, no_flight, open};
use pilotage_disk::workers::GoesOn;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::python_value;
use crate::interruption::unless_interrupted;
use crate::topic::PythonTopic;

/// A flight log: everything that a file holds, as it was written.
#[pyclass(name = "Log", module = "pilotage", frozen)]
pub struct PythonLog(Arc<Log>);

/// Reads a log of any format that Pilotage knows (PX4 ULog, ArduPilot dataflash binary and text, MAVLink telemetry,
/// MCAP, NMEA, SRT), tables (CSV, MATLAB), flight folders or photos.
///
/// `columns` is a file that says what the columns of tables mean, as `pilotage columns --save` writes it; `vehicle` is the
/// number of the system that flies, of a telemetry log of several.
#[pyfunction]
#[pyo3(signature = (path, *, columns = None, vehicle = None))]
pub fn read_log(
    py: Python<'_>,
    path: PathBuf,
    columns: Option<PathBuf>,
    vehicle: Option<u32>,
) -> PyResult<PythonLog> {
    let read = move |_: GoesOn<'_>| -> Result<Log, Box<dyn std::error::Error>> {
        let opened = open(&path, columns.as_deref()).map_err(|e| named(&path, &e.to_string()))?;
        match opened.of_vehicle(vehicle)? {
            OpenedPath::Log(log, _) => Ok(*log),
            OpenedPath::Folder(folder) | OpenedPath::Tables(folder) => Ok(folder.log()),
            OpenedPath::Nothing(told) => Err(no_flight(&path, &told).into()),
        }
    };
    Ok(PythonLog(Arc::new(unless_interrupted(py, read)?)))
}

/// The words of a failure, with the file before them where they lack it.
pub fn named(path: &std::path::Path, words: &str) -> String {
    let name = path.file_name().map(|name| name.to_string_lossy());
    if name.is_some_and(|name| words.contains(name.as_ref())) {
        return words.to_owned();
    }
    format!("{}: {words}", path.display())
}

#[pymethods]
impl PythonLog {
    /// Path of the file, or name of the flight.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Name of the format, for people.
    #[getter]
    fn format(&self) -> &'static str {
        self.0.format.label()
    }

    /// Kind of vehicle and software in the log's words, or "".
    #[getter]
    fn vehicle(&self) -> &str {
        &self.0.vehicle
    }

    /// Seconds since 1970 (UTC) at second zero of the log's time base, where the log tells.
    #[getter]
    fn utc_at_zero(&self) -> Option<f64> {
        self.0.utc_at_zero
    }

    /// First and last time, seconds; None without rows. Times far from those around them do not count.
    #[getter]
    fn span(&self) -> Option<(f64, f64)> {
        self.0.span()
    }

    /// Topics that have rows, in the order in which they were first met.
    #[getter]
    fn topics(&self) -> Vec<PythonTopic> {
        let topics = self.0.topics.iter().enumerate();
        let full = topics.filter(|(_, topic)| !topic.is_empty());
        full.map(|(place, _)| PythonTopic::new(&self.0, place))
            .collect()
    }

    /// Names of the topics that have rows.
    fn keys(&self) -> Vec<String> {
        let topics = self.0.topics.iter().filter(|topic| !topic.is_empty());
        topics.map(|topic| topic.name.to_string()).collect()
    }

    /// All topics by name, each a dictionary of the arrays of its fields with its "times".
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for topic in self.topics() {
            let topic = Bound::new(py, topic)?;
            all.set_item(topic.getattr("name")?, topic.call_method0("arrays")?)?;
        }
        Ok(all)
    }

    /// Parameters of the autopilot by name, as they were last set.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for parameter in &self.0.parameters {
            all.set_item(&parameter.name, parameter.value)?;
        }
        Ok(all)
    }

    /// Words of the autopilot: (seconds, text).
    #[getter]
    fn messages(&self) -> Vec<(f64, String)> {
        let messages = self.0.messages.iter();
        messages
            .map(|said| (said.time, said.text.clone()))
            .collect()
    }

    /// Changes of how it flies: (seconds, name of the mode).
    #[getter]
    fn modes(&self) -> Vec<(f64, String)> {
        let modes = self.0.modes.iter();
        modes
            .map(|change| (change.time, change.mode.clone()))
            .collect()
    }

    /// Statements of the log about itself: (name, text).
    #[getter]
    fn facts(&self) -> Vec<(String, String)> {
        let facts = self.0.facts.iter();
        let told = facts.map(|fact| (fact.name.clone(), fact.text.clone()));
        told.collect()
    }

    /// Report of what was read and skipped: bytes, messages, skipped places with their causes, gaps, remarks.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        python_value(py, &self.0.report)
    }

    fn __getitem__(&self, topic: &str) -> PyResult<PythonTopic> {
        let mut topics = self.0.topics.iter();
        // `GPS` is the first instance where there are several.
        let by_name = topics.position(|known| known.name.to_string() == topic);
        let mut topics = self.0.topics.iter();
        let found = by_name.or_else(|| topics.position(|known| known.name.name == topic));
        let Some(place) = found else {
            let known = self.keys().join(", ");
            let name = &self.0.name;
            return Err(PyKeyError::new_err(format!(
                "{name}: the log has no topic {topic:?}; it has {known}"
            )));
        };
        Ok(PythonTopic::new(&self.0, place))
    }

    fn __contains__(&self, topic: &str) -> bool {
        self.__getitem__(topic).is_ok()
    }

    fn __len__(&self) -> usize {
        self.keys().len()
    }

    fn __repr__(&self) -> String {
        let (format, topics) = (self.format(), self.__len__());
        format!("<Log {:?}: {format}, {topics} topics>", self.0.name)
    }
}
