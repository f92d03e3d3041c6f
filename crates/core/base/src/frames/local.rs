//! WGS 84 and the local tangent plane.

use nalgebra::{Isometry3, Point3, Rotation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use super::{Ellipsoid, GroundPoint};

/// Cosine of the largest angle between the verticals at the origin of a plane and at a place on it.
const FARTHEST_COSINE: f64 = 0.173_648_177_666_930_33;

/// A geodetic position on WGS 84.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Geodetic {
    /// Latitude, radians, north positive.
    pub latitude: f64,
    /// Longitude, radians, east positive.
    pub longitude: f64,
    /// Height above the ellipsoid, metres.
    pub height: f64,
}

impl Geodetic {
    /// From degrees and metres.
    pub fn from_degrees(latitude: f64, longitude: f64, height: f64) -> Self {
        Self {
            latitude: latitude.to_radians(),
            longitude: longitude.to_radians(),
            height,
        }
    }

    fn to_ecef(self) -> Vector3<f64> {
        Ellipsoid::WGS84.geocentric(self.latitude, self.longitude, self.height)
    }

    fn from_ecef(p: Vector3<f64>) -> Self {
        let (latitude, longitude, height) = Ellipsoid::WGS84.geodetic(&p);
        Self {
            latitude,
            longitude,
            height,
        }
    }
}

/// The local tangent plane (NED) at an origin on WGS 84.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LocalFrame {
    /// Point at which north, east and down are zero.
    pub origin: Geodetic,
}

impl LocalFrame {
    /// The frame with its origin there.
    ///
    /// ```
    /// use pilotage_base::frames::{Geodetic, LocalFrame};
    ///
    /// // At the equator a degree of longitude is π/180 of the semi-major axis: 111 319.49 m.
    /// let world = LocalFrame::new(Geodetic::from_degrees(0.0, 0.0, 0.0));
    /// let east = world.world_from_geodetic(&Geodetic::from_degrees(0.0, 0.01, 0.0));
    /// assert!((east.y - 1113.195).abs() < 0.001);
    /// // 100 m up is 100 m against down.
    /// let above = world.world_from_geodetic(&Geodetic::from_degrees(0.0, 0.0, 100.0));
    /// assert!((above.z + 100.0).abs() < 1e-6);
    /// ```
    pub fn new(origin: Geodetic) -> Self {
        Self { origin }
    }

    fn ecef_from_ned(&self) -> Rotation3<f64> {
        let (sin_lat, cos_lat) = self.origin.latitude.sin_cos();
        let (sin_lon, cos_lon) = self.origin.longitude.sin_cos();
        Rotation3::from_matrix_unchecked(nalgebra::Matrix3::new(
            -sin_lat * cos_lon,
            -sin_lon,
            -cos_lat * cos_lon,
            -sin_lat * sin_lon,
            cos_lon,
            -cos_lat * sin_lon,
            cos_lat,
            0.0,
            -sin_lat,
        ))
    }

    /// Transform of positions of the frame `other` (NED, metres) into this one: both are turned and moved
    /// against each other on the globe.
    pub fn world_from_other_world(&self, other: &Self) -> Isometry3<f64> {
        let own_from_ecef = self.ecef_from_ned().inverse();
        let offset = other.origin.to_ecef() - self.origin.to_ecef();
        let rotation = own_from_ecef * other.ecef_from_ned();
        Isometry3::from_parts(
            (own_from_ecef * offset).into(),
            UnitQuaternion::from_rotation_matrix(&rotation),
        )
    }

    /// World position (NED, metres) of a geodetic position.
    pub fn world_from_geodetic(&self, position: &Geodetic) -> Point3<f64> {
        let offset = position.to_ecef() - self.origin.to_ecef();
        Point3::from(self.ecef_from_ned().inverse() * offset)
    }

    /// Geodetic position of a world position (NED, metres).
    pub fn geodetic_from_world(&self, position: &Point3<f64>) -> Geodetic {
        Geodetic::from_ecef(self.origin.to_ecef() + self.ecef_from_ned() * position.coords)
    }

    /// Point of the plane through the origin that lies straight above or below a place, whatever
    /// the height of that place; not a number for a place that [`LocalFrame::ground_if_near`] refuses.
    ///
    /// The plane leaves the ellipsoid by 0.3 m at 2 km and 800 m at 100 km.
    pub fn ground_from_geodetic(&self, position: &Geodetic) -> GroundPoint {
        self.ground_if_near(position)
            .unwrap_or(GroundPoint::new(f64::NAN, f64::NAN))
    }

