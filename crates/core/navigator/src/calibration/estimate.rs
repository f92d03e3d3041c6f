//! Time offset, drift, mount and focal length of a camera beside a log.

use serde::{Deserialize, Serialize};

use super::CameraEvidence;
use super::residual::{ReferenceLog, Unknowns};
use super::solve::{Solution, solve};
use crate::navigator::Run;
use pilotage_flight::Flight;
use pilotage_mission::settings::CameraAdjustment;

/// Fewest frames from which anything can be told.
pub const FEWEST_FRAMES: usize = 6;
/// Guesses of the time offset, from one to the next, seconds.
const STEP: f64 = 0.1;

/// A number with its standard deviation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Estimated {
    /// The number.
    pub value: f64,
    /// Its standard deviation; that of what was assumed where the flight does not tell.
    pub deviation: f64,
    /// Whether the flight tells it: whether it is known at least twice as well as before.
    pub is_told: bool,
}

/// Prior of the camera's unknowns before the flight is looked at: standard deviations about zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraPrior {
    /// Time offset, seconds; three of them to each side are searched.
    pub offset: f64,
    /// Drift of the camera's clock against the log's, seconds per second.
    pub drift: f64,
    /// Each of the mount's angles, radians.
    pub mount: f64,
    /// Natural logarithm of the factor on the focal length.
    pub log_focal: f64,
    /// Natural logarithm of the factor on all of the log's heights: the ground is not where it took off.
    pub log_height: f64,
    /// Bias of satellite navigation against the map per axis, metres.
    pub bias: f64,
}

impl Default for CameraPrior {
    fn default() -> Self {
        Self {
            offset: 1.0,
            drift: 1e-4,
            mount: 3_f64.to_radians(),
            log_focal: 0.1,
            log_height: 0.03,
            bias: 3.0,
        }
    }
}

/// A camera beside a log. Time by the log is t + `offset` + `drift` (t - `middle`) for a time t of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CameraToLog {
    /// Seconds to add to the times of the frames, in the middle of the flight.
    pub offset: Estimated,
    /// Seconds per second by which the camera's clock is slow.
    pub drift: Estimated,
    /// The middle of the flight, seconds.
    pub middle: f64,
    /// To add to the mount's roll, radians.
    pub roll: Estimated,
    /// To add to the mount's pitch, radians.
    pub pitch: Estimated,
    /// To add to the mount's yaw, radians.
    pub yaw: Estimated,
    /// Natural logarithm of the factor on the focal length.
    pub log_focal: Estimated,
    /// Correction of satellite navigation to the map (north, east), metres: to add to its places.
    pub bias: [Estimated; 2],
    /// Frames that were held against the log.
    pub frames: usize,
    /// Standard deviation per axis of places of satellite navigation about those of the frames, metres, before
    /// and after.
    pub place_deviation: [f64; 2],
}

/// Why nothing can be told.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CalibrationError {
    /// Too few frames lie on the map.
    #[error(
        "{found} frames of the flight were laid on the map during the log; at least {FEWEST_FRAMES} are needed"
    )]
    TooFewFrames {
        /// Number of frames that were laid on the map during the log.
        found: usize,
    },
    /// Nothing to hold the frames against.
    #[error("the log has no satellite navigation against which the frames could be held")]
    NoFixes,
    /// The equations have no solution.
    #[error("the frames and the log contradict each other beyond reason")]
    NoSolution,
}

/// Estimates the camera of `flight` from the frames that `run` laid on the map, by robust least squares from
/// every time offset that is possible. Deviations count the errors of neighbouring frames as alike as they are.
///
/// # Errors
/// Too few frames, no satellite navigation, or nothing that explains the frames.
pub fn camera_to_log(
    flight: &Flight,
    run: &Run,
    believed: &CameraPrior,
) -> Result<CameraToLog, CalibrationError> {
    CameraEvidence::of(flight, run).estimate(believed)
}

impl CameraEvidence {
    /// Estimates the camera at once. See [`CameraSearch`] for the same in slices.
    ///
    /// # Errors
    /// Too few frames, no satellite navigation, or nothing that explains the frames.
    pub fn estimate(&self, believed: &CameraPrior) -> Result<CameraToLog, CalibrationError> {
        let mut search = CameraSearch::new(self, believed)?;
        while search.advance(self) {}
        search.finish(self)
    }
}

/// An estimate under way: a guess of the time offset after the other. The evidence has to be the same in every
/// call.
#[derive(Clone, Debug)]
pub struct CameraSearch {
    believed: CameraPrior,
    prior: Unknowns,
    /// Guesses of the time offset, and how many of them are done.
    guesses: Vec<f64>,
    done: usize,
    likely: Option<Solution>,
}

impl CameraSearch {
    /// Nothing tried yet.
    ///
    /// # Errors
    /// Too few frames, or no satellite navigation.
    pub fn new(
        evidence: &CameraEvidence,
        believed: &CameraPrior,
    ) -> Result<Self, CalibrationError> {
        let log = evidence.log().ok_or(CalibrationError::NoFixes)?;
        if evidence.frames() < FEWEST_FRAMES {
            return Err(CalibrationError::TooFewFrames {
                found: evidence.frames(),
            });
        }
        let count = (3.0 * believed.offset / STEP).ceil() as i32;
        Ok(Self {
            believed: *believed,
            prior: prior(&log, believed),
            guesses: (-count..=count).map(|i| f64::from(i) * STEP).collect(),
            done: 0,
            likely: None,
        })
    }

