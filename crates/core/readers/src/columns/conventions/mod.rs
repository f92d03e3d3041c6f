//! Tests with a single flight, written in many units and axes: each has to be read as the same values, or
//! with a question.

pub mod flown;
mod written;

use std::sync::Arc;

use pilotage_base::files::{FileSet, MemoryFiles};
use pilotage_base::frames::wrap_pi;
use pilotage_flight::ChannelName;

use super::{ColumnMap, flight_of_tables, guess_tables};
use flown::{Craft, FlownMoment, moments};
use written::{Choices, table};

/// Result of reading a table.
#[derive(Debug, PartialEq)]
enum ReadingVerdict {
    Right,
    Asked(Vec<String>),
    Wrong(Vec<String>),
}

fn read(text: &str) -> (Vec<ColumnMap>, Result<pilotage_flight::Flight, String>) {
    let files: Arc<dyn FileSet> = Arc::new(MemoryFiles(
        [("flight.csv".to_owned(), text.as_bytes().to_vec())].into(),
    ));
    let tables = guess_tables(files.as_ref(), &files.names());
    let maps: Vec<ColumnMap> = tables.into_iter().map(|t| t.map).collect();
    let flight = flight_of_tables(&files, &maps).map(|folder| folder.flight);
    (maps, flight.map_err(|e| e.to_string()))
}

/// Compares what is read of a table with what was flown.
fn verdict(text: &str, flown: &[FlownMoment], choices: &Choices) -> ReadingVerdict {
    let (maps, flight) = read(text);
    let flight = match flight {
        Ok(flight) => flight,
        Err(cause) => return ReadingVerdict::Wrong(vec![cause]),
    };
    let mut wrong = Vec::new();
    for (name, value) in choices.expected() {
        let channel = flight.channel(name);
        let start = flight.span().0;
        let off = |moment: &FlownMoment| {
            let found = channel.and_then(|c| c.interpolated(start + moment.time));
            let expected = value(moment);
            let difference = found.map_or(f64::INFINITY, |found| found - expected);
            if name.is_angle() {
                wrap_pi(difference).abs()
            } else {
                difference.abs()
            }
        };
        let worst = flown
            .iter()
            .skip(20)
            .step_by(31)
            .map(off)
            .fold(0.0, f64::max);
        let size = flown.iter().map(|m| value(m).abs()).fold(0.0, f64::max);
        // Values are written with four digits after the point; positions with seven of a degree.
        let allowed = 0.01 * size + 0.002;
        if worst > allowed {
            wrong.push(format!("{}: off by {worst:.3} of {size:.3}", name.key()));
        }
    }
    if wrong.is_empty() {
        return ReadingVerdict::Right;
    }
    let questions: Vec<String> = maps.iter().flat_map(|map| map.questions.clone()).collect();
    wrong.extend(maps.iter().flat_map(|map| map.findings.clone()));
    if questions.is_empty() {
        ReadingVerdict::Wrong(wrong)
    } else {
        wrong.extend(questions);
        ReadingVerdict::Asked(wrong)
    }
}

/// Numbers of the tables that are read right, asked about and wrong, with the wrong ones in words.
fn count(craft: Craft, all: &[Choices]) -> (usize, usize, Vec<String>) {
    let flown = moments(craft);
    let (mut right, mut asked, mut wrong) = (0, 0, Vec::new());
    for choices in all {
        match verdict(&table(&flown, choices), &flown, choices) {
            ReadingVerdict::Right => right += 1,
            ReadingVerdict::Asked(why) => {
                println!("asked: {choices:?}\n    {}", why.join("\n    "));
                asked += 1;
            }
            ReadingVerdict::Wrong(why) => {
                wrong.push(format!("{choices:?}\n    {}", why.join("\n    ")));
            }
        }
    }
    (right, asked, wrong)
}

/// None of the tables is read wrong, and at least the `share` (numerator, denominator) of them is read right.
fn check(craft: Craft, all: &[Choices], share: (usize, usize)) {
    let (right, asked, wrong) = count(craft, all);
    println!(
        "{right} right, {asked} asked, {} wrong of {}",
        wrong.len(),
        all.len()
    );
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(
        right * share.1 >= all.len() * share.0,
        "{right} of {}",
        all.len()
    );
}

/// Tables of mixed conventions: the same ones first, more of them where studies are asked for in full.
fn tables() -> usize {
    super::studies::either(20, 60)
}

