//! Satellite navigation cut out of a flight: what would have been known of its position all the same.

mod chart;
mod on_map;
mod panel;
mod state;
mod wind;

use egui::{Key, Ui};
use pilotage_core::flight::in_log_time;
use pilotage_core::instruments::PositionFix;
use pilotage_jobs::{Job, JobEvent, JobId, Outage, OutageOrder};
use serde_json::{Value, json};

use crate::command::Workspace;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::feature_work::WorkEvent;
use crate::map::MapLayer;
use crate::shell::NextStep;
use crate::shell::catalog::{CommandEntry, CommandGroup, entry, shift};
use crate::shell::icons::Icon;

use panel::outage_panel;
use state::{ID, OutageCommand, is_of_before, measures_airspeed};

pub use state::Outages;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "GPS outage",
    place: FeaturePlace::Tab,
    commands,
};

fn commands() -> Vec<CommandEntry> {
    vec![
        entry(
            CommandGroup::View,
            "Try a GPS outage",
            vec![shift(Key::G)],
            OutageCommand::Show.into(),
        )
        .also("lost jamming spoofing denied failure dead reckoning drift"),
    ]
}

impl Outages {
    fn begin_selected(&mut self, context: &mut FeatureContext<'_>) {
        if let Some((from, to)) = context.playback.selected_span {
            return self.begin(context, Outage::Stretch(from, to));
        }
        let text = "Hold Shift and drag over a plot or the time line.";
        context.note("No stretch is selected", text);
    }

    fn begin(&mut self, context: &mut FeatureContext<'_>, outage: Outage) {
        let documents = &*context.documents;
        if documents.flight.measured.is_none() {
            return context.note("Nothing to cut", "Open a flight log first.");
        }
        let words = match outage {
            Outage::Stretch(..) => "Navigating without GPS".to_owned(),
            Outage::AllAlong(length) => {
                format!("GPS outages of {length:.0} s all along the flight")
            }
        };
        let order = OutageOrder {
            flight: documents.flight.source.clone(),
            outage,
            seen: seen(documents),
        };
        self.asked_of = order.seen.as_ref().map(|_| documents.run.generation);
        let job = Job::Outage(Box::new(order));
        context.show();
        self.work.begin(words, job, context);
    }
}

/// Positions that the whole run found in the pictures, and what to call them; `None` without any.
fn seen(documents: &Documents) -> Option<(String, Vec<PositionFix>)> {
    let run = documents.run.navigated.as_ref();
    OutageOrder::seen_by(run.filter(|_| documents.is_run_whole())?)
}

impl Feature for Outages {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action::<OutageCommand>() else {
            return false;
        };
        match *command {
            OutageCommand::Show => context.show(),
            OutageCommand::Stop => {
                self.stop(context);
            }
            OutageCommand::Clear => {
                self.stop(context);
                // Outages all along the flight belong to no single one.
                let study = self.study.take();
                *self = Self {
                    study,
                    study_of: self.study_of,
                    ..Self::default()
                };
            }
            OutageCommand::Selected => self.begin_selected(context),
            OutageCommand::Of(from, to) => self.begin(context, Outage::Stretch(from, to)),
            OutageCommand::Study(length) => self.begin(context, Outage::AllAlong(length)),
        }
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        outage_panel(ui, context, documents, self);
    }

    fn layers(&self) -> Vec<&dyn MapLayer> {
        vec![self]
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, _context: &mut FeatureContext<'_>) -> bool {
        match self.work.take(job, event) {
            WorkEvent::Content(JobEvent::OutageMade(report)) => {
                (self.report, self.report_of) = (Some(*report), self.asked_of);
            }
            WorkEvent::Content(JobEvent::OutagesStudied(report)) => {
                (self.study, self.study_of) = (Some(*report), self.asked_of);
            }
            WorkEvent::Taken => {}
            WorkEvent::Content(_) | WorkEvent::Other(_) => return false,
        }
        true
    }

    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        self.is_of_before = is_of_before(self.report_of, context.documents);
    }

    fn next_step(&self, workspace: Workspace, documents: &Documents) -> Option<NextStep> {
        let flight = documents
            .flight
            .log
            .as_ref()
            .and(documents.flight.measured.as_ref());
        // Without airspeed little is known after an outage: that is no step to urge upon anybody.
        let is_worth_it = flight.is_some_and(measures_airspeed);
        (is_worth_it && workspace == Workspace::Replay).then(|| NextStep {
            icon: Icon::NoSignal,
            label: "Cut GPS",
            command: OutageCommand::Show.into(),
        })
    }

    fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        self.work.stop(context)
    }

    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        self.stop(context);
        *self = Self::default();
    }

    fn state(&self, documents: &Documents) -> Value {
        let report = self.report.as_ref();
        let results = report.iter().flat_map(|r| &r.results).map(|result| {
            let end = result.growth.last();
            json!({
                "label": result.label,
                "end_error": end.and_then(|g| g.error),
                "radius": end.map(|g| g.radius),
            })
        });
        let study = self.study.as_ref().map(|s| {
            let rows = s.studies.iter().map(|row| {
                json!({
                    "label": row.label,
                    "cuts": row.outages.len(),
                    "median": row.error_quantile(0.5),
                    "ninety": row.error_quantile(0.9),
                    "covered": row.covered(),
                })
            });
            json!({"length": s.length, "rows": rows.collect::<Vec<_>>()})
        });
        let is_there = report.is_some() || study.is_some() || self.work.trouble.is_some();
        if !is_there {
            return Value::Null;
        }
        json!({
            "of_run_before": is_of_before(self.report_of, documents),
            "span": report.map(|r| [r.span.0, r.span.1]),
            "results": results.collect::<Vec<_>>(),
            "remarks": report.map(|r| r.remarks.iter().map(|it| in_log_time(it)).collect::<Vec<_>>()),
            "winds": report.and_then(|r| r.winds.as_ref()),
            "study": study,
            "trouble": self.work.trouble,
        })
    }
}
