//! Simulated flights over the generated scenery.

use std::sync::Arc;

use pilotage_core::flight::{Flight, FrameError, FrameSource};
use pilotage_core::frames::GroundRect;
use pilotage_core::imagery::{Imagery, Window};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{MapReference, Mission};
use pilotage_core::navigator::NavigatorSettings;
use pilotage_core::raster::{Picture, encode_jpeg};
use pilotage_core::simulate::scenery::{DEMO_SEED, Day, Scenery};
use pilotage_core::simulate::{Overrides, Scenario, Wind, world_origin};

use super::SimulationOptions;
use super::flights::{KeptFrames, OpenFlight};

/// The map of the built-in scenarios.
pub fn scenery_map() -> Arc<dyn Imagery> {
    Arc::new(Scenery::new(DEMO_SEED, Day::map_day()))
}

/// Flies a scenario; pictures are taken when they are asked for.
pub fn open(options: &SimulationOptions) -> Result<OpenFlight, String> {
    let scenario = Scenario::named(&options.scenario).ok_or_else(|| {
        let known: Vec<_> = Scenario::all().iter().map(|s| s.name).collect();
        format!(
            "there is no scenario “{}”; there are {}",
            options.scenario,
            known.join(", ")
        )
    })?;
    let overrides = Overrides {
        wind: options.wind.map(|(from, speed)| Wind { from, speed }),
        height: options.height,
        sensors: None,
    };
    let flight = scenario.fly(options.seed, &overrides);
    let day = if options.other_day {
        Day::other_day()
    } else {
        Day::map_day()
    };
    let scenery = Scenery::new(DEMO_SEED, day);
    let mission = mission(&scenario, &scenery);
    let camera = AerialCamera {
        flight: flight.clone(),
        scenery,
    };
    Ok(OpenFlight {
        frames: KeptFrames::new(&flight, Box::new(camera)),
        flight: Arc::new(flight),
        mission: Some(mission),
    })
}

/// The mission that belongs to a scenario: its landmarks, in the order in which they are met.
fn mission(scenario: &Scenario, scenery: &Scenery) -> Mission {
    let landmarks = scenery
        .distinct_features()
        .into_iter()
        .zip(1..)
        .map(|(feature, id)| Landmark::new(id, feature.name, feature.landmark_box))
        .collect();
    Mission {
        name: scenario.title.to_owned(),
        origin: world_origin(),
        map: Some(MapReference::Scenario(scenario.name.to_owned())),
        landmarks,
        camera: None,
        navigator: NavigatorSettings::default(),
        properties: std::collections::BTreeMap::new(),
    }
}

struct AerialCamera {
    flight: Flight,
    scenery: Scenery,
}

impl FrameSource for AerialCamera {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        let pose = self
            .flight
            .truth
            .as_ref()
            .and_then(|t| t.frames.get(index)?.pose())
            .ok_or(FrameError::OutOfRange(index))?;
        let camera = &self.flight.camera;
        let down = self.flight.ground_down;
        let unseen = || FrameError::OutOfRange(index);
        let rect = GroundRect::around(camera.footprint(&pose, down)).ok_or_else(unseen)?;
        let gsd = (down - pose.position_in_world.z) / camera.focal;
        let window = Window::covering(&rect.grown(2.0 * gsd), gsd);
        let ground = self.scenery.window(&window).map(|[r, g, b, _]| [r, g, b]);
        Ok(Picture::from_fn(camera.width, camera.height, |c, r| {
            let pixel = nalgebra::Point2::new(c as f64 + 0.5, r as f64 + 0.5);
            camera
                .ground_at(&pose, &pixel, down)
                .and_then(|p| {
                    let (x, y) = window.pixel_at(&p);
                    ground.sample(x, y)
                })
                .unwrap_or_default()
        }))
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        encode_jpeg(&self.picture(index)?, 85).map_err(|cause| FrameError::Unreadable {
            name: index.to_string(),
            cause: cause.to_string(),
        })
    }
}
