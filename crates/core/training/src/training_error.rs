//! Why a detector cannot be trained.

use pilotage_vision::landmark::cascade::CascadeError;

/// Why a detector cannot be trained.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TrainingError {
    /// It is too large for the pictures.
    #[error(
        "landmark \"{0}\" does not fit into a picture from that height; fly higher or mark a smaller box"
    )]
    TooLarge(String),
    /// Nothing in it tells it from its surroundings.
    #[error("landmark \"{0}\" cannot be told from its surroundings: no feature parts them")]
    Featureless(String),
    /// The cascade is none.
    #[error("the detector of landmark \"{name}\": {cause}")]
    Cascade {
        /// Of which landmark.
        name: String,
        /// Error of the cascade.
        cause: CascadeError,
    },
}
