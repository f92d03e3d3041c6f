//! Looks for one landmark by its orientation field.

use std::sync::Arc;

use nalgebra::{Matrix2, Matrix4, Rotation2};

use super::patch::{ACROSS, OrientedBank, OrientedPatch};
use super::twins::{self, TwinSearch};
use super::variants::{PatchVariant, PatchVariants};
use super::weighed::{Prior, VariantPlace, WeighedPlaces};
use crate::evidence::Evidence;
use crate::landmark::match_evidence::{MatchEvidence, camera_gsd, in_picture};
use crate::landmark::patch::{FLAT_CONTRAST, gsd_of, level_of};
use crate::landmark::peak::separation;
use crate::landmark::rectify::rectify;
use crate::landmark::window::window_around;
use crate::landmark::{Detection, FrameView, Refusal, SearchRequest, Sighting, TemplateSettings};
use crate::texture::Texture;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{ChannelSearch, Gray, Peak, refine_peak, rival_peak};

/// Pixels beyond the search region on each side from which chance is told, too.
const CHANCE_REACH: usize = 12;
/// Variants in which chance is told.
const CHANCES: usize = 3;
/// Probability from which a place is believed.
pub const LEAST_PROBABILITY: f64 = 0.99;

/// Deviation per axis of where a place appears from where the map has it, beyond what the shape of the summit
/// tells, metres: what stands up leans another way in every picture, and shadows move.
const OTHER_DATE: f64 = 1.0;

/// Finds landmarks by the orientation fields of their map patches.
pub(in crate::landmark) struct OrientedDetector {
    bank: OrientedBank,
    settings: TemplateSettings,
}

/// Result of a search.
struct OrientedSearch {
    detection: Detection,
    refusal: Option<Refusal>,
    evidence: MatchEvidence,
}

impl OrientedDetector {
    /// A detector that cuts its patches from `map`.
    pub fn new(map: Arc<dyn Imagery>, settings: TemplateSettings) -> Self {
        Self {
            bank: OrientedBank::new(map),
            settings,
        }
    }

    /// Weighs every place, turn and size, and judges the best.
    fn search(
        &mut self,
        view: &FrameView<'_>,
        request: &SearchRequest<'_>,
    ) -> Result<OrientedSearch, Refusal> {
        let landmark = request.landmark;
        let center = landmark.bounds.center();
        let longer = landmark.bounds.width().max(landmark.bounds.height());
        let least = gsd_of(level_of(camera_gsd(view).max(self.bank.native_gsd())));
        let gsd = (longer / ACROSS).max(least);
        let (north, east) = request.half_extents(self.settings.search_sigmas);
        let twins = self.bank.twins(landmark, gsd, north.max(east)).to_vec();
        let patch = self.bank.patch(landmark, gsd);
        if patch.contrast < FLAT_CONTRAST {
            return Err(Refusal::Flat);
        }
        let size = patch.size;
        let reach = |metres: f64| ((metres / gsd).ceil() as usize + 1).max(CHANCE_REACH);
        let window = window_around(center, gsd, size, (reach(east), reach(north)));
        let (window, rectified, search) = seen(view, &window, size)?;
        let variants = patch.variants(request.turn_deviation, request.log_scale_deviation);
        let all: Vec<PatchVariant> = variants.all().collect();
        let apart = all.len().div_ceil(CHANCES);
        let by_chance = all.iter().step_by(apart).filter_map(|variant| {
            search.correlate(&patch.template(&variants, *variant)?.turned_half())
        });
        let evidence = Evidence::from_chance(by_chance).ok_or(Refusal::Flat)?;
        // Nothing is known to less than half a pixel, and a place stands for a pixel.
        let covariance =
            request.displacement_covariance + Matrix2::identity() * (0.5 * gsd).powi(2);
        let prior = Prior {
            center,
            information: covariance.try_inverse().ok_or(Refusal::OutOfPicture)?,
            turn: request.turn_deviation,
            log_scale: request.log_scale_deviation,
        };
        let mut weighed = WeighedPlaces::new(&prior, &window, size, evidence);
        for variant in all {
            let template = patch.template(&variants, variant);
            if let Some(surface) = template.and_then(|t| search.correlate(&t)) {
                weighed.add(&variants, variant, &surface);
            }
        }
        let likely = weighed.probabilities(separation(size));
        let (coarse, likely) = weighed.best.zip(likely).ok_or(Refusal::OutOfPicture)?;
        let best = between(coarse, patch, &variants, &search);
        let middle = weighed.ground_at(best.peak.x, best.peak.y);
        let found = TwinSearch {
            prior: &prior,
            evidence,
            place: middle,
            score: best.peak.value,
            score_at: &|place| weighed.score_at(place),
        };
        let (here, refusal) = judge(likely, twins::odds(&twins, &found));
        let second = rival_peak(&weighed.best_scores, &best.peak, separation(size) as f64);
        let (rotation, log_scale) = (
            variants.turn(best.variant),
            variants.log_scale(best.variant),
        );
        let arm = landmark.reference.to_vector() - center.to_vector();
        let arm = log_scale.exp() * (Rotation2::new(rotation) * arm);
        let detection = Detection {
            ground: (middle.to_vector() + arm).into(),
            covariance: covariance_of(&best, evidence, gsd, variants.step),
            score: best.peak.value,
            second_score: second.map_or(0.0, |s| s.value),
            probability: Some(here),
            rotation,
            scale: log_scale.exp(),
        };
        let peaks = [Some(best.peak), second].into_iter().flatten();
        Ok(OrientedSearch {
            detection,
            refusal,
            evidence: MatchEvidence {
                patch: patch.luminance(),
                rectified,
                peaks: peaks.map(|p| (p.x, p.y)).collect(),
                surface: weighed.best_scores,
                gsd,
            },
        })
    }

