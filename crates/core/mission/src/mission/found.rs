//! Landmarks and routes on the globe, as files hold them, before the world frame is known.

use std::collections::{BTreeMap, BTreeSet};

use super::{NoFlyZone, RallyPoint, Route, WayPoint, globe};
use pilotage_base::frames::{Altitude, Geodetic, GroundPoint, GroundRect, LocalFrame};
use pilotage_vision::landmark::Landmark;

/// Longitude and latitude, degrees.
pub(crate) type LonLat = (f64, f64);

/// Sides of the box that a place gets of which only a point is known, metres.
pub(crate) const POINT_BOX: f64 = 20.0;

/// Extent of a landmark as a file states it.
pub(crate) enum LandmarkExtent {
    /// The landmark is the box around these corners.
    Corners(Vec<LonLat>),
    /// Only this point is known; it gets a box of [`POINT_BOX`].
    Point(LonLat),
    /// A box of a size around a point.
    Around {
        /// The point.
        point: LonLat,
        /// Middle of the box from that point, metres north and east.
        offset: (f64, f64),
        /// Extents of the box to the north and to the east, metres.
        size: (f64, f64),
    },
}

impl LandmarkExtent {
    fn points(&self) -> &[LonLat] {
        match self {
            Self::Corners(corners) => corners,
            Self::Point(point) | Self::Around { point, .. } => std::slice::from_ref(point),
        }
    }
}

/// A landmark of a file.
pub(crate) struct FoundLandmark {
    /// Extent on the globe.
    pub extent: LandmarkExtent,
    /// Rings inside of the corners that are not part of it.
    pub holes: Vec<Vec<LonLat>>,
    /// The point that is measured; the middle of the box where there is none.
    pub reference: Option<LonLat>,
    /// Its identity in the file.
    pub id: Option<u32>,
    /// Name for people.
    pub name: Option<String>,
    /// Height of the reference above the ground, metres.
    pub height: f64,
    /// Whether the navigator looks for it.
    pub enabled: bool,
    /// Unknown properties, as JSON text.
    pub properties: BTreeMap<String, String>,
}

impl FoundLandmark {
    /// A landmark on the ground of which only its place is known.
    pub fn new(extent: LandmarkExtent) -> Self {
        Self {
            extent,
            holes: Vec::new(),
            reference: None,
            id: None,
            name: None,
            height: 0.0,
            enabled: true,
            properties: BTreeMap::new(),
        }
    }
}

/// A route of a file; the positions of its way-points stand beside them.
#[derive(Default)]
pub(crate) struct ReadRoute {
    /// Its identity in the file.
    pub id: Option<u32>,
    /// Name for people.
    pub name: Option<String>,
    /// Places of the way-points, and the way-points, which do not know theirs yet.
    pub way_points: Vec<(LonLat, WayPoint)>,
    /// Whether the aircraft returns to its home behind the last way-point.
    pub returns: bool,
    /// Unknown properties, as JSON text.
    pub properties: BTreeMap<String, String>,
}

/// An area of a file that must not be flown over.
pub(crate) struct FoundNoFly {
    /// Name for people.
    pub name: Option<String>,
    /// Its corners.
    pub corners: Vec<LonLat>,
    /// Rings inside of it that are not part of it.
    pub holes: Vec<Vec<LonLat>>,
    /// Unknown properties, as JSON text.
    pub properties: BTreeMap<String, String>,
}

/// A rally point of a file, which does not know its place in the world yet.
pub(crate) struct FoundRally {
    /// Name for people.
    pub name: Option<String>,
    /// Its place.
    pub place: LonLat,
    /// Altitude at which the aircraft comes there.
    pub altitude: Altitude,
    /// Unknown properties, as JSON text.
    pub properties: BTreeMap<String, String>,
}

/// The rally points in the world.
pub(crate) fn rally(found: Vec<FoundRally>, frame: &LocalFrame) -> Vec<RallyPoint> {
    let points = found.into_iter().enumerate().map(|(index, found)| {
        let (longitude, latitude) = found.place;
        let name = found.name;
        RallyPoint {
            name: name.unwrap_or_else(|| RallyPoint::usual_name(index + 1)),
            position: globe::ground(frame, longitude, latitude),
            altitude: found.altitude,
            properties: found.properties,
        }
    });
    points.collect()
}

/// The areas in the world.
pub(crate) fn no_fly(found: Vec<FoundNoFly>, frame: &LocalFrame) -> Vec<NoFlyZone> {
    let zones = found.into_iter().enumerate().map(|(index, found)| {
        let ring = |corners: &[LonLat]| -> Vec<GroundPoint> {
            let corners = corners.iter();
            corners
                .map(|(lon, lat)| globe::ground(frame, *lon, *lat))
                .collect()
        };
        NoFlyZone {
            name: found
                .name
                .unwrap_or_else(|| format!("No-fly area {}", index + 1)),
            corners: ring(&found.corners),
            holes: found.holes.iter().map(|hole| ring(hole)).collect(),
            properties: found.properties,
        }
    });
    zones.collect()
}

/// Whether these can be a longitude and a latitude in degrees.
pub(crate) fn on_globe(longitude: f64, latitude: f64) -> bool {
    (-540.0..=540.0).contains(&longitude) && (-90.0..=90.0).contains(&latitude)
}

