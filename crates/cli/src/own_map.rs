//! `pilotage simulate` over a map of one's own.

use std::path::PathBuf;

use pilotage_core::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
use pilotage_core::plan::cruise;
use pilotage_core::simulate::{FlightDay, Scenario, Wind};
use pilotage_jobs::{FlightSource, OpenFlight, PlannedPath, RehearsedFlight, fly_planned};

use crate::maps::{MAP_CACHE, MapOnDisk};
use crate::notes::{told, told_ground};
use crate::numbers::numbers;
use crate::plan::{PlanSource, PlannedFlight, above_ground};
use crate::workers::Lent;

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
    /// Mean wind, degrees from which it blows and m/s; without it calm over --map, and over a mission drawn by the seed
    /// about that of the flight beside it.
    #[arg(long, value_name = "FROM,SPEED", conflicts_with = "scenario")]
    pub wind: Option<String>,
}

/// Flies over it: on another day as `pilotage rehearse` and the page fly the seed of a mission's route, in a wind drawn
/// about the planned one unless it is stated.
///
/// # Errors
/// A map or mission that cannot be read, or a route of fewer than two way-points.
pub fn fly(
    own: &OwnMap,
    seed: u64,
    day: FlightDay,
) -> Result<OpenFlight, Box<dyn std::error::Error>> {
    above_ground(own.height)?;
    let (mut planned, lent) = match (&own.mission, &own.map) {
        (Some(_), _) => by_mission(own)?,
        (None, Some(map)) => by_map(own, crate::maps::open_map(map, None, MAP_CACHE)?)?,
        (None, None) => return Err("say --map or --mission".into()),
    };
    planned.seed = seed;
    if let Some(text) = &own.wind {
        let [from, speed] = numbers(text, "--wind")?;
        let airspeed = planned.path.airspeed.unwrap_or_else(cruise);
        if !(0.0..airspeed).contains(&speed) {
            return Err(format!(
                "--wind: in {speed} m/s the aircraft, which flies {airspeed:.1} m/s, gets nowhere; give its speed as zero or more and below that"
            )
            .into());
        }
        let from = from.to_radians();
        planned.path.wind = Wind { from, speed };
        planned.wind_deviation = 0.0;
    }
    Ok(fly_planned(&mut lent.worker(), &planned, day)?)
}

/// Plan of the first seed, and its map.
type OwnPlan = (RehearsedFlight, Lent);

fn by_mission(own: &OwnMap) -> Result<OwnPlan, Box<dyn std::error::Error>> {
    let ground = told_ground(PlannedFlight::at(&PlanSource {
        scenario: None,
        mission: own.mission.clone(),
        map: own.map.clone(),
        flight: None,
        height: own.height,
        dem: own.dem.clone(),
    })?);
    let lent = ground.lent();
    let plan = ground
        .plan
        .ok_or("the mission has no route to fly; add one, or leave it out and say --route")?;
    let route = ground.mission.routes.first();
    let name = route.map_or_else(String::new, |route| route.name.clone());
    let of = (name, ground.mission.origin);
    let planned = RehearsedFlight::of_plan(plan, of, ground.source, 1);
    Ok((planned, lent))
}

fn by_map(own: &OwnMap, opened: MapOnDisk) -> Result<OwnPlan, Box<dyn std::error::Error>> {
    let frame = opened.frame;
    let map = told(opened);
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
    let planned = RehearsedFlight {
        name: map.name().to_owned(),
        origin: frame.origin,
        path: PlannedPath::level(
            way_points,
            own.height.unwrap_or(FlightSource::USUAL_HEIGHT),
            Scenario::camera(),
        ),
        wind_deviation: 0.0,
        map: Lent::map_of_file(),
        seed: 1,
    };
    Ok((planned, Lent::default().with_map(Lent::map_of_file(), map)))
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
