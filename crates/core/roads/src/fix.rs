//! Position and heading by points that lie on roads.
//!
//! Gauss-Newton on the distances of the points from the centre lines. With r the residual of a point across its road, n
//! the road's normal and q the point from the centre of the turn, the row of the Jacobian is [n, n · q⊥, n · q] for
//! shift, turn and scale. The scale is known to some share and taken out of the equations at the end. Residuals on one
//! road share an error of variance s²: with weights w, the road gives Σ w j jᵀ - s² / (1 + s² Σ w) (Σ w j)(Σ w j)ᵀ
//! (Sherman and Morrison), so that its points together never tell their place across better than s.

use nalgebra::{Matrix3, Matrix4, SymmetricEigen, Vector2, Vector3, Vector4};
use pilotage_base::frames::GroundPoint;

use crate::map::RoadMap;

/// Steps after which the points have been matched often enough.
const STEPS: usize = 12;
/// Step below which nothing moves any more, metres.
const STILL: f64 = 1e-3;
/// Fewest points that make a fix.
const FEWEST: usize = 8;

/// Point on a road as seen from a believed pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoadSighting {
    /// Place under the believed pose.
    pub place: GroundPoint,
    /// Direction of the road under the believed pose, radians clockwise from north; either sense.
    pub direction: f64,
}

/// Errors of sightings and of the map, and how far roads are looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoadFixSettings {
    /// Greatest distance between a point and its road, metres.
    pub reach: f64,
    /// Greatest angle between the direction of a point and that of its road, radians.
    pub turn: f64,
    /// Standard deviation of one point across its road, metres.
    pub point: f64,
    /// Standard deviation of what all points on one road have in common, metres: the error of the map and that of the
    /// sight of its middle.
    pub shared: f64,
    /// Standard deviation of the scale, as a share: that of the height over the height.
    pub scale: f64,
    /// Greatest standard deviation of a direction of state that is reported, metres, at the points' distance for the
    /// heading: what is known less well is left open.
    pub least_known: f64,
}

impl Default for RoadFixSettings {
    fn default() -> Self {
        Self {
            reach: 25.0,
            turn: 20_f64.to_radians(),
            point: 1.0,
            shared: 1.0,
            scale: 0.02,
            least_known: 5.0,
        }
    }
}

/// Direction of state (north, east, heading) that roads tell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoadComponent {
    /// Weights of metres north, metres east and radians of heading in its value, metres.
    pub weights: Vector3<f64>,
    /// Value of the correction: what has to be added to the belief, metres.
    pub value: f64,
    /// Variance of the value, square metres. Errors of different components are independent.
    pub variance: f64,
}

/// Correction of a believed pose by roads.
#[derive(Clone, Debug, PartialEq)]
pub struct RoadFix {
    /// Shift north and east, metres, and turn clockwise, radians, to be added to the belief; nothing along directions
    /// that are left open.
    pub correction: Vector3<f64>,
    /// Information about north, east (1/m²) and heading (1/rad²).
    pub information: Matrix3<f64>,
    /// The directions of state that are known, the best first.
    pub components: Vec<RoadComponent>,
    /// Points that lie on a road after the correction.
    pub matched: usize,
    /// Root mean square of their distances across about the mean on each road, metres.
    pub residual: f64,
}

