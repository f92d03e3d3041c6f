//! The camera picture of the last frame at or before the cursor, with what the navigator saw in it.

mod attitude;
mod overlay;
mod picture;
mod placement;
mod sightings;

use egui::{Rect, Sense, Ui, Vec2, pos2, vec2};
use pilotage_core::flight::Frame;
use pilotage_core::navigator::{FrameReport, Run, SightingReport, StepReport};

use super::sights::LastStep;
use super::{parts, picking, sighted};
use crate::command::Command;
use crate::context::{DrawnTimes, ViewContext};
use crate::tokens::Tokens;
use picture::PictureCache;
use placement::CameraPlacement;

/// Furthest that the wheel goes in.
const MOST_ZOOM: f32 = 12.0;
/// Largest distance from a mark at which a click still selects it, points.
const REACH: f32 = 18.0;

/// Shows the camera picture and explains what was looked for and found in it.
pub struct CameraView {
    cache: PictureCache,
    zoom: f32,
    /// Shift of the picture's centre from the middle of the view, in points at zoom 1.
    shift: Vec2,
    drawn: Option<DrawnTimes>,
    reports: LastStep,
}

impl Default for CameraView {
    fn default() -> Self {
        Self {
            cache: PictureCache::default(),
            zoom: 1.0,
            shift: Vec2::ZERO,
            drawn: None,
            reports: LastStep::default(),
        }
    }
}

impl CameraView {
    /// Times that were drawn last.
    pub fn drawn(&self) -> Option<DrawnTimes> {
        self.drawn
    }

    /// Takes the pixels of the picture `key` for a frame that is shown now or soon: red, green, blue and opacity of
    /// each.
    pub fn prepare(&mut self, frame: usize, key: usize, width: usize, pixels: &[u8]) {
        self.cache.prepare(frame, key, width, pixels);
    }

    /// Takes why the picture `key` cannot be shown.
    pub fn refuse(&mut self, key: usize, why: &str) {
        self.cache.refuse(key, why);
    }

    /// Takes note that the picture `key` is another one by now.
    pub fn forget(&mut self, key: usize) {
        self.cache.forget(key);
    }

    /// Whether the pixels of the picture `key` are here already.
    pub fn is_prepared(&self, key: usize) -> bool {
        self.cache.is_prepared(key)
    }

    /// Frame that is to be shown, and the picture that is lacking for it.
    pub fn wanted(&self) -> Option<(usize, usize)> {
        self.cache.wanted()
    }

    /// Shows nothing until there is something of another flight.
    pub fn clear(&mut self) {
        self.cache.leave_flight();
    }

    /// The texture of the picture of frame `index`, or of the one before it until that is decoded, and
    /// the frame that it is of; for views that draw the picture themselves.
    pub fn picture_at(
        &mut self,
        egui: &egui::Context,
        context: &ViewContext<'_>,
        index: usize,
    ) -> Option<(egui::TextureId, usize)> {
        let shown = self.cache.update(egui, index, (context.pictures)(index))?;
        Some((self.cache.texture()?, shown))
    }

    /// Error of the picture at the cursor, in words.
    pub fn trouble(&self) -> Option<&str> {
        self.cache.trouble()
    }

