//! Why looks cannot be evaluated.

/// Looks that say nothing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EvaluationError {
    /// There is none with the landmark.
    #[error("none of {looks} looks has the landmark in it: nothing is known of detections")]
    NeverPresent {
        /// Looks without it.
        looks: usize,
    },
    /// A number is none.
    #[error("look {look} of day {day}: {what} is not a finite number")]
    NotFinite {
        /// Index of the look.
        look: usize,
        /// Its day.
        day: usize,
        /// Name of the number.
        what: &'static str,
    },
}
