//! Home of files of way-points, and every line and jump of them through reading and writing.

use super::super::{Format, Imported, Places, read_any, write_places, write_route};
use super::assert_noted;
use crate::mission::WayPointAction;

fn read(lines: &[&str]) -> (Imported, String) {
    let text = format!("QGC WPL 110\n{}\n", lines.join("\n").replace(' ', "\t"));
    let imported = read_any("a.waypoints", text.as_bytes(), None).unwrap();
    (imported, text)
}

fn written(imported: &Imported) -> String {
    let route = &imported.routes[0];
    let written = write_route(Format::Waypoints, route, &imported.frame).unwrap();
    String::from_utf8(written.bytes).unwrap()
}

fn told(imported: &Imported, words: &str) -> bool {
    imported.notes.iter().any(|note| note.contains(words))
}

/// A home, a take-off without a place, two changes of speed of which the second changes nothing, and
/// jumps to a way-point and to a change of speed.
const MISSION: [&str; 9] = [
    "0 0 0 16 0 0 0 0 47 8 430 1",
    "1 0 3 22 15 0 0 0 0 0 30 1",
    "2 0 2 178 0 5 0 0 0 0 0 1",
    "3 0 3 16 0 0 0 0 47.001 8 50 1",
    "4 0 0 178 1 5 0 0 0 0 0 1",
    "5 0 3 16 0 0 0 0 47.002 8 50 1",
    "6 0 0 177 3 -1 0 0 0 0 0 1",
    "7 0 0 177 2 1 0 0 0 0 0 1",
    "8 0 3 21 0 0 0 0 47 8 0 1",
];

#[test]
fn home_is_line_0_whatever_its_current_flag_and_every_line_comes_back() {
    // Frame 5 is 0 with whole numbers.
    for (current, frame) in [("0", 0), ("1", 0), ("0", 5), ("1", 5)] {
        let mut lines = MISSION;
        let first = format!("0 {current} {frame} 16 0 0 0 0 47 8 430 1");
        lines[0] = &first;
        let (imported, text) = read(&lines);
        let route = &imported.routes[0];
        assert_eq!(route.properties["home"], "[47.0,8.0,430.0]");
        assert_eq!(route.way_points.len(), 4);
        assert_eq!(route.way_points[0].action, WayPointAction::TakeOff);
        assert_eq!(route.way_points[1].speed, Some(5.0));
        assert_eq!(written(&imported), text);
    }
}

#[test]
fn only_a_heading_that_is_left_to_the_aircraft_is_no_number_in_a_plan() {
    let commands = [
        16, 22, 21, 84, 85, 17, 18, 19, 31, 82, 177, 178, 115, 206, 1000,
    ];
    for command in commands {
        let line = format!("2 0 3 {command} 1 2 3 0 47.001 8 50 1");
        let (imported, text) = read(&[
            "0 0 0 16 0 0 0 0 47 8 430 1",
            "1 1 3 22 0 0 0 0 47 8 30 1",
            &line,
        ]);
        assert_eq!(written(&imported), text);
        let places = Places {
            routes: &imported.routes,
            ..Places::default()
        };
        let plan = write_places(Format::Plan, &places, &imported.frame).unwrap();
        let plan: serde_json::Value = serde_json::from_slice(&plan.bytes).unwrap();
        let items = plan["mission"]["items"].as_array().unwrap();
        let item = items.iter().find(|item| item["params"][0] == 1.0).unwrap();
        let is_heading = [16, 17, 22, 21, 84, 85].contains(&command);
        assert_eq!(item["params"][3].is_null(), is_heading, "{item}");
    }
    // Of a circle that nobody has stated, too.
    for action in [
        WayPointAction::Loiter {
            radius: 30.0,
            turns: 2.0,
        },
        WayPointAction::Wait {
            radius: 30.0,
            seconds: Some(9.0),
        },
    ] {
        let (_, parameters) = super::super::item::command_of(&action);
        assert_eq!(parameters[3], Some(0.0));
    }
    let without_end = WayPointAction::Wait {
        radius: 30.0,
        seconds: None,
    };
    let (_, parameters) = super::super::item::command_of(&without_end);
    assert_eq!(parameters[3], None);
}

