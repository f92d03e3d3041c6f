//! Going to a place as a feature.

use egui::{Key, Ui};
use pilotage_core::frames::{Geodetic, LocalFrame};
use pilotage_core::place_text::{place_of_text, place_of_text_near, town_of_short_code};
use serde_json::Value;

use super::mark::GoToMark;
use super::places::OpenWorld;
use super::{GoTo, GoToCommand, ID};
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::map::{MapLayer, distance_over_ground, is_in_reach, world_reach};
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, entry, shift};
use crate::shell::keys::ShortcutListener;
use crate::state_json::object;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Go to a place",
    place: FeaturePlace::Dialog,
    commands,
};

fn commands() -> Vec<CommandEntry> {
    let show = Command::Feature(FeatureCommand::show(ID));
    let keys = vec![shift(Key::W)];
    let also = "town city coordinates latitude longitude utm mgrs plus code find where";
    let entry = entry(CommandGroup::View, "Go to a place…", keys, show);
    vec![entry.also(also).under(BarMenu::View)]
}

impl GoTo {
    /// Offers the towns of which the name is typed.
    fn search(&mut self, context: &FeatureContext<'_>) {
        (self.elsewhere, self.chosen) = (None, 0);
        self.why.clear();
        let world = world(context);
        let is_coordinates = place_of_text(&self.typed).is_ok();
        let text = if is_coordinates { "" } else { &*self.typed };
        let found = self.places.find(text, world.as_ref()).into_iter();
        let offered = found.map(|it| {
            let far = world.as_ref().map(|world| world.distance(&it.place));
            let far = far.map(|far| format!(" · {}", context.view.units.far(far)));
            let words = format!("{}, {}{}", it.name, it.region, far.unwrap_or_default());
            (it, words)
        });
        self.offered = offered.collect();
    }

    /// Moves the map to what is typed or chosen, or says why not.
    fn go(&mut self, context: &mut FeatureContext<'_>) {
        self.elsewhere = None;
        match self.meant(context) {
            Ok(mark) => {
                let place = mark.place;
                self.mark = Some(mark);
                self.go_there(&place, context);
            }
            Err(why) => self.why = why,
        }
        // Enter took it from the field.
        self.wants_keyboard = true;
    }

    /// The place that is typed or chosen, or why there is none.
    fn meant(&self, context: &FeatureContext<'_>) -> Result<GoToMark, String> {
        let text = self.typed.trim().to_owned();
        let read = match town_of_short_code(&text) {
            None => place_of_text(&text),
            Some(town) => place_of_text_near(&text, &self.near(town, context)?),
        };
        match (read, self.offered.get(self.chosen)) {
            (Ok(place), _) => Ok(GoToMark { place, text }),
            (Err(_), Some((town, _))) => Ok(GoToMark {
                place: town.place,
                text: town.name.clone(),
            }),
            (Err(why), None) if self.places.are_read() && text.contains(char::is_alphabetic) => {
                Err(format!("No town of the list begins so. {why}"))
            }
            (Err(why), None) => Err(why.to_string()),
        }
    }

    /// The place near which a short code lies: a town, or the middle of the map if none is written.
    fn near(&self, town: &str, context: &FeatureContext<'_>) -> Result<Geodetic, String> {
        let world = world(context);
        if town.is_empty() {
            let why = "That plus code is short: write the town behind it, or the whole code.";
            return world.map(|it| it.middle).ok_or_else(|| why.to_owned());
        }
        let found = self.places.find(town, world.as_ref());
        let place = found.first().map(|it| it.place);
        place.ok_or_else(|| format!("No town of the list is called {town}: write the whole code."))
    }

    fn go_there(&mut self, place: &Geodetic, context: &mut FeatureContext<'_>) {
        let documents = &*context.documents;
        let Some(frame) = documents.world_origin().map(LocalFrame::new) else {
            self.why = String::from("What is open has no place on the globe: nothing leads there.");
            self.elsewhere = Some(*place);
            return;
        };
        let place = Geodetic {
            height: frame.origin.height,
            ..*place
        };
        if !is_in_reach(&frame, &place) {
            self.why = format!(
                "That is {:.0} km from the world that is open, which reaches {:.0} km.",
                1e-3 * distance_over_ground(&frame, &place),
                1e-3 * world_reach()
            );
            self.elsewhere = Some(place);
            return;
        }
        let point = frame.ground_from_geodetic(&place);
        let is_bare = (documents.map.info.as_ref()).is_none_or(|map| !map.bounds.contains(&point));
        context.map.camera.center = point;
        context.map.stay();
        self.is_open = false;
        if is_bare {
            let text = "Open one that does, or a map from the web.";
            context.note("The open map does not reach there", text);
        }
    }
}

/// The open world, if it has a place on the globe.
fn world(context: &FeatureContext<'_>) -> Option<OpenWorld> {
    let frame = LocalFrame::new(context.documents.world_origin()?);
    let middle = frame.geodetic_from_ground(&context.map.camera.center);
    Some(OpenWorld { frame, middle })
}

impl Feature for GoTo {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        match command.action() {
            Some(GoToCommand::Search) => self.search(context),
            Some(GoToCommand::Go) => self.go(context),
            None => return false,
        }
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        if self.is_open {
            self.show(ui, context, documents);
        }
    }

    /// Opens the dialog, or closes it if it is open.
    fn on_shown(&mut self, context: &mut FeatureContext<'_>) {
        (self.is_open, self.wants_keyboard) = (!self.is_open, true);
        if self.is_open {
            self.places.ask(context.host);
        }
        self.search(context);
    }

    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        if self.places.take(context.host) {
            self.search(context);
        }
        let is_left = !ShortcutListener::is_covered(context.egui)
            && context.egui.input(|input| input.key_pressed(Key::Escape));
        if is_left {
            self.mark = None;
        }
    }

    fn layers(&self) -> Vec<&dyn MapLayer> {
        self.mark.iter().map(|it| it as &dyn MapLayer).collect()
    }

    fn is_open_over(&self) -> bool {
        self.is_open
    }

    fn takes_letters(&self) -> bool {
        self.is_open
    }

    fn state(&self, _documents: &Documents) -> Value {
        let offered: Vec<&str> = self.offered.iter().map(|it| &*it.1).collect();
        object!({
            "open": self.is_open,
            "why": self.why,
            "offered": offered,
            "chosen": self.chosen,
            "mark": self.mark.as_ref().map(|it| &*it.text),
        })
    }
}
