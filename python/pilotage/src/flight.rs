//! Flights as the navigator takes them: channels in SI units and radians, times of pictures, truth.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::{PyArray1, PyArray2};
use pilotage_core::flight::Flight;
use pilotage_disk::replaying::flight_at;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{rows, vector};
use crate::interruption::unless_interrupted;
use crate::log::named;

/// A flight as the navigator takes it: channels in SI units and radians in a world of north, east, down.
#[pyclass(name = "Flight", module = "pilotage", frozen)]
pub struct PythonFlight {
    flight: Arc<Flight>,
    /// Sentences about what was assumed or left out.
    #[pyo3(get)]
    notes: Vec<String>,
}

/// Reads a flight: a flight folder, a log, tables or photos, with their channels told apart.
///
/// `columns` says what the columns of tables mean; `vehicle` is the number of a system in a telemetry log.
#[pyfunction]
#[pyo3(signature = (path, *, columns = None, vehicle = None))]
pub fn read_flight(
    py: Python<'_>,
    path: PathBuf,
    columns: Option<PathBuf>,
    vehicle: Option<u32>,
) -> PyResult<PythonFlight> {
    unless_interrupted(py, move |_| {
        let read = flight_at(&path, columns.as_deref(), vehicle)
            .map_err(|e| named(&path, &e.to_string()))?;
        Ok(PythonFlight {
            flight: read.open.flight,
            notes: read.notes,
        })
    })
}

#[pymethods]
impl PythonFlight {
    /// Name for people.
    #[getter]
    fn name(&self) -> &str {
        &self.flight.name
    }

    /// Origin of the world, degrees north and east and metres, where it is known.
    #[getter]
    fn origin(&self) -> Option<(f64, f64, f64)> {
        let origin = self.flight.frame_on_globe?.origin;
        let (north, east) = (origin.latitude, origin.longitude);
        Some((north.to_degrees(), east.to_degrees(), origin.height))
    }

    /// First and last time at which anything was measured, seconds.
    #[getter]
    fn span(&self) -> (f64, f64) {
        self.flight.span()
    }

    /// Channels by name, each (times, values): seconds, and SI units or radians.
    #[getter]
    fn channels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let all = PyDict::new(py);
        for channel in &self.flight.channels {
            let times = vector(py, channel.times.clone());
            let values = vector(py, channel.values.clone());
            all.set_item(channel.name.key(), (times, values))?;
        }
        Ok(all)
    }

    /// SI units of the channels by name.
    #[getter]
    fn units(&self) -> std::collections::BTreeMap<&'static str, &'static str> {
        let channels = self.flight.channels.iter();
        let units = channels.map(|channel| (channel.name.key(), channel.name.quantity().unit()));
        units.collect()
    }

    /// Times of the pictures, seconds.
    #[getter]
    fn frame_times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.flight.frames.iter().map(|f| f.time).collect())
    }

    /// Names of the pictures.
    #[getter]
    fn frame_names(&self) -> Vec<&str> {
        let frames = self.flight.frames.iter();
        frames.map(|frame| frame.name.as_str()).collect()
    }

    /// True positions where they are known: rows of seconds, metres north, east and down.
    #[getter]
    fn truth<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        let Some(truth) = &self.flight.truth else {
            return Ok(None);
        };
        let row = |state: &pilotage_core::flight::TruthState| {
            let place = state.position;
            [state.time, place.x, place.y, place.z]
        };
        let values = truth.states.iter().flat_map(row).collect();
        Ok(Some(rows(py, 4, values)?))
    }

    fn __repr__(&self) -> String {
        let (channels, frames) = (self.flight.channels.len(), self.flight.frames.len());
        let name = &self.flight.name;
        format!("<Flight {name:?}: {channels} channels, {frames} pictures>")
    }
}
