//! Distances, courses and areas of the ground below a local tangent plane.

use std::f64::consts::TAU;

use super::{Geodetic, GroundPoint, GroundRect, LocalFrame};

/// Mean radius of WGS 84, metres: a third of twice the equatorial one and the polar one.
const MEAN_RADIUS: f64 = 6_371_008.8;

impl LocalFrame {
    /// Place straight above or below a point of the plane, as high above the ellipsoid as the origin.
    fn level(&self, point: &GroundPoint) -> Geodetic {
        Geodetic {
            height: self.origin.height,
            ..self.geodetic_from_ground(point)
        }
    }

    /// Mean radius of the Earth at the origin's height, metres.
    fn radius(&self) -> f64 {
        MEAN_RADIUS + self.origin.height
    }

    /// Distance over the ground (metres, at the origin's height above the ellipsoid) and the course on which it begins
    /// (radians clockwise from true north, 0 to 2π).
    ///
    /// The course is that of the place where it begins: the plane's own north is true at its origin alone. The arc over
    /// the chord is that of a sphere, which makes an error below 10 mm at 100 km.
    pub fn distance_and_course(&self, from: &GroundPoint, to: &GroundPoint) -> (f64, f64) {
        let [from, to] = [from, to].map(|point| self.level(point));
        let chord = Self::new(from).world_from_geodetic(&to).coords;
        let diameter = 2.0 * self.radius();
        let distance = diameter * (chord.norm() / diameter).min(1.0).asin();
        (distance, chord.y.atan2(chord.x).rem_euclid(TAU))
    }