/// The middle of all places on the sphere: the direction of the mean of their directions from the
/// middle of the Earth, which knows no date line and no pole; `None` if there are none, or if they lie
/// around the whole globe, where no middle is.
pub(crate) fn middle_of(places: &[LonLat]) -> Option<Geodetic> {
    let mut sum = [0.0_f64; 3];
    for (longitude, latitude) in places {
        let (sin_lat, cos_lat) = latitude.to_radians().sin_cos();
        let (sin_lon, cos_lon) = longitude.to_radians().sin_cos();
        let direction = [cos_lat * cos_lon, cos_lat * sin_lon, sin_lat];
        for (sum, part) in sum.iter_mut().zip(direction) {
            *sum += part / places.len() as f64;
        }
    }
    let [x, y, z] = sum;
    (x.hypot(y).hypot(z) > 1e-3).then(|| {
        Geodetic::from_degrees(
            z.atan2(x.hypot(y)).to_degrees(),
            y.atan2(x).to_degrees(),
            0.0,
        )
    })
}

/// Places of landmarks and routes.
pub(crate) fn places(landmarks: &[FoundLandmark], routes: &[ReadRoute]) -> Vec<LonLat> {
    let corners = landmarks.iter().flat_map(|l| l.extent.points());
    let way_points = routes
        .iter()
        .flat_map(|r| r.way_points.iter().map(|(place, _)| place));
    corners.chain(way_points).copied().collect()
}

/// The middle of all corners and way-points, on the ellipsoid; `None` if there is none.
pub(crate) fn middle(landmarks: &[FoundLandmark], routes: &[ReadRoute]) -> Option<Geodetic> {
    middle_of(&places(landmarks, routes))
}

/// Identities: those of the file, and free ones where it has none or has one twice.
fn identities(wanted: &[Option<u32>]) -> Vec<u32> {
    let mut taken = BTreeSet::new();
    let own: Vec<bool> = wanted
        .iter()
        .map(|id| id.is_some_and(|id| taken.insert(id)))
        .collect();
    let mut next = 1;
    let mut free = || {
        while !taken.insert(next) {
            next += 1;
        }
        next
    };
    wanted
        .iter()
        .zip(own)
        .map(|(id, own)| id.filter(|_| own).unwrap_or_else(&mut free))
        .collect()
}

/// The landmarks in the world.
pub(crate) fn landmarks(found: Vec<FoundLandmark>, frame: &LocalFrame) -> Vec<Landmark> {
    let wanted: Vec<_> = found.iter().map(|f| f.id).collect();
    let point = |(longitude, latitude): LonLat| globe::ground(frame, longitude, latitude);
    found
        .into_iter()
        .zip(identities(&wanted))
        .map(|(found, id)| {
            let bounds = match &found.extent {
                LandmarkExtent::Corners(corners) => {
                    let corners: Vec<GroundPoint> = corners.iter().copied().map(point).collect();
                    globe::bounds(&corners)
                        .unwrap_or_else(|| GroundRect::centered(GroundPoint::default(), 0.0, 0.0))
                }
                LandmarkExtent::Point(middle) => {
                    GroundRect::centered(point(*middle), POINT_BOX, POINT_BOX)
                }
                LandmarkExtent::Around {
                    point: middle,
                    offset,
                    size,
                } => {
                    let middle = point(*middle);
                    let middle = GroundPoint::new(middle.north + offset.0, middle.east + offset.1);
                    GroundRect::centered(middle, size.0, size.1)
                }
            };
            let reference = found.reference.map_or(bounds.center(), point);
            let mut landmark = Landmark {
                name: found.name.unwrap_or_else(|| format!("Landmark {id}")),
                height: found.height,
                enabled: found.enabled,
                reference,
                properties: found.properties,
                ..Landmark::new(id, "", bounds)
            };
            match &found.extent {
                LandmarkExtent::Corners(corners) => {
                    let corners: Vec<GroundPoint> = corners.iter().copied().map(point).collect();
                    if !globe::is_box(&corners) {
                        landmark.set_outline(globe::open(&corners));
                    }
                }
                LandmarkExtent::Point(_) => landmark.mark_point(),
                LandmarkExtent::Around { .. } => {}
            }
            if !found.holes.is_empty() {
                let holes: Vec<Vec<GroundPoint>> = found
                    .holes
                    .iter()
                    .map(|ring| ring.iter().copied().map(point).collect())
                    .collect();
                let holes: Vec<_> = holes
                    .iter()
                    .map(|ring| globe::open(ring).to_vec())
                    .collect();
                landmark.set_holes(&holes);
            }
            landmark
        })
        .collect()
}

/// The routes in the world.
pub(crate) fn routes(found: Vec<ReadRoute>, frame: &LocalFrame) -> Vec<Route> {
    let wanted: Vec<_> = found.iter().map(|f| f.id).collect();
    found
        .into_iter()
        .zip(identities(&wanted))
        .map(|(found, id)| Route {
            id,
            name: found.name.unwrap_or_else(|| format!("Route {id}")),
            way_points: found
                .way_points
                .into_iter()
                .map(|((longitude, latitude), way_point)| WayPoint {
                    position: globe::ground(frame, longitude, latitude),
                    ..way_point
                })
                .collect(),
            returns: found.returns,
            properties: found.properties,
        })
        .collect()
}
