//! Ground that looks like a landmark, and whether a place that was found may be that while the landmark itself is
//! out of the picture.

use super::patch::OrientedPatch;
use super::variants::{PatchVariant, PatchVariants};
use super::weighed::Prior;
use crate::evidence::Evidence;
use crate::landmark::look_alike::LookAlike;
use crate::landmark::peak::{best_peaks, separation};
use crate::landmark::window::window_around;
use crate::texture::Texture;
use nalgebra::Vector2;
use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::ChannelSearch;

/// Twins that are kept.
const MOST: usize = 16;
/// Farthest twins, metres in north and east.
const FARTHEST: f64 = 120.0;

impl OrientedPatch {
    /// Ground of `map` that looks like it, `reach` metres to each side and farther, as far as that matters.
    pub(super) fn twins(&mut self, map: &dyn Imagery, reach: f64) -> &[LookAlike] {
        let reach = reach.min(FARTHEST);
        if reach > self.twins.0 {
            // A filter that drifts asks for a little more in every frame.
            let farther = (1.5 * reach).min(FARTHEST);
            self.twins = (farther, find(map, self, farther));
        }
        &self.twins.1
    }
}

/// Twins of a patch on the map out to `reach` metres.
fn find(map: &dyn Imagery, patch: &mut OrientedPatch, reach: f64) -> Vec<LookAlike> {
    let (gsd, size) = (patch.gsd, patch.size);
    let pixels = (reach / gsd).ceil() as usize;
    let window = window_around(patch.bounds.center(), gsd, size, (pixels, pixels));
    let picture = map.window(&window);
    let covered = picture.map(|p| if p[3] == 255 { 1.0 } else { 0.0 });
    let (channels, covered) = Texture::EdgesAndContrast.channels(&picture.to_gray(), covered, 0);
    let as_it_is = PatchVariants::new(size.0 as f64, 0.0, 0.0);
    let template = patch.template(&as_it_is, PatchVariant { turn: 0, size: 0 });
    let surface = template.and_then(|t| ChannelSearch::new(&channels, &covered).correlate(&t));
    let Some(surface) = surface else {
        return Vec::new();
    };
    let apart = separation(size);
    best_peaks(&surface.score, apart, MOST + 1)
        .into_iter()
        .filter(|p| p.column.abs_diff(pixels).max(p.row.abs_diff(pixels)) >= apart)
        .map(|p| LookAlike {
            offset: gsd
                * Vector2::new(
                    pixels as f64 - p.row as f64,
                    p.column as f64 - pixels as f64,
                ),
            score: f64::from(p.score),
        })
        .collect()
}

/// Result of a search, and what it saw elsewhere.
pub(super) struct TwinSearch<'a> {
    pub prior: &'a Prior,
    pub evidence: Evidence,
    /// Middle of the patch.
    pub place: GroundPoint,
    pub score: f64,
    /// Best score of a patch with its middle at a place; `None` where that is not seen.
    pub score_at: &'a dyn Fn(&GroundPoint) -> Option<f64>,
}

/// Odds that what was found is a twin of a landmark that is seen elsewhere, and of one that is not seen, against its
/// being the landmark.
///
/// A twin that scores m on the map shares as much with the landmark: only by the rest do scores tell the two apart.
/// One of a landmark that nobody sees scores in a picture what it scores on the map, give or take chance.
pub(super) fn odds(twins: &[LookAlike], found: &TwinSearch<'_>) -> [f64; 2] {
    let likelihood = |score: f64| found.evidence.log_likelihood(score, 1.0);
    let mut odds = [0.0; 2];
    for twin in twins {
        let landmark = GroundPoint::from(found.place.to_vector() - twin.offset);
        let nearer = found.prior.log_of_place(&landmark) - found.prior.log_of_place(&found.place);
        if let Some(score) = (found.score_at)(&landmark) {
            let worse = likelihood(found.score) - likelihood(score);
            odds[0] += (nearer - (1.0 - twin.score.clamp(0.0, 1.0)) * worse).exp();
        } else {
            let better = ((found.score - twin.score) / found.evidence.chance).max(0.0);
            odds[1] += (nearer - 0.5 * better * better).exp();
        }
    }
    odds
}
