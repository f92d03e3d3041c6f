//! A toy world: a salt flat with a painted cross, over which an aeroplane flies straight on.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::flight::FlightPlan;
use super::flight_frames::{SimulatedFlight, SimulatedFrames};
use super::scenario::{Overrides, Scenario, Wind, world_origin};
use super::scenery::Scenery;
use super::sensors::SensorSpec;
use super::world::{LaidWorld, LayOut, SimulationChoice, World};
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_mission::mission::{MapReference, Mission};
use pilotage_mission::settings::NavigatorSettings;
use pilotage_raster::imagery::{CachedImagery, Imagery, Window};
use pilotage_raster::raster::{Raster, Rgba};
use pilotage_vision::landmark::Landmark;

const NAME: &str = "salt-flat";
const TITLE: &str = "Straight over a salt flat, 100 m, calm";
/// Half the side of the flat, metres.
const REACH: f64 = 600.0;
/// Height of the flight above ground, metres.
const HEIGHT: f64 = 100.0;
/// Half the length and half the width of the beams of the cross around the origin, metres.
const BEAM: (f64, f64) = (12.0, 4.0);

/// The salt flat.
#[derive(Debug)]
pub(super) struct SaltFlat;

/// Its scenario in the generated country, of which only the name and the way-points differ.
fn plan(overrides: &Overrides) -> FlightPlan {
    FlightPlan {
        name: NAME.to_owned(),
        way_points: SaltFlat.route(NAME).unwrap_or_default(),
        height: overrides.height.unwrap_or(HEIGHT),
        ..Scenario::all()[0].plan(overrides)
    }
}

impl World for SaltFlat {
    fn key(&self) -> &'static str {
        NAME
    }

    fn place(&self) -> &'static str {
        "the salt flat"
    }

    fn flights(&self) -> Vec<SimulationChoice> {
        vec![SimulationChoice {
            name: NAME,
            title: TITLE,
            description: "Northward over a painted cross on a salt flat.",
            height: HEIGHT,
            wind: Wind::default(),
            world: &Self,
        }]
    }

    fn navigator(&self, _: &str) -> NavigatorSettings {
        Scenario::all()[0].navigator(&SensorSpec::default())
    }

    fn route(&self, _: &str) -> Option<Vec<GroundPoint>> {
        Some(
            [-400.0, 400.0]
                .map(|north| GroundPoint::new(north, 0.0))
                .to_vec(),
        )
    }

    fn is_variable(&self) -> bool {
        true
    }

    fn is_shown_whole(&self) -> bool {
        true
    }
}

impl LayOut for SaltFlat {
    fn lay_out(&self) -> Arc<dyn LaidWorld> {
        Arc::new(Self)
    }
}

impl LaidWorld for SaltFlat {
    fn map(&self) -> Arc<dyn Imagery> {
        Arc::new(Self)
    }

    fn scenery(&self) -> Option<Scenery> {
        None
    }

    fn fly(&self, flight: &str, seed: u64, overrides: &Overrides) -> Option<SimulatedFlight> {
        if flight != NAME {
            return None;
        }
        let flight = plan(overrides).simulate(seed)?;
        let day = overrides.day.unwrap_or_default();
        let ground = Arc::new(CachedImagery::new(self.map(), 8));
        Some(SimulatedFlight {
            frames: SimulatedFrames::new(&flight, day, seed).over(ground),
            flight,
            seed,
            day,
        })
    }

    fn missions(&self, flight: &str, overrides: &Overrides) -> Vec<(&'static str, Mission)> {
        let own = self.flights().into_iter().filter(|own| own.name == flight);
        own.map(|choice| {
            let cross = GroundRect::centered(GroundPoint::default(), 34.0, 34.0);
            let mission = Mission {
                name: TITLE.to_owned(),
                origin: world_origin(),
                map: Some(MapReference::Picture("map.png".to_owned())),
                landmarks: vec![Landmark::new(1, "cross", cross)],
                routes: choice.route(overrides.height).into_iter().collect(),
                no_fly: Vec::new(),
                rally: Vec::new(),
                roads: Vec::new().into(),
                labels: Vec::new(),
                camera: Some(Scenario::camera()),
                camera_to_log: None,
                navigator: choice.navigator(),
                properties: BTreeMap::new(),
            };
            ("mission.geojson", mission)
        })
        .collect()
    }
}

impl Imagery for SaltFlat {
    fn name(&self) -> &'static str {
        "salt flat"
    }

    fn bounds(&self) -> GroundRect {
        GroundRect::centered(GroundPoint::default(), 2.0 * REACH, 2.0 * REACH)
    }

    fn native_gsd(&self) -> f64 {
        0.25
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        let (length, width) = BEAM;
        Raster::from_fn(window.width, window.height, |column, row| {
            let place = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
            let (north, east) = (place.north.abs(), place.east.abs());
            let is_cross = north.max(east) < length && north.min(east) < width;
            if is_cross {
                [40, 60, 160, 255]
            } else {
                [225, 220, 205, 255]
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_camera_sees_blue_only_over_the_cross() {
        let mut flown = SaltFlat.fly(NAME, 1, &Overrides::default()).unwrap();
        let states = flown.flight.truth.clone().unwrap();
        let blue = |index: usize, frames: &mut SimulatedFrames| {
            let picture = frames.frame(index).unwrap().picture;
            let (x, y) = (picture.width() / 2, picture.height() / 2);
            let [red, _, blue] = picture.get(x, y);
            blue > red
        };
        let place = |i: usize| states.position(flown.flight.frames[i].time).unwrap();
        let nearest = |north: f64| {
            let all = 0..flown.flight.frames.len();
            all.min_by(|a, b| {
                let off = |i: &usize| (place(*i).x - north).abs();
                off(a).total_cmp(&off(b))
            })
        };
        let (over, before) = (nearest(0.0).unwrap(), nearest(-200.0).unwrap());
        assert!(blue(over, &mut flown.frames));
        assert!(!blue(before, &mut flown.frames));
    }
}
