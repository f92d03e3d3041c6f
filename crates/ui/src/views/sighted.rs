//! Things that aids saw in a picture: their marks on picture and map, and words for them.

use egui::{
    Color32, Painter, Pos2, Rect, RichText, ScrollArea, Shape, Stroke, StrokeKind, Ui, vec2,
};
use pilotage_core::navigator::{AidInfo, Run, SeenReport, SightedKind, SightingReport};
use pilotage_core::reference::GenericClass;
use pilotage_core::sorting::sort;

use super::parts;
use crate::context::ViewContext;
use crate::tokens::Tokens;
use crate::units::Units;

/// Steps before the cursor in which a look of an aid still counts: some look at every second picture.
const STEPS_BACK: usize = 60;
/// Most things of a picture that are listed.
const MOST_ROWS: usize = 12;
/// Half the width of a mark, points.
pub(crate) const HALF: f32 = 4.0;

/// Name of a kind of thing.
pub(crate) const fn kind_name(kind: SightedKind) -> &'static str {
    match kind {
        SightedKind::Road => "road",
        SightedKind::Landmark(class) => match class {
            GenericClass::Building => "building",
            GenericClass::Field => "field",
            GenericClass::Tree => "tree",
            GenericClass::Crossing => "crossing",
            GenericClass::Water => "water",
            GenericClass::Parking => "paved place",
            GenericClass::Other(_) => "other landmark",
        },
    }
}

/// Colour of a thing of the picture by what became of it.
pub(crate) fn color(tokens: &Tokens, seen: &SeenReport) -> Color32 {
    match &seen.pair {
        Some(pair) if pair.accepted => tokens.observed,
        Some(_) => tokens.refused,
        None => tokens.ghost,
    }
}

/// Draws the mark of a kind of thing: a square for a building, a circle for a tree, a triangle for water, a bar for a road,
/// a diamond for the others. Filled where `fill` has a colour.
pub(crate) fn mark(
    painter: &Painter,
    at: Pos2,
    kind: SightedKind,
    stroke: Stroke,
    fill: Color32,
    tokens: &Tokens,
) {
    let rim = Stroke::new(stroke.width + 2.0, parts::rim(tokens));
    for (fill, stroke) in [(Color32::TRANSPARENT, rim), (fill, stroke)] {
        let corners = |corners: &[(f32, f32)]| {
            let points = corners
                .iter()
                .map(|(x, y)| at + HALF * vec2(*x, *y))
                .collect();
            Shape::convex_polygon(points, fill, stroke)
        };
        let shape = match kind {
            SightedKind::Road => corners(&[(-1.2, -0.4), (1.2, -0.4), (1.2, 0.4), (-1.2, 0.4)]),
            SightedKind::Landmark(GenericClass::Building) => {
                let rect = Rect::from_center_size(at, vec2(2.0 * HALF, 2.0 * HALF));
                Shape::Rect(egui::epaint::RectShape::new(
                    rect,
                    0.0,
                    fill,
                    stroke,
                    StrokeKind::Middle,
                ))
            }
            SightedKind::Landmark(GenericClass::Tree) => Shape::Circle(egui::epaint::CircleShape {
                center: at,
                radius: HALF,
                fill,
                stroke,
            }),
            SightedKind::Landmark(GenericClass::Water) => {
                corners(&[(-1.2, -1.0), (1.2, -1.0), (0.0, 1.1)])
            }
            SightedKind::Landmark(_) => {
                corners(&[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)])
            }
        };
        painter.add(shape);
    }
}

/// A probability with that many decimals. One that is not certain is never rounded to certainty.
pub(crate) fn certainty(probability: f64, decimals: usize) -> String {
    let rounded = format!("{probability:.decimals$}");
    if probability < 1.0 && rounded.starts_with('1') {
        format!("over 0.{}", "9".repeat(decimals))
    } else {
        rounded
    }
}

/// Sentences on what became of a thing of the picture.
pub(crate) fn explain(sighting: &SightingReport, seen: &SeenReport, units: Units) -> String {
    let name = kind_name(seen.kind);
    let (factor, unit) = units.length();
    let size = format!("{} {unit}", parts::figures(factor * seen.size));
    let of_road = seen.kind == SightedKind::Road;
    let size = if of_road {
        format!("Road, {size} wide")
    } else {
        let first = name[..1].to_uppercase();
        format!("{first}{}, {size} across", &name[1..])
    };
    let probability = |pair: &pilotage_core::navigator::PairReport| {
        pair.probability.map_or_else(String::new, |p| {
            format!(" (probability {})", certainty(p, 2))
        })
    };
    let verdict = match &seen.pair {
        Some(pair) if pair.accepted && of_road => "lies on a road of the map".to_owned(),
        Some(pair) if pair.accepted => {
            format!("paired with a {name} of the map{}", probability(pair))
        }
        Some(_) if of_road => "would lie on a road of the map, but too little is known".to_owned(),
        Some(pair) if sighting.accepted() > 0 => format!(
            "not used: that it is the {name} of the map at that place is too unsure{}",
            probability(pair)
        ),
        Some(pair) => format!(
            "not used: the pairs of this picture are too few or do not fit together{}",
            probability(pair)
        ),
        None if of_road && seen.similar > 0 => {
            "not used: it runs beside the road of the map".to_owned()
        }
        None if of_road => "not used: no road of the map runs that way within reach".to_owned(),
        None if seen.similar == 0 => {
            format!("not used: the map has no {name} of that size within reach")
        }
        None => format!(
            "not used: none of the {} of that kind and size on the map fits what else is seen",
            seen.similar
        ),
    };
    format!("{size}: {verdict}")
}

