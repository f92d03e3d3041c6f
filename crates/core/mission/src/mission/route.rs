//! Routes: way-points in the order in which they are flown.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use pilotage_base::frames::{Altitude, GroundPoint};

/// Action at a way-point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum WayPointAction {
    /// The turn begins before it and ends on the next leg.
    #[default]
    FlyBy,
    /// Circles around it before the route goes on.
    Loiter {
        /// Radius of the circle, metres; negative for circles to the left.
        radius: f64,
        /// Number of circles.
        turns: f64,
    },
    /// The route begins with a take-off here.
    TakeOff,
    /// The route ends with a landing here.
    Land,
}

/// A place that a route leads over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WayPoint {
    /// Place in the world.
    pub position: GroundPoint,
    /// Altitude at which it is flown over, and the reference that this counts from.
    pub altitude: Altitude,
    /// Airspeed on the leg that leads to it, m/s; the aircraft's cruise where it has none.
    pub speed: Option<f64>,
    /// Action at the way-point.
    pub action: WayPointAction,
    /// Properties that a file brought and we do not know, by name, as JSON text.
    pub properties: BTreeMap<String, String>,
}

impl WayPoint {
    /// A way-point that is flown by.
    pub fn new(position: GroundPoint, altitude: Altitude) -> Self {
        Self {
            position,
            altitude,
            speed: None,
            action: WayPointAction::default(),
            properties: BTreeMap::new(),
        }
    }
}

/// A line to be flown.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Route {
    /// Identity within a mission; never used twice.
    pub id: u32,
    /// Name for people.
    pub name: String,
    /// Its way-points, first to last.
    pub way_points: Vec<WayPoint>,
    /// Properties that a file brought and we do not know, by name, as JSON text.
    pub properties: BTreeMap<String, String>,
}

impl Route {
    /// Length over the way-points without turns and circles, metres.
    ///
    /// ```
    /// use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};
    /// use pilotage_mission::mission::{Route, WayPoint};
    ///
    /// let altitude = Altitude::new(120.0, AltitudeFrame::AboveGround);
    /// let at = |north, east| WayPoint::new(GroundPoint::new(north, east), altitude);
    /// let way_points = vec![at(0.0, 0.0), at(300.0, 400.0), at(300.0, 0.0)];
    /// let route = Route { way_points, ..Route::default() };
    /// assert_eq!(route.length(), 500.0 + 400.0);
    /// ```
    pub fn length(&self) -> f64 {
        self.way_points
            .windows(2)
            .map(|pair| pair[0].position.distance(&pair[1].position))
            .sum()
    }

    /// The same line flown the other way: each leg keeps its speed.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut way_points: Vec<WayPoint> = self.way_points.iter().rev().cloned().collect();
        for (i, way_point) in way_points.iter_mut().enumerate() {
            // The leg that now leads to this one led from it before.
            way_point.speed = match i {
                0 => None,
                _ => self.way_points[self.way_points.len() - i].speed,
            };
        }
        Self {
            way_points,
            ..self.clone()
        }
    }

    /// The route up to way-point `index` and the rest from there on, both with it; `None` at an end.
    pub fn split(&self, index: usize) -> Option<(Self, Self)> {
        if index == 0 || index + 1 >= self.way_points.len() {
            return None;
        }
        let part = |way_points: &[WayPoint]| Self {
            way_points: way_points.to_vec(),
            ..self.clone()
        };
        Some((
            part(&self.way_points[..=index]),
            part(&self.way_points[index..]),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::AltitudeFrame;

    fn route() -> Route {
        let at = |north, east, speed| WayPoint {
            speed,
            ..WayPoint::new(
                GroundPoint::new(north, east),
                Altitude::new(120.0, AltitudeFrame::AboveGround),
            )
        };
        Route {
            id: 1,
            name: "there".to_owned(),
            way_points: vec![
                at(0.0, 0.0, None),
                at(300.0, 0.0, Some(18.0)),
                at(300.0, 400.0, Some(22.0)),
            ],
            properties: BTreeMap::new(),
        }
    }

    #[test]
    fn a_route_reversed_twice_is_the_same_and_each_leg_keeps_its_speed() {
        let back = route().reversed();
        let speeds: Vec<_> = back.way_points.iter().map(|w| w.speed).collect();
        assert_eq!(speeds, [None, Some(22.0), Some(18.0)]);
        assert_eq!(back.reversed(), route());
        assert_eq!(back.length(), 700.0);
    }

    #[test]
    fn both_parts_of_a_split_route_have_the_way_point_between_them() {
        let (first, second) = route().split(1).unwrap();
        assert_eq!(first.way_points.last(), second.way_points.first());
        assert_eq!(first.length() + second.length(), route().length());
        assert_eq!(route().split(2), None);
    }
}
