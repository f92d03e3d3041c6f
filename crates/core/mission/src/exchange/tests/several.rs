//! Surveys and landing patterns of plans, missions before there were plans, and geometries in geometries.

use super::super::{Format, plan_schema, read_any, write_route};
use super::{assert_noted, frame};
use crate::mission::{Route, WayPointAction};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

/// A survey as `QGroundControl` 4 stores it, with a command before it and a landing pattern behind it.
fn survey(landing: &str) -> String {
    let simple = |id: u32, command: u32, place: &str| {
        format!(
            r#"{{ "autoContinue": true, "command": {command}, "doJumpId": {id}, "frame": 3, "params": [0, 0, 0, null, {place}], "type": "SimpleItem" }}"#
        )
    };
    let trigger = r#"{ "autoContinue": true, "command": 206, "doJumpId": 4, "frame": 2, "params": [25, 0, 1, 0, 0, 0, 0], "type": "SimpleItem" }"#;
    format!(
        r#"{{ "fileType": "Plan", "version": 1, "groundStation": "QGroundControl",
    "geoFence": {{ "circles": [], "polygons": [], "version": 2 }}, "rallyPoints": {{ "points": [], "version": 2 }},
    "mission": {{ "version": 2, "firmwareType": 12, "globalPlanAltitudeMode": 1, "vehicleType": 1, "cruiseSpeed": 15, "hoverSpeed": 5,
        "plannedHomePosition": [47.4, 8.5, 400],
        "items": [
            {},
            {{ "TransectStyleComplexItem": {{ "CameraShots": 14,
                "Items": [ {}, {trigger}, {}, {} ],
                "VisualTransectPoints": [ [47.41, 8.51], [47.42, 8.51] ], "version": 2 }},
              "angle": 0, "complexItemType": "survey", "polygon": [ [47.41, 8.51], [47.42, 8.51], [47.42, 8.52] ],
              "type": "ComplexItem", "version": 5 }},
            {landing}
        ] }} }}"#,
        simple(1, 22, "47.4, 8.5, 50"),
        simple(3, 16, "47.41, 8.51, 120"),
        simple(5, 16, "47.42, 8.51, 120"),
        simple(6, 16, "47.42, 8.52, 120"),
    )
}

const LANDING: &str = r#"{ "altitudesAreRelative": true, "complexItemType": "fwLandingPattern", "landCoordinate": [47.4, 8.49, 0],
    "landingApproachCoordinate": [47.405, 8.48, 40], "loiterClockwise": false, "loiterRadius": 75, "type": "ComplexItem",
    "useLoiterToAlt": true, "valueSetIsDistance": false, "version": 2 }"#;

fn read(text: &str) -> (Route, Vec<String>) {
    let mut back = read_any("a.plan", text.as_bytes(), Some(frame())).unwrap();
    (back.routes.remove(0), back.notes)
}

fn plan(route: &Route) -> serde_json::Value {
    let written = write_route(Format::Plan, route, &frame()).unwrap();
    let text = String::from_utf8(written.bytes).unwrap();
    // The documentation's schema is held to our own name there.
    let own = text.replace("\"QGroundControl\"", "\"Pilotage\"");
    plan_schema::check(&own).unwrap();
    serde_json::from_str(&text).unwrap()
}

#[test]
fn the_way_points_of_a_survey_and_a_landing_are_shown_and_both_are_written_as_they_were() {
    let text = survey(LANDING);
    let (route, notes) = read(&text);
    let metres: Vec<f64> = route.way_points.iter().map(|w| w.altitude.metres).collect();
    assert_eq!(metres, [50.0, 120.0, 120.0, 120.0, 40.0, 0.0]);
    assert_eq!(route.way_points[5].action, WayPointAction::Land);
    assert!(
        notes
            .iter()
            .any(|n| n.ends_with(": survey, fwLandingPattern")),
        "{notes:?}"
    );
    let before: serde_json::Value = serde_json::from_str(&text).unwrap();
    let (after, before) = (
        &plan(&route)["mission"]["items"],
        &before["mission"]["items"],
    );
    assert_eq!(after.as_array().unwrap().len(), 3);
    assert_eq!((&after[1], &after[2]), (&before[1], &before[2]));
    // The way-points that the second part is about are behind the first.
    let written = write_route(Format::Plan, &route, &frame()).unwrap();
    let again = read_any("a.plan", &written.bytes, Some(frame())).unwrap();
    assert_eq!(again.routes[0].way_points.len(), 6);
}

