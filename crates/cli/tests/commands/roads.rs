//! `pilotage roads` as a user calls it.

use pilotage_core::mission::read_mission;

use super::folder::Folder;

const OSM: &str = r#"<osm version="0.6">
 <node id="1" lat="60.1700" lon="24.9400"/><node id="2" lat="60.1710" lon="24.9400"/>
 <node id="3" lat="60.1720" lon="24.9400"/><node id="4" lat="60.1710" lon="24.9420"/>
 <way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><tag k="highway" v="secondary"/><tag k="name" v="Quay"/></way>
 <way id="2"><nd ref="2"/><nd ref="4"/><tag k="highway" v="footway"/></way>
</osm>"#;

#[test]
fn roads_of_openstreetmap_are_printed_imported_exported_and_compared() {
    let folder = Folder::new("roads");
    folder.write("town.osm", OSM);
    let said = |words: &[&str]| folder.run(&[&["roads"], words].concat());
    let printed = said(&["print", "town.osm"]).unwrap();
    assert!(
        printed.contains("4 nodes, 3 edges, 1 crossings, 0.33"),
        "{printed}"
    );
    let import = [
        "import",
        "town.osm",
        "--mission",
        "m.geojson",
        "--least",
        "service",
    ];
    said(&import).unwrap();
    let mission = read_mission(&std::fs::read(folder.0.join("m.geojson")).unwrap()).unwrap();
    assert_eq!(mission.roads.len(), 1);
    assert_eq!(mission.roads[0].name, "Quay");
    said(&["export", "town.osm", "--out", "again.geojson"]).unwrap();
    let same = said(&["apls", "town.osm", "again.geojson"]).unwrap();
    assert!(same.starts_with("APLS 1.0000"), "{same}");
    let less = said(&["apls", "town.osm", "m.geojson"]).unwrap();
    assert!(less.starts_with("APLS 0."), "{less}");
    let refused = said(&["print", "nowhere.osm"]).unwrap_err();
    assert!(refused.contains("nowhere.osm"), "{refused}");
}
