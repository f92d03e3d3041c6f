//! Similarity of road graphs against the figures of the metric's own program (`apls` by `CosmiQ`), computed beforehand.

#![allow(
    clippy::unwrap_used,
    clippy::missing_panics_doc,
    reason = "helpers of tests, which may panic"
)]

use std::path::{Path, PathBuf};

use pilotage_base::frames::GroundPoint;
use pilotage_roads::{AplsEdge, AplsGraph, AplsSettings, apls};
use serde_json::Value;

fn shared(name: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/data");
    let place = root.join(name);
    if place.exists() {
        return Some(place);
    }
    println!("skipped: no shared data ({name})");
    None
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// A graph as the files have it: rows of nodes, edges with their line (east, north).
fn graph(value: &Value, is_kept: impl Fn(&Value) -> bool, (north, east): (f64, f64)) -> AplsGraph {
    let place = |e: &Value, n: &Value| {
        GroundPoint::new(n.as_f64().unwrap() + north, e.as_f64().unwrap() + east)
    };
    // Nodes that lost all their edges were taken away as well.
    let edges = value["edges"].as_array().unwrap().iter();
    let kept: Vec<&Value> = edges.filter(|edge| is_kept(edge)).collect();
    let is_used = |row: &&Value| kept.iter().any(|e| e["u"] == row[0] || e["v"] == row[0]);
    let rows = value["nodes"].as_array().unwrap();
    let nodes: Vec<(u64, GroundPoint)> = rows
        .iter()
        .filter(is_used)
        .map(|row| (row[0].as_u64().unwrap(), place(&row[1], &row[2])))
        .collect();
    let index = |name: &Value| {
        let name = name.as_u64().unwrap();
        nodes.iter().position(|(other, _)| *other == name).unwrap()
    };
    let mut edges = Vec::new();
    for edge in kept {
        let line = edge["line_utm"].as_array().unwrap();
        let mut course: Vec<GroundPoint> = line.iter().map(|p| place(&p[0], &p[1])).collect();
        let ends = [index(&edge["u"]), index(&edge["v"])];
        let [from, to] = ends.map(|end| nodes[end].1.distance(&course[0]));
        if from > to {
            course.reverse();
        }
        edges.push(AplsEdge {
            ends,
            length: edge["length_m"].as_f64().unwrap(),
            course,
        });
    }
    AplsGraph { nodes, edges }
}

fn agrees(name: &str, golden: &Value, truth: &AplsGraph, proposal: &AplsGraph) {
    let number = |key: &str| golden[key].as_f64().unwrap();
    let settings = AplsSettings {
        snap: number("max_snap_m"),
        spacing: number("linestring_delta_m"),
    };
    let score = apls(truth, proposal, &settings);
    let counts = [&golden["n_control_gt"], &golden["n_control_prop"]];
    let counts = counts.map(|count| count.as_u64().unwrap() as usize);
    println!("{name}: {score:.4?}, golden {:.4}", number("apls"));
    assert_eq!([score.of_truth, score.of_proposal], counts, "{name}");
    for (own, key) in [
        (score.total, "apls"),
        (score.truth_onto_proposal, "gt_onto_prop"),
        (score.proposal_onto_truth, "prop_onto_gt"),
    ] {
        let theirs = number(key);
        assert!((own - theirs).abs() < 1e-3, "{name}: {key} {own} {theirs}");
    }
}

#[test]
fn scores_are_those_of_the_program_of_the_metrics_authors() {
    let Some(folder) = shared("roads_spacenet") else {
        return;
    };
    let golden = json(&folder.join("apls_golden.json"));
    let graphs = json(&folder.join("vegas_img0_graphs.json"));
    let whole = |value: &Value| graph(value, |_| true, (0.0, 0.0));
    let (truth, proposal) = (whole(&graphs["truth"]), whole(&graphs["proposal"]));
    for case in golden["img0"].as_array().unwrap() {
        agrees("img0", case, &truth, &proposal);
    }
    for case in golden["img0_disturbed"].as_array().unwrap() {
        let what = case["what"].as_str().unwrap();
        let removed = case["removed_u_v_key"]
            .as_array()
            .cloned()
            .unwrap_or_default();
        let is_kept = |edge: &Value| {
            let named = [&edge["u"], &edge["v"], &edge["key"]];
            !removed.iter().any(|r| named == [&r[0], &r[1], &r[2]])
        };
        let numbers = what.split(' ').filter_map(|word| word.parse::<f64>().ok());
        let shift = match numbers.collect::<Vec<_>>()[..] {
            [east, south] if what.contains("shifted") => (-south, east),
            _ => (0.0, 0.0),
        };
        agrees(what, case, &truth, &graph(&graphs["truth"], is_kept, shift));
    }
    for case in golden["spacenet_vs_osm"].as_array().unwrap() {
        let chip = case["chip"].as_str().unwrap();
        let image = chip.rsplit('_').next().unwrap();
        let graphs = json(&folder.join(format!("chip_{image}_graphs.json")));
        let (truth, osm) = (whole(&graphs["truth"]), whole(&graphs["proposal"]));
        agrees(chip, case, &truth, &osm);
    }
}
