//! Plans and way-point files of ground stations.

use super::super::{ExchangeError, Format, plan_schema, read_any, write_route};
use super::{assert_noted, assert_same_way_points, frame, route};
use crate::mission::{Route, WayPointAction};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

/// A plan as a ground station leaves it, with much that we do not know.
const SURVEY: &str = r#"{
    "fileType": "Plan", "version": 1, "groundStation": "Pilotage", "extra": [1,  2],
    "geoFence": { "circles": [ { "circle": { "center": [47.40, 8.51], "radius": 319.85 }, "inclusion": true, "version": 1 } ], "polygons": [], "version": 2 },
    "rallyPoints": { "points": [], "version": 2 },
    "mission": {
        "cruiseSpeed": 17.5, "firmwareType": 3, "hoverSpeed": 5, "vehicleType": 2, "version": 2, "globalPlanAltitudeMode": 0,
        "plannedHomePosition": [47.4, 8.5, 412.5],
        "items": [
            { "type": "SimpleItem", "command": 178, "frame": 2, "params": [1, 12, -1, 0, 0, 0, 0], "autoContinue": true, "doJumpId": 1 },
            { "type": "SimpleItem", "command": 22, "frame": 3, "params": [15, 0, 0, null, 0, 0, 50], "autoContinue": true, "doJumpId": 2,
              "AMSLAltAboveTerrain": null, "Altitude": 50, "AltitudeMode": 1 },
            { "type": "SimpleItem", "command": 205, "frame": 2, "params": [40, 0, 50, 0, 0, 0, 0], "autoContinue": true, "doJumpId": 3, "colour" : "red" },
            { "type": "SimpleItem", "command": 178, "frame": 2, "params": [0, 20, -1, 0, 0, 0, 0], "autoContinue": true, "doJumpId": 4 },
            { "type": "SimpleItem", "command": 206, "frame": 2, "params": [25, 0, 1, 0, 0, 0, 0], "autoContinue": true, "doJumpId": 5 },
            { "type": "SimpleItem", "command": 16, "frame": 0, "params": [3, 0, 0, 90, 47.41, 8.51, 560], "autoContinue": true, "doJumpId": 6,
              "AMSLAltAboveTerrain": 560, "Altitude": 120, "AltitudeMode": 3, "note": "bend" },
            { "type": "ComplexItem", "complexItemType": "survey", "version": 5, "angle": 0, "polygon": [[47.41, 8.51], [47.42, 8.51], [47.42, 8.52]] },
            { "type": "SimpleItem", "command": 19, "frame": 10, "params": [30, 0, 60, null, 47.42, 8.53, 90], "autoContinue": false, "doJumpId": 30 },
            { "type": "SimpleItem", "command": 18, "frame": 3, "params": [2, 1, -80, null, 47.43, 8.53, 90], "autoContinue": true, "doJumpId": 31 },
            { "type": "SimpleItem", "command": 20, "frame": 2, "params": [0, 0, 0, 0, 0, 0, 0], "autoContinue": true, "doJumpId": 32 }
        ]
    }
}"#;

fn plan(route: &Route) -> String {
    let written = write_route(Format::Plan, route, &frame()).unwrap();
    String::from_utf8(written.bytes).unwrap()
}

fn read(name: &str, text: &str) -> (Route, Vec<String>) {
    let mut imported = read_any(name, text.as_bytes(), Some(frame())).unwrap();
    assert_eq!(imported.routes.len(), 1);
    (imported.routes.remove(0), imported.notes)
}

#[test]
fn a_route_survives_the_plan_and_the_way_point_file() {
    for format in [Format::Plan, Format::Waypoints] {
        let written = write_route(format, &route(), &frame()).unwrap();
        let back = read_any("there", &written.bytes, Some(frame())).unwrap();
        assert_eq!(back.format, format);
        assert_same_way_points(&back.routes[0], &route());
        let again = write_route(format, &back.routes[0], &frame()).unwrap();
        assert_eq!(again.bytes, written.bytes);
    }
}

