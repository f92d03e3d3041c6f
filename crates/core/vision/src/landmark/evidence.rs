//! Evidence of a trained detector, what it saw and did in a search, for people who want to understand it.

use serde::{Deserialize, Serialize};

use super::cascade::{
    Cascade, CascadeKind, FeatureAnswer, HogPicture, Patch, ShownFeature, hog_picture,
    stage_answers, stage_features,
};
use super::trained::{SearchedGround, TrainedDetector, search};
use super::window::window_around;
use super::{FrameView, Refusal, SearchRequest};
use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Gray, Raster};

/// Cells of the HOG picture across the shorter side of the window.
const CELLS: usize = 8;
/// Pixels around a mark within which its window is looked for.
const AROUND: i64 = 3;

/// Stage of the detector: what it asks and what it lets pass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageLook {
    /// Its features, in the order in which its trees ask for them.
    pub features: Vec<ShownFeature>,
    /// Number of trees that vote.
    pub votes: usize,
    /// Least sum of votes that passes.
    pub threshold: f32,
    /// Windows that are left after it.
    pub left: usize,
}

/// A place at which the search marked the landmark.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MarkedPlace {
    /// Middle of the window, pixels of the searched ground, x right and y down.
    pub pixel: (f64, f64),
    /// The same on the ground under the assumed pose.
    pub ground: GroundPoint,
    /// Score of the fit; at least zero if every stage was passed.
    pub score: f64,
    /// Probability that a mark of this score is right, were it the only one.
    pub probability: f64,
}

/// A window as the detector is shown it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PatchLook {
    /// Grey levels.
    pub pixels: Raster<u8>,
    /// Its edges.
    pub hog: HogPicture,
    /// For each stage, what its features say of it.
    pub answers: Vec<Vec<FeatureAnswer>>,
}

/// Evidence of a trained detector: what it saw and did in a search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CascadeEvidence {
    /// Kind of features that the detector looks at.
    pub kind: CascadeKind,
    /// Width and height of the window that it is shown, pixels.
    pub size: (usize, usize),
    /// The searched ground under the assumed pose, at the detector's scale.
    pub window: Window,
    /// Place of the landmark's middle on the map.
    pub expected: GroundPoint,
    /// The camera picture as a north-up view of that ground, grey levels.
    pub ground: Raster<u8>,
    /// Stages that each window passed, by its upper left pixel.
    pub passed: Raster<u8>,
    /// Score of each window, by its upper left pixel: at least zero for one that passed every stage,
    /// below, a whole number less for each stage that it did not come to. Minus infinity where the
    /// camera did not see all of the window, which is then not looked at.
    pub scores: Gray,
    /// Windows that were looked at.
    pub windows: usize,
    /// Mean number of votes that were asked for a window.
    pub mean_votes: f64,
    /// The stages in the order in which a window meets them.
    pub stages: Vec<StageLook>,
    /// The best places apart from each other, the best first.
    pub marks: Vec<MarkedPlace>,
    /// Score from which on a mark counts.
    pub least_score: f64,
    /// The landmark on the map.
    pub on_map: Option<PatchLook>,
    /// The best window of the picture.
    pub in_picture: Option<PatchLook>,
}

impl CascadeEvidence {
    /// Looks for the landmark of `request` as its detector does; `map` shows what that was trained for.
    ///
    /// # Errors
    /// [`Refusal::Untrained`] without a detector, [`Refusal::OutOfPicture`] if no window lies whole in
    /// the picture.
    pub fn new(
        map: &dyn Imagery,
        view: &FrameView<'_>,
        request: &SearchRequest<'_>,
        sigmas: f64,
    ) -> Result<Self, Refusal> {
        let trained = request.landmark.trained_detector();
        let trained = trained.ok_or(Refusal::Untrained)?;
        Self::of(&trained, map, view, request, sigmas)
    }

