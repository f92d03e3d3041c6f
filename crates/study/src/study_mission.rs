//! Missions as studies fly them: their routes, and by what is navigated, without map and pictures.

use std::collections::BTreeMap;

use pilotage_core::camera::CameraModel;
use pilotage_core::frames::{Altitude, AltitudeFrame, Geodetic, GroundPoint, LocalFrame};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{Mission, Route, read_mission, write_mission};
use pilotage_core::navigator::{ChosenAid, NavigatorSettings};
use pilotage_core::plan::{FlownWay, RouteGround, cruise, longest_flight, planned_aircraft};
use pilotage_core::simulate::{FlightPlan, Scenario, Target};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::run_settings::RunSettings;

/// Mission in a plan: a text, GeoJSON. Whoever has the plan needs no other file, and reads the same numbers to the bit;
/// whoever only hands it on, as the page does, links no reader of missions.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanMission {
    text: String,
    /// Names of its routes that lead somewhere, and the time that each takes in calm air, seconds.
    routes: Vec<(String, f64)>,
}

impl PlanMission {
    /// Part of a mission that studies need: its routes, the landmarks that are switched on without their detectors, its
    /// camera and the settings of its navigator.
    pub fn of(mission: &Mission) -> Self {
        let mut kept = Mission::new(mission.name.clone(), mission.origin);
        let on = mission.landmarks.iter().filter(|landmark| landmark.enabled);
        kept.landmarks = on
            .map(|landmark| Landmark {
                properties: BTreeMap::new(),
                ..landmark.clone()
            })
            .collect();
        kept.routes.clone_from(&mission.routes);
        kept.camera.clone_from(&mission.camera);
        kept.navigator = mission.navigator.clone();
        if let Some(height) = mission.stated_ground() {
            kept.state_ground(height);
        }
        let text = write_mission(&kept);
        // As it is read back, for places pass through degrees.
        let kept = read_mission(text.as_bytes()).unwrap_or(kept);
        Self::of_text(text, &kept)
    }

    fn of_text(text: String, mission: &Mission) -> Self {
        let named = mission.routes.iter().filter_map(|route| {
            let flown = StudyMission::along_route(mission, route, None).ok()?;
            Some((route.name.clone(), flown.lasts()))
        });
        Self {
            routes: named.collect(),
            text,
        }
    }

    /// A mission that was read before, by its parts.
    pub(crate) fn of_parts((text, routes): PlanMissionParts) -> Self {
        Self { text, routes }
    }

    /// Its text, and its routes.
    pub(crate) fn into_parts(self) -> PlanMissionParts {
        (self.text, self.routes)
    }

    /// The mission.
    ///
    /// # Errors
    /// Where the text is no mission, in words.
    pub fn read(&self) -> Result<Mission, String> {
        read_mission(self.text.as_bytes()).map_err(|why| why.to_string())
    }

    /// Its text, GeoJSON.
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// The mission along the route of that name, or else the first one.
    pub(crate) fn along(&self, route: Option<&str>) -> FlownMission {
        let mut routes = self.routes.iter();
        let found = match route {
            Some(name) => routes.find(|(own, _)| own == name),
            None => routes.next(),
        };
        FlownMission {
            text: self.text.clone(),
            route: route.map(str::to_owned),
            lasts: found.map_or(f64::INFINITY, |(_, lasts)| *lasts),
        }
    }
}

/// Text of a mission, and its routes with their times.
pub(crate) type PlanMissionParts = (String, Vec<(String, f64)>);

/// Mission of a flight of a study, still as text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlownMission {
    text: String,
    route: Option<String>,
    /// Time in calm air, seconds.
    pub lasts: f64,
}

impl FlownMission {
    /// The mission as it is flown, at `height` metres above ground where one is given.
    ///
    /// # Errors
    /// Where it cannot be read or flown, in words.
    pub fn read(&self, height: Option<f64>) -> Result<StudyMission, String> {
        let mission = read_mission(self.text.as_bytes()).map_err(|why| why.to_string())?;
        StudyMission::along(&mission, self.route.as_deref(), height)
    }
}

impl Serialize for PlanMission {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(&self.text)
    }
}

impl<'d> Deserialize<'d> for PlanMission {
    fn deserialize<D: Deserializer<'d>>(from: D) -> Result<Self, D::Error> {
        let text = String::deserialize(from)?;
        let mission = read_mission(text.as_bytes()).map_err(D::Error::custom)?;
        Ok(Self::of_text(text, &mission))
    }
}

/// A route of a mission as a study flies it, over level ground, and what is navigated by.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyMission {
    origin: Geodetic,
    way: Vec<GroundPoint>,
    /// Height above ground, metres, and airspeed at each place of the way.
    targets: Vec<Target>,
    camera: CameraModel,
    /// Landmarks that are looked for.
    pub landmarks: Vec<Landmark>,
    navigator: NavigatorSettings,
}

