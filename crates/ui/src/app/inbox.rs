//! Events of the workers and files of the user.

use pilotage_core::flight::Flight;
use pilotage_core::mission::Mission;

use super::App;
use super::map_work::tell_of_map;
use crate::command::Workspace;
use crate::documents::kept::provide;
use crate::feature::{FlightFiles, OpenedSet};
use crate::host::{Host, OpenedFile};
use crate::job_owners::{Addressee, JobOwner};
use crate::shell::whole_sentences;
use pilotage_jobs::{Beside, FlightSource, JobEvent, JobId, MapInfo, MapSource, OpenedFiles};

/// Text of a remark, if the event is one.
fn remark_in(event: &JobEvent) -> Option<String> {
    match event {
        JobEvent::Remark(text) => Some(text.clone()),
        _ => None,
    }
}

impl App {
    pub(super) fn receive(&mut self, context: &egui::Context, host: &mut dyn Host) {
        if host.lost_workers() > 0 {
            self.toasts.trouble(
                host.now(),
                "A worker stopped and was started anew",
                "Everything you have open is still here. What it was computing begins again by itself.",
            );
        }
        for (id, event) in host.events() {
            self.event(context, host, id, event);
            self.follow_flight(context, host);
        }
        for batch in host.opened() {
            self.open_files(context, host, batch);
        }
        // What is opened takes earlier trouble off the screen, and this may be of files beside it.
        if self.openings.keys().next().is_none() {
            for (title, text) in host.troubles() {
                self.toasts.trouble(host.now(), title, text);
            }
        }
    }

    pub(super) fn open_files(
        &mut self,
        context: &egui::Context,
        host: &mut dyn Host,
        batch: Vec<OpenedFile>,
    ) {
        let Some(set) = self.openings.set_of(batch) else {
            return;
        };
        if self.are_taken(&set, context, host) {
            return;
        }
        provide(host, &set.key, &set.files);
        self.openings.begin(set, &self.documents, host);
    }

    /// Brings an event to the owner of its job.
    fn event(&mut self, context: &egui::Context, host: &mut dyn Host, id: JobId, event: JobEvent) {
        let owner = match host.owners().addressee(id, &event) {
            Addressee::Owner(owner) => owner,
            Addressee::Left(_) => return self.left_event(&event, host),
            Addressee::Over => return,
            Addressee::Nobody => return self.tell_of_nobody(host),
        };
        let remark = remark_in(&event);
        let is_awaited = match owner {
            JobOwner::Feature(feature) => self.feature_event(feature, context, host, (id, event)),
            JobOwner::FramePictures => self.frame_pictures.take(id, &event, &mut self.views.camera),
            JobOwner::Flight => self.fly_event(context, host, (id, event)),
            JobOwner::Map => self.map_event(context, host, id, event),
            JobOwner::Heights => {
                let (documents, toasts) = (&mut self.documents, &mut self.toasts);
                self.height_work.take((id, event), documents, toasts, host)
            }
            JobOwner::Openings => self.open_event(context, host, id, event),
            JobOwner::Files => self.files_event(event, host),
        };
        if is_awaited {
            return;
        }
        match remark {
            // Tiles of the map that could not be had are told of the job that asked first for any, whosever that is.
            Some(text) => tell_of_map(&text, &mut self.toasts, host),
            None => self.tell_of_nobody(host),
        }
    }

    fn map_event(
        &mut self,
        context: &egui::Context,
        host: &mut dyn Host,
        id: JobId,
        event: JobEvent,
    ) -> bool {
        let is_description = matches!(event, JobEvent::MapInfo(_));
        let (work, mut parts) = self.map_parts(host);
        let is_awaited = work.take(id, event, context, &mut parts);
        if is_awaited && is_description && std::mem::take(&mut self.map_work.fits_flight) {
            self.fit_to_flight_and_map();
        }
        is_awaited
    }

