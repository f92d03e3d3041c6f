//! Maps of any extent: found in as in one part, in any order, on any ground.

use nalgebra::Vector2;
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_roads::lost::{
    LostBelief, LostPlace, LostSettings, LostShare, PartSettings, RoadIndex, RoadIndexError,
    RoadParts, RoadView, ViewMotion, ViewPose,
};
use pilotage_roads::{RoadClass, RoadJoining, RoadLine, RoadMap};

use super::drawn::{Draw, Source, drawn_view};
use super::town::town;
use super::{BLOCKS, USUAL, is_right, usual_motion};

/// The roads of a town, scaled and moved.
fn laid(map: &RoadMap, scale: f64, north: f64, east: f64) -> Vec<RoadLine> {
    let at = |p: &GroundPoint| GroundPoint::new(scale * p.north + north, scale * p.east + east);
    let line = |line: &RoadLine| RoadLine {
        course: line.course.iter().map(at).collect(),
        ..line.clone()
    };
    map.lines().iter().map(line).collect()
}

fn settings_of(view: &RoadView, then: &[(ViewMotion, RoadView)]) -> PartSettings {
    let scale = LostSettings::default().scale;
    PartSettings::of_views(RoadClass::Service, view, then, scale)
}

/// Places in every part, those of the last part first where `is_reversed`.
fn shares(
    parts: &RoadParts,
    is_reversed: bool,
    in_part: impl Fn(&RoadIndex) -> LostShare,
) -> Vec<LostShare> {
    let mut shares = vec![LostShare::default(); parts.count()];
    for step in 0..shares.len() {
        let number = if is_reversed {
            shares.len() - 1 - step
        } else {
            step
        };
        if let Some(index) = parts.index(number) {
            shares[number] = in_part(&index);
        }
    }
    shares
}

fn found(parts: &RoadParts, view: &RoadView) -> LostBelief {
    let settings = LostSettings::default();
    let in_part = |index: &RoadIndex| index.places(view, &settings).unwrap();
    LostBelief::of_parts(shares(parts, false, in_part))
}

/// Probability of a place where so many times as much ground is searched, without chance fits there.
fn over_more_ground(belief: &LostBelief, place: &LostPlace, more: f64) -> f64 {
    let own = place.probability / more;
    own / ((1.0 - belief.elsewhere) / more + belief.elsewhere)
}

/// A view of a source from anywhere in it.
fn view_of(source: &Source, seed: u64) -> (ViewPose, RoadView) {
    let mut draw = Draw::new(seed);
    let mut truth = draw.pose(&source.map.bounds().unwrap(), 380.0);
    truth.scale = 1.0 + 0.02 * draw.gauss();
    let view = drawn_view(source, &truth, &USUAL, &mut draw);
    (truth, view)
}

#[test]
fn a_map_of_one_town_is_searched_as_ever() {
    let own = Source::new(town(1, BLOCKS));
    let index = RoadIndex::new(&own.map, RoadClass::Service).unwrap();
    let (_, view) = view_of(&own, 3);
    let parts = RoadParts::new(own.map.lines().to_vec(), &settings_of(&view, &[])).unwrap();
    assert_eq!(parts.count(), 1);
    let alone = index.locate(&view, &LostSettings::default()).unwrap();
    assert_eq!(found(&parts, &view), alone);
}

