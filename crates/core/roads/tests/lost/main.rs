//! Views found among the roads of towns that never were, and not found where they were not taken.

#![allow(
    clippy::unwrap_used,
    clippy::missing_panics_doc,
    reason = "helpers of tests, which may panic"
)]

mod drawn;
mod parts;
mod taught;
mod town;

use nalgebra::Vector2;
use pilotage_base::frames::{GroundPoint, wrap_pi};
use pilotage_roads::lost::{
    LostSettings, RoadIndex, RoadIndexError, RoadView, ViewMotion, ViewPose,
};
use pilotage_roads::{RoadClass, RoadJoining, RoadLine, RoadMap};

use drawn::{Draw, SeeingErrors, Source, drawn_view};
use town::town;

/// Blocks along the side of a town: 3.3 km.
const BLOCKS: i32 = 30;

/// Way from one view to the next, as it is reckoned: some 300 m ahead and a little to the right.
fn usual_motion() -> ViewMotion {
    ViewMotion {
        way: Vector2::new(300.0, 20.0),
        turn: 0.2,
        way_deviation: 5.0,
        turn_deviation: 0.01,
    }
}

/// As the network sees drawn ground (docs/notes/roads-lost.md), with fewer crossings.
const USUAL: SeeingErrors = SeeingErrors {
    recall: 0.85,
    stretch: 60.0,
    precision: 0.72,
    point: 1.0,
    of_map: 2.0,
    crossing_recall: 0.6,
    crossing_precision: 0.4,
    crossing_place: 3.0,
    arm: 0.1,
    arm_missed: 0.1,
};

fn is_right(found: &ViewPose, truth: &ViewPose) -> bool {
    found.place.distance(&truth.place) < 20.0 && wrap_pi(found.turn - truth.turn).abs() < 0.09
}

#[test]
fn views_of_a_town_are_found_in_it_and_in_no_other() {
    let own = Source::new(town(1, BLOCKS));
    let [here, elsewhere] =
        [&own.map, &town(2, BLOCKS)].map(|map| RoadIndex::new(map, RoadClass::Service).unwrap());
    let settings = LostSettings::default();
    let (mut right, mut wrong) = (0, 0);
    for seed in 0..16 {
        let mut draw = Draw::new(seed);
        let mut truth = draw.pose(&own.map.bounds().unwrap(), 380.0);
        truth.scale = 1.0 + 0.02 * draw.gauss();
        let view = drawn_view(&own, &truth, &USUAL, &mut draw);
        let belief = here.locate(&view, &settings).unwrap();
        if let Some(place) = belief.place(0.99) {
            let is_right = is_right(&place.pose, &truth);
            right += u32::from(is_right);
            wrong += u32::from(!is_right);
        }
        assert_eq!(
            elsewhere.locate(&view, &settings).unwrap().place(0.99),
            None,
            "{seed}"
        );
    }
    assert!(right >= 12 && wrong == 0, "{right} right, {wrong} wrong");
}

#[test]
fn a_heading_outside_the_stated_range_is_not_found() {
    let own = Source::new(town(5, 16));
    let index = RoadIndex::new(&own.map, RoadClass::Service).unwrap();
    let mut draw = Draw::new(3);
    let truth = ViewPose {
        turn: 2.0,
        ..draw.pose(&own.map.bounds().unwrap(), 500.0)
    };
    let view = drawn_view(&own, &truth, &USUAL, &mut draw);
    let within = |turn| LostSettings {
        turn,
        within_turn: 0.3,
        ..LostSettings::default()
    };
    let found = index.locate(&view, &within(1.9)).unwrap();
    assert!(is_right(&found.place(0.99).unwrap().pose, &truth));
    let other = index.locate(&view, &within(0.0)).unwrap();
    assert_eq!(other.place(0.5), None);
}

#[test]
fn a_scale_that_is_exact_is_as_good_as_one_that_is_known_well() {
    let own = Source::new(town(5, 16));
    let index = RoadIndex::new(&own.map, RoadClass::Service).unwrap();
    let mut draw = Draw::new(3);
    let truth = draw.pose(&own.map.bounds().unwrap(), 500.0);
    let view = drawn_view(&own, &truth, &USUAL, &mut draw);
    let [exact, well] = [0.0, 0.001].map(|scale| {
        let settings = LostSettings {
            scale,
            ..LostSettings::default()
        };
        let belief = index.locate(&view, &settings).unwrap();
        belief.place(0.99).unwrap().pose
    });
    assert!(is_right(&exact, &truth) && exact.place.distance(&well.place) < 1.0);
    assert!((exact.scale - 1.0).abs() < 1e-6, "{}", exact.scale);
}