#[test]
fn the_plan_is_as_the_ground_station_documents_it() {
    plan_schema::check(&plan(&route())).unwrap();
    let (survey, _) = read("survey.plan", SURVEY);
    plan_schema::check(&plan(&survey)).unwrap();
    for (wrong, right) in [
        ("\"AltitudeMode\": 7", "\"AltitudeModes\": 7"),
        ("\"version\": 2", "\"version\": 3"),
        ("\"frame\": 3", "\"frame\": null"),
    ] {
        let text = plan(&route()).replace("\"AltitudeMode\": 1", "\"AltitudeMode\": 7");
        assert!(plan_schema::check(&text.replacen(wrong, right, 1)).is_err());
    }
}

#[test]
fn places_speeds_and_altitudes_of_a_plan_are_understood() {
    let (route, notes) = read("folder/survey.plan", SURVEY);
    assert_eq!(route.name, "survey");
    let speeds: Vec<_> = route.way_points.iter().map(|w| w.speed).collect();
    assert_eq!(speeds, [Some(12.0), Some(20.0), Some(20.0), Some(20.0)]);
    let altitudes: Vec<_> = route.way_points.iter().map(|w| w.altitude).collect();
    assert_eq!(
        altitudes,
        [
            Altitude::new(50.0, AltitudeFrame::AboveTakeOff),
            Altitude::new(120.0, AltitudeFrame::AboveGround),
            Altitude::new(90.0, AltitudeFrame::AboveGround),
            Altitude::new(90.0, AltitudeFrame::AboveTakeOff),
        ]
    );
    assert_eq!(route.way_points[0].action, WayPointAction::TakeOff);
    assert!(
        route.way_points[0]
            .position
            .distance(&GroundPoint::default())
            < 0.01
    );
    let loiter = WayPointAction::Loiter {
        radius: -80.0,
        turns: 2.0,
    };
    assert_eq!(route.way_points[3].action, loiter);
    let told = |words: &str| assert!(notes.iter().any(|n| n.contains(words)), "{notes:#?}");
    told("3 commands are kept but not understood: DO_MOUNT_CONTROL, DO_SET_CAM_TRIGG_DIST, survey");
    let waits = [(1, 0.0, 3.0), (2, 60.0, 30.0)];
    for (index, radius, seconds) in waits {
        let seconds = Some(seconds);
        let wait = WayPointAction::Wait { radius, seconds };
        assert_eq!(route.way_points[index].action, wait);
    }
    assert!(route.returns);
    told("keeps aircraft in: it is kept");
    told("at the home position");
}

#[test]
fn what_a_plan_has_and_we_do_not_know_is_written_back_in_its_place() {
    let (route, _) = read("survey.plan", SURVEY);
    let after: serde_json::Value = serde_json::from_str(&plan(&route)).unwrap();
    let before: serde_json::Value = serde_json::from_str(SURVEY).unwrap();
    for name in ["geoFence", "rallyPoints", "extra", "groundStation"] {
        assert_eq!(after[name], before[name]);
    }
    for name in [
        "cruiseSpeed",
        "firmwareType",
        "vehicleType",
        "plannedHomePosition",
    ] {
        assert_eq!(after["mission"][name], before["mission"][name]);
    }
    let numbers = |item: &serde_json::Value| -> Option<Vec<Option<f64>>> {
        let list = item.get("params")?.as_array()?;
        Some(list.iter().map(serde_json::Value::as_f64).collect())
    };
    let (after, before) = (&after["mission"]["items"], &before["mission"]["items"]);
    assert_eq!(after.as_array().unwrap().len(), 10);
    for (i, (after, before)) in after
        .as_array()
        .unwrap()
        .iter()
        .zip(before.as_array().unwrap())
        .enumerate()
    {
        assert_eq!(after["type"], before["type"], "{i}");
        assert_eq!(after["command"], before["command"], "{i}");
        assert_eq!(after["autoContinue"], before["autoContinue"], "{i}");
        for name in ["colour", "note", "polygon", "angle"] {
            assert_eq!(after.get(name), before.get(name), "{i}");
        }
        if i != 1 && i != 5 && i != 6 {
            // The take-off gets the place of home; heights over calculated ground become such.
            assert_eq!(numbers(after), numbers(before), "{i}");
        }
    }
    let (again, _) = read("survey.plan", &plan(&route));
    assert_eq!(plan(&again), plan(&route));
}

