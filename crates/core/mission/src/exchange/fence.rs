//! Fences of plans and of files of way-points: those that keep aircraft out, as no-fly areas.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use serde::Deserialize;
use serde_json::{Value, json};

use super::item::MissionItem;
use super::rally::RALLY_POINT;
use crate::mission::NoFlyZone;
use crate::mission::found::{FoundNoFly, LonLat, on_globe};
use pilotage_base::frames::{Geodetic, GroundPoint, LocalFrame};

const RETURN_POINT: u16 = 5000;
const VERTEX_INSIDE: u16 = 5001;
const VERTEX_OUTSIDE: u16 = 5002;
const CIRCLE_INSIDE: u16 = 5003;
const CIRCLE_OUTSIDE: u16 = 5004;
/// Corners that are this near each other are the same, degrees.
const SAME_DEGREES: f64 = 1e-7;
/// Corners of the polygon around a circle.
const CIRCLE_CORNERS: usize = 48;

/// Fences of a file.
#[derive(Default)]
pub(super) struct Fences {
    /// Those that keep aircraft out.
    pub no_fly: Vec<FoundNoFly>,
    /// Notes on all other fences, in sentences for people.
    pub notes: Vec<String>,
}

/// Whether a command is a part of a fence, or a rally point.
pub(super) fn is_fence(command: u16) -> bool {
    (RETURN_POINT..=RALLY_POINT).contains(&command)
}

/// Fences whose corners and circles are commands; corners of one polygon follow each other, and each
/// says how many there are.
pub(super) fn of_items(items: &[&MissionItem]) -> Fences {
    let mut fences = Gathered::default();
    let mut corners: Vec<LonLat> = Vec::new();
    for item in items {
        let [first, .., latitude, longitude, _] = item.parameters.map(|p| p.unwrap_or(0.0));
        let place = (longitude, latitude);
        if is_fence(item.command) && !on_globe(longitude, latitude) {
            fences.broken += 1;
            continue;
        }
        match item.command {
            VERTEX_INSIDE | VERTEX_OUTSIDE => {
                corners.push(place);
                if corners.len() as f64 >= first {
                    let corners = std::mem::take(&mut corners);
                    fences.polygon(corners, item.command == VERTEX_INSIDE);
                }
            }
            CIRCLE_INSIDE | CIRCLE_OUTSIDE => {
                fences.circle(place, first, item.command == CIRCLE_INSIDE);
            }
            RETURN_POINT | RALLY_POINT => {}
            // A circle about home (5005) or one that MAVLink does not have yet.
            command => fences.broken += usize::from(is_fence(command)),
        }
    }
    fences.broken += usize::from(!corners.is_empty());
    fences.finish()
}

/// Fences of a plan, the member `geoFence`; what is no such thing has none.
pub(super) fn of_plan(text: &str) -> Fences {
    #[derive(Deserialize)]
    struct GeoFence {
        #[serde(default)]
        circles: Vec<Circle>,
        #[serde(default)]
        polygons: Vec<FencePolygon>,
        /// Plans of before 2018 have one fence, which keeps the aircraft in.
        #[serde(default)]
        polygon: Vec<(f64, f64)>,
    }
    #[derive(Deserialize)]
    struct Circle {
        circle: FenceCircle,
        inclusion: bool,
    }
    #[derive(Deserialize)]
    struct FenceCircle {
        center: (f64, f64),
        radius: f64,
    }
    #[derive(Deserialize)]
    struct FencePolygon {
        polygon: Vec<(f64, f64)>,
        inclusion: bool,
    }
    let mut fences = Gathered::default();
    let Ok(stated) = serde_json::from_str::<GeoFence>(text) else {
        return Fences::default();
    };
    fences.inside += usize::from(!stated.polygon.is_empty());
    for FencePolygon { polygon, inclusion } in stated.polygons {
        let corners: Vec<LonLat> = polygon.into_iter().map(|(lat, lon)| (lon, lat)).collect();
        if corners.iter().all(|(lon, lat)| on_globe(*lon, *lat)) {
            fences.polygon(corners, inclusion);
        } else {
            fences.broken += 1;
        }
    }
    for Circle { circle, inclusion } in stated.circles {
        let (latitude, longitude) = circle.center;
        fences.circle((longitude, latitude), circle.radius, inclusion);
    }
    fences.finish()
}