    fn of(
        trained: &TrainedDetector,
        map: &dyn Imagery,
        view: &FrameView<'_>,
        request: &SearchRequest<'_>,
        sigmas: f64,
    ) -> Result<Self, Refusal> {
        let (cascade, gsd) = (&trained.cascade, trained.window.gsd);
        let size = (trained.window.width, trained.window.height);
        let reach = request.half_extents(sigmas);
        let expected = request.landmark.bounds.center();
        let marks = search(cascade, &trained.window, view, expected, reach)?;
        // Shown is the variant in which the best mark was found: places are carried into it by their pixels.
        let (shown, best) = (&trained.window, marks.first().ok_or(Refusal::OutOfPicture)?);
        let variant = shown.variants.nearest(best.rotation, best.log_scale);
        let seen = SearchedGround::new(cascade, shown, view, expected, reach, &variant)
            .ok_or(Refusal::OutOfPicture)?;
        let scores = seen.scores.map(|score| score as f32);
        let marks: Vec<MarkedPlace> = marks
            .iter()
            .filter_map(|mark| {
                let ground = seen.there(mark.ground)?;
                Some(MarkedPlace {
                    pixel: seen.window.pixel_at(&ground),
                    ground,
                    score: mark.score,
                    probability: trained.likelihood.probability(mark.score),
                })
            })
            .collect();
        // Of windows that were looked at: stages passed, and whether any stage was asked.
        let looks: Vec<(usize, bool)> = (scores.pixels().iter().zip(seen.said.stages.pixels()))
            .zip(seen.said.score.pixels())
            .filter(|((score, _), _)| score.is_finite())
            .map(|((_, passed), margin)| (usize::from(*passed), margin.is_finite()))
            .collect();
        let asked: usize = looks.iter().map(|look| votes_asked(cascade, *look)).sum();
        let best = marks.first().and_then(|m| best_window(&scores, m, size));
        let best = best.and_then(|(x, y)| Patch::cut(&seen.pixels, x, y, size.0, size.1));
        Ok(Self {
            kind: cascade.kind(),
            size,
            window: seen.window,
            expected: seen.expected,
            passed: seen.said.stages,
            windows: looks.len(),
            mean_votes: asked as f64 / looks.len().max(1) as f64,
            stages: stages(cascade, &looks),
            marks,
            least_score: trained.least_score,
            on_map: map_patch(map, request.landmark.bounds.center(), gsd, size)
                .map(|p| PatchLook::of(cascade, &p)),
            in_picture: best.map(|p| PatchLook::of(cascade, &p)),
            ground: seen.pixels,
            scores,
        })
    }

    /// Votes of all stages.
    pub fn all_votes(&self) -> usize {
        self.stages.iter().map(|stage| stage.votes).sum()
    }

    /// Windows that are left after the first `stages` stages.
    pub fn left_after(&self, stages: usize) -> usize {
        let stage = stages.checked_sub(1).and_then(|i| self.stages.get(i));
        stage.map_or(self.windows, |stage| stage.left)
    }
}

impl PatchLook {
    fn of(cascade: &Cascade, patch: &Patch) -> Self {
        let cell = (patch.width().min(patch.height()) / CELLS).max(2);
        let answers = (0..cascade.stages.len()).map(|stage| stage_answers(cascade, stage, patch));
        Self {
            pixels: Raster::from_fn(patch.width(), patch.height(), |x, y| {
                patch.pixels().get(x + 1, y + 1)
            }),
            hog: hog_picture(patch, cell),
            answers: answers.collect(),
        }
    }
}

/// Votes that were asked for a window that passed so many stages, if any was asked.
fn votes_asked(cascade: &Cascade, (passed, is_asked): (usize, bool)) -> usize {
    let met = if is_asked { passed + 1 } else { 0 };
    let stages = cascade.stages.iter().take(met);
    stages.map(super::cascade::Stage::votes).sum()
}

fn stages(cascade: &Cascade, looks: &[(usize, bool)]) -> Vec<StageLook> {
    let left = |stage: usize| looks.iter().filter(|look| look.0 > stage).count();
    let stages = cascade.stages.iter().enumerate();
    stages
        .map(|(number, stage)| StageLook {
            features: stage_features(cascade, number),
            votes: stage.votes(),
            threshold: stage.threshold,
            left: left(number),
        })
        .collect()
}