    /// Point of the plane through the origin that lies straight above or below a place, exactly;
    /// `None` where the verticals at both differ by more than 80°, because beyond 90° no point of the
    /// plane is above.
    pub fn ground_if_near(&self, position: &Geodetic) -> Option<GroundPoint> {
        let position = Geodetic {
            height: self.origin.height,
            ..*position
        };
        let ned_from_ecef = self.ecef_from_ned().inverse();
        let foot = ned_from_ecef * (position.to_ecef() - self.origin.to_ecef());
        let (sin_lat, cos_lat) = position.latitude.sin_cos();
        let (sin_lon, cos_lon) = position.longitude.sin_cos();
        let up = ned_from_ecef * Vector3::new(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat);
        let is_above = -up.z > FARTHEST_COSINE;
        if !is_above {
            return None;
        }
        // The vertical is a straight line: where it meets the plane is one division away.
        let p = foot - up * (foot.z / up.z);
        Some(GroundPoint::new(p.x, p.y))
    }

    /// Geodetic position of a point of the plane through the origin.
    pub fn geodetic_from_ground(&self, ground: &GroundPoint) -> Geodetic {
        self.geodetic_from_world(&Point3::new(ground.north, ground.east, 0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn geodetic_survives_the_round_trip_to_a_nanometre() {
        let frame = LocalFrame::new(Geodetic::from_degrees(46.84, -91.99, 200.0));
        let p = Point3::new(1234.5, -987.6, -321.0);
        let back = frame.world_from_geodetic(&frame.geodetic_from_world(&p));
        assert!((back - p).norm() < 1e-8, "{back}");
    }

    #[test]
    fn a_ground_point_survives_the_round_trip_to_a_micrometre() {
        let frame = LocalFrame::new(Geodetic::from_degrees(-33.9, 151.2, 40.0));
        for distance in [0.0, 10.0, 2000.0, 50_000.0, 300_000.0] {
            let p = GroundPoint::new(0.6 * distance, -0.8 * distance);
            let back = frame.ground_from_geodetic(&frame.geodetic_from_ground(&p));
            assert!(back.distance(&p) < 1e-6, "{distance}: {back:?}");
        }
    }

    #[test]
    fn a_place_beyond_the_plane_is_refused() {
        let frame = LocalFrame::new(Geodetic::from_degrees(0.0, 179.0, 0.0));
        let refused = |longitude| {
            let place = Geodetic::from_degrees(0.0, longitude, 0.0);
            frame.ground_if_near(&place).is_none()
        };
        assert!(!refused(-102.0) && !refused(100.0));
        assert!(refused(-100.0) && refused(98.0) && refused(0.0));
        assert!(
            frame
                .ground_from_geodetic(&Geodetic::from_degrees(0.0, 0.0, 0.0))
                .north
                .is_nan()
        );
    }

    proptest::proptest! {
        #[test]
        fn any_place_survives_the_way_over_any_plane_to_a_micrometre(
            origin in (-90.0_f64..=90.0, -180.0_f64..=180.0, -400.0_f64..6000.0),
            place in (-90.0_f64..=90.0, -180.0_f64..=180.0),
        ) {
            let frame = LocalFrame::new(Geodetic::from_degrees(origin.0, origin.1, origin.2));
            let place = Geodetic::from_degrees(place.0, place.1, 0.0);
            if let Some(ground) = frame.ground_if_near(&place) {
                let back = frame.geodetic_from_ground(&ground);
                let back = Geodetic { height: 0.0, ..back };
                let moved = (back.to_ecef() - place.to_ecef()).norm();
                proptest::prop_assert!(moved < 1e-6, "{moved} m");
            }
        }
    }

    #[test]
    fn a_minute_of_latitude_is_about_a_nautical_mile() {
        let frame = LocalFrame::new(Geodetic::from_degrees(45.0, 10.0, 0.0));
        let p = frame.world_from_geodetic(&Geodetic::from_degrees(45.0 + 1.0 / 60.0, 10.0, 0.0));
        assert!((p.x - 1852.2).abs() < 0.5, "{p}");
    }
}