#[test]
fn a_survey_that_was_changed_is_written_as_its_commands() {
    let (mut route, _) = read(&survey(LANDING));
    route.way_points[2].position.north += 5.0;
    let items = &plan(&route)["mission"]["items"];
    let commands: Vec<_> = items
        .as_array()
        .unwrap()
        .iter()
        .map(|i| i["command"].as_u64())
        .collect();
    assert_eq!(
        commands,
        [Some(22), Some(16), Some(206), Some(16), Some(16), None]
    );
    assert_eq!(items[5]["complexItemType"], "fwLandingPattern");
}

#[test]
fn way_point_files_have_the_commands_of_a_survey_and_a_landing() {
    for (landing, radius) in [
        (LANDING.to_owned(), "-75"),
        (
            LANDING
                .replace("landingApproachCoordinate", "loiterCoordinate")
                .replace("false, \"loiterR", "true, \"loiterR"),
            "75",
        ),
    ] {
        let (route, _) = read(&survey(&landing));
        let written = write_route(Format::Waypoints, &route, &frame()).unwrap();
        let text = String::from_utf8(written.bytes).unwrap();
        let lines: Vec<Vec<&str>> = text
            .lines()
            .skip(1)
            .map(|l| l.split('\t').collect())
            .collect();
        let commands: Vec<&str> = lines.iter().map(|l| l[3]).collect();
        assert_eq!(
            commands,
            ["16", "22", "16", "206", "16", "16", "189", "31", "21"]
        );
        assert_eq!(
            &lines[7][4..11],
            ["1", radius, "0", "1", "47.405", "8.48", "40"]
        );
    }
}

#[test]
fn missions_before_there_were_plans_are_read_in_both_versions() {
    let first = r#"{ "MAV_AUTOPILOT": 3, "groundStation": "QGroundControl", "version": "1.0",
        "complexItems": [ { "id": 3, "complexItemType": "survey", "type": "complexItem", "polygon": [] } ],
        "items": [
            { "autoContinue": true, "command": 22, "coordinate": [47.4, 8.5, 30], "frame": 3, "id": 1, "param1": 0, "param2": 0, "param3": 0, "param4": 0, "type": "missionItem" },
            { "autoContinue": true, "command": 16, "coordinate": [47.41, 8.51, 90], "frame": 0, "id": 2, "param1": 5, "param2": 0, "param3": 0, "param4": 0, "type": "missionItem" },
            { "autoContinue": true, "command": 16, "coordinate": [47.42, 8.51, 95], "frame": 3, "id": 4, "param1": 0, "param2": 0, "param3": 0, "param4": 0, "type": "missionItem" } ],
        "plannedHomePosition": { "autoContinue": true, "command": 16, "coordinate": [47.4, 8.5, 412], "frame": 0, "id": 0, "type": "missionItem" } }"#;
    let second = r#"{ "fileType": "Mission", "version": 2, "groundStation": "QGroundControl", "firmwareType": 3, "plannedHomePosition": [47.4, 8.5, 412],
        "items": [
            { "autoContinue": true, "command": 22, "coordinate": [47.4, 8.5, 30], "doJumpId": 1, "frame": 3, "params": [0, 0, 0, 0], "type": "SimpleItem" },
            { "autoContinue": true, "command": 16, "coordinate": [47.41, 8.51, 90], "doJumpId": 2, "frame": 0, "params": [5, 0, 0, 0], "type": "SimpleItem" },
            { "type": "ComplexItem", "complexItemType": "survey", "version": 3 },
            { "autoContinue": true, "command": 16, "coordinate": [47.42, 8.51, 95], "doJumpId": 4, "frame": 3, "params": [0, 0, 0, 0], "type": "SimpleItem" } ] }"#;
    for text in [first, second] {
        let mut back = read_any("old.mission", text.as_bytes(), Some(frame())).unwrap();
        let route = back.routes.remove(0);
        let altitudes: Vec<_> = route.way_points.iter().map(|w| w.altitude).collect();
        let above = |m| Altitude::new(m, AltitudeFrame::AboveTakeOff);
        assert_eq!(
            altitudes,
            [
                above(30.0),
                Altitude::new(90.0, AltitudeFrame::Amsl),
                above(95.0)
            ]
        );
        assert_eq!(
            (route.name.as_str(), route.properties["home"].as_str()),
            ("old", "[47.4,8.5,412.0]")
        );
        assert_noted(&back.notes, |n| n.contains("before there were plans"));
        let items = &plan(&route)["mission"]["items"];
        assert_eq!(items[1]["params"][0], 5.0);
        assert_eq!(items[2]["complexItemType"], "survey");
        assert_eq!(plan(&route)["mission"]["firmwareType"], 3);
    }
    let wrong = first.replace("\"command\": 22", "\"command\": \"up\"");
    let error = read_any("old.mission", wrong.as_bytes(), None)
        .unwrap_err()
        .to_string();
    assert!(
        error.starts_with("old.mission: mission.items[0].command"),
        "{error}"
    );
}

