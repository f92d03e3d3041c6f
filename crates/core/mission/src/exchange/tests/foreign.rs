//! Files of other programs, and landmarks through every format that holds them.

use super::super::{ExchangeError, Format, read_any, write_landmarks, write_route};
use super::{frame, route};
use crate::mission::USUAL_ALTITUDE;
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint, GroundRect};
use pilotage_vision::landmark::Landmark;

fn barn() -> Landmark {
    let mut barn = Landmark::new(
        7,
        "barn <north> & \"co\"",
        GroundRect::centered(GroundPoint::new(300.0, -120.0), 30.0, 44.5),
    );
    barn.reference = GroundPoint::new(295.0, -110.0);
    barn.height = 4.5;
    barn.enabled = false;
    for (name, value) in [
        ("owner", "\"Ann, & \\\"Bob\\\"\""),
        ("roof", "[1,{\"a\":2.5}]"),
    ] {
        barn.properties.insert(name.to_owned(), value.to_owned());
    }
    barn
}

#[test]
fn a_landmark_survives_every_format_that_holds_boxes() {
    for format in [Format::GeoJson, Format::Kml, Format::Kmz, Format::Csv] {
        let written = write_landmarks(format, &[barn()], &frame()).unwrap();
        let back = read_any("x", &written.bytes, Some(frame())).unwrap();
        let (after, before) = (&back.landmarks[0], barn());
        assert!(after.reference.distance(&before.reference) < 1e-4);
        assert!(after.bounds.center().distance(&before.bounds.center()) < 1e-4);
        assert!((after.bounds.width() - before.bounds.width()).abs() < 1e-4);
        assert!((after.bounds.height() - before.bounds.height()).abs() < 1e-4);
        let (reference, bounds) = (before.reference, before.bounds);
        let placed = Landmark {
            bounds,
            reference,
            ..after.clone()
        };
        assert_eq!(placed, before, "{}", format.name());
    }
}

#[test]
fn landmarks_have_no_place_in_a_plan() {
    let error = write_landmarks(Format::Plan, &[barn()], &frame()).unwrap_err();
    assert!(matches!(error, ExchangeError::CannotHold { .. }));
    assert!(error.to_string().contains("GeoJSON, KML or CSV"), "{error}");
}

#[test]
fn numbers_that_are_none_are_missing_and_lose_nothing_else() {
    // As Python's `json` writes a table with gaps.
    let told = r#"{"type": "FeatureCollection", "features": [
 {"type": "Feature", "properties": {"name": "NaN", "score": NaN},
  "geometry": {"type": "Point", "coordinates": [8.5, 47.4, NaN]}},
 {"type": "Feature", "properties": {"name": "b", "score": -Infinity},
  "geometry": {"type": "Point", "coordinates": [8.51, 47.41]}}]}"#;
    let read = read_any("gaps.geojson", told.as_bytes(), None).unwrap();
    let names = read.landmarks.iter().map(|l| l.name.as_str());
    assert_eq!(names.collect::<Vec<_>>(), ["NaN", "b"]);
    let notes = read.notes.join("; ");
    assert!(notes.contains("3 of the numbers are none"), "{notes}");
    let between = told.replace("[8.51, 47.41]", "[8.51, NaN, 47.41]");
    assert!(
        read_any("gaps.geojson", between.as_bytes(), None).is_err(),
        "a height is no latitude"
    );
    let with_a_place = told.replace("[8.51,", "[NaN,");
    let error = read_any("gaps.geojson", with_a_place.as_bytes(), None).unwrap_err();
    assert!(error.to_string().contains("line 4"), "{error}");
}

#[test]
fn places_of_gdal_with_names_may_have_heights() {
    let told = "X,Y,Z,name\n8.542134,47.371256,420.5,church\n8.543181,47.372267,430,bridge\n";
    let read = read_any("places.csv", told.as_bytes(), None).unwrap();
    assert_eq!(read.landmarks.len(), 2);
    let notes = read.notes.join("; ");
    assert!(
        notes.contains("`X` and `Y` are taken for longitude"),
        "{notes}"
    );
    // Without a name they may be metres of a track.
    let told = told.replace(",name", ",q");
    assert!(read_any("places.csv", told.as_bytes(), None).is_err());
}

