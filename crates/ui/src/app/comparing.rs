//! Trajectories beside each other: kept, let go of, shown.

use pilotage_core::flight::trajectory::Track;
use pilotage_core::navigator::{EstimatorChoice, Run, smooth};

use super::{App, SideTab};
use crate::command::Workspace;
use crate::compare::{CompareCommand, CompareScene, Contest, TrackId, open_tracks};
use crate::documents::Documents;
use crate::host::Host;
use pilotage_jobs::{ContestOrder, Job, JobEvent, JobId};

/// Seconds since 1970 at time zero of the flight that is open, where its log says so.
fn utc_at_zero(documents: &Documents) -> Option<f64> {
    documents.log.as_ref()?.outline.as_ref()?.utc_at_zero
}

/// Scene of the view of trajectories.
pub(super) fn compare_scene(documents: &Documents) -> CompareScene<'_> {
    CompareScene {
        shelf: &documents.shelf,
        generations: [documents.run_generation, documents.ghost_generation],
        is_complete: documents.run_complete,
        contest: &documents.contest,
        utc_at_zero: utc_at_zero(documents),
    }
}

/// Name of a kept run of the flight `of`: with its estimator where that is not the usual one.
fn named_after(of: &str, run: Option<&Run>) -> String {
    let estimator = run.map(|run| run.settings.estimator.choice);
    match estimator.filter(|choice| *choice != EstimatorChoice::default()) {
        Some(choice) => format!("{of}, {}", choice.label()),
        None => of.to_owned(),
    }
}

impl App {
    /// Keeps the run with every step estimated from all of the flight.
    fn keep_smoothed(&mut self, host: &mut dyn Host) {
        let documents = &mut self.documents;
        let run = documents.run.as_ref().filter(|_| documents.run_complete);
        let (Some(flight), Some(run)) = (documents.flight.as_ref(), run) else {
            let text = "Wait until the flight is flown to its end.";
            self.toasts.note(host.now(), "Nothing to smooth yet", text);
            return;
        };
        let estimates = match smooth(run) {
            Ok(estimates) => estimates,
            Err(cause) => {
                let title = "The run cannot be smoothed";
                self.toasts
                    .trouble(host.now(), title.to_owned(), cause.to_string());
                return;
            }
        };
        let places = run.steps.iter().zip(&estimates).map(|(step, estimate)| {
            let place = estimate.position();
            (step.time, place.north, place.east)
        });
        let name = format!("{}, smoothed", named_after(&flight.name, Some(run)));
        let mut track = Track::on_the_ground(name, flight.frame_on_globe, places);
        track.utc_at_zero = utc_at_zero(documents);
        let name = documents.shelf.keep(track).to_owned();
        self.toasts.note(host.now(), "Kept for comparison", name);
    }

    /// Flies what is open by every estimator.
    fn fly_by_all(&mut self, host: &mut dyn Host) {
        self.stop_contest(host);
        let documents = &mut self.documents;
        documents.contest = Contest {
            at_work: Some("Beginning".to_owned()),
            ..Contest::default()
        };
        let order = ContestOrder {
            flight: documents.flight_source.clone(),
            map: documents.map_source.clone(),
            mission: documents.mission.clone(),
        };
        self.jobs.contest = Some(host.start(Job::Contest(Box::new(order))));
    }

    /// Stops flying by every estimator; whether somebody flew.
    pub(super) fn stop_contest(&mut self, host: &mut dyn Host) -> bool {
        let job = self.jobs.contest.take();
        if let Some(job) = job {
            host.cancel(job);
            self.documents.contest.at_work = None;
        }
        job.is_some()
    }

    /// Takes what a worker says of the contest; whether `id` was about it.
    pub(super) fn contest_event(&mut self, id: JobId, event: &JobEvent) -> bool {
        if self.jobs.contest != Some(id) {
            return false;
        }
        let contest = &mut self.documents.contest;
        match event {
            JobEvent::Progress(share, words) => {
                contest.at_work = Some(format!("{words}: {:.0} %", 100.0 * share));
            }
            JobEvent::ContestJudged(found) => contest.found = Some((**found).clone()),
            JobEvent::Failed(why) => contest.trouble = Some(why.clone()),
            _ => {}
        }
        if event.is_last() {
            contest.at_work = None;
            self.jobs.contest = None;
        }
        true
    }

    /// Does what was asked about trajectories.
    pub(super) fn compare(&mut self, command: &CompareCommand, host: &mut dyn Host) {
        let documents = &mut self.documents;
        match *command {
            CompareCommand::Show => {
                self.view.workspace = Workspace::Replay;
                self.view.side_open = true;
                self.dialogs.settings = false;
                self.side_tab = SideTab::Compare;
            }
            CompareCommand::Keep(id) => {
                let utc = utc_at_zero(documents);
                let (flight, run) = (documents.flight.as_ref(), documents.run.as_ref());
                let open = open_tracks(flight, run, documents.ghost.as_ref(), utc);
                let wanted = open.into_iter().find(|(found, _)| *found == id);
                let Some((_, mut track)) = wanted else {
                    let text = "Simulate or open a flight first.";
                    self.toasts.note(host.now(), "Nothing to keep", text);
                    return;
                };
                let of = flight.map_or("the flight", |f| f.name.as_str());
                track.name = match id {
                    TrackId::Truth => format!("{of}, true"),
                    TrackId::Unaided => format!("{of}, dead reckoning"),
                    _ => named_after(of, run),
                };
                let name = documents.shelf.keep(track).to_owned();
                self.toasts.note(host.now(), "Kept for comparison", name);
            }
            CompareCommand::KeepSmoothed => self.keep_smoothed(host),
            CompareCommand::FlyAll => self.fly_by_all(host),
            CompareCommand::Discard(number) => documents.shelf.discard(number),
            CompareCommand::ToggleShown(number) => documents.shelf.toggle_shown(number),
        }
    }
}
