//! Flight plans of Little Navmap (`.lnmpln`, XML): a route over their places.

use super::ExchangeError;
use super::found::GeodeticContent;
use super::xml::{NamedText, XmlElement};
use crate::mission::found::{ReadRoute, on_globe};
use crate::mission::{USUAL_ALTITUDE, WayPoint};
use pilotage_base::frames::units::METRES_PER_FOOT;
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

/// Name of the root of such files.
pub(super) const ROOT: &str = "LittleNavmap";

/// Reads the way-points of a plan; its altitudes are feet above mean sea level.
pub(super) fn read(
    source: &NamedText,
    root: &XmlElement,
) -> Result<GeodeticContent, ExchangeError> {
    let plan = root.child("Flightplan");
    let list = plan.and_then(|plan| plan.child("Waypoints"));
    let mut route = ReadRoute::default();
    let mut is_assumed = false;
    for point in list.into_iter().flat_map(|list| list.all("Waypoint")) {
        let value = |name: &str| {
            let text = point.child("Pos")?.attribute(name)?;
            text.trim().parse::<f64>().ok()
        };
        let place = value("Lon").zip(value("Lat"));
        let place = place.filter(|(longitude, latitude)| on_globe(*longitude, *latitude));
        let Some(place) = place else {
            return Err(source.error(point.begin, "Waypoint/Pos is no place"));
        };
        // No plan is flown at sea level: programs write 0 for an altitude that is open.
        let feet = value("Alt").filter(|feet| *feet != 0.0);
        is_assumed |= feet.is_none();
        let altitude = feet.map_or(USUAL_ALTITUDE, |feet| {
            Altitude::new(feet * METRES_PER_FOOT, AltitudeFrame::Amsl)
        });
        let mut way_point = WayPoint::new(GroundPoint::default(), altitude);
        if let Some(name) = point.child_text("Ident").or(point.child_text("Name")) {
            let name = serde_json::Value::from(name).to_string();
            way_point.properties.insert("name".to_owned(), name);
        }
        route.way_points.push((place, way_point));
    }
    let mut found = GeodeticContent::default();
    found.notes.push(
        "this is a flight plan of Little Navmap: its altitudes are read in feet above mean sea level"
            .to_owned(),
    );
    if is_assumed {
        found.notes.push(format!(
            "points without an altitude are at {USUAL_ALTITUDE}"
        ));
    }
    if !route.way_points.is_empty() {
        found.routes.push(route);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::super::{Format, read_any};

    #[test]
    fn a_plan_of_little_navmap_is_a_route_in_metres() {
        let text = r#"<?xml version="1.0" encoding="UTF-8"?>
<LittleNavmap xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">
  <Flightplan><Header><FlightplanType>VFR</FlightplanType><CruisingAlt>5000</CruisingAlt></Header>
    <Waypoints>
      <Waypoint><Ident>FACT</Ident><Type>AIRPORT</Type><Pos Lon="18.601667" Lat="-33.964722" Alt="151.00"/></Waypoint>
      <Waypoint><Ident>WP1</Ident><Type>USER</Type><Pos Lon="18.42" Lat="-33.85" Alt="5000.00"/></Waypoint>
    </Waypoints></Flightplan></LittleNavmap>"#;
        assert_eq!(Format::of("a.lnmpln", text.as_bytes()), Some(Format::Gpx));
        let read = read_any("a.lnmpln", text.as_bytes(), None).unwrap();
        let way_points = &read.routes[0].way_points;
        let place = read.frame.geodetic_from_ground(&way_points[1].position);
        assert!((place.latitude.to_degrees() + 33.85).abs() < 1e-9);
        assert!((place.longitude.to_degrees() - 18.42).abs() < 1e-9);
        assert!((way_points[0].altitude.metres - 46.0248).abs() < 1e-9);
        assert!((way_points[1].altitude.metres - 1524.0).abs() < 1e-9);
    }
}