#[test]
fn geometries_in_geometries_are_read_with_their_holes() {
    let ring = |at: f64, size: f64| {
        let (a, b) = (at, at + size);
        format!("[[{a}, 47], [{b}, 47], [{b}, 47.001], [{a}, 47.0005], [{a}, 47]]")
    };
    let text = format!(
        r#"{{ "type": "Feature", "properties": {{ "name": "all" }}, "geometry": {{ "type": "GeometryCollection", "geometries": [
        {{ "type": "GeometryCollection", "geometries": [
            {{ "type": "Polygon", "coordinates": [{}, {}] }},
            {{ "type": "MultiPoint", "coordinates": [[8, 47], [8.001, 47.001, 5]] }} ] }},
        {{ "type": "MultiPolygon", "coordinates": [[{}, {}], [{}]] }},
        {{ "type": "MultiLineString", "coordinates": [[[8, 47, 500], [8.001, 47, 510]], [[8, 47], [8.002, 47]]] }} ] }} }}"#,
        ring(8.0, 0.01),
        ring(8.001, 0.001),
        ring(8.1, 0.01),
        ring(8.101, 0.001),
        ring(8.2, 0.01),
    );
    let back = read_any("x.geojson", text.as_bytes(), None).unwrap();
    let holes: Vec<usize> = back.landmarks.iter().map(|l| l.holes().len()).collect();
    assert_eq!(holes, [1, 0, 0, 1, 0]);
    assert_eq!(back.routes.len(), 2);
    let kml = r"<kml><Placemark><name>all</name><MultiGeometry><MultiGeometry><Point><coordinates>8,47</coordinates></Point>
        <LineString><coordinates>8,47 8.001,47</coordinates></LineString></MultiGeometry>
        <Polygon><outerBoundaryIs><LinearRing><coordinates>8,47 8.01,47 8.01,47.01 8,47</coordinates></LinearRing></outerBoundaryIs></Polygon>
        </MultiGeometry></Placemark></kml>";
    let back = read_any("x.kml", kml.as_bytes(), None).unwrap();
    assert_eq!((back.routes.len(), back.landmarks.len()), (1, 2));
    let middle = back.landmarks[1].bounds.center();
    assert!(middle.distance(&GroundPoint::default()) < 1000.0);
}

