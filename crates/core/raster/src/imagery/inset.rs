//! Imagery made of two: one inside a rectangle, another around it.

use std::sync::Arc;

use super::{Imagery, Window};
use crate::raster::{Raster, Rgba};
use pilotage_base::frames::GroundRect;

/// Imagery made of two, one inside a rectangle and another around it: for ground that takes long to draw and
/// of which only a part matters.
pub struct InsetImagery {
    inner: Arc<dyn Imagery>,
    rect: GroundRect,
    around: Arc<dyn Imagery>,
}

impl InsetImagery {
    /// `inner` inside `rect`, `around` outside; pixels count as inside that touch it. Bounds and
    /// sampling are those of `inner`.
    pub fn new(inner: Arc<dyn Imagery>, rect: GroundRect, around: Arc<dyn Imagery>) -> Self {
        Self {
            inner,
            rect,
            around,
        }
    }
}

impl Imagery for InsetImagery {
    fn name(&self) -> &str {
        self.inner.name()
    }

    fn bounds(&self) -> GroundRect {
        self.inner.bounds()
    }

    fn native_gsd(&self) -> f64 {
        self.inner.native_gsd()
    }

    fn source(&self) -> Option<&dyn Imagery> {
        Some(&self.inner)
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        let of = |map: &dyn Imagery, window: &Window| (map.window(window), true);
        self.joined(window, &of).0
    }

    fn window_so_far(&self, window: &Window) -> (Raster<Rgba>, bool) {
        let of = |map: &dyn Imagery, window: &Window| map.window_so_far(window);
        self.joined(window, &of)
    }

    fn problems(&self) -> Vec<String> {
        let mut all = self.inner.problems();
        let mut more = self.around.problems();
        more.retain(|problem| !all.contains(problem));
        all.extend(more);
        all
    }
}

/// Pixels of a window of a map, and whether they are whole.
type LookAt<'a> = &'a dyn Fn(&dyn Imagery, &Window) -> (Raster<Rgba>, bool);

impl InsetImagery {
    /// The pixels of a window out of both, as `of` looks at each, and whether they are whole.
    fn joined(&self, window: &Window, of: LookAt<'_>) -> (Raster<Rgba>, bool) {
        let Some((part, (left, top))) = window.touching(&self.rect) else {
            return of(&self.around, window);
        };
        let (part, is_whole) = of(&self.inner, &part);
        if (part.width(), part.height()) == (window.width, window.height) {
            return (part, is_whole);
        }
        let (mut out, is_around_whole) = of(&self.around, window);
        for row in 0..part.height() {
            out.row_mut(top + row)[left..left + part.width()].copy_from_slice(part.row(row));
        }
        (out, is_whole && is_around_whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every pixel tells its own place and whose it is.
    struct Places(u8);

    impl Imagery for Places {
        fn name(&self) -> &'static str {
            "places"
        }
        fn bounds(&self) -> GroundRect {
            GroundRect {
                south: -500.0,
                north: 500.0,
                west: -500.0,
                east: 500.0,
            }
        }
        fn native_gsd(&self) -> f64 {
            0.6
        }
        fn window(&self, window: &Window) -> Raster<Rgba> {
            Raster::from_fn(window.width, window.height, |column, row| {
                let place = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
                let byte = |metres: f64| (metres / 0.3).round().rem_euclid(256.0) as u8;
                [byte(place.north), byte(place.east), self.0, 255]
            })
        }
    }

    #[test]
    fn inside_it_is_the_one_picture_and_outside_the_other() {
        let (whole, around) = (Arc::new(Places(1)), Arc::new(Places(2)));
        let rect = GroundRect {
            north: 40.0,
            south: 10.0,
            west: -22.0,
            east: 5.0,
        };
        let inset = InsetImagery::new(whole.clone(), rect, around.clone());
        let mut seen = [0; 3];
        for (north, west) in [(38.4, -38.4), (50.0, -12.0), (25.0, 4.9), (-50.0, 60.0)] {
            let window = Window {
                north_edge: north,
                west_edge: west,
                gsd: 0.6,
                width: 64,
                height: 48,
            };
            let (one, other) = (whole.window(&window), around.window(&window));
            let shown = inset.window(&window);
            for row in 0..48 {
                for column in 0..64 {
                    let ground = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
                    let beyond = (ground.north - 25.0).abs() - 15.0;
                    let beyond = beyond.max((ground.east + 8.5).abs() - 13.5);
                    let expected = match beyond {
                        within if within < -0.6 => one.get(column, row),
                        outside if outside > 0.6 => other.get(column, row),
                        _ => continue,
                    };
                    assert_eq!(shown.get(column, row), expected, "{ground:?}");
                    seen[usize::from(expected[2])] += 1;
                }
            }
        }
        assert!(seen[1] > 500 && seen[2] > 500, "{seen:?}");
    }
}