/// Correction of a pose by which `sightings` were put on the ground, which is believed to be above `centre`; `None`
/// where too few of them lie by roads, or nothing is told well enough.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_roads::{RoadFixSettings, RoadJoining, RoadLine, RoadMap, RoadSighting, fix_on_roads};
///
/// let points = |ends: [(f64, f64); 2]| ends.map(|(north, east)| GroundPoint::new(north, east)).to_vec();
/// let road = |ends| RoadLine { course: points(ends), ..RoadLine::default() };
/// let roads = vec![road([(-100.0, 0.0), (100.0, 0.0)]), road([(0.0, -100.0), (0.0, 100.0)])];
/// let map = RoadMap::new(roads, RoadJoining { crossings: true, ..RoadJoining::SHARED_POINTS });
/// // The road to the north and that to the east are seen 3 m too far south and 2 m too far west.
/// let seen = |north, east, direction| RoadSighting { place: GroundPoint::new(north - 3.0, east - 2.0), direction };
/// let ways: Vec<f64> = (-8..=8).map(|i| 10.0 * f64::from(i)).collect();
/// let all = ways.iter().flat_map(|way| [seen(*way, 0.0, 0.0), seen(0.0, *way, 90_f64.to_radians())]);
/// let all: Vec<RoadSighting> = all.collect();
/// let fix = fix_on_roads(&map, &all, GroundPoint::default(), &RoadFixSettings::default()).ok_or("no fix")?;
/// assert!((fix.correction.x - 3.0).abs() < 0.01 && (fix.correction.y - 2.0).abs() < 0.01);
/// # Ok::<(), &str>(())
/// ```
pub fn fix_on_roads(
    map: &RoadMap,
    sightings: &[RoadSighting],
    centre: GroundPoint,
    settings: &RoadFixSettings,
) -> Option<RoadFix> {
    let mut state = Vector4::zeros();
    let mut normal = None;
    for step in 0..STEPS {
        // Roads are looked for from afar at first, then where they should be if the rest is right.
        let reach = if step < 4 {
            settings.reach
        } else {
            settings.reach.min(6.0 * settings.point + 2.0)
        };
        let system = NormalEquations::of(map, sightings, centre, &state, settings, reach)?;
        let delta = system.step(settings);
        state += delta;
        let moved = delta.xy().norm() + system.lever * delta.z.abs();
        normal = Some(system);
        if step > 4 && moved < STILL {
            break;
        }
    }
    normal?.fix(&state, settings)
}

/// Equations of one step, about a state (north, east, turn, relative scale).
struct NormalEquations {
    information: Matrix4<f64>,
    gradient: Vector4<f64>,
    matched: usize,
    /// Sum of squared residuals about their mean on each road, square metres.
    squares: f64,
    /// Root mean square distance of the points from the centre, metres: what a turn is worth.
    lever: f64,
}

/// Sums over the points on one road.
#[derive(Clone, Copy, Default)]
struct OneRoad {
    points: u32,
    /// Mean residual, metres.
    mean: f64,
    /// Sums over the points: of weights, and weighted.
    weight: f64,
    row: Vector4<f64>,
    residual: f64,
}

impl NormalEquations {
    fn of(
        map: &RoadMap,
        sightings: &[RoadSighting],
        centre: GroundPoint,
        state: &Vector4<f64>,
        settings: &RoadFixSettings,
        reach: f64,
    ) -> Option<Self> {
        let mut own = Self {
            information: Matrix4::zeros(),
            gradient: Vector4::zeros(),
            matched: 0,
            squares: 0.0,
            lever: 0.0,
        };
        let mut roads: Vec<(usize, OneRoad)> = Vec::new();
        let (sin, cos) = state.z.sin_cos();
        for sighting in sightings {
            let q = sighting.place.to_vector() - centre.to_vector();
            let turned =
                (1.0 + state.w) * Vector2::new(cos * q.x - sin * q.y, sin * q.x + cos * q.y);
            let place = GroundPoint::from(centre.to_vector() + state.xy() + turned);
            let direction = sighting.direction + state.z;
            let Some(near) = map.nearest_like(place, reach, direction, settings.turn) else {
                continue;
            };
            // Beyond the end of a road nothing is known of the place across.
            if near.distance > near.right.abs() + 0.5 {
                continue;
            }
            let (sin, cos) = near.heading.sin_cos();
            let to_right = Vector2::new(-sin, cos);
            let row = Vector4::new(
                to_right.x,
                to_right.y,
                to_right.dot(&Vector2::new(-turned.y, turned.x)),
                to_right.dot(&turned),
            );
            let weight = huber(near.right / settings.point) / settings.point.powi(2);
            own.information += weight * row * row.transpose();
            own.gradient -= weight * near.right * row;
            own.matched += 1;
            own.squares += near.right.powi(2);
            own.lever += q.norm_squared();
            let line = map.edge(near.edge).line;
            let known = roads.iter().position(|(other, _)| *other == line);
            let known = known.unwrap_or_else(|| {
                roads.push((line, OneRoad::default()));
                roads.len() - 1
            });
            let road = &mut roads[known].1;
            road.weight += weight;
            road.row += weight * row;
            road.residual += weight * near.right;
            road.mean += (near.right - road.mean) / f64::from(road.points + 1);
            road.points += 1;
        }
        if own.matched < FEWEST {
            return None;
        }
        own.lever = (own.lever / own.matched as f64).sqrt().max(1.0);
        let shared = settings.shared.powi(2);
        for (_, road) in roads {
            let share = shared / (1.0 + shared * road.weight);
            own.information -= share * road.row * road.row.transpose();
            own.gradient += share * road.residual * road.row;
            own.squares -= f64::from(road.points) * road.mean.powi(2);
        }
        let known_scale = settings.scale.max(1e-6).powi(-2);
        own.information[(3, 3)] += known_scale;
        own.gradient.w -= known_scale * state.w;
        Some(own)
    }

