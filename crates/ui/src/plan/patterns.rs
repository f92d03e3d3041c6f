//! Routes that are made of a pattern: a survey over an area, a corridor along a line.

use pilotage_core::camera::CameraModel;
use pilotage_core::frames::{Altitude, Geodetic, GroundPoint, LocalFrame};
use pilotage_core::mission::pattern::{
    Passes, bends, corridor, fewest_passes, picture_on_ground, survey,
};
use pilotage_core::mission::{Route, WayPoint, WayPointAction};
use pilotage_core::sorting::sort;
use serde::{Deserialize, Serialize};

/// Property of a route with the pattern that it is made of.
const PROPERTY: &str = "pattern";

/// Kind of ground that a pattern covers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CoveredGround {
    /// The area within the places.
    Survey,
    /// The ground along the places.
    Corridor {
        /// Its width, metres.
        width_m: f64,
    },
}

/// Pattern of a route.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pattern {
    /// Kind of ground that it covers.
    pub cover: CoveredGround,
    /// Longitude and latitude of the corners or of the line, degrees.
    pub places: Vec<[f64; 2]>,
    /// Share of a picture that the pass beside shows too.
    pub side_overlap: f64,
    /// Share of a picture that the next one shows too.
    pub forward_overlap: f64,
    /// Course of the passes, degrees from north; that with the fewest passes if `None`.
    pub course_deg: Option<f64>,
}

/// Circumstances for which the passes are made.
#[derive(Clone, Debug, PartialEq)]
pub struct PassCircumstances {
    /// The world frame.
    pub frame: LocalFrame,
    /// The camera.
    pub camera: CameraModel,
    /// Height above ground, metres.
    pub height: f64,
    /// Radius of a turn, metres.
    pub radius: f64,
}

/// Distance within which a place is the same, metres.
const SAME_PLACE: f64 = 0.5;

/// Passes of a route as they lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LaidPasses {
    /// Their number.
    pub count: usize,
    /// Greatest distance between neighbours, metres; `None` of fewer than two.
    pub spacing: Option<f64>,
    /// Number of passes that the pattern takes now.
    pub needed: usize,
    /// Whether the pattern would be laid like that now.
    pub is_of_now: bool,
}

/// Greatest distance between neighbouring passes of `per_pass` way-points each, there and back, metres.
fn spacing(way_points: &[WayPoint], per_pass: usize) -> Option<f64> {
    let (a, b) = (way_points.first()?.position, way_points.get(1)?.position);
    let along = b.to_vector() - a.to_vector();
    let passes = way_points.chunks_exact(per_pass).enumerate();
    // Of every second pass the end lies beside the beginning of the first.
    let beside = passes.filter_map(|(i, pass)| {
        let end = if i % 2 == 0 {
            pass.first()?
        } else {
            pass.last()?
        };
        let way = end.position.to_vector() - a.to_vector();
        Some((along.x * way.y - along.y * way.x) / along.norm())
    });
    let mut beside: Vec<f64> = beside.collect();
    sort(&mut beside, &|a, b| a.total_cmp(b));
    let steps = beside.windows(2).map(|pair| pair[1] - pair[0]);
    steps.max_by(f64::total_cmp)
}

impl Pattern {
    /// A pattern with the usual overlaps over or along these places.
    pub fn new(cover: CoveredGround, places: &[GroundPoint], frame: &LocalFrame) -> Self {
        let lon_lat = |p: &GroundPoint| {
            let position = frame.geodetic_from_ground(p);
            [
                position.longitude.to_degrees(),
                position.latitude.to_degrees(),
            ]
        };
        Self {
            cover,
            places: places.iter().map(lon_lat).collect(),
            side_overlap: 0.6,
            forward_overlap: 0.7,
            course_deg: None,
        }
    }

    /// The pattern that a route is made of.
    pub fn of(route: &Route) -> Option<Self> {
        serde_json::from_str(route.properties.get(PROPERTY)?).ok()
    }

    /// Lets a route be no pattern any more: its way-points are moved one by one.
    pub fn release(route: &mut Route) {
        route.properties.remove(PROPERTY);
    }

    /// Share of a picture that the pass beside shows too where passes are `spacing` metres apart; negative where there is a
    /// gap between them.
    pub(super) fn overlap(spacing: f64, c: &PassCircumstances) -> f64 {
        let (across, _) = picture_on_ground(&c.camera, c.height);
        1.0 - spacing / across
    }

    /// Spacing of its passes beside each other.
    fn passes(&self, c: &PassCircumstances) -> Passes {
        let (across, _) = picture_on_ground(&c.camera, c.height);
        Passes {
            spacing: across * (1.0 - self.side_overlap),
            run_out: c.radius,
            least_step: 2.0 * c.radius,
        }
    }

