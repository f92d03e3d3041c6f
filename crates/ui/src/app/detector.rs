//! Searches of trained detectors: asked for, taken, shown.

use serde_json::{Value, json};

use super::{App, SideTab};
use crate::command::Workspace;
use crate::detector::DetectorCommand;
use crate::host::Host;
use pilotage_jobs::{DetectorSearch, ExplainedBy, JobEvent};

impl App {
    pub(super) fn detector(&mut self, command: &DetectorCommand, host: &mut dyn Host) {
        match command {
            DetectorCommand::Explain { time, landmark } => {
                self.explain_detector(host, *time, *landmark);
            }
            DetectorCommand::Show => self.show_detector(),
            DetectorCommand::Evaluate => self.evaluate(host),
            DetectorCommand::StopEvaluating => self.stop_evaluating(host),
            DetectorCommand::SaveEvaluation(file) => self.save_evaluation(file, host),
            DetectorCommand::CloseEvaluation => self.close_evaluation(),
            DetectorCommand::Stages(_) | DetectorCommand::Play => {
                if self.side_tab != SideTab::Detector {
                    self.show_detector();
                }
                self.views.detector.act(command);
            }
        }
    }

    fn show_detector(&mut self) {
        self.show_workspace(Workspace::Replay);
        self.view.side_open = true;
        self.dialogs.settings = false;
        self.side_tab = SideTab::Detector;
    }

    /// Asks what the trained detector saw and did, once.
    fn explain_detector(&mut self, host: &mut dyn Host, time: f64, landmark: u32) {
        let is_it = |t: f64, l: u32| t == time && l == landmark;
        let known = &self.documents.detector_search;
        let known = known.as_ref().is_some_and(|s| is_it(s.time, s.landmark));
        let asked = self.jobs.detector.is_some_and(|(_, t, l)| is_it(t, l));
        // One question at a time: while the flight plays, the latest search is asked for next.
        let busy = self.jobs.detector.is_some() && self.playback.playing;
        if known || asked || busy {
            return;
        }
        let Some(job) = self.explanation(ExplainedBy::Cascade, time, landmark) else {
            return;
        };
        if let Some((old, ..)) = self.jobs.detector.take() {
            host.cancel(old);
        }
        self.jobs.detector = Some((host.start(job), time, landmark));
    }

    pub(super) fn detector_event(&mut self, event: JobEvent) {
        match event {
            JobEvent::Detector(search) => self.documents.detector_search = Some(*search),
            JobEvent::Failed(why) => {
                if let Some((_, time, landmark)) = self.jobs.detector.take() {
                    self.documents.detector_search = Some(DetectorSearch {
                        time,
                        landmark,
                        found: Err(why),
                    });
                }
            }
            JobEvent::Finished | JobEvent::Cancelled => self.jobs.detector = None,
            _ => {}
        }
    }

    /// State of the view of trained detectors, for journeys.
    pub(super) fn detector_json(&self) -> Value {
        let view = &self.views.detector;
        let (passed, stages) = view.passed();
        let shown = self.documents.detector_search.as_ref().map(|search| {
            let found = search.found.as_ref();
            json!({
                "time": search.time,
                "landmark": search.landmark,
                "trouble": found.err(),
                "left": found.map_or(Vec::new(), |found| {
                    (0..=found.stages.len()).map(|stage| found.left_after(stage)).collect()
                }),
                "mean_votes": found.map_or(0.0, |found| found.mean_votes),
                "all_votes": found.map_or(0, pilotage_core::landmark::CascadeEvidence::all_votes),
            })
        });
        let (is_open, is_whole) = self.evaluating.state();
        let judged = self.evaluating.progress();
        json!({
            "evaluation": {
                "open": is_open,
                "whole": is_whole,
                "figures": self.evaluating.figures(),
                "progress": judged.map(|(part, words)| json!({"part": part, "words": words})),
            },
            "wanted": view.wanted().map(|(time, landmark)| json!([time, landmark])),
            "passed": passed,
            "stages": stages,
            "shown": shown,
        })
    }
}
