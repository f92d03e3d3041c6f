//! Question for a route, and the worth of any line over way-points to that question.

use std::sync::Arc;

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use super::blind_way::{BlindWayField, Pace, Unsure};
use super::field::Localizability;
use super::found::FoundRoute;
use super::no_fly::Obstacles;
use super::turns::{Turns, flown};
use pilotage_base::frames::GroundPoint;
use pilotage_mission::mission::NoFlyZone;

/// Quantity that the budget limits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum BudgetOf {
    /// The time in the wind.
    #[default]
    Time,
    /// The length.
    Length,
}

/// Quantity that is to be least.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Aim {
    /// The worst uncertainty on the way.
    #[default]
    Worst,
    /// The mean uncertainty over the way.
    Mean,
}

/// Test whether a place is forbidden, e.g. because the ground is too high there.
pub type Forbidden = Arc<dyn Fn(&GroundPoint) -> bool + Send + Sync>;

/// Question for a route.
#[derive(Clone)]
pub struct RouteQuestion {
    /// Start of the route; the position is known there.
    pub from: GroundPoint,
    /// End of the route.
    pub to: GroundPoint,
    /// Field that tells where a fix would be had.
    pub field: Arc<Localizability>,
    /// Shorter side of the picture on the ground, metres: the length of a pass over a landmark.
    pub pass: f64,
    /// Areas to fly around.
    pub no_fly: Vec<NoFlyZone>,
    /// Distance that is kept from them, metres.
    pub clearance: f64,
    /// Other places that are forbidden.
    pub forbidden: Option<Forbidden>,
    /// Airspeed, m/s.
    pub airspeed: f64,
    /// Velocity of the air (north, east), m/s.
    pub wind: Vector2<f64>,
    /// Factor by which the uncertainty grows faster before the first fix, while nobody knows the wind; 1 if
    /// it is known.
    pub before_first_fix: f64,
    /// Radius of a turn, metres, and the way flown while rolling into it, metres.
    pub turns: Turns,
    /// Greatest cost of the route over that of the shortest allowed one, e.g. 1.3.
    pub budget: f64,
    /// Quantity that is the cost.
    pub budget_of: BudgetOf,
    /// Quantity that is to be least.
    pub aim: Aim,
}

