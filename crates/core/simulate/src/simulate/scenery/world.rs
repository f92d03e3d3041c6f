//! The land on a day: its parcels, cars, light and shadows.

use std::sync::Arc;

use super::cast::{CrownShadow, Shadow, prop_vertices};
use super::day::{Day, Season};
use super::foliage::Foliage;
use super::grid::CellLists;
use super::land::Land;
use super::light::DayLight;
use super::noise::{hash2, unit};
use super::parcels::Parcels;
use super::shape::Slab;
use super::things::{Prop, PropForm};

/// The land, and what a day makes of it.
#[derive(Clone, Debug)]
pub(super) struct SceneryWorld {
    pub(super) land: Arc<Land>,
    pub(super) parcels: Parcels,
    pub(super) props: Vec<Prop>,
    pub(super) prop_grid: CellLists,
    pub(super) shadows: Vec<Shadow>,
    pub(super) shadow_grid: CellLists,
    pub(super) crown_shadow_grid: CellLists,
    pub(super) crown_shadows: Vec<CrownShadow>,
    pub(super) foliage: Foliage,
    pub(super) growth: u32,
    pub(super) light: DayLight,
}

impl SceneryWorld {
    /// `land` on `day`.
    pub(super) fn new(land: Arc<Land>, day: &Day) -> Self {
        let light = DayLight::new(day);
        let parcels = land.parcels.on_day(land.seed, day);
        let plan = &land.plan;
        let mut props = plan.props.clone();
        props.extend(parked(&plan.stalls, day));
        let prop_grid = CellLists::new(
            &props,
            0.6,
            |p| p.slab.corners().to_vec(),
            |p, center, reach| p.slab.distance(center) < reach,
        );
        let mut shadows: Vec<Shadow> = plan
            .solids
            .iter()
            .enumerate()
            .map(|(i, solid)| Shadow::cast(&solid.vertices(), &light, i as u32))
            .collect();
        shadows.extend(
            props
                .iter()
                .map(|p| Shadow::cast(&prop_vertices(p), &light, u32::MAX)),
        );
        let shadow_grid = CellLists::new(
            &shadows,
            1.0,
            |s| s.corners.clone(),
            |s, center, reach| s.distance(center) < reach,
        );
        let bare = day.season == Season::LateWinter;
        let crown_shadows: Vec<CrownShadow> = plan
            .crowns
            .iter()
            .map(|c| CrownShadow::new(c, &light, bare))
            .collect();
        let crown_shadow_grid = CellLists::new(
            &crown_shadows,
            0.5,
            |s| s.slab(&light).corners().to_vec(),
            |s, center, reach| s.slab(&light).distance(center) < reach,
        );
        Self {
            parcels,
            props,
            prop_grid,
            shadows,
            shadow_grid,
            crown_shadow_grid,
            crown_shadows,
            foliage: Foliage::new(day.season, day.growth_seed),
            growth: day.growth_seed as u32,
            light,
            land,
        }
    }
}

/// The day's cars: each stall (its place, how often one stands there) holds one or none.
fn parked(stalls: &[(Slab, f32)], day: &Day) -> Vec<Prop> {
    const PAINTS: [[f32; 3]; 10] = [
        [0.62, 0.62, 0.61],
        [0.6, 0.6, 0.6],
        [0.34, 0.35, 0.36],
        [0.3, 0.3, 0.31],
        [0.03, 0.03, 0.034],
        [0.04, 0.042, 0.045],
        [0.1, 0.1, 0.105],
        [0.05, 0.09, 0.2],
        [0.26, 0.025, 0.025],
        [0.2, 0.18, 0.14],
    ];
    let mut cars = Vec::new();
    for (i, (stall, chance)) in stalls.iter().enumerate() {
        let h = hash2(i as i32, day.cars_seed as i32, 5);
        if unit(h) < *chance {
            let paint = PAINTS[(h.rotate_left(7) % 10) as usize];
            let jitter = unit(h.rotate_left(13)) - 0.5;
            let turned = if h & 1 == 0 {
                stall.axis
            } else {
                stall.axis * -1.0
            };
            let angle = turned.e.atan2(turned.n) + 0.06 * jitter;
            let slab = Slab::new(
                stall.at(0.6 * jitter, 0.3 * (unit(h.rotate_left(19)) - 0.5)),
                angle,
                4.3 + 0.5 * unit(h.rotate_left(23)),
                1.76 + 0.14 * jitter,
            );
            cars.push(Prop {
                slab,
                height: 1.5,
                form: PropForm::Car,
                color: paint,
            });
        }
    }
    cars
}
