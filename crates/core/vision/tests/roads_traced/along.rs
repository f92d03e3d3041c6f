//! Roads drawn with help, from click to click along lines that people traced.

use pilotage_vision::road::network::RoadNetwork;
use pilotage_vision::road::{RoadProbability, RoadTrace, TracedRoad, probability_by};

use super::sites::{self, GSD, Site, distance};
use super::{ALL, studies};

/// Distance between two clicks, metres.
const LEG: f64 = 150.0;
/// Shortest line that is traced again, metres.
const SHORTEST: f64 = 25.0;

/// Places of a line, a pixel apart, with the distance from its begin.
fn places(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut all = Vec::new();
    for ends in line.windows(2) {
        let [[ax, ay], [bx, by]] = [ends[0], ends[1]];
        let steps = (bx - ax).hypot(by - ay).ceil().max(1.0) as usize;
        for i in 0..steps {
            let t = i as f64 / steps as f64;
            all.push([ax + t * (bx - ax), ay + t * (by - ay)]);
        }
    }
    all.extend(line.last());
    all
}

/// The road between two clicks, as the page would draw it; `None` where it would draw a straight line.
fn leg(seen: &RoadProbability, from: [f64; 2], to: [f64; 2]) -> Option<TracedRoad> {
    let apart = (from[0] - to[0]).hypot(from[1] - to[1]);
    let mut trace = RoadTrace::new(seen.clone(), from, to, 1.5 * apart + 60.0 / GSD)?;
    while trace.advance() {}
    let road = trace.traced([true, true]);
    road.is_road().then_some(road)
}

/// Distances from the stored line, metres, of lines as they would be drawn and of the straight ones between the same clicks.
#[derive(Default)]
struct Distances {
    drawn: Vec<f64>,
    straight: Vec<f64>,
}

impl Distances {
    /// Medians of both, and the 90 % quantile of what is drawn.
    fn told(&mut self) -> (f64, f64, f64) {
        let (off, straight) = (median(&mut self.drawn), median(&mut self.straight));
        let far = self.drawn.get(self.drawn.len() * 9 / 10);
        (off, straight, far.copied().unwrap_or(f64::NAN))
    }
}

/// Distances of all legs, and of those that bend with a road; the number of the latter and of all; differences of widths,
/// metres.
#[derive(Default)]
struct Along {
    all: Distances,
    bent: Distances,
    legs: (usize, usize),
    widths: Vec<f64>,
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn traced_again(site: &Site, seen: &RoadProbability) -> Along {
    let mut along = Along::default();
    for line in &site.lines {
        let all = places(&line.points);
        let inside: Vec<[f64; 2]> = all.into_iter().filter(|p| site.is_sure(*p)).collect();
        let is_on = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 2.0;
        let stretches = inside.chunk_by(is_on);
        for part in stretches.flat_map(|stretch| stretch.chunks((LEG / GSD) as usize)) {
            if (part.len() as f64) * GSD < SHORTEST {
                continue;
            }
            let (from, to) = (part[0], part[part.len() - 1]);
            along.legs.1 += 1;
            let off = |line: &[[f64; 2]]| -> Vec<f64> {
                let away = part.iter().map(|place| distance(*place, line) * GSD);
                away.collect()
            };
            let straight = off(&[from, to]);
            let road = leg(seen, from, to);
            let drawn = road
                .as_ref()
                .map_or_else(|| straight.clone(), |road| off(&road.line));
            if road.as_ref().is_some_and(|road| road.line.len() > 2) {
                along.legs.0 += 1;
                along.bent.drawn.extend(&drawn);
                along.bent.straight.extend(&straight);
            }
            along.all.drawn.extend(drawn);
            along.all.straight.extend(straight);
            let Some(road) = road else {
                continue;
            };
            let widths = road.width.zip(line.width);
            along
                .widths
                .extend(widths.map(|(seen, stored)| (seen - stored).abs() * GSD));
        }
    }
    along
}

#[test]
fn roads_followed_from_click_to_click_lie_on_the_lines_that_people_traced() {
    let network = RoadNetwork::built_in();
    for site in sites::all(studies::either(&["caliterra"][..], &ALL)) {
        let seen = probability_by(&network, &site.grid, GSD);
        let mut along = traced_again(&site, &seen);
        let (followed, all) = along.legs;
        let (off, straight, far) = along.bent.told();
        let of_all = along.all.told();
        println!(
            "{}: {followed} of {all} legs of {LEG} m bend with a road; stored lines lie {off:.2} m off them in the median, \
             {far:.2} m at 90 %; off straight lines {straight:.2} m; of all legs {:.2} m, off straight lines {:.2} m; widths {:.1} m",
            site.name,
            of_all.0,
            of_all.1,
            median(&mut along.widths)
        );
        if site.name == "caliterra" {
            assert!(
                followed >= 2 && off < 2.0 && off < 0.5 * straight,
                "{followed} of {all}, {off} m, {straight} m"
            );
        }
    }
}
