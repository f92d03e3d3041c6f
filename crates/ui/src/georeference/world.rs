//! Places on the globe of a picture's points: beside the map that is open, or in another country.

use nalgebra::Point2;
use pilotage_core::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame, ReferenceSystem};
use pilotage_jobs::{MapSource, PresumedSystem};

use super::Georeferencer;
use crate::map::{distance_over_ground, is_in_reach};

/// Complaint about a place that is not where the other points are.
const FAR: &str = "is too far from the other points. Delete those first, or undo them.";

impl Georeferencer {
    /// Takes the world that the map beside is shown in.
    pub(super) fn know_world(&mut self, origin: Option<Geodetic>) {
        let known = self.frame.map(|frame| frame.origin);
        if origin.is_some() && origin != known {
            self.frame = origin.map(LocalFrame::new);
        }
    }

    /// A place on the globe where the picture lies, as far as its points tell.
    pub fn somewhere(&self) -> Option<Geodetic> {
        let place = self.points.first().map(|point| point.place);
        let place = place.or(self.pending.place)?;
        self.system?.geodetic(place.x, place.y)
    }

    /// The system that points of a file are taken to be in which names none: the plane of the points that there are, or of
    /// the world of the map beside.
    pub(super) fn presumed_system(&self) -> Option<PresumedSystem> {
        let near = (self.somewhere()).or_else(|| self.frame.map(|frame| frame.origin))?;
        let system = self.system?;
        Some(PresumedSystem { system, near })
    }

    /// Distance of the picture from the map beside over the ground, metres, where it lies beyond the reach of that map's world.
    pub fn far_from_map(&self) -> Option<f64> {
        self.distance(&self.somewhere()?)
    }

    /// Distance of a place from the world of the map over the ground, metres, if that world does not reach it.
    fn distance(&self, place: &Geodetic) -> Option<f64> {
        let frame = self.frame?;
        (!is_in_reach(&frame, place)).then(|| distance_over_ground(&frame, place))
    }

    /// Takes a place on the globe for the point being picked. The first decides on the plane, wherever it lies; of the
    /// others those are refused, in words beside the field, that the plane does not reach.
    pub fn pick_globe(&mut self, at: &Geodetic) {
        let is_first = self.points.is_empty();
        if is_first && (self.frame.is_none() || self.distance(at).is_some()) {
            self.change_plane(Some(ReferenceSystem::utm_around(at)));
        } else if is_first && let Some(frame) = self.frame {
            self.change_plane(Some(ReferenceSystem::utm_around(&frame.origin)));
        }
        let system = self.system;
        self.frame.get_or_insert_with(|| LocalFrame::new(*at));
        match system.and_then(|system| system.coordinates(at)) {
            Some((x, y)) => self.pick_place(Point2::new(x, y)),
            None => self.typed_wrong = Some(format!("This place {FAR}")),
        }
    }

    /// Takes a place of the map for the point being picked.
    pub fn pick_ground(&mut self, ground: &GroundPoint) {
        if !self.points.is_empty() && self.far_from_map().is_some() {
            self.typed_wrong = Some(format!("A place of this map {FAR}"));
            return;
        }
        let Some(frame) = self.frame else {
            let why = "The open map has no place on the globe itself: type coordinates.";
            self.typed_wrong = Some(why.to_owned());
            return;
        };
        self.pick_globe(&frame.geodetic_from_ground(ground));
    }

    /// The place in the plane of a point of the map.
    pub fn place_of(&self, ground: &GroundPoint) -> Option<Point2<f64>> {
        let place = self.frame?.geodetic_from_ground(ground);
        let (x, y) = self.system?.coordinates(&place)?;
        Some(Point2::new(x, y))
    }

    /// The point of the map at a place in the plane.
    pub fn ground_of(&self, place: &Point2<f64>) -> Option<GroundPoint> {
        let place = self.system?.geodetic(place.x, place.y)?;
        Some(self.frame?.ground_from_geodetic(&place))
    }

    /// Ground of all points, to show it on the map; `None` where the map does not reach.
    pub fn ground(&self) -> Option<GroundRect> {
        if self.far_from_map().is_some() {
            return None;
        }
        GroundRect::around(self.points.iter().filter_map(|p| self.ground_of(&p.place)))
    }

