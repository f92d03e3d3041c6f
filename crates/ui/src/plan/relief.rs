//! The ground that a plan counts its altitudes from: that of the elevation model, level elsewhere.

use egui::{Align, Layout, Ui};
use pilotage_core::frames::{Altitude, AltitudeFrame, AltitudeReference, GroundPoint, LocalFrame};
use pilotage_core::imagery::terrain::{HeightDatum, Terrain as _};
use pilotage_core::mission::{Route, WayPoint};
use pilotage_core::plan::{RouteGround, profile, take_off_place};

use super::PlanCommand;
use super::routes::EditStep;
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::{Documents, OpenedTerrain};
use crate::shell::{NumberField, caption, muted};
use crate::units::Units;

/// The height of the ground, metres above the datum of the elevation model, or above mean sea level
/// where it is level.
#[derive(Clone, Copy, Debug)]
pub struct Relief<'a> {
    terrain: &'a OpenedTerrain,
    /// The world frame of the mission.
    world: LocalFrame,
    /// Height where the elevation model does not know it, metres.
    level: f64,
}

impl Documents {
    /// The ground that is planned over.
    pub fn relief(&self) -> Relief<'_> {
        let down = self.flight.measured.as_ref().map_or(0.0, |f| f.ground_down);
        Relief {
            terrain: &self.map.terrain,
            world: LocalFrame::new(self.mission.origin),
            level: self.mission.level_ground_under(down),
        }
    }

    /// States the height of level ground, metres above mean sea level.
    pub fn state_ground(&mut self, height: f64, step: EditStep) {
        if self.mission.stated_ground() != Some(height) {
            self.mission.history.begin_drag(&self.mission.content);
            self.mission.state_ground(height);
            self.mission.is_edited = true;
        }
        if step == EditStep::Whole {
            self.mission.history.finish_drag(&self.mission.content);
        }
    }
}

