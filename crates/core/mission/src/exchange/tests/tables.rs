//! Tables of places as other programs write them: places in one cell, geometries, parts of angles, frames as numbers.

use super::assert_noted;
use crate::exchange::{Format, Imported, read_any, write_route};
use crate::mission::WayPointAction;
use pilotage_base::frames::{Altitude, AltitudeFrame};

fn read(table: &str) -> Imported {
    read_any("a.csv", table.as_bytes(), None).unwrap_or_else(|e| panic!("{e}\n{table}"))
}

/// Latitude and longitude of the landmarks, degrees.
fn landmarks(found: &Imported) -> Vec<[f64; 2]> {
    let places = found.landmarks.iter().map(|landmark| {
        let place = found.frame.geodetic_from_ground(&landmark.reference);
        [place.latitude.to_degrees(), place.longitude.to_degrees()]
    });
    places.collect()
}

/// Latitude and longitude of the way-points of the first route, degrees.
fn way_points(found: &Imported) -> Vec<[f64; 2]> {
    let places = found.routes[0].way_points.iter().map(|way_point| {
        let place = found.frame.geodetic_from_ground(&way_point.position);
        [place.latitude.to_degrees(), place.longitude.to_degrees()]
    });
    places.collect()
}

#[track_caller]
fn assert_at(found: &[[f64; 2]], expected: &[[f64; 2]]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (found, expected) in found.iter().zip(expected) {
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < 1e-9, "{found:?} {expected:?}");
        }
    }
}

#[test]
fn a_table_that_was_cut_off_is_refused_with_its_line() {
    let whole = "name,lat,lon,height\nA,47.123456,8.512345,10\nB,47.234567,8.654321,11";
    let found = read(whole);
    assert_eq!(found.landmarks.len(), 2);
    assert!(!found.notes.iter().any(|note| note.contains("cut off")));
    let end_of_place = whole.rfind(',').unwrap();
    for cut in whole.rfind("B,").unwrap() + 1..end_of_place {
        let told = read_any("a.csv", &whole.as_bytes()[..cut], None).unwrap_err();
        let told = told.to_string();
        assert!(
            told.contains("line 3") && told.contains("cut off"),
            "{told}"
        );
    }
    let short = &whole[..end_of_place];
    for table in [short, "name,lat,lon,note\nA,47.1,8.5,church\nB,47.2,8.6"] {
        let found = read(table);
        assert_eq!(found.landmarks.len(), 2);
        assert_noted(&found.notes, |note| {
            note.contains("line 3") && note.contains("may be cut off")
        });
        assert_eq!(read(&format!("{table}\r")).landmarks.len(), 2);
    }
    // The last number of all may lack digits as well.
    let full = read("name,lat,lon\nA,47.123456,8.512345\nB,47.234567,8.6");
    assert_noted(&full.notes, |note| note.contains("may be cut off"));
    // Others leave out their last cells all along.
    let found = read("name,lat,lon,height\nA,47.1,8.5\nB,47.2,8.6");
    assert_eq!(found.landmarks.len(), 2);
    assert!(!found.notes.iter().any(|note| note.contains("cut off")));
}

#[test]
fn both_numbers_may_stand_in_one_cell() {
    let both = [[47.5, 8.5], [47.6, 8.6]];
    for table in [
        "name,coordinates\nA,\"47.5, 8.5\"\nB,\"47.6, 8.6\"\n",
        "name,location\nA,47.5 8.5\nB,47.6 8.6\n",
        "name;Koordinaten\nA;47,5 8,5\nB;47,6 8,6\n",
        "name,where\nA,47°30'N 8°30'E\nB,47°36'N 8°36'E\n",
        "name,lonlat\nA,8.5 47.5\nB,8.6 47.6\n",
        "name,GPS,alt_seen\nA,\"(47.5, 8.5)\",12\nB,\"(47.6, 8.6)\",13\n",
    ] {
        assert_at(&landmarks(&read(table)), &both);
    }
    let unsure = read("name,coordinates\nA,\"47.5, 8.5\"\n");
    assert_noted(&unsure.notes, |note| {
        note.contains("call the column `lon lat`")
    });
    let sure = read("name,lat/lon\nA,\"47.5, 8.5\"\n");
    assert!(!sure.notes.iter().any(|note| note.contains("lon lat")));
    let far = read("name,position\nA,\"-122.5, 45.5\"\n");
    assert_at(&landmarks(&far), &[[45.5, -122.5]]);
    let flown = read("position,altitude\n\"47.5, 8.5\",50\n\"47.6, 8.6\",60\n");
    assert_at(&way_points(&flown), &both);
    let error = read_any(
        "a.csv",
        b"name,coordinates\nA,\"47.5, 8.5\"\nB,here\n",
        None,
    );
    assert!(error.unwrap_err().to_string().contains("latitude"));
}

