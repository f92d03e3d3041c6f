//! Words near the beginning of a text that tell what it is, one kind a line.

use super::kind::{
    CONVERT, FLIGHT_PLAN, Foreign, LABELS, LOG, MODEL, ROADS, TO_CSV, TO_GEOJSON, kind,
};

const NMEA: &str = "no two places could be read in them: they need GGA or RMC with a fix";
const PAGE: &str = "what was downloaded is a page about the file, not the file: download it again";
const POINTS: &str =
    "control points or places of photos, as OpenDroneMap has them (gcp_list.txt, geo.txt)";
const POINTS_ADVICE: &str = "make a CSV of it with the columns name, latitude and longitude, or name, easting, northing and zone, and open that";
const MADE_OF_TLOG: &str =
    "telemetry that Mission Planner wrote as text, with a name before each value";
const PRINTED: &str = "messages of an autopilot as pymavlink prints them";
const PLACES: &str =
    "write its places into a CSV with the columns latitude, longitude and altitude and open that";
const PLACES_IN_TIME: &str = "write its rows into a CSV with the columns time, latitude, longitude and altitude and open that";
const UGCS: &str = "export it as KML or CSV in UgCS and open that in Plan";
const AIRSPACE: &str = "make KML or GeoJSON of them and open that";
const TLOG: &str = "open the .tlog of which it was made";
const PHOTOS: &str = "open the folder of the photos themselves";
pub(super) const PARAMETERS: &str =
    "settings tell of no flight: open its log, in which they stand as well";

const fn word(
    word: &'static str,
    what: &'static str,
    advice: &'static str,
) -> (&'static str, Foreign) {
    (word, kind(what, advice))
}

