//! The log that is open: read in a worker, flown as soon as all of it is there, its fields fetched when
//! they are plotted.

use pilotage_core::flight::Flight;
use pilotage_core::mission::Mission;

use super::keeping::{provide, put_beside};
use super::log_work::{LogAnswers, ReadingLog};
use super::pending_jobs::Opening;
use super::{App, SideTab, is_sheet};
use crate::command::Workspace;
use crate::documents::{Documents, Session, Staged, with_origin};
use crate::host::Host;
use crate::log::{LogCommand, OpenLog, PresetCommand};
use pilotage_jobs::{
    FlightSource, Job, JobEvent, JobId, MapSource, ReadLog, ReadLogOrder, SeriesName, SeriesOrder,
    VEHICLE_FILE, write_vehicle,
};

/// Times that a log is read again because nobody has it any more.
const MOST_REREADS: u8 = 2;

impl App {
    /// Reads a log that was dropped, over the map that was dropped with it.
    pub(super) fn open_log(
        &mut self,
        host: &mut dyn Host,
        opening: &Opening,
        file: String,
        map: Option<MapSource>,
        mission: Option<Mission>,
    ) {
        self.jobs.logs.rereads = 0;
        self.keep_files(host, &opening.key, &opening.name, &opening.files);
        self.read_log(host, opening.key.clone(), file, map, mission);
    }

    /// Reads what a flight of tables or photos is as a log, then flies it. Its files are kept already.
    pub(super) fn open_measured(
        &mut self,
        host: &mut dyn Host,
        key: String,
        flight: &Flight,
        map: MapSource,
        mission: Option<Mission>,
    ) {
        self.jobs.logs.rereads = 0;
        self.read_log(host, key, flight.name.clone(), Some(map), mission);
    }

    /// Reads the log of the last visit again, or that of the flight which was open then.
    pub(super) fn reopen_log(&mut self, host: &mut dyn Host) {
        let (key, file) = match (&self.documents.log, &self.documents.flight_source) {
            (Some(log), _) => (log.key.clone(), log.file.clone()),
            (None, FlightSource::Files(key)) => (key.clone(), "The flight".to_owned()),
            (None, _) => return,
        };
        let session = self.documents.session();
        self.read_log(host, key, file, Some(session.map), session.mission);
        if let Some(reading) = &mut self.jobs.logs.reading {
            reading.is_again = true;
        }
    }

    /// Reads the log that is open again with another of its vehicles as the one that flies; the map stays.
    fn fly_vehicle(&mut self, system: u32, host: &mut dyn Host) {
        let Some(log) = &self.documents.log else {
            return;
        };
        let (key, file) = (log.key.clone(), log.file.clone());
        let Some(mut files) = self.jobs.keeping.files(&key) else {
            let title = format!("Another vehicle of {file} cannot be chosen here");
            let text = "The browser keeps no logs as large as this one. `pilotage replay --vehicle` flies it on the \
                        terminal.";
            self.toasts.trouble(host.now(), title, text);
            return;
        };
        put_beside(&mut files, VEHICLE_FILE, write_vehicle(system));
        provide(host, &key, &files);
        self.keep_files(host, &key, &file, &files);
        let map = self.documents.map_source.clone();
        self.read_log(host, key, file, Some(map), None);
    }

    fn read_log(
        &mut self,
        host: &mut dyn Host,
        key: String,
        file: String,
        map: Option<MapSource>,
        mission: Option<Mission>,
    ) {
        self.stop_reading(host);
        let id = host.start(Job::ReadLog(ReadLogOrder {
            key: key.clone(),
            file: file.clone(),
        }));
        self.jobs.logs.reading = Some(ReadingLog {
            id,
            words: format!("Reading {file}"),
            key,
            file,
            progress: 0.0,
            map,
            mission,
            is_again: false,
            is_shown: false,
        });
    }

    /// Stops reading a log; what was read stays. Whether one was being read.
    pub(super) fn stop_reading(&mut self, host: &mut dyn Host) -> bool {
        let reading = self.jobs.logs.reading.take();
        if let Some(reading) = &reading {
            host.cancel(reading.id);
        }
        reading.is_some()
    }