#[test]
fn geometries_become_landmarks_with_holes_and_routes() {
    let table = "WKT,name,description\n\"POINT (8.5 47.5)\",A,x\n\"LINESTRING Z (8 47 400, 8.1 47.1 410)\",B,\n\
                 \"POLYGON ((8 47, 8.3 47, 8.3 47.3, 8 47), (8.1 47.05, 8.2 47.05, 8.2 47.1, 8.1 47.05))\",C,\n\
                 \"MULTIPOINT ((8.6 47.6), (8.7 47.7))\",D,\n";
    let found = read(table);
    let mut names: Vec<&str> = found.landmarks.iter().map(|l| l.name.as_str()).collect();
    names.sort_unstable();
    assert_eq!(names, ["A", "C", "D", "D"]);
    let points = landmarks(&found);
    let first = found.landmarks.iter().position(|l| l.name == "A").unwrap();
    assert_at(&points[first..=first], &[[47.5, 8.5]]);
    assert_eq!(found.routes[0].name, "B");
    assert_at(&way_points(&found), &[[47.0, 8.0], [47.1, 8.1]]);
    let altitude = found.routes[0].way_points[1].altitude;
    assert_eq!(
        (altitude.metres, altitude.frame),
        (410.0, AltitudeFrame::Amsl)
    );
    let polygon = found.landmarks.iter().find(|l| l.name == "C").unwrap();
    assert_eq!(polygon.holes().len(), 1);
    // A table of points with altitudes is a route.
    let flown = read("WKT,alt\nPOINT (8.5 47.5),50\nPOINT (8.6 47.6),60\n");
    assert_at(&way_points(&flown), &[[47.5, 8.5], [47.6, 8.6]]);
    let error = read_any("a.csv", b"WKT,id\n\"POINT (2600000 1200000)\",1\n", None);
    assert!(error.unwrap_err().to_string().contains("degrees"));
}

#[test]
fn angles_in_three_columns_are_added_up() {
    let table = "name,lat_deg,lat_min,lat_sec,lat_dir,lon_deg,lon_min,lon_sec,lon_dir\nA,33,51,0,S,18,25,12,W\n";
    assert_at(&landmarks(&read(table)), &[[-33.85, -18.42]]);
    let table = "name,lat_deg,lat_min,lon_deg,lon_min\nA,-33,51.0,-0,25.2\n";
    assert_at(&landmarks(&read(table)), &[[-33.85, -0.42]]);
    let broken = "name,lat_deg,lat_min,lon_deg,lon_min\nA,33.5,51.0,8,25.2\n";
    let error = read_any("a.csv", broken.as_bytes(), None).unwrap_err();
    assert!(error.to_string().contains("fraction"), "{error}");
}

#[test]
fn frames_are_words_or_numbers_of_mavlink_and_modes_are_those_of_litchi() {
    use AltitudeFrame::{AboveGround, AboveTakeOff, Amsl};
    let frames = |column: &str, values: &[&str]| -> Vec<AltitudeFrame> {
        let rows: Vec<String> = values
            .iter()
            .enumerate()
            .map(|(i, value)| format!("47.{i},8,50,{value}"))
            .collect();
        let found = read(&format!("Lat,Lng,Alt,{column}\n{}\n", rows.join("\n")));
        let way_points = found.routes[0].way_points.iter();
        way_points.map(|w| w.altitude.frame).collect()
    };
    // MAV_FRAME: GLOBAL, GLOBAL_RELATIVE_ALT, GLOBAL_TERRAIN_ALT, and the same of whole numbers.
    assert_eq!(
        frames("Frame", &["0", "3", "10", "5", "6", "11"]),
        [
            Amsl,
            AboveTakeOff,
            AboveGround,
            Amsl,
            AboveTakeOff,
            AboveGround
        ]
    );
    assert_eq!(
        frames("altitudemode", &["0", "1"]),
        [AboveTakeOff, AboveGround]
    );
    assert_eq!(
        frames("Altitude Reference", &["Takeoff", "MSL"]),
        [AboveTakeOff, Amsl]
    );
    let error = read_any("a.csv", b"Lat,Lng,Alt,Frame\n47,8,50,7\n", None);
    assert!(error.unwrap_err().to_string().contains("`7`"));
}

