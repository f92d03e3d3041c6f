//! Transform between points of the ground and places on the screen.

use egui::{Pos2, Rect, Vec2, pos2, vec2};
use pilotage_core::frames::{GroundPoint, GroundRect};

/// Finest and coarsest map scale, metres per point.
pub const SCALES: [f64; 2] = [0.02, 64.0];
/// Height from which on a map has figures at its top that hide something of it, points.
const HIGH: f32 = 400.0;
/// Room that these take beside the margin, points.
const LOWER: f32 = 44.0;

/// Takes ground points to screen points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScreenFromWorld {
    /// Ground point in the middle of the map.
    pub center: GroundPoint,
    /// Metres per screen point.
    pub metres_per_point: f64,
    /// Direction at the top of the map, radians clockwise from north.
    pub up: f64,
    /// Screen point in the middle of the map.
    pub middle: Pos2,
}

impl ScreenFromWorld {
    /// Screen point of a ground point.
    ///
    /// ```
    /// use pilotage_core::frames::GroundPoint;
    /// use pilotage_ui::map::ScreenFromWorld;
    ///
    /// // Two metres per point, and east at the top: what lies east is above, what lies north is to the left.
    /// let map = ScreenFromWorld {
    ///     center: GroundPoint::new(100.0, 0.0),
    ///     metres_per_point: 2.0,
    ///     up: 90_f64.to_radians(),
    ///     middle: egui::pos2(400.0, 300.0),
    /// };
    /// let place = map.apply(&GroundPoint::new(120.0, 50.0));
    /// assert!(place.distance(egui::pos2(390.0, 275.0)) < 1e-3);
    /// ```
    pub fn apply(&self, p: &GroundPoint) -> Pos2 {
        let (sin, cos) = self.up.sin_cos();
        let (north, east) = (p.north - self.center.north, p.east - self.center.east);
        let right = (east * cos - north * sin) / self.metres_per_point;
        let ahead = (north * cos + east * sin) / self.metres_per_point;
        self.middle + vec2(right as f32, -ahead as f32)
    }

    /// Ground point of a screen point.
    pub fn inverse(&self, p: Pos2) -> GroundPoint {
        let offset = self.world_from_vector(p - self.middle);
        GroundPoint::new(
            self.center.north + offset.north,
            self.center.east + offset.east,
        )
    }

    /// Ground offset, metres, of a screen offset.
    pub fn world_from_vector(&self, v: Vec2) -> GroundPoint {
        let (sin, cos) = self.up.sin_cos();
        let (right, ahead) = (
            f64::from(v.x) * self.metres_per_point,
            f64::from(-v.y) * self.metres_per_point,
        );
        GroundPoint::new(ahead * cos - right * sin, ahead * sin + right * cos)
    }

    /// Points on the screen that a length on the ground takes.
    pub fn points(&self, metres: f64) -> f32 {
        (metres / self.metres_per_point) as f32
    }

    /// Screen points of a rectangle's corners, beginning in the north-west, clockwise.
    pub fn corners(&self, rect: &GroundRect) -> [Pos2; 4] {
        [
            (rect.north, rect.west),
            (rect.north, rect.east),
            (rect.south, rect.east),
            (rect.south, rect.west),
        ]
        .map(|(north, east)| self.apply(&GroundPoint::new(north, east)))
    }

    /// The smallest north-aligned rectangle that holds everything in `screen`.
    pub fn visible(&self, screen: Rect) -> GroundRect {
        let corners = [
            screen.left_top(),
            screen.right_top(),
            screen.right_bottom(),
            screen.left_bottom(),
        ]
        .map(|p| self.inverse(p));
        GroundRect::around(corners).unwrap_or(GroundRect::centered(self.center, 0.0, 0.0))
    }
}

/// View of the map: middle, scale and direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapCamera {
    /// Ground point in the middle.
    pub center: GroundPoint,
    /// Metres per screen point.
    pub metres_per_point: f64,
    /// Direction at the top, radians clockwise from north.
    pub up: f64,
}

impl Default for MapCamera {
    fn default() -> Self {
        Self {
            center: GroundPoint::new(0.0, 0.0),
            metres_per_point: 1.5,
            up: 0.0,
        }
    }
}

impl MapCamera {
    /// The transform for a map drawn in `rect`.
    pub fn screen_from_world(&self, rect: Rect) -> ScreenFromWorld {
        ScreenFromWorld {
            center: self.center,
            metres_per_point: self.metres_per_point,
            up: self.up,
            middle: rect.center(),
        }
    }

    /// Moves the map with the pointer.
    pub fn pan(&mut self, rect: Rect, delta: Vec2) {
        let moved = self.screen_from_world(rect).world_from_vector(delta);
        self.center.north -= moved.north;
        self.center.east -= moved.east;
    }

