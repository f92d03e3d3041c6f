//! Refusals as exceptions of Python.

use pyo3::PyErr;
use pyo3::exceptions::PyException;

pyo3::create_exception!(
    pilotage,
    PilotageError,
    PyException,
    "A file that cannot be read, or a question without an answer; the text names file and place."
);
pyo3::create_exception!(
    pilotage,
    FilterError,
    PilotageError,
    "A step that the filter refused; the filter is as it was before."
);

/// The exception with these words.
pub fn refusal(words: impl ToString) -> PyErr {
    PilotageError::new_err(words.to_string())
}

/// The exception of a step that the filter refused.
pub fn filter_refusal(words: impl ToString) -> PyErr {
    FilterError::new_err(words.to_string())
}