#[test]
fn commands_without_a_place_are_left_out_of_a_table_of_commands() {
    let found =
        read("CNum,CId,Lat,Lng,Alt,Frame\n1,16,47,8,50,3\n2,178,0,0,0,3\n3,16,47.1,8,50,3\n");
    assert_at(&way_points(&found), &[[47.0, 8.0], [47.1, 8.0]]);
    assert_noted(&found.notes, |note| note.contains("1 of the rows"));
}

#[test]
fn columns_called_x_and_y_are_places_only_where_they_are_degrees_for_sure() {
    let found = read("X,Y,id,name\n8.50001,47.50002,1,A\n8.60001,47.60002,2,B\n");
    assert_at(
        &landmarks(&found),
        &[[47.50002, 8.50001], [47.60002, 8.60001]],
    );
    assert_noted(&found.notes, |note| note.contains("`X` and `Y`"));
    for table in [
        "X,Y,name\n2600000.12345,1200000.12345,A\n",
        "X,Y,name\n12.5,33.25,A\n14.0,31.5,B\n",
    ] {
        let error = read_any("a.csv", table.as_bytes(), None).unwrap_err();
        assert!(error.to_string().contains("latitude"), "{error}");
    }
}

/// Sound tables that columns beside their places must not turn into others.
#[test]
fn what_stands_beside_latitude_and_longitude_changes_no_place() {
    for (header, cells) in [
        ("owner", "Martin Meier"),
        ("owner", "Destination (north)"),
        ("site", "Point Mugu"),
        ("site", "Point East"),
        (
            "altitude,footprint",
            "430,\"POLYGON ((8 47, 9 47, 9 48, 8 47))\"",
        ),
        ("geom", "SRID=3857;POINT (946000 6024000)"),
        ("size", "\"1.5, 2.0\""),
    ] {
        let table = format!("name,latitude,longitude,{header}\nA,47.5,8.5,{cells}\n");
        let found = read(&table);
        let at = if found.routes.is_empty() {
            landmarks(&found)
        } else {
            way_points(&found)
        };
        assert_at(&at, &[[47.5, 8.5]]);
    }
    let metres = "name,lat_deg,lon_deg,lat_m,lon_m\nA,47.5,8.5,5261000,640000\n";
    assert_at(&landmarks(&read(metres)), &[[47.5, 8.5]]);
    let both = "name,latitude,longitude,lat_deg,lat_min,lat_sec,lon_deg,lon_min,lon_sec\nA,47.5,8.25,47,30,0,8,15,0\n";
    assert_at(&landmarks(&read(both)), &[[47.5, 8.25]]);
}

#[test]
fn minutes_with_decimals_and_hemispheres_at_no_degrees_are_heeded() {
    let decimals = "name,lat_deg,lat_dec_min,lon_deg,lon_dec_min\nA,47,30.5,8,15.3\n";
    let place = [47.0 + 30.5 / 60.0, 8.0 + 15.3 / 60.0];
    assert_at(&landmarks(&read(decimals)), &[place]);
    let west = "name,lat_deg,lat_min,lon_deg,lon_min\nA,51N,30,0W,7.5\n";
    assert_at(&landmarks(&read(west)), &[[51.5, -0.125]]);
}

#[test]
fn numbers_that_may_be_anything_are_no_places() {
    for table in [
        "name,size\nA,\"1.5, 2.0\"\n",
        "name,opening\nA,9.30 17.30\n",
        "timestamp,x,y,z\n1.0,1.23456,2.34567,0.5\n",
    ] {
        assert!(
            read_any("a.csv", table.as_bytes(), None).is_err(),
            "{table}"
        );
    }
}

