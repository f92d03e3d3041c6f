//! Errors of a filter step.

/// Why a filter refused a step. The filter is left as it was before the call.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FilterError {
    /// A setting lies outside the range in which the unscented transform is defined.
    #[error("filter setting {name} = {value} is not allowed: choose {allowed}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// The value that was given.
        value: f64,
        /// The allowed range in words.
        allowed: &'static str,
    },
    /// A covariance is not symmetric.
    #[error("{matrix} is not symmetric at row {row}, column {column}: give a symmetric covariance")]
    NotSymmetric {
        /// Name of the matrix.
        matrix: &'static str,
        /// Row of the first offending element, from 0.
        row: usize,
        /// Column of the first offending element, from 0.
        column: usize,
    },
    /// A covariance has a negative eigenvalue (or, where it must be inverted, a zero one).
    #[error(
        "{matrix} is not a covariance: its pivot for component {component} is {pivot:e}; \
         check the noise of that component"
    )]
    NotPositive {
        /// Name of the matrix.
        matrix: &'static str,
        /// Component at which the factorisation stopped, from 0.
        component: usize,
        /// The pivot found there.
        pivot: f64,
    },
    /// A number that must be finite is not.
    #[error("{place} is not finite: check the inputs of this step")]
    NotFinite {
        /// Place of the number.
        place: &'static str,
    },
    /// The measurement model has no answer for a sigma point (for example behind the lens).
    #[error(
        "the measurement model has no answer for sigma point {point}: leave this measurement out"
    )]
    NoMeasurement {
        /// Index of the sigma point, 0 is the centre.
        point: usize,
    },
    /// Two things that belong together differ in size.
    #[error("{what} has {found} components where {expected} were expected")]
    Size {
        /// Name of the matrix or vector.
        what: &'static str,
        /// The size it should have.
        expected: usize,
        /// The size it has.
        found: usize,
    },
    /// The measurement was predicted from another state than the one to be corrected.
    #[error(
        "the measurement was predicted before the filter moved on: predict it again before correcting"
    )]
    Stale,
}
