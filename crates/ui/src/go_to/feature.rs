//! Going to a place as a feature.

use egui::{Key, Ui};
use pilotage_core::frames::{Geodetic, LocalFrame};
use pilotage_core::place_text::place_of_text;
use pilotage_jobs::WebMap;
use serde_json::Value;

use super::{GoTo, ID};
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, entry, shift};
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
    let also = "coordinates latitude longitude utm mgrs plus code find where";
    let entry = entry(CommandGroup::View, "Go to a place…", keys, show);
    vec![entry.also(also).under(BarMenu::View)]
}

impl GoTo {
    /// Moves the map to what is typed, or says why not.
    fn go(&mut self, context: &mut FeatureContext<'_>) {
        self.elsewhere = None;
        match place_of_text(&self.typed) {
            Ok(place) => self.go_there(&place, context),
            Err(why) => self.why = why.to_string(),
        }
        // Enter took it from the field.
        self.wants_keyboard = true;
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
        let distance = frame.world_from_geodetic(&place).coords.norm();
        // Beyond, the plane leaves the globe.
        let reach = 0.5 * WebMap::area().width();
        if distance > reach {
            self.why = format!(
                "That is {:.0} km from the world that is open, which reaches {:.0} km.",
                1e-3 * distance,
                1e-3 * reach
            );
            self.elsewhere = Some(place);
            return;
        }
        let point = frame.ground_from_geodetic(&place);
        let is_bare = (documents.map.as_ref()).is_none_or(|map| !map.bounds.contains(&point));
        context.map.camera.center = point;
        context.map.stay();
        self.is_open = false;
        if is_bare {
            let text = "Open one that does, or a map from the web.";
            context.note("The open map does not reach there", text);
        }
    }
}

impl Feature for GoTo {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let is_own = command.action::<super::GoToCommand>().is_some();
        if is_own {
            self.go(context);
        }
        is_own
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        if self.is_open {
            self.show(ui, context, documents);
        }
    }

    /// Opens the dialog, or closes it if it is open.
    fn on_shown(&mut self, _context: &mut FeatureContext<'_>) {
        *self = Self {
            is_open: !self.is_open,
            wants_keyboard: true,
            typed: std::mem::take(&mut self.typed),
            ..Self::default()
        };
    }

    fn is_open_over(&self) -> bool {
        self.is_open
    }

    fn takes_letters(&self) -> bool {
        self.is_open
    }

    fn state(&self, _documents: &Documents) -> Value {
        object!({"open": self.is_open, "why": self.why})
    }
}
