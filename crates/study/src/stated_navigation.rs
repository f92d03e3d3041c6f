//! Navigation of a flight without pictures: landmarks are found as often and as well as it is stated.

use std::sync::Arc;

use pilotage_core::flight::Flight;
use pilotage_core::landmark::Landmark;
use pilotage_core::navigator::{Navigator, NavigatorSettings};
use pilotage_core::plan::{
    DetectionStatistics, ExpectedDetection, PlannedLandmark, StatedFrames, as_stated,
};

/// Statement of how landmarks are found along a flight of which there are no pictures.
pub struct StatedNavigation {
    /// The flight as its camera sees it, where that is another than the flight as it is.
    pub(crate) seen: Option<Arc<Flight>>,
    /// Detection of each landmark: how often and how well it is found, from any height.
    pub(crate) expected: ExpectedDetection,
    /// Seed of what is found.
    pub(crate) seed: u64,
    /// Whether the navigator thinks neither of late pictures nor of turned compasses.
    pub(crate) is_trusting: bool,
}

impl StatedNavigation {
    /// The navigator at the start of `flight`, and the frames that it asks for.
    ///
    /// # Errors
    /// Why the flight cannot be navigated, in words.
    pub fn begin(
        &self,
        flight: &Arc<Flight>,
        landmarks: &[Landmark],
        settings: &NavigatorSettings,
    ) -> Result<(Navigator, StatedFrames), String> {
        let planned = landmarks.iter().map(|landmark| PlannedLandmark {
            landmark: landmark.clone(),
            detection: DetectionStatistics::everywhere(self.expected),
        });
        let planned: Vec<PlannedLandmark> = planned.collect();
        let seen = self.seen.as_ref().unwrap_or(flight);
        let stated = as_stated(seen, &planned, self.seed);
        let (detector, frames) = stated.ok_or("nobody knows where it really flew")?;
        let flight = Arc::clone(flight);
        let navigator = Navigator::with_detector(flight, landmarks, Box::new(detector), settings);
        let mut navigator = navigator.map_err(|cause| cause.to_string())?;
        if self.is_trusting {
            navigator = navigator.trusting();
        }
        Ok((navigator, frames))
    }
}
