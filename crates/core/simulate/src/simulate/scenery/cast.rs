//! Shadows on level ground: of solids and props, and of crowns.

use super::light::DayLight;
use super::parcels::center_of;
use super::shape::{Slab, Spot, convex_hull};
use super::things::{Crown, Habit, Prop, PropForm};

/// The shadow of a solid or prop on level ground: a convex polygon as half planes.
#[derive(Clone, Debug)]
pub(super) struct Shadow {
    /// `normal · p - offset` is positive outside.
    planes: Vec<(Spot, f32)>,
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

    /// As [`Self::distance`], but gives up once the distance is over `limit`.
    #[inline]
    pub(super) fn distance_below(&self, p: Spot, limit: f32) -> f32 {
        let mut most = f32::MIN;
        for (normal, offset) in &self.planes {
            most = most.max(normal.dot(p) - offset);
            if most > limit {
                break;
            }
        }
        most
    }

    /// The shadow of the convex hull of points (place, height).
    pub(super) fn cast(points: &[(Spot, f32)], light: &DayLight, caster: u32) -> Self {
        let away = light.toward * -light.shadow_per_height;
        let corners = convex_hull(points.iter().map(|&(p, h)| p + away * h).collect());
        let center = center_of(&corners);
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

/// Points (place, height) whose hull stands for a car, bale or crate.
pub(super) fn prop_vertices(p: &Prop) -> Vec<(Spot, f32)> {
    let corners = p.slab.corners();
    let low = if p.form == PropForm::Car {
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

/// The elliptic shadow of a crown.
#[derive(Clone, Copy, Debug)]
pub(super) struct CrownShadow {
    pub(super) center: Spot,
    pub(super) inverse_along: f32,
    pub(super) inverse_across: f32,
    /// Place and height of the crown's middle.
    pub(super) crown: Spot,
    pub(super) middle: f32,
    pub(super) radius: f32,
    pub(super) density: f32,
}

impl CrownShadow {
    /// The crown is taken as an ellipsoid in the upper part of the tree.
    pub(super) fn new(c: &Crown, light: &DayLight, bare: bool) -> Self {
        let semi = match c.habit {
            Habit::Conifer => 0.4 * c.height,
            Habit::Broadleaf | Habit::Dead => 0.36 * c.height,
            Habit::Shrub => 0.5 * c.height,
        };
        let k = light.shadow_per_height;
        let middle = c.height - semi;
        let leaves = c.habit != Habit::Conifer && bare || c.habit == Habit::Dead;
        Self {
            center: c.center - light.toward * (k * middle),
            inverse_along: 1.0 / c.radius.hypot(semi * k),
            inverse_across: 1.0 / (0.96 * c.radius),
            crown: c.center,
            middle,
            radius: c.radius,
            density: if leaves { 0.45 } else { 0.97 },
        }
    }

    /// The rectangle that holds the shadow.
    pub(super) fn slab(&self, light: &DayLight) -> Slab {
        Slab {
            center: self.center,
            axis: light.toward,
            half_along: 1.25 / self.inverse_along,
            half_across: 1.25 / self.inverse_across,
        }
    }
}
