//! `pilotage plan --find FROM TO`: a route over ground where a fix will be had, beside the straight one.

use std::sync::Arc;

use pilotage_core::frames::units::GRAVITY;
use pilotage_core::frames::{Altitude, AltitudeFrame, GroundPoint, LocalFrame};
use pilotage_core::imagery::terrain::{Dem, Terrain as _};
use pilotage_core::mission::{Route, WayPoint};
use pilotage_core::plan::{
    Aim, BudgetOf, FieldBuilder, FieldView, FixSource, Forbidden, FoundRoutes, PlannedLandmark,
    Prediction, PredictionRequest, RouteQuestion, Turns, growth_before_first_fix,
};
use pilotage_core::simulate::{FlightPlan, GuidanceSettings};
use serde::Serialize;

use super::arguments::{Arguments, FindArguments, Least, Of, Over};
use super::ground::{Ground, way_points};
use super::landmarks::expected;
use super::propose::rehearsed;
use crate::files::DiskFile;

/// Standard deviation of the position with which the field is computed, metres.
const POSITION: f64 = 15.0;
/// Most cells along the longer side of the field.
const MOST_CELLS: f64 = 700.0;
/// Worlds of each prediction.
const WORLDS: usize = 32;

/// Figures of one of the two routes.
#[derive(Clone, Debug, Serialize)]
pub struct Compared {
    name: &'static str,
    length_m: f64,
    time_s: f64,
    way_points: usize,
    worst_blind_m: f64,
    mean_blind_m: f64,
    worst_sigma_m: f64,
    mean_sigma_m: f64,
}

/// Both routes and what they come to.
#[derive(Clone, Debug, Serialize)]
pub struct Found {
    routes: FoundRoutes,
    comparison: Vec<Compared>,
}

/// Finds a route and flies it instead of the plan's.
pub(super) fn find(
    arguments: &Arguments,
    ground: &mut Ground,
    ends: &[String],
) -> Result<Found, Box<dyn std::error::Error>> {
    let wanted = &arguments.find;
    let ends = way_points(&ends.join(";"))?;
    let &[from, to] = &ends[..] else {
        return Err("--find takes two places, NORTH,EAST each".into());
    };
    let plan = ground
        .plan
        .clone()
        .ok_or("the mission has no route whose height and speed could be taken")?;
    let settings = &ground.mission.navigator;
    let view = FieldView {
        camera: ground.camera.clone(),
        height: ground.height,
        position: POSITION,
        tilt: settings.sensors.roll.max(settings.sensors.pitch),
    };
    let pass = view.across().ok_or("the camera does not see the ground")?;
    let landmarks = if wanted.over == Over::Landmarks || arguments.predict {
        expected(arguments, ground, plan.ground_down)
    } else {
        Vec::new()
    };
    let sources: Vec<FixSource> = match wanted.over {
        Over::Landmarks => landmarks
            .iter()
            .filter_map(|l| FixSource::of(l, ground.height))
            .collect(),
        Over::Map => rehearsed(arguments, ground, true)?
            .ranked()
            .iter()
            .map(|c| FixSource {
                bounds: c.bounds,
                probability: c.probability(),
            })
            .collect(),
    };
    let region = ground.map.bounds();
    let step = (pass / 6.0).max(region.width().max(region.height()) / MOST_CELLS);
    let mut builder = FieldBuilder::new(view, &region, step, sources);
    while builder.advance() {}
    let zones = ground.mission.no_fly.iter();
    let routes = RouteQuestion {
        from,
        to,
        field: Arc::new(builder.into_field()),
        pass,
        no_fly: zones.map(|z| z.corners.clone()).collect(),
        clearance: wanted.clearance,
        forbidden: high_ground(wanted, ground)?,
        airspeed: plan.airframe.cruise,
        wind: plan.wind,
        before_first_fix: growth_before_first_fix(&ground.mission.navigator),
        turns: turns(&plan),
        budget: wanted.budget,
        budget_of: match wanted.budget_of {
            Of::Time => BudgetOf::Time,
            Of::Length => BudgetOf::Length,
        },
        aim: match wanted.least {
            Least::Worst => Aim::Worst,
            Least::Mean => Aim::Mean,
        },
    }
    .find()?;
    let mut comparison = Vec::new();
    println!("            length    time  turns  worst blind   worst σ    mean σ");
    for (name, route) in [("straight", &routes.shortest), ("found", &routes.surest)] {
        let plan = FlightPlan {
            way_points: route.way_points.clone(),
            longest: 300.0 + 4.0 * route.time,
            ..plan.clone()
        };
        let prediction = predict(&plan, ground, &landmarks)?;
        let sigmas = || prediction.samples.iter().map(|s| s.corridor.sigma_major);
        let compared = Compared {
            name,
            length_m: route.length,
            time_s: prediction.samples.last().map_or(route.time, |s| s.time),
            way_points: route.way_points.len(),
            worst_blind_m: route.worst_blind,
            mean_blind_m: route.mean_blind,
            worst_sigma_m: sigmas().fold(0.0, f64::max),
            mean_sigma_m: sigmas().sum::<f64>() / prediction.samples.len().max(1) as f64,
        };
        println!(
            "{name:10} {:6.0} m {:5.0} s {:6} {:10.0} m {:7.1} m {:7.1} m",
            compared.length_m,
            compared.time_s,
            compared.way_points.saturating_sub(2),
            compared.worst_blind_m,
            compared.worst_sigma_m,
            compared.mean_sigma_m
        );
        comparison.push(compared);
    }
    take(ground, &routes.surest.way_points);
    Ok(Found { routes, comparison })
}

