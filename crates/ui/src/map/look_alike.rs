//! The place that is most easily taken for the selected landmark.

use egui::{Pos2, Rect, Stroke};
use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_jobs::Distinctness;

use super::labels::LandmarkLabel;
use super::symbols::paint_lifted_line;
use super::transform::{ScreenFromWorld, topmost};
use crate::tokens::Tokens;

/// Rank of its label.
const RANK: u8 = 2;

/// Strongest look-alike of a landmark on the map.
#[derive(Clone, Copy, Debug)]
pub struct LookAlikeOnMap {
    /// Box of the landmark.
    landmark: GroundRect,
    /// Middle of the look-alike.
    place: GroundPoint,
    /// Its score.
    score: f64,
}

impl LookAlikeOnMap {
    /// The one that was found, if any.
    pub fn of(found: &Distinctness) -> Option<Self> {
        let (place, score) = found.look_alike?;
        Some(Self {
            landmark: found.bounds,
            place,
            score,
        })
    }

    /// Marks it, joins it to the landmark, and returns what is to be written beside it; `most` is the greatest score at
    /// which the landmark is not refused.
    pub fn paint(
        &self,
        painter: &egui::Painter,
        view: &ScreenFromWorld,
        most: f64,
        tokens: &Tokens,
    ) -> LandmarkLabel {
        let of = &self.landmark;
        let corners = view.corners(&GroundRect::centered(self.place, of.height(), of.width()));
        let ends: [Pos2; 2] = [view.apply(&of.center()), view.apply(&self.place)];
        paint_lifted_line(painter, ends, 1.0, tokens.warning, tokens);
        let mut closed = corners.to_vec();
        closed.push(corners[0]);
        let stroke = Stroke::new(2.0, tokens.warning);
        painter.extend(egui::Shape::dashed_line(&closed, stroke, 5.0, 3.0));
        LandmarkLabel {
            rank: RANK,
            around: Rect::from_points(&corners),
            top: topmost(&corners),
            text: format!(
                "look-alike, score {:.2}, refused from {most:.2}",
                self.score
            ),
            color: tokens.warning,
        }
    }
}
