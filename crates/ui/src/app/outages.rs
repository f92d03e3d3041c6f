//! Satellite navigation cut out of the flight that is open.

use pilotage_core::instruments::PositionFix;
use pilotage_core::navigator::position_fixes;

use super::{App, SideTab};
use crate::command::Workspace;
use crate::host::Host;
use crate::outage::{OutageCommand, Outages};
use pilotage_jobs::{Job, JobEvent, JobId, Outage, OutageOrder};

impl App {
    /// Does what was asked about cuts.
    pub(super) fn cut(&mut self, command: &OutageCommand, host: &mut dyn Host) {
        match *command {
            OutageCommand::Show => self.show_cut(),
            OutageCommand::Clear => {
                self.stop_cutting(host);
                self.documents.cuts = Outages::default();
            }
            OutageCommand::Selected => match self.playback.selected_span {
                Some((from, to)) => self.begin_cut(host, Outage::Stretch(from, to)),
                None => self.toasts.note(
                    host.now(),
                    "No stretch is selected",
                    "Hold Shift and drag over a plot or the time line.",
                ),
            },
            OutageCommand::Of(from, to) => self.begin_cut(host, Outage::Stretch(from, to)),
            OutageCommand::Study(length) => self.begin_cut(host, Outage::AllAlong(length)),
        }
    }

    fn show_cut(&mut self) {
        self.view.workspace = Workspace::Replay;
        self.view.side_open = true;
        self.dialogs.settings = false;
        self.side_tab = SideTab::Outage;
    }

    fn begin_cut(&mut self, host: &mut dyn Host, cut: Outage) {
        if self.documents.flight.is_none() {
            let text = "Open a flight log first.";
            self.toasts.note(host.now(), "Nothing to cut", text);
            return;
        }
        self.stop_cutting(host);
        self.show_cut();
        let words = match cut {
            Outage::Stretch(..) => "Navigating without GPS".to_owned(),
            Outage::AllAlong(length) => format!("Cutting {length:.0} s all along the flight"),
        };
        self.documents.cuts.at_work = Some(words);
        self.documents.cuts.trouble = None;
        let order = OutageOrder {
            flight: self.documents.flight_source.clone(),
            cut,
            seen: self.seen(),
        };
        self.jobs.cutting = Some(host.start(Job::Outage(Box::new(order))));
    }

    /// Positions that the whole run found in the pictures, and what to call them; `None` without any.
    fn seen(&self) -> Option<(String, Vec<PositionFix>)> {
        let documents = &self.documents;
        let run = documents.run.as_ref().filter(|_| documents.run_complete)?;
        let fixes = position_fixes(run);
        let by = if run.settings.whole_frames.is_some() {
            "pictures"
        } else {
            "landmarks"
        };
        (!fixes.is_empty()).then(|| (format!("Airspeed, wind, {by}"), fixes))
    }

    /// Stops what is computed of a cut; whether something was.
    pub(super) fn stop_cutting(&mut self, host: &mut dyn Host) -> bool {
        let job = self.jobs.cutting.take();
        if let Some(job) = job {
            host.cancel(job);
            self.documents.cuts.at_work = None;
        }
        job.is_some()
    }

    /// Takes what a worker says of a cut; whether `id` was about one.
    pub(super) fn cut_event(&mut self, id: JobId, event: &JobEvent) -> bool {
        if self.jobs.cutting != Some(id) {
            return false;
        }
        let cuts = &mut self.documents.cuts;
        match event {
            JobEvent::Progress(share, words) => {
                cuts.at_work = Some(format!("{words}: {:.0} %", 100.0 * share));
            }
            JobEvent::OutageMade(report) => cuts.report = Some((**report).clone()),
            JobEvent::OutagesStudied(report) => cuts.study = Some((**report).clone()),
            JobEvent::Failed(why) => cuts.trouble = Some(why.clone()),
            _ => {}
        }
        if event.is_last() {
            cuts.at_work = None;
            self.jobs.cutting = None;
        }
        true
    }
}
