//! Missions of DJI and Litchi.

use super::super::{ExchangeError, Format, Imported, read_any, write_route};
use super::{assert_noted, frame};
use crate::mission::{Route, WayPoint, WayPointAction};
use pilotage_base::files::{FileSet, FileSink, ZipFiles, ZipSink};
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};

/// The two files of DJI's documentation, shortened, with places.
fn documented(mode: &str, flown: [f64; 2], drawn: Option<(&str, [f64; 2])>) -> Vec<u8> {
    let head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\" \
        xmlns:wpml=\"http://www.dji.com/wpmz/1.0.6\"><Document>";
    let mission = "<wpml:missionConfig><wpml:flyToWaylineMode>safely</wpml:flyToWaylineMode>\
        <wpml:finishAction>goHome</wpml:finishAction>\
        <wpml:takeOffRefPoint>47.400000,8.500000,460.000000</wpml:takeOffRefPoint>\
        <wpml:droneInfo><wpml:droneEnumValue>67</wpml:droneEnumValue></wpml:droneInfo></wpml:missionConfig>";
    let action = "<wpml:actionGroup><wpml:actionGroupId>0</wpml:actionGroupId>\
        <wpml:actionGroupStartIndex>1</wpml:actionGroupStartIndex>\
        <wpml:actionGroupEndIndex>1</wpml:actionGroupEndIndex><wpml:action><wpml:actionId>0</wpml:actionId>\
        <wpml:actionActuatorFunc>takePhoto</wpml:actionActuatorFunc></wpml:action></wpml:actionGroup>";
    let waylines = format!(
        "{head}{mission}<Folder><wpml:templateId>0</wpml:templateId>\
         <wpml:executeHeightMode>{mode}</wpml:executeHeightMode><wpml:waylineId>0</wpml:waylineId>\
         <wpml:autoFlightSpeed>10</wpml:autoFlightSpeed>\
         <Placemark><Point><coordinates>\n  8.5001234567,47.4001234567\n</coordinates></Point>\
         <wpml:index>0</wpml:index><wpml:executeHeight>{}</wpml:executeHeight>\
         <wpml:waypointSpeed>7</wpml:waypointSpeed><wpml:waypointTurnParam>\
         <wpml:waypointTurnMode>coordinateTurn</wpml:waypointTurnMode>\
         <wpml:waypointTurnDampingDist>5</wpml:waypointTurnDampingDist></wpml:waypointTurnParam></Placemark>\
         <Placemark><Point><coordinates>8.51,47.41</coordinates></Point>\
         <wpml:index>1</wpml:index><wpml:executeHeight>{}</wpml:executeHeight>\
         <wpml:waypointSpeed>9</wpml:waypointSpeed>{action}</Placemark></Folder></Document></kml>",
        flown[0], flown[1]
    );
    let mut zip = ZipSink::default();
    if let Some((mode, [first, second])) = drawn {
        let template = format!(
            "{head}{mission}<Folder><wpml:templateType>waypoint</wpml:templateType>\
             <wpml:templateId>0</wpml:templateId><wpml:waylineCoordinateSysParam>\
             <wpml:coordinateMode>WGS84</wpml:coordinateMode><wpml:heightMode>{mode}</wpml:heightMode>\
             </wpml:waylineCoordinateSysParam><wpml:autoFlightSpeed>10</wpml:autoFlightSpeed>\
             <wpml:gimbalPitchMode>usePointSetting</wpml:gimbalPitchMode>\
             <Placemark><Point><coordinates>8.5001234567,47.4001234567</coordinates></Point>\
             <wpml:index>0</wpml:index><wpml:height>{first}</wpml:height><wpml:useGlobalTurnParam>1</wpml:useGlobalTurnParam>\
             </Placemark><Placemark><Point><coordinates>8.51,47.41</coordinates></Point>\
             <wpml:index>1</wpml:index><wpml:height>{second}</wpml:height>{action}</Placemark></Folder></Document></kml>"
        );
        zip.write("wpmz/template.kml", template.as_bytes()).unwrap();
    }
    zip.write("wpmz/waylines.wpml", waylines.as_bytes())
        .unwrap();
    zip.finish().unwrap()
}

