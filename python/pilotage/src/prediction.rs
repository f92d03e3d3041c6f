//! The corridor along a planned route.

use std::cell::RefCell;
use std::path::PathBuf;

use nalgebra::{Matrix4, Vector4};
use numpy::{PyArray1, PyArray2, PyArray3};
use pilotage_core::plan::{
    DetectionStatistics, ExpectedDetection, PredictionSample, RoutePrediction,
};
use pilotage_disk::landmarks::{enabled, expected_while};
use pilotage_disk::planned_flight::{PlanSource, PlannedFlight};
use pilotage_disk::predict::prediction;
use pilotage_jobs::{FINE, PredictionOrder};
use pyo3::prelude::*;

use crate::arrays::{matrix, python_value, rows, squares, vector};
use crate::interruption::unless_interrupted;

/// Errors of a landmark's place that is stated to be found: metres, and radians with the logarithm of the size.
const STATED: [f64; 2] = [0.5, 0.02];

/// The uncertainty of the position along a route, before the flight: one row of every array for each picture.
#[pyclass(name = "Prediction", module = "pilotage", frozen)]
pub struct PythonPrediction {
    prediction: RoutePrediction,
    /// Names of the landmarks, in the order of the columns of `detection`.
    #[pyo3(get)]
    landmarks: Vec<String>,
    /// Sentences on what was assumed of the files, and on how each landmark was measured.
    #[pyo3(get)]
    notes: Vec<String>,
}

/// Predicts how well the position will be known along a route, as `pilotage plan --predict` does.
///
/// The route is that of `mission` called `route`, or its first, over `map` if the file holds none, or that of a built-in
/// `scenario`; the ground is as high as the elevation model `dem` says, and level without. Landmarks are measured over the
/// map, or found as `detection` states it: the probability that one can be recognised on the day, and that in which it is then found in a picture. `worlds` are ways in which wind and detections
/// may turn out: 8 are coarse, 100 are fine. `limit` is the accepted standard deviation in metres.
#[pyfunction]
#[pyo3(signature = (
    mission = None,
    *,
    scenario = None,
    route = None,
    map = None,
    flight = None,
    height = None,
    dem = None,
    detection = None,
    worlds = FINE,
    seed = None,
    limit = f64::INFINITY,
))]
pub fn predict_route(
    py: Python<'_>,
    mission: Option<PathBuf>,
    scenario: Option<String>,
    route: Option<&str>,
    map: Option<PathBuf>,
    flight: Option<PathBuf>,
    height: Option<f64>,
    dem: Option<PathBuf>,
    detection: Option<(f64, f64)>,
    worlds: usize,
    seed: Option<u64>,
    limit: f64,
) -> PyResult<PythonPrediction> {
    let source = PlanSource {
        scenario,
        mission,
        map,
        flight,
        height,
        dem,
    };
    let route = route.map(ToOwned::to_owned);
    unless_interrupted(py, move |goes_on| {
        let ground = PlannedFlight::along(&source, route.as_deref())?;
        let order = prediction(&ground, seed)?;
        let notes = RefCell::new(ground.notes.clone());
        let say = |line: &str| notes.borrow_mut().push(line.to_owned());
        let landmarks = match detection {
            None => expected_while(&ground, seed, &say, goes_on)?,
            Some(stated) => {
                let statistics = as_stated(stated);
                let landmarks = enabled(&ground).into_iter();
                let stated = landmarks.map(|landmark| (landmark.clone(), statistics.clone()));
                stated.collect()
            }
        };
        let order = PredictionOrder {
            landmarks,
            worlds,
            limit,
            ..order
        };
        let names = order.landmarks.iter();
        Ok(PythonPrediction {
            prediction: order.predict_while(&mut || goes_on().is_ok())?,
            landmarks: names.map(|(landmark, _)| landmark.name.clone()).collect(),
            notes: notes.into_inner(),
        })
    })
}

fn as_stated((recognised, per_frame): (f64, f64)) -> DetectionStatistics {
    let [place, turn] = STATED;
    let deviations = Vector4::new(place, place, turn, turn);
    DetectionStatistics::everywhere(ExpectedDetection {
        recognised,
        per_frame,
        covariance: Matrix4::from_diagonal(&deviations.component_mul(&deviations)),
    })
}

impl PythonPrediction {
    fn each<'py>(
        &self,
        py: Python<'py>,
        of: impl Fn(&PredictionSample) -> f64,
    ) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.prediction.samples.iter().map(of).collect())
    }
}

#[pymethods]
impl PythonPrediction {
    /// Seconds after the start.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.each(py, |sample| sample.time)
    }

    /// Distance along the flown path, metres.
    #[getter]
    fn distance<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.each(py, |sample| sample.distance)
    }

    /// Planned positions, metres north and east.
    #[getter]
    fn position<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let samples = self.prediction.samples.iter();
        let places = samples.flat_map(|sample| [sample.position.north, sample.position.east]);
        rows(py, 2, places.collect())
    }

    /// Courses over ground, radians clockwise from north.
    #[getter]
    fn course<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.each(py, |sample| sample.course)
    }

    /// Covariances of the error (north, east), m².
    #[getter]
    fn covariance<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let samples = self.prediction.samples.iter();
        let values = samples.flat_map(|sample| sample.corridor.covariance.as_slice());
        let shape = (self.prediction.samples.len(), 2);
        squares(py, shape, values.copied().collect())
    }

    /// Standard deviations along the longer axis, metres.
    #[getter]
    fn sigma_major<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.each(py, |sample| sample.corridor.sigma_major)
    }

    /// Standard deviations along the shorter axis, metres.
    #[getter]
    fn sigma_minor<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.each(py, |sample| sample.corridor.sigma_minor)
    }

    /// Half widths across the course of the strip that holds the error with 95 %, metres.
    #[getter]
    fn across<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.each(py, |sample| sample.corridor.across)
    }

    /// Half lengths along the course of the strip that holds the error with 95 %, metres.
    #[getter]
    fn along<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.each(py, |sample| sample.corridor.along)
    }

    /// Seconds since a picture in which finding any landmark was more likely than not.
    #[getter]
    fn dead_reckoning<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.each(py, |sample| sample.dead_reckoning)
    }

    /// Probabilities that each landmark (column) is found in each picture (row).
    #[getter]
    fn detection<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let samples = self.prediction.samples.iter();
        let values = samples.flat_map(|sample| &sample.detection).copied();
        let shape = (self.prediction.samples.len(), self.landmarks.len());
        matrix(py, shape, values.collect())
    }

    /// Stretches over the limit: dictionaries with where they begin and end along the path, and how bad they are.
    #[getter]
    fn over_limit<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        python_value(py, &self.prediction.over_limit)
    }

    fn __len__(&self) -> usize {
        self.prediction.samples.len()
    }

    fn __repr__(&self) -> String {
        let (count, landmarks) = (self.prediction.samples.len(), self.landmarks.len());
        format!("<Prediction: {count} pictures over {landmarks} landmarks>")
    }
}
