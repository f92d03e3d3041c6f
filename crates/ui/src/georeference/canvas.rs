//! The picture beside the map: looked at, picked in, with the residual of every point as an arrow.

use egui::{Align2, Painter, Pos2, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};
use nalgebra::Point2;
use pilotage_core::frames::GroundPoint;

use super::Georeferencer;
use crate::jobs::MapInfo;
use crate::map::{MapCamera, ScreenFromWorld, TileCache, paint_halo_text};
use crate::tokens::Tokens;

/// How near a point has to be to be taken, points.
const REACH: f32 = 12.0;
/// Length on screen that the largest residual is drawn with at most, points.
const LONGEST_ARROW: f32 = 60.0;

/// How the picture is looked at.
#[derive(Default)]
pub struct PictureCanvas {
    /// Where and how near.
    pub camera: MapCamera,
    /// Its pixels.
    pub tiles: TileCache,
    info: Option<MapInfo>,
    rect: Option<Rect>,
    fitted: bool,
    dragged: Option<usize>,
}

/// A pixel on the bare picture's ground, where a pixel is a metre and the first row lies in the north.
pub fn ground_of_pixel(pixel: &Point2<f64>) -> GroundPoint {
    GroundPoint::new(-pixel.y, pixel.x)
}

/// The pixel at a place of that ground.
pub fn pixel_of_ground(ground: &GroundPoint) -> Point2<f64> {
    Point2::new(ground.east, -ground.north)
}

impl PictureCanvas {
    /// Takes what is known of the picture.
    pub fn know(&mut self, info: MapInfo) {
        self.info = Some(info);
    }

    /// Where it was drawn last.
    pub fn rect(&self) -> Option<Rect> {
        self.rect
    }
}

impl Georeferencer {
    /// Draws the picture in the space that is left, and takes the pointer.
    pub fn show_picture(&mut self, ui: &mut Ui, tokens: &Tokens) {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        let label = format!("Picture {}", self.name);
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, &label));
        let painter = ui.painter_at(rect);
        painter.rect_filled(rect, 0.0, tokens.background);
        self.canvas.rect = Some(rect);
        let Some(info) = self.canvas.info.clone() else {
            let middle = Align2::CENTER_CENTER;
            painter.text(
                rect.center(),
                middle,
                "Reading the picture …",
                tokens.normal(),
                tokens.muted,
            );
            return;
        };
        if !self.canvas.fitted {
            self.canvas.fitted = true;
            self.canvas.camera.fit(rect, &info.bounds);
        }
        let (scroll, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
        let factor = f64::from(pinch) * (f64::from(scroll) * 0.004).exp();
        if let Some(at) = response.hover_pos().filter(|_| (factor - 1.0).abs() > 1e-6) {
            self.canvas.camera.zoom(rect, factor, at);
        }
        self.take_pointer(rect, &response);
        let view = self.canvas.camera.screen_from_world(rect);
        self.canvas.tiles.paint(&painter, &view, rect, &info);
        self.paint_points(&painter, &view, tokens);
        if let Some(at) = response.hover_pos() {
            let pixel = pixel_of_ground(&view.inverse(at));
            let text = format!("column {:.1}   row {:.1}", pixel.x, pixel.y);
            let corner = rect.right_bottom() - vec2(16.0, 12.0);
            paint_halo_text(
                &painter,
                corner,
                Align2::RIGHT_BOTTOM,
                &text,
                tokens.small(),
                tokens.sigma,
            );
        }
        let heading = format!(
            "Picture: {}",
            self.name.rsplit('/').next().unwrap_or_default()
        );
        let corner = rect.left_top() + vec2(16.0, 12.0);
        paint_halo_text(
            &painter,
            corner,
            Align2::LEFT_TOP,
            &heading,
            tokens.normal(),
            tokens.sigma,
        );
    }

    fn take_pointer(&mut self, rect: Rect, response: &egui::Response) {
        let view = self.canvas.camera.screen_from_world(rect);
        let places = self
            .points
            .iter()
            .map(|p| view.apply(&ground_of_pixel(&p.pixel)));
        let places: Vec<Pos2> = places.collect();
        let hit = |at: Pos2| nearest(&places, at);
        if response.drag_started() {
            let grasped = response.interact_pointer_pos().and_then(hit);
            if grasped.is_some() {
                self.remember();
            }
            self.canvas.dragged = grasped;
            self.chosen = grasped.or(self.chosen);
        }
        if response.dragged() {
            match (self.canvas.dragged, response.interact_pointer_pos()) {
                (Some(index), Some(at)) => {
                    let pixel = pixel_of_ground(&view.inverse(at));
                    self.drag(index, Some(pixel), None);
                }
                _ => self.canvas.camera.pan(rect, response.drag_delta()),
            }
        }
        if response.drag_stopped() {
            self.canvas.dragged = None;
        }
        if response.clicked()
            && let Some(at) = response.interact_pointer_pos()
        {
            match hit(at) {
                Some(index) => self.chosen = Some(index),
                None => self.pick_pixel(pixel_of_ground(&view.inverse(at))),
            }
        }
    }

    fn paint_points(&self, painter: &Painter, view: &ScreenFromWorld, tokens: &Tokens) {
        let residuals = self.fitted().as_ref().map(|fit| fit.residuals.as_slice());
        let residuals = residuals.unwrap_or_default();
        let arrows = residuals.iter().map(|r| r.in_pixels.unwrap_or_default());
        let arrows: Vec<_> = arrows.map(|r| vec2(r.x as f32, r.y as f32)).collect();
        let stretch = stretch(&arrows, view.points(1.0));
        for (index, point) in self.points.iter().enumerate() {
            let at = view.apply(&ground_of_pixel(&point.pixel));
            let arrow = arrows.get(index).map(|r| *r * stretch);
            paint_point(
                painter,
                at,
                index,
                point.enabled,
                self.chosen == Some(index),
                arrow,
                tokens,
            );
        }
        if let Some(pixel) = self.pending.pixel {
            paint_pending(painter, view.apply(&ground_of_pixel(&pixel)), tokens);
        }
    }
}