    /// Distance between pictures along a pass, metres.
    pub(super) fn between_pictures(&self, c: &PassCircumstances) -> f64 {
        let (_, along) = picture_on_ground(&c.camera, c.height);
        along * (1.0 - self.forward_overlap)
    }

    /// Number of way-points of a pass.
    fn per_pass(&self, frame: &LocalFrame) -> usize {
        match self.cover {
            CoveredGround::Survey => 2,
            CoveredGround::Corridor { .. } => bends(&self.on_ground(frame)).len().max(1),
        }
    }

    /// Its corners or its line.
    fn on_ground(&self, frame: &LocalFrame) -> Vec<GroundPoint> {
        let ground = |[longitude, latitude]: &[f64; 2]| {
            let place = Geodetic::from_degrees(*latitude, *longitude, 0.0);
            frame.ground_from_geodetic(&place)
        };
        self.places.iter().map(ground).collect()
    }

    /// Passes of a route that is made of it.
    pub(super) fn laid(&self, route: &Route, c: &PassCircumstances) -> LaidPasses {
        let per_pass = self.per_pass(&c.frame);
        let now = self.places(c);
        let is_close =
            |(at, place): (&WayPoint, &GroundPoint)| at.position.distance(place) < SAME_PLACE;
        let is_of_now =
            now.len() == route.way_points.len() && route.way_points.iter().zip(&now).all(is_close);
        LaidPasses {
            count: route.way_points.len() / per_pass,
            spacing: spacing(&route.way_points, per_pass),
            needed: now.len() / per_pass,
            is_of_now,
        }
    }

    /// The way-points of the pattern.
    fn places(&self, c: &PassCircumstances) -> Vec<GroundPoint> {
        let places = self.on_ground(&c.frame);
        match self.cover {
            CoveredGround::Survey => {
                let stated = self.course_deg.map(f64::to_radians);
                let course = stated.or_else(|| fewest_passes(&places)).unwrap_or(0.0);
                survey(&places, course, &self.passes(c))
            }
            CoveredGround::Corridor { width_m } => corridor(&places, width_m, &self.passes(c)),
        }
    }

