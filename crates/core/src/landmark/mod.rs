//! Landmarks on the map and how they are found in the picture.

mod distinct;
mod settings;

pub use distinct::Landmark;
pub use settings::TemplateSettings;
