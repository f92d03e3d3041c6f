//! Cascades that were trained for one landmark each, at work on rectified pictures.
//!
//! The picture is turned north up and put to the map's scale first (DeAngelo 2016, chapter 3: the
//! detectors are sensitive to rotation), so that a window of one size is shown every place of the search
//! region once.

mod detector;
mod likelihood;
mod mark;
mod model;
mod precision;
mod search;
mod variants;

pub use detector::CascadeDetector;
pub(super) use detector::{BELIEVED, probabilities};
pub use likelihood::Likelihood;
pub use mark::Mark;
pub use model::{DetectorWindow, TemplateLikelihood, TrainedDetector};
pub use precision::{ByScore, MarkPrecision, ReadingEstimate, ScoreScale};
pub use search::{SearchedGround, search, to_bytes};
pub use variants::{Preparation, Steps, Variant, Variants};