#[test]
fn frames_are_those_of_litchi_unless_something_is_of_mavlink_alone() {
    let frames = |table: &str| -> Vec<AltitudeFrame> {
        let found = read(table);
        let points = found.routes[0].way_points.iter();
        points.map(|point| point.altitude.frame).collect()
    };
    let litchi = "lat,lon,alt,frame\n47,8,30,0\n47.1,8,30,1\n";
    assert_eq!(
        frames(litchi),
        [AltitudeFrame::AboveTakeOff, AltitudeFrame::AboveGround]
    );
    let mavlink = "lat,lon,alt,frame\n47,8,430,0\n47.1,8,30,3\n";
    assert_eq!(
        frames(mavlink),
        [AltitudeFrame::Amsl, AltitudeFrame::AboveTakeOff]
    );
}

#[test]
fn a_height_in_a_geometry_counts_from_the_sea() {
    let found = read("WKT,speed\n\"POINT Z (8.5 47.5 430)\",5\n");
    let point = &found.routes[0].way_points[0];
    assert_eq!(
        (point.altitude.metres, point.altitude.frame),
        (430.0, AltitudeFrame::Amsl)
    );
}

#[test]
fn a_landmark_without_a_place_is_left_out_and_told_and_no_way_point_is() {
    let found = read("name,lat,lon\nA,,\nB,-33.85,-18.42\nC,,\n");
    assert_at(&landmarks(&found), &[[-33.85, -18.42]]);
    let told = |note: &String| note == "2 rows have no place, and are left out";
    assert!(found.notes.iter().any(told), "{:?}", found.notes);
    let found = read("name,pos\nA,\nB,\"-33.85, -18.42\"\n");
    assert_at(&landmarks(&found), &[[-33.85, -18.42]]);
    for refused in [
        "name,lat,lon\nA,,\n",
        "name,lat,lon\nA,-33.85,\nB,-33.85,-18.42\n",
        "lat,lon,alt\n,,50\n-33.85,-18.42,50\n",
    ] {
        let error = read_any("x.csv", refused.as_bytes(), None).unwrap_err();
        assert!(error.to_string().contains("line 2"), "{error}");
    }
}

#[test]
fn places_of_short_names_squares_and_libraries_are_read() {
    for (table, right) in [
        (
            "name,pos\nA,-33.85 -18.42\nB,-33.86 -18.43\n",
            [[-33.85, -18.42], [-33.86, -18.43]],
        ),
        (
            "name,location\nA,\"lat/lng: (-33.85,-18.42)\"\nB,\"LatLng(-33.86, -18.43)\"\n",
            [[-33.85, -18.42], [-33.86, -18.43]],
        ),
        // pyproj: 32632 to 4326 of (448251.5, 5211932.5) and a kilometre east, the middles of their squares.
        (
            "name,MGRS\nA,32TMT4825111932\nB,32T MT 49251 11932\n",
            [
                [47.058_879_634_2, 8.318_577_666_3],
                [47.058_957_221_2, 8.331_744_702_3],
            ],
        ),
    ] {
        assert_at(&landmarks(&read(table)), &right);
    }
}

#[test]
fn hemispheres_in_the_names_of_columns_turn_places() {
    for (head, right) in [
        ("name,Latitude (S),Longitude (W)", [-47.5, -8.25]),
        ("name,Lat S,Lon E", [-47.5, 8.25]),
        ("name,lat_n,lon_w", [47.5, -8.25]),
        ("name,LAT [°N],West Longitude", [47.5, -8.25]),
    ] {
        let table = format!("{head}\nA,47.5,8.25\n");
        assert_at(&landmarks(&read(&table)), &[right]);
    }
    // Signs and letters that say the same count once; others are refused.
    let signed = read("name,Lat (S),Lon (W)\nA,-47.5,8.25W\n");
    assert_at(&landmarks(&signed), &[[-47.5, -8.25]]);
    let error = read_any("a.csv", b"name,Lat (S),Lon (W)\nA,47.5N,8.25\n", None);
    let error = error.unwrap_err().to_string();
    assert!(
        error.contains("Lat (S)") && error.contains("says N"),
        "{error}"
    );
}

