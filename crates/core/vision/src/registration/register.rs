//! From what is known of a pose to one that can be trusted, or to none.

use nalgebra::{Matrix2, Matrix6};
use serde::{Deserialize, Serialize};

use super::CameraPlace;
use super::contrast::{Exact, begin, by_contrast, is_promising};
use super::edges::pieces;
use super::fit::PoseFit;
use super::guess::{BELIEVED, PoseGuess, are_beside};
use super::look::{FrameLook, MapPose};
use super::patches::PatchMatch;
use super::prior::PosePrior;
use super::summit::{climb, place_by_edges};
use super::sweep::sweep;
use pilotage_base::frames::GroundPoint;
use pilotage_base::statistics::probability_words;
use pilotage_raster::camera::CameraModel;

/// Guesses of the sweep that are kept.
const GUESSES: usize = 6;
/// Of these, those whose coarse patches agree best are looked at finely.
const FINISHED: usize = 2;
/// Guesses less probable than this are not made exact.
const LEAST_PROBABLE: f64 = 1e-3;
/// A frame of other ground is believed by its patches once in ten thousand, as a logarithm (base 10).
const MOST_FALSE_ALARMS: f64 = -4.0;

/// By what a frame was believed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum RegistrationMethod {
    /// Small patches agree on one pose: map and frame look alike in detail.
    #[default]
    Patches,
    /// The edges of the whole frame correlate with one place by far best.
    WholeFrame,
}

/// A frame laid on the map.
#[derive(Clone, Debug, PartialEq)]
pub struct Registration {
    /// Pose over the map, its covariance, how the map is stretched.
    pub fit: PoseFit,
    /// Matches that agree with the pose.
    pub matches: Vec<PatchMatch>,
    /// Patches that could have been found.
    pub tried: usize,
    /// By what it was believed.
    pub laid_by: RegistrationMethod,
    /// Logarithm (base 10) of how likely it is wrong: the agreements as good as this one that chance would
    /// give on a map of other ground, or the probability that the whole frame lies elsewhere.
    pub log_false_alarms: f64,
    /// Probability of this place by the whole frame alone, against all others that the prior allows and
    /// against none.
    pub probability: f64,
    /// Place of the camera, the slope of the ground told from its tilt.
    pub camera: CameraPlace,
    /// Place of the map in the middle of the picture.
    pub centre: GroundPoint,
    /// Covariance of that place, north and east, m².
    pub centre_covariance: Matrix2<f64>,
    /// Turn of the stored picture against the mount beyond the one that is known, radians clockwise, a
    /// multiple of a quarter turn: π for one stored upside down. Zero where the heading is not measured.
    pub stored_turn: f64,
    /// Correlation of the whole frame's edges with the map.
    pub score: f64,
}

/// Why a frame could not be laid on the map.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotRegistered {
    /// There is no map where the picture may be.
    #[error("there is no map within reach, or nothing in the picture to compare with it")]
    NothingAlike,
    /// The likeliest place is not likely enough.
    #[error("the likeliest place has a probability of {}; nothing within reach looks enough like the picture", probability_words(*probability))]
    Doubtful {
        /// Its probability.
        probability: f64,
    },
    /// Another place explains the picture about as well.
    #[error("two places {distance:.0} m apart explain the picture ({} and {})", probability_words(*probability), probability_words(*other))]
    Ambiguous {
        /// Distance between the two, metres.
        distance: f64,
        /// Probability of the likelier one.
        probability: f64,
        /// Probability of the other one.
        other: f64,
    },
}

/// All that a frame says of where it was taken.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameSighting {
    /// The place that it can be laid on for itself, or why there is none.
    pub verdict: Result<Registration, NotRegistered>,
    /// Every place that is not improbable, the likeliest first, no two the same; other frames may tell which.
    pub places: Vec<Registration>,
}

impl FrameSighting {
    fn of_nothing() -> Self {
        Self {
            verdict: Err(NotRegistered::NothingAlike),
            places: Vec::new(),
        }
    }
}

