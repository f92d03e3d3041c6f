//! The picture beside the map: looked at, picked in, with the residual of every point as an arrow.

use egui::{
    Align2, Key, Modifiers, Painter, Pos2, Rect, Response, Role, Sense, Shape, Ui, Vec2,
    WidgetInfo, vec2,
};
use nalgebra::Point2;
use pilotage_core::frames::GroundPoint;

use super::Georeferencer;
use super::marks::{nearest, paint_pending, paint_point, stretch};
use crate::map::{ScreenFromWorld, arrow_way, paint_halo_text, paint_middle, tool_keys};
use crate::shell::paint_focus_ring;
use crate::tokens::Tokens;

/// Factor by which a key brings the picture closer.
const CLOSER: f64 = 1.5;

/// A pixel on the bare picture's ground, where a pixel is a metre and the first row lies in the north.
pub fn ground_of_pixel(pixel: &Point2<f64>) -> GroundPoint {
    GroundPoint::new(-pixel.y, pixel.x)
}

/// The pixel at a place of that ground.
pub fn pixel_of_ground(ground: &GroundPoint) -> Point2<f64> {
    Point2::new(ground.east, -ground.north)
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
        if response.has_focus() {
            self.take_keys(ui, rect, &response);
        }
        let view = self.canvas.camera.screen_from_world(rect);
        self.canvas.tiles.paint(&painter, &view, rect, &info);
        // Where it is transparent, its edge would not be seen.
        let corners = info.bounds.corners().map(|corner| view.apply(&corner));
        painter.add(Shape::closed_line(corners.to_vec(), (1.0, tokens.line)));
        self.paint_points(&painter, &view, tokens);
        if response.has_focus() {
            paint_focus_ring(&painter, rect.shrink(1.0), tokens);
            paint_middle(&painter, rect.center(), tokens);
        }
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

    /// Moves and scales the picture, and picks its middle, by the keyboard.
    fn take_keys(&mut self, ui: &Ui, rect: Rect, response: &Response) {
        let way = arrow_way(ui, response);
        if way != Vec2::ZERO {
            self.canvas.camera.pan(rect, -way);
        }
        let closer = ui.input_mut(|input| {
            let mut times = |key| input.count_and_consume_key(Modifiers::NONE, key) as i32;
            times(Key::Plus) + times(Key::Equals) - times(Key::Minus)
        });
        if closer != 0 {
            let middle = rect.center();
            self.canvas.camera.zoom(rect, CLOSER.powi(closer), middle);
        }
        if tool_keys(ui, response, [Key::Enter])[0] {
            let view = self.canvas.camera.screen_from_world(rect);
            self.pick_pixel(pixel_of_ground(&view.inverse(rect.center())));
        }
    }

    fn take_pointer(&mut self, rect: Rect, response: &Response) {
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
        let times = stretch / view.points(1.0);
        if times > 1.0 {
            let text = format!("arrows: errors × {times:.0}");
            let corner = painter.clip_rect().left_bottom() + vec2(16.0, -12.0);
            let (align, font) = (Align2::LEFT_BOTTOM, tokens.small());
            paint_halo_text(painter, corner, align, &text, font, tokens.sigma);
        }
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