/// The nearest of `places` within reach of `at`.
pub fn nearest(places: &[Pos2], at: Pos2) -> Option<usize> {
    let near = |(_, p): &(usize, &Pos2)| p.distance(at) <= REACH;
    let all = places.iter().enumerate().filter(near);
    all.min_by(|a, b| a.1.distance(at).total_cmp(&b.1.distance(at)))
        .map(|(index, _)| index)
}

/// Screen points per unit at which the largest arrow is well seen, but never drawn smaller than it is.
pub fn stretch(arrows: &[egui::Vec2], points_per_unit: f32) -> f32 {
    let largest = arrows.iter().map(|a| a.length()).fold(0.0, f32::max);
    if largest <= 0.0 {
        return 0.0;
    }
    (LONGEST_ARROW / largest).max(points_per_unit)
}

/// Draws a control point with its number and its residual.
pub fn paint_point(
    painter: &Painter,
    at: Pos2,
    index: usize,
    enabled: bool,
    chosen: bool,
    arrow: Option<egui::Vec2>,
    tokens: &Tokens,
) {
    let color = match (enabled, chosen) {
        (_, true) => tokens.accent,
        (true, false) => tokens.observed,
        (false, false) => tokens.muted,
    };
    if let Some(arrow) = arrow.filter(|a| a.length() > 1.0) {
        painter.arrow(at, arrow, Stroke::new(3.5, tokens.outline()));
        painter.arrow(at, arrow, Stroke::new(2.0, tokens.corrected));
    }
    let radius = if chosen { 7.0 } else { 5.0 };
    painter.circle_stroke(at, radius, Stroke::new(4.0, tokens.outline()));
    painter.circle_stroke(at, radius, Stroke::new(2.0, color));
    painter.circle_filled(at, 1.5, color);
    if !enabled {
        let arm = vec2(radius, radius);
        painter.line_segment([at - arm, at + arm], Stroke::new(1.5, color));
    }
    let label = pos2(at.x + radius + 3.0, at.y - radius);
    let text = (index + 1).to_string();
    paint_halo_text(
        painter,
        label,
        Align2::LEFT_BOTTOM,
        &text,
        tokens.normal(),
        color,
    );
}

/// Draws a point that is known on this side only.
pub fn paint_pending(painter: &Painter, at: Pos2, tokens: &Tokens) {
    for (from, to) in [
        (vec2(-10.0, 0.0), vec2(10.0, 0.0)),
        (vec2(0.0, -10.0), vec2(0.0, 10.0)),
    ] {
        painter.line_segment([at + from, at + to], Stroke::new(4.0, tokens.outline()));
        painter.line_segment([at + from, at + to], Stroke::new(2.0, tokens.accent));
    }
}