    /// Makes a route of it; altitude and speed are those of the route's first way-points, or
    /// `otherwise`. A take-off at its beginning and a landing at its end stay, the landing at its altitude.
    pub fn apply(&self, route: &mut Route, otherwise: Altitude, c: &PassCircumstances) {
        let altitude = route.way_points.first().map_or(otherwise, |w| w.altitude);
        let speed = route.way_points.get(1).and_then(|w| w.speed);
        let take_off = route.way_points.first().cloned();
        let take_off = take_off.filter(|w| w.action == WayPointAction::TakeOff);
        let landing = route.way_points.last().cloned();
        let landing = landing.filter(|w| w.action == WayPointAction::Land);
        let places = self.places(c).into_iter().enumerate();
        let way_points = places.map(|(i, place)| WayPoint {
            speed: speed.filter(|_| i > 0),
            ..WayPoint::new(place, altitude)
        });
        route.way_points = way_points.collect();
        let keep = |new: Option<&mut WayPoint>, old: Option<WayPoint>| {
            if let Some((new, old)) = new.zip(old) {
                let (position, speed) = (new.position, new.speed);
                *new = WayPoint {
                    position,
                    speed,
                    ..old
                };
            }
        };
        keep(route.way_points.first_mut(), take_off);
        keep(route.way_points.last_mut(), landing);
        let text = serde_json::to_string(self).unwrap_or_default();
        route.properties.insert(PROPERTY.to_owned(), text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::frames::AltitudeFrame;

    fn circumstances() -> PassCircumstances {
        PassCircumstances {
            frame: LocalFrame::new(Geodetic::from_degrees(47.0, 8.0, 0.0)),
            camera: CameraModel::pinhole(640, 480, 60.0_f64.to_radians()),
            height: 100.0,
            radius: 40.0,
        }
    }

    fn field() -> Vec<GroundPoint> {
        let corners = [(0.0, 0.0), (0.0, 600.0), (300.0, 600.0), (300.0, 0.0)];
        corners.map(|(n, e)| GroundPoint::new(n, e)).to_vec()
    }

    #[test]
    fn passes_lie_as_far_apart_as_the_overlap_allows() {
        let c = circumstances();
        let pattern = Pattern::new(CoveredGround::Survey, &field(), &c.frame);
        let mut route = Route::default();
        let altitude = Altitude::new(100.0, AltitudeFrame::AboveGround);
        pattern.apply(&mut route, altitude, &c);
        // 115.5 m across and 60 % overlap: 46.2 m, so that 300 m take seven passes.
        assert_eq!(route.way_points.len(), 14);
        assert_eq!(Pattern::of(&route), Some(pattern));
        Pattern::release(&mut route);
        assert_eq!(Pattern::of(&route), None);
    }

    #[test]
    fn a_route_keeps_its_altitude_and_speed_under_another_overlap() {
        let c = circumstances();
        let mut pattern = Pattern::new(CoveredGround::Survey, &field(), &c.frame);
        let mut route = Route::default();
        let low = Altitude::new(80.0, AltitudeFrame::Amsl);
        pattern.apply(&mut route, low, &c);
        for way_point in &mut route.way_points[1..] {
            way_point.speed = Some(14.0);
        }
        pattern.side_overlap = 0.8;
        let other = Altitude::new(1.0, AltitudeFrame::AboveGround);
        pattern.apply(&mut route, other, &c);
        assert_eq!(route.way_points.len(), 26);
        assert!(route.way_points.iter().all(|w| w.altitude == low));
        assert!(route.way_points[1..].iter().all(|w| w.speed == Some(14.0)));
    }

    #[test]
    fn take_off_and_landing_stay_at_the_ends_under_another_overlap() {
        let c = circumstances();
        let mut pattern = Pattern::new(CoveredGround::Survey, &field(), &c.frame);
        let mut route = Route::default();
        let high = Altitude::new(100.0, AltitudeFrame::AboveGround);
        pattern.apply(&mut route, high, &c);
        let ground = Altitude::new(0.0, AltitudeFrame::AboveGround);
        route.way_points[0].action = WayPointAction::TakeOff;
        route.way_points[13].action = WayPointAction::Land;
        route.way_points[13].altitude = ground;
        let there = route.way_points[13].position;
        pattern.side_overlap = 0.8;
        pattern.apply(&mut route, ground, &c);
        let actions: Vec<_> = route.way_points.iter().map(|w| w.action).collect();
        assert_eq!(actions.len(), 26);
        assert_eq!(actions[0], WayPointAction::TakeOff);
        assert_eq!(actions[25], WayPointAction::Land);
        assert!(actions[1..25].iter().all(|a| *a == WayPointAction::FlyBy));
        assert_eq!(route.way_points[25].altitude, ground);
        assert_eq!(route.way_points[0].altitude, high);
        assert_ne!(
            route.way_points[25].position, there,
            "it lands where it ends"
        );
    }

    #[test]
    fn passes_are_told_as_they_lie_and_not_as_they_would_be_laid_now() {
        let c = circumstances();
        let pattern = Pattern::new(CoveredGround::Survey, &field(), &c.frame);
        let mut route = Route::default();
        let altitude = Altitude::new(100.0, AltitudeFrame::AboveGround);
        pattern.apply(&mut route, altitude, &c);
        let laid = pattern.laid(&route, &c);
        assert_eq!((laid.count, laid.needed, laid.is_of_now), (7, 7, true));
        // 300 m in seven strips, of pictures 115.5 m wide.
        let spacing = laid.spacing.unwrap();
        assert!((spacing - 300.0 / 7.0).abs() < 1e-6, "{spacing}");
        assert!((Pattern::overlap(spacing, &c) - 0.629).abs() < 1e-3);
        // From 50 m they are 57.7 m wide: 23.1 m apart, 13 passes.
        let low = PassCircumstances {
            height: 50.0,
            ..circumstances()
        };
        let laid = pattern.laid(&route, &low);
        assert_eq!((laid.count, laid.needed, laid.is_of_now), (7, 13, false));
        assert_eq!(laid.spacing, Some(spacing));
        assert!((Pattern::overlap(spacing, &low) - 0.258).abs() < 1e-3);
        // Wider turns: as many passes, in another order.
        let wide = PassCircumstances {
            radius: 100.0,
            ..circumstances()
        };
        let laid = pattern.laid(&route, &wide);
        assert_eq!((laid.needed, laid.is_of_now), (7, false));
    }

    #[test]
    fn passes_of_a_corridor_are_as_far_apart_as_their_beginnings() {
        let c = circumstances();
        let line = [(0.0, 0.0), (500.0, 0.0), (500.0, 500.0)];
        let line = line.map(|(n, e)| GroundPoint::new(n, e));
        // Files have the first way-point where they take off, too.
        let twice = [line[0], line[0], line[1], line[2]];
        for line in [&line[..], &twice] {
            let cover = CoveredGround::Corridor { width_m: 200.0 };
            let pattern = Pattern::new(cover, line, &c.frame);
            let mut route = Route::default();
            let altitude = Altitude::new(100.0, AltitudeFrame::AboveGround);
            pattern.apply(&mut route, altitude, &c);
            let laid = pattern.laid(&route, &c);
            // 46.2 m at most: five passes in 200 m.
            assert_eq!((laid.count, laid.needed, laid.is_of_now), (5, 5, true));
            assert!((laid.spacing.unwrap() - 40.0).abs() < 1e-3, "{laid:?}");
        }
    }
}