impl RouteQuestion {
    /// Obstacles to fly around.
    pub(super) fn obstacles(&self) -> Obstacles<'_> {
        Obstacles {
            areas: &self.no_fly,
            clearance: self.clearance,
        }
    }

    /// The ground and how it is flown over.
    pub(super) fn ground(&self) -> BlindWayField<'_> {
        BlindWayField {
            field: &self.field,
            pass: self.pass.max(1.0),
            pace: Pace {
                airspeed: self.airspeed,
                wind: self.wind,
            },
            before_first_fix: self.before_first_fix.max(1.0),
        }
    }

    /// Whether one must not fly over a place.
    pub(super) fn forbids(&self, place: &GroundPoint) -> bool {
        self.obstacles().forbid(place) || self.forbidden.as_ref().is_some_and(|f| f(place))
    }

    /// Whether one may fly straight from `a` to `b`.
    pub(super) fn allows(&self, a: &GroundPoint, b: &GroundPoint) -> bool {
        let Some(forbidden) = &self.forbidden else {
            return self.obstacles().leave_free(a, b);
        };
        let way = b.to_vector() - a.to_vector();
        let pieces = (way.norm() / self.field.step.max(1.0)).ceil().max(1.0);
        self.obstacles().leave_free(a, b)
            && (0..=pieces as usize).all(|i| {
                let place = GroundPoint::from(a.to_vector() + way * (i as f64 / pieces));
                !forbidden(&place)
            })
    }

    /// Whether one may fly the turns of a line, and straight between them.
    pub(super) fn allows_turns(&self, way_points: &[GroundPoint]) -> bool {
        self.allows_path(&flown(way_points, &self.turns))
    }

    /// Whether one may fly straight from place to place of a path.
    fn allows_path(&self, path: &[GroundPoint]) -> bool {
        path.windows(2)
            .all(|piece| self.allows(&piece[0], &piece[1]))
    }

    /// Whether one may turn at a place as one likes.
    pub(super) fn leaves_room_to_turn(&self, at: &GroundPoint) -> bool {
        self.forbidden.is_none() && self.obstacles().leave_room(at, self.turns.reach())
    }

    /// Cost that counts against the budget.
    pub(super) fn cost(&self, length: f64, time: f64) -> f64 {
        match self.budget_of {
            BudgetOf::Length => length,
            BudgetOf::Time => time,
        }
    }

    /// Least cost that the way between two places can have.
    pub(super) fn least_cost(&self, a: &GroundPoint, b: &GroundPoint) -> f64 {
        let length = a.distance(b);
        let fastest = self.airspeed + self.wind.norm();
        self.cost(length, length / fastest.max(1e-3))
    }

    /// Worth of a line over way-points, flown with its turns before them; `None` where the line is not
    /// allowed.
    ///
    /// ```
    /// # use std::sync::Arc;
    /// # use nalgebra::Vector2;
    /// # use pilotage_base::frames::{GroundPoint, GroundRect};
    /// # use pilotage_mission::mission::NoFlyZone;
    /// # use pilotage_plan::{Aim, BudgetOf, Localizability, RouteQuestion, Turns};
    /// # let region = GroundRect::centered(GroundPoint::new(250.0, 0.0), 1000.0, 1000.0);
    /// # let mut field = Localizability::unknown(&region, 50.0);
    /// # field.values.fill(0.0);
    /// # let corners = [(200.0, 50.0), (300.0, 50.0), (300.0, 150.0), (200.0, 150.0)];
    /// # let question = RouteQuestion {
    /// #     from: GroundPoint::new(0.0, 0.0),
    /// #     to: GroundPoint::new(500.0, 0.0),
    /// #     field: Arc::new(field),
    /// #     pass: 100.0,
    /// #     no_fly: vec![NoFlyZone {
    /// #         corners: corners.map(|(n, e)| GroundPoint::new(n, e)).to_vec(),
    /// #         ..NoFlyZone::default()
    /// #     }],
    /// #     clearance: 20.0,
    /// #     forbidden: None,
    /// #     airspeed: 20.0,
    /// #     wind: Vector2::new(5.0, 0.0),
    /// #     before_first_fix: 1.0,
    /// #     turns: Turns::default(),
    /// #     budget: 1.3,
    /// #     budget_of: BudgetOf::Time,
    /// #     aim: Aim::Worst,
    /// # };
    /// // 500 m northward at 20 m/s with 5 m/s from behind.
    /// let (from, to) = (GroundPoint::new(0.0, 0.0), GroundPoint::new(500.0, 0.0));
    /// let straight = question.judge(&[from, to]).ok_or("not allowed")?;
    /// assert!((straight.length - 500.0).abs() < 1e-9);
    /// assert!((straight.time - 20.0).abs() < 1e-6);
    /// // By way of an area that must not be flown over.
    /// assert!(question.judge(&[from, GroundPoint::new(250.0, 100.0), to]).is_none());
    /// # Ok::<(), &str>(())
    /// ```
    pub fn judge(&self, way_points: &[GroundPoint]) -> Option<FoundRoute> {
        let ground = self.ground();
        let mut route = FoundRoute {
            way_points: way_points.to_vec(),
            ..FoundRoute::default()
        };
        let (mut unsure, mut integral) = (Unsure::START, 0.0);
        for leg in way_points.windows(2) {
            if !self.allows(&leg[0], &leg[1]) {
                return None;
            }
            route.length += leg[0].distance(&leg[1]);
            route.time += ground.time(&leg[0], &leg[1])?;
        }
        let path = flown(way_points, &self.turns);
        if !self.allows_path(&path) {
            return None;
        }
        let mut length = 0.0;
        for piece in path.windows(2) {
            let way = ground.follow(&piece[0], &piece[1])?;
            route.worst_blind = way.worst(unsure).max(route.worst_blind);
            integral += way.integral.of(unsure);
            unsure = way.after(unsure);
            length += way.length;
        }
        route.mean_blind = integral / length.max(1e-9);
        Some(route)
    }

    /// Quantity that is to be least, of a route.
    pub(super) fn aimed(&self, route: &FoundRoute) -> f64 {
        match self.aim {
            Aim::Worst => route.worst_blind,
            Aim::Mean => route.mean_blind,
        }
    }
}