    /// The picture as a map where the fit puts it: in the world of the map beside, or in one of its own.
    pub fn placed(&self) -> Option<MapSource> {
        let fitted = self.fitted().as_ref().ok()?;
        let place = fitted.georeference(self.system?);
        let middle = place.origin(self.size?.0 as usize, self.size?.1 as usize);
        let world = self.frame.map(|frame| frame.origin);
        let world = world.filter(|_| self.far_from_map().is_none());
        Some(MapSource::Picture {
            key: self.key.clone(),
            name: self.name.clone(),
            origin: world.or(middle),
            place,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pixels and the places of a picture in the north-east of Duluth, beside a map in the Atlantic.
    fn far() -> Georeferencer {
        let map = Geodetic::from_degrees(45.0, -30.0, 0.0);
        let mut it = Georeferencer::new("opened-1", "ortho.jpg", Some(map));
        it.size = Some((1000.0, 800.0));
        it
    }

    #[test]
    fn the_first_point_may_lie_in_any_country_and_decides_on_the_plane() {
        let mut it = far();
        for (pixel, latitude, longitude) in [
            ((0.0, 0.0), 46.8430, -91.9950),
            ((1000.0, 0.0), 46.8430, -91.9937),
            ((1000.0, 800.0), 46.8423, -91.9937),
        ] {
            it.pick_pixel(Point2::new(pixel.0, pixel.1));
            it.pick_globe(&Geodetic::from_degrees(latitude, longitude, 0.0));
        }
        assert_eq!(it.points.len(), 3);
        assert_eq!(it.system.and_then(|s| s.epsg()), Some(32_615));
        let km = 1e-3 * it.far_from_map().expect("another country");
        assert!((4000.0..5000.0).contains(&km), "{km} km");
        assert!(it.ground().is_none());
        let origin = it.placed().and_then(|map| map.origin()).expect("a fit");
        assert!((origin.latitude.to_degrees() - 46.8427).abs() < 5e-4);
        // The map beside is no help, and says so.
        it.pick_pixel(Point2::new(5.0, 5.0));
        it.pick_ground(&GroundPoint::default());
        assert!(
            it.typed_wrong
                .as_ref()
                .is_some_and(|why| why.contains("too far"))
        );
        assert_eq!(it.points.len(), 3);
        // A map that is opened there is.
        it.know_world(Some(Geodetic::from_degrees(46.8427, -91.994, 0.0)));
        assert!(it.far_from_map().is_none() && it.ground().is_some());
        it.pick_ground(&GroundPoint::default());
        assert_eq!(it.points.len(), 4);
    }

    #[test]
    fn a_place_that_the_plane_does_not_reach_is_refused_in_words_and_taken_once_nothing_contradicts()
     {
        let mut it = far();
        it.pick_pixel(Point2::new(0.0, 0.0));
        it.pick_ground(&GroundPoint::default());
        assert_eq!(it.system.and_then(|s| s.epsg()), Some(32_626));
        it.pick_pixel(Point2::new(10.0, 0.0));
        let other = Geodetic::from_degrees(46.8430, -91.9950, 0.0);
        it.pick_globe(&other);
        assert_eq!(it.points.len(), 1);
        assert!(it.typed_wrong.is_some());
        it.undo();
        it.undo();
        it.pick_pixel(Point2::new(0.0, 0.0));
        it.pick_globe(&other);
        assert_eq!(it.points.len(), 1);
        assert_eq!(it.system.and_then(|s| s.epsg()), Some(32_615));
    }

    #[test]
    fn a_map_without_a_place_on_the_globe_says_that_coordinates_are_to_be_typed() {
        let mut it = Georeferencer::new("opened-1", "ortho.jpg", None);
        it.pick_pixel(Point2::new(0.0, 0.0));
        it.pick_ground(&GroundPoint::default());
        assert!(it.typed_wrong.is_some() && it.points.is_empty());
        it.pick_globe(&Geodetic::from_degrees(-33.9, 18.4, 0.0));
        assert_eq!(it.system.and_then(|s| s.epsg()), Some(32_734));
    }
}