fn read(bytes: &[u8]) -> Imported {
    let back = read_any("folder/roof.kmz", bytes, Some(frame())).unwrap();
    assert_eq!((back.format, back.routes.len()), (Format::Wpml, 1));
    back
}

fn altitudes(route: &Route) -> Vec<Altitude> {
    route.way_points.iter().map(|w| w.altitude).collect()
}

fn metres(back: &Imported) -> Vec<f64> {
    let altitudes = altitudes(&back.routes[0]);
    altitudes.iter().map(|altitude| altitude.metres).collect()
}

#[test]
fn a_mission_of_dji_has_the_heights_that_its_modes_say() {
    for (bytes, wanted, frame) in [
        (
            documented("relativeToStartPoint", [60.0, 65.5], None),
            [60.0, 65.5],
            AltitudeFrame::AboveTakeOff,
        ),
        (
            documented("realTimeFollowSurface", [60.0, 65.5], None),
            [60.0, 65.5],
            AltitudeFrame::AboveGround,
        ),
        (
            documented("WGS84", [547.25, 553.25], Some(("EGM96", [500.0, 506.0]))),
            [500.0, 506.0],
            AltitudeFrame::Amsl,
        ),
        (
            documented(
                "WGS84",
                [547.25, 553.25],
                Some(("aboveGroundLevel", [80.0, 90.0])),
            ),
            [80.0, 90.0],
            AltitudeFrame::AboveGround,
        ),
        (
            documented("WGS84", [547.25, 553.25], None),
            [547.25, 553.25],
            AltitudeFrame::Amsl,
        ),
    ] {
        let back = read(&bytes);
        let route = &back.routes[0];
        assert_eq!(route.name, "roof");
        assert_eq!(altitudes(route), wanted.map(|m| Altitude::new(m, frame)));
        // The speed of a leg stands at the way-point that it leads away from.
        let speeds: Vec<_> = route.way_points.iter().map(|w| w.speed).collect();
        assert_eq!(speeds, [None, Some(7.0)]);
        assert!(
            route.way_points[1]
                .properties
                .contains_key("mavlink_ground_speed")
        );
        let told = |words: &str| {
            assert_noted(&back.notes, |n| n.contains(words));
        };
        told("turns at way-points are kept, and not shown: coordinateTurn");
        told("actions are kept, and not shown: takePhoto");
        told("goHome");
        let is_ellipsoid = back.notes.iter().any(|n| n.contains("above the ellipsoid"));
        assert_eq!(is_ellipsoid, wanted[0] > 540.0);
    }
}

#[test]
fn a_mission_of_dji_comes_back_with_all_that_it_said() {
    for bytes in [
        documented(
            "relativeToStartPoint",
            [60.0, 65.5],
            Some(("relativeToStartPoint", [60.0, 65.5])),
        ),
        documented("WGS84", [547.25, 553.25], Some(("EGM96", [500.0, 506.0]))),
        documented("WGS84", [547.25, 553.25], None),
    ] {
        let before = read(&bytes);
        let written = write_route(Format::Wpml, &before.routes[0], &before.frame).unwrap();
        assert_eq!(written.notes, Vec::<String>::new());
        let after = read(&written.bytes);
        assert_eq!(altitudes(&after.routes[0]), altitudes(&before.routes[0]));
        let zip = ZipFiles::open(&written.bytes).unwrap();
        let text = |name| String::from_utf8(zip.read(name).unwrap()).unwrap();
        let (template, waylines) = (text("wpmz/template.kml"), text("wpmz/waylines.wpml"));
        for text in [&template, &waylines] {
            assert!(
                text.contains("xmlns:wpml=\"http://www.dji.com/wpmz/1.0.6\""),
                "{text}"
            );
            assert!(
                text.contains("<wpml:droneEnumValue>67</wpml:droneEnumValue>"),
                "{text}"
            );
        }
        for kept in [
            "8.5001234567,47.4001234567",
            "<wpml:waypointTurnDampingDist>5</",
            "takePhoto",
        ] {
            assert!(waylines.contains(kept), "{waylines}");
        }
        let again = write_route(Format::Wpml, &after.routes[0], &after.frame).unwrap();
        let zip = ZipFiles::open(&again.bytes).unwrap();
        assert_eq!(
            String::from_utf8(zip.read("wpmz/waylines.wpml").unwrap()).unwrap(),
            waylines
        );
    }
}