    pub(super) fn log_event(&mut self, host: &mut dyn Host, id: JobId, event: JobEvent) {
        if self.jobs.logs.fetching.contains_key(&id) {
            self.series_event(id, event);
            return;
        }
        if self.jobs.logs.answers.has(id) {
            self.answer_event(host, id, event);
            return;
        }
        let Some(reading) = &mut self.jobs.logs.reading else {
            return;
        };
        match event {
            JobEvent::Progress(progress, words) => {
                (reading.progress, reading.words) = (progress, words);
            }
            JobEvent::LogOutline(outline) => {
                self.show_log(host);
                if let Some(log) = &mut self.documents.log {
                    log.grow(*outline);
                }
                if self.views.log_plots.is_empty() {
                    self.views.log_plots.begin(OpenLog::likely_fields());
                }
            }
            JobEvent::LogRead(read) => {
                self.show_log(host);
                self.take_log(host, *read);
            }
            JobEvent::Failed(why) => {
                let name = reading.file.clone();
                self.jobs.logs.reading = None;
                let title = format!("{name} was not read to its end");
                let text = format!("{why} What was read of it stays.");
                self.toasts.trouble(host.now(), title, text);
            }
            JobEvent::Finished | JobEvent::Cancelled => self.jobs.logs.reading = None,
            _ => {}
        }
    }

    /// The log being read takes the place of what is open, once there is something of it to show.
    fn show_log(&mut self, host: &mut dyn Host) {
        let Some(reading) = &mut self.jobs.logs.reading else {
            return;
        };
        if std::mem::replace(&mut reading.is_shown, true) {
            return;
        }
        let (key, file) = (reading.key.clone(), reading.file.clone());
        let source = FlightSource::Files(key.clone());
        self.stop_flying(host);
        self.documents.begin_log(OpenLog::new(key, file), &source);
        self.leave_log(host);
        self.jobs.document_changed = true;
        if !self.is_flight_hidden() {
            self.view.workspace = Workspace::Replay;
        }
        // Whoever put a camera beside a log waits for this one, and whoever lays photos looks at them.
        if !is_sheet(self.side_tab, &self.views.features) {
            self.side_tab = SideTab::Log;
        }
        self.views.shows_log_plots = true;
    }

    fn take_log(&mut self, host: &mut dyn Host, read: ReadLog) {
        let Some(reading) = self.jobs.logs.reading.take() else {
            return;
        };
        let Some(log) = &mut self.documents.log else {
            return;
        };
        log.grow(read.outline);
        log.overview = Some(read.overview);
        let frame = read.flight.as_ref().ok().copied().flatten();
        log.tracks = (read.tracks, frame);
        self.jobs.logs.answers = LogAnswers::default();
        let plots = &mut self.views.log_plots;
        if plots.is_empty() || plots.panels().eq(OpenLog::likely_fields()) {
            plots.begin(log.first_fields());
        }
        self.jobs.logs.fetching.clear();
        if let Some(why) = read.lost_pictures {
            let title = "The pictures beside the log were left out";
            self.toasts.trouble(host.now(), title.to_owned(), why);
        }
        match read.flight {
            Ok(frame) => {
                let map = reading.map.clone();
                let map = map.unwrap_or_else(|| self.documents.map_under(frame));
                let map = with_origin(map, frame);
                let source = FlightSource::Files(reading.key);
                if reading.is_again {
                    // It may have been edited while the log was read.
                    let session = Session {
                        flight: source,
                        map,
                        ..self.documents.session()
                    };
                    self.fly_open(host, session);
                } else {
                    self.fly_new(host, source, map, reading.mission);
                }
            }
            Err(why) => {
                log.unnavigable = Some(why.clone());
                if let Some((first, _)) = log.span() {
                    self.playback.time = first;
                }
                let title = format!("{} cannot be navigated", reading.file);
                let text = format!("{why}. Its fields can be plotted all the same.");
                self.toasts.note(host.now(), title, text);
                // Nobody knows where it was: it lies on no map, and beside no landmark that was not put there.
                if !self.documents.mission_edited {
                    let staged = Staged {
                        mission: Some(Documents::empty_mission()),
                        ..Staged::default()
                    };
                    let source = self.documents.flight_source.clone();
                    self.documents.look_at(staged, &source);
                    self.change_map(host, MapSource::Nothing);
                }
            }
        }
    }

