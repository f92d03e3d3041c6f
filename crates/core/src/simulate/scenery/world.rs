//! The plan made ready for painting: grids over everything and the shadows of the day.

use super::day::Day;
use super::grid::{Grid, REACH};
use super::light::Light;
use super::noise::{hash2, unit};
use super::parcels::Parcels;
use super::plan::{Plan, Segment, segment_grid};
use super::shape::{Outline, Slab, Spot, convex_hull, spot};
use super::things::{Crown, Form, Habit, Prop};
use super::{distinct, network, settlement, water, woods};

/// The shadow of a solid or prop on level ground: a convex polygon as half planes.
#[derive(Clone, Debug)]
pub(super) struct Shadow {
    /// `normal · p - offset` is positive outside.
    pub(super) planes: Vec<(Spot, f32)>,
    pub(super) corners: Vec<Spot>,
    /// Height of the caster's top, metres.
    pub(super) top: f32,
    /// Number of the solid that casts it, or `u32::MAX`.
    pub(super) caster: u32,
}

impl Shadow {
    /// Signed distance, metres, negative inside the shadow.
    #[inline]
    pub(super) fn distance(&self, p: Spot) -> f32 {
        self.planes
            .iter()
            .map(|(normal, offset)| normal.dot(p) - offset)
            .fold(f32::MIN, f32::max)
    }

    fn cast(points: &[(Spot, f32)], light: &Light, caster: u32) -> Self {
        let away = light.toward * -light.shadow_per_height;
        let corners = convex_hull(points.iter().map(|&(p, h)| p + away * h).collect());
        let center = super::parcels::center_of(&corners);
        let planes = (0..corners.len())
            .map(|i| {
                let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
                let mut normal = (b - a).unit().right();
                if normal.dot(center - a) > 0.0 {
                    normal = normal * -1.0;
                }
                (normal, normal.dot(a))
            })
            .collect();
        let top = points.iter().map(|&(_, h)| h).fold(0.0, f32::max);
        Self {
            planes,
            corners,
            top,
            caster,
        }
    }
}

/// The plan, its grids, and the light of the day.
#[derive(Clone, Debug)]
pub(super) struct World {
    pub(super) plan: Plan,
    pub(super) parcels: Parcels,
    pub(super) segments: Vec<Segment>,
    pub(super) segment_grid: Grid,
    pub(super) surface_grid: Grid,
    pub(super) solid_grid: Grid,
    pub(super) crown_grid: Grid,
    pub(super) prop_grid: Grid,
    pub(super) shadows: Vec<Shadow>,
    pub(super) shadow_grid: Grid,
    pub(super) crown_shadow_grid: Grid,
    pub(super) light: Light,
}

fn square(center: Spot, radius: f32) -> Vec<Spot> {
    vec![center + spot(radius, radius), center - spot(radius, radius)]
}

impl World {
    pub(super) fn new(seed: u64, day: &Day) -> Self {
        let light = Light::new(day);
        let mut plan = Plan::default();
        network::build(&mut plan);
        distinct::build(&mut plan);
        water::build(&mut plan);
        settlement::build(&mut plan, seed);
        let parcels = Parcels::new(seed, day);
        let segments = plan.segments();
        let segment_grid = segment_grid(&segments, 3.0);
        let surface_grid = Grid::new(
            &plan.surfaces,
            2.0,
            |s| s.outline.corners(),
            |s, center, reach| s.outline.distance(center) < reach + 2.0 * s.ragged,
        );
        let solid_grid = Grid::new(
            &plan.solids,
            1.0,
            |s| s.outline().corners(),
            |s, center, reach| s.distance(center) < reach,
        );
        let ground = woods::Ground {
            segments: &segments,
            segment_grid: &segment_grid,
            surface_grid: &surface_grid,
            solid_grid: &solid_grid,
        };
        woods::plant(&mut plan, &parcels, &ground, seed);
        park(&mut plan, day);
        plan.crowns
            .retain(|c| c.center.n.abs() < REACH + 8.0 && c.center.e.abs() < REACH + 8.0);
        let crown_grid = Grid::new(
            &plan.crowns,
            1.0,
            |c| square(c.center, c.radius * 1.15),
            |c, center, reach| (c.center - center).length() < c.radius * 1.15 + reach,
        );
        let prop_grid = Grid::new(
            &plan.props,
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
            plan.props
                .iter()
                .map(|p| Shadow::cast(&prop_vertices(p), &light, u32::MAX)),
        );
        let shadow_grid = Grid::new(
            &shadows,
            1.0,
            |s| s.corners.clone(),
            |s, center, reach| s.distance(center) < reach,
        );
        let crown_shadow_grid = Grid::new(
            &plan.crowns,
            1.0,
            |c| {
                let shadow = crown_shadow(c, &light);
                shadow.grown(0.2 * c.radius).corners().to_vec()
            },
            |c, center, reach| crown_shadow(c, &light).distance(center) < reach + 0.2 * c.radius,
        );
        Self {
            plan,
            parcels,
            segments,
            segment_grid,
            surface_grid,
            solid_grid,
            crown_grid,
            prop_grid,
            shadows,
            shadow_grid,
            crown_shadow_grid,
            light,
        }
    }
}

fn prop_vertices(p: &Prop) -> Vec<(Spot, f32)> {
    let corners = p.slab.corners();
    let low = if p.form == Form::Car {
        0.55 * p.height
    } else {
        p.height
    };
    let cabin = Slab {
        half_along: 0.6 * p.slab.half_along,
        ..p.slab
    };
    corners
        .iter()
        .map(|&c| (c, 0.0))
        .chain(corners.iter().map(|&c| (c, low)))
        .chain(cabin.corners().into_iter().map(|c| (c, p.height)))
        .collect()
}

/// The ellipse of a crown's shadow: the crown is an ellipsoid in its upper part.
pub(super) fn crown_shadow(c: &Crown, light: &Light) -> Slab {
    let semi = match c.habit {
        Habit::Conifer => 0.42 * c.height,
        Habit::Broadleaf | Habit::Dead => 0.36 * c.height,
        Habit::Shrub => 0.5 * c.height,
    };
    let k = light.shadow_per_height;
    Slab {
        center: c.center - light.toward * (k * (c.height - semi)),
        axis: light.toward,
        half_along: c.radius.hypot(semi * k),
        half_across: c.radius,
    }
}

/// Parks the day's cars.
fn park(plan: &mut Plan, day: &Day) {
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
    for (i, (stall, chance)) in plan.stalls.clone().into_iter().enumerate() {
        let h = hash2(i as i32, day.cars_seed as i32, 5);
        if unit(h) < chance {
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
            plan.put(slab, 1.5, Form::Car, paint);
        }
    }
}

/// Corners of an outline in world metres.
pub(super) fn ground_polygon(outline: &Outline) -> Vec<crate::frames::GroundPoint> {
    outline.corners().into_iter().map(Spot::ground).collect()
}
