//! Models of process and measurement as callers state them: a function of the state, or a matrix.

use std::cell::RefCell;

use numpy::PyArrayMethods;
use pyo3::prelude::*;

use crate::arrays::{Matrix, Vector, numbers, numbers_of_rows, vector};
use crate::error::refusal;

/// A model of the state with so many results.
pub enum ModelOfState<'py> {
    /// A function that takes the state as an array.
    Function(Bound<'py, PyAny>),
    /// A matrix by which the state is multiplied, row by row.
    Linear(Vec<f64>),
}

/// A model with what went wrong in it: the filter only learns that there is no answer.
pub struct Asked<'py> {
    py: Python<'py>,
    model: ModelOfState<'py>,
    results: usize,
    name: &'static str,
    failure: RefCell<Option<PyErr>>,
}

impl<'py> Asked<'py> {
    /// The model that `given` is, with `states` components and so many `results`; messages call it `name`.
    pub fn new(
        given: &Bound<'py, PyAny>,
        (results, states): (usize, usize),
        name: &'static str,
    ) -> PyResult<Self> {
        let model = if given.is_callable() {
            ModelOfState::Function(given.clone())
        } else {
            let matrix: Matrix<'py> = given.extract().map_err(|_| {
                refusal(format!(
                    "{name} is neither a function of the state nor a matrix"
                ))
            })?;
            ModelOfState::Linear(numbers_of_rows(&matrix, (results, states), name)?)
        };
        Ok(Self {
            py: given.py(),
            model,
            results,
            name,
            failure: RefCell::new(None),
        })
    }

    /// Results of the model for a state; `None` once it failed.
    pub fn of(&self, state: &[f64]) -> Option<Vec<f64>> {
        match &self.model {
            ModelOfState::Linear(matrix) => {
                let row = |row: &[f64]| row.iter().zip(state).map(|(a, b)| a * b).sum();
                Some(matrix.chunks_exact(state.len().max(1)).map(row).collect())
            }
            ModelOfState::Function(_) if self.failure.borrow().is_some() => None,
            ModelOfState::Function(function) => match self.call(function, state) {
                Ok(results) => Some(results),
                Err(failure) => {
                    self.failure.replace(Some(failure));
                    None
                }
            },
        }
    }

    fn call(&self, function: &Bound<'py, PyAny>, state: &[f64]) -> PyResult<Vec<f64>> {
        let state = vector(self.py, state.to_vec());
        let results = function.call1((state,))?;
        if let Ok(array) = results.cast::<numpy::PyArray1<f64>>() {
            let values = array.readonly().as_array().to_vec();
            if values.len() == self.results {
                return Ok(values);
            }
        }
        let array: Vector<'py> = results
            .extract()
            .map_err(|_| refusal(format!("{} answers no vector of numbers", self.name)))?;
        numbers(&array, self.results, self.name)
    }

    /// Exception that the function raised, if it did, else what the filter says.
    pub fn judge<T>(&self, done: Result<T, PyErr>) -> PyResult<T> {
        match self.failure.take() {
            Some(failure) => Err(failure),
            None => done,
        }
    }
}