/// Tallies of views of towns side by side: right ones in the town alone, in all, in all as one index, and wrong ones.
fn among_towns(towns: i32, blocks: i32, views: u64, as_one: bool) -> [u32; 4] {
    let mut lines = Vec::new();
    let place = |number: i32| match number {
        // The last lies far off.
        last if last + 1 == towns => GroundPoint::new(300e3, -300e3),
        number => GroundPoint::new(11e3 * f64::from(number / 7), 11e3 * f64::from(number % 7)),
    };
    let town = |number: i32| town(100 + number as u64, blocks);
    for number in 0..towns {
        let at = place(number);
        // As one index none may lie far off.
        if !(as_one && number + 1 == towns) {
            lines.extend(laid(&town(number), 1.0, at.north, at.east));
        }
    }
    let mut tally = [0; 4];
    let whole = RoadMap::new(lines.clone(), RoadJoining::SHARED_POINTS);
    let whole = as_one.then(|| RoadIndex::new(&whole, RoadClass::Service).unwrap());
    let mut parts: Option<RoadParts> = None;
    for seed in 0..views {
        let number = (seed as i32 * 5 + 4) % (towns - i32::from(as_one));
        let own = Source::new(town(number));
        let (truth, view) = view_of(&own, seed);
        let index = RoadIndex::new(&own.map, RoadClass::Service).unwrap();
        let alone = index.locate(&view, &LostSettings::default()).unwrap();
        let parts = parts.get_or_insert_with(|| {
            RoadParts::new(lines.clone(), &settings_of(&view, &[])).unwrap()
        });
        let at = place(number);
        let there = ViewPose {
            place: GroundPoint::new(truth.place.north + at.north, truth.place.east + at.east),
            ..truth
        };
        let all = found(parts, &view);
        let of_whole = whole.as_ref().map(|whole| {
            let belief = whole.locate(&view, &LostSettings::default()).unwrap();
            belief
                .place(0.99)
                .is_some_and(|p| is_right(&p.pose, &there))
        });
        let own_place = alone.places.first().filter(|p| is_right(&p.pose, &truth));
        let expected = own_place.map(|place| {
            let bounds = own.map.bounds().unwrap();
            let area = 1e-6 * bounds.width() * bounds.height();
            over_more_ground(&alone, place, parts.area() / area)
        });
        tally[0] += u32::from(expected.is_some_and(|p| p >= 0.99));
        tally[2] += u32::from(of_whole == Some(true));
        if let Some(place) = all.place(0.99) {
            let is_right = is_right(&place.pose, &there);
            tally[1] += u32::from(is_right);
            tally[3] += u32::from(!is_right);
            let off = (place.probability - expected.unwrap_or(0.0)).abs();
            assert!(off < 0.01, "{seed}: {place:?}, alone {expected:?}");
        }
    }
    tally
}

#[test]
fn views_are_found_among_towns_that_lie_far_apart() {
    let [alone, all, _, wrong] = among_towns(5, 16, 8, false);
    assert!(
        alone >= 5 && all + 1 >= alone && wrong == 0,
        "{alone} {all} {wrong}"
    );
}

#[test]
#[ignore = "a study of some minutes"]
fn views_are_found_among_forty_towns_as_in_one() {
    let [alone, all, as_one, wrong] = among_towns(40, BLOCKS, 16, true);
    println!("alone {alone}, in parts {all}, as one index {as_one}, wrong {wrong}");
    assert!(all + 1 >= alone && wrong == 0);
}

#[test]
fn views_across_the_border_of_parts_are_found_once() {
    let own = Source::new(town(21, BLOCKS));
    let index = RoadIndex::new(&own.map, RoadClass::Service).unwrap();
    let settings = LostSettings::default();
    let mut draw = Draw::new(5);
    let mut truth = ViewPose {
        place: GroundPoint::new(1100.0, 1690.0),
        turn: 0.8,
        scale: 1.01,
    };
    let first = drawn_view(&own, &truth, &USUAL, &mut draw);
    let mut then = Vec::new();
    for _ in 0..2 {
        let motion = usual_motion();
        truth = truth.after(&motion);
        then.push((motion, drawn_view(&own, &truth, &USUAL, &mut draw)));
    }
    let last = &then[1].1;
    let alone = index.locate(last, &settings).unwrap();
    let along = index.locate_along(&first, &then, &settings).unwrap();
    let small = |then: &[(ViewMotion, RoadView)], view: &RoadView, at: GroundPoint| {
        let around = GroundRect::centered(at, 5000.0, 5000.0);
        let of_views = settings_of(view, then);
        let own_settings = PartSettings {
            area: 2500.0 * 2500.0,
            around: Some(around),
            ..of_views
        };
        RoadParts::new(own.map.lines().to_vec(), &own_settings).unwrap()
    };
    // Their corner lies where the last view was taken, or a little beside.
    for (north, east) in [(0.0, 0.0), (12.0, -8.0), (-200.0, 1.0)] {
        let at = GroundPoint::new(truth.place.north + north, truth.place.east + east);
        let parts = small(&[], last, at);
        assert_eq!(parts.count(), 4);
        let more = parts.area() / area_of(&own.map);
        same_place(&found(&parts, last), &alone, &truth, more);
        let parts = small(&then, &first, at);
        let more = parts.area() / area_of(&own.map);
        let in_part = |index: &RoadIndex| index.places_along(&first, &then, &settings).unwrap();
        let [forward, backward] =
            [false, true].map(|is_reversed| shares(&parts, is_reversed, in_part));
        let belief = LostBelief::of_parts(forward);
        assert_eq!(LostBelief::of_parts(backward), belief);
        same_place(&belief, &along, &truth, more);
    }
}