    /// Information about north, east and heading without the scale, and its gradient.
    fn without_scale(&self) -> (Matrix3<f64>, Vector3<f64>) {
        let cross = self.information.fixed_view::<3, 1>(0, 3).into_owned();
        let own = self.information.fixed_view::<3, 3>(0, 0).into_owned();
        let of_scale = self.information[(3, 3)];
        (
            own - cross * cross.transpose() / of_scale,
            self.gradient.xyz() - cross * (self.gradient.w / of_scale),
        )
    }

    /// Eigenvectors (of north, east and heading times the lever) with eigenvalues, the best known first.
    fn axes(&self, information: &Matrix3<f64>) -> Vec<(Vector3<f64>, f64)> {
        let lever = Vector3::new(1.0, 1.0, 1.0 / self.lever);
        let scaled = Matrix3::from_diagonal(&lever) * information * Matrix3::from_diagonal(&lever);
        let eigen = SymmetricEigen::new(scaled);
        let mut axes: Vec<_> = (0..3)
            .map(|i| {
                (
                    eigen.eigenvectors.column(i).into_owned(),
                    eigen.eigenvalues[i],
                )
            })
            .collect();
        axes.sort_by(|a, b| b.1.total_cmp(&a.1));
        axes
    }

    /// Components that are known well enough, and the way to them.
    fn components(&self, settings: &RoadFixSettings) -> Vec<RoadComponent> {
        let (information, gradient) = self.without_scale();
        let lever = Vector3::new(1.0, 1.0, self.lever);
        let scaled = gradient.component_div(&lever);
        let axes = self.axes(&information).into_iter();
        axes.filter(|(_, value)| *value * settings.least_known.powi(2) >= 1.0)
            .map(|(axis, value)| RoadComponent {
                weights: axis.component_mul(&lever),
                value: axis.dot(&scaled) / value,
                variance: 1.0 / value,
            })
            .collect()
    }

    /// Change of the state along what is known.
    fn step(&self, settings: &RoadFixSettings) -> Vector4<f64> {
        let own = self.shift(&self.components(settings));
        let cross = self.information.fixed_view::<3, 1>(0, 3).into_owned();
        let scale = (self.gradient.w - cross.dot(&own)) / self.information[(3, 3)];
        Vector4::new(own.x, own.y, own.z, scale)
    }

    /// Change of north, east and heading that has these components, and nothing else.
    fn shift(&self, components: &[RoadComponent]) -> Vector3<f64> {
        let squared = Vector3::new(1.0, 1.0, self.lever.powi(2));
        let shift = |c: &RoadComponent| c.value * c.weights.component_div(&squared);
        components.iter().map(shift).sum()
    }

    /// Fix after the last step.
    fn fix(&self, state: &Vector4<f64>, settings: &RoadFixSettings) -> Option<RoadFix> {
        let residual = (self.squares.max(0.0) / self.matched as f64).sqrt();
        // Points that scatter more than was said are known less.
        let more = (residual / settings.point).powi(2).max(1.0);
        let mut components = self.components(settings);
        for component in &mut components {
            component.value = component.weights.dot(&state.xyz());
            component.variance *= more;
        }
        (!components.is_empty()).then(|| RoadFix {
            correction: self.shift(&components),
            information: self.without_scale().0 / more,
            components,
            matched: self.matched,
            residual,
        })
    }
}

/// Huber's weight of a residual in standard deviations.
fn huber(residual: f64) -> f64 {
    const BEND: f64 = 1.5;
    (BEND / residual.abs().max(1e-12)).min(1.0)
}