#[test]
fn an_airplane_is_read_the_same_in_each_convention_by_itself() {
    let all = Choices::one_by_one();
    check(Craft::Airplane, &all, (19, 20));
}

#[test]
fn an_airplane_is_read_the_same_in_mixed_conventions() {
    let all = Choices::mixed(tables(), false);
    check(Craft::Airplane, &all, (19, 20));
}

#[test]
fn tables_with_few_columns_are_read_right_or_asked_about() {
    let all = Choices::mixed(tables(), true);
    check(Craft::Airplane, &all, (3, 4));
}

#[test]
fn a_copter_that_looks_elsewhere_is_read_right_or_asked_about() {
    let all = Choices::mixed(tables(), false);
    check(Craft::Copter, &all, (3, 4));
}

#[test]
fn what_contradicts_itself_is_a_sentence() {
    let flown = moments(Craft::Airplane);
    let choices = Choices {
        course_header: Some("course_deg"),
        course: written::Angle::Tenths,
        ..Choices::default()
    };
    let (maps, flight) = read(&table(&flown, &choices));
    let findings = maps[0].findings.join("; ");
    assert!(findings.contains("differ by a factor of 10"), "{findings}");
    let north = flight.unwrap();
    let channel = north.channel(ChannelName::GpsVelocityNorth).unwrap();
    assert!(channel.values.iter().all(|v| v.abs() < 40.0));
}

#[test]
fn velocities_along_the_body_are_turned_by_the_attitude() {
    for craft in [Craft::Airplane, Craft::Copter] {
        let flown = moments(craft);
        for velocity in [written::Velocity::Body, written::Velocity::BodyUp] {
            for attitude in [written::Attitude::Euler, written::Attitude::Quaternion] {
                let choices = Choices {
                    velocity,
                    attitude,
                    speed: written::Speed::Centimetres,
                    ..Choices::default()
                };
                let text = table(&flown, &choices);
                let (maps, _) = read(&text);
                let told = maps[0].findings.join("; ");
                assert!(told.contains("along the body's axes"), "{craft:?}: {told}");
                let found = verdict(&text, &flown, &choices);
                assert_eq!(
                    found,
                    ReadingVerdict::Right,
                    "{craft:?} {velocity:?} {attitude:?}"
                );
            }
        }
    }
}

#[test]
fn a_velocity_along_the_body_without_an_attitude_is_refused_with_a_sentence() {
    let flown = moments(Craft::Airplane);
    let choices = Choices {
        velocity: written::Velocity::Body,
        attitude: written::Attitude::None,
        ..Choices::default()
    };
    let (maps, flight) = read(&table(&flown, &choices));
    let told = maps[0].findings.join("; ");
    assert!(
        told.contains("body_vel_x, body_vel_y, body_vel_z: ") && told.contains("not used"),
        "{told}"
    );
    assert!(
        flight
            .unwrap()
            .channel(ChannelName::GpsVelocityNorth)
            .is_none()
    );
}

#[test]
fn columns_without_names_are_told_by_how_their_values_go_together() {
    let flown = moments(Craft::Airplane);
    for (velocity, place) in [
        (written::Velocity::Ned, written::Place::Degrees),
        (written::Velocity::Enu, written::Place::TenMillionths),
    ] {
        let choices = Choices {
            velocity,
            place,
            has_inertial: Some(true),
            airspeed: Some(written::Speed::Metres),
            wind: written::Wind::None,
            ..Choices::default()
        };
        let text = table(&flown, &choices);
        let (_, rows) = text.split_once('\n').unwrap();
        assert_eq!(
            verdict(rows, &flown, &choices),
            ReadingVerdict::Right,
            "{velocity:?}"
        );
        let (maps, _) = read(rows);
        let told = maps[0].findings.join("; ");
        assert!(told.contains("its columns have no names"), "{told}");
    }
}

#[test]
fn numbers_without_names_that_are_no_flight_are_refused_with_a_sentence() {
    use std::fmt::Write as _;
    let mut text = String::new();
    for i in 0..400 {
        let time = 0.1 * f64::from(i);
        let noise = |k: f64| ((k * 12.9898 + time * 78.233).sin() * 43_758.545).fract();
        writeln!(
            text,
            "{time:.1},{:.5},{:.5},{:.5}",
            noise(1.0),
            noise(2.0),
            noise(3.0)
        )
        .unwrap();
    }
    let (maps, flight) = read(&text);
    assert!(flight.is_err());
    let told = maps[0].findings.join("; ");
    assert!(told.contains("write names into its first line"), "{told}");
}
