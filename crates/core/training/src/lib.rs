//! Detectors trained from the map, and how well they do where they were not trained.

mod envelope;
pub mod evaluation;
pub mod ground_classes;
mod held_out;
mod labelled;
mod photo;
mod plan;
mod polygon;
mod precision;
pub mod road;
mod sample;
#[cfg(test)]
mod tests;
mod trainer;
mod training_error;
pub mod words;

pub use envelope::FlightEnvelope;
pub use held_out::TrainingPhotos;
pub use labelled::labelled_photos;
pub use photo::{Assumed, Photographer, TrainingPhoto};
pub use plan::TrainingPlan;
pub use sample::TrainingSample;
pub use trainer::{DetectorTraining, StageReport, TrainingPhase, TrainingProgress};
pub use training_error::TrainingError;
