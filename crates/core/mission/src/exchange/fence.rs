//! Fences of plans and of files of way-points: those that keep aircraft out, as no-fly areas.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

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
pub(super) const CIRCLE_CORNERS: usize = 48;

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
        let [first, .., latitude, longitude, _] = item.parameters.map(|p| p.unwrap_or(f64::NAN));
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

/// Fences of a plan, the member `geoFence`, each by itself: what is odd in one says nothing of the others.
pub(super) fn of_plan(text: &str) -> Fences {
    let mut fences = Gathered::default();
    let stated: Value = serde_json::from_str(text).unwrap_or_default();
    let list = |name: &str| stated.get(name).and_then(Value::as_array);
    let inclusion = |fence: &Value| fence.get("inclusion").and_then(Value::as_bool);
    // Plans of before 2018 have one fence, which keeps the aircraft in.
    fences.inside += usize::from(list("polygon").is_some_and(|corners| !corners.is_empty()));
    for fence in list("polygons").into_iter().flatten() {
        let corners = fence.get("polygon").and_then(Value::as_array);
        let corners = corners.and_then(|corners| corners.iter().map(corner).collect());
        match (corners, inclusion(fence)) {
            (Some(corners), Some(is_inside)) => fences.polygon(corners, is_inside),
            _ => fences.broken += 1,
        }
    }
    for fence in list("circles").into_iter().flatten() {
        let circle = fence.get("circle").unwrap_or(&Value::Null);
        let radius = circle.get("radius").and_then(Value::as_f64);
        let middle = circle.get("center").and_then(corner);
        match (middle, radius, inclusion(fence)) {
            (Some(middle), Some(radius), Some(is_inside)) => {
                fences.circle(middle, radius, is_inside);
            }
            _ => fences.broken += 1,
        }
    }
    let is_odd = |name: &str| {
        stated
            .get(name)
            .is_some_and(|v| !v.is_array() && !v.is_null())
    };
    let odd = ["polygons", "circles"]
        .into_iter()
        .filter(|name| is_odd(name));
    fences.broken += odd.count() + usize::from(!stated.is_object() && !stated.is_null());
    fences.finish()
}

/// The place of a corner: latitude and longitude, whatever stands behind them.
fn corner(value: &Value) -> Option<LonLat> {
    let number = |i: usize| value.get(i).and_then(Value::as_f64);
    let (latitude, longitude) = (number(0)?, number(1)?);
    on_globe(longitude, latitude).then_some((longitude, latitude))
}

/// Those of `areas` that are none of the fences `known`, with their corners.
fn beside<'a>(
    known: &[FoundNoFly],
    areas: &'a [NoFlyZone],
    frame: &LocalFrame,
) -> Vec<(&'a NoFlyZone, Vec<LonLat>)> {
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
    let corners = areas.iter().map(|area| (area, corners(area)));
    corners.filter(|(_, area)| !is_known(area)).collect()
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
/// came from it are not written again. The second is a note on what fences cannot hold.
pub(super) fn with_areas(
    kept: &str,
    areas: &[NoFlyZone],
    frame: &LocalFrame,
) -> (String, Option<String>) {
    let new = beside(&of_plan(kept).no_fly, areas, frame);
    let mut fences: Value = serde_json::from_str(kept).unwrap_or_default();
    if new.is_empty() {
        return (kept.to_owned(), None);
    }
    let holes: usize = new.iter().map(|(area, _)| area.holes.len()).sum();
    let note = (holes > 0)
        .then(|| format!("{holes} × hole of a no-fly area is left out: fences have none"));
    let nine = |degrees: f64| (degrees * 1e9).round() / 1e9;
    let polygon = |(_, area): (_, Vec<LonLat>)| {
        let ring = area.into_iter().map(|(lon, lat)| [nine(lat), nine(lon)]);
        json!({ "inclusion": false, "polygon": ring.collect::<Vec<_>>(), "version": 1 })
    };
    let new = new.into_iter().map(polygon);
    // What is no list of fences has no room for one.
    if !fences.is_object() {
        fences = json!({ "circles": [], "version": 2 });
    }
    match fences.get_mut("polygons").and_then(Value::as_array_mut) {
        Some(polygons) => polygons.extend(new),
        None => fences["polygons"] = new.collect(),
    }
    (fences.to_string(), note)
}

/// Corners of the polygon around a circle, which leaves none of it out; `None` of what is no circle on the globe.
pub(super) fn circle_corners((longitude, latitude): LonLat, radius: f64) -> Option<Vec<LonLat>> {
    if !(on_globe(longitude, latitude) && radius > 0.0 && radius < 1e6) {
        return None;
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
    Some(corners.collect())
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

    fn circle(&mut self, middle: LonLat, radius: f64, is_inside: bool) {
        match circle_corners(middle, radius) {
            Some(corners) => self.polygon(corners, is_inside),
            None => self.broken += 1,
        }
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
