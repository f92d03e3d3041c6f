//! The card over the map: what was sought, the places that were found, each with its probability.

use egui::{Label, Rect, RichText, ScrollArea, Ui};
use pilotage_core::filter::probability_words;
use pilotage_core::frames::LocalFrame;
use pilotage_jobs::{FoundAmongRoads, PlaceAmongRoads, PlaceVerdict, SoughtPicture};

use super::{AmongRoads, AmongRoadsCommand, AskedPlace};
use crate::context::ViewContext;
use crate::map::MapCard;
use crate::shell::{at_work, heading, muted, of_before};
use crate::units::{clock, direction};
use crate::views::parts;

/// The card.
const CARD: MapCard = MapCard {
    id: "among roads",
    title: "Place among the roads",
    close: "Close the place among the roads",
    width: 248.0,
};

impl AmongRoads {
    /// Draws the card beside the map's controls; the part of the map that it covers.
    pub(super) fn card(&self, ui: &mut Ui, map: Rect, context: &mut ViewContext<'_>) -> Rect {
        let tokens = context.tokens;
        let mut content = |ui: &mut Ui, height: f32| {
            ScrollArea::vertical()
                .max_height((height - 152.0).max(96.0))
                .show(ui, |ui| self.content(ui, context));
        };
        let (rect, is_closed) = CARD.show(ui, map, tokens, &mut content);
        if is_closed {
            context.commands.push(AmongRoadsCommand::Close.into());
        }
        rect
    }

    fn content(&self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let tokens = context.tokens;
        if let Some(asked) = &self.asked {
            ui.add(Label::new(muted(tokens, asked.words(context.clock_zero))).wrap());
        }
        if self.job.is_some() {
            let (share, words) = &self.at_work;
            let words = format!("{words}: {:.0} %", 100.0 * share);
            if at_work(ui, tokens, &words) {
                context.commands.push(AmongRoadsCommand::Stop.into());
            }
        } else if let Some(trouble) = &self.trouble {
            ui.add(Label::new(RichText::new(trouble).color(tokens.warning)).wrap());
        } else if self.found.is_none() {
            ui.add(Label::new(muted(tokens, "Stopped.")).wrap());
        }
        if let Some(found) = &self.found {
            of_before(ui, tokens, self.of_before, |ui| {
                self.places(ui, context, found);
            });
        }
    }

    fn places(&self, ui: &mut Ui, context: &mut ViewContext<'_>, found: &FoundAmongRoads) {
        let tokens = context.tokens;
        let verdict = found.verdict();
        let words = match verdict {
            PlaceVerdict::Found => "Found".to_owned(),
            PlaceVerdict::Alike(2) => "Two places look alike".to_owned(),
            PlaceVerdict::Alike(count) => format!("{count} places look alike"),
            PlaceVerdict::NotHere => "Not found here".to_owned(),
            PlaceVerdict::Unsure => "No place is sure".to_owned(),
            PlaceVerdict::NothingSeen => "Too few roads in the picture".to_owned(),
        };
        heading(ui, tokens, &words);
        if verdict == PlaceVerdict::NothingSeen {
            return;
        }
        let origin = self.asked.as_ref().and_then(|asked| asked.origin);
        let frame = origin.map(LocalFrame::new);
        for (number, place) in found.places.iter().enumerate() {
            let words = row(number, place, frame.as_ref(), context);
            let is_chosen = self.chosen == Some(number);
            if ui.selectable_label(is_chosen, words).clicked() {
                context
                    .commands
                    .push(AmongRoadsCommand::Choose(number).into());
            }
        }
        let elsewhere = probability_words(found.elsewhere);
        let words = format!("Elsewhere, or not on these roads: {elsewhere}");
        ui.add(Label::new(muted(tokens, words)).wrap());
        let words = format!("Sought by {}.", found.assumed);
        ui.add(Label::new(muted(tokens, words)).wrap());
    }
}

/// A place in words, with its number from 1.
fn row(
    number: usize,
    place: &PlaceAmongRoads,
    frame: Option<&LocalFrame>,
    context: &ViewContext<'_>,
) -> String {
    let at = if let Some(frame) = frame {
        let at = frame.geodetic_from_ground(&place.below);
        let [latitude, longitude] = [at.latitude, at.longitude].map(f64::to_degrees);
        format!("{latitude:.5}°, {longitude:.5}°")
    } else {
        let (length, unit) = context.units.length();
        let [north, east] =
            [place.below.north, place.below.east].map(|it| parts::figures(length * it));
        format!("{north} {unit} N, {east} {unit} E")
    };
    let probability = probability_words(place.probability);
    let heading = direction(place.heading, 0);
    format!("{}: {probability}\n{at}, heading {heading}°", number + 1)
}

impl AskedPlace {
    /// The picture, by what people call it; clocks stand at zero at `clock_zero`, seconds in the flight's time base.
    fn words(&self, clock_zero: f64) -> String {
        match (&self.picture, self.time) {
            (SoughtPicture::Photo(_, name, _), _) => {
                format!("Photo {}", name.rsplit('/').next().unwrap_or(name))
            }
            (SoughtPicture::Frame(..), time) => {
                let time = clock(time.unwrap_or_default(), clock_zero);
                format!("Camera picture at {time}")
            }
        }
    }
}