/// Plans the found way-points, and makes them the mission's first route.
fn take(ground: &mut Ground, way_points: &[GroundPoint]) {
    if let Some(plan) = &mut ground.plan {
        plan.way_points = way_points.to_vec();
        plan.targets.clear();
    }
    let altitude = Altitude {
        metres: ground.height,
        frame: AltitudeFrame::AboveGround,
    };
    let all = &mut ground.mission.routes;
    let found = Route {
        id: all.iter().map(|r| r.id + 1).max().unwrap_or(1),
        name: "Found".to_owned(),
        way_points: way_points
            .iter()
            .map(|at| WayPoint::new(*at, altitude))
            .collect(),
        ..Route::default()
    };
    all.insert(0, found);
}

fn predict(
    plan: &FlightPlan,
    ground: &Ground,
    landmarks: &[PlannedLandmark],
) -> Result<Prediction, pilotage_core::plan::PredictionError> {
    let request = PredictionRequest {
        plan,
        settings: &ground.mission.navigator,
        landmarks,
        wind_deviation: ground.mission.navigator.start.wind,
        worlds: WORLDS,
        seed: 1,
        limit: f64::INFINITY,
    };
    request.predict()
}

/// Turns of the aircraft with the wind behind it.
fn turns(plan: &FlightPlan) -> Turns {
    let guidance = GuidanceSettings::default();
    let speed = plan.airframe.cruise + plan.wind.norm();
    Turns {
        radius: speed * speed / (GRAVITY * guidance.planned_bank.tan()),
        roll_in: speed * guidance.roll_in,
    }
}

/// Ground of the elevation model that is too high for the height of the flight, which counts from the ground
/// at its origin.
fn high_ground(
    wanted: &FindArguments,
    ground: &Ground,
) -> Result<Option<Forbidden>, Box<dyn std::error::Error>> {
    let Some(path) = &wanted.dem else {
        return Ok(None);
    };
    let frame = LocalFrame::new(ground.mission.origin);
    let name = path.file_name().unwrap_or(path.as_os_str());
    let file = DiskFile::open(path, &name.to_string_lossy())
        .map_err(|e| format!("{}: {e}", path.display()))?;
    let dem = Dem::open(Arc::new(file), Some(frame), None)?;
    let base = dem.height_at(&GroundPoint::default()).unwrap_or(0.0);
    let highest = base + ground.height - wanted.ground_clearance;
    Ok(Some(Arc::new(move |place: &GroundPoint| {
        dem.height_at(place).is_some_and(|height| height > highest)
    })))
}