#[test]
fn a_sequence_of_features_is_read_and_other_reference_systems_are_refused_by_name() {
    let lines = "\u{1e}{ \"type\": \"Feature\", \"properties\": {}, \"geometry\": { \"type\": \"Point\", \
        \"coordinates\": [8, 47] } }\n\u{1e}{ \"type\": \"Feature\", \"properties\": {}, \"geometry\": { \
        \"type\": \"LineString\", \"coordinates\": [[8, 47], [8.001, 47]] } }\n";
    for text in [lines.to_owned(), lines.replace('\u{1e}', "")] {
        let back = read_any("x.geojsonl", text.as_bytes(), None).unwrap();
        assert_eq!((back.routes.len(), back.landmarks.len()), (1, 1));
    }
    let in_system = |name: &str| {
        let text = format!(
            r#"{{ "type": "FeatureCollection", "crs": {{ "type": "name", "properties": {{ "name": "{name}" }} }},
            "features": [ {{ "type": "Feature", "properties": {{}}, "geometry": {{ "type": "Point", "coordinates": [8, 47] }} }} ] }}"#
        );
        read_any("x.geojson", text.as_bytes(), None)
    };
    let notes = in_system("urn:ogc:def:crs:OGC:1.3:CRS84").unwrap().notes;
    assert!(!notes.iter().any(|n| n.contains("WGS 84")), "{notes:?}");
    let notes = in_system("urn:ogc:def:crs:EPSG::4258").unwrap().notes;
    assert!(
        notes
            .iter()
            .any(|n| n.contains("taken for those of WGS 84")),
        "{notes:?}"
    );
    let error = in_system("urn:ogc:def:crs:EPSG::3857")
        .unwrap_err()
        .to_string();
    assert!(error.contains("EPSG::3857"), "{error}");
}

#[test]
fn coordinates_with_space_beside_their_commas_are_read() {
    let text = "<kml><Placemark><LineString><altitudeMode>absolute</altitudeMode><coordinates>8, 47, 500\n\
        8.01 ,47.01 ,510 8.02,47.02,520</coordinates></LineString></Placemark></kml>";
    let back = read_any("x.kml", text.as_bytes(), None).unwrap();
    let metres: Vec<f64> = back.routes[0]
        .way_points
        .iter()
        .map(|w| w.altitude.metres)
        .collect();
    assert_eq!(metres, [500.0, 510.0, 520.0]);
}

#[test]
fn geometries_without_corners_are_left_out_and_counted_and_empty_holes_are_none() {
    let read = |geometry: &str| {
        let text = format!(
            r#"{{ "type": "FeatureCollection", "features": [
            {{ "type": "Feature", "properties": {{}}, "geometry": {{ "type": "Point", "coordinates": [8.5, 47.4] }} }},
            {{ "type": "Feature", "properties": {{}}, "geometry": {geometry} }} ] }}"#
        );
        read_any("x.geojson", text.as_bytes(), None).unwrap()
    };
    for (geometry, note) in [
        (
            r#"{ "type": "Polygon", "coordinates": [] }"#,
            "1 of the geometries have no coordinates",
        ),
        (
            r#"{ "type": "Polygon", "coordinates": [[]] }"#,
            "1 of the geometries have no coordinates",
        ),
        (
            r#"{ "type": "Polygon", "coordinates": [[[8.5, 47.4], [8.6, 47.4]]] }"#,
            "1 of the polygons have fewer than three corners",
        ),
        (
            r#"{ "type": "MultiPolygon", "coordinates": [[[[8.5, 47.4]]]] }"#,
            "1 of the polygons have fewer than three corners",
        ),
    ] {
        let back = read(geometry);
        assert_eq!(back.landmarks.len(), 1, "{geometry}");
        assert_noted(&back.notes, |n| n.starts_with(note));
    }
    let ring = "[[8.5, 47.4], [8.6, 47.4], [8.6, 47.5], [8.5, 47.4]]";
    let back = read(&format!(
        r#"{{ "type": "Polygon", "coordinates": [{ring}, []] }}"#
    ));
    assert_eq!(
        (back.landmarks.len(), back.landmarks[1].holes().len()),
        (2, 0)
    );
    let table = "WKT,name\n\"POLYGON EMPTY\",a\n\"POINT (8.5 47.4)\",b\n";
    let back = read_any("x.csv", table.as_bytes(), None).unwrap();
    assert_eq!(back.landmarks.len(), 1);
    assert_noted(&back.notes, |n| {
        n.starts_with("1 of the geometries have no coordinates")
    });
}