#[test]
fn where_commands_jump_to_others_these_keep_their_numbers() {
    let text = SURVEY.replacen("\"command\": 20,", "\"command\": 177,", 1);
    let (mut route, notes) = read("jump.plan", &text);
    assert!(notes.iter().any(|n| n.contains("jumps")), "{notes:#?}");
    route
        .way_points
        .insert(1, super::route().way_points[1].clone());
    let after: serde_json::Value = serde_json::from_str(&plan(&route)).unwrap();
    let ids: Vec<_> = after["mission"]["items"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|i| i["type"] == "SimpleItem")
        .map(|i| i["doJumpId"].as_u64().unwrap())
        .collect();
    assert!(
        [2, 3, 5, 6, 30, 31, 32].iter().all(|id| ids.contains(id)),
        "{ids:?}"
    );
    plan_schema::check(&plan(&route)).unwrap();
}

#[test]
fn what_is_wrong_in_a_plan_is_told_with_its_place() {
    let told = |from: &str, to: &str| {
        let text = SURVEY.replacen(from, to, 1);
        let error = read_any("x.plan", text.as_bytes(), None).unwrap_err();
        assert!(matches!(error, ExchangeError::Place { .. }), "{error}");
        error.to_string()
    };
    let message = told("[15, 0, 0, null, 0, 0, 50]", "[15, 0, 0, null, 0, 0]");
    assert!(
        message.starts_with(
            "x.plan, line 10, column 74: mission.items[1].params: there are 6 numbers"
        ),
        "{message}"
    );
    let message = told("\"command\": 205", "\"command\": \"spin\"");
    assert!(
        message.contains("line 12") && message.contains("mission.items[2].command"),
        "{message}"
    );
    let message = told("\"version\": 1", "\"version\": 4");
    assert!(message.contains("version: 4 is not known"), "{message}");
    let message = told("\"Plan\"", "\"Mission\"");
    assert!(message.contains("fileType"), "{message}");
}

#[test]
fn the_first_line_of_mission_planner_is_home_and_no_way_point() {
    let text = "QGC WPL 110\r\n\
        0\t1\t0\t16\t0\t0\t0\t0\t47.4\t8.5\t412.5\t1\r\n\
        1\t0\t3\t22\t0.0\t0\t0\t0\t0\t0\t30\t1\r\n\
        2\t0\t3\t16\t0.0\t0\t0\t0\t47.41\t8.51\t100.000000\t1\r\n\
        3\t0\t3\t181\t1\t1\t0\t0\t0\t0\t0\t1\r\n";
    let (route, notes) = read("a.waypoints", text);
    assert_eq!(route.way_points.len(), 2);
    assert_eq!(route.properties["home"], "[47.4,8.5,412.5]");
    assert!(
        notes
            .iter()
            .any(|n| n.contains("not understood: command 181")),
        "{notes:#?}"
    );
    let written = write_route(Format::Waypoints, &route, &frame()).unwrap();
    let lines = String::from_utf8(written.bytes).unwrap();
    let commands: Vec<_> = lines
        .lines()
        .skip(1)
        .map(|l| l.split('\t').nth(3).unwrap())
        .collect();
    assert_eq!(commands, ["16", "22", "16", "181"]);
    assert_eq!(lines.lines().nth(1), text.lines().nth(1));
}

#[test]
fn a_survey_that_has_no_line_is_left_out_and_that_is_said() {
    let (route, _) = read("survey.plan", SURVEY);
    let written = write_route(Format::Waypoints, &route, &frame()).unwrap();
    assert_noted(&written.notes, |n| n.contains("left out: survey"));
    assert_noted(&written.notes, |n| n.contains("fences"));
}

#[test]
fn what_is_wrong_in_a_way_point_file_is_told_with_line_and_column() {
    let error = |text: &str| {
        read_any("a.waypoints", text.as_bytes(), None)
            .unwrap_err()
            .to_string()
    };
    let text = "QGC WPL 110\n0\t1\t0\t16\t0\t0\tx\t0\t47.4\t8.5\t0\t1\n";
    assert_eq!(
        error(text),
        "a.waypoints, line 2, column 14: `x` is no number"
    );
    assert!(error("QGC WPL 100\n").contains("line 1"));
    assert!(error("QGC WPL 110\n1 2 3\n").contains("there are 3 fields, not 12"));
}

