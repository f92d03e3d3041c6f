//! Writing of files in all formats that are known.

use super::written::WrittenFile;
use super::{ExchangeError, Format, Places};
use crate::mission::Route;
use pilotage_base::frames::LocalFrame;
use pilotage_vision::landmark::Landmark;

/// Writes a single route, placed in the world `frame`, in any format.
///
/// ```
/// use pilotage_base::frames::{Altitude, AltitudeFrame, Geodetic, GroundPoint, LocalFrame};
/// use pilotage_mission::exchange::{Format, read_any, write_route};
/// use pilotage_mission::mission::{Route, WayPoint};
///
/// let world = LocalFrame::new(Geodetic::from_degrees(46.8, -92.0, 0.0));
/// let altitude = Altitude::new(120.0, AltitudeFrame::AboveTakeOff);
/// let at = |north, east| WayPoint::new(GroundPoint::new(north, east), altitude);
/// let way_points = vec![at(0.0, 0.0), at(500.0, 0.0)];
/// let route = Route { id: 1, name: "Out".to_owned(), way_points, ..Route::default() };
/// let file = write_route(Format::Plan, &route, &world)?; // QGroundControl
/// let read = read_any("out.plan", &file.bytes, Some(world))?;
/// assert!((read.routes[0].length() - 500.0).abs() < 0.01);
/// # Ok::<(), pilotage_mission::exchange::ExchangeError>(())
/// ```
pub fn write_route(
    format: Format,
    route: &Route,
    frame: &LocalFrame,
) -> Result<WrittenFile, ExchangeError> {
    let places = Places {
        routes: std::slice::from_ref(route),
        ..Places::default()
    };
    write_places(format, &places, frame)
}

/// Landmarks, placed in the world `frame`, in a format that holds them.
pub fn write_landmarks(
    format: Format,
    landmarks: &[Landmark],
    frame: &LocalFrame,
) -> Result<WrittenFile, ExchangeError> {
    let places = Places {
        landmarks,
        ..Places::default()
    };
    write_places(format, &places, frame)
}

/// Routes, landmarks, no-fly areas and rally points, placed in the world `frame`, together in one file.
pub fn write_places(
    format: Format,
    places: &Places<'_>,
    frame: &LocalFrame,
) -> Result<WrittenFile, ExchangeError> {
    let Places {
        routes,
        landmarks,
        rally,
        ..
    } = *places;
    let is_rally_alone = Some(format) == Format::of_rally_alone()
        && routes.is_empty()
        && rally.is_some_and(|r| !r.is_empty());
    let cannot_hold = |what: String, advice| ExchangeError::CannotHold {
        format: format.name(),
        what,
        advice,
    };
    if !landmarks.is_empty() && !format.holds_landmarks() {
        return Err(cannot_hold(
            "landmarks".to_owned(),
            "write them as GeoJSON, KML or CSV",
        ));
    }
    if routes.is_empty() && !format.holds_landmarks() && !is_rally_alone {
        return Err(cannot_hold(
            "a file without a route".to_owned(),
            "draw a route first",
        ));
    }
    if !format.holds_several_routes() && routes.len() != 1 && !is_rally_alone {
        return Err(cannot_hold(
            format!("{} routes", routes.len()),
            "choose one of them",
        ));
    }
    (format.work().write)(places, frame)
}