/// Words in small letters, in the order in which they are tried; a line break before one says that a line begins so.
#[rustfmt::skip]
const WORDS: &[(&str, Foreign)] = &[
    word(" --> 0", "the subtitles of a film, as DJI writes them beside it (.SRT)", "no place and time could be read in it"),
    word("rinex version", "observations of a satellite receiver (RINEX)", "compute positions of them (RTKLIB) and open those as CSV"),
    word("\n$gp", "sentences of a satellite receiver (NMEA)", NMEA),
    word("\n$gn", "sentences of a satellite receiver (NMEA)", NMEA),
    word(" {time_boot_ms : ", PRINTED, "open the .tlog or the dataflash log of which it was printed"),
    word(" {timeus : ", PRINTED, "open the .tlog or the dataflash log of which it was printed"),
    word("filetype=text/acmi", "a recording of Tacview (.acmi)", "export its flight as CSV in Tacview and open that"),
    word(";vgx:", "what a Tello said of itself, without a place and without a clock", LOG),
    word(",mavlink_heartbeat_t,", MADE_OF_TLOG, TLOG),
    word(",mavlink_attitude_t,", MADE_OF_TLOG, TLOG),
    word(",mavlink_vfr_hud_t,", MADE_OF_TLOG, TLOG),
    word(",ellh\t", "the times and places of photos, as a receiver of DJI with corrections has them (…_Timestamp.MRK)", PHOTOS),
    word("\n#bestposa,", "messages of a receiver of NovAtel (ASCII)", PLACES),
    word("\n#inspvaa,", "messages of a receiver of NovAtel (ASCII)", PLACES),
    word("\nepsg:", POINTS, CONVERT),
    word("\n+proj=", POINTS, CONVERT),
    word("\nwgs84 utm", POINTS, CONVERT),
    word("\nname,code,country,lat,lon", "places and tasks of SeeYou (.cup)", CONVERT),
    word("\nimagename x y z omega phi kappa", "the places of cameras that Pix4D computed", POINTS_ADVICE),
    word("\n# coordinatesystem:", "a reference table of Metashape", CONVERT),
    word("\n# image list with two lines of data per image", "the places of cameras that COLMAP computed, in metres of its own", PHOTOS),
    word("\n# camera list with one line of data per camera", "the lenses of COLMAP", PHOTOS),
    word("<cameras next_id=", "the cameras of a project of Metashape (XML)", PHOTOS),
    word("\n$col,imu", "what the sensors of a FlySight measured, at times of its own clock", "open the TRACK.CSV beside it"),
    word("\n1100 version", "a flight plan of X-Plane (.fms)", FLIGHT_PLAN),
    word("\n3 version", "a flight plan of X-Plane (.fms)", FLIGHT_PLAN),
    word("\ng  wgs 84", "places or tracks of CompeGPS", "make a GPX of it (gpsbabel -i compegps) and open that"),
    word("<marker id=\"", "control points of Metashape (XML)", "export them there as CSV and open that in Plan"),
    word("<mission missiontimelmt", "a mission of DJI's Ground Station (.awm)", PLACES),
    word("\ncoordsys earth", "features of MapInfo (.mif)", TO_GEOJSON),
    word("<rss", "news with places (GeoRSS)", TO_GEOJSON),
    word("\nhfdte", "a glider's flight record (IGC)", "no two fixes could be read in it"),
    word("\nh product:blackbox", "a blackbox log of Betaflight, INAV or Cleanflight", "make a table of it (`blackbox_decode file`) and open the CSV"),
    word("\n# betaflight /", "settings of Betaflight (a dump of its terminal)", PARAMETERS),
    word("\n# inav/", "settings of INAV (a dump of its terminal)", PARAMETERS),
    word("\n# inav /", "settings of INAV (a dump of its terminal)", PARAMETERS),
    word("\n# onboard parameters", "parameters of an autopilot, as QGroundControl saves them (.params)", PARAMETERS),
    word("\n# vehicle-id component-id name value type", "parameters of an autopilot, as QGroundControl saves them (.params)", PARAMETERS),
    word("\narducopter v2", "a text log of ArduPilot from before 2013, whose lines nothing in it explains", "open it in a Mission Planner of that time, save it as GPX or KML, and open that"),
    word("\narduplane v2", "a text log of ArduPilot from before 2013, whose lines nothing in it explains", "open it in a Mission Planner of that time, save it as GPX or KML, and open that"),
    word("\nrally\t", "rally points of ArduPilot (.ral)", CONVERT),
    word("\n#saved by apm planner", "a fence of ArduPilot, as Mission Planner saves it (.fen)", CONVERT),
    word("\noziexplorer map data", "where a picture lies, as OziExplorer has it (.map)", "make a GeoTIFF of it (`gdal_translate`) and open that"),
    word("\n!table", "a table of MapInfo (.tab)", "make a GeoTIFF of its picture (`gdal_translate`), or GeoJSON of its features (`ogr2ogr`), and open that"),
    word("\noziexplorer track", "a track of OziExplorer (.plt)", "no two points with a time could be read in it"),
    word("\noziexplorer waypoint", "way-points of OziExplorer (.wpt)", CONVERT),
    word("\noziexplorer ", "places or tracks of OziExplorer", "make a GPX of it (gpsbabel -i ozi) and open that"),
    word("\nbyteorder ", "the header of a grid of bare samples (.hdr)", "make a GeoTIFF of the grid beside it (`gdal_translate`) and open that"),
    word("\nbyteorder\t", "the header of a grid of bare samples (.hdr)", "make a GeoTIFF of the grid beside it (`gdal_translate`) and open that"),
    word("\nncols ", "a grid of heights as text (Esri ASCII, .asc)", "open it as .asc beside a map or a flight, or look at it with `pilotage map info`"),
    word("\ngeogcs[", "the reference system of a map (.prj)", "open the map beside which it lies"),
    word("\nprojcs[", "the reference system of a map (.prj)", "open the map beside which it lies"),
    word("\nmtllib ", "a model (OBJ)", MODEL),
    word("<missionitem", "a mission of INAV or Multiwii (.mission, XML)", CONVERT),
    word("<trainingcenterdatabase", "an activity of Garmin (TCX)", "no two points with a time and a place could be read in it"),
    word("<flight-plan", "a flight plan of Garmin (.fpl)", FLIGHT_PLAN),
    word("<divelementsflightplanner", "a flight plan of SkyDemon (.flightplan)", FLIGHT_PLAN),
    word("<simbase.document", "a flight plan of a simulator (.pln)", FLIGHT_PLAN),
    word("<littlenavmap", "a flight plan of Little Navmap (.lnmpln)", CONVERT),
    word("<flight_plan", "a flight plan of Paparazzi (XML)", PLACES),
    word("<loc ", "places of a geocache (.loc)", "make a GPX of it (gpsbabel -i geo) and open that"),
    word("\nal fl", "airspaces (OpenAir)", AIRSPACE),
    word("\nah fl", "airspaces (OpenAir)", AIRSPACE),
    word("\ntype=airspace", "airspaces (TNP, .sua)", AIRSPACE),
    word("<openaip", "airspaces of openAIP (.aip)", AIRSPACE),
    word("aixmbasicmessage", "airspaces (AIXM)", AIRSPACE),
    word("\nnc: ", "the classes of a data set of YOLO (data.yaml)", LABELS),
    word("<annotations>", "labels of CVAT (XML)", LABELS),
    word("<osmchange", "changes of OpenStreetMap (.osc)", "apply them to a road map (`osmium apply-changes`) and import that: `pilotage roads import`"),
    word("0\nsection\n", "a drawing (DXF)", TO_GEOJSON),
    word("0\r\nsection\r\n", "a drawing (DXF)", TO_GEOJSON),
    word("\nac ctr", "airspaces (OpenAir)", AIRSPACE),
    word("\nal sfc", "airspaces (OpenAir)", AIRSPACE),
    word("\nal gnd", "airspaces (OpenAir)", AIRSPACE),
    word("\"horizontalprojection\"", "zones of unmanned aircraft (ED-269)", AIRSPACE),
    word("\"progressive_course_activated\"", "a flight plan of Parrot's FreeFlight", PLACES),
    word("<gpx", "a GPX file", CONVERT),
    word("<kml", "a KML file", CONVERT),
    word("<osm ", "a road map of OpenStreetMap", ROADS),
    word("<qgis", "a project or style of QGIS", TO_GEOJSON),
    word("<!doctype plist", "a list of settings of macOS (plist)", LOG),
    word("<!doctype html", "a web page", PAGE),
    word("<html", "a web page", PAGE),
    word("<svg", "a drawing (SVG)", "save it as PNG and open that as a map, with a world file beside it"),
    word("<vrtdataset", "a map made of others (GDAL's VRT)", "make a GeoTIFF of it (`gdal_translate`) and open that"),
    word("<gml", "features of GML", TO_GEOJSON),
    word("<wfs:featurecollection", "features of GML", TO_GEOJSON),
    word("\nbegin:vcalendar", "a calendar", LOG),
    word("\nbegin:vcard", "addresses", LOG),
];

