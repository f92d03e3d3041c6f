//! Photos on the map, as a feature: their commands, their jobs and their layer.

use egui::{Key, Ui};
use pilotage_core::flight::photo::{PhotoSearch, RegisteredPhoto};
use pilotage_core::frames::{GroundRect, LocalFrame};
use pilotage_jobs::{JobEvent, JobId, OpenedFiles};
use serde_json::Value;

use super::PhotosCommand;
use super::panel::photos_sheet;
use super::scene::PhotosScene;
use super::state::PhotosState;
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{
    Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace, OpenedSet,
};
use crate::map::MapLayer;
use crate::shell::catalog::{CommandEntry, CommandGroup, entry, shift};
use crate::state_json::object;

/// Share of its outline that is shown around a photo.
const AROUND: f64 = 0.2;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: super::ID,
    tab: "Photos",
    place: FeaturePlace::Sheet,
    commands,
};

fn commands() -> Vec<CommandEntry> {
    vec![
        entry(
            CommandGroup::View,
            "Lay photos on the map",
            vec![shift(Key::O)],
            Command::Feature(FeatureCommand::show(super::ID)),
        )
        .also("images pictures exif locate"),
    ]
}

/// Photos on the map.
#[derive(Default)]
pub struct PhotosFeature {
    pub(super) state: PhotosState,
    /// Photos that were opened before there was a map to lay them on: key of their files, and their names.
    pub(super) awaiting: Option<(String, Vec<String>)>,
    /// The photos being laid on the map.
    pub(super) laying: Option<JobId>,
    /// The photo that is to be shown on the map: job, and its number.
    draping: Option<(JobId, usize)>,
    /// Whether its panel is shown.
    pub(super) is_shown: bool,
    /// Whether they were laid on another map than the one that is open.
    pub(super) are_of_another_map: bool,
}

impl PhotosFeature {
    /// Looks at a photo, and shows its ground while the panel is open.
    fn choose(&mut self, number: usize, context: &mut FeatureContext<'_>) {
        self.state.chosen = Some(number);
        if let Some(ground) = self.ground().filter(|_| context.is_shown) {
            context.map.fit(ground);
        }
        self.drape(context);
    }

    /// Has the chosen photo shown on the map, if it is not yet.
    fn drape(&mut self, context: &mut FeatureContext<'_>) {
        let Some((number, order)) = self.state.drape_order() else {
            return;
        };
        self.stop_draping(context);
        let job = context.start(pilotage_jobs::Job::DrapePhoto(Box::new(order)));
        self.draping = Some((job, number));
    }

    pub(super) fn stop_draping(&mut self, context: &mut FeatureContext<'_>) {
        if let Some((job, _)) = self.draping.take() {
            context.cancel(job);
        }
    }

    fn draping_event(
        &mut self,
        number: usize,
        event: JobEvent,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let is_last = event.is_last();
        match event {
            JobEvent::PhotoDraped(draped) => self.state.drape(number, &draped, context.egui),
            JobEvent::Failed(why) => context.trouble("The photo cannot be shown on the map", why),
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if is_last {
            self.draping = None;
        }
        true
    }

    fn laying_event(&mut self, event: JobEvent, context: &mut FeatureContext<'_>) -> bool {
        let is_last = event.is_last();
        let photos = &mut self.state;
        match event {
            JobEvent::Progress(share, words) => photos.at_work = Some((share, words)),
            JobEvent::PhotoRegistered(report) => {
                let number = report.number;
                photos.take(*report);
                if photos.chosen.is_none() && photos.laid(number).is_some() {
                    self.choose(number, context);
                }
            }
            JobEvent::Failed(why) => photos.trouble = Some(why),
            JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if is_last {
            self.state.at_work = None;
            self.laying = None;
        }
        true
    }
}

impl Feature for PhotosFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action::<PhotosCommand>() else {
            return false;
        };
        match command {
            PhotosCommand::Close if context.documents.flight.log.is_some() => {
                context.ask(Command::Feature(FeatureCommand::show("log")));
            }
            PhotosCommand::Close => context.hide(),
            PhotosCommand::Lay => {
                self.seek_on_open_map(context);
                self.lay(context);
            }
            PhotosCommand::Stop => {
                self.stop(context);
            }
            PhotosCommand::Search(search) => self.state.search = **search,
            PhotosCommand::AroundView => {
                let origin = context.documents.world_origin();
                let center = context.map.camera.center;
                let place = origin.map(|o| LocalFrame::new(o).geodetic_from_ground(&center));
                self.state.search.at = place;
            }
            PhotosCommand::Choose(number) => self.choose(*number, context),
            PhotosCommand::Display(shown) => {
                self.state.shown = *shown;
                self.drape(context);
            }
        }
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        let frame = documents.world_origin().map(LocalFrame::new);
        let scene = PhotosScene {
            photos: &self.state,
            has_map: documents.map.is_real() && frame.is_some(),
            are_of_another_map: self.state.are_of_another_map(&documents.map.source),
            frame,
        };
        photos_sheet(ui, context, &scene);
    }

