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

/// Memory for the encoded pictures of a rendered flight, bytes: some thousand of them. A worker has 4 GB for all.
const ROOM: usize = 256 << 20;

/// Pictures that were rendered, encoded, as far as there is room for them.
#[derive(Default)]
struct Rendered {
    encoded: BTreeMap<usize, Arc<[u8]>>,
    /// Bytes that they may have yet.
    room: usize,
}

impl Rendered {
    /// Keeps a picture unless there is no room for it: flights are flown from their beginning, so that those kept first
    /// are asked for again first, and in place of others they would be gone when they are.
    fn keep(&mut self, index: usize, encoded: &Arc<[u8]>) {
        if let Some(room) = self.room.checked_sub(encoded.len()) {
            self.room = room;
            self.encoded.insert(index, Arc::clone(encoded));
        }
    }
}

/// Pictures of a flight. Rendered ones are kept encoded once they were asked for, so that flying
/// again renders nothing anew, but for those of a long flight for which there is no room.
pub struct KeptFrames {
    source: Box<dyn FrameSource>,
    names: Vec<String>,
    rendered: Option<Rendered>,
    stated: Option<StatedNavigation>,
}

impl KeptFrames {
    /// Pictures of `flight` that `source` renders.
    pub fn rendered(flight: &Flight, source: Box<dyn FrameSource>) -> Self {
        Self {
            rendered: Some(Rendered {
                room: ROOM,
                ..Rendered::default()
            }),
            ..Self::stored(flight, source)
        }
    }

    /// Pictures of `flight` that `source` has in files.
    pub fn stored(flight: &Flight, source: Box<dyn FrameSource>) -> Self {
        Self {
            source,
            names: flight.frames.iter().map(|f| f.name.clone()).collect(),
            rendered: None,
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

    /// A picture that was rendered before, encoded, if it is kept.
    pub fn rendered_before(&self, index: usize) -> Option<&[u8]> {
        let rendered = self.rendered.as_ref()?;
        rendered.encoded.get(&index).map(AsRef::as_ref)
    }

    /// A picture, encoded.
    pub fn kept(&mut self, index: usize) -> Result<Arc<[u8]>, FrameError> {
        let rendered = self.rendered.as_ref();
        if let Some(encoded) = rendered.and_then(|kept| kept.encoded.get(&index)) {
            return Ok(encoded.clone());
        }
        if self.stated.is_some() {
            return Err(FrameError::Unreadable {
                name: "there is no picture".to_owned(),
                cause: "flights of studies are flown without a camera".to_owned(),
            });
        }
        let encoded: Arc<[u8]> = self.source.encoded(index)?.into();
        if let Some(rendered) = &mut self.rendered {
            rendered.keep(index, &encoded);
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Renders pictures of 1,000 bytes, and counts them.
    struct Counting(Arc<std::sync::atomic::AtomicUsize>);

    impl FrameSource for Counting {
        fn picture(&mut self, _: usize) -> Result<Picture, FrameError> {
            unreachable!("asked for encoded")
        }

        fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
            self.0.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            Ok(vec![u8::try_from(index).unwrap_or_default(); 1000])
        }
    }

    #[test]
    fn rendered_pictures_are_kept_within_their_room_and_others_are_rendered_again() {
        let count = Arc::new(std::sync::atomic::AtomicUsize::new(0));
        let mut frames = KeptFrames {
            source: Box::new(Counting(Arc::clone(&count))),
            names: Vec::new(),
            rendered: Some(Rendered {
                room: 2500,
                ..Rendered::default()
            }),
            stated: None,
        };
        for _ in 0..3 {
            for index in 0..4 {
                let encoded = frames.kept(index).unwrap();
                assert_eq!(encoded[0], u8::try_from(index).unwrap());
            }
        }
        // The first two once, the others each time.
        assert_eq!(count.load(std::sync::atomic::Ordering::Relaxed), 2 + 3 * 2);
        assert!(frames.rendered_before(1).is_some() && frames.rendered_before(2).is_none());
    }
}