    /// Share of the guesses that were tried, 0 to 1.
    pub fn progress(&self) -> f64 {
        self.done as f64 / self.guesses.len().max(1) as f64
    }

    /// Tries the next guess; false once there is none left.
    pub fn advance(&mut self, evidence: &CameraEvidence) -> bool {
        let (Some(log), Some(offset)) = (evidence.log(), self.guesses.get(self.done)) else {
            return false;
        };
        // At first with the offset held: its valley is narrow where the aircraft turns.
        let mut held = self.prior;
        held[0] = 0.0;
        held[1] = 0.0;
        let mut guess = Unknowns::zeros();
        guess[0] = *offset;
        self.done += 1;
        let frames = evidence.laid();
        let solution = solve(&log, frames, &guess, &held);
        let enough = |s: &Solution| 2 * s.frames > frames.len() && s.frames >= FEWEST_FRAMES;
        let best = self.likely.as_ref().map_or(f64::INFINITY, |s| s.cost);
        if let Some(found) = solution.filter(|s| enough(s) && s.cost < best) {
            self.likely = Some(found);
        }
        true
    }

    /// The estimate around the likeliest guess.
    ///
    /// # Errors
    /// Too few frames fall into the log, or nothing explains them.
    pub fn finish(&self, evidence: &CameraEvidence) -> Result<CameraToLog, CalibrationError> {
        let log = evidence.log().ok_or(CalibrationError::NoFixes)?;
        let (frames, prior) = (evidence.laid(), &self.prior);
        let likely = self.likely.as_ref();
        let likely = likely.ok_or(CalibrationError::TooFewFrames { found: 0 })?;
        let best =
            solve(&log, frames, &likely.unknowns, prior).ok_or(CalibrationError::NoSolution)?;
        let before = solve(&log, frames, &Unknowns::zeros(), &Unknowns::zeros());
        let before = before.map_or(f64::NAN, |solution| solution.place_deviation);
        let mut found = told(&best, prior, log.middle, before);
        // A longer lens and higher ground look alike.
        let deviation = found.log_focal.deviation.hypot(self.believed.log_height);
        found.log_focal.is_told &= 2.0 * deviation < self.believed.log_focal;
        found.log_focal.deviation = deviation;
        Ok(found)
    }
}

/// Standard deviations of the unknowns; zero for what the log cannot tell.
fn prior(log: &ReferenceLog<'_>, believed: &CameraPrior) -> Unknowns {
    let mount = if log.has_heading { believed.mount } else { 0.0 };
    let focal = if log.has_height {
        believed.log_focal
    } else {
        0.0
    };
    Unknowns::from([
        believed.offset,
        believed.drift,
        mount,
        mount,
        mount,
        focal,
        believed.bias,
        believed.bias,
    ])
}

fn told(best: &Solution, prior: &Unknowns, middle: f64, before: f64) -> CameraToLog {
    let number = |i: usize| {
        let deviation = best.covariance[(i, i)].max(0.0).sqrt();
        Estimated {
            value: best.unknowns[i],
            deviation,
            is_told: prior[i] > 0.0 && 2.0 * deviation < prior[i],
        }
    };
    CameraToLog {
        offset: number(0),
        drift: number(1),
        middle,
        roll: number(2),
        pitch: number(3),
        yaw: number(4),
        log_focal: number(5),
        bias: [number(6), number(7)],
        frames: best.frames,
        place_deviation: [before, best.place_deviation],
    }
}

impl CameraToLog {
    /// Change to make to the camera. What the flight does not tell stays near the prior, since the estimate
    /// does.
    pub fn adjustment(&self) -> CameraAdjustment {
        CameraAdjustment {
            offset: self.offset.value,
            drift: self.drift.value,
            middle: self.middle,
            roll: self.roll.value,
            pitch: self.pitch.value,
            yaw: self.yaw.value,
            log_focal: self.log_focal.value,
        }
    }

    /// The same estimate for a flight of which all but `left` was changed already: known as well, and about the
    /// middle of `left`.
    #[must_use]
    pub fn with(&self, left: &CameraAdjustment) -> Self {
        let number = |value, known: Estimated| Estimated { value, ..known };
        Self {
            offset: number(left.offset, self.offset),
            drift: number(left.drift, self.drift),
            middle: left.middle,
            roll: number(left.roll, self.roll),
            pitch: number(left.pitch, self.pitch),
            yaw: number(left.yaw, self.yaw),
            log_focal: number(left.log_focal, self.log_focal),
            ..*self
        }
    }

    /// Satellite navigation's bias against the map: north, east, metres.
    pub fn bias_values(&self) -> [f64; 2] {
        self.bias.map(|axis| axis.value)
    }

    /// The flight with its frames at the log's times and its camera as estimated.
    pub fn apply(&self, flight: &Flight) -> Flight {
        self.adjustment().apply(flight)
    }
}

#[cfg(test)]
#[path = "estimate_tests.rs"]
mod tests;
