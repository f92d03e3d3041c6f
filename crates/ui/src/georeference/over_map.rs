//! The georeferencer's points on the map.

use egui::{Align2, Key, Pos2, Response, Ui, vec2};
use nalgebra::Point2;

use super::Georeferencer;
use super::marks::{nearest, paint_pending, paint_point, stretch};
use crate::context::ViewContext;
use crate::map::{MapCanvas, MapStage, MapTool, ScreenFromWorld, paint_halo_text, tool_keys};

impl Georeferencer {
    fn screen(&self, view: &ScreenFromWorld, place: &Point2<f64>) -> Option<Pos2> {
        Some(view.apply(&self.ground_of(place)?))
    }
}

impl MapTool for Georeferencer {
    fn interact(
        &mut self,
        ui: &Ui,
        view: &ScreenFromWorld,
        response: &Response,
        _context: &mut ViewContext<'_>,
    ) -> bool {
        if response.has_focus() && tool_keys(ui, response, [Key::Enter])[0] {
            // By keyboard: the middle of the map.
            self.pick_ground(&view.inverse(response.rect.center()));
        }
        let off_screen = Pos2::new(f32::MAX, f32::MAX);
        let places = self.points.iter();
        let places = places.map(|p| self.screen(view, &p.place).unwrap_or(off_screen));
        let places: Vec<Pos2> = places.collect();
        let hit = response
            .interact_pointer_pos()
            .and_then(|at| nearest(&places, at));
        if response.drag_started() && hit.is_some() {
            self.remember();
            self.chosen = hit;
            self.on_map = hit;
        }
        if let Some(index) = self.on_map {
            if let Some(at) = response
                .interact_pointer_pos()
                .filter(|_| response.dragged())
            {
                let place = self.place_of(&view.inverse(at));
                self.drag(index, None, place);
            }
            if !response.dragged() {
                self.on_map = None;
            }
            return true;
        }
        if response.clicked() {
            if hit.is_some() {
                self.chosen = hit;
            } else if let Some(at) = response.interact_pointer_pos() {
                self.pick_ground(&view.inverse(at));
            }
            return true;
        }
        false
    }

    fn takes_middle(&self, has_keyboard: bool) -> bool {
        has_keyboard
    }

    fn paint(&self, stage: MapStage, canvas: &MapCanvas<'_>) {
        if stage != MapStage::Last {
            return;
        }
        let (painter, view, tokens) = (canvas.painter, canvas.view, canvas.tokens);
        let residuals = self.fitted().as_ref().map(|fit| fit.residuals.as_slice());
        let residuals = residuals.unwrap_or_default();
        let (sin, cos) = view.up.sin_cos();
        let arrows = residuals.iter().map(|r| {
            let (east, north) = (r.in_plane.x, r.in_plane.y);
            let (right, ahead) = (east * cos - north * sin, north * cos + east * sin);
            if right.is_finite() && ahead.is_finite() {
                vec2(right as f32, -ahead as f32)
            } else {
                egui::Vec2::ZERO
            }
        });
        let arrows: Vec<_> = arrows.collect();
        let stretch = stretch(&arrows, view.points(1.0));
        for (index, point) in self.points.iter().enumerate() {
            let Some(at) = self.screen(view, &point.place) else {
                continue;
            };
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
        if let Some(at) = self
            .pending
            .place
            .and_then(|place| self.screen(view, &place))
        {
            paint_pending(painter, at, tokens);
        }
        let corner = painter.clip_rect().left_top() + vec2(16.0, 12.0);
        let text = match self.far_from_map() {
            Some(distance) => format!(
                "This map lies {:.0} km from the picture: type coordinates",
                1e-3 * distance
            ),
            None => "Map: click the same places here, or type their coordinates".to_owned(),
        };
        paint_halo_text(
            painter,
            corner,
            Align2::LEFT_TOP,
            &text,
            tokens.normal(),
            tokens.sigma,
        );
    }
}
