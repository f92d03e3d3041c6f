//! A log read in a worker, and flown as soon as all of it is there.

use pilotage_core::flight::log::LogOutline;
use pilotage_jobs::{
    FlightSource, Job, JobEvent, JobId, MapSource, ReadLog, ReadLogOrder, VEHICLE_FILE,
    write_vehicle,
};

use super::OpenLog;
use super::work::{LogAnswers, LogFeature, Reading};
use crate::documents::kept::put_beside;
use crate::documents::{Staged, empty_mission, with_origin};
use crate::feature::{FeatureContext, FlightFiles, OpenedSet};

/// Times that a log is read again because nobody has it any more.
const MOST_REREADS: u8 = 2;

impl LogFeature {
    /// Reads the log of a flight, in the place of the one being read.
    pub(super) fn read(&mut self, flight: FlightFiles, context: &mut FeatureContext<'_>) {
        self.stop_reading(context);
        let is_known = self.log.as_ref().is_some_and(|log| log.key == flight.key);
        if flight.is_open && context.documents.flight.log.is_some() && !is_known {
            self.log = Some(OpenLog::new(flight.key.clone(), flight.name.clone()));
        }
        let order = ReadLogOrder {
            key: flight.key.clone(),
            file: flight.name.clone(),
        };
        self.reading = Some(Reading {
            job: context.start(Job::ReadLog(order)),
            words: format!("Reading {}", flight.name),
            flight,
            progress: 0.0,
            is_shown: false,
        });
    }

    /// Reads the log that is open again.
    pub(super) fn read_again(&mut self, context: &mut FeatureContext<'_>) {
        if let Some(flight) = FlightFiles::open(context.documents) {
            self.read(flight, context);
        }
    }

    /// Reads the log that is open again with another of its vehicles as the one that flies; the map stays.
    pub(super) fn fly_vehicle(&mut self, system: u32, context: &mut FeatureContext<'_>) {
        let Some(log) = &self.log else {
            return;
        };
        let (key, name) = (log.key.clone(), log.file.clone());
        let Some(mut files) = (context.kept)(&key) else {
            let title = format!("Another vehicle of {name} cannot be chosen here");
            let text = "The browser keeps no logs as large as this one. `pilotage replay --vehicle` flies it on the \
                        terminal.";
            return context.trouble(&title, text);
        };
        put_beside(&mut files, VEHICLE_FILE, write_vehicle(system));
        context.provide(OpenedSet {
            key: key.clone(),
            name: name.clone(),
            files,
        });
        let map = context.documents.map.source.clone();
        self.read(FlightFiles::opened(key, name, Some(map), None), context);
    }

    /// Stops reading a log; what was read stays. Whether one was being read.
    pub(super) fn stop_reading(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let reading = self.reading.take();
        if let Some(reading) = &reading {
            context.cancel(reading.job);
        }
        reading.is_some()
    }

    /// Takes what is said of the log being read; whether that is awaited.
    pub(super) fn reading_event(
        &mut self,
        id: JobId,
        event: JobEvent,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let Some(reading) = self.reading.as_mut().filter(|it| it.job == id) else {
            return false;
        };
        match event {
            JobEvent::Progress(progress, words) => {
                (reading.progress, reading.words) = (progress, words);
            }
            JobEvent::LogOutline(outline) => {
                self.show(context);
                self.grow(*outline, context);
                if self.plots.is_empty() {
                    self.plots.begin(OpenLog::likely_fields());
                }
            }
            JobEvent::LogRead(read) => {
                self.show(context);
                self.take(*read, context);
            }
            JobEvent::Failed(why) => {
                let title = format!("{} was not read to its end", reading.flight.name);
                self.reading = None;
                context.trouble(&title, format!("{why} What was read of it stays."));
            }
            JobEvent::Finished | JobEvent::Cancelled => self.reading = None,
            _ => return false,
        }
        true
    }

