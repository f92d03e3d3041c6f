//! Pieces of a frame laid as a whole that lie where the map has them: what a viewer can look at.

use super::fit::residual;
use super::grid::SweepGrid;
use super::ground::Texture;
use super::look::{FrameLook, MapPose};
use super::patches::{PatchMatch, PatchPlan, find_patches};

/// Side of a piece, pixels of the sweep; how far it is looked for.
const SIDE: usize = 24;
const REACH: usize = 6;
/// Distance within which a piece is where it should be, pixels of the sweep: buildings lean by as much.
const WITHIN: f64 = 2.5;

/// The pieces that lie where the pose has them, and how many could have been found.
pub fn pieces(look: &FrameLook<'_>, at: &MapPose) -> Option<(Vec<PatchMatch>, usize)> {
    let footprint = look.footprint(at)?;
    let gsd = SweepGrid::full().gsd(&footprint);
    let plan = PatchPlan {
        texture: Texture::Edges,
        gsd,
        side: SIDE,
        stride: SIDE / 2,
        reach: REACH,
    };
    let search = find_patches(look, at, plan)?;
    let height = look.ground_down - at.pose.position_in_world.z;
    let limit = WITHIN * gsd * look.camera.focal / height;
    let is_there = |m: &&PatchMatch| residual(look, at, m).is_some_and(|r| r.norm() < limit);
    Some((
        search.matches.iter().filter(is_there).copied().collect(),
        search.tried,
    ))
}