/// Members of JSON without blanks, in small letters; `^` before one says that the text begins so.
#[rustfmt::skip]
const MEMBERS: &[(&str, Foreign)] = &[
    word("\"type\":\"topology\"", "TopoJSON", "save it as GeoJSON (mapshaper, `topo2geo`) and open that"),
    word("\"geometrytype\":\"esri", "the JSON of ArcGIS", "ask for f=geojson, or save it as GeoJSON (`ogr2ogr`), and open that"),
    word("\"filetype\":\"plan\"", "a plan of QGroundControl", CONVERT),
    word("\"filetype\":\"mission\"", "an old mission of QGroundControl", CONVERT),
    word("\"mav_autopilot\"", "an old mission of QGroundControl", CONVERT),
    word("\"icaoclass\":", "airspaces of openAIP (JSON)", AIRSPACE),
    word("\"generator\":\"overpassapi", "a road map of OpenStreetMap (JSON of Overpass)", "ask for XML (`[out:xml]`) and import that: `pilotage roads import`"),
    word("\"shape_type\":", "labels of labelme", LABELS),
    word("\"_via_settings\"", "labels of VIA", LABELS),
    word("\"shape_attributes\":", "labels of VIA", LABELS),
    word("\"coordinates\":{\"x\":", "labels of CreateML", LABELS),
    word("^[{\"image_id\":", "detections for a data set of COCO", "open the data set itself, whose labels are read"),
    word("\"type\":\"traversealgorithm\"", "a route of UgCS (JSON)", UGCS),
    word("\"type\":\"areascanalgorithm\"", "a route of UgCS (JSON)", UGCS),
    word("\"details_headers\":", "a flight of Parrot's FreeFlight (JSON)", PLACES_IN_TIME),
    word("\"flight_logging_items\":", "a flight record of GUTMA (JSON, also of Parrot)", PLACES_IN_TIME),
    word("\"turnpoints\":[", "a task of XCTrack (.xctsk)", PLACES),
    word("\"segments\":[{\"type\":\"waypoint\"", "a route of UgCS (JSON)", UGCS),
    word("\"type\":\"featurecollection\"", "GeoJSON", CONVERT),
    word("^{\"type\":\"feature\"", "GeoJSON", CONVERT),
    word("^{\"type\":\"point\"", "GeoJSON", CONVERT),
    word("^{\"type\":\"linestring\"", "GeoJSON", CONVERT),
    word("^{\"type\":\"polygon\"", "GeoJSON", CONVERT),
    word("^{\"type\":\"multi", "GeoJSON", CONVERT),
    word("^{\"type\":\"geometrycollection\"", "GeoJSON", CONVERT),
    word("^{\"coordinates\":[", "GeoJSON", CONVERT),
    word("\"cells\":[", "a notebook of Jupyter", TO_CSV),
    word("\"asset\":{\"", "a model (glTF)", MODEL),
];