impl Registration {
    /// Probability of this place by all that was looked at, its patches as well.
    pub fn belief(&self) -> f64 {
        match self.laid_by {
            RegistrationMethod::WholeFrame => self.probability,
            RegistrationMethod::Patches => self
                .probability
                .max(1.0 - 10_f64.powf(self.log_false_alarms)),
        }
    }
}

impl NotRegistered {
    /// Probability of the likeliest place.
    pub fn probability(&self) -> f64 {
        match *self {
            Self::NothingAlike => 0.0,
            Self::Doubtful { probability } | Self::Ambiguous { probability, .. } => probability,
        }
    }
}

/// Lays a frame on the map: [`sight`]'s verdict.
///
/// # Errors
/// Why no place can be believed.
pub fn register(look: &FrameLook<'_>, prior: &PosePrior) -> Result<Registration, NotRegistered> {
    sight(look, prior).verdict
}

/// Looks where a frame may lie on the map: sweeps over all that the prior allows, makes the likeliest poses exact, and
/// believes one if its patches agree as chance would not have it, or if the whole frame leaves little doubt.
pub fn sight(look: &FrameLook<'_>, prior: &PosePrior) -> FrameSighting {
    let turns = prior.heading.turns();
    let cameras: Vec<CameraModel> = turns
        .iter()
        .map(|turn| look.camera.stored_turned(*turn))
        .collect();
    let looks: Vec<FrameLook<'_>> = cameras
        .iter()
        .map(|camera| FrameLook { camera, ..*look })
        .collect();
    let guesses = sweep(&looks, prior, GUESSES);
    let turned = |guess: &PoseGuess, laid: Registration| Registration {
        stored_turn: turns[guess.turn],
        ..laid
    };
    let Some((first, others)) = guesses.split_first() else {
        return FrameSighting::of_nothing();
    };
    let made_exact =
        |guess: &PoseGuess| Some(turned(guess, exact(&looks[guess.turn], prior, guess)?));
    let mut laid: Vec<Registration> = made_exact(first).into_iter().collect();
    // Rivals of a place that leaves them little are not worth the time.
    if laid.is_empty() || first.probability < BELIEVED {
        let likely = others.iter().filter(|g| g.probability > LEAST_PROBABLE);
        laid.extend(likely.filter_map(made_exact));
    }
    let is_sure =
        |r: &Registration| r.laid_by == RegistrationMethod::Patches || r.probability >= BELIEVED;
    if !laid.iter().any(is_sure) {
        // Patches of a map of the same day may know better.
        let mut begun: Vec<_> = guesses
            .iter()
            .filter_map(|g| Some((g, begin(&looks[g.turn], prior, &g.at)?)))
            .collect();
        begun.sort_by(|a, b| a.1.1.total_cmp(&b.1.1));
        let finished = begun
            .into_iter()
            .take(FINISHED)
            .filter_map(|(guess, (at, _))| {
                let found = by_patches(&looks[guess.turn], prior, guess, &at)?;
                Some(turned(guess, found))
            });
        laid.extend(finished);
    }
    // What patches agree on comes before what is only alike as a whole.
    laid.sort_by(|a, b| {
        let rank =
            |r: &Registration| (r.laid_by != RegistrationMethod::Patches, r.log_false_alarms);
        let (a, b) = (rank(a), rank(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let places = apart(&laid, look.ground_down);
    FrameSighting {
        verdict: judge(laid, first.probability, look.ground_down),
        places,
    }
}

/// Those of `laid` that are not one with an earlier one, the likeliest first.
fn apart(laid: &[Registration], ground_down: f64) -> Vec<Registration> {
    let mut places: Vec<Registration> = Vec::new();
    for found in laid {
        let is_known = |k: &Registration| {
            k.stored_turn == found.stored_turn && are_beside(&k.fit.at, &found.fit.at, ground_down)
        };
        if found.belief() > LEAST_PROBABLE && !places.iter().any(is_known) {
            places.push(found.clone());
        }
    }
    places.sort_by(|a, b| b.belief().total_cmp(&a.belief()));
    places
}

/// A guess made exact.
fn exact(look: &FrameLook<'_>, prior: &PosePrior, guess: &PoseGuess) -> Option<Registration> {
    let begun = climb(look, prior, guess);
    let start = begun.map_or(guess.at, |top| top.at);
    if is_promising(look, &start)
        && let Some(laid) = by_patches(look, prior, guess, &start)
    {
        return Some(laid);
    }
    let fit = place_by_edges(look, prior, guess, &begun?)?.fit(look, prior)?;
    let (matches, tried) = pieces(look, &fit.at)?;
    let by_edges = Exact {
        fit,
        matches,
        tried,
        log_false_alarms: guess.log_doubt,
    };
    registration(look, prior, guess, RegistrationMethod::WholeFrame, by_edges)
}

/// Registration on which patches around a pose agree, if chance does not explain it.
fn by_patches(
    look: &FrameLook<'_>,
    prior: &PosePrior,
    guess: &PoseGuess,
    start: &MapPose,
) -> Option<Registration> {
    let found = by_contrast(look, prior, start)?;
    (found.log_false_alarms <= MOST_FALSE_ALARMS)
        .then(|| registration(look, prior, guess, RegistrationMethod::Patches, found))
        .flatten()
}

fn registration(
    look: &FrameLook<'_>,
    prior: &PosePrior,
    guess: &PoseGuess,
    laid_by: RegistrationMethod,
    found: Exact,
) -> Option<Registration> {
    let (centre, centre_covariance) = found.fit.centre(look)?;
    let mut camera = found.fit.camera(look, prior)?;
    let of_map = prior.map_deviation.powi(2);
    camera.covariance += Matrix6::from_diagonal(&[of_map, of_map, 0.0, 0.0, 0.0, 0.0].into());
    Some(Registration {
        fit: found.fit,
        matches: found.matches,
        tried: found.tried,
        laid_by,
        log_false_alarms: found.log_false_alarms,
        probability: guess.probability,
        camera,
        centre,
        centre_covariance: centre_covariance + Matrix2::identity() * of_map,
        stored_turn: 0.0,
        score: guess.score,
    })
}

/// The first of `laid`, best first, if it can be believed; `likeliest` is the probability of the likeliest guess.
fn judge(
    laid: Vec<Registration>,
    likeliest: f64,
    ground_down: f64,
) -> Result<Registration, NotRegistered> {
    let mut laid = laid.into_iter();
    let best = laid.next().ok_or(NotRegistered::NothingAlike)?;
    let elsewhere = |other: &Registration| {
        other.stored_turn != best.stored_turn
            || !are_beside(&best.fit.at, &other.fit.at, ground_down)
    };
    let rival = laid.find(elsewhere);
    let ambiguous = |other: &Registration| NotRegistered::Ambiguous {
        distance: best.centre.distance(&other.centre),
        probability: best.probability,
        other: other.probability,
    };
    match (best.laid_by, rival) {
        (RegistrationMethod::Patches, Some(other))
            if other.laid_by == RegistrationMethod::Patches
                && other.log_false_alarms < best.log_false_alarms - MOST_FALSE_ALARMS =>
        {
            Err(ambiguous(&other))
        }
        (RegistrationMethod::Patches, _) => Ok(best),
        _ if best.probability >= BELIEVED => Ok(best),
        // Two places explain the picture where one of them does more likely than not.
        (_, Some(other))
            if other.probability > 0.5 * best.probability
                && best.probability + other.probability > 0.5 =>
        {
            Err(ambiguous(&other))
        }
        _ => Err(NotRegistered::Doubtful {
            probability: likeliest,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::super::laid_for_tests::laid_at;
    use super::*;

    #[test]
    fn two_places_explain_a_picture_only_where_it_likely_shows_one_of_them() {
        let judged = |a: f64, b: f64| {
            let laid = vec![laid_at(0.0, 0.0, a), laid_at(300.0, 0.0, b)];
            judge(laid, a, 0.0).unwrap_err()
        };
        assert_eq!(
            judged(0.03, 0.02),
            NotRegistered::Doubtful { probability: 0.03 }
        );
        assert_eq!(
            judged(0.4, 0.3),
            NotRegistered::Ambiguous {
                distance: 300.0,
                probability: 0.4,
                other: 0.3
            }
        );
    }
}