#[test]
fn towns_that_lie_far_apart_make_no_one_index_before_they_fill_the_memory() {
    let mut lines = town(1, 4).lines().to_vec();
    let there = lines.iter().map(|line| RoadLine {
        course: (line.course.iter())
            .map(|p| GroundPoint::new(p.north + 300e3, p.east + 300e3))
            .collect(),
        ..line.clone()
    });
    let there: Vec<RoadLine> = there.collect();
    lines.extend(there);
    let map = RoadMap::new(lines, RoadJoining::SHARED_POINTS);
    let why = RoadIndex::new(&map, RoadClass::Service).unwrap_err();
    let RoadIndexError::TooWide { north, east } = why else {
        panic!("{why}");
    };
    assert!((300.0..302.0).contains(&north) && (300.0..302.0).contains(&east));
    assert!(why.to_string().contains("at most 5000 km²"), "{why}");
    let none = RoadMap::new(Vec::new(), RoadJoining::SHARED_POINTS);
    let why = RoadIndex::new(&none, RoadClass::Service).unwrap_err();
    assert_eq!(why, RoadIndexError::NoRoad);
}

#[test]
fn a_straight_road_and_no_road_tell_no_place() {
    let line = |ends: [(f64, f64); 2]| RoadLine {
        course: ends.map(|(n, e)| GroundPoint::new(n, e)).to_vec(),
        ..RoadLine::default()
    };
    let own = Source::new(town(7, 12));
    let index = RoadIndex::new(&own.map, RoadClass::Service).unwrap();
    let road = RoadMap::new(
        vec![line([(0.0, 0.0), (400.0, 90.0)])],
        RoadJoining::SHARED_POINTS,
    );
    for view in [RoadView::of_map(&road).unwrap(), RoadView::default()] {
        let belief = index.locate(&view, &LostSettings::default()).unwrap();
        assert_eq!(belief.places, []);
        assert_eq!(belief.elsewhere, 1.0);
    }
}

#[test]
fn a_town_that_repeats_itself_is_not_believed_once() {
    // The same quarter four times: what a view shows is true of all of them.
    let quarter = town(11, 9);
    let mut lines = Vec::new();
    for (north, east) in [(0.0, 0.0), (1300.0, 0.0), (0.0, 1300.0), (1300.0, 1300.0)] {
        lines.extend(quarter.lines().iter().map(|line| {
            RoadLine {
                course: (line.course.iter())
                    .map(|p| GroundPoint::new(p.north + north, p.east + east))
                    .collect(),
                ..line.clone()
            }
        }));
    }
    let index = RoadIndex::new(
        &RoadMap::new(lines, RoadJoining::SHARED_POINTS),
        RoadClass::Service,
    );
    let source = Source::new(quarter);
    let mut draw = Draw::new(2);
    let truth = ViewPose {
        place: source.map.bounds().unwrap().center(),
        turn: 0.4,
        scale: 1.0,
    };
    let view = drawn_view(&source, &truth, &USUAL, &mut draw);
    let belief = (index.unwrap().locate(&view, &LostSettings::default())).unwrap();
    let likely = belief
        .places
        .iter()
        .filter(|p| p.probability > 0.05)
        .count();
    assert!(belief.places[0].probability < 0.7, "{:?}", belief.places[0]);
    assert!(likely >= 2, "{likely}");
}

#[test]
fn views_on_one_way_are_surer_than_each_of_them() {
    let own = Source::new(town(21, BLOCKS));
    let index = RoadIndex::new(&own.map, RoadClass::Service).unwrap();
    let settings = LostSettings::default();
    // Much worse than usual: few crossings, less than half of the road.
    let poor = SeeingErrors {
        recall: 0.45,
        precision: 0.5,
        crossing_recall: 0.3,
        ..USUAL
    };
    let (mut alone, mut along) = (0.0, 0.0);
    for seed in 0..6 {
        let mut draw = Draw::new(seed + 60);
        let mut truth = draw.pose(&own.map.bounds().unwrap(), 1000.0);
        let first = drawn_view(&own, &truth, &poor, &mut draw);
        let mut then = Vec::new();
        for _ in 0..2 {
            let motion = usual_motion();
            truth = truth.after(&motion);
            let off = 5.0 * Vector2::new(draw.gauss(), draw.gauss());
            let told = ViewMotion {
                way: motion.way + off,
                ..motion
            };
            then.push((told, drawn_view(&own, &truth, &poor, &mut draw)));
        }
        let of_right = |places: &[pilotage_roads::lost::LostPlace]| -> f64 {
            let right = places.iter().filter(|p| is_right(&p.pose, &truth));
            right.map(|p| p.probability).sum()
        };
        let last = index.locate(&then[1].1, &settings).unwrap();
        alone += of_right(&last.places) / 6.0;
        let all = index.locate_along(&first, &then, &settings).unwrap();
        along += of_right(&all.places) / 6.0;
    }
    assert!(
        along > 0.95 && 1.0 - along < 0.3 * (1.0 - alone),
        "{alone} {along}"
    );
}
