//! The list of flights that failed, each to be opened in Replay.

use egui::{Align2, Label, RichText, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::command::StudyCommand;
use super::outcome::{FailedRun, StudyOutcome};
use crate::context::ViewContext;
use crate::shell::{counted, heading, muted, paint_focus_ring, paint_row};
use crate::views::parts;

/// Most rows that are listed.
const LISTED: usize = 100;
/// Width of a column of numbers, in letters of normal size.
const COLUMN: f32 = 3.8;

/// Number by which failed flights are sorted, the worst first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FailedOrder {
    /// Largest error.
    #[default]
    Largest,
    /// Root mean square error.
    Rms,
    /// Time in the ellipse, the shortest first.
    Inside,
    /// Number of the run.
    Run,
}

impl FailedOrder {
    /// The flights in this order, the worst first; of a flight that was given up there is nothing worse.
    pub fn sorted(self, failed: &[FailedRun]) -> Vec<&FailedRun> {
        let key = |run: &FailedRun| match self {
            Self::Largest => -run.largest.unwrap_or(f64::INFINITY),
            Self::Rms => -run.rms.unwrap_or(f64::INFINITY),
            Self::Inside => run.inside.unwrap_or(-1.0),
            Self::Run => run.run as f64,
        };
        let mut sorted: Vec<&FailedRun> = failed.iter().collect();
        sorted.sort_by(|one, other| key(one).total_cmp(&key(other)));
        sorted
    }
}

/// Draws the list; `open` is the run that is open in Replay.
pub(super) fn failed(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    outcome: &StudyOutcome,
    order: &mut FailedOrder,
    open: Option<u64>,
) {
    let tokens = context.tokens;
    let flights: usize = outcome.settings.iter().map(|own| own.flights).sum();
    let count = outcome.failed.len();
    let flights = counted(flights, "flight", "flights");
    heading(ui, tokens, &format!("Failed: {count} of {flights}"));
    let words = "A flight failed if the filter gave up, if an error passed a limit of the plan, or if the truth was \
                 outside the 95 % ellipse for more than half of the time.";
    ui.add(Label::new(muted(tokens, words)).wrap());
    if count == 0 {
        return;
    }
    let words = match open {
        Some(run) => {
            let words = format!(
                "Run {run} is open in Replay: the same flight to the last digit. It has no camera pictures."
            );
            RichText::new(words).color(tokens.accent)
        }
        None => muted(
            tokens,
            "Choose one to fly that very flight again in Replay. There are no camera pictures.",
        ),
    };
    ui.add(Label::new(words).wrap());
    ui.horizontal_wrapped(|ui| {
        ui.label(muted(tokens, "Sort by"));
        for (own, by, text) in [
            (FailedOrder::Largest, "largest error", "largest"),
            (FailedOrder::Rms, "RMS error", "RMS"),
            (FailedOrder::Inside, "time in the ellipse", "inside"),
            (FailedOrder::Run, "number of the run", "run"),
        ] {
            let name = format!("Sort by {by}");
            if parts::chip(ui, tokens, *order == own, text, &name).clicked() {
                *order = own;
            }
        }
    });
    let (_, unit) = context.units.length();
    let titles = [
        format!("largest, {unit}"),
        format!("RMS, {unit}"),
        "inside".to_owned(),
    ];
    let height = 1.6 * tokens.text_sizes[0];
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    let mut right = rect.right() - 0.5 * tokens.space;
    for title in titles.iter().rev() {
        let at = pos2(right, rect.center().y);
        ui.painter().text(
            at,
            Align2::RIGHT_CENTER,
            title,
            parts::small(tokens),
            tokens.muted,
        );
        right -= COLUMN * tokens.text_sizes[1];
    }
    ui.spacing_mut().item_spacing.y = 0.0;
    for run in order.sorted(&outcome.failed).into_iter().take(LISTED) {
        row(ui, context, run, open == Some(run.run));
    }
    if count > LISTED {
        let words = format!("and {} more, less bad in this order", count - LISTED);
        ui.label(muted(tokens, words));
    }
}

fn row(ui: &mut Ui, context: &mut ViewContext<'_>, run: &FailedRun, is_open: bool) {
    let tokens = context.tokens;
    let (factor, unit) = context.units.length();
    let length = |value: Option<f64>| {
        value.map_or_else(|| "–".to_owned(), |value| parts::figures(factor * value))
    };
    let inside = run
        .inside
        .map_or_else(|| "–".to_owned(), |share| format!("{:.0} %", 100.0 * share));
    let cells = [length(run.largest), length(run.rms), inside];
    let height = (2.0 * tokens.text_sizes[1] + tokens.space).max(tokens.target());
    let size = vec2(ui.available_width(), height);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let [largest, rms, inside] = &cells;
    let words = format!(
        "Run {}, {}: {}. Largest error {largest} {unit}, RMS {rms} {unit}, inside the ellipse {inside} of the time",
        run.run, run.setting, run.why
    );
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_open, &words));
    if ui.is_rect_visible(rect) {
        let painter = ui.painter();
        paint_row(
            painter,
            rect,
            tokens,
            is_open,
            response.hovered() || response.has_focus(),
        );
        if response.has_focus() {
            paint_focus_ring(painter, rect, tokens);
        }
        let upper = rect.center().y - 0.5 * tokens.text_sizes[1];
        let mut right = rect.right() - 0.5 * tokens.space;
        for cell in cells.iter().rev() {
            let at = pos2(right, upper);
            painter.text(
                at,
                Align2::RIGHT_CENTER,
                cell,
                parts::normal(tokens),
                tokens.text,
            );
            right -= COLUMN * tokens.text_sizes[1];
        }
        let left = rect.left() + 0.5 * tokens.space;
        let write = |text: String, font, colour, y: f32, width: f32| {
            let mut job = egui::text::LayoutJob::simple_singleline(text, font, colour);
            job.wrap = egui::text::TextWrapping::truncate_at_width(width.max(0.0));
            let galley = painter.layout_job(job);
            painter.galley(pos2(left, y - 0.5 * galley.size().y), galley, colour);
        };
        let name = format!("Run {} · {}", run.run, run.setting);
        write(
            name,
            parts::normal(tokens),
            tokens.text,
            upper,
            right - left,
        );
        let lower = rect.center().y + 0.5 * tokens.text_sizes[1] + 2.0;
        let width = rect.right() - left;
        write(
            run.why.clone(),
            parts::small(tokens),
            tokens.muted,
            lower,
            width,
        );
    }
    if response.gained_focus() {
        response.scroll_to_me(None);
    }
    if response.on_hover_text("Open in Replay").clicked() {
        context.commands.push(StudyCommand::Open(run.run).into());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_flight_stands_first_and_one_that_was_given_up_before_all() {
        let run = |run, largest, rms, inside| FailedRun {
            run,
            setting: String::new(),
            largest,
            rms,
            inside,
            why: String::new(),
        };
        let failed = [
            run(0, Some(30.0), Some(9.0), Some(0.6)),
            run(1, Some(50.0), Some(8.0), Some(0.3)),
            run(2, None, None, None),
        ];
        let sorted = |order: FailedOrder| -> Vec<u64> {
            order
                .sorted(&failed)
                .into_iter()
                .map(|run| run.run)
                .collect()
        };
        assert_eq!(sorted(FailedOrder::Largest), [2, 1, 0]);
        assert_eq!(sorted(FailedOrder::Rms), [2, 0, 1]);
        assert_eq!(sorted(FailedOrder::Inside), [2, 1, 0]);
        assert_eq!(sorted(FailedOrder::Run), [0, 1, 2]);
    }
}
