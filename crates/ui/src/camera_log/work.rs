//! Camera beside its log: the estimate, and the adjustment by hand.

use pilotage_core::calibration::{
    CameraAdjustment, CameraEvidence, CameraPrior, CameraToLog, FEWEST_FRAMES, FrameResidual,
    ResidualSummary,
};
use pilotage_core::flight::{ChannelName, Flight};
use pilotage_core::frames::GroundPoint;
use pilotage_core::navigator::Run;
use pilotage_jobs::MapSource;

/// An estimate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundCamera {
    /// The estimate, beyond what the flight was flown with then.
    pub told: CameraToLog,
    /// All that is to be changed of the flight as it was opened.
    pub change: CameraAdjustment,
}

/// Why nothing can be estimated or tried yet.
#[derive(Clone, Debug, PartialEq)]
pub enum Missing {
    /// There is no flight.
    Flight,
    /// Its camera took no pictures.
    Frames,
    /// The log has no satellite navigation.
    Fixes,
    /// There is no map on which they could be laid.
    Map,
    /// The run is under way or was not begun.
    Run,
    /// The run did not look where whole frames lie.
    FrameRegistration,
    /// It did, but found too few.
    Laid {
        /// Frames that lie on the map.
        found: usize,
    },
}

/// Residuals of one camera.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResidualPreview {
    /// Each laid frame's, as the hand has the camera.
    pub residuals: Vec<FrameResidual>,
    /// Over all frames: as the flight was opened, with the estimate, and as the hand has it.
    pub summaries: [Option<ResidualSummary>; 3],
}

/// Key of a preview: everything that it was computed from.
type PreviewKey = (u64, CameraAdjustment, Option<FoundCamera>);

/// A camera beside its log, until another flight is opened.
#[derive(Clone, Debug)]
pub struct CameraLog {
    /// Adjustment of the camera with which the flight was flown.
    flown: CameraAdjustment,
    /// The latest estimate.
    pub found: Option<FoundCamera>,
    /// Map on which the frames of that were laid.
    found_on: Option<MapSource>,
    /// Adjustment by hand, if it was moved.
    pub by_hand: Option<CameraAdjustment>,
    /// Standard deviation of the camera's clock before anything is known, seconds.
    pub clock: f64,
    /// The laid frames of a run, by its generation.
    evidence: Option<(u64, CameraEvidence)>,
    preview: Option<(PreviewKey, ResidualPreview)>,
}

impl Default for CameraLog {
    fn default() -> Self {
        Self {
            flown: CameraAdjustment::default(),
            found: None,
            found_on: None,
            by_hand: None,
            clock: CameraPrior::default().offset,
            evidence: None,
            preview: None,
        }
    }
}

/// Missing part of a flight that cannot be done without, apart from its run.
fn lacks(flight: Option<&Flight>) -> Option<Missing> {
    let Some(flight) = flight else {
        return Some(Missing::Flight);
    };
    let is_there = |name| flight.channel(name).is_some_and(|c| !c.times.is_empty());
    if flight.frames.is_empty() {
        Some(Missing::Frames)
    } else if is_there(ChannelName::GpsNorth) && is_there(ChannelName::GpsEast) {
        None
    } else {
        Some(Missing::Fixes)
    }
}

impl CameraLog {
    /// Missing part without which there is no estimate.
    pub fn missing(
        &self,
        flight: Option<&Flight>,
        run: Option<&Run>,
        has_map: bool,
    ) -> Option<Missing> {
        if let Some(missing) = lacks(flight) {
            return Some(missing);
        }
        if !has_map {
            return Some(Missing::Map);
        }
        let (Some(run), Some(evidence)) = (run, self.evidence()) else {
            return Some(Missing::Run);
        };
        let found = evidence.frames();
        if found >= FEWEST_FRAMES {
            None
        } else if run.settings.whole_frames.is_none() {
            Some(Missing::FrameRegistration)
        } else {
            Some(Missing::Laid { found })
        }
    }

    /// The laid frames of the run, once it is complete.
    pub fn evidence(&self) -> Option<&CameraEvidence> {
        self.evidence.as_ref().map(|(_, evidence)| evidence)
    }

