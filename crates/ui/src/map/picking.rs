//! Drawing, moving and resizing landmarks with the pointer.

use egui::{Pos2, Rect};
use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::landmark::Landmark;

use super::landmarks::{handles, has_handles};
use super::transform::ScreenFromWorld;

/// Distance from a handle or a small box that still counts as on it, points.
pub const HIT_RADIUS: f32 = 12.0;
/// Smallest side of a landmark's box, metres.
pub const SMALLEST: f64 = 3.0;

/// Drag of the pointer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Drag {
    /// Nothing.
    #[default]
    None,
    /// Moving the map.
    Pan,
    /// Drawing a box from this corner.
    Draw(GroundPoint),
    /// Moving a landmark.
    Move {
        /// Landmark id.
        id: u32,
        /// Its box when the drag began.
        bounds: GroundRect,
        /// Place at which the landmark was taken.
        grip: GroundPoint,
    },
    /// Resizing a landmark.
    Resize {
        /// Landmark id.
        id: u32,
        /// Its box when the drag began.
        bounds: GroundRect,
        /// Index of the handle, from the north-west clockwise.
        handle: usize,
    },
}

/// The landmark at a screen point: the smallest box that holds it, or the nearest within the
/// forgiving radius.
pub fn landmark_at(landmarks: &[Landmark], view: &ScreenFromWorld, at: Pos2) -> Option<u32> {
    let ground = view.inverse(at);
    let area = |l: &&Landmark| l.bounds.width() * l.bounds.height();
    let inside = landmarks
        .iter()
        .filter(|l| l.bounds.contains(&ground))
        .min_by(|a, b| area(a).total_cmp(&area(b)));
    inside
        .or_else(|| {
            let margin = f64::from(HIT_RADIUS) * view.metres_per_point;
            landmarks
                .iter()
                .filter(|l| l.bounds.grown(margin).contains(&ground))
                .min_by(|a, b| {
                    let away = |l: &Landmark| l.bounds.center().distance(&ground);
                    away(a).total_cmp(&away(b))
                })
        })
        .map(|l| l.id)
}

/// The handle of the selected landmark at a screen point.
pub fn handle_at(landmark: &Landmark, view: &ScreenFromWorld, at: Pos2) -> Option<usize> {
    let corners = view.corners(&landmark.bounds);
    // A box too small for handles is only moved.
    if !has_handles(&corners) {
        return None;
    }
    let side = Rect::from_points(&corners).size().min_elem();
    // Small boxes keep a middle to take them by.
    let reach = HIT_RADIUS.min(0.3 * side);
    handles(&corners)
        .iter()
        .enumerate()
        .map(|(index, p)| (index, p.distance(at)))
        .filter(|(_, distance)| *distance <= reach)
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(index, _)| index)
}

/// The box between two corners.
pub fn box_between(a: GroundPoint, b: GroundPoint) -> GroundRect {
    GroundRect {
        south: a.north.min(b.north),
        north: a.north.max(b.north),
        west: a.east.min(b.east),
        east: a.east.max(b.east),
    }
}

/// `bounds` moved by what lies between `grip` and `to`.
pub fn moved(bounds: &GroundRect, grip: GroundPoint, to: GroundPoint) -> GroundRect {
    let (north, east) = (to.north - grip.north, to.east - grip.east);
    GroundRect {
        south: bounds.south + north,
        north: bounds.north + north,
        west: bounds.west + east,
        east: bounds.east + east,
    }
}

/// `bounds` with one handle taken to a ground point; never smaller than [`SMALLEST`].
pub fn resized(bounds: &GroundRect, handle: usize, to: GroundPoint) -> GroundRect {
    let mut rect = *bounds;
    if matches!(handle, 0..=2) {
        rect.north = to.north.max(rect.south + SMALLEST);
    }
    if matches!(handle, 4..=6) {
        rect.south = to.north.min(rect.north - SMALLEST);
    }
    if matches!(handle, 2..=4) {
        rect.east = to.east.max(rect.west + SMALLEST);
    }
    if matches!(handle, 0 | 6 | 7) {
        rect.west = to.east.min(rect.east - SMALLEST);
    }
    rect
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::transform::MapCamera;

    fn view() -> ScreenFromWorld {
        let rect = Rect::from_min_size(Pos2::ZERO, egui::vec2(800.0, 600.0));
        MapCamera::default().screen_from_world(rect)
    }

    fn landmark() -> Landmark {
        let bounds = GroundRect::centered(GroundPoint::new(0.0, 0.0), 60.0, 90.0);
        Landmark::new(7, "Barn", bounds)
    }

    #[test]
    fn a_click_beside_a_box_still_finds_it() {
        let edge = view().apply(&GroundPoint::new(0.0, 45.0));
        let landmarks = [landmark()];
        assert_eq!(
            landmark_at(&landmarks, &view(), edge + egui::vec2(8.0, 0.0)),
            Some(7)
        );
        assert_eq!(
            landmark_at(&landmarks, &view(), edge + egui::vec2(30.0, 0.0)),
            None
        );
    }

    #[test]
    fn the_inner_of_two_boxes_is_found() {
        let inner = GroundRect::centered(GroundPoint::new(0.0, 0.0), 10.0, 10.0);
        let landmarks = [landmark(), Landmark::new(8, "Door", inner)];
        let middle = view().apply(&GroundPoint::new(0.0, 0.0));
        assert_eq!(landmark_at(&landmarks, &view(), middle), Some(8));
    }

    #[test]
    fn a_box_that_handles_would_hide_has_none() {
        let corner = GroundPoint::new(-30.0, 45.0);
        let far = |metres_per_point| ScreenFromWorld {
            metres_per_point,
            ..view()
        };
        let of = |view: &ScreenFromWorld| handle_at(&landmark(), view, view.apply(&corner));
        // 60 m are its shorter side.
        assert_eq!(of(&far(60.0 / 29.0)), Some(4));
        assert_eq!(of(&far(60.0 / 27.0)), None);
    }

    #[test]
    fn the_south_east_handle_moves_two_edges() {
        let handle = handle_at(
            &landmark(),
            &view(),
            view().apply(&GroundPoint::new(-30.0, 45.0)),
        );
        assert_eq!(handle, Some(4));
        let rect = resized(&landmark().bounds, 4, GroundPoint::new(-50.0, 70.0));
        assert_eq!(
            (rect.south, rect.east, rect.north, rect.west),
            (-50.0, 70.0, 30.0, -45.0)
        );
    }

    #[test]
    fn a_box_cannot_be_turned_inside_out() {
        let rect = resized(&landmark().bounds, 4, GroundPoint::new(500.0, -500.0));
        assert!(rect.height() >= SMALLEST && rect.width() >= SMALLEST);
    }
}