#[test]
fn heights_above_ground_are_flown_above_the_ellipsoid_as_long_as_nothing_is_changed() {
    let modes = |bytes: &[u8]| {
        let zip = ZipFiles::open(bytes).unwrap();
        let text = |name| String::from_utf8(zip.read(name).unwrap()).unwrap();
        let of = |text: &str, name: &str| {
            let (_, rest) = text.split_once(&format!("<wpml:{name}>")).unwrap();
            rest.split_once('<').unwrap().0.to_owned()
        };
        let waylines = text("wpmz/waylines.wpml");
        let drawn = of(&text("wpmz/template.kml"), "heightMode");
        let executed = of(&waylines, "executeHeight");
        [drawn, of(&waylines, "executeHeightMode"), executed]
    };
    let drawn = Some(("aboveGroundLevel", [80.0, 90.0]));
    let mut back = read(&documented("WGS84", [547.25, 553.25], drawn));
    let same = write_route(Format::Wpml, &back.routes[0], &back.frame).unwrap();
    assert_eq!(modes(&same.bytes), ["aboveGroundLevel", "WGS84", "547.25"]);
    assert_eq!(same.notes, Vec::<String>::new());
    back.routes[0].way_points[1].altitude.metres = 95.0;
    let changed = write_route(Format::Wpml, &back.routes[0], &back.frame).unwrap();
    let follows = ["aboveGroundLevel", "realTimeFollowSurface", "80"];
    assert_eq!(modes(&changed.bytes), follows);
    assert_noted(&changed.notes, |n| {
        n.contains("only the Mavic 3 Enterprise")
    });
    let again = read(&changed.bytes);
    let heights = [80.0, 95.0].map(|m| Altitude::new(m, AltitudeFrame::AboveGround));
    assert_eq!(altitudes(&again.routes[0]), heights);
}

#[test]
fn waylines_of_a_template_alone_fly_its_common_headings_and_turns() {
    let template = "<kml xmlns:wpml=\"http://www.dji.com/wpmz/1.0.2\"><Document><wpml:missionConfig>\
        <wpml:finishAction>noAction</wpml:finishAction></wpml:missionConfig><Folder>\
        <wpml:templateType>waypoint</wpml:templateType><wpml:templateId>0</wpml:templateId>\
        <wpml:waylineCoordinateSysParam><wpml:heightMode>relativeToStartPoint</wpml:heightMode>\
        </wpml:waylineCoordinateSysParam><wpml:autoFlightSpeed>5</wpml:autoFlightSpeed>\
        <wpml:globalWaypointHeadingParam><wpml:waypointHeadingMode>fixed</wpml:waypointHeadingMode>\
        </wpml:globalWaypointHeadingParam><wpml:globalWaypointTurnMode>coordinateTurn</wpml:globalWaypointTurnMode>\
        <Placemark><Point><coordinates>8.5,47.4</coordinates></Point><wpml:index>0</wpml:index>\
        <wpml:height>60</wpml:height><wpml:useGlobalHeadingParam>1</wpml:useGlobalHeadingParam>\
        <wpml:useGlobalTurnParam>1</wpml:useGlobalTurnParam></Placemark>\
        <Placemark><Point><coordinates>8.51,47.41</coordinates></Point><wpml:index>1</wpml:index>\
        <wpml:height>60</wpml:height><wpml:useGlobalHeadingParam>1</wpml:useGlobalHeadingParam>\
        <wpml:waypointHeadingParam><wpml:waypointHeadingMode>followWayline</wpml:waypointHeadingMode>\
        </wpml:waypointHeadingParam><wpml:useGlobalTurnParam>0</wpml:useGlobalTurnParam><wpml:waypointTurnParam>\
        <wpml:waypointTurnMode>toPointAndPassWithContinuityCurvature</wpml:waypointTurnMode>\
        </wpml:waypointTurnParam></Placemark></Folder></Document></kml>";
    let back = read_any("template.kml", template.as_bytes(), None).unwrap();
    let written = write_route(Format::Wpml, &back.routes[0], &back.frame).unwrap();
    let zip = ZipFiles::open(&written.bytes).unwrap();
    let waylines = String::from_utf8(zip.read("wpmz/waylines.wpml").unwrap()).unwrap();
    let words = |name: &str| -> Vec<&str> {
        let pieces = waylines.split(name).skip(1);
        pieces
            .map(|piece| piece.split('<').next().unwrap())
            .collect()
    };
    assert_eq!(words("<wpml:waypointHeadingMode>"), ["fixed", "fixed"]);
    let turns = ["coordinateTurn", "toPointAndPassWithContinuityCurvature"];
    assert_eq!(words("<wpml:waypointTurnMode>"), turns);
    assert_eq!(words("<wpml:waypointTurnDampingDist>"), ["0.2"]);
}