#[test]
fn tables_may_begin_with_other_lines_and_name_places_in_other_languages() {
    for table in [
        "sep=;\nname;lat;lon\nA;47,5;8,25\n",
        "# exported, 2024\n\nname,lat,lon\nA,47.5,8.25\n",
        "name|lat|lon\nA|47.5|8.25\n",
        "Name;Breitengrad;Längengrad\nA;47,5;8,25\n",
        "nombre,latitud,longitud\nA,47.5,8.25\n",
        "nome,Latitudine,Longitudine\nA,47.5,8.25\n",
    ] {
        assert_at(&landmarks(&read(table)), &[[47.5, 8.25]]);
    }
    // Lines are counted in the file.
    let error = read_any("a.csv", b"sep=,\nname,lat,lon\nA,47.5,8.25\nB,x,8\n", None);
    let error = error.unwrap_err().to_string();
    assert!(error.contains("line 4"), "{error}");
}

#[test]
fn a_reference_table_of_metashape_has_its_names_behind_a_comment() {
    let table = "# CoordinateSystem: WGS 84 (EPSG::4326)\n#Label,X/Longitude,Y/Latitude,Z/Altitude\n\
        DJI_1.JPG,8.5,47.3,500\nDJI_2.JPG,8.51,47.3,510\n";
    for name in ["reference.csv", "reference.txt"] {
        let found = read_any(name, table.as_bytes(), None).unwrap();
        let way_points = &found.routes[0].way_points;
        let names = way_points.iter().map(|it| it.properties["name"].as_str());
        assert!(names.eq(["\"DJI_1.JPG\"", "\"DJI_2.JPG\""]));
        assert_eq!(
            way_points[0].altitude,
            Altitude::new(500.0, AltitudeFrame::Amsl)
        );
        let place = found.frame.geodetic_from_ground(&way_points[1].position);
        let degrees = [place.longitude, place.latitude].map(f64::to_degrees);
        assert!((degrees[0] - 8.51).abs() < 1e-9 && (degrees[1] - 47.3).abs() < 1e-9);
    }
}

#[test]
fn names_of_x_and_y_behind_a_comment_are_longitude_and_latitude() {
    for table in [
        "#Label,X_est,Y_est,Z_est\nGCP1,8.500000,47.300000,480.0\n",
        "#name,x,y,alt,heading\nGCP1,8.500000,47.300000,480.0,10\n",
    ] {
        let found = read(table);
        let places = if found.routes.is_empty() {
            landmarks(&found)
        } else {
            way_points(&found)
        };
        assert_at(&places, &[[47.3, 8.5]]);
        assert_noted(&found.notes, |note| note.contains("longitude and latitude"));
    }
    // Nothing is a place there.
    let error = read_any("a.csv", b"#name,x,y\nA,2600000.1,1200000.2\n", None).unwrap_err();
    assert!(error.to_string().contains("latitude"), "{error}");
}

#[test]
fn speeds_over_ground_are_those_of_the_legs_and_points_of_surveys_have_their_names() {
    let found =
        read("wp,lat,lon,alt_ft_agl,groundspeed_kts\n1,47.0,8.0,400,20\n2,47.001,8.0,400,0\n");
    let route = &found.routes[0].way_points;
    assert!((route[0].speed.unwrap() - 20.0 * 1852.0 / 3600.0).abs() < 1e-12);
    assert_eq!(route[0].properties["mavlink_ground_speed"], "true");
    assert_eq!(route[1].speed, None);
    assert!(!route[1].properties.contains_key("mavlink_ground_speed"));
    assert_noted(&found.notes, |note| note.contains("over ground"));
    assert!(!found.notes.iter().any(|note| note.contains("Litchi")));
    let found = read("PointId\tLatitude\tLongitude\tEll. Height\nA1\t47.5\t8.25\t477.5\n");
    assert_at(&landmarks(&found), &[[47.5, 8.25]]);
    assert_eq!(found.landmarks[0].name, "A1");
}

#[test]
fn rows_of_photos_are_places_and_no_heights_to_fly_at() {
    let found = read(
        "Photo Name,Latitude,Longitude,Altitude,Yaw\nDJI_0001.JPG,47.5,8.25,485.2,90\nDJI_0002.JPG,47.6,8.25,485.3,90\n",
    );
    assert_at(&landmarks(&found), &[[47.5, 8.25], [47.6, 8.25]]);
    assert_eq!(found.landmarks[0].name, "DJI_0001.JPG");
    assert!(found.landmarks[0].properties["Altitude"].contains("485.2"));
    let flown = read("latitude,longitude,altitude,image,speed\n47.5,8.25,40,a.jpg,5\n");
    assert_at(&way_points(&flown), &[[47.5, 8.25]]);
}

