//! The mission.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{FrameLabels, NoFlyZone, RallyPoint, Route};
use crate::settings::{CameraAdjustment, NavigatorSettings};
use pilotage_base::frames::{AltitudeReference, Geodetic};
use pilotage_flight::Flight;
use pilotage_raster::camera::CameraModel;
use pilotage_roads::SharedRoads;
use pilotage_vision::landmark::Landmark;

/// Member of the file with the height of level ground, metres above mean sea level. The world's plane
/// stays where its origin is, whatever the ground is said to be.
const GROUND: &str = "ground_height_m";

/// Map that the mission was made on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum MapReference {
    /// A built-in scenario's generated scenery, by the scenario's name.
    Scenario(String),
    /// A picture file with a georeference, by file name.
    Picture(String),
}

/// Mission: places to be flown over, and the settings to navigate by.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mission {
    /// Name for people.
    pub name: String,
    /// Origin of the world frame on the globe.
    pub origin: Geodetic,
    /// The map on which the landmarks were picked.
    pub map: Option<MapReference>,
    /// Landmarks, in the order of the list.
    pub landmarks: Vec<Landmark>,
    /// Routes, in the order of the list.
    pub routes: Vec<Route>,
    /// Areas that must not be flown over.
    #[serde(default)]
    pub no_fly: Vec<NoFlyZone>,
    /// Places to which the aircraft may go and land when it cannot go on.
    #[serde(default)]
    pub rally: Vec<RallyPoint>,
    /// Roads; shared points join them.
    #[serde(default)]
    pub roads: SharedRoads,
    /// Labels that people gave the pictures of flights, in the order of the pictures' names.
    #[serde(default)]
    pub labels: Vec<FrameLabels>,
    /// Camera, where the mission states one (otherwise the flight's).
    pub camera: Option<CameraModel>,
    /// Adjustment of that camera and of the times of its pictures, so that they go with the flight's log.
    #[serde(default)]
    pub camera_to_log: Option<CameraAdjustment>,
    /// Settings of the navigator.
    pub navigator: NavigatorSettings,
    /// Members of the file that we do not know, by name, as JSON text.
    pub properties: BTreeMap<String, String>,
}

impl Mission {
    /// A mission with nothing in it, around `origin`.
    ///
    /// ```
    /// use pilotage_base::frames::{Geodetic, GroundPoint, GroundRect};
    /// use pilotage_mission::mission::Mission;
    /// use pilotage_vision::landmark::Landmark;
    ///
    /// let mut mission = Mission::new("River", Geodetic::from_degrees(46.8, -92.0, 183.0));
    /// let bounds = GroundRect::centered(GroundPoint::new(0.0, 0.0), 40.0, 40.0);
    /// mission.landmarks.push(Landmark::new(mission.free_landmark_id(), "Bridge", bounds));
    /// assert_eq!(mission.landmark(1).map(|l| l.name.as_str()), Some("Bridge"));
    /// assert_eq!(mission.free_landmark_id(), 2);
    /// // Where no terrain model says it, the ground is as high as the origin.
    /// assert_eq!(mission.level_ground().ground, 183.0);
    /// ```
    pub fn new(name: impl Into<String>, origin: Geodetic) -> Self {
        Self {
            name: name.into(),
            origin,
            map: None,
            landmarks: Vec::new(),
            routes: Vec::new(),
            no_fly: Vec::new(),
            rally: Vec::new(),
            roads: SharedRoads::default(),
            labels: Vec::new(),
            camera: None,
            camera_to_log: None,
            navigator: NavigatorSettings::default(),
            properties: BTreeMap::new(),
        }
    }

    /// The flight as it is flown in this mission: with the mission's camera, put beside the log as the mission
    /// says.
    pub fn flown(&self, flight: &Arc<Flight>) -> Arc<Flight> {
        let mut flown = Arc::clone(flight);
        if let Some(camera) = &self.camera {
            Arc::make_mut(&mut flown).camera = camera.clone();
        }
        match &self.camera_to_log {
            Some(change) => Arc::new(change.apply(&flown)),
            None => flown,
        }
    }

    /// Height of level ground that was stated for where no elevation model says it, metres above mean
    /// sea level.
    pub fn stated_ground(&self) -> Option<f64> {
        let stated: f64 = self.properties.get(GROUND)?.trim().parse().ok()?;
        stated.is_finite().then_some(stated)
    }

    /// The route of that name.
    ///
    /// # Errors
    /// Where there is none, with the names that there are, and where there are several.
    pub fn route_named(&self, name: &str) -> Result<&Route, String> {
        let routes = &self.routes;
        let found: Vec<&Route> = routes.iter().filter(|route| route.name == name).collect();
        match &found[..] {
            [only] => Ok(only),
            [] => {
                let names = routes.iter().map(|route| format!("\"{}\"", route.name));
                let names = match names.collect::<Vec<_>>().join(", ") {
                    none if none.is_empty() => "none at all".to_owned(),
                    names => names,
                };
                Err(format!(
                    "the mission has no route \"{name}\"; it has: {names}"
                ))
            }
            several => Err(format!(
                "{} of its routes are called \"{name}\"; give each a name of its own",
                several.len()
            )),
        }
    }

    /// States the height of level ground, metres above mean sea level.
    pub fn state_ground(&mut self, height: f64) {
        self.properties
            .insert(GROUND.to_owned(), height.to_string());
    }

    /// Level ground at the stated height, or else at that of the mission's origin, where it takes off.
    pub fn level_ground(&self) -> AltitudeReference {
        let height = self.level_ground_under(0.0);
        AltitudeReference {
            take_off: height,
            ground: height,
        }
    }

    /// Height of level ground, metres above mean sea level: as stated, or else that of a plane `ground_down` metres below
    /// the origin.
    pub fn level_ground_under(&self, ground_down: f64) -> f64 {
        let stated = self.stated_ground();
        stated.unwrap_or(self.origin.height - ground_down)
    }

    /// An id that no landmark of the mission has, and none that labels of pictures tell of.
    pub fn free_landmark_id(&self) -> u32 {
        let told = self.labels.iter().flat_map(FrameLabels::landmarks);
        let taken = self.landmarks.iter().map(|l| l.id).chain(told);
        taken.max().map_or(1, |id| id.saturating_add(1))
    }

    /// The name `wanted`, or another if a rally point of the mission has it.
    pub fn free_rally_name(&self, wanted: &str) -> String {
        let is_free = |name: &str| self.rally.iter().all(|point| point.name != name);
        if is_free(wanted) {
            return wanted.to_owned();
        }
        let mut names = (1..).map(RallyPoint::usual_name);
        names.find(|name| is_free(name)).unwrap_or_default()
    }

    /// The landmark with that id.
    pub fn landmark(&self, id: u32) -> Option<&Landmark> {
        self.landmarks.iter().find(|l| l.id == id)
    }
}
