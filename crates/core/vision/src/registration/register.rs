//! From a guess to a pose that can be trusted, or to none.

use nalgebra::Matrix2;

use super::CameraPlace;
use super::agreement::{agree, least_likely};
use super::fit::{PoseFit, fit, residual};
use super::look::{Look, MapPose};
use super::patches::{PatchMatch, PatchPlan, PatchSearch, find_patches};
use super::prior::PosePrior;
use super::sweep::{Guess, are_beside, sweep};
use pilotage_base::frames::GroundPoint;
use pilotage_raster::camera::CameraModel;

/// Guesses of the sweep that are refined at first.
const GUESSES: usize = 6;
/// Of these, those that agree best are refined to the end.
const FINISHED: usize = 2;
/// A frame of other ground is believed once in ten thousand, as a logarithm (base 10).
const MOST_FALSE_ALARMS: f64 = -4.0;
/// Pixels across the shorter side of the footprint that give enough patches, if map and frame have as many.
const ENOUGH: f64 = 256.0;
/// Independent patches that are enough.
const WANTED: f64 = 64.0;
/// Tolerances of the agreement beyond which a match is an outlier of the fit.
const OUTLYING: f64 = 3.0;

/// A frame laid on the map.
#[derive(Clone, Debug, PartialEq)]
pub struct Registration {
    /// Pose over the map, its covariance, how the map is stretched.
    pub fit: PoseFit,
    /// Matches that agree with the pose.
    pub matches: Vec<PatchMatch>,
    /// Patches that could have been found.
    pub tried: usize,
    /// Logarithm (base 10) of the agreements as good as this one that chance would give on a map of
    /// other ground.
    pub log_false_alarms: f64,
    /// Where the camera is, the slope of the ground told from its tilt.
    pub camera: CameraPlace,
    /// Place of the map in the middle of the picture.
    pub centre: GroundPoint,
    /// Covariance of that place, north and east, m².
    pub centre_covariance: Matrix2<f64>,
    /// Turn of the stored picture against the mount beyond the one that is known, radians clockwise, a
    /// multiple of a quarter turn: π for one stored upside down. Zero where the heading is not measured.
    pub stored_turn: f64,
    /// Correlation of the whole frame with the map at the guess from which it came.
    pub guess_score: f64,
}

/// Why a frame could not be laid on the map.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotRegistered {
    /// Nowhere within reach does the picture look like the map.
    #[error("nothing within reach looks like the picture")]
    NothingAlike,
    /// The best agreement may be chance.
    #[error("too few of {tried} patches agree on a pose (10^{log_false_alarms:.1} by chance)")]
    Disagreement {
        /// Patches that could have been found.
        tried: usize,
        /// Logarithm (base 10) of the false alarms.
        log_false_alarms: f64,
    },
    /// Another place explains the picture about as well.
    #[error("two places {distance:.0} m apart explain the picture")]
    Ambiguous {
        /// Distance between the two, metres.
        distance: f64,
    },
}

/// A guess under refinement.
struct Candidate {
    at: MapPose,
    guess: Guess,
    log_false_alarms: f64,
}

/// Patches found at one level, and the pose that they agree on.
struct Level {
    search: PatchSearch,
    fit: PoseFit,
    /// Of the raw agreement, in which overlapping patches count fully; to compare guesses.
    agreement: f64,
    pixels_per_metre: f64,
}

/// How patches are cut at a guess: at first coarsely, then at the distance that is fine enough for a frame
/// that shows nothing but map; and the finest that map and frame have.
fn plans(look: &Look<'_>, guess: &Guess) -> Option<([PatchPlan; 2], f64)> {
    let footprint = look.footprint(&guess.at)?;
    let height = look.ground_down - guess.at.pose.position_in_world.z;
    let finest = look.map.native_gsd().max(height / look.camera.focal);
    let fine = finest.max(footprint.width().min(footprint.height()) / ENOUGH);
    let coarse = PatchPlan {
        gsd: 2.0 * fine,
        side: 16,
        stride: 6,
        reach: 12,
    };
    let middle = PatchPlan {
        gsd: fine,
        side: 24,
        stride: 12,
        reach: 10,
    };
    Some(([coarse, middle], finest))
}

/// The last look: finer where little of the frame shows mapped ground, so that it still gives enough
/// patches to be sure of.
fn last_plan(middle: &PatchSearch, finest: f64) -> PatchPlan {
    let independent = middle.tried as f64 / middle.plan.overlap() as f64;
    let share = (independent / WANTED).sqrt().min(1.0);
    PatchPlan {
        gsd: (middle.plan.gsd * share).max(finest),
        reach: 6,
        ..middle.plan
    }
}

