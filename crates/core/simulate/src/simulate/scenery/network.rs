//! The road network: fixed curves, named for people.

use super::plan::SceneryPlan;
use super::road_table::ROADS;
use super::scene_kind::SceneKind;
use super::shape::{GroundOutline, Slab, Spot, smooth_curve, spot};
use super::things::SceneryRoadClass::{Main, Street, Track};
use super::things::{Road, SceneryRoadClass, SurfaceMaterial};

fn road(plan: &mut SceneryPlan, name: &'static str, class: SceneryRoadClass, controls: &[Spot]) {
    let half_width = match class {
        Main => 3.6,
        SceneryRoadClass::Stream => 1.7,
        Street => 2.9,
        Track => 1.35,
    };
    plan.roads.push(Road {
        class,
        curve: smooth_curve(controls, 5.0),
        half_width,
        name: Some(name),
        village: name.ends_with("Street"),
    });
}

/// The roundabout where the main roads meet.
fn roundabout(plan: &mut SceneryPlan) {
    let center = spot(428.0, 617.0);
    let ring = |radius: f32, ground| (GroundOutline::Disc(center, radius), ground);
    for (outline, ground) in [
        ring(24.0, SurfaceMaterial::Grass),
        ring(17.9, SurfaceMaterial::Asphalt),
        ring(9.3, SurfaceMaterial::Paving),
        ring(8.2, SurfaceMaterial::Lawn),
        ring(3.0, SurfaceMaterial::Beds),
    ] {
        plan.lay(outline, ground, spot(1.0, 0.0), 0.1, None);
    }
    let circle = (0..=28)
        .map(|i| {
            let angle = i as f32 * std::f32::consts::TAU / 28.0;
            center + Spot::heading(angle) * 13.7
        })
        .collect();
    plan.roads.push(Road {
        class: Street,
        curve: circle,
        half_width: 4.3,
        name: Some("roundabout"),
        village: false,
    });
    let site = Slab::new(center, 0.0, 52.0, 52.0);
    plan.reserved.push(site);
    let outline = GroundOutline::Disc(center, 18.5).corners();
    plan.announce("roundabout", SceneKind::Place, outline, &site);
}

/// Pedestrian crossings: road, metres along it.
const CROSSINGS: [(&str, f32); 9] = [
    ("High Street", 300.0),
    ("High Street", 452.0),
    ("High Street", 640.0),
    ("Back Street", 320.0),
    ("Back Street", 520.0),
    ("School Street", 32.0),
    ("Market Street", 250.0),
    ("Market Street", 140.0),
    ("Church Street", 150.0),
];

/// Paints the crossings of the village streets.
fn crossings(plan: &mut SceneryPlan) {
    for (name, along) in CROSSINGS {
        let Some(road) = plan.roads.iter().find(|r| r.name == Some(name)) else {
            continue;
        };
        if let Some((place, axis)) = super::settlement::station(&road.curve, along) {
            let half_width = road.half_width;
            let slab = Slab {
                center: place,
                axis: axis.right(),
                half_along: half_width - 0.25,
                half_across: 1.7,
            };
            plan.lay_slab(slab, SurfaceMaterial::Zebra, 0.0);
        }
    }
}

/// Lays all roads.
pub(super) fn build(plan: &mut SceneryPlan) {
    roundabout(plan);
    for (name, class, controls) in ROADS {
        road(plan, name, class, controls);
    }
    crossings(plan);
}
