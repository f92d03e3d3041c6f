//! The invitation to draw a landmark.

use egui::{Align2, Rect, pos2, vec2};
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Outcome, Run};
use pilotage_core::sorting::sort;

use super::super::figure::{Figure, FigureNumbers};
use super::super::lesson::TourStop;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use crate::command::Command;
use crate::units::Units;
use crate::views::{parts, picking};

/// The end of the run, and what to do next.
#[derive(Default)]
pub(super) struct YourTurnStop;

impl TourStop for YourTurnStop {
    fn title(&self) -> &'static str {
        "Your turn"
    }

    fn find(&self, run: &Run, _flight: Option<&Flight>, _units: Units) -> Option<TourMoment> {
        let index = run.steps.len().checked_sub(1)?;
        let text = "Now pick something that looks like nothing else around it: drag a box on the map and name it. The flight \
                    is flown again by itself, and the run before it stays on the map as a faint line, so that you see \
                    at once whether your landmark helped."
            .to_owned();
        Some(TourMoment::new(run, index, text))
    }

    fn gather(&self, run: &Run) -> FigureNumbers {
        let mut rows: Vec<(u32, usize, usize)> = Vec::new();
        for candidate in run
            .steps
            .iter()
            .flat_map(|s| s.frame.iter().flat_map(|f| &f.candidates))
        {
            let place = rows.iter().position(|r| r.0 == candidate.landmark);
            let place = place.unwrap_or_else(|| {
                rows.push((candidate.landmark, 0, 0));
                rows.len() - 1
            });
            if candidate.outcome == Outcome::Accepted {
                rows[place].1 += 1;
            } else {
                rows[place].2 += 1;
            }
        }
        sort(&mut rows, &|a, b| b.1.cmp(&a.1));
        rows.truncate(6);
        FigureNumbers {
            looks: rows,
            ..FigureNumbers::default()
        }
    }

    // The numbers of uses and refusals of each landmark.
    fn draw(&self, figure: &Figure<'_>) {
        let Figure {
            painter,
            rect,
            tokens,
            run,
            numbers,
            ..
        } = *figure;
        let rows = &numbers.looks;
        let most = rows.iter().map(|r| r.1 + r.2).max().unwrap_or(1).max(1) as f32;
        let head = 1.5 * tokens.text_sizes[0];
        let height = (rect.height() - 2.0 * tokens.space - head) / rows.len().max(1) as f32;
        let left = rect.left() + 10.5 * tokens.text_sizes[0];
        let width = rect.right() - 6.0 * tokens.text_sizes[0] - left;
        let corner = pos2(
            rect.right() - tokens.space,
            rect.top() + 0.75 * tokens.space,
        );
        let heading = "looks: used (blue) / refused (orange)";
        figure.caption(corner, Align2::RIGHT_TOP, heading, tokens.muted);
        if rows.is_empty() {
            let words = "this run looked for no landmark";
            figure.caption(rect.center(), Align2::CENTER_CENTER, words, tokens.muted);
            return;
        }
        for (i, (id, used, refused)) in rows.iter().enumerate() {
            let y = rect.top() + tokens.space + head + (i as f32 + 0.5) * height;
            let name = picking::landmark_name(run, *id);
            let at = pos2(rect.left() + tokens.space, y);
            let clip = Rect::from_min_max(rect.min, pos2(left - 4.0, rect.bottom()));
            let clipped = painter.with_clip_rect(clip);
            let font = parts::small(tokens);
            clipped.text(at, Align2::LEFT_CENTER, &name, font, tokens.text);
            let used_width = width * *used as f32 / most;
            let bar = Rect::from_min_size(pos2(left, y - 3.0), vec2(used_width, 6.0));
            painter.rect_filled(bar, 2.0, tokens.observed);
            let refused_width = width * *refused as f32 / most;
            let rest = Rect::from_min_size(bar.right_top(), vec2(refused_width, 6.0));
            painter.rect_filled(rest, 2.0, tokens.refused);
            let at = pos2(rect.right() - tokens.space, y);
            let text = format!("{used} / {refused}");
            figure.caption(at, Align2::RIGHT_CENTER, &text, tokens.muted);
        }
    }

    fn trial(&self, _moment: &TourMoment, _settings: &NavigatorSettings) -> TourTrial {
        TourTrial::look("Draw a landmark on the map", vec![Command::TogglePickTool])
    }
}
