//! Pieces of the frame found again on the map, each for itself.

use nalgebra::{Point2, Vector2};

use super::ground::{GroundPicture, Texture};
use pilotage_base::frames::GroundPoint;
use pilotage_raster::raster::{ChannelSearch, ChannelTemplate, Gray, Template, highest_peak};

use super::look::{FrameLook, MapPose};

/// Share of a patch that must be covered on the map.
const COVERED: f64 = 0.9;

/// A patch of the frame and where on the map it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchMatch {
    /// Its centre in the picture, pixels.
    pub pixel: Point2<f64>,
    /// Place at which the patch was found on the map.
    pub ground: GroundPoint,
    /// Place at which the assumed pose would have put it.
    pub expected: GroundPoint,
    /// Correlation there.
    pub score: f64,
}

/// Plan of the patches, how they are cut and how far they are looked for; all in pixels of the ground sample
/// distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchPlan {
    /// Texture of the patches that is compared.
    pub texture: Texture,
    /// Ground sample distance, metres.
    pub gsd: f64,
    /// Side of a patch.
    pub side: usize,
    /// From one patch to the next, across and down.
    pub stride: usize,
    /// Pixels to each side of where a patch should be.
    pub reach: usize,
}

impl PatchPlan {
    /// Patches that share a pixel: so many times more are found than are independent.
    pub fn overlap(&self) -> usize {
        (self.side / self.stride).pow(2).max(1)
    }
}

/// Matches that [`find_patches`] found, and how it searched.
#[derive(Clone, Debug)]
pub struct PatchSearch {
    /// Matches, one for every patch that has a summit within the search.
    pub matches: Vec<PatchMatch>,
    /// Patches that had texture and map to be found.
    pub tried: usize,
    /// Plan of the search.
    pub plan: PatchPlan,
}

/// Looks for the patches of a frame, laid on the map at `place`.
pub fn find_patches(look: &FrameLook<'_>, place: &MapPose, plan: PatchPlan) -> Option<PatchSearch> {
    let PatchPlan {
        texture,
        gsd,
        side,
        stride,
        reach,
    } = plan;
    let footprint = look.footprint(place)?;
    let margin = reach as f64 * gsd;
    let radius = side / 2;
    let map = GroundPicture::of_map(look.map, &footprint.grown(margin), gsd, texture, radius);
    let (window, (left, top)) = map.window.touching(&footprint)?;
    let frame = GroundPicture::of_frame(look, place, &window, texture, radius);
    let mut search = PatchSearch {
        matches: Vec::new(),
        tried: 0,
        plan,
    };
    for row in (0..window.height.saturating_sub(side - 1)).step_by(stride) {
        for column in (0..window.width.saturating_sub(side - 1)).step_by(stride) {
            let (map_column, map_row) = (left + column, top + row);
            if frame.covered(column, row, side, side) < 1.0
                || map.covered(map_column, map_row, side, side) < COVERED
            {
                continue;
            }
            let first = (
                map_column.saturating_sub(reach),
                map_row.saturating_sub(reach),
            );
            let last = (map_column + reach, map_row + reach);
            let Some(surface) = correlate(&frame, (column, row), side, &map, first, last) else {
                continue;
            };
            search.tried += 1;
            let Some(peak) = highest_peak(&surface) else {
                continue;
            };
            let (c, r) = peak.sample;
            if c == 0 || r == 0 || c + 1 == surface.width() || r + 1 == surface.height() {
                continue;
            }
            let half = 0.5 * side as f64;
            let centre = Vector2::new(column as f64 + half, row as f64 + half);
            let expected = window.ground_at(centre.x, centre.y);
            let ground = map.window.ground_at(
                first.0 as f64 + peak.x + half,
                first.1 as f64 + peak.y + half,
            );
            let Some(pixel) = look.pixel(place, &expected) else {
                continue;
            };
            search.matches.push(PatchMatch {
                pixel,
                ground,
                expected,
                score: peak.value,
            });
        }
    }
    Some(search)
}

/// The correlation of the patch of `frame` at `corner` with the map, for its top-left corner at `first` to
/// `last`; `None` if there is nothing to compare.
fn correlate(
    frame: &GroundPicture,
    corner: (usize, usize),
    side: usize,
    map: &GroundPicture,
    first: (usize, usize),
    last: (usize, usize),
) -> Option<Gray> {
    if let ([frame], [map]) = (&frame.channels[..], &map.channels[..]) {
        let template = Template::new(&frame.crop(corner.0, corner.1, side, side)?)?;
        return Some(template.correlate_at(map, first.0..last.0 + 1, first.1..last.1 + 1));
    }
    let cut = |picture: &Gray| picture.crop(corner.0, corner.1, side, side);
    let channels: Option<Vec<Gray>> = frame.channels.iter().map(cut).collect();
    let template = ChannelTemplate::new(&channels?, &cut(&frame.covered)?)?;
    let width = (last.0 + side).min(map.covered.width()) - first.0;
    let height = (last.1 + side).min(map.covered.height()) - first.1;
    let cut = |picture: &Gray| picture.crop(first.0, first.1, width, height);
    let channels: Option<Vec<Gray>> = map.channels.iter().map(cut).collect();
    let surface = ChannelSearch::new(&channels?, &cut(&map.covered)?).correlate(&template)?;
    Some(surface.score)
}