/// Kind of a text in small letters.
pub(super) fn of(text: &str) -> Option<Foreign> {
    // A sequence of JSON may begin with its separator.
    let text = text.trim_start_matches(['\u{feff}', '\u{1e}']);
    let is_there = |word: &str| match word.strip_prefix('\n') {
        Some(begin) => text.lines().any(|line| {
            line.trim_start_matches(['\u{feff}', ' '])
                .starts_with(begin)
        }),
        None => text.contains(word),
    };
    let found = WORDS.iter().find(|(word, _)| is_there(word));
    if found.is_some() || !text.trim_start().starts_with(['{', '[']) {
        return found.map(|(_, is)| *is);
    }
    let bare: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let is_there = |member: &str| match member.strip_prefix('^') {
        Some(begin) => bare.starts_with(begin),
        None => bare.contains(member),
    };
    let found = MEMBERS.iter().find(|(member, _)| is_there(member));
    // Files of our own have words of their own where they cannot be read.
    let is_own = bare.contains("\"pilotage");
    let is_json = ["{\"", "[{\"", "[["]
        .iter()
        .any(|begin| bare.starts_with(begin));
    let of_any = (is_json && !is_own).then(|| kind("JSON of no kind that is known here", TO_CSV));
    found.map(|(_, is)| *is).or(of_any)
}

#[cfg(test)]
mod tests {
    use super::of;