const KML: &str = r##"<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2"><Document><name>Trip</name>
 <Folder><Placemark><name>Line &amp; bend</name><styleUrl>#nowhere</styleUrl><description><![CDATA[<b>bold</b>]]></description>
   <gx:Undeclared>1</gx:Undeclared>
   <LineString><altitudeMode>absolute</altitudeMode><coordinates>
     8.5,47.4,510 8.51,47.41,520
     8.52,47.41,530 </coordinates></LineString></Placemark>
  <Placemark><Point><coordinates>8.5,47.4</coordinates></Point></Placemark>
  <Placemark><name>Field</name><ExtendedData><Data name="crop"><value>wheat</value></Data>
   <SchemaData schemaUrl="#s"><SimpleData name="area">12.5</SimpleData></SchemaData></ExtendedData>
   <MultiGeometry><Polygon><outerBoundaryIs><LinearRing><coordinates>8.5,47.4,0 8.501,47.4,0 8.501,47.401,0 8.5,47.4,0</coordinates></LinearRing></outerBoundaryIs></Polygon></MultiGeometry></Placemark>
  <Placemark><name>nothing</name></Placemark>
 </Folder></Document></kml>"##;

#[test]
fn a_kml_without_its_styles_is_read_and_what_is_not_known_is_kept() {
    let back = read_any("trip.kml", KML.as_bytes(), Some(frame())).unwrap();
    assert_eq!(back.routes.len(), 1);
    let line = &back.routes[0];
    assert_eq!(line.name, "Line & bend");
    assert_eq!(
        line.way_points[2].altitude,
        Altitude::new(530.0, AltitudeFrame::Amsl)
    );
    let names: Vec<_> = back.landmarks.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names, ["Landmark 1", "Field"]);
    assert_eq!(back.landmarks[0].bounds.width(), 20.0);
    assert_eq!(back.landmarks[1].properties["crop"], "\"wheat\"");
    assert_eq!(back.landmarks[1].properties["area"], "\"12.5\"");
    assert!((back.landmarks[1].bounds.width() - 75.5).abs() < 0.2);
    let told = |words: &str| back.notes.iter().any(|n| n.contains(words));
    assert!(told("1 × placemark without geometry"), "{:#?}", back.notes);
    assert!(told("box of 20 m"), "{:#?}", back.notes);
    assert!(told("style `nowhere` is missing"), "{:#?}", back.notes);
    let written = write_route(Format::Kml, line, &frame()).unwrap();
    let text = String::from_utf8(written.bytes).unwrap();
    for kept in ["<styleUrl>#nowhere</styleUrl>", "<![CDATA[<b>bold</b>]]>"] {
        assert!(text.contains(kept), "{text}");
    }
}

#[test]
fn a_line_that_was_moved_in_another_program_keeps_its_new_place() {
    let written = write_route(Format::Kml, &route(), &frame()).unwrap();
    let text = String::from_utf8(written.bytes).unwrap();
    let begin = text.find("<coordinates>").unwrap() + "<coordinates>".len();
    let end = text.find("</coordinates>").unwrap();
    let moved = format!("{}8.5,47.4 8.6,47.4{}", &text[..begin], &text[end..]);
    let back = read_any("x.kml", moved.as_bytes(), Some(frame())).unwrap();
    assert_eq!(back.routes[0].way_points.len(), 2);
    assert_eq!(back.routes[0].way_points[1].altitude, USUAL_ALTITUDE);
    assert!(back.notes.iter().any(|n| n.contains("changed elsewhere")));
}

#[test]
fn what_is_wrong_in_xml_is_told_with_its_place() {
    let told = |text: &str| {
        read_any("a.kml", text.as_bytes(), None)
            .unwrap_err()
            .to_string()
    };
    let message = told(&KML.replace("8.5,47.4</c", "8.5;47.4</c"));
    assert!(
        message.starts_with("a.kml, line 8, column 21: Placemark/Point/coordinates: `8.5;47.4`"),
        "{message}"
    );
    let message = told(&KML[..KML.len() - 20]);
    assert!(message.starts_with("a.kml, line 13"), "{message}");
    let message = told("<kml><a></b></kml>");
    assert!(message.starts_with("a.kml, line 1, column"), "{message}");
    let message = told("<kml></kml>");
    assert!(
        message.contains("neither a route nor a landmark"),
        "{message}"
    );
    assert!(
        read_any("a.bin", &[0, 1, 2], None)
            .unwrap_err()
            .to_string()
            .contains("known are")
    );
}