    /// The job that reads files tells what is wrong with them; here they did not even arrive.
    fn files_event(&mut self, event: JobEvent, host: &dyn Host) -> bool {
        match event {
            JobEvent::Failed(why) => {
                let title = "The files did not reach the workers";
                self.toasts.trouble(host.now(), title, why);
            }
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        true
    }

    /// An event of a job that its owner left while it ran is of no use any more, but for what a worker says of a map once
    /// and for all: of a tile or a height that nobody waits for.
    fn left_event(&mut self, event: &JobEvent, host: &mut dyn Host) {
        if let Some(text) = remark_in(event) {
            tell_of_map(&text, &mut self.toasts, host);
        }
    }

    fn tell_of_nobody(&mut self, host: &mut dyn Host) {
        let text =
            "Nobody waits for an answer that came from a worker. This is a fault of the program.";
        self.toasts
            .trouble(host.now(), "An answer was not used", text);
    }

    /// The map over which a flight is flown that came without one: the open one, unless it is known to lie elsewhere.
    fn map_beneath(&self, flight: Option<&Flight>) -> MapSource {
        match flight.and_then(|flight| flight.frame_on_globe) {
            Some(frame) => self.documents.map_under(Some(frame)),
            None => self.documents.map.source.clone(),
        }
    }

    fn open_event(
        &mut self,
        context: &egui::Context,
        host: &mut dyn Host,
        id: JobId,
        event: JobEvent,
    ) -> bool {
        if !self.openings.is_under_way(id) {
            return false;
        }
        let now = host.now();
        match event {
            JobEvent::Opened(opened) => {
                host.owners().leave(id);
                if let Some(set) = self.openings.end(id) {
                    // What is said from here on is of these files.
                    self.toasts.withdraw_notes();
                    self.take_opened(context, host, &set, *opened);
                }
            }
            JobEvent::Failed(why) => {
                let name = self.openings.end(id).map(|set| set.name);
                let title = format!("{} was not opened", name.unwrap_or_default());
                let text = format!("{why} Everything open stays as it was.");
                self.toasts.trouble(now, title, text);
            }
            JobEvent::Finished | JobEvent::Cancelled => {
                self.openings.end(id);
            }
            JobEvent::Progress(..) => {}
            _ => return false,
        }
        true
    }

    /// A mission that was opened takes the place of the one that is open, one undo step away from it.
    fn take_mission(&mut self, host: &mut dyn Host, mission: Mission) {
        self.documents.mission.remember();
        self.documents.mission.content = mission;
        self.documents.mission.is_edited = true;
        self.selection = None;
        self.run_is_stale(host.now());
    }

    /// Shows a map that was opened without a flight, in a world of its own if it lies elsewhere.
    fn show_opened_map(&mut self, host: &mut dyn Host, source: MapSource, info: MapInfo) {
        let world = self.documents.world_origin();
        if let Some(origin) = info.origin.filter(|origin| world != Some(*origin)) {
            if self.documents.flight.measured.is_some()
                || !self.documents.mission.landmarks.is_empty()
            {
                let text = "It begins a plan of its own. Undo brings the mission back; the flight \
                    opens again from its files, or with \u{201c}Open the built-in demo\u{201d}.";
                self.toasts
                    .note(host.now(), "The map lies far from what was open", text);
            }
            self.fly_work.stop(host);
            let name = info.name.rsplit('/').next().unwrap_or_default();
            let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
            self.documents.begin_world(origin, stem);
            self.selection = None;
            self.show_workspace(Workspace::Plan);
        }
        self.change_map(host, source);
        self.views.map.fit(info.bounds);
        self.documents.map.info = Some(info);
        self.stored.document_changed = true;
    }

    /// Opens what was open beside a mission when it was saved.
    fn open_beside(&mut self, egui: &egui::Context, host: &mut dyn Host, beside: Option<Beside>) {
        let Some(mut beside) = beside else { return };
        let is_flight_named = beside.simulation.is_some();
        for feature in &mut self.views.features {
            feature.take_beside(&mut beside);
        }
        let flight = beside.simulation.map(FlightSource::Simulated);
        if let Some(flight) = flight.filter(|it| *it != self.documents.flight.source) {
            let map = self.documents.map.source.clone();
            self.fly_over_mission(egui, host, (flight, map));
            if let Some(fly) = &mut self.fly_work.job {
                fly.staged.bookmarks = Some(beside.bookmarks);
            }
        } else if is_flight_named || self.may_have_set(&beside.bookmarks) {
            self.documents.flight.add_bookmarks(beside.bookmarks);
        }
    }

    /// Whether bookmarks beside a mission of which nobody says over what it was flown may be of the recorded flight that
    /// is open: it has none of its own, and all of them lie within it.
    fn may_have_set(&self, bookmarks: &[f64]) -> bool {
        let documents = &self.documents;
        let is_recorded = matches!(documents.flight.source, FlightSource::Files(_));
        let is_within = |(first, last): (f64, f64)| {
            let mut marks = bookmarks.iter();
            marks.all(|mark| (first..=last).contains(mark))
        };
        is_recorded
            && documents.flight.bookmarks.is_empty()
            && documents.whole_span().is_some_and(is_within)
    }

    fn take_opened(
        &mut self,
        context: &egui::Context,
        host: &mut dyn Host,
        opening: &OpenedSet,
        mut opened: OpenedFiles,
    ) {
        let now = host.now();
        let has_more = !opened.tables.is_empty() || opened.run.is_some();
        if self.is_taken_first(opening, &mut opened, context, host) {
            return;
        }
        let OpenedFiles {
            key,
            flight,
            log,
            mut map,
            terrain,
            mission,
            run,
            unplaced: _,
            photos,
            imports,
            tables: _,
            labels,
            beside,
            remarks,
        } = opened;
        let mut parts = Vec::new();
        let is_log = log.is_some();
        let has_flight = flight.is_some() || is_log;
        let are_laid = !has_flight && !photos.is_empty();
        if has_flight || map.is_some() {
            // What lacked before may be here now.
            self.toasts.withdraw_trouble();
        }
        if has_flight || map.is_some() || terrain.is_some() {
            self.keeping.keep_few(opening, &mut self.toasts, host);
        }
        let has_map = map.is_some();
        let map_source = if let Some(info) = &map {
            parts.push("a map");
            match info.origin.filter(|_| !has_flight) {
                Some(origin) => MapSource::Placed {
                    key: opening.key.clone(),
                    origin,
                },
                None => MapSource::Files(opening.key.clone()),
            }
        } else {
            self.map_beneath(flight.as_ref())
        };
        if let Some(terrain) = terrain {
            parts.push("an elevation model");
            let (documents, toasts) = (&mut self.documents, &mut self.toasts);
            self.height_work
                .use_model(&opening.key, &terrain, documents, toasts, host);
            self.stored.document_changed = true;
        }
        if let Some(file) = log {
            // What it is, is told at the right; a notice would cover it.
            let over = has_map.then_some(map_source);
            let files = FlightFiles::opened(opening.key.clone(), file, over, mission);
            self.read_flight(&files, context, host);
        } else if let Some(flight) = &flight {
            parts.push("a flight");
            if mission.is_some() {
                parts.push("a mission");
            }
            let (name, over) = (flight.name.clone(), Some(map_source));
            let files = FlightFiles::opened(opening.key.clone(), name, over, mission);
            self.read_flight(&files, context, host);
        } else {
            if let Some(info) = map.take() {
                self.show_opened_map(host, map_source, info);
            }
            if let Some(mission) = mission {
                parts.push("a mission");
                self.take_mission(host, mission);
                self.open_beside(context, host, beside);
            }
            if let Some(run) = run {
                parts.extend(self.show_opened_run(host, run).then_some("a run"));
            }
        }
        let adds = !imports.is_empty() || labels.is_some() || is_log || has_more;
        let mut left = OpenedFiles {
            key,
            flight,
            map,
            photos,
            imports,
            labels,
            ..OpenedFiles::default()
        };
        self.give_opened(&opening.name, &mut left, context, host);
        if are_laid {
            parts.push("photos");
        }
        if remarks.is_empty() && are_laid || parts.is_empty() && adds {
            // What was added is told already.
        } else if parts.is_empty() {
            let text = whole_sentences(&remarks);
            let title = format!("{} holds nothing that can be shown", opening.name);
            self.toasts.trouble(now, title, text);
        } else {
            let title = format!("Opened {} from {}", parts.join(", "), opening.name);
            self.toasts.note(now, title, whole_sentences(&remarks));
        }
    }
}
