//! Routes: way-points in the order in which they are flown.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::globe;
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint, LocalFrame};

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
    /// Circles around it, or hovers, for a time before the route goes on.
    Wait {
        /// Radius of the circle, metres; negative for circles to the left, and zero for hovering or the autopilot's
        /// own.
        radius: f64,
        /// Seconds; `None` until somebody says otherwise.
        seconds: Option<f64>,
    },
}

impl WayPointAction {
    /// Seconds for which the aircraft waits; `None` where it does not, or without an end.
    pub fn wait_seconds(&self) -> Option<f64> {
        match self {
            Self::Wait { seconds, .. } => *seconds,
            _ => None,
        }
    }
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
    /// Whether the aircraft returns to its home behind the last way-point.
    #[serde(default)]
    pub returns: bool,
    /// Properties that a file brought and we do not know, by name, as JSON text.
    pub properties: BTreeMap<String, String>,
}

/// Property of a route: latitude and longitude in degrees of its home, and metres above mean sea level.
pub(crate) const HOME: &str = "home";

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

    /// Latitude and longitude in degrees and metres above mean sea level of the home that a file stated.
    pub(crate) fn stated_home(&self) -> Option<[f64; 3]> {
        serde_json::from_str(self.properties.get(HOME)?).ok()
    }

    /// Place to which the aircraft returns: the home that a file stated, or else the first way-point; `frame` is the
    /// world's.
    pub fn home(&self, frame: &LocalFrame) -> Option<GroundPoint> {
        let stated = self.stated_home();
        let stated =
            stated.map(|[latitude, longitude, _]| globe::ground(frame, longitude, latitude));
        stated.or_else(|| Some(self.way_points.first()?.position))
    }

    /// Whether it lands at its last way-point.
    pub fn lands(&self) -> bool {
        let last = self.way_points.last();
        last.is_some_and(|it| it.action == WayPointAction::Land)
    }

    /// Place at which it lands: its last way-point if it lands there, or home if it returns.
    pub fn landing(&self, frame: &LocalFrame) -> Option<GroundPoint> {
        let last = self.way_points.last()?;
        if self.lands() {
            return Some(last.position);
        }
        self.home(frame).filter(|_| self.returns)
    }

    /// Leg from the last way-point to home, if it returns and does not land before.
    pub fn way_back(&self, frame: &LocalFrame) -> Option<[GroundPoint; 2]> {
        let last = self.way_points.last()?.position;
        let landing = self.landing(frame)?;
        (last.distance(&landing) > 1.0).then_some([last, landing])
    }

    /// The same line flown the other way: each leg keeps its speed, and take-off and landing change places.
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
        let inner = way_points.get(1).map(|w| w.altitude);
        if let (Some(first), Some(altitude)) = (way_points.first_mut(), inner)
            && first.action == WayPointAction::Land
        {
            (first.action, first.altitude) = (WayPointAction::TakeOff, altitude);
        }
        if let Some(last) = way_points.last_mut()
            && last.action == WayPointAction::TakeOff
        {
            last.action = WayPointAction::Land;
            last.altitude = Altitude::new(0.0, AltitudeFrame::AboveGround);
        }
        Self {
            way_points,
            ..self.clone()
        }
    }

    /// Adds metres to its altitudes above take-off: by how much the ground at the take-off before is higher than that at
    /// the one now, where the route shall stay as high.
    ///
    /// ```
    /// use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};
    /// use pilotage_mission::mission::{Route, WayPoint};
    ///
    /// // 120 m above ground at 550 m, counted from 400 m.
    /// let altitude = Altitude::new(120.0, AltitudeFrame::AboveTakeOff);
    /// let way_points = vec![WayPoint::new(GroundPoint::default(), altitude)];
    /// let mut route = Route { way_points, ..Route::default() };
    /// route.raise_above_take_off(550.0 - 400.0);
    /// assert_eq!(route.way_points[0].altitude.metres, 270.0);
    /// ```
    pub fn raise_above_take_off(&mut self, metres: f64) {
        for way_point in &mut self.way_points {
            if way_point.altitude.frame == AltitudeFrame::AboveTakeOff {
                way_point.altitude.metres += metres;
            }
        }
    }

    /// The route up to way-point `index` and the rest from there on, both with it; `None` at an end.
    pub fn split(&self, index: usize) -> Option<(Self, Self)> {
        if index == 0 || index + 1 >= self.way_points.len() {
            return None;
        }
        let part = |way_points: &[WayPoint], returns| Self {
            way_points: way_points.to_vec(),
            returns,
            ..self.clone()
        };
        Some((
            part(&self.way_points[..=index], false),
            part(&self.way_points[index..], self.returns),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_base::frames::Geodetic;

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
            returns: true,
            properties: BTreeMap::new(),
        }
    }

    #[test]
    fn home_is_what_a_file_stated_and_the_first_way_point_without_it() {
        let frame = LocalFrame::new(Geodetic::from_degrees(47.0, 8.0, 400.0));
        let mut route = route();
        let home = |route: &Route| route.home(&frame).unwrap();
        assert_eq!(home(&route), GroundPoint::new(0.0, 0.0));
        let stated = "[47.001, 8.0, 400.0]".to_owned();
        route.properties.insert(HOME.to_owned(), stated);
        assert!((home(&route).north - 111.2).abs() < 0.1);
        assert_eq!(route.landing(&frame), Some(home(&route)));
        let last = GroundPoint::new(300.0, 400.0);
        assert_eq!(route.way_back(&frame), Some([last, home(&route)]));
        route.returns = false;
        assert_eq!(route.landing(&frame), None);
        route.way_points[2].action = WayPointAction::Land;
        route.returns = true;
        assert_eq!(route.landing(&frame), Some(last));
        assert_eq!(route.way_back(&frame), None, "it landed before");
    }

    #[test]
    fn flown_the_other_way_it_takes_off_where_it_landed_and_climbs_to_the_next_way_point() {
        let mut there = route();
        there.way_points[0].action = WayPointAction::TakeOff;
        there.way_points[2].action = WayPointAction::Land;
        there.way_points[2].altitude = Altitude::new(0.0, AltitudeFrame::AboveGround);
        let back = there.reversed();
        let ends = [&back.way_points[0], &back.way_points[2]];
        assert_eq!(
            ends.map(|w| w.action),
            [WayPointAction::TakeOff, WayPointAction::Land]
        );
        assert_eq!(ends.map(|w| w.altitude.metres), [120.0, 0.0]);
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
        assert_eq!([first.returns, second.returns], [false, true]);
        assert_eq!(route().split(2), None);
    }
}