    /// Looks for the landmark of `request` in `view`.
    pub fn detect(&mut self, view: &FrameView<'_>, request: &SearchRequest<'_>) -> Sighting {
        match self.search(view, request) {
            Err(refusal) => Sighting::Refused(refusal, None),
            Ok(searched) => match searched.refusal {
                None => Sighting::Found(searched.detection),
                Some(refusal) => Sighting::Refused(refusal, Some(searched.detection)),
            },
        }
    }

    /// Pictures that explain the search.
    pub fn explain(
        &mut self,
        view: &FrameView<'_>,
        request: &SearchRequest<'_>,
    ) -> Result<MatchEvidence, Refusal> {
        self.search(view, request).map(|searched| searched.evidence)
    }
}

/// Part of `window` that the picture shows, its luminance, and its channels to be searched for a patch of
/// `size` pixels.
fn seen(
    view: &FrameView<'_>,
    window: &Window,
    size: (usize, usize),
) -> Result<(Window, Gray, ChannelSearch), Refusal> {
    let window = in_picture(window, view).ok_or(Refusal::OutOfPicture)?;
    if window.width < size.0 || window.height < size.1 {
        return Err(Refusal::OutOfPicture);
    }
    let ground = rectify(view, &window);
    let covered = if ground.complete {
        Gray::filled(window.width, window.height, 1.0)
    } else {
        ground.seen
    };
    let (channels, covered) = Texture::EdgesAndContrast.channels(&ground.luminance, covered, 0);
    let search = ChannelSearch::new(&channels, &covered);
    Ok((window, ground.luminance, search))
}

/// The best of a place and of what lies beside it between the turns and sizes of the grid.
fn between(
    coarse: VariantPlace,
    patch: &mut OrientedPatch,
    variants: &PatchVariants,
    search: &ChannelSearch,
) -> VariantPlace {
    let mut best = coarse;
    for variant in PatchVariants::beside(coarse.variant) {
        let (column, row) = coarse.peak.sample;
        let template = patch.template(variants, variant);
        if let Some(surface) = template.and_then(|t| search.correlate(&t)) {
            let peak = nearby(&surface.score, column, row);
            if peak.value > best.peak.value {
                best = VariantPlace {
                    variant,
                    peak,
                    ..best
                };
            }
        }
    }
    best
}

/// The probability of the best place, and why it is not believed: from the probabilities of this, of the likeliest
/// other and of none that is seen, and the odds of twins that are seen and that are not.
fn judge(
    [here, other, unseen]: [f64; 3],
    [seen_twin, unseen_twin]: [f64; 2],
) -> (f64, Option<Refusal>) {
    let here = here / (1.0 + here * (seen_twin + unseen_twin));
    let doubt = 1.0 - here;
    let refusal = if here >= LEAST_PROBABILITY {
        None
    } else if here * unseen_twin > 0.5 * doubt {
        Some(Refusal::LookAlike)
    } else if here * seen_twin > 0.5 * doubt {
        Some(Refusal::Ambiguous)
    } else if unseen > other && unseen > doubt - unseen {
        Some(Refusal::OutOfPicture)
    } else if other > 0.5 * doubt {
        Some(Refusal::Ambiguous)
    } else {
        Some(Refusal::LowScore)
    };
    (here, refusal)
}

/// The highest sample beside one, refined.
fn nearby(surface: &Gray, column: usize, row: usize) -> Peak {
    let columns = column.saturating_sub(1)..(column + 2).min(surface.width());
    let rows = row.saturating_sub(1)..(row + 2).min(surface.height());
    let all = rows.flat_map(|r| columns.clone().map(move |c| (c, r)));
    let best = all.max_by(|a, b| surface.get(a.0, a.1).total_cmp(&surface.get(b.0, b.1)));
    let (column, row) = best.unwrap_or((column, row));
    refine_peak(surface, column, row)
}

/// Covariance of the place (north, east, m²), of the turn and of the logarithm of the size: from how sharp the summit
/// is (Laplace's approximation), and from the `step` between what is tried.
fn covariance_of(best: &VariantPlace, evidence: Evidence, gsd: f64, step: f64) -> Matrix4<f64> {
    let h = best.peak.hessian;
    // Rows run south and columns east.
    let curvature = evidence.slope(best.peak.value, best.share) / (gsd * gsd)
        * Matrix2::new(h[(1, 1)], -h[(0, 1)], -h[(0, 1)], h[(0, 0)]);
    let sharp = (-curvature).try_inverse();
    let sharp = sharp.filter(|c| c[(0, 0)] > 0.0 && c.determinant() > 0.0);
    // On a ridge it is known to as far as is looked for a rival.
    let sharp = sharp.unwrap_or(Matrix2::identity() * (4.0 * gsd).powi(2));
    // Turn and size are known to a step of what was tried at last.
    let mut covariance = Matrix4::identity() * (0.5 * step).powi(2);
    let place = sharp + Matrix2::identity() * OTHER_DATE.powi(2);
    covariance.fixed_view_mut::<2, 2>(0, 0).copy_from(&place);
    covariance
}
