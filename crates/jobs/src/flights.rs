//! Opened flights: what was measured, the mission that goes with it, and its pictures.

use std::collections::BTreeMap;
use std::sync::Arc;

use pilotage_core::flight::{
    Flight, FlightFolder, FrameError, FrameSource, NoPictures, SharedFrames,
};
use pilotage_core::imagery::Imagery;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{KnownGround, Navigator, NavigatorSettings};
use pilotage_core::plan::StatedFrames;
use pilotage_core::raster::{Picture, decode_picture};
use pilotage_study::StatedNavigation;

/// A flight with everything needed to navigate it.
pub struct OpenFlight {
    /// Measured flight.
    pub flight: Arc<Flight>,
    /// The mission that comes with it, if any.
    pub mission: Option<Mission>,
    /// Its pictures.
    pub frames: KeptFrames,
    /// Universal time at its zero, seconds since 1970, where that is known.
    pub utc_at_zero: Option<f64>,
}

impl OpenFlight {
    /// A flight with the pictures that were read with it.
    pub fn of_folder(folder: FlightFolder, mission: Option<Mission>) -> Self {
        Self {
            utc_at_zero: folder.utc_at_zero(),
            frames: KeptFrames::stored(&folder.flight, Box::new(folder.frames)),
            flight: Arc::new(folder.flight),
            mission,
        }
    }

    /// A flight that no camera watched.
    pub fn without_pictures(flight: Flight) -> Self {
        Self {
            frames: KeptFrames::stored(&flight, Box::new(NoPictures)),
            flight: Arc::new(flight),
            mission: None,
            utc_at_zero: None,
        }
    }
}

/// Pictures of a flight. Rendered ones are kept encoded once they were asked for, so that flying
/// again renders nothing anew.
pub struct KeptFrames {
    source: Box<dyn FrameSource>,
    names: Vec<String>,
    encoded: Option<BTreeMap<usize, Arc<[u8]>>>,
    stated: Option<StatedNavigation>,
}

impl KeptFrames {
    /// Pictures of `flight` that `source` renders.
    pub fn rendered(flight: &Flight, source: Box<dyn FrameSource>) -> Self {
        Self {
            encoded: Some(BTreeMap::new()),
            ..Self::stored(flight, source)
        }
    }

    /// Pictures of `flight` that `source` has in files.
    pub fn stored(flight: &Flight, source: Box<dyn FrameSource>) -> Self {
        Self {
            source,
            names: flight.frames.iter().map(|f| f.name.clone()).collect(),
            encoded: None,
            stated: None,
        }
    }

    /// Nothing in the place of pictures of `flight`: it is stated how landmarks are found.
    pub fn stated(flight: &Flight, stated: StatedNavigation) -> Self {
        Self {
            stated: Some(stated),
            ..Self::stored(flight, Box::new(NoPictures))
        }
    }

    /// Statement of how landmarks are found, where that is stated in the place of pictures.
    pub fn statement(&self) -> Option<&StatedNavigation> {
        self.stated.as_ref()
    }

    /// The navigator at the start of the flight as it is `flown`, by a mission with other settings than its own; with
    /// frames of its own where it is stated how landmarks are found.
    ///
    /// # Errors
    /// Why the flight cannot be navigated, in words.
    pub fn navigator(
        &self,
        flown: &Arc<Flight>,
        mission: &Mission,
        map: Arc<dyn Imagery>,
        settings: &NavigatorSettings,
    ) -> Result<(Navigator, Option<StatedFrames>), String> {
        if let Some(stated) = &self.stated {
            let (navigator, frames) = stated.begin(flown, &mission.landmarks, settings)?;
            return Ok((navigator, Some(frames)));
        }
        let ground = KnownGround::of(mission, map);
        let navigator = Navigator::new(Arc::clone(flown), &ground, settings);
        Ok((navigator.map_err(|cause| cause.to_string())?, None))
    }

    /// A picture that was rendered before, encoded.
    pub fn rendered_before(&self, index: usize) -> Option<&[u8]> {
        self.encoded.as_ref()?.get(&index).map(AsRef::as_ref)
    }

    /// A picture, encoded.
    pub fn kept(&mut self, index: usize) -> Result<Arc<[u8]>, FrameError> {
        if let Some(encoded) = self.encoded.as_ref().and_then(|kept| kept.get(&index)) {
            return Ok(encoded.clone());
        }
        if self.stated.is_some() {
            return Err(FrameError::Unreadable {
                name: "there is no picture".to_owned(),
                cause: "flights of studies are flown without a camera".to_owned(),
            });
        }
        let encoded: Arc<[u8]> = self.source.encoded(index)?.into();
        if let Some(kept) = &mut self.encoded {
            kept.insert(index, encoded.clone());
        }
        Ok(encoded)
    }
}

impl FrameSource for KeptFrames {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        let encoded = self.kept(index)?;
        decode_picture(&encoded).map_err(|cause| FrameError::Unreadable {
            name: self.names.get(index).cloned().unwrap_or_default(),
            cause: cause.to_string(),
        })
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        Ok(self.kept(index)?.to_vec())
    }

    fn another(&self) -> Option<SharedFrames> {
        let is_stored = self.stated.is_none();
        is_stored.then(|| self.source.another()).flatten()
    }
}