#[test]
fn coordinates_of_a_kml_with_more_numbers_than_three_are_refused() {
    let of = |coordinates: &str| {
        let text = format!(
            "<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Placemark><LineString><coordinates>{coordinates}</coordinates>\
             </LineString></Placemark></kml>"
        );
        read_any("a.kml", text.as_bytes(), None)
    };
    // Decimal commas, a semicolon between places, and none at all.
    for wrong in [
        "8,5,47,3 8,6,47,4",
        "8.5,47.3,500;8.6,47.4,510",
        "8.5,47.3,08.6,47.4,0",
    ] {
        let told = of(wrong).unwrap_err().to_string();
        assert!(
            told.contains("line 1") && told.contains("longitude,latitude,altitude"),
            "{told}"
        );
    }
    for right in [
        "8.5,47.3 8.6,47.4",
        "8.5,47.3, 8.6,47.4,",
        "8.5,47.3,nan 8.6,47.4,0,",
        "8.5 , 47.3 , 0 8.6,47.4,0",
    ] {
        assert_eq!(of(right).unwrap().routes[0].way_points.len(), 2, "{right}");
    }
}

#[test]
fn routes_tracks_and_points_of_a_gpx_are_read() {
    let text = r#"<?xml version="1.0"?><gpx version="1.1" xsi:schemaLocation="x">
      <wpt lat="47.4" lon="8.5"><name>Tower</name><sym>Flag</sym></wpt>
      <rte><name>R</name><rtept lat="47.4" lon="8.5"><ele>500</ele><name>one</name></rtept><rtept lat="47.41" lon="8.5"/></rte>
      <trk><name>T</name><trkseg><trkpt lat="47.4" lon="8.5"><ele>510.5</ele></trkpt></trkseg><trkseg/></trk></gpx>"#;
    let back = read_any("x.gpx", text.as_bytes(), None).unwrap();
    let names: Vec<_> = back.routes.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(names, ["R", "T"]);
    assert_eq!(
        back.routes[1].way_points[0].altitude,
        Altitude::new(510.5, AltitudeFrame::Amsl)
    );
    assert_eq!(back.routes[0].way_points[0].properties["name"], "\"one\"");
    assert_eq!(back.landmarks[0].properties["sym"], "\"Flag\"");
    assert!(back.notes.iter().any(|n| n.contains("without elevation")));
}

#[test]
fn lines_and_points_of_somebody_elses_geojson_are_routes_and_landmarks() {
    let text = r#"{ "type": "FeatureCollection", "features": [
        { "type": "Feature", "id": 4, "properties": { "name": "creek", "id": "way/9" },
          "geometry": { "type": "LineString", "coordinates": [[8.5, 47.4], [8.51, 47.4]] } },
        { "type": "Feature", "properties": { "id": "node/1" },
          "geometry": { "type": "Polygon", "coordinates": [[[8.5, 47.4], [8.501, 47.4], [8.501, 47.401]]] } },
        { "type": "Feature", "properties": null, "geometry": { "type": "Point", "coordinates": [8.5, 47.4, 12] } },
        { "type": "Feature", "properties": {}, "geometry": null } ] }"#;
    let back = read_any("x.geojson", text.as_bytes(), None).unwrap();
    assert_eq!(back.routes[0].name, "creek");
    assert_eq!(back.routes[0].properties["id_in_file"], "\"way/9\"");
    assert_eq!(back.landmarks.len(), 2);
    assert!(
        back.notes
            .iter()
            .any(|n| n.contains("1 features are neither"))
    );
    let bare = r#"{ "type": "LineString", "coordinates": [[8.5, 47.4, 500], [8.51, 47.4, 510]] }"#;
    let back = read_any("x.json", bare.as_bytes(), None).unwrap();
    assert_eq!(
        back.routes[0].way_points[1].altitude,
        Altitude::new(510.0, AltitudeFrame::Amsl)
    );
}

