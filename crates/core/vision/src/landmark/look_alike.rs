//! Other places of the map that look like a landmark, and the test for whether a place that was found may be
//! one.

use nalgebra::{Matrix2, Vector2};

use super::features::{FeatureTemplate, Features};
use super::peak::{FORBIDDEN, best_peaks, separation};
use super::window::window_around;
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_base::statistics::normal_probability;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::Gray;

/// Look-alikes that are kept.
const MOST: usize = 16;
/// Look-alikes that score less on the map are no danger.
const LEAST: f32 = 0.2;
/// Gain of a look-alike's score in a picture over that on the map, where it is turned and enlarged to fit
/// best and the light is another: mean and standard deviation. One that was taken for its landmark scored
/// 0.08 more.
const BETTER: (f64, f64) = (0.03, 0.05);
/// Probability of the look-alike over that of the landmark from which on it is taken for one.
const ODDS: f64 = 0.05;
/// Farthest look-alikes, metres in north and east.
const FARTHEST: f64 = 120.0;

/// A place of the map that looks like a landmark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::landmark) struct LookAlike {
    /// Offset of the place from the landmark, metres north and east.
    pub offset: Vector2<f64>,
    /// Its score on the map.
    pub score: f64,
}

/// Look-alikes of a landmark out to some distance.
#[derive(Clone, Debug, Default)]
pub(super) struct LookAlikes {
    /// Distance out to which look-alikes were looked for, metres in north and east.
    reach: f64,
    all: Vec<LookAlike>,
}

impl LookAlikes {
    /// Looks for them out to `reach` metres or a little more, unless that was done already.
    pub fn find(
        &mut self,
        map: &dyn Imagery,
        bounds: &GroundRect,
        (template, size): (&FeatureTemplate, (usize, usize)),
        gsd: f64,
        reach: f64,
    ) -> &[LookAlike] {
        let reach = reach.min(FARTHEST);
        if reach > self.reach {
            // A filter that drifts asks for a little more in every frame.
            self.reach = (1.5 * reach).min(FARTHEST);
            let pixels = (self.reach / gsd).ceil() as usize;
            let window = window_around(bounds.center(), gsd, size, (pixels, pixels));
            let surface = template.correlate(&Features::new(map.window(&window).to_gray()));
            let apart = separation(size);
            self.all = best_peaks(&surface, apart, MOST + 1)
                .into_iter()
                .filter(|p| {
                    let own = p.column.abs_diff(pixels).max(p.row.abs_diff(pixels)) < apart;
                    !own && p.score >= LEAST
                })
                .map(|p| LookAlike {
                    offset: gsd
                        * Vector2::new(
                            pixels as f64 - p.row as f64,
                            p.column as f64 - pixels as f64,
                        ),
                    score: f64::from(p.score),
                })
                .collect();
        }
        &self.all
    }
}

/// Result of a search: the score at every offset of a patch of `size` pixels in `window`.
pub(super) struct LookAlikeSearch<'a> {
    pub surface: &'a Gray,
    pub window: &'a Window,
    pub size: (usize, usize),
    /// Expected place of the landmark's middle, and its covariance, m².
    pub expected: (GroundPoint, Matrix2<f64>),
}