/// Corners of those of `areas` that are none of the fences `known`.
fn beside(known: &[FoundNoFly], areas: &[NoFlyZone], frame: &LocalFrame) -> Vec<Vec<LonLat>> {
    let corners = |area: &NoFlyZone| -> Vec<LonLat> {
        let places = area.corners.iter().map(|c| frame.geodetic_from_ground(c));
        let degrees = |p: Geodetic| (p.longitude.to_degrees(), p.latitude.to_degrees());
        places.map(degrees).collect()
    };
    let is_known = |area: &[LonLat]| {
        let same = |(a, b): (&LonLat, &LonLat)| {
            (a.0 - b.0).abs() < SAME_DEGREES && (a.1 - b.1).abs() < SAME_DEGREES
        };
        let is_it = |other: &FoundNoFly| {
            other.corners.len() == area.len() && other.corners.iter().zip(area).all(same)
        };
        known.iter().any(is_it)
    };
    let corners = areas.iter().map(corners);
    corners.filter(|area| !is_known(area)).collect()
}

/// That areas are left out which are none of the fences `known` of a file, if there are any.
pub(super) fn left_out(
    known: &[FoundNoFly],
    areas: &[NoFlyZone],
    frame: &LocalFrame,
) -> Option<String> {
    let count = beside(known, areas, frame).len();
    (count > 0).then(|| {
        format!(
            "{count} × no-fly area is left out: plans have them as fences, KML and GeoJSON as areas"
        )
    })
}

/// The member `geoFence` of a plan that keeps aircraft out of `areas`, after what a plan said before (`kept`): areas that
/// came from it are not written again.
pub(super) fn with_areas(kept: &str, areas: &[NoFlyZone], frame: &LocalFrame) -> String {
    let new = beside(&of_plan(kept).no_fly, areas, frame);
    let Ok(mut fences) = serde_json::from_str::<Value>(kept) else {
        return kept.to_owned();
    };
    if new.is_empty() {
        return kept.to_owned();
    }
    let nine = |degrees: f64| (degrees * 1e9).round() / 1e9;
    let polygon = |area: Vec<LonLat>| {
        let ring = area.into_iter().map(|(lon, lat)| [nine(lat), nine(lon)]);
        json!({ "inclusion": false, "polygon": ring.collect::<Vec<_>>(), "version": 1 })
    };
    if let Some(members) = fences.as_object_mut() {
        let polygons = members.entry("polygons").or_insert_with(|| json!([]));
        if let Some(polygons) = polygons.as_array_mut() {
            polygons.extend(new.into_iter().map(polygon));
        }
    }
    fences.to_string()
}

#[derive(Default)]
struct Gathered {
    no_fly: Vec<FoundNoFly>,
    inside: usize,
    broken: usize,
}

impl Gathered {
    fn polygon(&mut self, corners: Vec<LonLat>, is_inside: bool) {
        if corners.len() < 3 {
            self.broken += 1;
        } else if is_inside {
            self.inside += 1;
        } else {
            let number = self.no_fly.len() + 1;
            self.no_fly.push(FoundNoFly {
                name: Some(format!("Fence {number}")),
                corners,
                holes: Vec::new(),
                properties: BTreeMap::new(),
            });
        }
    }

    /// A circle as the polygon around it, which leaves none of it out.
    fn circle(&mut self, (longitude, latitude): LonLat, radius: f64, is_inside: bool) {
        if !(on_globe(longitude, latitude) && radius > 0.0 && radius < 1e6) {
            self.broken += 1;
            return;
        }
        let frame = LocalFrame::new(Geodetic::from_degrees(latitude, longitude, 0.0));
        let step = TAU / CIRCLE_CORNERS as f64;
        let radius = radius / (0.5 * step).cos();
        let corners = (0..CIRCLE_CORNERS).map(|i| {
            let (east, north) = (step * i as f64).sin_cos();
            let corner = GroundPoint::new(radius * north, radius * east);
            let place = frame.geodetic_from_ground(&corner);
            (place.longitude.to_degrees(), place.latitude.to_degrees())
        });
        self.polygon(corners.collect(), is_inside);
    }

    fn finish(self) -> Fences {
        let mut notes = Vec::new();
        let mut tell = |count: usize, what: &str| {
            if count > 0 {
                notes.push(format!("{count} × {what}"));
            }
        };
        tell(
            self.no_fly.len(),
            "fence that keeps aircraft out: a no-fly area",
        );
        tell(
            self.inside,
            "fence that keeps aircraft in: it is kept, and is no no-fly area",
        );
        tell(
            self.broken,
            "fence that is no area: it is kept as it stands",
        );
        Fences {
            no_fly: self.no_fly,
            notes,
        }
    }
}
