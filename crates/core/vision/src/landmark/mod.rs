//! Landmarks on the map and how they are found in the picture.

mod alignment;
pub mod annotations;
pub mod cascade;
mod choice;
mod chosen;
mod detector;
mod distinct;
mod distinctness;
mod evidence;
mod features;
mod look_alike;
mod match_evidence;
mod oriented;
mod patch;
mod peak;
mod rectify;
mod rehearsal;
mod settings;
mod template;
mod tolerance;
pub mod trained;
mod window;

pub use choice::DetectorChoice;
pub use chosen::ChosenDetector;
pub use detector::measured;
pub use detector::{Detection, Detector, FrameView, Refusal, SearchRequest, Sighting};
pub use distinct::Landmark;
pub use distinctness::{PatchDistinctness, distinctness};
pub use evidence::{CascadeEvidence, MarkedPlace, PatchLook, StageLook};
pub use match_evidence::MatchEvidence;
pub use oriented::LEAST_PROBABILITY;
pub use rectify::{GroundView, rectify, rectify_plane};
pub use rehearsal::{Rehearsal, rehearse};
pub use settings::{TemplateFeatures, TemplateSettings};
pub use template::TemplateDetector;
pub use tolerance::tolerance;