#[test]
fn the_mark_of_the_current_command_stays_with_it_or_goes() {
    let mut lines: Vec<String> = vec!["0 0 0 16 0 0 0 0 47 8 430 1".to_owned()];
    for i in 1..6 {
        let mark = u8::from(i == 3);
        lines.push(format!("{i} {mark} 3 16 0 0 0 0 47.00{i} 8 50 1"));
    }
    let lines: Vec<&str> = lines.iter().map(String::as_str).collect();
    let marked = |gone: &[usize]| {
        let (mut imported, _) = read(&lines);
        let way_points = &mut imported.routes[0].way_points;
        for place in gone {
            way_points.remove(*place);
        }
        let text = written(&imported);
        let marked = text
            .lines()
            .filter(|line| line.split('\t').nth(1) == Some("1"));
        marked
            .map(|line| line.split('\t').nth(8).unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(marked(&[]), ["47.003"]);
    for kept in [&[0][..], &[1], &[1, 0], &[4], &[4, 3, 1, 0]] {
        assert_eq!(marked(kept), ["47.003"], "{kept:?}");
    }
    assert!(marked(&[2]).is_empty());
    assert!(marked(&[2, 1]).is_empty());
}

#[test]
fn jumps_follow_their_commands_when_the_route_is_edited() {
    let (mut imported, _) = read(&MISSION);
    let copy = imported.routes[0].way_points[0].clone();
    let mut added = crate::mission::WayPoint::new(copy.position, copy.altitude);
    added.position.north += 50.0;
    imported.routes[0].way_points.insert(1, added);
    let text = written(&imported);
    let jumps: Vec<&str> = text
        .lines()
        .filter(|l| l.split('\t').nth(3) == Some("177"))
        .map(|l| l.split('\t').nth(4).unwrap())
        .collect();
    let row = |n: &str| {
        text.lines()
            .find(|l| l.starts_with(&format!("{n}\t")))
            .unwrap()
    };
    assert!(row(jumps[0]).contains("\t47.001\t"), "{text}");
}

#[test]
fn a_home_that_was_never_set_is_none_and_its_line_comes_back() {
    let (imported, text) = read(&[
        "0 1 0 0 0 0 0 0 0 0 0 1",
        "1 0 3 22 0 0 0 0 0 0 30 1",
        "2 0 3 16 0 0 0 0 47.001 8 50 1",
    ]);
    assert!(told(&imported, "home was not set"), "{:?}", imported.notes);
    assert!(
        told(&imported, "route begins behind it"),
        "{:?}",
        imported.notes
    );
    assert!(!imported.notes.iter().any(|n| n.contains("put at the home")));
    assert_eq!(imported.routes[0].way_points.len(), 1);
    assert!(!imported.routes[0].properties.contains_key("home"));
    assert_eq!(written(&imported), text);
}

#[test]
fn a_file_without_a_line_for_home_is_written_without_one() {
    let (imported, text) = read(&[
        "0 0 3 22 0 0 0 0 0 0 30 1",
        "1 0 3 16 0 0 0 0 47.001 8 50 1",
        "2 0 0 177 1 -1 0 0 0 0 0 1",
    ]);
    assert!(
        told(&imported, "the file has no home"),
        "{:?}",
        imported.notes
    );
    assert_eq!(written(&imported), text);
}

#[test]
fn fences_are_areas_and_talk_of_no_home() {
    let (imported, text) = read(&[
        "0 0 0 5002 3 0 0 0 47 8 0 0",
        "1 0 0 5002 3 0 0 0 47 8.001 0 0",
        "2 0 0 5002 3 0 0 0 47.001 8 0 0",
        "3 0 0 5004 100 0 0 0 47.01 8 0 0",
        "4 0 0 5001 3 0 0 0 47 8 0 0",
        "5 0 0 5001 3 0 0 0 47 8.1 0 0",
        "6 0 0 5001 3 0 0 0 47.1 8 0 0",
    ]);
    assert_eq!(imported.no_fly.len(), 2);
    assert_eq!(imported.no_fly[0].corners.len(), 3);
    // Every corner of the polygon around the circle lies at or a little beyond its radius.
    let middle =
        imported
            .frame
            .ground_from_geodetic(&pilotage_base::frames::Geodetic::from_degrees(
                47.01, 8.0, 0.0,
            ));
    for corner in &imported.no_fly[1].corners {
        let radius = corner.distance(&middle);
        assert!((100.0..100.6).contains(&radius), "{radius}");
    }
    assert!(
        !imported.notes.iter().any(|n| n.contains("home")),
        "{:?}",
        imported.notes
    );
    assert!(told(&imported, "keeps aircraft in"), "{:?}", imported.notes);
    assert_eq!(written(&imported), text);
}

#[test]
fn a_fence_about_home_that_has_no_place_is_told() {
    let (imported, text) = read(&["0 0 0 5005 50 0 0 0 0 0 0 0"]);
    assert!(
        told(&imported, "fence that is no area"),
        "{:?}",
        imported.notes
    );
    assert_eq!(written(&imported), text);
}

#[test]
fn areas_become_fences_of_a_plan_once_and_are_a_note_elsewhere() {
    let (imported, _) = read(&[
        "0 1 0 16 0 0 0 0 47 8 430 1",
        "1 0 3 16 0 0 0 0 47.001 8 50 1",
        "2 0 0 5002 3 0 0 0 47 8 0 0",
        "3 0 0 5002 3 0 0 0 47 8.001 0 0",
        "4 0 0 5002 3 0 0 0 47.001 8 0 0",
    ]);
    let plan = |imported: &Imported, format: Format| {
        let places = Places {
            routes: &imported.routes,
            no_fly: &imported.no_fly,
            ..Places::default()
        };
        write_places(format, &places, &imported.frame).unwrap()
    };
    let first = plan(&imported, Format::Plan);
    let again = read_any("a.plan", &first.bytes, None).unwrap();
    assert_eq!(again.no_fly.len(), 1);
    for (a, b) in again.no_fly[0]
        .corners
        .iter()
        .zip(&imported.no_fly[0].corners)
    {
        let apart = |c| again.frame.geodetic_from_ground(c);
        let (a, b) = (apart(a), imported.frame.geodetic_from_ground(b));
        assert!(
            (a.latitude - b.latitude).abs() < 1e-10 && (a.longitude - b.longitude).abs() < 1e-10
        );
    }
    // The fence that the plan kept is not written a second time.
    let third = read_any("a.plan", &plan(&again, Format::Plan).bytes, None).unwrap();
    assert_eq!(third.no_fly.len(), 1);
    let table = plan(&imported, Format::Csv);
    assert_noted(&table.notes, |n| n.contains("no-fly area"));
}

#[test]
fn an_area_beside_the_fences_of_a_way_point_file_is_a_note() {
    let (mut imported, _) = read(&[
        "0 1 0 16 0 0 0 0 47 8 430 1",
        "1 0 3 16 0 0 0 0 47.001 8 50 1",
        "2 0 0 5002 3 0 0 0 47 8 0 0",
        "3 0 0 5002 3 0 0 0 47 8.001 0 0",
        "4 0 0 5002 3 0 0 0 47.001 8 0 0",
    ]);
    let left_out = |imported: &Imported| {
        let places = Places {
            routes: &imported.routes,
            no_fly: &imported.no_fly,
            ..Places::default()
        };
        let written = write_places(Format::Waypoints, &places, &imported.frame).unwrap();
        let mut notes = written.notes.into_iter();
        notes.find(|note| note.contains("no-fly area"))
    };
    assert_eq!(left_out(&imported), None);
    let mut drawn = imported.no_fly[0].clone();
    drawn.corners[0].north += 50.0;
    imported.no_fly.push(drawn);
    assert!(left_out(&imported).is_some_and(|note| note.starts_with("1 ×")));
}

#[test]
fn version_120_is_the_same_and_another_is_refused() {
    let text = "QGC WPL 120\n0\t1\t0\t16\t0\t0\t0\t0\t47\t8\t430\t1\n1\t0\t3\t16\t0\t0\t0\t0\t47.001\t8\t50\t1\n";
    let imported = read_any("a.waypoints", text.as_bytes(), None).unwrap();
    assert_eq!(imported.routes[0].way_points.len(), 1);
    assert_eq!(written(&imported), text);
    let error = read_any("a.waypoints", text.replace("120", "999").as_bytes(), None).unwrap_err();
    assert!(error.to_string().contains("line 1"), "{error}");
}