    /// Area within a polygon of the ground, square metres at the origin's height above the ellipsoid; of one that
    /// crosses itself the difference of its parts.
    ///
    /// A tangent plane shows the ground as if seen from the Earth's centre: shortest ways are straight lines, and an
    /// area is the larger the farther out it lies. The polygon is carried onto the plane at its own middle, and what is
    /// left of that is taken out along its sides: the integral of the density (1 + r²/R²)^(-3/2) by Green's theorem.
    pub fn area(&self, corners: &[GroundPoint]) -> f64 {
        let Some(around) = GroundRect::around(corners.iter().copied()) else {
            return 0.0;
        };
        let own = Self::new(self.level(&around.center()));
        let places = corners.iter();
        let places = places.map(|corner| own.ground_from_geodetic(&self.level(corner)).to_vector());
        let places: Vec<_> = places.collect();
        let share = |r_squared: f64| {
            let root = (1.0 + r_squared / self.radius().powi(2)).sqrt();
            2.0 / (root * (1.0 + root))
        };
        let next = places.iter().cycle().skip(1);
        let sides = places.iter().zip(next).map(|(a, b)| {
            let ends = share(a.norm_squared()) + share(b.norm_squared());
            let middle = share((0.5 * (a + b)).norm_squared());
            0.5 * (a.x * b.y - a.y * b.x) * (ends + 4.0 * middle) / 6.0
        });
        sides.sum::<f64>().abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The plane of these origins has the places somewhere out on it, where scale and north differ from the middle's.
    fn frames() -> [LocalFrame; 2] {
        [(47.0, 8.0), (47.4, 9.2)].map(|(latitude, longitude)| frame(latitude, longitude, 0.0))
    }

    fn frame(latitude: f64, longitude: f64, height: f64) -> LocalFrame {
        LocalFrame::new(Geodetic::from_degrees(latitude, longitude, height))
    }

    fn on(frame: &LocalFrame, (latitude, longitude): (f64, f64)) -> GroundPoint {
        frame.ground_from_geodetic(&Geodetic::from_degrees(latitude, longitude, 0.0))
    }

    /// The course of a leg may be off by so many degrees, its length by so many parts of it.
    fn check(frame: &LocalFrame, ends: [(f64, f64); 2], distance: f64, course: f64) {
        let [from, to] = ends.map(|end| on(frame, end));
        let (metres, radians) = frame.distance_and_course(&from, &to);
        assert!(
            (metres - distance).abs() < 1e-3 + 1e-7 * distance,
            "{ends:?}: {metres}, {distance}"
        );
        assert!(
            (radians.to_degrees() - course).abs() < 1e-3,
            "{ends:?}: {}, {course}",
            radians.to_degrees()
        );
    }

    /// Expected values: `pyproj.Geod(ellps="WGS84").inv`, pyproj 3.7.2 with PROJ 9.5.1.
    #[test]
    fn distances_and_true_courses_are_those_of_the_geodesic() {
        for frame in frames() {
            let begin = (47.0, 8.0);
            check(&frame, [begin, (47.01, 8.01)], 1346.9378, 34.37127);
            check(&frame, [begin, (46.995, 7.98)], 1619.5664, 249.93465);
            check(&frame, [(47.3, 8.6), (47.9, 9.4)], 89_828.940_6, 41.75013);
        }
        let wide = frame(46.6, -91.6, 0.0);
        let along = [(46.84, -91.99), (46.84, -90.99)];
        check(&wide, along, 76_282.231, 89.63527);
        let south = frame(-33.9, 151.0, 0.0);
        check(
            &south,
            [(-33.9, 151.2), (-33.95, 151.1)],
            10_782.304_7,
            239.01701,
        );
        check(
            &south,
            [(-33.9, 151.2), (-34.6, 151.2)],
            77_648.840_4,
            180.0,
        );
        // So far north the plane's own north is 0.56° off, 0.6° of longitude from its origin.
        let polar = frame(69.5, 19.4, 0.0);
        check(
            &polar,
            [(69.5, 20.0), (69.51, 20.3)],
            11_780.161_7,
            84.42558,
        );
    }

    /// Expected value: as above, on an ellipsoid with both axes longer by 1500 m.
    #[test]
    fn ways_are_longer_up_in_the_mountains() {
        let high = frame(47.0, 8.0, 1500.0);
        check(&high, [(47.0, 8.0), (47.01, 8.01)], 1347.2546, 34.37125);
    }

    /// Expected values: `pyproj.Geod(ellps="WGS84").polygon_area_perimeter`, pyproj 3.7.2 with PROJ 9.5.1.
    #[test]
    fn areas_are_those_within_geodesics() {
        let small = [(47.0, 8.0), (47.01, 8.0), (47.01, 8.015), (47.0, 8.01)];
        let large = [(47.3, 8.6), (47.9, 8.7), (47.8, 9.6), (47.2, 9.4)];
        for frame in frames() {
            for (corners, area) in [(small, 1_056_797.609), (large, 4_393_468_167.011)] {
                let corners = corners.map(|corner| on(&frame, corner));
                let found = frame.area(&corners);
                assert!((found / area - 1.0).abs() < 1e-6, "{found}, {area}");
            }
        }
        let polar = frame(69.4, 19.0, 0.0);
        let corners = [(69.5, 20.0), (69.51, 20.3), (69.46, 20.2)];
        let found = polar.area(&corners.map(|corner| on(&polar, corner)));
        assert!((found / 30_566_007.865 - 1.0).abs() < 1e-6, "{found}");
        let high = frame(47.0, 8.0, 1500.0);
        let found = high.area(&small.map(|corner| on(&high, corner)));
        assert!((found / 1_057_294.628 - 1.0).abs() < 1e-6, "{found}");
    }

    #[test]
    fn less_than_a_triangle_has_no_area() {
        let [frame, _] = frames();
        let point = GroundPoint::new(30.0, 40.0);
        assert_eq!(frame.area(&[]), 0.0);
        assert!(frame.area(&[point, GroundPoint::default()]).abs() < 1e-9);
        assert_eq!(frame.distance_and_course(&point, &point).0, 0.0);
    }
}