#[test]
fn airports_are_landmarks_and_no_way_points_at_their_elevations() {
    let found = read(
        "\"id\",\"ident\",\"type\",\"name\",\"latitude_deg\",\"longitude_deg\",\"elevation_ft\"\n\
         6523,\"00A\",\"heliport\",\"Total RF Heliport\",40.070985,-74.933689,11\n",
    );
    assert_at(&landmarks(&found), &[[40.070_985, -74.933_689]]);
    assert!(found.routes.is_empty());
    let flown = read("name,latitude,longitude,elevation\na,47.5,8.25,40\n");
    assert_at(&way_points(&flown), &[[47.5, 8.25]]);
}

#[test]
fn a_table_of_a_mission_tells_that_home_and_the_first_commands_have_no_row() {
    let lines = "0 1 0 16 0 0 0 0 -33.85 18.42 357 1\n1 0 3 2000 0 1 0 0 0 0 0 1\n2 0 3 201 0 0 0 0 -33.84 18.41 71 1\n\
                 3 0 3 16 0 0 0 0 -33.84 18.40 78 1\n";
    let text = format!("QGC WPL 110\n{}", lines.replace(' ', "\t"));
    let mission = read_any("a.waypoints", text.as_bytes(), None).unwrap();
    for format in [Format::Csv, Format::Litchi] {
        let written = write_route(format, &mission.routes[0], &mission.frame).unwrap();
        assert_noted(&written.notes, |n| {
            n.starts_with("the home position is left out")
        });
        assert_noted(&written.notes, |n| {
            n.starts_with("2 × command before the first way-point is left out")
        });
        assert!(
            !written.notes.iter().any(|n| n.starts_with("other")),
            "{:?}",
            written.notes
        );
    }
}

#[test]
fn seconds_of_waiting_in_a_table_without_actions_are_waited() {
    let found = read(
        "WP;Latitude;Longitude;AltitudeAGL;Speed;WaitTime\n1;47.3977;8.5456;50;5;2\n2;47.398;8.546;55;6;\n",
    );
    let actions: Vec<_> = found.routes[0]
        .way_points
        .iter()
        .map(|w| w.action)
        .collect();
    let wait = WayPointAction::Wait {
        radius: 0.0,
        seconds: Some(2.0),
    };
    assert_eq!(actions, [wait, WayPointAction::FlyBy]);
    // Times of rows are no waits, nor is what is no number.
    for table in [
        "seconds,latitude,longitude,alt\n0,47,8,50\n10,47.1,8.1,50\n20,47.2,8.2,50\n",
        "lat,lon,alt,Hold Time\n47,8,50,2 min\n47.1,8.1,50,2 min\n",
    ] {
        let found = read(table);
        let mut way_points = found.routes[0].way_points.iter();
        assert!(
            way_points.all(|w| w.action == WayPointAction::FlyBy),
            "{table}"
        );
    }
}

#[test]
fn places_of_a_table_may_be_whole_ten_millionths_of_a_degree_or_addresses_of_maps() {
    let right = [[-35.363_262_1, 149.165_237_4], [-35.362_5, 149.166]];
    let rows = "A,-353632621,1491652374\nB,-353625000,1491660000\n";
    for names in [
        "name,lat,lon",
        "name,latitude_e7,longitude_e7",
        "name,latitudeE7,longitudeE7",
        "name,lat [1e7 deg],lon [1e7 deg]",
        "name,lat (degE7),lon (degE7)",
    ] {
        let found = read(&format!("{names}\n{rows}"));
        assert_at(&landmarks(&found), &right);
        let notes = &found.notes;
        let is_told = notes.iter().any(|note| note.contains("ten-millionths"));
        assert_eq!(is_told, names == "name,lat,lon", "{notes:?}");
    }
    let links = "name,link\nA,\"https://www.google.com/maps/@-35.3632621,149.1652374,15z\"\n\
                 B,https://www.openstreetmap.org/#map=15/-35.3625/149.166\n";
    assert_at(&landmarks(&read(links)), &right);
    // As well millionths, and more than the globe has.
    for rows in ["A,35363262,149165237\n", "A,-953632621,1491652374\n"] {
        let text = format!("name,lat,lon\n{rows}");
        assert!(read_any("a.csv", text.as_bytes(), None).is_err(), "{rows}");
    }
}