    /// The log being read takes the place of what is open, once there is something of it to show.
    fn show(&mut self, context: &mut FeatureContext<'_>) {
        let Some(reading) = &mut self.reading else {
            return;
        };
        if std::mem::replace(&mut reading.is_shown, true) {
            return;
        }
        let (key, name) = (reading.flight.key.clone(), reading.flight.name.clone());
        let source = FlightSource::Files(key.clone());
        context.stop_flying();
        context.documents.begin_log(name.clone(), &source);
        self.leave(context);
        self.log = Some(OpenLog::new(key, name));
        context.document_changed();
        // Whoever put a camera beside a log waits for this one, and whoever lays photos looks at them.
        context.offer();
        self.shows_plots = true;
    }

    /// More of the log was read.
    fn grow(&mut self, outline: LogOutline, context: &mut FeatureContext<'_>) {
        if let Some(file) = &mut context.documents.flight.log {
            file.grow(&outline);
        }
        if let Some(log) = &mut self.log {
            log.grow(outline);
        }
    }

    fn take(&mut self, read: ReadLog, context: &mut FeatureContext<'_>) {
        let Some(Reading { job, flight, .. }) = self.reading.take() else {
            return;
        };
        context.wait_no_more(job);
        // What was asked while it was read is asked anew of all of it.
        self.stop_asking(context);
        self.grow(read.outline, context);
        let Some(log) = &mut self.log else {
            return;
        };
        if let Some(file) = &mut context.documents.flight.log {
            file.take_off = read.overview.airborne.first().map(|(from, _)| *from);
        }
        log.overview = Some(read.overview);
        let frame = read.flight.as_ref().ok().copied().flatten();
        log.tracks = (read.tracks, frame);
        let plots = &mut self.plots;
        if plots.is_empty() || plots.panels().eq(OpenLog::likely_fields()) {
            plots.begin(log.first_fields());
        }
        if let Some(why) = &read.lost_pictures {
            context.trouble("The pictures beside the log were left out", why);
        }
        match &read.flight {
            Ok(frame) => {
                let map = flight.map.clone();
                let map = map.unwrap_or_else(|| context.documents.map_under(*frame));
                context.fly(flight, with_origin(map, *frame));
            }
            Err(why) => look_at_fields(&flight, why, context),
        }
    }

    /// Leaves what was asked of a log that is open no longer.
    pub(super) fn leave(&mut self, context: &mut FeatureContext<'_>) {
        self.stop_asking(context);
        self.plots.begin(Vec::new());
        self.shows_plots = false;
    }

    /// Stops all that was asked of the log.
    fn stop_asking(&mut self, context: &mut FeatureContext<'_>) {
        let LogAnswers {
            asked: _,
            figures,
            table,
        } = std::mem::take(&mut self.answers);
        let fetching = self.fetching.drain(..).map(|(job, _)| job);
        let figures = figures.map(|(job, _)| job);
        let table = table.map(|table| table.job);
        for job in fetching.chain(figures).chain(table) {
            context.cancel(job);
        }
    }

    /// The worker that had the log is gone: another one has to read it first.
    pub(super) fn lose(&mut self) {
        if self.reading.is_none() && self.rereads < MOST_REREADS {
            self.rereads += 1;
            self.is_lost = true;
        }
    }
}

/// Shows a log that cannot be navigated, without a flight: nobody knows where it was, so it lies on no map, and beside
/// no landmark that was not put there.
fn look_at_fields(flight: &FlightFiles, why: &str, context: &mut FeatureContext<'_>) {
    let documents = &mut *context.documents;
    if let Some(file) = &mut documents.flight.log {
        file.unnavigable = Some(why.to_owned());
    }
    if let Some(time) = documents.first_look() {
        context.playback.time = time;
    }
    if !documents.mission.is_edited {
        let staged = Staged {
            mission: Some(empty_mission()),
            ..Staged::default()
        };
        let source = documents.flight.source.clone();
        documents.look_at(staged, &source);
        context.change_map(MapSource::Nothing);
    }
    let title = format!("{} cannot be navigated", flight.name);
    // The title names the file already.
    let lack = why
        .strip_prefix(&format!("{}: no ", flight.name))
        .map_or_else(|| why.to_owned(), |lack| format!("There is no {lack}"));
    let text = format!("{lack}. Its fields can be plotted all the same.");
    context.note(&title, text);
}
