//! `pilotage simulate` over a map of one's own.

use std::path::PathBuf;
use std::sync::Arc;

use pilotage_core::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
use pilotage_core::imagery::Imagery;
use pilotage_core::plan::{OtherDays, PictureDays, SceneryDays};
use pilotage_core::simulate::{FlightDay, FlightPlan, Overrides, Scenario, Wind};

use pilotage_jobs::{MapSource, OpenFlight, fly_plan};

use crate::files::MAP_CACHE;
use crate::numbers::numbers;
use crate::plan::{PlanSource, PlannedFlight};

/// Height of a flight without a mission, metres above ground.
const HEIGHT: f64 = 120.0;
/// Share of the map that lies within the way-points where none are stated, along each side.
const AROUND: f64 = 0.5;

/// A flight over a map of one's own: which, and where.
#[derive(clap::Args)]
pub struct OwnMap {
    /// A map of your own to fly over: any that `pilotage map info` knows.
    #[arg(long)]
    pub map: Option<PathBuf>,
    /// A mission whose first route is flown with its camera; over the map that it holds, or --map.
    #[arg(long)]
    pub mission: Option<PathBuf>,
    /// Way-points over the map, degrees, in place of a mission; once around the middle of the map if absent.
    #[arg(
        long,
        value_name = "LAT,LON;…",
        requires = "map",
        conflicts_with = "mission",
        allow_hyphen_values = true
    )]
    pub route: Option<String>,
    /// Height above ground, metres; without a mission 120.
    #[arg(long, conflicts_with = "scenario")]
    pub height: Option<f64>,
    /// An elevation model of the ground below the mission's route; level where it says nothing.
    #[arg(long, value_name = "FILE", requires = "mission")]
    pub dem: Option<PathBuf>,
    /// Mean wind, degrees from which it blows and m/s.
    #[arg(long, value_name = "FROM,SPEED", conflicts_with = "scenario")]
    pub wind: Option<String>,
}

/// Route, map and days of such a flight.
struct OwnRouteAndMap {
    plan: FlightPlan,
    map: Arc<dyn Imagery>,
    days: Box<dyn OtherDays>,
}

/// Flies over it.
///
/// # Errors
/// A map or mission that cannot be read, or a route of fewer than two way-points.
pub fn fly(
    own: &OwnMap,
    seed: u64,
    day: FlightDay,
) -> Result<OpenFlight, Box<dyn std::error::Error>> {
    let OwnRouteAndMap {
        mut plan,
        map,
        days,
    } = match (&own.mission, &own.map) {
        (Some(_), _) => by_mission(own)?,
        (None, Some(map)) => by_map(own, crate::files::open_map_with_frame(map, MAP_CACHE)?)?,
        (None, None) => return Err("say --map or --mission".into()),
    };
    if let Some(text) = &own.wind {
        let [from, speed] = numbers(text, "--wind")?;
        let from = from.to_radians();
        plan.wind = Wind { from, speed }.velocity();
    }
    let ground: Arc<dyn Imagery> = match day {
        FlightDay::Same => map,
        FlightDay::Other | FlightDay::LateWinter | FlightDay::EarlySpring => days.drawn(seed),
    };
    Ok(fly_plan(&plan, ground, day, seed)?)
}

fn by_mission(own: &OwnMap) -> Result<OwnRouteAndMap, Box<dyn std::error::Error>> {
    let ground = PlannedFlight::at(&PlanSource {
        scenario: None,
        mission: own.mission.clone(),
        map: own.map.clone(),
        flight: None,
        height: own.height,
        dem: own.dem.clone(),
    })?;
    let plan = ground
        .plan
        .ok_or("the mission has no route to fly; add one, or leave it out and say --route")?;
    let route = ground.mission.routes.first();
    let plan = FlightPlan {
        name: route.map_or_else(String::new, |route| route.name.clone()),
        frame_on_globe: LocalFrame::new(ground.mission.origin),
        ..plan.path.plan()
    };
    let days: Box<dyn OtherDays> = match ground.source {
        MapSource::World(_) => Box::new(SceneryDays {
            scenery: Scenario::map(),
        }),
        _ => Box::new(PictureDays::new(Arc::clone(&ground.map))),
    };
    Ok(OwnRouteAndMap {
        plan,
        map: ground.map,
        days,
    })
}

fn by_map(
    own: &OwnMap,
    (map, frame): (Arc<dyn Imagery>, Option<LocalFrame>),
) -> Result<OwnRouteAndMap, Box<dyn std::error::Error>> {
    let frame = frame.ok_or(
        "the map counts in metres of no place on the globe; name its reference system in a .prj file beside it",
    )?;
    let way_points = match &own.route {
        Some(text) => way_points(text, &frame)?,
        None => around(&map.bounds()),
    };
    let bounds = map.bounds();
    if let Some(outside) = way_points.iter().find(|place| !bounds.contains(place)) {
        return Err(format!(
            "--route: the way-point {:.0} m north and {:.0} m east of the map's middle is not on it",
            outside.north - bounds.center().north,
            outside.east - bounds.center().east
        )
        .into());
    }
    let plan = FlightPlan {
        name: map.name().to_owned(),
        way_points,
        height: own.height.unwrap_or(HEIGHT),
        frame_on_globe: frame,
        ..Scenario::all()[0].plan(&Overrides::default())
    };
    Ok(OwnRouteAndMap {
        plan,
        days: Box::new(PictureDays::new(Arc::clone(&map))),
        map,
    })
}

/// Once around the middle of a map.
fn around(bounds: &GroundRect) -> Vec<GroundPoint> {
    let inner = GroundRect::centered(
        bounds.center(),
        AROUND * bounds.height(),
        AROUND * bounds.width(),
    );
    let mut corners = inner.corners().to_vec();
    corners.push(corners[0]);
    corners
}

fn way_points(text: &str, frame: &LocalFrame) -> Result<Vec<GroundPoint>, String> {
    let place = |pair: &str| {
        let [latitude, longitude] = numbers(pair, "--route")?;
        let place = Geodetic::from_degrees(latitude, longitude, 0.0);
        Ok(frame.ground_from_geodetic(&place))
    };
    text.split(';')
        .filter(|pair| !pair.trim().is_empty())
        .map(place)
        .collect()
}