    /// The report on picture `index`, if it is the last one of the run at or before `time`, with the run and its step.
    fn report<'a>(
        &mut self,
        run: &'a Run,
        index: usize,
        time: f64,
    ) -> Option<(&'a Run, &'a StepReport, &'a FrameReport)> {
        let is_picture = |step: &StepReport| step.frame.is_some();
        let step = &run.steps[self.reports.at(run, run.index_at(time)?, is_picture)?];
        let report = step.frame.as_ref().filter(|it| it.index == index)?;
        Some((run, step, report))
    }

    /// Draws the view into the space that `ui` has left.
    pub fn show(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        let Some(flight) = context.flight else {
            let (title, hint) = match context.flying {
                Some(words) => ("Computing the flight …", words),
                None => ("No flight yet", "Open a flight or simulate one."),
            };
            return parts::empty(ui, tokens, title, hint);
        };
        if flight.frames.is_empty() {
            let hint = "This flight was recorded without a camera.";
            return parts::empty(ui, tokens, "No pictures", hint);
        }
        let Some(index) = context.shown_frame() else {
            parts::empty(
                ui,
                tokens,
                "No picture yet",
                "The camera takes its first picture a little later.",
            );
            return;
        };
        // While a picture is decoded the one before it stays, with what was seen in that.
        let current = index;
        let shown = self
            .cache
            .update(ui.ctx(), index, (context.pictures)(index));
        let index = shown.filter(|i| *i < flight.frames.len()).unwrap_or(index);
        let time = if index == current {
            context.time
        } else {
            flight.frames[index].time
        };
        let report = context.run.and_then(|run| self.report(run, index, time));
        let seen = report.map_or(&[][..], |(_, step, _)| &step.sightings);
        let report = report.map(|(run, _, report)| (run, report));

        let outer = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(outer, Sense::click_and_drag());
        parts::name(
            &response,
            describe(report, seen, flight.frames[index].name.as_str()),
        );
        let size = vec2(flight.camera.width as f32, flight.camera.height as f32);
        self.navigate(ui, &response, outer, size);
        let placement = self.placement(outer, size);
        let painter = ui.painter_at(outer);
        painter.rect_filled(outer, 0.0, tokens.background);
        if let Some(texture) = self.cache.texture() {
            let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(texture, placement.rect, uv, egui::Color32::WHITE);
            if index == current {
                self.drawn = context.drawn(flight.frames[index].time);
            }
        } else {
            painter.rect_filled(placement.rect, 0.0, tokens.raised);
            // Below the marks, most of which are around the middle.
            painter.text(
                placement.rect.center_bottom() - vec2(0.0, 2.0 * tokens.space),
                egui::Align2::CENTER_BOTTOM,
                self.cache
                    .trouble()
                    .unwrap_or(lacking(&flight.frames[index])),
                parts::normal(tokens),
                tokens.muted,
            );
        }
        let corner = vec2(28.0 * tokens.space, 6.0 * tokens.space);
        let mut taken = vec![Rect::from_min_max(
            pos2(outer.right() - corner.x, outer.top()),
            pos2(outer.right(), outer.top() + corner.y),
        )];
        if let Some((run, report)) = report {
            let pointer = response.hover_pos();
            let near = nearest(report, &placement, pointer);
            let theme = std::mem::replace(&mut context.tokens, Tokens::over_imagery());
            sightings::draw(&painter, context, seen, &placement);
            overlay::draw(&painter, context, run, report, &placement, near, &mut taken);
            context.tokens = theme;
            if response.clicked() {
                context.commands.push(Command::SelectLandmark(near));
            }
            if let Some(candidate) = report.candidates.iter().find(|c| Some(c.landmark) == near) {
                let text = overlay::explain(run, candidate);
                response.on_hover_text_at_pointer(text);
            } else if let Some(text) =
                pointer.and_then(|at| sightings::explain(seen, &placement, at, context))
            {
                response.on_hover_text_at_pointer(text);
            }
            attitude::draw(
                &painter,
                Tokens::over_imagery(),
                outer,
                &flight.camera,
                report,
            );
        }
    }

    /// Wheel and pinch zoom at the pointer, a drag moves, a double click shows all again.
    fn navigate(&mut self, ui: &Ui, response: &egui::Response, outer: Rect, size: Vec2) {
        if response.double_clicked() {
            self.zoom = 1.0;
            self.shift = Vec2::ZERO;
        }
        if let Some(pointer) = response.hover_pos() {
            let factor = ui.input(|i| i.zoom_delta() * (i.smooth_scroll_delta().y / 240.0).exp());
            if factor != 1.0 {
                let zoom = (self.zoom * factor).clamp(1.0, MOST_ZOOM);
                let from_middle = pointer - outer.center();
                self.shift += from_middle * (1.0 / zoom - 1.0 / self.zoom);
                self.zoom = zoom;
            }
        }
        if response.dragged() {
            self.shift += response.drag_delta() / self.zoom;
        }
        let fitted = parts::fitted(outer, size).size();
        let most = (fitted - outer.size() / self.zoom).max(Vec2::ZERO) * 0.5;
        self.shift = self.shift.clamp(-most, most);
    }

    fn placement(&self, outer: Rect, size: Vec2) -> CameraPlacement {
        let fitted = parts::fitted(outer, size);
        let rect = Rect::from_center_size(
            outer.center() + self.shift * self.zoom,
            fitted.size() * self.zoom,
        );
        CameraPlacement {
            rect,
            scale: rect.width() / size.x.max(1.0),
        }
    }
}

/// The landmark whose predicted or found place is nearest to the pointer and within reach.
fn nearest(
    report: &FrameReport,
    placement: &CameraPlacement,
    pointer: Option<egui::Pos2>,
) -> Option<u32> {
    let pointer = pointer?;
    report
        .candidates
        .iter()
        .flat_map(|c| {
            [Some(c.predicted_pixel), c.measured_pixel]
                .into_iter()
                .flatten()
                .map(|pixel| (placement.at(&pixel).distance(pointer), c.landmark))
        })
        .filter(|(distance, _)| *distance <= REACH)
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, landmark)| landmark)
}

/// Words in the place of a picture that is not there, or not yet.
fn lacking(frame: &Frame) -> &'static str {
    if frame.name.is_empty() {
        "No picture: flights of studies are flown without a camera."
    } else {
        "The picture is on its way."
    }
}

/// Description of the picture in a line, for those who do not see it.
fn describe(
    report: Option<(&Run, &FrameReport)>,
    sightings: &[SightingReport],
    name: &str,
) -> String {
    let Some((run, report)) = report else {
        return format!("Camera picture {name}");
    };
    let accepted: Vec<String> = report
        .accepted()
        .map(|c| picking::landmark_name(run, c.landmark))
        .collect();
    let refused = report.candidates.len() - accepted.len();
    let is_whole = report.joint.is_some() && accepted.is_empty();
    let whole = is_whole.then(|| "used as a whole".to_owned());
    let seen = sightings.iter().map(sighted::summary);
    let told: Vec<String> = whole.into_iter().chain(seen).collect();
    if !told.is_empty() && report.candidates.is_empty() {
        return format!("Camera picture {name}: {}", told.join("; "));
    }
    if accepted.is_empty() {
        format!("Camera picture {name}: no landmark used, {refused} refused")
    } else {
        format!(
            "Camera picture {name}: {} used, {refused} refused",
            accepted.join(", ")
        )
    }
}

#[cfg(test)]
mod tests;