impl StudyMission {
    /// The route of that name, or else the first one, at `height` metres above ground where one is given.
    ///
    /// # Errors
    /// Where there is no such route, more than one has that name or it leads nowhere, in words.
    pub fn along(
        mission: &Mission,
        route: Option<&str>,
        height: Option<f64>,
    ) -> Result<Self, String> {
        let route = match route {
            Some(name) => mission.route_named(name)?,
            None => (mission.routes.first()).ok_or("the mission has no route to fly")?,
        };
        Self::along_route(mission, route, height)
    }

    fn along_route(mission: &Mission, route: &Route, height: Option<f64>) -> Result<Self, String> {
        let mut route = route.clone();
        if let Some(metres) = height {
            let stated = Altitude::new(metres, AltitudeFrame::AboveGround);
            let all = route.way_points.iter_mut();
            all.for_each(|way_point| way_point.altitude = stated);
        }
        let level = mission.level_ground_under(0.0);
        let ground = RouteGround {
            height_at: &|_| level,
            take_off: level,
            is_level: true,
        };
        let frame = LocalFrame::new(mission.origin);
        let way = FlownWay::along(&route, &frame, &ground, planned_aircraft().bank_limit);
        let leads_on = way.places.windows(2).any(|pair| pair[0] != pair[1]);
        if !leads_on {
            return Err("the route needs two way-points in different places".to_owned());
        }
        let on = mission.landmarks.iter().filter(|landmark| landmark.enabled);
        Ok(Self {
            origin: mission.origin,
            way: way.places,
            targets: way.targets,
            camera: mission.camera.clone().unwrap_or_else(Scenario::camera),
            landmarks: on.cloned().collect(),
            navigator: mission.navigator.clone(),
        })
    }

    /// Mean height above ground at the places of the way, metres.
    pub fn height(&self) -> f64 {
        let heights = self.targets.iter().map(|target| target.height);
        heights.sum::<f64>() / self.targets.len().max(1) as f64
    }

    /// Time in calm air, seconds.
    pub fn lasts(&self) -> f64 {
        let legs = self.way.windows(2);
        legs.map(|pair| pair[0].distance(&pair[1])).sum::<f64>() / cruise()
    }

    /// Settings of the navigator, as the mission states them.
    pub(crate) fn navigator(&self) -> &NavigatorSettings {
        &self.navigator
    }

    /// Aids that the mission switches on and a study can read, with their numbers.
    pub(crate) fn read_aids(&self) -> Vec<ChosenAid> {
        let aids = self.navigator.aids.iter().cloned();
        aids.filter(RunSettings::reads).collect()
    }

    /// The plan of a flight in the wind and with the sensors of `plan`, along this way, for `seconds` at most.
    pub(crate) fn flown(&self, plan: FlightPlan, seconds: f64) -> FlightPlan {
        FlightPlan {
            way_points: self.way.clone(),
            height: self.height(),
            targets: self.targets.clone(),
            longest: longest_flight(&self.way, cruise()).min(seconds),
            airframe: planned_aircraft(),
            camera: self.camera.clone(),
            frame_on_globe: LocalFrame::new(self.origin),
            ..plan
        }
    }

