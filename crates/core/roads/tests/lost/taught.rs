//! Views of real road maps with errors as stated, good and bad ones, for teaching the weights.

use std::fmt::Write;

use pilotage_base::frames::LocalFrame;
use pilotage_roads::lost::{LostSettings, RoadIndex};
use pilotage_roads::{RoadClass, RoadJoining, RoadMap};

use super::drawn::{Draw, SeeingErrors, Source, drawn_view};
use super::{USUAL, is_right};

/// Maps of the folder that `PILOTAGE_ROAD_MAPS` names, of those that `PILOTAGE_LOST_MAPS` lists.
fn maps() -> Vec<(String, Source)> {
    let Ok(folder) = std::env::var("PILOTAGE_ROAD_MAPS") else {
        println!("skipped: PILOTAGE_ROAD_MAPS names no folder with road maps");
        return Vec::new();
    };
    let listed = std::env::var("PILOTAGE_LOST_MAPS").unwrap_or_default();
    let mut maps = Vec::new();
    for name in listed.split_whitespace() {
        let path = std::path::Path::new(&folder).join(format!("{name}.geojson"));
        let read = pilotage_roads::files::read_roads(&std::fs::read(path).unwrap()).unwrap();
        let frame = LocalFrame::new(read.middle().unwrap());
        let map = RoadMap::new(read.in_world(&frame), RoadJoining::SHARED_POINTS);
        maps.push((name.to_owned(), Source::new(map)));
    }
    maps
}

/// Errors of any quality of seeing.
fn errors(draw: &mut Draw) -> SeeingErrors {
    SeeingErrors {
        recall: draw.between(0.35, 0.95),
        stretch: draw.between(20.0, 90.0),
        precision: draw.between(0.4, 0.95),
        point: draw.between(0.5, 2.5),
        of_map: draw.between(0.5, 3.5),
        crossing_recall: draw.between(0.25, 0.85),
        crossing_precision: draw.between(0.2, 0.8),
        crossing_place: draw.between(2.0, 5.0),
        ..USUAL
    }
}

#[test]
#[ignore = "a table for `tests/oracles/lost_weights.py`, of many minutes"]
fn views_of_any_quality_are_tabled() {
    let count: u64 = std::env::var("PILOTAGE_VIEWS").map_or(100, |text| text.parse().unwrap());
    let settings = LostSettings::default();
    let maps = maps();
    let mut table = String::new();
    for (name, map) in &maps {
        let index = RoadIndex::new(&map.map, RoadClass::Service).unwrap();
        for (other, source) in &maps {
            let is_own = name == other;
            let views = if is_own { count } else { count / 4 };
            let (mut first, mut believed) = (0, 0);
            for seed in 0..views {
                let mut draw = Draw::new(seed + 2000);
                let errors = errors(&mut draw);
                let mut truth = draw.pose(&source.map.bounds().unwrap(), 450.0);
                truth.scale = 1.0 + 0.02 * draw.gauss();
                let view = drawn_view(source, &truth, &errors, &mut draw);
                let belief = index.locate(&view, &settings).unwrap();
                let right = belief
                    .places
                    .iter()
                    .position(|p| is_own && is_right(&p.pose, &truth));
                first += u32::from(right == Some(0));
                believed += u32::from(belief.place(0.99).is_some());
                let right = right.map_or(-1, |r| r as i64);
                write!(
                    table,
                    "{{\"map\":\"{name}\",\"of\":\"{other}\",\"right\":{right},\"places\":["
                )
                .unwrap();
                for (index, place) in belief.places.iter().enumerate() {
                    let comma = if index > 0 { "," } else { "" };
                    let evidence = place.evidence;
                    write!(table, "{comma}[{:?},{:?}]", evidence.seen, evidence.known).unwrap();
                }
                table += "]}\n";
            }
            println!(
                "{name}, views of {other}: {views}, likeliest right {first}, believed {believed}"
            );
        }
    }
    if let Ok(path) = std::env::var("PILOTAGE_LOST_TABLE") {
        std::fs::write(path, table).unwrap();
    }
}