/// Plan after `QGroundControl`'s guide: fences of both kinds, rally points, a survey with its transects, put
/// together.
const DOCUMENTED: &str = r#"{
    "fileType": "Plan", "version": 1, "groundStation": "QGroundControl",
    "geoFence": { "version": 2,
        "circles": [ { "circle": { "center": [47.39756763610029, 8.544649762407738], "radius": 319.85 }, "inclusion": true, "version": 1 } ],
        "polygons": [ { "inclusion": true, "version": 1, "polygon": [ [47.39807773798406, 8.543834631785785], [47.39983519888905, 8.550024648373267], [47.39641100087146, 8.54499282423751], [47.395590322265186, 8.539435808992085] ] } ] },
    "rallyPoints": { "version": 2, "points": [ [47.39760401, 8.5509154, 50], [47.39902017, 8.54263274, 50] ] },
    "mission": { "version": 2, "firmwareType": 12, "globalPlanAltitudeMode": 1, "vehicleType": 2, "cruiseSpeed": 15, "hoverSpeed": 5,
        "plannedHomePosition": [47.3977419, 8.545594, 487.989],
        "items": [
            { "AMSLAltAboveTerrain": null, "Altitude": 50, "AltitudeMode": 0, "autoContinue": true, "command": 22, "doJumpId": 1, "frame": 3, "params": [15, 0, 0, null, 47.39750719, 8.54544, 50], "type": "SimpleItem" },
            { "TransectStyleComplexItem": {
                "CameraCalc": { "AdjustedFootprintFrontal": 25, "AdjustedFootprintSide": 25, "CameraName": "Manual (no camera specs)", "DistanceToSurface": 50, "DistanceToSurfaceRelative": true, "version": 1 },
                "CameraShots": 14, "CameraTriggerInTurnAround": true, "FollowTerrain": false, "HoverAndCapture": false,
                "Items": [ { "autoContinue": true, "command": 16, "doJumpId": 2, "frame": 3, "params": [0, 0, 0, null, 47.39795, 8.5456, 50], "type": "SimpleItem" } ],
                "Refly90Degrees": false, "TurnAroundDistance": 10, "VisualTransectPoints": [ [47.39795, 8.5456], [47.39899, 8.5456] ], "version": 1 },
              "angle": 0, "complexItemType": "survey", "entryLocation": 0, "flyAlternateTransects": false,
              "polygon": [ [47.3989, 8.5455], [47.3989, 8.5465], [47.3979, 8.5465] ], "splitConcavePolygons": false, "type": "ComplexItem", "version": 5 },
            { "AMSLAltAboveTerrain": null, "Altitude": 60, "AltitudeMode": 1, "autoContinue": true, "command": 16, "doJumpId": 9, "frame": 3, "params": [0, 0, 0, null, 47.3991, 8.5481, 60], "type": "SimpleItem" },
            { "autoContinue": true, "command": 20, "doJumpId": 10, "frame": 2, "params": [0, 0, 0, 0, 0, 0, 0], "type": "SimpleItem" }
        ] }
}"#;

#[test]
fn the_documented_plan_is_edited_and_keeps_fences_rally_points_and_the_survey() {
    let (mut route, notes) = read("documented.plan", DOCUMENTED);
    let told = |words: &str| {
        assert!(
            notes.iter().any(|n| n.contains(words)),
            "{words}: {notes:?}"
        );
    };
    told("keeps aircraft in: it is kept");
    told("survey");
    let last = route.way_points.last_mut().unwrap();
    last.altitude = Altitude {
        metres: 75.0,
        frame: AltitudeFrame::AboveTakeOff,
    };
    let text = plan(&route);
    let json = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
    let (after, before) = (json(&text), json(DOCUMENTED));
    for name in ["geoFence", "rallyPoints"] {
        assert_eq!(after[name], before[name]);
    }
    let items = |plan: &serde_json::Value| plan["mission"]["items"].as_array().unwrap().clone();
    let (after, before) = (items(&after), items(&before));
    assert_eq!(after.len(), before.len());
    assert_eq!(after[1], before[1], "the survey");
    assert_eq!(after[2]["params"][6], 75.0);
    assert_eq!(after[2]["params"][4], before[2]["params"][4]);
    assert_eq!(after[3]["command"], 20);
    assert_eq!(plan(&read("documented.plan", &text).0), text);
    let points = read_any("a.plan", DOCUMENTED.as_bytes(), Some(frame())).unwrap();
    let heights: Vec<_> = points.rally.iter().map(|point| point.altitude).collect();
    assert_eq!(
        heights,
        [Altitude::new(50.0, AltitudeFrame::AboveTakeOff); 2]
    );
}

