//! The chosen photo in full: where it lies, how that is known, what was assumed, and how it is shown on the map.

use egui::{Label, RichText, Slider, Ui, vec2};
use pilotage_core::filter::probability_words;
use pilotage_core::flight::photo::RegisteredPhoto;
use pilotage_core::frames::{GroundPoint, LocalFrame};
use pilotage_core::registration::RegistrationMethod;

use super::scene::{PhotosScene, send};
use super::{PhotoAppearance, PhotosCommand as Do};
use crate::context::ViewContext;
use crate::shell::{heading, muted};
use crate::units::direction;
use crate::views::parts::{self, NumberReadout};
use pilotage_jobs::PhotoReport;

/// Opacity that is begun with.
const USUAL_OPACITY: f32 = 0.6;

/// Draws it.
pub(super) fn chosen(ui: &mut Ui, context: &mut ViewContext<'_>, scene: &PhotosScene<'_>) {
    let (tokens, photos) = (context.tokens, scene.photos);
    let Some(number) = photos.chosen else {
        return;
    };
    let Some(report) = photos.reports.get(number).and_then(Option::as_ref) else {
        return;
    };
    ui.add_space(0.5 * tokens.space);
    heading(ui, tokens, photos.name(number));
    match &report.answer.laid {
        Ok(laid) => {
            display(ui, context, photos.shown);
            ui.scope(|ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                place(ui, context, laid, scene.frame.as_ref());
            });
            ui.add(Label::new(muted(tokens, believed(report, laid))).wrap());
        }
        Err(why) => {
            let text = RichText::new(format!("Not laid: {why}.")).color(tokens.warning);
            ui.add(Label::new(text).wrap());
        }
    }
    if !report.answer.assumed.is_empty() {
        let words = format!("Assumed: {}.", report.answer.assumed.join("; "));
        ui.add(Label::new(muted(tokens, words)).wrap());
    }
}

/// Draws the choice of the photo's appearance over the map.
fn display(ui: &mut Ui, context: &mut ViewContext<'_>, shown: PhotoAppearance) {
    let tokens = context.tokens;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
        let opacity = match shown {
            PhotoAppearance::Whole(opacity) => opacity,
            _ => USUAL_OPACITY,
        };
        let choices = [
            ("Chequerboard", PhotoAppearance::Squares),
            ("See-through", PhotoAppearance::Whole(opacity)),
            ("Outline", PhotoAppearance::Outline),
        ];
        for (words, choice) in choices {
            let on = choice == shown;
            let name = format!("Over the map: {words}");
            if parts::chip(ui, tokens, on, words, &name).clicked() {
                send(context, Do::Display(choice));
            }
        }
        if let PhotoAppearance::Whole(mut opacity) = shown {
            ui.spacing_mut().slider_width = 72.0;
            let slider = Slider::new(&mut opacity, 0.0..=1.0).show_value(false);
            let response = ui.add_sized(vec2(80.0, 20.0), slider);
            parts::name(&response, "Opacity of the photo");
            if response.changed() {
                send(context, Do::Display(PhotoAppearance::Whole(opacity)));
            }
        }
    });
}

fn place(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    laid: &RegisteredPhoto,
    frame: Option<&LocalFrame>,
) {
    let (tokens, units) = (context.tokens, context.units);
    let (length, unit) = units.length();
    let mut show = |what: &NumberReadout| {
        parts::reading(ui, tokens, what);
    };
    let metres = |value: f64| parts::figures(length * value);
    let at = |place: &GroundPoint| {
        let Some(frame) = frame else {
            let text = format!("{} N, {} E", metres(place.north), metres(place.east));
            return (text, unit);
        };
        let place = frame.geodetic_from_ground(place);
        let degrees = [place.latitude, place.longitude].map(f64::to_degrees);
        (format!("{:.6}, {:.6}", degrees[0], degrees[1]), "°")
    };
    let (middle, of_middle) = at(&laid.centre);
    show(&NumberReadout::new(
        "Middle of the picture",
        middle,
        of_middle,
    ));
    let deviation = metres(laid.centre_deviation());
    show(&NumberReadout::new("known to, σ per axis", deviation, unit));
    let (below, of_below) = at(&laid.below());
    show(&NumberReadout::new("Camera above", below, of_below));
    let camera = laid.camera_deviation(0).hypot(laid.camera_deviation(1)) / 2_f64.sqrt();
    show(&NumberReadout::new(
        "known to, σ per axis",
        metres(camera),
        unit,
    ));
    let height = NumberReadout::new("Height above the ground", metres(laid.height()), unit);
    show(&height.deviation(metres(laid.camera_deviation(2))));
    let degrees = |radians: f64| format!("{:.1}", radians.to_degrees()).replace('-', "−");
    let attitude = laid.camera.attitude;
    for (name, angle, part) in [
        ("Heading", direction(attitude.yaw, 1), 5),
        ("Pitch", degrees(attitude.pitch), 4),
        ("Roll", degrees(attitude.roll), 3),
    ] {
        let reading = NumberReadout::new(name, angle, "°");
        show(&reading.deviation(degrees(laid.camera_deviation(part))));
    }
}

/// By what a photo was believed, in a sentence or two.
fn believed(report: &PhotoReport, laid: &RegisteredPhoto) -> String {
    let [agree, tried] = laid.patches;
    let probability = probability_words(report.answer.probability);
    let by = match laid.laid_by {
        RegistrationMethod::Patches => {
            format!("Believed by its details: {agree} of {tried} patches agree on this place.")
        }
        RegistrationMethod::WholeFrame => format!(
            "Believed as a whole: of all places within reach, and none, this one has a probability of {probability}; \
             {agree} of {tried} parts of it agree."
        ),
    };
    format!("{by} Found in {:.2} s.", 1e-3 * report.computed)
}
