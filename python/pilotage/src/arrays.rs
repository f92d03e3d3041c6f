//! Numbers handed to and taken from `NumPy`.

use numpy::ndarray::{Array2, Array3};
use numpy::{
    AllowTypeChange, Element, IntoPyArray, PyArray1, PyArray2, PyArray3, PyArrayLike1, PyArrayLike2,
};
use pyo3::prelude::*;
use serde::Serialize;

use crate::error::refusal;

/// A vector of floats of whoever calls; lists and other kinds of numbers are converted.
pub type Vector<'py> = PyArrayLike1<'py, f64, AllowTypeChange>;
/// A matrix of floats of whoever calls.
pub type Matrix<'py> = PyArrayLike2<'py, f64, AllowTypeChange>;

/// An array that takes over the memory of `values`.
pub fn vector<T: Element>(py: Python<'_>, values: Vec<T>) -> Bound<'_, PyArray1<T>> {
    values.into_pyarray(py)
}

/// An array of so many rows and columns, either of which may be none, which takes over the memory of its values, row by
/// row.
pub fn matrix<T: Element>(
    py: Python<'_>,
    shape: (usize, usize),
    values: Vec<T>,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let array = Array2::from_shape_vec(shape, values).map_err(refusal)?;
    Ok(array.into_pyarray(py))
}

/// An array of rows of `columns` values each, which takes over their memory; without columns, it has no rows.
pub fn rows<T: Element>(
    py: Python<'_>,
    columns: usize,
    values: Vec<T>,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let count = values.len().checked_div(columns).unwrap_or(0);
    matrix(py, (count, columns), values)
}

/// An array of so many square matrices, row by row, which takes over their memory.
pub fn squares(
    py: Python<'_>,
    (count, side): (usize, usize),
    values: Vec<f64>,
) -> PyResult<Bound<'_, PyArray3<f64>>> {
    let array = Array3::from_shape_vec((count, side, side), values).map_err(refusal)?;
    Ok(array.into_pyarray(py))
}

/// The numbers of a vector that must have so many.
pub fn numbers(array: &Vector<'_>, count: usize, what: &str) -> PyResult<Vec<f64>> {
    let values: Vec<f64> = array.as_array().iter().copied().collect();
    if values.len() == count {
        return Ok(values);
    }
    let found = values.len();
    Err(refusal(format!(
        "{what} has {found} components where {count} were expected"
    )))
}

/// The numbers of a matrix of that shape, row by row.
pub fn numbers_of_rows(
    array: &Matrix<'_>,
    shape: (usize, usize),
    what: &str,
) -> PyResult<Vec<f64>> {
    let array = array.as_array();
    if array.dim() == shape {
        return Ok(array.iter().copied().collect());
    }
    let ((rows, columns), (r, c)) = (array.dim(), shape);
    Err(refusal(format!(
        "{what} is {rows} × {columns} where {r} × {c} were expected"
    )))
}

/// A value as Python's json reads it: dictionaries, lists, numbers, texts.
pub fn python_value<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(value).map_err(refusal)?;
    py.import("json")?.call_method1("loads", (text,))
}