#[test]
fn a_name_that_is_a_number_is_a_name_and_what_is_none_is_kept() {
    let text = r#"{ "type": "FeatureCollection", "features": [
        { "type": "Feature", "properties": { "name": 12 }, "geometry": { "type": "Point", "coordinates": [8.5, 47.4] } },
        { "type": "Feature", "properties": { "name": ["a", "b"], "title": 7.5 },
          "geometry": { "type": "Point", "coordinates": [8.5, 47.41] } },
        { "type": "Feature", "properties": { "name": null }, "geometry": { "type": "Point", "coordinates": [8.5, 47.42] } } ] }"#;
    let back = read_any("x.geojson", text.as_bytes(), None).unwrap();
    let names: Vec<_> = back.landmarks.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names[..2], ["12", "7.5"]);
    assert!(!back.landmarks[0].properties.contains_key("name_in_file"));
    assert_eq!(back.landmarks[1].properties["name_in_file"], r#"["a","b"]"#);
    assert!(!back.landmarks[2].properties.contains_key("name_in_file"));
}

#[test]
fn a_geometry_without_coordinates_is_left_out_and_told() {
    let text = r#"{ "type": "FeatureCollection", "features": [
        { "type": "Feature", "properties": {}, "geometry": { "type": "LineString", "coordinates": [] } },
        { "type": "Feature", "properties": {}, "geometry": { "type": "Point", "coordinates": [] } },
        { "type": "Feature", "properties": {}, "geometry": { "type": "Point", "coordinates": [8.5, 47.4] } } ] }"#;
    let back = read_any("x.geojson", text.as_bytes(), None).unwrap();
    assert_eq!((back.routes.len(), back.landmarks.len()), (0, 1));
    let told = "2 of the geometries have no coordinates";
    assert!(
        back.notes.iter().any(|n| n.contains(told)),
        "{:?}",
        back.notes
    );
}

#[test]
fn a_table_of_anybody_is_read_by_its_header() {
    let text =
        "Name;Lat;Lon;Alt AGL (ft);Speed [kt];pilot\nA;47,4;8,5;400;30;Ann\nB;47,41;8,5;500;;\n";
    let back = read_any("x.csv", text.as_bytes(), None).unwrap();
    let way_points = &back.routes[0].way_points;
    assert_eq!(way_points[0].altitude.frame, AltitudeFrame::AboveGround);
    assert!((way_points[0].altitude.metres - 121.92).abs() < 1e-9);
    assert!((way_points[0].speed.unwrap() - 15.433_333).abs() < 1e-5);
    assert_eq!(way_points[0].properties["pilot"], "\"Ann\"");
    assert_eq!(way_points[1].speed, None);
    let text = "title,latitude,longitude,colour\nTower,47.4,8.5,red\n";
    let back = read_any("x.csv", text.as_bytes(), None).unwrap();
    assert_eq!(back.landmarks[0].name, "Tower");
    assert_eq!(back.landmarks[0].properties["colour"], "\"red\"");
    let told = |text: &str| {
        read_any("x.csv", text.as_bytes(), None)
            .unwrap_err()
            .to_string()
    };
    let message = told("name,lat,lon\nTower,47.4,east\n");
    assert_eq!(
        message,
        "x.csv, line 2, column 1: column `lon`: `east` is no number"
    );
    let message = told("name,north,east\nTower,1,2\n");
    assert!(
        message.contains("no column for the latitude; there are: name, north, east"),
        "{message}"
    );
}