    fn series_event(&mut self, id: JobId, event: JobEvent) {
        match event {
            JobEvent::LogSeries(series) => {
                if let Some(log) = &mut self.documents.log {
                    log.take(&series);
                }
            }
            JobEvent::Finished | JobEvent::Cancelled => {
                self.jobs.logs.fetching.remove(&id);
            }
            // What is read by and by may have it yet.
            JobEvent::Failed(_) if self.jobs.logs.reading.is_some() => {
                self.jobs.logs.fetching.remove(&id);
            }
            JobEvent::Failed(_) => {
                let series = self.jobs.logs.fetching.remove(&id);
                if let (Some(log), Some(series)) = (&mut self.documents.log, series) {
                    log.series.remove(&series);
                }
                self.log_is_lost();
            }
            _ => {}
        }
    }

    /// The worker that had the log is gone: another one has to read it first.
    pub(super) fn log_is_lost(&mut self) {
        let work = &mut self.jobs.logs;
        if work.reading.is_none() && work.rereads < MOST_REREADS {
            work.rereads += 1;
            work.lost = true;
        }
    }

    /// Asks for the fields that are plotted and not there.
    pub(super) fn fetch_series(&mut self, host: &mut dyn Host) {
        if std::mem::take(&mut self.jobs.logs.lost) {
            self.reopen_log(host);
            return;
        }
        let Some(log) = &mut self.documents.log else {
            return;
        };
        if log.outline.is_none() {
            return;
        }
        let work = &mut self.jobs.logs;
        let is_asked = |series: &SeriesName| work.fetching.values().any(|asked| asked == series);
        let track = self.views.map.track_field().cloned();
        let wanted = self.views.log_plots.fields().into_iter().cloned();
        let missing: Vec<SeriesName> = wanted
            .chain(track)
            .filter(|series| !log.is_up_to_date(series) && !is_asked(series))
            .collect();
        for series in missing {
            log.look_for(&series);
            let id = host.start(Job::LogSeries(SeriesOrder {
                key: log.key.clone(),
                file: log.file.clone(),
                series: series.clone(),
            }));
            work.fetching.insert(id, series);
        }
    }

    /// Does what was asked about the log.
    pub(super) fn log(&mut self, command: LogCommand, host: &mut dyn Host) {
        match command {
            LogCommand::ColourTrack(series) => self.views.map.colour_track(series),
            LogCommand::Show => {
                self.view.workspace = Workspace::Replay;
                self.view.side_open = true;
                self.dialogs.settings = false;
                self.side_tab = SideTab::Log;
            }
            LogCommand::ShowTab(tab) => {
                self.views.log_tab = tab;
                self.log(LogCommand::Show, host);
            }
            LogCommand::SaveTable => self.save_table(host),
            LogCommand::SaveSvg => self.save_plots(host, false),
            LogCommand::SavePng => self.save_plots(host, true),
            LogCommand::ShowPreset(preset) => {
                let log = self.documents.log.as_ref();
                self.arrange_plots(log.map(|log| preset.panels(log)).unwrap_or_default());
            }
            LogCommand::Presets(PresetCommand::Show(name)) => {
                let preset = self.views.presets.named(&name);
                self.arrange_plots(preset.map(|it| it.panels.clone()).unwrap_or_default());
            }
            LogCommand::Presets(command) => {
                let shown = self.views.log_plots.arrangement();
                self.views.presets.execute(command, shown);
            }
            LogCommand::ReadAgain => self.reopen_log(host),
            LogCommand::FlyVehicle(system) => self.fly_vehicle(system, host),
            other => {
                self.views.shows_log_plots = true;
                self.view.plots_open = Some(true);
                self.views.log_plots.execute(other);
            }
        }
    }
}
