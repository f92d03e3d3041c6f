//! Roads seen in real pictures of places that no detector learned from, beside what people traced there.
//!
//! The everyday run looks at one of them; `PILOTAGE_STUDIES=1 cargo test -p pilotage-vision --test roads_traced --
//! --nocapture` prints the tables of docs/results.md. Nothing here may be trained or tuned on.

mod along;
mod calibration;
mod sites;
#[path = "../../../../../tests/src/studies.rs"]
mod studies;

use std::time::Instant;

use calibration::{LogOddsChange, RoadCounts};
use pilotage_raster::raster::{Gray, Picture, Raster, encode_png};
use pilotage_vision::road::network::{RoadNetwork, network_input};
use pilotage_vision::road::yellow::YellowLineRule;
use pilotage_vision::road::{RoadsSeen, probability_by};
use sites::Site;

/// All places.
const ALL: [&str; 5] = [
    "brighton_beach",
    "caliterra",
    "adm2014",
    "fengyuan",
    "vegas_img0",
];
/// Pixels by which an edge may be off.
const SLACK: f64 = 3.0;

struct Scores {
    precision: f64,
    recall: f64,
}

impl Scores {
    fn f1(&self) -> f64 {
        2.0 * self.precision * self.recall / (self.precision + self.recall).max(1e-9)
    }
}

/// Pixels within the slack of set ones.
fn widened(mask: &Raster<bool>) -> Raster<bool> {
    let reach = SLACK as isize;
    let mut out = mask.map(|_| false);
    for y in 0..mask.height() {
        for x in (0..mask.width()).filter(|x| mask.get(*x, y)) {
            for dy in -reach..=reach {
                for dx in -reach..=reach {
                    let (c, r) = (x.wrapping_add_signed(dx), y.wrapping_add_signed(dy));
                    if dx * dx + dy * dy <= reach * reach && c < mask.width() && r < mask.height() {
                        out.set(c, r, true);
                    }
                }
            }
        }
    }
    out
}

fn share(hits: usize, all: usize) -> f64 {
    hits as f64 / all.max(1) as f64
}

/// Relaxed precision and recall, and the share of what both have in what either has.
fn by_pixels(site: &Site, seen: &Raster<bool>, truth: &Raster<bool>) -> (Scores, f64) {
    let (near_seen, near_truth) = (widened(seen), widened(truth));
    let mut counts = [0; 6];
    for y in 0..seen.height() {
        for x in 0..seen.width() {
            if !site.is_sure([x as f64 + 0.5, y as f64 + 0.5]) {
                continue;
            }
            let (s, t) = (seen.get(x, y), truth.get(x, y));
            let kinds = [
                s,
                s && near_truth.get(x, y),
                t,
                t && near_seen.get(x, y),
                s && t,
                s || t,
            ];
            for (count, is_so) in counts.iter_mut().zip(kinds) {
                *count += usize::from(is_so);
            }
        }
    }
    let [seen, good, truth, found, both, either] = counts;
    let scores = Scores {
        precision: share(good, seen),
        recall: share(found, truth),
    };
    (scores, share(both, either))
}

/// The same of points of centre lines.
fn by_lines(site: &Site, roads: &RoadsSeen) -> (Scores, usize, usize) {
    let centre = site.centre_places();
    let seen: Vec<[f64; 2]> = (roads.points.iter().map(|p| p.pixel))
        .filter(|p| site.is_sure(*p))
        .collect();
    let near = |p: &[f64; 2], others: &[[f64; 2]]| {
        others
            .iter()
            .any(|q| (p[0] - q[0]).hypot(p[1] - q[1]) <= SLACK)
    };
    let good = seen.iter().filter(|p| {
        site.lines
            .iter()
            .any(|l| sites::distance(**p, &l.points) <= SLACK)
    });
    let found = centre.iter().filter(|p| near(p, &seen));
    let scores = Scores {
        precision: share(good.count(), seen.len()),
        recall: share(found.count(), centre.len()),
    };
    (scores, seen.len(), centre.len())
}

/// The rule of the thesis in the picture's own pixels, on the grid.
fn yellow(site: &Site) -> Raster<bool> {
    let found = YellowLineRule::default().lines(&site.native);
    let (width, height) = (site.grid.width(), site.grid.height());
    Raster::from_fn(width, height, |x, y| {
        found.mask.get(
            x * site.native.width() / width,
            y * site.native.height() / height,
        )
    })
}

fn picture_of(site: &Site, probability: &Gray, roads: &RoadsSeen) -> Picture {
    let (width, height) = (site.grid.width(), site.grid.height());
    let mut shown = Picture::from_fn(2 * width, height, |x, y| {
        let [r, g, b, _] = site.grid.get(x % width, y);
        if x < width {
            [r, g, b]
        } else {
            [(255.0 * probability.get(x - width, y)) as u8, g / 2, b / 2]
        }
    });
    for point in &roads.points {
        shown.set(
            point.pixel[0] as usize,
            point.pixel[1] as usize,
            [255, 0, 255],
        );
    }
    for place in site.centre_places() {
        shown.set(width + place[0] as usize, place[1] as usize, [0, 255, 0]);
    }
    for crossing in &roads.crossings {
        for i in 0..7 {
            let (x, y) = (
                (crossing.pixel[0] as usize + i).saturating_sub(3),
                crossing.pixel[1] as usize,
            );
            shown.set(x.min(width - 1), y.min(height - 1), [255, 255, 0]);
        }
    }
    shown
}

