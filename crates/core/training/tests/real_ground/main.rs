//! Classes and landmarks of the generated country, looked for in real pictures.
//!
//! `cargo test -p pilotage-training --test real_ground -- --ignored --nocapture NAME` prints the tables of
//! docs/notes/real-ground.md. Nothing that the program ships is learned from these places.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

mod by_edges;
mod locating;
mod patches;
mod photos;
mod tally;
mod three_classes;

use patches::PatchSite;
use photos::RealSite;
use pilotage_reference::ReferenceTable;
use pilotage_reference::seeing::ReferenceMapping;
use pilotage_vision::ground_class::{CELL_PIXELS, CoverFeatures, CoverNetwork, FEATURES};
use three_classes::{THREE, ThreeClasses};

/// Features of the cell at a point.
fn features_at(features: &CoverFeatures, [x, y]: [f64; 2]) -> Option<[f32; FEATURES]> {
    let cell = |pixels: f64| (pixels / CELL_PIXELS as f64) as usize;
    let (column, row) = (cell(x), cell(y));
    let is_seen = column < features.width()
        && row < features.height()
        && features.seen()[row * features.width() + column];
    is_seen.then(|| features.cell(column, row))
}

/// The points of a place as the network tells them.
fn by_network(site: &PatchSite, network: &CoverNetwork) -> ThreeClasses {
    let features = CoverFeatures::of(&site.picture);
    let mut counts = ThreeClasses::default();
    for patch in &site.patches {
        let Some(own) = features_at(&features, patch.pixel) else {
            continue;
        };
        let told = network.probabilities(&own);
        counts.add(
            patch.cover,
            THREE.map(|class| f64::from(told[class.index()])),
        );
    }
    counts
}

#[test]
#[ignore = "a study of real pictures"]
fn classes_of_traced_points() {
    let network = CoverNetwork::usual();
    let mut all = ThreeClasses::default();
    for site in patches::sites() {
        let counts = by_network(&site, &network);
        println!("{}: {counts}", site.name);
        all.join(&counts);
    }
    println!("all: {all}");
}

/// The table of a map, as it comes back from its file.
fn table_of(site: &RealSite, network: &CoverNetwork) -> ReferenceTable {
    let mut mapping = ReferenceMapping::of(site.map.clone(), network.clone());
    while mapping.advance() {}
    let bytes = mapping.into_table().to_bytes();
    ReferenceTable::from_bytes(&bytes).unwrap()
}

/// Places with photos and the map over which they were taken, of which the data are at hand.
fn photographed() -> impl Iterator<Item = RealSite> {
    let sites = [
        || photos::adm("map_january"),
        photos::fengyuan,
        photos::caliterra,
    ];
    sites.into_iter().filter_map(|site| site())
}

#[test]
#[ignore = "a study of real pictures"]
fn photos_by_the_table() {
    let network = CoverNetwork::usual();
    for site in photographed() {
        locating::locate(&site, &table_of(&site, &network), &network);
    }
}

#[test]
#[ignore = "a study of real pictures"]
fn photos_by_edges() {
    for site in photographed() {
        let table = by_edges::table_of(site.map.as_ref());
        by_edges::locate(&site, &table, 1, (10.0, 0.0));
        // The others' maps reach farther than the photos.
        if site.name != "caliterra" {
            by_edges::locate(&site, &table, 1, (10.0, 200.0));
        }
        if site.name == "fengyuan" {
            by_edges::locate(&site, &table, 1, (40.0, 0.0));
        }
    }
}

#[test]
#[ignore = "a study of real pictures"]
fn photos_of_the_tuned_place_by_edges() {
    let Some(site) = photos::adm("map_january") else {
        return;
    };
    let table = by_edges::table_of(site.map.as_ref());
    by_edges::locate(&site, &table, 2, (10.0, 0.0));
    by_edges::locate(&site, &table, 2, (10.0, 200.0));
}