impl LookAlikeSearch<'_> {
    /// Whether a landmark with its middle at `place` would be in the picture whole.
    fn is_seen(&self, place: &GroundPoint) -> bool {
        let column = (place.east - self.window.west_edge) / self.window.gsd;
        let row = (self.window.north_edge - place.north) / self.window.gsd;
        let column = (column - 0.5 * self.size.0 as f64).round();
        let row = (row - 0.5 * self.size.1 as f64).round();
        let within = |at: f64, count: usize| (0.0..count as f64).contains(&at);
        within(column, self.surface.width())
            && within(row, self.surface.height())
            && self.surface.get(column as usize, row as usize) > FORBIDDEN
    }

    /// Whether what was found at `place` with `score` may be a look-alike of a landmark that is out of
    /// the picture. One that is in the picture would have scored better itself.
    pub fn may_be(&self, look_alikes: &[LookAlike], place: &GroundPoint, score: f64) -> bool {
        let (expected, covariance) = &self.expected;
        let Some(root) = covariance.cholesky() else {
            return false;
        };
        let surprise = |at: &GroundPoint| {
            let off = at.to_vector() - expected.to_vector();
            0.5 * root.solve(&off).dot(&off)
        };
        look_alikes.iter().any(|other| {
            let landmark = GroundPoint::from(place.to_vector() - other.offset);
            let so_good = 1.0 - normal_probability((score - other.score - BETTER.0) / BETTER.1);
            let odds = (surprise(place) - surprise(&landmark)).exp() * so_good;
            odds > ODDS && !self.is_seen(&landmark)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_raster::raster::{Raster, Rgba};

    /// Two crosses 40 m apart on bare ground.
    struct Twins;

    impl Imagery for Twins {
        fn name(&self) -> &'static str {
            "twins"
        }
        fn bounds(&self) -> GroundRect {
            GroundRect::centered(GroundPoint::default(), 400.0, 400.0)
        }
        fn native_gsd(&self) -> f64 {
            1.0
        }
        fn window(&self, window: &Window) -> Raster<Rgba> {
            Raster::from_fn(window.width, window.height, |column, row| {
                let at = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
                let on = |east: f64| {
                    let (x, y) = ((at.east - east).abs(), at.north.abs());
                    (x < 2.0 && y < 8.0) || (y < 2.0 && x < 8.0)
                };
                let v = if on(0.0) || on(40.0) { 220 } else { 90 };
                [v, v, v, 255]
            })
        }
    }

    fn look_alikes() -> Vec<LookAlike> {
        let bounds = GroundRect::centered(GroundPoint::default(), 20.0, 20.0);
        let window = Window {
            north_edge: 10.0,
            west_edge: -10.0,
            gsd: 1.0,
            width: 20,
            height: 20,
        };
        let patch = Features::new(Twins.window(&window).to_gray());
        let template = FeatureTemplate::new(&patch).unwrap();
        let mut found = LookAlikes::default();
        let near = found.find(&Twins, &bounds, (&template, (20, 20)), 1.0, 20.0);
        assert!(near.iter().all(|l| l.score < 0.9), "{near:?}");
        found
            .find(&Twins, &bounds, (&template, (20, 20)), 1.0, 60.0)
            .to_vec()
    }

    #[test]
    fn a_twin_is_found_once_it_is_looked_for_far_enough() {
        let twins = look_alikes();
        let best = twins.iter().max_by(|a, b| a.score.total_cmp(&b.score));
        let best = best.unwrap();
        assert!(best.score > 0.95, "{best:?}");
        assert!((best.offset - Vector2::new(0.0, 40.0)).norm() < 0.5);
    }

    #[test]
    fn a_place_may_be_the_twin_only_if_the_landmark_may_be_where_nobody_looked() {
        let twins = look_alikes();
        let window = Window {
            north_edge: 50.0,
            west_edge: -10.0,
            gsd: 1.0,
            width: 100,
            height: 100,
        };
        let all = Gray::filled(81, 81, 0.1);
        let searched = |surface, deviation: f64| LookAlikeSearch {
            surface,
            window: &window,
            size: (20, 20),
            expected: (
                GroundPoint::default(),
                Matrix2::from_diagonal_element(deviation * deviation),
            ),
        };
        // Were this the twin, the landmark would be at 0, 0: seen, and not so good.
        let at = GroundPoint::new(0.0, 40.0);
        assert!(!searched(&all, 30.0).may_be(&twins, &at, 0.9));
        // The place itself is the landmark's; were it the twin, that would be 40 m west of the picture.
        let own = GroundPoint::default();
        assert!(searched(&all, 30.0).may_be(&twins, &own, 0.9));
        // Nobody believes the landmark to be so far off.
        assert!(!searched(&all, 8.0).may_be(&twins, &own, 0.9));
        // Part of the picture is hidden.
        let mut hidden = all.clone();
        hidden.set(0, 40, FORBIDDEN);
        assert!(searched(&hidden, 30.0).may_be(&twins, &at, 0.9));
    }
}