#[test]
fn points_without_a_height_in_lines_with_heights_are_told() {
    let line = r#"{ "type": "LineString", "coordinates": [[8.5, 47.4, 500], [8.6, 47.5]] }"#;
    let back = read_any("x.geojson", line.as_bytes(), None).unwrap();
    assert_noted(&back.notes, |n| {
        n.starts_with("1 of the points of lines with heights")
    });
    let kml = "<kml><Placemark><LineString><altitudeMode>absolute</altitudeMode><coordinates>8.5,47.4 8.6,47.5,510\
        </coordinates></LineString></Placemark></kml>";
    let back = read_any("x.kml", kml.as_bytes(), None).unwrap();
    assert_noted(&back.notes, |n| {
        n.contains("line of which points state no altitude")
    });
    assert!(
        !back.notes.iter().any(|n| n.contains("on the ground")),
        "{:?}",
        back.notes
    );
}

#[test]
fn a_zone_of_unmanned_aircraft_is_the_circle_about_its_point_and_keeps_its_heights() {
    let layer = r#"{ "upper": 120, "upperReference": "AGL", "uom": "m" }"#;
    let zone = |geometry: &str| {
        let text = format!(
            r#"{{ "type": "FeatureCollection", "features": [ {{ "type": "Feature", "properties": {{ "country": "CHE" }},
            "geometry": {geometry} }} ] }}"#
        );
        read_any("zones.json", text.as_bytes(), None).unwrap()
    };
    let circle = r#""type": "Point", "coordinates": [8.5, 47.4], "extent": { "subType": "Circle", "radius": 5000 }"#;
    for geometry in [
        format!("{{ {circle}, \"layer\": {layer} }}"),
        format!(
            r#"{{ "type": "GeometryCollection", "geometries": [ {{ {circle}, "layer": {layer} }} ] }}"#
        ),
    ] {
        let back = zone(&geometry);
        let place = back.landmarks[0].bounds;
        // Two radii, and at most the 0.2 % by which 48 corners lie outside of the circle.
        for size in [place.width(), place.height()] {
            assert!((10_000.0..10_030.0).contains(&size), "{size}");
        }
        let kept: serde_json::Value =
            serde_json::from_str(&back.landmarks[0].properties["layer"]).unwrap();
        assert_eq!(kept["upper"], 120);
        assert_noted(&back.notes, |n| {
            n.starts_with("1 of the places are circles")
        });
    }
    let ring = "[[[8.5, 47.4], [8.6, 47.4], [8.6, 47.5], [8.5, 47.4]]]";
    let back = zone(&format!(
        r#"{{ "type": "Polygon", "coordinates": {ring}, "layer": {layer} }}"#
    ));
    assert!(back.landmarks[0].properties["layer"].contains("AGL"));
}

#[test]
fn an_offset_of_altitudes_moves_the_line_and_tours_and_models_are_named() {
    let text = "<kml xmlns:gx=\"http://www.google.com/kml/ext/2.2\"><Document><gx:Tour><name>T</name></gx:Tour>\
        <Placemark><Model><Location><longitude>8.5</longitude></Location></Model></Placemark>\
        <Placemark><LineString><gx:altitudeOffset>10</gx:altitudeOffset><altitudeMode>absolute</altitudeMode>\
        <coordinates>8.5,47.4,500 8.51,47.41,510</coordinates></LineString></Placemark></Document></kml>";
    let back = read_any("x.kml", text.as_bytes(), None).unwrap();
    let metres: Vec<f64> = back.routes[0]
        .way_points
        .iter()
        .map(|w| w.altitude.metres)
        .collect();
    assert_eq!(metres, [510.0, 520.0]);
    for name in ["Tour is left out", "Model is left out"] {
        assert_noted(&back.notes, |n| n.contains(name));
    }
}

#[test]
fn the_number_of_a_system_as_files_of_before_2008_state_it_is_heeded() {
    let text = r#"{ "type": "Point", "coordinates": [8.5, 47.4], "crs": { "type": "EPSG", "properties": { "code": 4314 } } }"#;
    let error = read_any("x.geojson", text.as_bytes(), None)
        .unwrap_err()
        .to_string();
    assert!(error.contains("are in 4314"), "{error}");
}
