//! Road maps to be lost over.

use std::path::{Path, PathBuf};

use pilotage_base::frames::{GroundPoint, GroundRect, LocalFrame};
use pilotage_roads::files::read_roads;
use pilotage_roads::{RoadJoining, RoadLine, RoadMap};

/// Distance of views from the edge of a map, metres.
const EDGE: f64 = 450.0;

/// Map of 100 km², and where in it views are.
pub struct Site {
    pub name: String,
    pub map: RoadMap,
    pub within: GroundRect,
}

fn lines(path: &Path) -> Vec<RoadLine> {
    let read = read_roads(&std::fs::read(path).unwrap()).unwrap();
    read.in_world(&LocalFrame::new(read.middle().unwrap()))
}

/// The maps of the folder that `PILOTAGE_ROAD_MAPS` names, and Helsinki in the midst of the one that is called `liege`.
pub fn sites() -> Vec<Site> {
    let Ok(folder) = std::env::var("PILOTAGE_ROAD_MAPS") else {
        println!("skipped: PILOTAGE_ROAD_MAPS names no folder with road maps");
        return Vec::new();
    };
    let files = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<PathBuf> = files.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let mut sites = Vec::new();
    for path in files {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let own = lines(&path);
        if name == "liege" {
            sites.extend(helsinki(&own));
        }
        let map = RoadMap::new(own, RoadJoining::SHARED_POINTS);
        let within = map.bounds().unwrap().grown(-EDGE);
        sites.push(Site { name, map, within });
    }
    sites
}

/// Helsinki's roads, 1.0 km by 1.7 km, in place of those in the middle of another map.
fn helsinki(around: &[RoadLine]) -> Option<Site> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("../../../../shared/data/osm_vectors/Helsinki.osm.pbf");
    if !path.exists() {
        println!("skipped: no shared data (Helsinki)");
        return None;
    }
    let own = lines(&path);
    let extent = |lines: &[RoadLine]| {
        let points = lines.iter().flat_map(|line| line.course.iter().copied());
        GroundRect::around(points).unwrap()
    };
    let (place, whole) = (extent(&own), extent(around));
    let to = whole.center().to_vector() - place.center().to_vector();
    let moved = |p: &GroundPoint| GroundPoint::from(p.to_vector() + to);
    let cleared = GroundRect::centered(whole.center(), place.height() + 40.0, place.width() + 40.0);
    let is_outside = |line: &&RoadLine| !line.course.iter().any(|p| cleared.contains(p));
    let mut all: Vec<RoadLine> = around.iter().filter(is_outside).cloned().collect();
    all.extend(own.iter().map(|line| RoadLine {
        course: line.course.iter().map(moved).collect(),
        ..line.clone()
    }));
    Some(Site {
        name: "helsinki".to_owned(),
        map: RoadMap::new(all, RoadJoining::SHARED_POINTS),
        within: cleared.grown(-220.0),
    })
}
