//! The place of a picture among roads as a feature.

use egui::{Rect, Ui};
use pilotage_jobs::{
    Beside, FindAmongRoadsOrder, FoundAmongRoads, Job, JobEvent, JobId, PlaceVerdict, SoughtPicture,
};
use serde_json::Value;

use super::{AmongRoads, AmongRoadsCommand, AskedPlace};
use crate::command::Command;
use crate::context::{ViewContext, shown_frame};
use crate::documents::Documents;
use crate::feature::{
    Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace, PictureButton,
};
use crate::feature_command::{AMONG_ROADS, FIND_AMONG_ROADS};
use crate::map::MapLayer;
use crate::shell::CommandLack;
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, entry};
use crate::shell::icons::Icon;
use crate::state_json::object;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: AMONG_ROADS,
    tab: "Place among roads",
    place: FeaturePlace::Nowhere,
    commands,
};

fn commands() -> Vec<CommandEntry> {
    let find = Command::Feature(FeatureCommand::show(AMONG_ROADS));
    let entry = entry(CommandGroup::View, FIND_AMONG_ROADS, vec![], find);
    vec![entry.also("lost where am I crossings").under(BarMenu::View)]
}

/// Picture that is looked at, with its time if it is one of a flight: a photo, else the camera picture at the cursor.
fn picture(context: &FeatureContext<'_>) -> Option<(SoughtPicture, Option<f64>)> {
    if let Some((key, name, search)) = context.others().find_map(|it| it.photo()) {
        let photo = SoughtPicture::Photo(key.to_owned(), name.to_owned(), *search);
        return Some((photo, None));
    }
    let flight = &context.documents.flight;
    let measured = flight.measured.as_ref()?;
    let index = shown_frame(measured, context.playback.time)?;
    let frame = SoughtPicture::Frame(flight.source.clone(), index);
    Some((frame, Some(measured.frames[index].time)))
}

impl AmongRoads {
    /// Seeks the picture that is looked at, unless it is known where it lies.
    fn find(&mut self, context: &mut FeatureContext<'_>) {
        let Some((picture, time)) = picture(context).filter(|_| self.has_roads) else {
            return;
        };
        context.take_map();
        let roads = &context.documents.mission.roads;
        let is_known = (self.asked.as_ref())
            .is_some_and(|asked| asked.picture == picture && asked.roads.is_of(roads));
        if is_known && (self.job.is_some() || self.found.is_some()) {
            self.is_open = true;
            return;
        }
        self.forget(context);
        self.is_open = true;
        self.asked = Some(AskedPlace {
            picture: picture.clone(),
            time,
            roads: context.documents.mission.roads.mark(),
            origin: context.documents.world_origin(),
        });
        let mission = context.documents.mission.clone();
        let order = FindAmongRoadsOrder { picture, mission };
        self.job = Some(context.start(Job::FindAmongRoads(Box::new(order))));
    }

    /// Stops the search and leaves what came of it.
    fn forget(&mut self, context: &mut FeatureContext<'_>) {
        self.stop(context);
        let (has_roads, has_picture) = (self.has_roads, self.has_picture);
        *self = Self {
            has_roads,
            has_picture,
            ..Self::default()
        };
    }

    /// Looks at a place that was found.
    fn choose(&mut self, number: usize, context: &mut FeatureContext<'_>) {
        let place = self.found.as_ref().and_then(|it| it.places.get(number));
        if let Some(place) = place {
            self.chosen = Some(number);
            context.map.camera.center = place.below;
            context.map.stay();
        }
    }
}

impl Feature for AmongRoads {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn on_shown(&mut self, context: &mut FeatureContext<'_>) {
        self.find(context);
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        match command.action() {
            Some(AmongRoadsCommand::Stop) => {
                self.stop(context);
            }
            Some(AmongRoadsCommand::Choose(number)) => self.choose(*number, context),
            Some(AmongRoadsCommand::Close) => self.forget(context),
            None => return false,
        }
        true
    }