/// The window with the highest score about where a mark lies.
fn best_window(scores: &Gray, mark: &MarkedPlace, size: (usize, usize)) -> Option<(usize, usize)> {
    let corner = |middle: f64, size: usize| (middle - 0.5 * size as f64).round() as i64;
    let (x, y) = (corner(mark.pixel.0, size.0), corner(mark.pixel.1, size.1));
    let inside = |(x, y): &(i64, i64)| {
        (0..scores.width() as i64).contains(x) && (0..scores.height() as i64).contains(y)
    };
    let around = (-AROUND..=AROUND).flat_map(|dy| (-AROUND..=AROUND).map(move |dx| (dx, dy)));
    around
        .map(|(dx, dy)| (x + dx, y + dy))
        .filter(inside)
        .map(|(x, y)| (x as usize, y as usize))
        .max_by(|a, b| scores.get(a.0, a.1).total_cmp(&scores.get(b.0, b.1)))
}

/// The map around a place as large as the detector's window, with the pixel more on every side.
fn map_patch(
    map: &dyn Imagery,
    center: GroundPoint,
    gsd: f64,
    size: (usize, usize),
) -> Option<Patch> {
    let pixels = map.window(&window_around(center, gsd, size, (1, 1)));
    let byte = |grey: f32| grey.round().clamp(0.0, 255.0) as u8;
    Patch::with_margin(pixels.to_gray().map(byte))
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix2, Point3};

    use super::*;
    use crate::landmark::Landmark;
    use crate::landmark::cascade::{CascadeFeature, NodeSplit, TrainedStage, TrainedTree};
    use crate::landmark::trained::{DetectorWindow, Likelihood, MarkPrecision, Variants};
    use pilotage_base::frames::{Attitude, GroundRect, Pose};
    use pilotage_raster::camera::CameraModel;
    use pilotage_raster::raster::{Pyramid, Rgba};

    const GSD: f64 = 0.5;

    /// A bright square of 8 m around the origin on dark ground, and a bar that has only its upright edges.
    struct Square;

    impl Square {
        fn grey(p: &GroundPoint) -> u8 {
            let square = p.north.abs() < 4.0 && p.east.abs() < 4.0;
            let bar = (10.0..14.0).contains(&p.east) && p.north.abs() < 30.0;
            if square || bar { 210 } else { 60 }
        }
    }

    impl Imagery for Square {
        fn name(&self) -> &'static str {
            "square"
        }
        fn bounds(&self) -> GroundRect {
            GroundRect::centered(GroundPoint::default(), 200.0, 200.0)
        }
        fn native_gsd(&self) -> f64 {
            GSD
        }
        fn window(&self, window: &Window) -> Raster<Rgba> {
            Raster::from_fn(window.width, window.height, |x, y| {
                let grey = Self::grey(&window.ground_at(x as f64 + 0.5, y as f64 + 0.5));
                [grey, grey, grey, 255]
            })
        }
    }

    /// The first stage asks for an upright edge at the left, the second for a level one at the top.
    fn detector() -> TrainedDetector {
        let feature = |cell, component| CascadeFeature::Hog { cell, component };
        let stage = |feature, votes| TrainedStage {
            trees: (0..votes)
                .map(|_| TrainedTree::stump(feature, NodeSplit::Threshold(0.3), -1.0, 1.0))
                .collect(),
            threshold: 0.5,
        };
        let features = vec![feature([0, 6, 6, 6], 8), feature([6, 0, 6, 6], 4)];
        let stages = [stage(0, 1), stage(1, 3)];
        TrainedDetector {
            cascade: Cascade::from_parts(24, 24, features, &stages).unwrap(),
            window: DetectorWindow {
                gsd: GSD,
                width: 24,
                height: 24,
                variants: Variants::default(),
            },
            bounds: landmark().bounds,
            least_score: 0.0,
            likelihood: Likelihood {
                offset: 0.0,
                slope: 1.0,
            },
            precision: MarkPrecision::even(1.0),
            template: None,
        }
    }

    fn landmark() -> Landmark {
        let bounds = GroundRect::centered(GroundPoint::default(), 12.0, 12.0);
        Landmark::new(1, "Square", bounds)
    }

    /// The search from 60 m above the origin, on a heading in radians.
    fn looked(landmark: &Landmark, heading: f64) -> Result<CascadeEvidence, Refusal> {
        let camera = CameraModel::pinhole(320, 240, 60_f64.to_radians());
        let pose = Pose {
            position_in_world: Point3::new(0.0, 0.0, -60.0),
            attitude: Attitude::level(heading),
        };
        let pixels = Gray::from_fn(320, 240, |x, y| {
            let pixel = nalgebra::Point2::new(x as f64 + 0.5, y as f64 + 0.5);
            let ground = camera.ground_at(&pose, &pixel, 0.0);
            f32::from(ground.map_or(0, |p| Square::grey(&p)))
        });
        let luminance = Pyramid::new(pixels, 3);
        let view = FrameView {
            camera: &camera,
            pose,
            ground_down: 0.0,
            luminance: &luminance,
        };
        let request = SearchRequest {
            landmark,
            displacement_covariance: Matrix2::from_diagonal_element(16.0),
            turn_deviation: 0.02,
            log_scale_deviation: 0.01,
        };
        CascadeEvidence::new(&Square, &view, &request, 3.0)
    }

    #[test]
    fn what_is_told_of_a_search_is_what_happened_in_it() {
        let mut landmark = landmark();
        landmark.keep_trained(Some(&detector()));
        let told = looked(&landmark, 0.0).unwrap();
        let (width, height) = (told.passed.width(), told.passed.height());
        assert_eq!(
            (width, height),
            (told.window.width - 23, told.window.height - 23)
        );
        assert_eq!(told.windows, width * height, "all of it was in the picture");
        let passed = |least: u8| told.passed.pixels().iter().filter(|p| **p >= least).count();
        assert_eq!(told.left_after(0), told.windows);
        assert_eq!(
            (told.left_after(1), told.left_after(2)),
            (passed(1), passed(2))
        );
        assert!(told.left_after(2) > 0 && told.left_after(2) < told.left_after(1));
        // One vote for every window, three more for those that passed the first stage.
        let mean = 1.0 + 3.0 * passed(1) as f64 / told.windows as f64;
        assert!(
            (told.mean_votes - mean).abs() < 1e-12,
            "{}",
            told.mean_votes
        );
        assert_eq!(told.all_votes(), 4);
        // The square, and not the bar, passes both.
        let best = told.marks[0];
        assert!(
            best.score > 0.0 && best.ground.distance(&told.expected) < 2.0,
            "{best:?}"
        );
        let (x, y) = best.pixel;
        assert!(told.window.ground_at(x, y).distance(&best.ground) < 1e-9);
        let in_picture = told.in_picture.as_ref().unwrap();
        let needed = told.stages.iter().map(|s| s.threshold);
        for (answers, needed) in in_picture.answers.iter().zip(needed) {
            assert!(answers.iter().map(|a| a.vote).sum::<f32>() >= needed);
        }
        let on_map = told.on_map.as_ref().unwrap();
        assert_eq!(
            (on_map.pixels.get(12, 12), on_map.pixels.get(1, 1)),
            (210, 60)
        );
        assert_eq!(on_map.hog.cell, 3);
    }

    #[test]
    fn what_the_camera_does_not_see_is_not_counted_and_no_detector_is_told() {
        let mut landmark = landmark();
        assert_eq!(looked(&landmark, 0.6), Err(Refusal::Untrained));
        // At the picture's edge, which runs across the searched ground.
        let to = GroundRect::centered(GroundPoint::new(20.0, 0.0), 12.0, 12.0);
        landmark.reshape(to);
        let mut detector = detector();
        detector.bounds = to;
        landmark.keep_trained(Some(&detector));
        let told = looked(&landmark, 0.6).unwrap();
        let all = told.scores.pixels().len();
        let looked_at = told
            .scores
            .pixels()
            .iter()
            .filter(|s| s.is_finite())
            .count();
        assert_eq!(told.windows, looked_at);
        assert!(looked_at < all, "{looked_at} of {all}");
    }
}
