//! Classes and landmarks of the generated country, looked for in real pictures.
//!
//! `cargo test -p pilotage-training --test real_ground -- --ignored --nocapture NAME` prints the tables of
//! docs/notes/real-ground.md. Nothing that the program ships is learned from these places.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

mod by_edges;
mod by_network;
mod by_words;
mod locating;
mod patches;
mod photos;
mod tally;
mod three_classes;

use photos::RealSite;
use pilotage_reference::ReferenceTable;
use pilotage_reference::edges::EDGE_GSD;
use pilotage_reference::seeing::ReferenceMapping;
use pilotage_vision::ground_class::CoverNetwork;
use three_classes::ThreeClasses;

/// Of all places together, and of each, those that `tell` tells of it.
fn held_out(name: &str, count: usize, tell: &dyn Fn(usize) -> (&'static str, ThreeClasses)) {
    let mut all = ThreeClasses::default();
    for number in 0..count {
        let (site, counts) = tell(number);
        println!("{name}, {site}: {counts}");
        all.join(&counts);
    }
    println!("{name}, all: {all}");
}

#[test]
#[ignore = "a study of real pictures"]
fn classes_of_traced_points() {
    let sites = patches::sites();
    let network = CoverNetwork::usual();
    held_out("the program's network", sites.len(), &|site| {
        (sites[site].name, by_network::told(&sites[site], &network))
    });
}

#[test]
#[ignore = "a study of real pictures"]
fn classes_of_traced_points_learned_otherwise() {
    let sites = patches::sites();
    let mut examples = by_network::generated(0);
    for name in ["generated ground", "generated ground in other colours"] {
        let network = by_network::trained(&examples);
        held_out(name, sites.len(), &|site| {
            (sites[site].name, by_network::told(&sites[site], &network))
        });
        examples = by_network::generated(3);
    }
    held_out("the same and the other places", sites.len(), &|site| {
        let mut examples = examples.clone();
        for (number, other) in sites.iter().enumerate() {
            if number != site {
                by_network::add(&mut examples, other);
            }
        }
        let network = by_network::trained(&examples);
        (sites[site].name, by_network::told(&sites[site], &network))
    });
}

#[test]
#[ignore = "a study of real pictures"]
fn words_of_traced_points() {
    let sites = patches::sites();
    let generated = by_words::generated();
    let real: Vec<_> = sites.iter().map(by_words::of_site).collect();
    println!("{} windows of generated ground", generated.len());
    let classifier = by_words::trained(&generated);
    held_out("words of generated ground", sites.len(), &|site| {
        (sites[site].name, by_words::told(&real[site], &classifier))
    });
    let others = |site: usize| {
        let others = real.iter().enumerate().filter(move |(i, _)| *i != site);
        others.flat_map(|(_, windows)| windows.iter().cloned())
    };
    held_out("words of the other places", sites.len(), &|site| {
        let learned: Vec<_> = others(site).collect();
        (
            sites[site].name,
            by_words::told(&real[site], &by_words::trained(&learned)),
        )
    });
    held_out("words of both", sites.len(), &|site| {
        let learned: Vec<_> = others(site).chain(generated.iter().cloned()).collect();
        (
            sites[site].name,
            by_words::told(&real[site], &by_words::trained(&learned)),
        )
    });
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
        let table = by_edges::table_of(site.map.as_ref(), EDGE_GSD);
        let every = (1, EDGE_GSD);
        by_edges::locate(&site, &table, every, (10.0, 0.0));
        // The others' maps reach farther than the photos.
        if site.name != "caliterra" {
            by_edges::locate(&site, &table, every, (10.0, 200.0));
        }
        if site.name == "fengyuan" {
            by_edges::locate(&site, &table, every, (40.0, 0.0));
        }
    }
}

#[test]
#[ignore = "a study of real pictures"]
fn photos_from_forty_metres_by_edges() {
    let Some((shore, works)) = photos::brighton_beach().zip(photos::caliterra()) else {
        return;
    };
    for (site, other) in [(&shore, &works), (&works, &shore)] {
        for gsd in [EDGE_GSD, 0.35, 0.25] {
            let table = by_edges::table_of(site.map.as_ref(), gsd);
            by_edges::locate(site, &table, (1, gsd), (10.0, 0.0));
            by_edges::believed_elsewhere(other, site, &table, gsd);
        }
    }
}

#[test]
#[ignore = "a study of real pictures"]
fn photos_of_the_tuned_place_by_edges() {
    let Some(site) = photos::adm("map_january") else {
        return;
    };
    let table = by_edges::table_of(site.map.as_ref(), EDGE_GSD);
    by_edges::locate(&site, &table, (2, EDGE_GSD), (10.0, 0.0));
    by_edges::locate(&site, &table, (2, EDGE_GSD), (10.0, 200.0));
}
