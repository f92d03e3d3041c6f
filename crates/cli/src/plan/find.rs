//! `pilotage plan --find FROM TO`: a route over ground where a fix will be had, beside the straight one.

use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::Route;
use pilotage_core::plan::{FoundRoutes, Proposal};
use pilotage_jobs::{
    FindOrder, FixesFrom, Foreseen, FoundPlan, HighGround, JobEvent, PlanCircumstances,
    PlannedPath, PredictionOrder, RouteWishes,
};
use serde::Serialize;

use super::arguments::Arguments;
use super::ground::way_points;
use super::landmarks::expected;
use super::planned_flight::PlannedFlight;
use crate::workers;

/// Figures of one of the two routes.
#[derive(Clone, Debug, Serialize)]
pub struct ComparedRoute {
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
pub struct BothRoutes {
    routes: FoundRoutes,
    comparison: Vec<ComparedRoute>,
}

/// Finds a route and flies it instead of the plan's.
pub(super) fn find(
    arguments: &Arguments,
    ground: &mut PlannedFlight,
    ends: &[String],
) -> Result<BothRoutes, Box<dyn std::error::Error>> {
    let order = order(arguments, ground, ends)?;
    let mut found = None;
    workers::run(vec![order], &ground.lent(), &mut |_, event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::FoundPlan(plan) => found = Some(*plan),
            _ => {}
        }
        Ok(())
    })?;
    let FoundPlan { shortest, surest } = found.ok_or("nothing was found")?;
    println!("            length    time  turns  worst blind   worst σ    mean σ");
    let comparison = vec![
        ComparedRoute::of("straight", &shortest),
        ComparedRoute::of("found", &surest),
    ];
    comparison.iter().for_each(ComparedRoute::print);
    take(ground, &surest.route.way_points);
    let routes = FoundRoutes {
        shortest: shortest.route,
        surest: surest.route,
    };
    Ok(BothRoutes { routes, comparison })
}

fn order(
    arguments: &Arguments,
    ground: &PlannedFlight,
    ends: &[String],
) -> Result<FindOrder, Box<dyn std::error::Error>> {
    let wishes = arguments.find.wishes();
    let ends = way_points(&ends.join(";"), "--find")?;
    let &[from, to] = &ends[..] else {
        return Err("--find takes two places, NORTH,EAST each".into());
    };
    let plan = ground
        .plan
        .clone()
        .ok_or("the mission has no route whose height and speed could be taken")?;
    let straight = ground.at_its_altitude(&[from, to]);
    let height = ground.mean_above(&straight).unwrap_or(ground.height);
    let with = PlanCircumstances {
        height,
        ..ground.circumstances(Proposal::POSITION)
    };
    let landmarks = if wishes.over == FixesFrom::Landmarks || arguments.predict {
        expected(ground, arguments.seed, &|line| println!("{line}"))?
    } else {
        Vec::new()
    };
    let flight = PredictionOrder {
        navigator: with.navigator.clone(),
        landmarks,
        path: PlannedPath {
            height,
            targets: Vec::new(),
            ..plan.path
        },
        ..plan
    };
    let planned = flight.planned_landmarks().into_iter();
    let field = with.field(wishes.over, ground.map.bounds(), planned);
    wishes
        .order(
            (from, to),
            field,
            flight,
            ground.mission.no_fly.clone(),
            high_ground(&wishes, ground, &from),
        )
        .ok_or_else(|| "--find: the map reaches neither of the two places".into())
}

impl ComparedRoute {
    fn of(name: &'static str, foreseen: &Foreseen) -> Self {
        let Foreseen { route, prediction } = foreseen;
        Self {
            name,
            length_m: route.length,
            time_s: prediction.samples.last().map_or(route.time, |s| s.time),
            way_points: route.way_points.len(),
            worst_blind_m: route.worst_blind,
            mean_blind_m: route.mean_blind,
            worst_sigma_m: foreseen.worst_sigma(),
            mean_sigma_m: foreseen.mean_sigma(),
        }
    }

    fn print(&self) {
        println!(
            "{:10} {:6.0} m {:5.0} s {:6} {:10.0} m {:7.1} m {:7.1} m",
            self.name,
            self.length_m,
            self.time_s,
            self.way_points.saturating_sub(2),
            self.worst_blind_m,
            self.worst_sigma_m,
            self.mean_sigma_m
        );
    }
}

/// Plans the found way-points, and makes them the mission's first route.
fn take(ground: &mut PlannedFlight, way_points: &[GroundPoint]) {
    let all = &ground.mission.routes;
    let found = Route {
        id: all.iter().map(|r| r.id + 1).max().unwrap_or(1),
        name: FindOrder::FOUND.to_owned(),
        ..ground.at_its_altitude(way_points)
    };
    ground.fly_along(&found);
    ground.mission.routes.insert(0, found);
}

/// Ground of the elevation model that is too high for a route that takes off at `from`.
fn high_ground(
    wishes: &RouteWishes,
    ground: &PlannedFlight,
    from: &GroundPoint,
) -> Option<HighGround> {
    let heights = ground.heights.clone()?;
    let take_off = ground.height_at(from);
    let highest = wishes.highest_ground(ground.altitude, take_off)?;
    Some(HighGround { heights, highest })
}
