//! A landmark on another day, as the orientation field sees it.

use super::patch::{ACROSS, OrientedPatch};
use super::variants::{PatchVariant, PatchVariants};
use crate::landmark::patch::FLAT_CONTRAST;
use crate::landmark::peak::separation;
use crate::landmark::rehearsed::{MOST_BLANK, OFF_PIXELS, RehearsalFit, blank};
use crate::landmark::window::window_around;
use crate::texture::Texture;
use pilotage_base::frames::GroundRect;
use pilotage_raster::imagery::Imagery;
use pilotage_raster::raster::{ChannelSearch, Peak, highest_peak, rival_peak};

/// An orientation field is coarser than brightness: a best place so many times as far off is the landmark still.
const COARSER: f64 = 2.0;

/// Looks for the patch `bounds` of `map` on `day` within `radius` metres; `None` if the patch is flat, lies partly
/// beyond the map or has a hole in it.
pub(in crate::landmark) fn rehearse(
    map: &dyn Imagery,
    day: &dyn Imagery,
    bounds: &GroundRect,
    radius: f64,
) -> Option<RehearsalFit> {
    let gsd = (bounds.width().max(bounds.height()) / ACROSS).max(map.native_gsd());
    let mut patch = OrientedPatch::new(map, bounds, gsd);
    let size = patch.size;
    let own = map.window(&window_around(bounds.center(), gsd, size, (0, 0)));
    let has_hole = own.pixels().iter().any(|p| p[3] < 255) || blank(&own) > MOST_BLANK;
    if has_hole || patch.contrast < FLAT_CONTRAST {
        return None;
    }
    let as_it_is = PatchVariants::new(size.0 as f64, 0.0, 0.0);
    let template = patch.template(&as_it_is, PatchVariant { turn: 0, size: 0 })?;
    let reach = (radius / gsd).ceil() as usize;
    let window = window_around(bounds.center(), gsd, size, (reach, reach));
    let picture = day.window(&window);
    let covered = picture.map(|p| if p[3] == 255 { 1.0 } else { 0.0 });
    let (channels, covered) = Texture::EdgesAndContrast.channels(&picture.to_gray(), covered, 0);
    let surface = ChannelSearch::new(&channels, &covered).correlate(&template)?;
    let peak = highest_peak(&surface.score)?;
    let place = |peak: &Peak| {
        let (w, h) = (size.0 as f64, size.1 as f64);
        window.ground_at(peak.x + 0.5 * w, peak.y + 0.5 * h)
    };
    let found = place(&peak);
    let drift = found.distance(&bounds.center());
    if drift > COARSER * OFF_PIXELS * gsd {
        return Some(RehearsalFit {
            score: 0.0,
            rival: peak.value,
            rival_place: found,
            drift,
        });
    }
    let rival = rival_peak(&surface.score, &peak, separation(size) as f64);
    Some(RehearsalFit {
        score: peak.value,
        rival: rival.map_or(0.0, |r| r.value),
        rival_place: rival.map_or(bounds.center(), |r| place(&r)),
        drift,
    })
}