fn area_of(map: &RoadMap) -> f64 {
    let bounds = map.bounds().unwrap();
    1e-6 * bounds.width() * bounds.height()
}

/// Sees that the place of `belief` is that of `whole`, once.
fn same_place(belief: &LostBelief, whole: &LostBelief, truth: &ViewPose, more: f64) {
    let (own, other) = (belief.places[0], whole.places[0]);
    assert!(is_right(&own.pose, truth) && own.pose.place.distance(&other.pose.place) < 0.2);
    let expected = over_more_ground(whole, &other, more);
    assert!(
        (own.probability - expected).abs() < 1e-3,
        "{own:?} {expected}"
    );
    let near = |p: &&LostPlace| p.pose.place.distance(&own.pose.place) < 25.0;
    let same = |p: &&LostPlace| near(p) && (p.pose.turn - own.pose.turn).abs() < 0.1;
    assert_eq!(belief.places.iter().filter(same).count(), 1);
}

#[test]
fn a_part_as_dense_as_aleppo_takes_less_than_a_hundred_megabytes() {
    // 0.8 of two streets every 85 m: 18.8 km in each square kilometre.
    let lines = laid(&town(4, 140), 0.773, 0.0, 0.0);
    let settings = PartSettings {
        least: RoadClass::Service,
        reach: 600.0,
        around: Some(GroundRect::centered(
            GroundPoint::new(5950.0, 5950.0),
            10e3,
            10e3,
        )),
        area: 100e6,
    };
    let parts = RoadParts::new(lines, &settings).unwrap();
    assert_eq!((parts.count(), parts.area().round()), (1, 100.0));
    let index = parts.index(0).unwrap();
    assert!(index.crossings() > 10_000, "{}", index.crossings());
    assert!(index.bytes() < 100_000_000, "{}", index.bytes());
}

#[test]
fn places_are_sought_around_a_place_alone() {
    let own = Source::new(town(1, 16));
    let (truth, view) = view_of(&own, 1);
    let around = |north: f64| PartSettings {
        around: Some(GroundRect::centered(
            GroundPoint::new(truth.place.north + north, truth.place.east),
            800.0,
            800.0,
        )),
        ..settings_of(&view, &[])
    };
    let lines = own.map.lines();
    let here = RoadParts::new(lines.to_vec(), &around(0.0)).unwrap();
    let place = *found(&here, &view).place(0.99).unwrap();
    assert!(is_right(&place.pose, &truth));
    let beside = RoadParts::new(lines.to_vec(), &around(450.0)).unwrap();
    assert_eq!(found(&beside, &view).place(0.5), None);
    let none = RoadParts::new(lines.to_vec(), &around(90e3)).unwrap_err();
    assert_eq!(none, RoadIndexError::NoRoadAround);
    let far = PartSettings {
        reach: 40e3,
        ..around(0.0)
    };
    let why = RoadParts::new(lines.to_vec(), &far).unwrap_err();
    assert!(why.to_string().contains("reach 40 km"), "{why}");
}

#[test]
fn a_view_with_a_road_that_lies_elsewhere_is_refused_in_words() {
    let own = town(7, 12);
    let index = RoadIndex::new(&own, RoadClass::Service).unwrap();
    let mut lines = own.lines().to_vec();
    lines.extend(laid(&own, 1.0, 300e3, 0.0).into_iter().take(1));
    let map = RoadMap::new(lines, RoadJoining::SHARED_POINTS);
    let view = RoadView::of_map(&map).unwrap();
    let settings = LostSettings::default();
    let why = index.locate(&view, &settings).unwrap_err();
    assert!(why.to_string().contains("at most 5 km"), "{why}");
    let motion = ViewMotion {
        way: Vector2::new(1.0, 0.0),
        turn: 0.0,
        way_deviation: 1.0,
        turn_deviation: 0.1,
    };
    let then = [(motion, view)];
    assert!(
        index
            .locate_along(&RoadView::default(), &then, &settings)
            .is_err()
    );
}