/// A plan of way-points, with latitude, longitude and altitude of each.
fn plan_of(places: &[[&str; 3]]) -> String {
    let item = |[latitude, longitude, metres]: &[&str; 3]| {
        format!(
            "{{ \"type\": \"SimpleItem\", \"command\": 16, \"frame\": 3, \"autoContinue\": true, \"Altitude\": {metres}, \
             \"AltitudeMode\": 1, \"params\": [0, 0, 0, null, {latitude}, {longitude}, {metres}] }}"
        )
    };
    let items: Vec<String> = places.iter().map(item).collect();
    format!(
        "{{ \"fileType\": \"Plan\", \"version\": 1, \"mission\": {{ \"version\": 2, \
         \"plannedHomePosition\": [47.4, 8.5, 412.5], \"items\": [{}] }} }}",
        items.join(", ")
    )
}

#[test]
fn a_way_point_without_a_latitude_is_kept_and_not_shown_at_the_equator() {
    let text = plan_of(&[
        ["47.41", "8.5", "50"],
        ["null", "8.51", "50"],
        ["47.42", "null", "50"],
    ]);
    let (route, notes) = read("a.plan", &text);
    assert_eq!(route.way_points.len(), 1);
    assert_noted(&notes, |n| n.contains("altitude is missing: 2 × "));
    let again = plan(&route);
    assert!(again.contains("null, null, 8.51, 50]"), "{again}");
    assert!(again.contains("null, 47.42, null, 50]"), "{again}");
    let lines = "QGC WPL 110\n0 1 0 16 0 0 0 0 47.4 8.5 488 1\n1 0 3 16 0 0 0 0 nan 8.5 50 1\n\
                 2 0 3 16 0 0 0 0 47.41 8.5 50 1\n";
    let (route, _) = read(
        "a.waypoints",
        &lines.replace(' ', "\t").replace("QGC\tWPL\t", "QGC WPL "),
    );
    assert_eq!(route.way_points.len(), 1);
    let written = write_route(Format::Waypoints, &route, &frame()).unwrap();
    let text = String::from_utf8(written.bytes).unwrap();
    assert!(text.contains("\tNaN\t8.5\t50\t"), "{text}");
}

#[test]
fn a_way_point_without_an_altitude_has_that_of_the_one_before_and_still_states_none() {
    let text = plan_of(&[
        ["47.40", "8.5", "null"],
        ["47.41", "8.5", "50"],
        ["47.42", "8.51", "null"],
    ]);
    let (mut route, notes) = read("a.plan", &text);
    let altitudes: Vec<Altitude> = route.way_points.iter().map(|w| w.altitude).collect();
    assert_eq!(
        altitudes,
        [Altitude::new(50.0, AltitudeFrame::AboveTakeOff); 2]
    );
    assert_noted(&notes, |n| {
        n.starts_with("1 × way-point states no altitude")
    });
    assert_noted(&notes, |n| n.contains("altitude is missing"));
    let again = plan(&route);
    assert!(again.contains("null, 47.42, 8.51, null]"), "{again}");
    assert!(again.contains("\"Altitude\": null"), "{again}");
    // Its own altitude is stated as soon as it has one.
    route.way_points[1].altitude.metres = 60.0;
    let again = plan(&route);
    assert!(again.contains("null, 47.42, 8.51, 60.0]"), "{again}");
}