#[test]
fn groups_of_actions_follow_their_way_points_when_others_are_put_before() {
    let mut route = read(&documented("relativeToStartPoint", [60.0, 65.5], None))
        .routes
        .remove(0);
    let new = WayPoint::new(
        GroundPoint::new(50.0, 60.0),
        Altitude::new(60.0, AltitudeFrame::AboveTakeOff),
    );
    route.way_points.insert(0, new);
    let written = write_route(Format::Wpml, &route, &frame()).unwrap();
    let zip = ZipFiles::open(&written.bytes).unwrap();
    let waylines = String::from_utf8(zip.read("wpmz/waylines.wpml").unwrap()).unwrap();
    assert!(
        waylines.contains("<wpml:actionGroupStartIndex>2<"),
        "{waylines}"
    );
    assert!(
        waylines.contains("<wpml:actionGroupEndIndex>2<"),
        "{waylines}"
    );
}

#[test]
fn what_dji_and_litchi_cannot_fly_is_refused_by_name() {
    let at =
        |metres, frame| WayPoint::new(GroundPoint::new(metres, 0.0), Altitude::new(metres, frame));
    let route = |way_points: Vec<WayPoint>| Route {
        way_points,
        ..Route::default()
    };
    let above_sea = route(vec![
        at(500.0, AltitudeFrame::Amsl),
        at(510.0, AltitudeFrame::Amsl),
    ]);
    let mixed = route(vec![
        at(50.0, AltitudeFrame::AboveGround),
        at(60.0, AltitudeFrame::AboveTakeOff),
    ]);
    for (format, route, words) in [
        (Format::Wpml, &above_sea, "above the ellipsoid"),
        (Format::Wpml, &mixed, "several kinds"),
        (Format::Wpml, &route(Vec::new()), "without way-points"),
        (Format::Litchi, &above_sea, "above mean sea level"),
    ] {
        let error = write_route(format, route, &frame()).unwrap_err();
        assert!(matches!(error, ExchangeError::CannotHold { .. }));
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn a_landing_of_a_mission_of_dji_is_no_way_point_on_the_ground() {
    let at = |metres, action| WayPoint {
        action,
        ..WayPoint::new(
            GroundPoint::new(metres, 0.0),
            Altitude::new(metres, AltitudeFrame::AboveTakeOff),
        )
    };
    let route = Route {
        way_points: vec![
            at(50.0, WayPointAction::TakeOff),
            at(80.0, WayPointAction::FlyBy),
            at(0.0, WayPointAction::Land),
        ],
        ..Route::default()
    };
    let written = write_route(Format::Wpml, &route, &frame()).unwrap();
    let back = read(&written.bytes);
    assert_eq!(metres(&back), [50.0, 80.0, 80.0]);
    assert_noted(&back.notes, |n| n.contains("autoLand"));
}

#[test]
fn a_landing_is_no_slant_into_the_ground_for_litchi_nor_before_the_end_for_dji() {
    let at = |north, metres, frame, action| WayPoint {
        action,
        ..WayPoint::new(GroundPoint::new(north, 0.0), Altitude::new(metres, frame))
    };
    let route = Route {
        way_points: vec![
            at(0.0, 80.0, AltitudeFrame::AboveGround, WayPointAction::FlyBy),
            at(9.0, 60.0, AltitudeFrame::AboveGround, WayPointAction::FlyBy),
            at(20.0, 0.0, AltitudeFrame::AboveTakeOff, WayPointAction::Land),
            at(
                30.0,
                70.0,
                AltitudeFrame::AboveGround,
                WayPointAction::FlyBy,
            ),
        ],
        ..Route::default()
    };
    let written = write_route(Format::Litchi, &route, &frame()).unwrap();
    let text = String::from_utf8(written.bytes).unwrap();
    let rows = text.lines().skip(1).map(|row| row.split(','));
    let rows: Vec<Vec<&str>> = rows.map(Iterator::collect).collect();
    let columns: Vec<[&str; 2]> = rows.iter().map(|row| [row[2], row[38]]).collect();
    assert_eq!(
        columns,
        [["80", "1"], ["60", "1"], ["60", "1"], ["70", "1"]]
    );
    assert_noted(&written.notes, |n| {
        n == "the landing is left out: it stays at 60 m above ground"
    });
    let written = write_route(Format::Wpml, &route, &frame()).unwrap();
    assert_eq!(metres(&read(&written.bytes)), [80.0, 60.0, 60.0, 70.0]);
    assert_noted(&written.notes, |n| n.contains("landing before the end"));
}

#[test]
fn an_area_of_dji_without_waylines_is_shown_as_such() {
    let text = "<kml xmlns:wpml=\"http://www.dji.com/wpmz/1.0.2\"><Document><Folder>\
        <wpml:templateType>mapping2d</wpml:templateType><Placemark><Polygon><outerBoundaryIs><LinearRing>\
        <coordinates>8,47,0 8.01,47,0 8.01,47.01,0</coordinates></LinearRing></outerBoundaryIs></Polygon>\
        </Placemark></Folder></Document></kml>";
    let back = read_any("template.kml", text.as_bytes(), None).unwrap();
    assert_eq!((back.routes.len(), back.landmarks.len()), (0, 1));
    assert_noted(&back.notes, |n| n.contains("no waylines"));
}

const LITCHI: &str = "latitude,longitude,altitude(m),heading(deg),curvesize(m),rotationdir,gimbalmode,\
gimbalpitchangle,actiontype1,actionparam1,actiontype2,actionparam2,actiontype3,actionparam3,actiontype4,\
actionparam4,actiontype5,actionparam5,actiontype6,actionparam6,actiontype7,actionparam7,actiontype8,actionparam8,\
actiontype9,actionparam9,actiontype10,actionparam10,actiontype11,actionparam11,actiontype12,actionparam12,\
actiontype13,actionparam13,actiontype14,actionparam14,actiontype15,actionparam15,altitudemode,speed(m/s),\
poi_latitude,poi_longitude,poi_altitude(m),poi_altitudemode,photo_timeinterval,photo_distinterval
47.0012345,8.5,30.5,12.5,3,0,2,-45,1,0,0,2000,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,1,0,47.1,8.6,5,0,-1,12
47.002,8.501,40,0,0,0,0,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,-1,0,0,7.5,0,0,0,0,-1,-1
";

#[test]
fn a_table_of_litchi_comes_back_as_it_was() {
    let before = read_any("roof.csv", LITCHI.as_bytes(), None).unwrap();
    let written = write_route(Format::Litchi, &before.routes[0], &before.frame).unwrap();
    assert_eq!(String::from_utf8(written.bytes).unwrap(), LITCHI);
    // To which leg the 7.5 m/s belong is not known.
    assert_eq!(written.notes.len(), 1, "{:?}", written.notes);
    assert_noted(&written.notes, |n| n.contains("leg that leads to its row"));
}

#[test]
fn speeds_of_litchi_are_over_ground_and_their_legs_are_told_where_it_matters() {
    let read = |table: &str| read_any("roof.csv", table.as_bytes(), None).unwrap();
    let before = read(LITCHI);
    assert_noted(&before.notes, |n| n.contains("over ground"));
    assert_noted(&before.notes, |n| n.contains("leg that leads to its row"));
    let text = write_route(Format::Waypoints, &before.routes[0], &before.frame).unwrap();
    let text = String::from_utf8(text.bytes).unwrap();
    // DO_CHANGE_SPEED, whose first parameter 1 is the speed over ground.
    assert!(text.contains("\t178\t1\t7.5\t-1\t"), "{text}");
    let same = read(&LITCHI.replacen(",1,0,47.1,", ",1,7.5,47.1,", 1));
    assert_noted(&same.notes, |n| n.contains("over ground"));
    assert!(
        !same.notes.iter().any(|n| n.contains("its row")),
        "{:?}",
        same.notes
    );
}

#[test]
fn a_table_of_litchi_in_feet_or_with_decimal_commas_keeps_its_curve_and_its_point_of_interest() {
    let row = |table: &str| -> Vec<String> {
        let before = read_any("roof.csv", table.as_bytes(), None).unwrap();
        let written = write_route(Format::Litchi, &before.routes[0], &before.frame).unwrap();
        let others = |n: &String| n.starts_with("properties");
        assert!(!written.notes.iter().any(others), "{:?}", written.notes);
        let text = String::from_utf8(written.bytes).unwrap();
        let row = text.lines().nth(1).unwrap().split(',');
        row.map(str::to_owned).collect()
    };
    // 30.5 ft, 3 ft and 5 ft of 0.3048 m each.
    let feet = row(&LITCHI.replace("(m)", "(ft)"));
    assert_eq!(
        [&feet[2], &feet[4], &feet[42]],
        ["9.2964", "0.9144", "1.524"]
    );
    let commas = LITCHI.replace(',', ";").replace('.', ",");
    let commas = row(&commas);
    assert_eq!(commas.len(), 46);
    let [heading, latitude, longitude] = [&commas[3], &commas[40], &commas[41]];
    assert_eq!([heading, latitude, longitude], ["12.5", "47.1", "8.6"]);
}

#[test]
fn a_table_for_litchi_says_nothing_about_what_a_route_does_not_know() {
    let way_point = WayPoint::new(
        GroundPoint::new(10.0, 20.0),
        Altitude::new(30.0, AltitudeFrame::AboveTakeOff),
    );
    let route = Route {
        way_points: vec![way_point],
        ..Route::default()
    };
    let written = write_route(Format::Litchi, &route, &frame()).unwrap();
    let text = String::from_utf8(written.bytes).unwrap();
    let row: Vec<&str> = text.lines().nth(1).unwrap().split(',').collect();
    assert_eq!(row.len(), 46);
    assert_eq!(&row[2..8], ["30", "0", "0", "0", "0", "0"]);
    assert!(
        row[8..38].chunks(2).all(|action| action == ["-1", "0"]),
        "{text}"
    );
    assert_eq!(&row[38..], ["0", "0", "0", "0", "0", "0", "-1", "-1"]);
}

#[test]
fn what_a_zip_has_beside_a_mission_of_dji_is_told_and_shadows_are_none_of_it() {
    let zip = ZipFiles::open(&documented("relativeToStartPoint", [60.0, 65.5], None)).unwrap();
    let waylines = zip.read("wpmz/waylines.wpml").unwrap();
    let mut more = ZipSink::default();
    let shadow = "__MACOSX/wpmz/._waylines.wpml";
    for (name, bytes) in [
        (shadow, &[0, 5][..]),
        ("wpmz/waylines.wpml", &waylines),
        ("wpmz/res/a.jpg", &[1][..]),
    ] {
        more.write(name, bytes).unwrap();
    }
    let back = read(&more.finish().unwrap());
    assert_eq!(back.routes[0].way_points.len(), 2);
    assert_noted(&back.notes, |n| n.starts_with("1 × other file"));
}

#[test]
fn a_template_alone_says_how_far_the_ellipsoid_is() {
    let text = "<kml xmlns:wpml=\"http://www.dji.com/wpmz/1.0.2\"><Document><Folder>\
        <wpml:templateType>waypoint</wpml:templateType><wpml:waylineCoordinateSysParam>\
        <wpml:heightMode>EGM96</wpml:heightMode></wpml:waylineCoordinateSysParam>\
        <wpml:autoFlightSpeed>6</wpml:autoFlightSpeed><Placemark><Point><coordinates>8,47</coordinates></Point>\
        <wpml:ellipsoidHeight>547.5</wpml:ellipsoidHeight><wpml:height>500</wpml:height></Placemark>\
        <Placemark><Point><coordinates>8.01,47</coordinates></Point><wpml:ellipsoidHeight>557.5</wpml:ellipsoidHeight>\
        <wpml:height>510</wpml:height></Placemark></Folder></Document></kml>";
    let before = read(text.as_bytes());
    let speeds: Vec<_> = before.routes[0]
        .way_points
        .iter()
        .map(|w| w.speed)
        .collect();
    assert_eq!(speeds, [None, Some(6.0)]);
    let written = write_route(Format::Wpml, &before.routes[0], &before.frame).unwrap();
    let waylines = ZipFiles::open(&written.bytes)
        .unwrap()
        .read("wpmz/waylines.wpml")
        .unwrap();
    let waylines = String::from_utf8(waylines).unwrap();
    for kept in [
        "<wpml:executeHeightMode>WGS84<",
        "<wpml:executeHeight>547.5<",
        "<wpml:executeHeight>557.5<",
    ] {
        assert!(waylines.contains(kept), "{waylines}");
    }
}

#[test]
fn the_template_of_an_area_says_how_far_the_ellipsoid_of_its_waylines_is() {
    let zip = ZipFiles::open(&documented("WGS84", [547.25, 553.25], None)).unwrap();
    let template = "<kml xmlns:wpml=\"http://www.dji.com/wpmz/1.0.6\"><Document><Folder>\
        <wpml:templateType>mapping2d</wpml:templateType><wpml:waylineCoordinateSysParam>\
        <wpml:heightMode>EGM96</wpml:heightMode></wpml:waylineCoordinateSysParam><Placemark><Polygon/>\
        <wpml:ellipsoidHeight>147.25</wpml:ellipsoidHeight><wpml:height>100</wpml:height></Placemark></Folder>\
        </Document></kml>";
    let read_with = |template: &str| {
        let mut more = ZipSink::default();
        let name = "wpmz/waylines.wpml";
        more.write(name, &zip.read(name).unwrap()).unwrap();
        more.write("wpmz/template.kml", template.as_bytes())
            .unwrap();
        read(&more.finish().unwrap())
    };
    let back = read_with(template);
    assert_eq!(metres(&back), [500.0, 506.0]);
    assert_noted(&back.notes, |n| n.contains("47.25 m above it"));
    // Heights above the ground say nothing of the geoid.
    let back = read_with(&template.replace("EGM96", "relativeToStartPoint"));
    assert_eq!(metres(&back), [547.25, 553.25]);
}

#[test]
fn places_of_a_kml_may_begin_with_a_comma() {
    let of = |coordinates: &str| {
        let text = format!(
            "<kml><Placemark><LineString><coordinates>{coordinates}</coordinates></LineString></Placemark></kml>"
        );
        let read = read_any("a.kml", text.as_bytes(), None).unwrap();
        let places = read.routes[0].way_points.iter();
        let places = places.map(|w| read.frame.geodetic_from_ground(&w.position));
        let rounded = |radians: f64| (radians.to_degrees() * 1e6).round() / 1e6;
        places
            .map(|p| (rounded(p.longitude), rounded(p.latitude)))
            .collect::<Vec<_>>()
    };
    let right = [(8.1, 47.1), (8.2, 47.2), (8.3, 47.3)];
    for coordinates in [
        ",8.1,47.1,0 ,8.2,47.2,0\n,8.3,47.3,0",
        ",8.1,47.1 ,8.2,47.2\n,8.3,47.3",
        "8.1, 47.1, 0 8.2 ,47.2 ,0 8.3,47.3,0",
        "8.1,47.1,5 , 8.2,47.2,5 , 8.3,47.3",
        "8.1,47.1, 8.2,47.2, 8.3,47.3,",
    ] {
        assert_eq!(of(coordinates), right, "{coordinates}");
    }
}