fn level(look: &Look<'_>, prior: &PosePrior, at: &MapPose, plan: PatchPlan) -> Option<Level> {
    let search = find_patches(look, at, plan)?;
    let agreement = agree(&search)?;
    let height = look.ground_down - at.pose.position_in_world.z;
    let pixels_per_metre = look.camera.focal / height;
    let members: Vec<PatchMatch> = agreement
        .members
        .iter()
        .map(|&index| search.matches[index])
        .collect();
    let limit = OUTLYING * agreement.tolerance.max(plan.gsd) * pixels_per_metre;
    let first = fit(look, at, &members, prior, limit)?;
    // Once more with all that fit the pose, whose perspective the agreement lacks.
    let fit = fit(look, &first.at, &search.matches, prior, limit)?;
    Some(Level {
        search,
        fit,
        agreement: agreement.log_false_alarms,
        pixels_per_metre,
    })
}

/// The first look at a guess.
fn begin(look: &Look<'_>, prior: &PosePrior, guess: Guess) -> Option<Candidate> {
    let ([coarse, _], _) = plans(look, &guess)?;
    let level = level(look, prior, &guess.at, coarse)?;
    Some(Candidate {
        at: level.fit.at,
        guess,
        log_false_alarms: level.agreement,
    })
}

/// The rest of the way.
fn finish(look: &Look<'_>, prior: &PosePrior, candidate: &Candidate) -> Option<Registration> {
    let ([_, plan], finest) = plans(look, &candidate.guess)?;
    let middle = level(look, prior, &candidate.at, plan)?;
    let plan = last_plan(&middle.search, finest);
    let last = level(look, prior, &middle.fit.at, plan)?;
    let residuals: Vec<f64> = last
        .search
        .matches
        .iter()
        .map(|m| {
            residual(look, &last.fit.at, m)
                .map_or(f64::INFINITY, |r| r.norm() / last.pixels_per_metre)
        })
        .collect();
    // Four matches determine pose and shape.
    let (log_false_alarms, radius) = least_likely(&residuals, &last.search, 4, plan.overlap());
    let matches = last.search.matches.iter().zip(&residuals);
    let (centre, centre_covariance) = last.fit.centre(look)?;
    Some(Registration {
        matches: matches
            .filter(|(_, r)| **r <= radius)
            .map(|(m, _)| *m)
            .collect(),
        tried: last.search.tried,
        log_false_alarms,
        camera: last.fit.camera(look, prior)?,
        centre,
        centre_covariance,
        stored_turn: 0.0,
        guess_score: candidate.guess.score,
        fit: last.fit,
    })
}

/// Lays a frame on the map: sweeps over all that the prior allows, refines the best guesses, and
/// believes one only if chance cannot explain it and no other does as well.
pub fn register(look: &Look<'_>, prior: &PosePrior) -> Result<Registration, NotRegistered> {
    let turns = prior.heading.turns();
    let cameras: Vec<CameraModel> = turns
        .iter()
        .map(|turn| look.camera.stored_turned(*turn))
        .collect();
    let looks: Vec<Look<'_>> = cameras
        .iter()
        .map(|camera| Look { camera, ..*look })
        .collect();
    let guesses = sweep(&looks, prior, GUESSES);
    let mut candidates: Vec<Candidate> = guesses
        .into_iter()
        .filter_map(|guess| begin(&looks[guess.turn], prior, guess))
        .collect();
    candidates.sort_by(|a, b| a.log_false_alarms.total_cmp(&b.log_false_alarms));
    let mut finished: Vec<Registration> = candidates
        .iter()
        .take(FINISHED)
        .filter_map(|candidate| {
            let turn = candidate.guess.turn;
            let found = finish(&looks[turn], prior, candidate)?;
            Some(Registration {
                stored_turn: turns[turn],
                ..found
            })
        })
        .collect();
    finished.sort_by(|a, b| a.log_false_alarms.total_cmp(&b.log_false_alarms));
    judge(finished, look.ground_down)
}

/// The first of `finished`, best first, if it can be believed.
fn judge(finished: Vec<Registration>, ground_down: f64) -> Result<Registration, NotRegistered> {
    let mut finished = finished.into_iter();
    let best = finished.next().ok_or(NotRegistered::NothingAlike)?;
    if best.log_false_alarms > MOST_FALSE_ALARMS {
        return Err(NotRegistered::Disagreement {
            tried: best.tried,
            log_false_alarms: best.log_false_alarms,
        });
    }
    let elsewhere = |other: &Registration| {
        other.stored_turn != best.stored_turn
            || !are_beside(&best.fit.at, &other.fit.at, ground_down)
    };
    match finished.find(elsewhere) {
        Some(other) if other.log_false_alarms < best.log_false_alarms - MOST_FALSE_ALARMS => {
            Err(NotRegistered::Ambiguous {
                distance: best.centre.distance(&other.centre),
            })
        }
        _ => Ok(best),
    }
}