#[test]
fn roads_of_traced_places() {
    let network = RoadNetwork::built_in();
    let mut bins = [[0_usize; 2]; 10];
    for site in sites::all(studies::either(&["caliterra"][..], &ALL)) {
        for is_grey in [false, true] {
            let grid = if is_grey {
                site.grid.map(|[r, g, b, a]| {
                    let y = ((u32::from(r) * 299 + u32::from(g) * 587 + u32::from(b) * 114) / 1000)
                        as u8;
                    [y, y, y, a]
                })
            } else {
                site.grid.clone()
            };
            let seen = probability_by(&network, &grid, sites::GSD);
            let roads = seen.roads();
            let (lines, points, places) = by_lines(&site, &roads);
            println!(
                "{} {}: centre lines F1 {:.3} (precision {:.3} of {points}, recall {:.3} of {places})",
                site.name,
                if is_grey { "grey" } else { "colour" },
                lines.f1(),
                lines.precision,
                lines.recall
            );
            if let Some(truth) = site.road_mask() {
                let (scores, iou) = by_pixels(&site, &seen.mask(), &truth);
                println!(
                    "    pixels: relaxed F1 {:.3} (precision {:.3}, recall {:.3}), IoU {iou:.3}",
                    scores.f1(),
                    scores.precision,
                    scores.recall
                );
                if site.name == "caliterra" {
                    assert!(scores.f1() > 0.7, "{}: {}", site.name, scores.f1());
                }
                if !is_grey {
                    let (rule, iou) = by_pixels(&site, &yellow(&site), &truth);
                    println!(
                        "    yellow lines: relaxed F1 {:.3}, IoU {iou:.3}",
                        rule.f1()
                    );
                    for y in 0..truth.height() {
                        for x in 0..truth.width() {
                            if site.is_sure([x as f64 + 0.5, y as f64 + 0.5]) {
                                let bin = &mut bins
                                    [((10.0 * seen.probability.get(x, y)) as usize).min(9)];
                                bin[0] += 1;
                                bin[1] += usize::from(truth.get(x, y));
                            }
                        }
                    }
                }
            }
            let truth = site.crossings();
            let near =
                |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) * sites::GSD <= 5.0;
            let sure: Vec<_> = roads
                .crossings
                .iter()
                .filter(|c| site.is_sure(c.pixel))
                .collect();
            let right = sure
                .iter()
                .filter(|c| truth.iter().any(|t| near(*t, c.pixel)))
                .count();
            let found = truth
                .iter()
                .filter(|t| sure.iter().any(|c| near(**t, c.pixel)))
                .count();
            println!(
                "    crossings: {right} of {} seen are true, {found} of {} found",
                sure.len(),
                truth.len()
            );
            if let (Ok(folder), false) = (std::env::var("PILOTAGE_PICTURES"), is_grey) {
                let bytes = encode_png(&picture_of(&site, &seen.probability, &roads)).unwrap();
                std::fs::write(format!("{folder}/{}.png", site.name), bytes).unwrap();
            }
        }
    }
    for (i, [count, road]) in bins.iter().enumerate() {
        println!(
            "p {:.1}-{:.1}: road {:.3} of {count}",
            i as f64 / 10.0,
            (i + 1) as f64 / 10.0,
            share(*road, *count)
        );
    }
}

#[test]
#[ignore = "measures time"]
fn time_of_a_picture() {
    let picture = Raster::from_fn(1280, 960, |x, y| {
        let value = ((x * 7 + y * 13 + x * y / 50) % 200) as u8;
        [value, value / 2 + 40, 90, 255]
    });
    let network = RoadNetwork::built_in();
    let best = |work: &dyn Fn()| {
        let times = (0..15).map(|_| {
            let start = Instant::now();
            work();
            start.elapsed().as_secs_f64() * 1e3
        });
        times.fold(f64::INFINITY, f64::min)
    };
    let input = network_input(&picture);
    println!("input {:.1} ms", best(&|| drop(network_input(&picture))));
    println!("input copied {:.1} ms", best(&|| drop(input.clone())));
    println!(
        "network with the copy {:.1} ms",
        best(&|| drop(network.log_odds(input.clone())))
    );
    println!(
        "probability {:.1} ms",
        best(&|| drop(probability_by(&network, &picture, sites::GSD)))
    );
    let seen = probability_by(&network, &picture, sites::GSD);
    println!(
        "points and crossings {:.1} ms",
        best(&|| drop(seen.roads()))
    );
}

#[test]
#[ignore = "a study of real pictures"]
fn probabilities_over_a_temperature_of_other_places() {
    let network = RoadNetwork::built_in();
    let counts: Vec<(&str, RoadCounts)> = sites::all(&ALL)
        .iter()
        .filter_map(|site| {
            let seen = probability_by(&network, &site.grid, sites::GSD);
            Some((site.name, RoadCounts::of(site, &seen.probability)?))
        })
        .collect();
    let offsets: Vec<f64> = (-30..=10).map(|step| 0.1 * f64::from(step)).collect();
    for (name, own) in &counts {
        let others = counts.iter().filter(|(other, _)| other != name);
        let others = RoadCounts::joined(others.map(|(_, counts)| counts));
        let [sure, on_roads] = own.surest();
        print!(
            "{name}: {on_roads} of {sure} pixels from 0.9 on are road; calibration error {:.3}",
            own.calibration_error(LogOddsChange::NONE)
        );
        for (what, offsets) in [("temperature", &[0.0][..]), ("with an offset", &offsets)] {
            let change = others.fitted(offsets);
            let error = own.calibration_error(change);
            print!(
                "; {what} {:.2}, {:.1}: {error:.3}",
                change.temperature, change.offset
            );
        }
        println!();
    }
}