#[test]
fn hemispheres_in_columns_of_their_own_or_at_the_numbers_are_heeded() {
    for text in [
        "name,latitude,N/S,longitude,E/W\nWell,33.85,S,18.42,W\n",
        "name,latitude,longitude\nWell,33.85S,18.42 W\n",
        "name,lat,lon\nWell,S33 51 00,W18 25 12\n",
        "name;lat;lon\nWell;-33,85;-18,42\n",
        "name,lat,lat_ns,lon,lon_ew\nWell,33.85,S,18.42,W\n",
        "name,lat,north_south,lon,east_west\nWell,33.85,S,18.42,W\n",
        "Name,GPSLatitude,GPSLatitudeRef,GPSLongitude,GPSLongitudeRef\nWell,33.85,S,18.42,W\n",
        // Known by their cells.
        "name,lat,lat_hem,lon,lon_hem\nWell,33.85,S,18.42,W\n",
        "name,lat,hemi,lon,hemi2\nWell,33.85,s,18.42,w\n",
        "name,lat,,lon,\nWell,33.85,S,18.42,W\n",
        "name,lat,lon,h1,h2\nWell,33.85,18.42,South,West\n",
        "name,lat,lon_ind,lon\nWell,-33.85,W,18.42\n",
    ] {
        let back = read_any("x.csv", text.as_bytes(), None).unwrap();
        let origin = back.frame.origin;
        assert!(
            (origin.latitude.to_degrees() + 33.85).abs() < 1e-9,
            "{text}"
        );
        assert!(
            (origin.longitude.to_degrees() + 18.42).abs() < 1e-9,
            "{text}"
        );
    }
    // German and Romance words and letters.
    for text in [
        "Name;Breite;Länge\nBrunnen;33,85° S;18,42° W\n",
        "nom;latitude;longitude\nPuits;33°51'00\"S;18°25'12\"O\n",
        "Nombre;Latitud;Longitud\nPozo;33,85 S;18,42 O\n",
        "name,lat,lon\nWell,33.85 S,18.42 O\nOther,33.85 S,18.42 O\nEast,33.85 S,0.0 E\n",
        "name,lat,NS,lon,EW\nWell,33.85,Sud,18.42,Ouest\n",
        "nom,lat,lat_h,lon,lon_h\nPuits,33.85,S,18.42,O\n",
    ] {
        let back = read_any("x.csv", text.as_bytes(), None).unwrap();
        let first = back
            .frame
            .geodetic_from_ground(&back.landmarks[0].reference);
        let (latitude, longitude) = (first.latitude.to_degrees(), first.longitude.to_degrees());
        assert!((latitude + 33.85).abs() < 1e-9, "{text}: {latitude}");
        assert!((longitude + 18.42).abs() < 1e-9, "{text}: {longitude}");
    }
    let east = "Name;Breite;Länge\nBrunnen;33°51'00\"S;18°25'12\"O\n";
    let back = read_any("x.csv", east.as_bytes(), None).unwrap();
    assert!((back.frame.origin.longitude.to_degrees() - 18.42).abs() < 1e-9);
    let either = "name,lat,lon\nWell,33.85 S,18.42 O\n";
    let error = read_any("x.csv", either.as_bytes(), None).unwrap_err();
    assert!(
        error.to_string().contains("east (Ost) or west (Ouest"),
        "{error}"
    );
    // Which way something faces is no hemisphere.
    let facing = "name,lat,lon,facing\nWell,33.85,18.42,S\n";
    let back = read_any("x.csv", facing.as_bytes(), None).unwrap();
    assert!((back.frame.origin.latitude.to_degrees() - 33.85).abs() < 1e-9);
    let wrong = "name,latitude,N/S,longitude,E/W\nWell,33.85,up,18.42,W\n";
    let error = read_any("x.csv", wrong.as_bytes(), None)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("line 2") && error.contains("neither N nor S"),
        "{error}"
    );
}

#[test]
fn altitudes_of_litchi_count_from_what_their_mode_says_and_no_speed_is_the_cruise() {
    let text = "latitude,longitude,altitude(m),heading(deg),altitudemode,speed(m/s)\n\
                47.0,8.0,30,0,1,0\n47.001,8.0,30,0,0,4.5\n";
    let back = read_any("x.csv", text.as_bytes(), None).unwrap();
    let way_points = &back.routes[0].way_points;
    let frames: Vec<_> = way_points.iter().map(|w| w.altitude.frame).collect();
    assert_eq!(
        frames,
        [AltitudeFrame::AboveGround, AltitudeFrame::AboveTakeOff]
    );
    let speeds: Vec<_> = way_points.iter().map(|w| w.speed).collect();
    assert_eq!(speeds, [None, Some(4.5)]);
}

#[test]
fn tables_in_utf_16_are_read() {
    let text = "name\tlatitude\tlongitude\nZürich\t47.5\t8.5\n";
    for (mark, to_bytes) in [
        ([0xff, 0xfe], u16::to_le_bytes as fn(u16) -> [u8; 2]),
        ([0xfe, 0xff], u16::to_be_bytes),
    ] {
        let bytes = text.encode_utf16().flat_map(to_bytes);
        let bytes: Vec<u8> = mark.into_iter().chain(bytes).collect();
        let back = read_any("x.csv", &bytes, None).unwrap();
        assert_eq!(back.landmarks[0].name, "Zürich");
    }
}