    /// The mission to which the flight belongs, without its route.
    pub fn mission(&self, navigator: NavigatorSettings) -> Mission {
        Mission {
            landmarks: self.landmarks.clone(),
            navigator,
            ..Mission::new(String::new(), self.origin)
        }
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::frames::GroundRect;
    use pilotage_core::mission::WayPoint;

    use super::*;
    use crate::{Study, StudyError, StudyPlan};

    fn mission() -> Mission {
        let mut mission = Mission::new("River", Geodetic::from_degrees(46.8, -92.0, 183.0));
        mission.camera = Some(Scenario::camera());
        for (id, north) in [(1, 200.0), (2, 500.0), (3, 800.0)] {
            let bounds = GroundRect::centered(GroundPoint::new(north, 0.0), 40.0, 40.0);
            mission
                .landmarks
                .push(Landmark::new(id, format!("Barn {id}"), bounds));
        }
        let altitude = Altitude::new(300.0, AltitudeFrame::Amsl);
        let route = |name: &str, north: &[f64]| Route {
            name: name.to_owned(),
            way_points: (north.iter())
                .map(|north| WayPoint::new(GroundPoint::new(*north, 10.0), altitude))
                .collect(),
            ..Route::default()
        };
        mission.routes.push(route("Out", &[0.0, 1000.0]));
        mission.routes.push(route("Away", &[0.0, -1000.0]));
        mission.routes.push(route("Nowhere", &[0.0]));
        mission
    }

    fn plan(more: &str) -> Result<StudyPlan, StudyError> {
        let text = format!(
            r#"
            name = "routes"
            question = "Which way is better known?"
            draws = 3
            {more}
            measure = [{{ of = "error-rms" }}, {{ of = "frames-used" }}]
            "#
        );
        StudyPlan::read_with(&text, &mut |name| match name {
            "river.geojson" => Ok(mission()),
            other => Err(format!("{other}: there is no such file")),
        })
    }

    #[test]
    fn routes_of_a_mission_are_compared_and_the_one_over_landmarks_is_known_better() {
        let plan = plan(
            "fixed = { mission = \"river.geojson\", step = 0.2 }\ncross.route = [\"Out\", \"Away\"]",
        );
        let study = Study::new(plan.unwrap()).unwrap();
        for draw in 0..3 {
            let [out, away] = [2 * draw, 2 * draw + 1].map(|run| study.fly(run).unwrap().measured);
            assert!(
                out[1] > Some(10.0) && away[1] == Some(0.0),
                "{out:?} {away:?}"
            );
            assert!(out[0] < away[0], "{out:?} {away:?}");
        }
        // At 300 m above the sea over ground at 183 m, for all of its kilometre.
        let flight = study.design().run(0).unwrap().flight();
        let prepared = flight.prepare().unwrap();
        assert!((prepared.mission.unwrap().height() - 117.0).abs() < 0.1);
        let flown = prepared.flight;
        let last = flown.truth.as_ref().unwrap().states.last().unwrap();
        assert!(
            (last.position.x - 1000.0).abs() < 60.0,
            "{:?}",
            last.position
        );
        assert!(
            (flight.lasts() - 1000.0 / cruise()).abs() < 1e-3,
            "{}",
            flight.lasts()
        );
    }

    #[test]
    fn a_plan_with_its_missions_in_it_needs_no_file_and_flies_the_same() {
        let more = "fixed = { mission = \"river.geojson\", height = 150, told = \"no\" }";
        let plan = plan(more).unwrap();
        assert!(plan.notes().is_empty());
        let packed = plan.to_toml().unwrap();
        let again = StudyPlan::read(&packed).unwrap();
        assert_eq!(again, plan);
        let [one, other] = [plan, again].map(|plan| Study::new(plan).unwrap().fly(1).unwrap());
        assert_eq!(one, other);
        // Through JSON, as the folder of a study has it, and over the wire to a worker.
        let json = serde_json::to_string(&StudyPlan::read(&packed).unwrap()).unwrap();
        assert_eq!(
            serde_json::from_str::<StudyPlan>(&json).unwrap(),
            StudyPlan::read(&packed).unwrap()
        );
    }

    #[test]
    fn a_mission_is_navigated_as_it_states_unless_the_plan_tells_the_filter_of_the_sensors() {
        let settings = |more: &str| {
            let fixed = format!("fixed = {{ mission = \"river.geojson\"{more} }}");
            let study = Study::new(plan(&fixed).unwrap()).unwrap();
            let flight = study.design().run(0).unwrap().flight();
            flight.prepare().unwrap().settings
        };
        let stated = mission().navigator;
        let (own, told) = (
            settings(""),
            settings(", told = \"yes\", noise-heading = 3"),
        );
        assert_eq!(
            (own.vehicle, own.process, own.start),
            (stated.vehicle, stated.process, stated.start)
        );
        assert_ne!(told.process, stated.process);
        assert!(told.sensors.yaw > 3_f64.to_radians());
        let bare = StudyPlan::read_with(
            "name = \"a\"\nquestion = \"?\"\ndraws = 1\nfixed.mission = \"a\"\nmeasure = [{ of = \"error-rms\" }]",
            &mut |_| {
                Ok(Mission {
                    landmarks: Vec::new(),
                    ..mission()
                })
            },
        );
        assert!(bare.unwrap().notes()[0].contains("dead reckoning alone"));
    }

    #[test]
    fn what_cannot_be_flown_of_a_mission_is_refused_before_the_study_begins() {
        for (more, words) in [
            (
                "fixed.mission = \"lake.geojson\"",
                "lake.geojson: there is no such file",
            ),
            (
                "fixed = { mission = \"river.geojson\", route = \"Back\" }",
                "no route \"Back\"; it has: \"Out\"",
            ),
            (
                "fixed = { mission = \"river.geojson\", route = \"Nowhere\" }",
                "two way-points",
            ),
            (
                "fixed = { mission = \"river.geojson\", scenario = \"distinct-400ft-calm\" }",
                "not both",
            ),
            ("fixed.route = \"Out\"", "say the mission"),
            ("fixed.mission = \"\"", "there is no such file"),
        ] {
            let why = plan(more).unwrap_err().to_string();
            assert!(why.contains(words), "{why}");
        }
    }
}
