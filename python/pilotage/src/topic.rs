//! Topics of logs: rows of one kind with their times.

use std::sync::Arc;

use numpy::PyArray1;
use pilotage_core::flight::log::{FieldLayout, Log, Topic};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::vector;
use crate::field_array::{FieldArray, kind_name};

/// A field of a topic: its name, its unit as the file says it (or ""), and the kind of its array.
#[pyclass(name = "Field", module = "pilotage", frozen, get_all)]
pub struct PythonField {
    /// Name as the file has it; elements of arrays as `name[3]`.
    name: String,
    /// Unit of the values as the file says it (`m/s`, `deg`), or "".
    unit: String,
    /// Kind of its array (`float32`, `uint64`), `str` or `bytes`.
    kind: &'static str,
}

#[pymethods]
impl PythonField {
    fn __repr__(&self) -> String {
        let Self { name, unit, kind } = self;
        format!("Field({name:?}, {unit:?}, {kind:?})")
    }
}

/// Rows of one kind with their times: `topic["field"]` is the array of a field.
///
/// Numbers come in the kind in which the file has them, or as float64 where the file scales them; texts come as a list.
/// Arrays are made when they are asked for, and belong to whoever asked.
#[pyclass(name = "Topic", module = "pilotage", frozen)]
pub struct PythonTopic {
    log: Arc<Log>,
    place: usize,
}

impl PythonTopic {
    /// The topic at `place` of a log.
    pub fn new(log: &Arc<Log>, place: usize) -> Self {
        Self {
            log: Arc::clone(log),
            place,
        }
    }

    fn topic(&self) -> &Topic {
        &self.log.topics[self.place]
    }
}

#[pymethods]
impl PythonTopic {
    /// Name of the topic, with the instance where the log tells several apart: `GPS[1]`.
    #[getter]
    fn name(&self) -> String {
        self.topic().name.to_string()
    }

    /// Name of the kind of message that the rows are, where the log tells it beside the topic's own name, or "".
    #[getter]
    fn schema(&self) -> &str {
        &self.topic().schema
    }

    /// Number of the sensor or sender among several, or None.
    #[getter]
    fn instance(&self) -> Option<u32> {
        self.topic().name.instance
    }

    /// Times of the rows, seconds in the log's time base (float64). As the file has them: they may stand still or go back.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        vector(py, self.topic().times.clone())
    }

    /// Fields in the order of the file.
    #[getter]
    fn fields(&self) -> Vec<PythonField> {
        let fields = self.topic().fields.iter();
        let told = |field: &FieldLayout| PythonField {
            name: field.name.clone(),
            unit: field.unit.clone(),
            kind: kind_name(field),
        };
        fields.map(told).collect()
    }

    /// Names of the fields.
    fn keys(&self) -> Vec<String> {
        let fields = self.topic().fields.iter();
        fields.map(|field| field.name.clone()).collect()
    }

    /// All fields by name, and the times as "times" unless a field is called so.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let topic = self.topic();
        let read = || {
            let fields = topic.fields.iter();
            let arrays = fields.map(|field| (field.name.as_str(), FieldArray::of(topic, field)));
            arrays.collect::<Vec<_>>()
        };
        let arrays = py.detach(read);
        let all = PyDict::new(py);
        all.set_item("times", self.times(py))?;
        for (name, array) in arrays {
            all.set_item(name, array.into_python(py)?)?;
        }
        Ok(all)
    }

    fn __getitem__<'py>(&self, py: Python<'py>, field: &str) -> PyResult<Bound<'py, PyAny>> {
        let topic = self.topic();
        let Some(layout) = topic.field(field) else {
            let known = self.keys().join(", ");
            let name = &topic.name;
            return Err(PyKeyError::new_err(format!(
                "{}: the topic {name} has no field {field:?}; it has {known}",
                self.log.name
            )));
        };
        py.detach(|| FieldArray::of(topic, layout)).into_python(py)
    }

    fn __contains__(&self, field: &str) -> bool {
        self.topic().field(field).is_some()
    }

    fn __len__(&self) -> usize {
        self.topic().len()
    }

    fn __repr__(&self) -> String {
        let topic = self.topic();
        let (rows, fields) = (topic.len(), topic.fields.len());
        format!("<Topic {}: {rows} rows of {fields} fields>", topic.name)
    }
}