    fn layers(&self) -> Vec<&dyn MapLayer> {
        vec![self]
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, context: &mut FeatureContext<'_>) -> bool {
        if let Some((_, number)) = self.draping.filter(|(draping, _)| *draping == job) {
            return self.draping_event(number, event, context);
        }
        self.laying == Some(job) && self.laying_event(event, context)
    }

    /// Stops laying photos. Those that were laid stay.
    fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let job = self.laying.take();
        if let Some(job) = job {
            context.cancel(job);
            self.state.at_work = None;
        }
        job.is_some()
    }

    /// Leaves photos that were laid in another world: their places mean nothing in this one.
    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        let documents = &context.documents;
        let is_strange = self.state.sought.as_ref().is_some_and(|sought| {
            let is_flown = documents.flight.source.key() == Some(&sought.key);
            !is_flown && sought.origin != documents.world_origin()
        });
        if is_strange {
            self.stop(context);
            self.stop_draping(context);
            self.state.leave();
        }
    }

    /// Leaves photos that wait for a map: whoever flies has gone on.
    fn on_other_flight(&mut self, _context: &mut FeatureContext<'_>) {
        self.awaiting = None;
    }

    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        self.is_shown = context.is_shown;
        self.lay_awaiting(context);
        let map = &context.documents.map.source;
        self.are_of_another_map = self.state.are_of_another_map(map);
    }

    fn on_shown(&mut self, context: &mut FeatureContext<'_>) {
        context.playback.playing = false;
        self.seek_photos_of_flight(context);
    }

    /// Whoever looks at photos means a picture that does not say where it lies as one of them.
    fn take_first(
        &mut self,
        _set: &OpenedSet,
        opened: &mut OpenedFiles,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        if context.is_shown && context.documents.map.is_real() {
            opened.unplaced = None;
        }
        false
    }

    fn take_opened(
        &mut self,
        _file: &str,
        opened: &mut OpenedFiles,
        context: &mut FeatureContext<'_>,
    ) {
        let names = std::mem::take(&mut opened.photos);
        if names.is_empty() {
            return;
        }
        match &opened.flight {
            Some(flight) => {
                let map = opened.map.as_ref();
                self.lay_flight(opened.key.clone(), names, flight, map, context);
            }
            None => self.lay_opened(opened.key.clone(), names, context),
        }
    }

    fn used_files(&self) -> Vec<&str> {
        let sought = self.state.sought.iter().map(|sought| &sought.key);
        let awaiting = self.awaiting.iter().map(|(key, _)| key);
        sought.chain(awaiting).map(String::as_str).collect()
    }

    fn leaves_flight_aside(&self) -> bool {
        true
    }

    /// The chosen photo, or the first, while they are shown; else one that waits for a map.
    fn photo(&self) -> Option<(&str, &str, &PhotoSearch)> {
        let shown = self.state.sought.as_ref().filter(|_| self.is_shown);
        let (key, name) = match (shown, &self.awaiting) {
            (Some(shown), _) => {
                let name = shown.names.get(self.state.chosen.unwrap_or_default());
                (&shown.key, name)
            }
            (None, Some((key, names))) => (key, names.first()),
            (None, None) => return None,
        };
        Some((key, name?, &self.state.search))
    }

    /// Ground of the chosen photo, and some around it.
    fn ground(&self) -> Option<GroundRect> {
        let laid = self.state.laid(self.state.chosen?)?;
        let ground = GroundRect::around(laid.outline.iter().copied())?;
        let longer = ground.width().max(ground.height());
        Some(ground.grown(AROUND * longer))
    }

    fn needs_no_advice(&self) -> bool {
        self.state.sought.is_some()
    }

    /// Places in degrees, deviations in metres, angles in degrees.
    fn state(&self, documents: &Documents) -> Value {
        let photos = &self.state;
        let world = photos.sought.as_ref().and_then(|s| s.origin);
        let row = |number: usize| {
            let report = photos.reports[number].as_ref();
            let laid = photos.laid(number);
            let place = laid.zip(world).map(|(laid, origin)| {
                let at = LocalFrame::new(origin).geodetic_from_ground(&laid.centre);
                [at.latitude.to_degrees(), at.longitude.to_degrees()]
            });
            object!({
                "name": photos.name(number),
                "probability": report.map(|r| r.answer.probability),
                "refused": report.and_then(|r| r.answer.laid.as_ref().err()),
                "assumed": report.map(|r| r.answer.assumed.join("; ")),
                "milliseconds": report.map(|r| r.computed),
                "place": place,
                "deviation": laid.map(RegisteredPhoto::centre_deviation),
                "heading": laid.map(|l| l.camera.attitude.yaw.to_degrees().rem_euclid(360.0)),
                "height": laid.map(RegisteredPhoto::height),
            })
        };
        object!({
            "rows": (0..photos.reports.len()).map(row).collect::<Vec<_>>(),
            "at_work": photos.at_work.is_some(),
            "trouble": photos.trouble,
            "chosen": photos.chosen,
            "of_another_map": photos.are_of_another_map(&documents.map.source),
            "draped": photos.draped().is_some(),
            "within": photos.search.within,
        })
    }
}