/// Whether it is of the points of roads, which are much alike.
pub(crate) fn of_roads(sighting: &SightingReport) -> bool {
    sighting
        .seen
        .iter()
        .any(|seen| seen.kind == SightedKind::Road)
}

/// Summary of a picture: how many things were seen, and how many of them told something of the place.
pub(crate) fn summary(sighting: &SightingReport) -> String {
    let sure = sighting.probability.map_or_else(String::new, |p| {
        format!(
            "; their place is right with probability {}",
            certainty(p, 3)
        )
    });
    let what = if of_roads(sighting) {
        "points of roads"
    } else {
        "things"
    };
    format!(
        "{} of {} {what} paired with the map{sure}",
        sighting.accepted(),
        sighting.seen.len()
    )
}

/// Things that aids saw last at or before `time`.
pub(crate) fn last(run: &Run, time: f64) -> &[SightingReport] {
    let Some(index) = run.index_at(time) else {
        return &[];
    };
    let first = index.saturating_sub(STEPS_BACK);
    let mut back = run.steps[first..=index].iter().rev();
    back.find(|step| !step.sightings.is_empty())
        .map_or(&[], |step| &step.sightings)
}

/// Shows what became of each picture's things, with a heading for each aid.
pub(crate) fn show_all(ui: &mut Ui, context: &ViewContext<'_>, sightings: &[SightingReport]) {
    let tokens = context.tokens;
    ScrollArea::vertical().id_salt("sighted").show(ui, |ui| {
        for sighting in sightings {
            let name = AidInfo::named(&sighting.aid).map_or("", |info| info.label);
            parts::section(ui, tokens, &name.to_uppercase(), true, |ui| {
                show(ui, context, sighting);
            });
        }
    });
}

/// Shows what an aid saw in a picture: a summary, and the things that are not points of roads one by one.
pub(crate) fn show(ui: &mut Ui, context: &ViewContext<'_>, sighting: &SightingReport) {
    let tokens = context.tokens;
    let text = RichText::new(summary(sighting)).size(tokens.text_sizes[0]);
    ui.label(text.color(tokens.text));
    if !of_roads(sighting) {
        table(ui, context, sighting);
    }
}

/// Things seen, each with what became of it: those that were used first, then by what was nearly used.
fn table(ui: &mut Ui, context: &ViewContext<'_>, seen: &SightingReport) {
    let tokens = context.tokens;
    let mut order: Vec<&SeenReport> = seen.seen.iter().collect();
    let rank = |seen: &SeenReport| match &seen.pair {
        Some(pair) if pair.accepted => 0,
        Some(_) => 1,
        None => 2,
    };
    sort(&mut order, &|a, b| rank(a).cmp(&rank(b)));
    for thing in order.iter().take(MOST_ROWS) {
        let text = explain(seen, thing, context.units);
        let color = match rank(thing) {
            0 => tokens.text,
            _ => tokens.muted,
        };
        ui.label(RichText::new(text).size(tokens.text_sizes[0]).color(color));
    }
    if order.len() > MOST_ROWS {
        let more = format!("and {} more", order.len() - MOST_ROWS);
        ui.label(
            RichText::new(more)
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{Fixture, sighting};
    use super::*;

    #[test]
    fn each_thing_says_why_it_was_used_or_not() {
        let told = sighting();
        let words: Vec<String> = (told.seen.iter())
            .map(|seen| explain(&told, seen, Units::Metric))
            .collect();
        assert_eq!(
            words,
            [
                "Building, 14.0 m across: paired with a building of the map (probability 0.98)",
                "Tree, 6.00 m across: not used: that it is the tree of the map at that place is too unsure \
                 (probability 0.41)",
                "Water, 30.0 m across: not used: none of the 3 of that kind and size on the map fits what else is seen",
                "Paved place, 20.0 m across: not used: the map has no paved place of that size within reach",
            ]
        );
        assert_eq!(
            summary(&told),
            "1 of 4 things paired with the map; their place is right with probability 0.997"
        );
    }

    #[test]
    fn what_is_almost_certain_is_not_called_certain() {
        let of = |p| certainty(p, 3);
        assert_eq!(
            [of(0.99951), of(1.0), of(0.5)],
            ["over 0.999", "1.000", "0.500"]
        );
        assert_eq!(certainty(0.9999, 2), "over 0.99");
    }

    #[test]
    fn the_last_look_stays_until_the_next_but_not_for_ever() {
        let mut run = Fixture::lasting(15.0).run;
        run.steps[5].sightings = vec![sighting()];
        let seen = |step: usize| last(&run, run.steps[step].time).len();
        assert_eq!(
            [seen(4), seen(5), seen(5 + STEPS_BACK), seen(6 + STEPS_BACK)],
            [0, 1, 1, 0]
        );
    }
}