    /// Preview that was computed last for the adjustment by hand.
    pub fn preview(&self) -> Option<&ResidualPreview> {
        self.preview.as_ref().map(|(_, preview)| preview)
    }

    /// Adjustment by hand; before it is moved, the adjustment of the mission (`applied`).
    pub fn change(&self, applied: Option<&CameraAdjustment>) -> CameraAdjustment {
        (self.by_hand.or(applied.copied())).unwrap_or_else(|| CameraAdjustment::none(self.middle()))
    }

    /// The middle of the laid frames by the camera's own clock, seconds: about it drifts are told, whatever was
    /// flown with.
    fn middle(&self) -> f64 {
        let flown = self.evidence().map_or(0.0, CameraEvidence::middle);
        let back = CameraAdjustment::none(self.flown.middle).beyond(&self.flown);
        back.time(flown)
    }

    /// Takes an estimate by frames that were laid on a map, and puts the hand where it is.
    pub fn take(&mut self, told: CameraToLog, on: Option<MapSource>) {
        self.found_on = on;
        let change = self.flown.then(&told.adjustment());
        let change = change.about(self.middle());
        self.found = Some(FoundCamera { told, change });
        self.by_hand = Some(change);
    }

    /// Forgets an estimate by frames that were laid on another map than those of the run, whose offset from GPS is not
    /// that of this one; whether there was such. Where nobody moved the hand since, it is free again.
    pub fn keep_to(&mut self, map: Option<&MapSource>) -> bool {
        let found = self.found.filter(|_| self.found_on.as_ref() != map);
        if let Some(found) = found {
            self.found = None;
            self.by_hand = self.by_hand.filter(|hand| *hand != found.change);
        }
        found.is_some()
    }

    /// Remainder of the latest estimate for the flight as it is flown now, however much of the estimate was
    /// applied since.
    pub fn left(&self, flown: &CameraAdjustment) -> Option<CameraToLog> {
        let of = |found: &FoundCamera| found.told.with(&found.change.beyond(flown));
        self.found.as_ref().map(of)
    }

    /// Looks at the run if it is complete and new, and computes the preview if anything changed; whether it did.
    pub fn refresh(
        &mut self,
        flight: Option<&Flight>,
        run: Option<&Run>,
        generation: Option<u64>,
        flown: &CameraAdjustment,
        applied: Option<&CameraAdjustment>,
    ) -> bool {
        self.flown = *flown;
        let (Some(flight), Some(run), Some(generation)) = (flight, run, generation) else {
            let had = self.evidence.is_some();
            (self.evidence, self.preview) = (None, None);
            return had;
        };
        if self.evidence.as_ref().map(|(of, _)| *of) != Some(generation) {
            self.evidence = Some((generation, CameraEvidence::of(flight, run)));
            self.preview = None;
        }
        let change = self.change(applied);
        let key = (generation, change, self.found);
        if self.preview.as_ref().is_some_and(|(of, _)| *of == key) {
            return false;
        }
        let preview = self.previewed(&change);
        self.preview = Some((key, preview));
        true
    }

    fn previewed(&self, change: &CameraAdjustment) -> ResidualPreview {
        let Some(evidence) = self.evidence() else {
            return ResidualPreview::default();
        };
        let bias = self
            .found
            .map_or([0.0; 2], |found| found.told.bias_values());
        let of = |change: &CameraAdjustment| evidence.residuals(&change.beyond(&self.flown), bias);
        let summary = |change: &CameraAdjustment| ResidualSummary::of(&of(change));
        let opened = CameraAdjustment::none(change.middle);
        let residuals = of(change);
        ResidualPreview {
            summaries: [
                Some(summary(&opened)),
                self.found.map(|found| summary(&found.change)),
                Some(ResidualSummary::of(&residuals)),
            ],
            residuals,
        }
    }

    /// Corners of the ground that frame `index` would show by the log alone, as the hand has the camera.
    pub fn footprint(
        &self,
        index: usize,
        applied: Option<&CameraAdjustment>,
    ) -> Option<Vec<GroundPoint>> {
        let change = self.change(applied).beyond(&self.flown);
        self.evidence()?.footprint(index, &change)
    }
}