    #[test]
    fn routes_and_flights_of_other_programs_are_called_by_these() {
        for (text, program) in [
            (
                "{ \"route\": { \"segments\": [ { \"type\": \"traversealgorithm\" } ] } }",
                "UgCS",
            ),
            (
                "{\"details_headers\":[\"time\"],\"details_data\":[]}",
                "FreeFlight",
            ),
            ("{\"flight_logging_items\": [[0.1]]}", "GUTMA"),
            ("{\"tasktype\":\"classic\",\"turnpoints\":[]}", "XCTrack"),
            (
                "<?xml?>\n<mission missiontimelmt=\"65535\">",
                "Ground Station",
            ),
            (
                "<document><chunk><markers><marker id=\"0\" label=\"a\">",
                "Metashape",
            ),
            ("version 300\ncoordsys earth projection 1, 104\n", "MapInfo"),
        ] {
            assert!(of(text).unwrap().what.contains(program), "{program}");
        }
    }

    #[test]
    fn tables_of_photogrammetry_are_called_by_the_program_that_writes_them() {
        for (text, program) in [
            (
                "epsg:32632\n465429.7 5246517.2 430 100 200 dji_1.jpg gcp1\n",
                "OpenDroneMap",
            ),
            (
                "+proj=utm +zone=32\n465429.7 5246517.2 430\n",
                "OpenDroneMap",
            ),
            (
                "imagename x y z omega phi kappa\ndji_1.jpg 1 2 3 4 5 6\n",
                "Pix4D",
            ),
            (
                "# coordinatesystem: wgs 84\n#label,x/longitude,y/latitude\n",
                "Metashape",
            ),
            ("# image list with two lines of data per image:\n", "COLMAP"),
        ] {
            let found = of(text).unwrap();
            assert!(found.what.contains(program), "{text}: {}", found.what);
        }
        assert!(of("name,note\na,see epsg:4326\n").is_none());
    }

    #[test]
    fn airspaces_labels_and_maps_of_others_are_called_by_their_names() {
        for (text, name) in [
            ("ac w\nan wave north\nal fl100\nah fl195\n", "OpenAir"),
            ("# tnp\ninclude=yes\ntype=airspace\n", "TNP"),
            ("<?xml version=\"1.0\"?><openaip version=\"1\">", "openAIP"),
            ("<message:aixmbasicmessage xmlns:message=\"x\"/>", "AIXM"),
            ("[{\"_id\": \"a\", \"icaoclass\": 3}]", "openAIP"),
            (
                "{\"version\": 0.6, \"generator\": \"overpass api\"}",
                "Overpass",
            ),
            ("<osmchange version=\"0.6\">", "changes of OpenStreetMap"),
            ("  0\r\nsection\r\n  2\r\nheader\r\n", "DXF"),
            (
                "{\"shapes\": [{\"label\": \"a\", \"shape_type\": \"rectangle\"}]}",
                "labelme",
            ),
            (
                "{\"a.jpg1\": {\"regions\": [{\"shape_attributes\": {}}]}}",
                "VIA",
            ),
            (
                "[{\"image\": \"a.jpg\", \"annotations\": [{\"label\": \"a\", \"coordinates\": {\"x\": 1}}]}]",
                "CreateML",
            ),
            (
                "[{\"image_id\": 1, \"category_id\": 1, \"score\": 0.9}]",
                "COCO",
            ),
            ("<annotations><version>1.1</version></annotations>", "CVAT"),
            ("train: a\nnc: 2\nnames: [a, b]\n", "YOLO"),
            (
                "{\"route\": {\"name\": \"r\", \"segments\": [{\"type\": \"waypoint\"}]}}",
                "UgCS",
            ),
        ] {
            let found = of(text).map_or("", |is| is.what);
            assert!(found.contains(name), "{text}: {found}");
        }
        for text in [
            "{\"type\": \"linestring\", \"coordinates\": [[8.5, 47.4]]}",
            "{\"coordinates\": [8.5, 47.4], \"type\": \"point\"}",
            "\u{1e}{\"type\": \"feature\", \"geometry\": null}\n\u{1e}{\"type\": \"feature\"}\n",
        ] {
            assert_eq!(of(text).map(|is| is.what), Some("GeoJSON"), "{text}");
        }
    }
}