    fn missing(
        &self,
        _command: &FeatureCommand,
        _documents: &Documents,
        _selected: Option<u32>,
    ) -> Option<CommandLack> {
        let (what, advice) = if self.has_roads {
            (
                "No picture is shown",
                "Open a flight with pictures, or photos.",
            )
        } else {
            (
                "The mission has no roads",
                "Open a file of them, or draw them.",
            )
        };
        CommandLack::unless(self.has_roads && self.has_picture, what, advice)
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, context: &mut FeatureContext<'_>) -> bool {
        if self.job != Some(job) {
            return false;
        }
        let is_last = event.is_last();
        match event {
            JobEvent::Progress(share, words) => self.at_work = (share, words),
            JobEvent::Figures(_) => match event.read_figures::<FoundAmongRoads>() {
                Ok(found) => {
                    let verdict = found.verdict();
                    self.found = Some(found);
                    if matches!(verdict, PlaceVerdict::Found | PlaceVerdict::Alike(_)) {
                        self.choose(0, context);
                    }
                }
                Err(why) => self.trouble = Some(why),
            },
            JobEvent::Failed(why) => self.trouble = Some(why),
            JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if is_last {
            self.job = None;
        }
        true
    }

    fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let job = self.job.take();
        if let Some(job) = job {
            context.cancel(job);
        }
        job.is_some()
    }

    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        self.forget(context);
    }

    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        let documents = &*context.documents;
        let photo = context.others().find_map(|it| it.photo());
        self.has_roads = !documents.mission.roads.is_empty();
        let measured = documents.flight.measured.as_ref();
        self.has_picture = photo.is_some() || measured.is_some_and(|it| !it.frames.is_empty());
        let Some(asked) = &self.asked else {
            self.forget(context);
            return;
        };
        let (is_other, are_others) = match (&asked.picture, photo) {
            (SoughtPicture::Photo(key, name, _), Some((other, shown, _))) => {
                (name != shown, key != other)
            }
            _ => (false, false),
        };
        if are_others || asked.origin != documents.world_origin() {
            self.forget(context);
        } else if !asked.roads.is_of(&documents.mission.roads) {
            self.of_before = Some("Of the roads before: find it again.");
        } else {
            self.of_before = is_other.then_some("Of another photo than the one that is shown.");
        }
    }

    /// A mission is opened: what was found among the roads of another is left with the next frame.
    fn take_beside(&mut self, _beside: &mut Beside) {
        self.asked = None;
    }

    fn leave_map(&mut self, _context: &mut FeatureContext<'_>) {
        self.is_open = false;
    }

    fn layers(&self) -> Vec<&dyn MapLayer> {
        if self.is_open { vec![self] } else { Vec::new() }
    }

    fn over_map(&self, ui: &mut Ui, rect: Rect, context: &mut ViewContext<'_>) -> Vec<Rect> {
        let card = self.is_open.then(|| self.card(ui, rect, context));
        card.into_iter().collect()
    }

    fn needs_no_advice(&self) -> bool {
        self.is_open
    }

    fn used_files(&self) -> Vec<&str> {
        match self.asked.as_ref().map(|asked| &asked.picture) {
            Some(SoughtPicture::Photo(key, ..)) => vec![key],
            _ => Vec::new(),
        }
    }

    fn picture_button(&self) -> Option<PictureButton> {
        self.has_roads.then(|| PictureButton {
            icon: Icon::Road,
            label: FIND_AMONG_ROADS,
            command: Command::Feature(FeatureCommand::show(AMONG_ROADS)),
        })
    }

    fn progress(&self) -> Option<(f32, &str)> {
        self.job.map(|_| (self.at_work.0, &*self.at_work.1))
    }

    /// Places in metres north and east, headings in degrees.
    fn state(&self, _documents: &Documents) -> Value {
        if self.asked.is_none() {
            return Value::Null;
        }
        let found = self.found.as_ref();
        let places = found.map_or(&[][..], |found| &found.places).iter();
        let places = places.map(|it| {
            object!({
                "place": [it.below.north, it.below.east],
                "heading": it.heading.to_degrees().rem_euclid(360.0),
                "probability": it.probability,
            })
        });
        object!({
            "open": self.is_open,
            "at_work": self.job.is_some(),
            "trouble": self.trouble,
            "verdict": found.map(|it| format!("{:?}", it.verdict())),
            "places": places.collect::<Vec<_>>(),
            "elsewhere": found.map(|it| it.elsewhere),
            "chosen": self.chosen,
            "of_before": self.of_before,
        })
    }
}
