//! Simulated flights over the generated scenery.

use std::sync::Arc;

use pilotage_core::flight::{Flight, FrameError, FrameSource};
use pilotage_core::frames::{GroundPoint, GroundRect};
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

/// Side of the blocks in which the ground is computed, pixels.
const BLOCK: usize = 64;

impl AerialCamera {
    /// The ground of `window`, computed only where a block may touch the convex `footprint`.
    fn ground(&self, window: &Window, footprint: &[GroundPoint]) -> Picture {
        let mut ground = Picture::filled(window.width, window.height, [0; 3]);
        for top in (0..window.height).step_by(BLOCK) {
            for left in (0..window.width).step_by(BLOCK) {
                let block = Window {
                    north_edge: window.north_edge - top as f64 * window.gsd,
                    west_edge: window.west_edge + left as f64 * window.gsd,
                    width: BLOCK.min(window.width - left),
                    height: BLOCK.min(window.height - top),
                    ..*window
                };
                if !may_touch(&block.rect().grown(2.0 * window.gsd), footprint) {
                    continue;
                }
                let pixels = self.scenery.window(&block);
                for row in 0..block.height {
                    let target = &mut ground.row_mut(top + row)[left..][..block.width];
                    for (pixel, [r, g, b, _]) in target.iter_mut().zip(pixels.row(row)) {
                        *pixel = [*r, *g, *b];
                    }
                }
            }
        }
        ground
    }
}

/// False if one edge of the convex outline has the whole rectangle on its outer side.
fn may_touch(rect: &GroundRect, outline: &[GroundPoint]) -> bool {
    let center = rect.center().to_vector();
    let half = nalgebra::Vector2::new(0.5 * rect.height(), 0.5 * rect.width());
    let middle = outline
        .iter()
        .map(|p| p.to_vector())
        .sum::<nalgebra::Vector2<f64>>()
        / outline.len().max(1) as f64;
    outline.iter().enumerate().all(|(i, a)| {
        let (a, b) = (a.to_vector(), outline[(i + 1) % outline.len()].to_vector());
        let along = b - a;
        let mut outward = nalgebra::Vector2::new(along.y, -along.x);
        if outward.dot(&(middle - a)) > 0.0 {
            outward = -outward;
        }
        // The corner of the rectangle that lies farthest inward.
        let inward = outward.dot(&(center - a)) - outward.abs().dot(&half);
        inward <= 0.0
    })
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
        let footprint = camera.footprint(&pose, down);
        let rect = GroundRect::around(footprint.iter().copied()).ok_or_else(unseen)?;
        let gsd = (down - pose.position_in_world.z) / camera.focal;
        let window = Window::covering(&rect.grown(2.0 * gsd), gsd);
        let ground = self.ground(&window, &footprint);
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
