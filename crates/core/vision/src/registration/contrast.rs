//! A pose made exact by contrast: small patches of the frame found on a map of the same days, which agree.
//!
//! Where map and frame are of different dates, patches so small are seldom found; then there is no answer.

use super::agreement::{agree, least_likely};
use super::fit::{PoseFit, fit, residual};
use super::ground::Texture;
use super::look::{FrameLook, MapPose};
use super::patches::{PatchMatch, PatchPlan, PatchSearch, find_patches};
use super::prior::PosePrior;

/// Pixels across the shorter side of the footprint that give enough patches, if map and frame have as many.
const ENOUGH: f64 = 256.0;
/// Independent patches that are enough.
const WANTED: f64 = 64.0;
/// Tolerances of the agreement beyond which a match is an outlier of the fit.
const OUTLYING: f64 = 3.0;
/// Logarithm (base 10) of the false alarms of few patches from which all are looked for.
const PROMISING: f64 = -1.0;

/// A pose made exact, and how likely it is wrong.
pub struct Exact {
    pub fit: PoseFit,
    /// Matches that agree with it.
    pub matches: Vec<PatchMatch>,
    /// Patches that could have been found.
    pub tried: usize,
    /// Logarithm (base 10) of the agreements as good as this one that chance would give, or of the doubt.
    pub log_false_alarms: f64,
}

/// Patches found at one level, and the pose that they agree on.
struct ContrastLevel {
    search: PatchSearch,
    fit: PoseFit,
    /// Of the raw agreement, in which overlapping patches count fully; to compare guesses.
    agreement: f64,
    pixels_per_metre: f64,
}

/// Plan of the patches at a pose: at the ground sample distance that is fine enough for a frame that shows
/// nothing but map; and the finest that map and frame have.
fn plan(look: &FrameLook<'_>, at: &MapPose) -> Option<(PatchPlan, f64)> {
    let footprint = look.footprint(at)?;
    let height = look.ground_down - at.pose.position_in_world.z;
    let finest = look.map.native_gsd().max(height / look.camera.focal);
    let fine = finest.max(footprint.width().min(footprint.height()) / ENOUGH);
    let middle = PatchPlan {
        texture: Texture::Contrast,
        gsd: fine,
        side: 24,
        stride: 12,
        reach: 10,
    };
    Some((middle, finest))
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

fn level(
    look: &FrameLook<'_>,
    prior: &PosePrior,
    at: &MapPose,
    plan: PatchPlan,
) -> Option<ContrastLevel> {
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
    Some(ContrastLevel {
        search,
        fit,
        agreement: agreement.log_false_alarms,
        pixels_per_metre,
    })
}

/// The pose that coarse patches agree on around a guess, and how surely: the logarithm (base 10) of the false
/// alarms.
pub fn begin(look: &FrameLook<'_>, prior: &PosePrior, at: &MapPose) -> Option<(MapPose, f64)> {
    let (middle, _) = plan(look, at)?;
    let coarse = PatchPlan {
        gsd: 2.0 * middle.gsd,
        side: 16,
        stride: 6,
        reach: 12,
        ..middle
    };
    let level = level(look, prior, at, coarse)?;
    Some((level.fit.at, level.agreement))
}

/// Whether every fourth patch gives hope that they agree: most frames of other dates cost no more than that.
pub fn is_promising(look: &FrameLook<'_>, at: &MapPose) -> bool {
    let Some((plan, _)) = plan(look, at) else {
        return false;
    };
    let few = PatchPlan {
        stride: 2 * plan.stride,
        ..plan
    };
    let agreement = find_patches(look, at, few).and_then(|search| agree(&search));
    agreement.is_some_and(|a| a.log_false_alarms <= PROMISING)
}

/// Looks for the patches of a frame around a pose, and for what they agree on.
pub fn by_contrast(look: &FrameLook<'_>, prior: &PosePrior, start: &MapPose) -> Option<Exact> {
    let (plan, finest) = plan(look, start)?;
    let middle = level(look, prior, start, plan)?;
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
    Some(Exact {
        matches: matches
            .filter(|(_, r)| **r <= radius)
            .map(|(m, _)| *m)
            .collect(),
        tried: last.search.tried,
        log_false_alarms,
        fit: last.fit,
    })
}