    /// Zooms by `factor` (over 1 is closer) and keeps the ground under `about` where it is.
    pub fn zoom(&mut self, rect: Rect, factor: f64, about: Pos2) {
        let before = self.screen_from_world(rect).inverse(about);
        self.metres_per_point = (self.metres_per_point / factor).clamp(SCALES[0], SCALES[1]);
        self.keep(rect, before, about);
    }

    /// Turns the map by `angle` radians clockwise and keeps the ground under `about`.
    pub fn turn(&mut self, rect: Rect, angle: f64, about: Pos2) {
        let before = self.screen_from_world(rect).inverse(about);
        self.up = pilotage_core::frames::wrap_pi(self.up - angle);
        self.keep(rect, before, about);
    }

    fn keep(&mut self, rect: Rect, ground: GroundPoint, at: Pos2) {
        let after = self.screen_from_world(rect).inverse(at);
        self.center.north += ground.north - after.north;
        self.center.east += ground.east - after.east;
    }

    /// Shows all of `ground` in `rect` with a margin, in a high one below what is told at its top.
    pub fn fit(&mut self, rect: Rect, ground: &GroundRect) {
        let lower = if rect.height() > HIGH { LOWER } else { 0.0 };
        let (sin, cos) = (self.up.sin().abs(), self.up.cos().abs());
        let right = ground.width() * cos + ground.height() * sin;
        let ahead = ground.height() * cos + ground.width() * sin;
        let room = (rect.size() - vec2(96.0, 112.0 + lower)).max(vec2(50.0, 50.0));
        self.metres_per_point = (right / f64::from(room.x))
            .max(ahead / f64::from(room.y))
            .clamp(SCALES[0], SCALES[1]);
        let above = 0.5 * f64::from(lower) * self.metres_per_point;
        let middle = ground.center();
        self.center = GroundPoint::new(
            middle.north + above * self.up.cos(),
            middle.east + above * self.up.sin(),
        );
    }
}

/// The point of a polygon's outline that lies highest on the screen.
pub fn topmost(points: &[Pos2]) -> Pos2 {
    points
        .iter()
        .copied()
        .reduce(|a, b| if b.y < a.y { b } else { a })
        .unwrap_or(pos2(0.0, 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::Rect;

    fn rect() -> Rect {
        Rect::from_min_size(pos2(0.0, 0.0), vec2(800.0, 600.0))
    }

    fn near(a: GroundPoint, b: GroundPoint) -> bool {
        a.distance(&b) < 1e-3
    }

    #[test]
    fn north_is_up_and_east_is_right() {
        let view = MapCamera::default().screen_from_world(rect());
        let up = view.apply(&GroundPoint::new(100.0, 0.0));
        let right = view.apply(&GroundPoint::new(0.0, 100.0));
        assert!(up.y < 300.0 && (up.x - 400.0).abs() < 1e-3);
        assert!(right.x > 400.0 && (right.y - 300.0).abs() < 1e-3);
    }

    #[test]
    fn what_lies_ahead_is_up_when_the_map_is_turned() {
        let camera = MapCamera {
            up: 1.0,
            ..MapCamera::default()
        };
        let ahead = GroundPoint::new(100.0 * 1.0_f64.cos(), 100.0 * 1.0_f64.sin());
        let p = camera.screen_from_world(rect()).apply(&ahead);
        assert!((p.x - 400.0).abs() < 1e-3 && p.y < 300.0);
    }

    #[test]
    fn screen_and_ground_are_inverse() {
        let camera = MapCamera {
            up: 0.7,
            metres_per_point: 0.4,
            ..MapCamera::default()
        };
        let view = camera.screen_from_world(rect());
        let p = GroundPoint::new(33.0, -21.0);
        assert!(near(view.inverse(view.apply(&p)), p));
    }

    #[test]
    fn zoom_and_turn_keep_the_ground_under_the_pointer() {
        let mut camera = MapCamera::default();
        let pointer = pos2(123.0, 456.0);
        let before = camera.screen_from_world(rect()).inverse(pointer);
        camera.zoom(rect(), 3.0, pointer);
        camera.turn(rect(), 0.5, pointer);
        assert!(near(
            camera.screen_from_world(rect()).inverse(pointer),
            before
        ));
    }

    #[test]
    fn fit_shows_all_of_it() {
        let mut camera = MapCamera {
            up: 0.4,
            ..MapCamera::default()
        };
        let ground = GroundRect::centered(GroundPoint::new(500.0, -200.0), 900.0, 300.0);
        camera.fit(rect(), &ground);
        for corner in camera.screen_from_world(rect()).corners(&ground) {
            assert!(rect().contains(corner) && corner.y > crate::shell::BELOW_HUD);
        }
        // The figures at the top hide nothing of a high one, either.
        let high = GroundRect::centered(GroundPoint::new(500.0, -200.0), 300.0, 900.0);
        camera.up = 0.0;
        camera.fit(rect(), &high);
        for corner in camera.screen_from_world(rect()).corners(&high) {
            assert!(rect().contains(corner) && corner.y > crate::shell::BELOW_HUD);
        }
    }
}