impl Relief<'_> {
    /// Height of the ground at a place, metres.
    pub fn at(&self, place: &GroundPoint) -> f64 {
        self.terrain.height_at(place).unwrap_or(self.level)
    }

    /// Height of the ground where a route takes off, metres.
    pub fn take_off(&self, route: &Route) -> f64 {
        let place = self.take_off_place(route);
        place.map_or(self.level, |place| self.at(&place))
    }

    /// Lets a route that was made of `before` lead as high as that: its altitudes above take-off count from a take-off of
    /// its own.
    pub fn keep_heights(&self, before: &Route, route: &mut Route) {
        route.raise_above_take_off(self.take_off(before) - self.take_off(route));
    }

    /// The altitude of a route's first way-point, above the sea where it is one above take-off: as high for routes that
    /// take off elsewhere.
    pub fn first_altitude(&self, route: &Route) -> Option<Altitude> {
        let first = route.way_points.first()?;
        let reference = self.reference(route, &first.position);
        Some(match first.altitude.frame {
            AltitudeFrame::AboveTakeOff => {
                first.altitude.counted_from(AltitudeFrame::Amsl, &reference)
            }
            _ => first.altitude,
        })
    }

    /// Place from whose ground altitudes above take-off are counted.
    fn take_off_place(&self, route: &Route) -> Option<GroundPoint> {
        take_off_place(route, &self.world, |place| self.knows(place))
    }

    /// Whether the elevation model knows a place.
    fn knows(&self, place: &GroundPoint) -> bool {
        self.terrain.height_at(place).is_some()
    }

    /// Reference heights of a route's altitudes at a place.
    pub fn reference(&self, route: &Route, place: &GroundPoint) -> AltitudeReference {
        AltitudeReference {
            take_off: self.take_off(route),
            ground: self.at(place),
        }
    }

    /// The ground under a route, whose heights `at` says.
    pub fn under<'f>(&self, route: &Route, at: &'f dyn Fn(&GroundPoint) -> f64) -> RouteGround<'f> {
        RouteGround {
            height_at: at,
            take_off: self.take_off(route),
            is_level: self.is_level(),
        }
    }

    /// Height of a way-point above the ground below it, metres.
    pub fn above(&self, route: &Route, way_point: &WayPoint) -> f64 {
        self.under(route, &|p| self.at(p)).above(way_point)
    }

    /// Whether no elevation model says the height of the ground.
    pub fn is_level(&self) -> bool {
        self.terrain.heights().is_none()
    }

    /// Metres between the posts of the elevation model; endless without one.
    pub fn spacing(&self) -> f64 {
        let grid = self.terrain.heights();
        grid.map_or(f64::INFINITY, |grid| grid.spacing())
    }

    /// Datum of its heights, to stand behind a number with its unit.
    pub fn frame(&self) -> &'static str {
        (self.terrain.heights()).map_or("AMSL", |grid| grid.datum().frame())
    }

    /// Share of a route over ground that the elevation model does not know, 0 to 1.
    fn unknown(&self, route: &Route) -> f64 {
        let places = places(route);
        let unknown = |p: &&GroundPoint| !self.knows(p);
        places.iter().filter(unknown).count() as f64 / places.len().max(1) as f64
    }

    /// Source of the heights, in words.
    pub fn words(&self, route: &Route, units: Units) -> String {
        let (factor, unit) = units.length();
        let level = format!("level at {:.0} {unit} AMSL", self.level * factor);
        let Some(grid) = self.terrain.heights() else {
            return format!("{level}, no elevation model is open");
        };
        let name = grid.name();
        let share = self.unknown(route);
        if share >= 1.0 {
            return format!("{level}, {name} does not reach here");
        }
        let words = format!("{name}, heights above {}", grid.datum().name());
        if share > 0.0 {
            let percent = (100.0 * share).ceil();
            return format!("{words}; {level} on the {percent:.0} % of the route beyond it");
        }
        words
    }

    /// Assumptions about the ground behind a prediction along a route, in sentences.
    pub fn assumptions(&self, route: &Route, units: Units) -> Vec<String> {
        let mut list = vec![format!("Ground: {}.", self.words(route, units))];
        let frames = |f: AltitudeFrame| route.way_points.iter().any(|w| w.altitude.frame == f);
        let Some(grid) = self.terrain.heights() else {
            return list;
        };
        list.push(
            "The height above ground follows the elevation model along the route; the ground within \
             a picture counts as level."
                .to_owned(),
        );
        if frames(AltitudeFrame::AboveTakeOff) {
            let (factor, unit) = units.length();
            let place = self.take_off_place(route);
            let first = route.way_points.first().map(|w| w.position);
            let place = if place == first {
                "the first way-point"
            } else {
                "home"
            };
            list.push(format!(
                "Take-off is at {place}, {:.0} {unit} {}.",
                self.take_off(route) * factor,
                self.frame()
            ));
        }
        if frames(AltitudeFrame::Amsl) && !matches!(grid.datum(), HeightDatum::MeanSeaLevel(_)) {
            list.push(format!(
                "AMSL altitudes are compared with heights {} as they are: they may be tens of metres off.",
                self.frame()
            ));
        }
        list
    }
}

/// Places along a route.
fn places(route: &Route) -> Vec<GroundPoint> {
    let level = profile(route, &|_| 0.0, 0.0, f64::INFINITY);
    level.into_iter().map(|s| s.place).collect()
}

/// Draws where the height of the ground comes from, and the height of level ground where it counts.
pub fn ground(ui: &mut Ui, relief: &Relief<'_>, route: &Route, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    let (factor, unit) = context.units.length();
    ui.horizontal(|ui| {
        caption(ui, tokens, "Height of the ground");
        if relief.is_level() || relief.unknown(route) > 0.0 {
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let mut height = relief.level;
                let field = NumberField::new(-500.0..=9000.0).unit((factor, unit));
                let field = field.suffix(format!(" {unit} AMSL"));
                let field = field.show(ui, &mut height);
                let field = field.accessible_name("Height of level ground");
                if field.changed() {
                    let command = PlanCommand::SetGround {
                        height,
                        finished: !field.dragged(),
                    };
                    context.commands.push(Command::from(command));
                }
                ui.label(muted(tokens, "level at"));
            });
        }
    });
    if !relief.is_level() {
        ui.label(muted(tokens, relief.words(route, context.units)));
    }
}

#[cfg(test)]
#[path = "relief_tests.rs"]
mod tests;
