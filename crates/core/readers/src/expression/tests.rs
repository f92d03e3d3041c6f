use approx::assert_abs_diff_eq;
use proptest::prelude::*;

use super::*;
use crate::log::{FieldKind, FieldLayout, Log, LogFormat, TopicName};

/// Ten seconds: `A.t` at every second is the time, `A.yaw` a heading that passes north, `B.x` twice as often is
/// the square of time from second 2 to 8, `Odd} name` a one.
struct Fixed;

fn fixed(name: &str) -> Option<TimedSamples> {
    let seconds = (0..=10).map(f64::from);
    let halves = (4..=16).map(|i| 0.5 * f64::from(i));
    Some(match name {
        "A.t" => TimedSamples::new(seconds.map(|t| (t, t)), "m"),
        "A.yaw" => TimedSamples::new(seconds.map(|t| (t, (340.0 + 5.0 * t) % 360.0)), "deg"),
        "B.x" => TimedSamples::new(halves.map(|t| (t, t * t)), "m/s"),
        "Odd} name" => TimedSamples::new(seconds.map(|t| (t, 1.0)), ""),
        _ => return None,
    })
}

impl SeriesSource for Fixed {
    fn samples(&self, name: &str) -> Option<TimedSamples> {
        fixed(name)
    }
    fn names(&self) -> Vec<String> {
        ["A.t", "A.yaw", "B.x", "Odd} name"]
            .map(str::to_owned)
            .to_vec()
    }
}

fn samples(text: &str) -> TimedSamples {
    let expression = Expression::parse(text).unwrap_or_else(|e| panic!("{text}: {e}"));
    expression
        .evaluate(&Fixed)
        .unwrap_or_else(|e| panic!("{text}: {e}"))
}

/// The value at second 3 of a text.
fn at_three(text: &str) -> f64 {
    let found = samples(text);
    let index = found
        .times
        .iter()
        .position(|t| *t == 3.0)
        .expect("second 3");
    found.values[index]
}

fn trouble(text: &str) -> (std::ops::Range<usize>, String) {
    let error = Expression::parse(text).and_then(|e| e.evaluate(&Fixed).map(|_| ()));
    let error = error.expect_err(text);
    (error.place, error.trouble.to_string())
}

#[test]
fn operators_bind_as_in_mathematics() {
    for (text, expected) in [
        ("A.t + 2 * 3", 9.0),
        ("(A.t + 2) * 3", 15.0),
        ("2 ^ A.t ^ 2", 512.0),
        ("-A.t ^ 2", -9.0),
        ("2 ^ -A.t", 0.125),
        ("12 - A.t - 4", 5.0),
        ("12 / A.t / 4", 1.0),
        ("-A.t % 5", 2.0),
        ("A.t × 2 − 1", 5.0),
        ("A.t > 2 + 0.5", 1.0),
        ("A.t * 2 == 7", 0.0),
        ("1.5e1 + .5 + A.t * 0", 15.5),
        ("--A.t", 3.0),
    ] {
        assert_eq!(at_three(text), expected, "{text}");
    }
}

#[test]
fn functions_are_those_of_mathematics() {
    for (text, expected) in [
        ("sin(rad(A.t * 10))", 0.5),
        ("deg(atan2(A.t, 3))", 45.0),
        ("hypot(A.t, 4)", 5.0),
        ("hypot(A.t, 4, 12)", 13.0),
        ("min(A.t, 5, 2) + max(A.t, 1)", 5.0),
        ("wrap180(A.t + 187)", -170.0),
        ("wrap360(A.t - 13)", 350.0),
        ("sqrt(A.t + 1) + abs(-2) + log(exp(A.t))", 7.0),
        ("cos(pi * A.t)", -1.0),
    ] {
        assert_abs_diff_eq!(at_three(text), expected, epsilon = 1e-12);
    }
}

#[test]
fn the_first_series_gives_the_times_and_the_others_follow() {
    let slow = samples("A.t - B.x");
    assert_eq!(slow.times.len(), 11);
    assert!(slow.values[1].is_nan() && slow.values[9].is_nan());
    assert_eq!(
        slow.values[2..=8],
        [2, 3, 4, 5, 6, 7, 8].map(|t| f64::from(t - t * t))
    );
    let fast = samples("B.x * 0 + A.t");
    assert_eq!(fast.times, fast.values);
    assert_eq!(fast.times.len(), 13);
}

#[test]
fn a_derivative_is_taken_where_the_series_has_its_samples() {
    let found = samples("A.t * 0 + derivative(B.x)");
    for time in 3..8 {
        assert_abs_diff_eq!(found.values[time], 2.0 * time as f64, epsilon = 1e-12);
    }
    let turning = samples("derivative(A.yaw)");
    assert_eq!(turning.values, [5.0; 11]);
    assert_eq!(turning.unit, "deg/s");
}

#[test]
fn a_series_is_shifted_without_moving_others() {
    let alone = samples("shift(A.t, 0.25)");
    assert_eq!((alone.times[0], alone.values[0]), (0.25, 0.0));
    let beside = samples("A.t - shift(A.t, 2)");
    assert!(beside.values[1].is_nan());
    assert_eq!(beside.values[2..], [2.0; 9]);
    assert_eq!(samples("shift(B.x, -1) * 1").times[0], 1.0);
}

#[test]
fn integrals_and_means_are_over_seconds() {
    assert_eq!(at_three("integral(A.t)"), 4.5);
    assert_eq!(at_three("smooth(A.t ^ 2, 2)"), (4.0 + 9.0 + 16.0) / 3.0);
    // The first of them has its slope from one side only: half a step of it is a little too steep.
    assert_eq!(at_three("integral(derivative(B.x))"), 5.125);
}

#[test]
fn units_are_kept_where_they_hold() {
    for (text, unit) in [
        ("A.t", "m"),
        ("A.t + 1", "m"),
        ("A.t - A.t", "m"),
        ("A.t + B.x", ""),
        ("2 * A.t", ""),
        ("derivative(A.t)", "m/s"),
        ("derivative(derivative(A.t))", "m/s²"),
        ("integral(B.x)", "m"),
        ("integral(A.t)", "m·s"),
        ("rad(A.yaw)", "rad"),
        ("max(A.t, 3)", "m"),
        ("A.t > 3", ""),
    ] {
        assert_eq!(samples(text).unit, unit, "{text}");
    }
}

#[test]
fn any_name_may_stand_in_braces() {
    assert_eq!(at_three("{A.t} + { A.t }"), 6.0);
    assert_eq!(at_three("{Odd}} name}"), 1.0);
    assert_eq!(written("Odd} name"), "{Odd}} name}");
    assert_eq!(written("GPS[1].Spd"), "GPS[1].Spd");
    assert_eq!(written("min"), "{min}");
    let expression = Expression::parse("A.t * {Odd}} name} + A.t").expect("an expression");
    assert_eq!(expression.names(), ["A.t", "Odd} name"]);
}

#[test]
fn errors_name_the_place_and_what_is_missing() {
    for (text, place, words) in [
        (
            "A.t +",
            5..5,
            "a name, a number or `(` is missing at the end",
        ),
        (
            "A.t + * 2",
            6..7,
            "a name, a number or `(` should stand here, not `*`",
        ),
        ("(A.t", 4..4, "`)` or an operator is missing at the end"),
        ("A.t A.t", 4..7, "an operator should stand here, not `A.t`"),
        ("A.t)", 3..4, "an operator should stand here, not `)`"),
        ("A.t $ 2", 4..5, "`$` means nothing here"),
        ("{A.t", 0..1, "this brace is never closed"),
        (
            "A.T + 1",
            0..3,
            "no series is called A.T; did you mean A.t?",
        ),
        (
            "A.t + B.y",
            6..9,
            "no series is called B.y; did you mean B.x?",
        ),
        (
            "sinn(A.t)",
            0..4,
            "no function is called sinn; did you mean sin?",
        ),
        (
            "sin A.t",
            4..7,
            "`(` after a function should stand here, not `A.t`",
        ),
        ("atan2(A.t)", 0..10, "atan2 takes two arguments, not 1"),
        (
            "smooth(A.t, A.t)",
            12..15,
            "a number should stand here, the same for all times",
        ),
        (
            "smooth(A.t, 1 - 1)",
            12..17,
            "this should be more than 0 seconds",
        ),
        ("1 + 2", 0..5, "no series of the log is named"),
        ("", 0..0, "a name, a number or `(` is missing at the end"),
    ] {
        assert_eq!(trouble(text), (place, words.to_owned()), "{text}");
    }
    let error = Expression::parse("A.t + ").expect_err("nothing follows");
    assert!(error.to_string().starts_with("at byte 5: "), "{error}");
}

#[test]
fn names_are_checked_without_the_samples() {
    let expression = Expression::parse("A.t + A.yuw").expect("an expression");
    let names = ["A.t", "A.yaw"];
    let error = expression.check(&names.into_iter()).expect_err("A.yuw");
    assert_eq!(error.place, 6..11);
    assert!(
        error.to_string().ends_with("did you mean A.yaw?"),
        "{error}"
    );
    assert!(expression.check(&["A.t", "A.yuw"].into_iter()).is_ok());
}

#[test]
fn series_of_a_log_are_found_by_topic_instance_and_meaning() {
    let mut log = Log::new("east.log", LogFormat::Dataflash);
    let field = |name: &str| vec![FieldLayout::plain(name, FieldKind::U8, 0)];
    let named = |name: &str, instance| TopicName {
        name: name.to_owned(),
        instance,
    };
    for (name, instance, of, value) in [
        ("GPS", Some(1), "Spd", 7),
        ("a.b", None, "q[0]", 8),
        ("ATT", None, "Roll", 9),
    ] {
        let place = log.topic_or_new(&named(name, instance), || field(of));
        log.topics[place].push(1.0, &[value]);
        log.topics[place].push(2.0, &[value + 1]);
    }
    let first = |text: &str| {
        let expression = Expression::parse(text).expect(text);
        expression.evaluate(&log).map(|found| found.values[0])
    };
    assert_eq!(first("GPS[1].Spd"), Ok(7.0));
    assert_eq!(first("a.b.q[0] + 0"), Ok(8.0));
    assert_eq!(first("{Roll}"), Ok(9.0));
    assert_eq!(first("Roll - ATT.Roll"), Ok(0.0));
    let error = first("GPS.Spd").expect_err("there is only a second receiver");
    assert!(error.to_string().contains("GPS[1].Spd"), "{error}");
}

proptest! {
    #[test]
    fn no_text_makes_it_panic(text in "[-+*/^%<>=!(){}\\[\\]., A-Ct0-9eéμ]{0,40}") {
        if let Ok(expression) = Expression::parse(&text) {
            let _ = expression.evaluate(&Fixed);
        }
        for cursor in 0..=text.len() {
            let _ = complete(&text, cursor, [("A.t", "m")].into_iter());
        }
    }

    #[test]
    fn errors_lie_within_the_text(text in "[-+*/^(){},A.t 1]{0,24}") {
        if let Err(error) = Expression::parse(&text) {
            prop_assert!(text.get(error.place).is_some());
        }
    }

    #[test]
    fn every_name_can_be_written(name in "[^{\\s][^{\n]{0,12}[^{\\s]") {
        let expression = Expression::parse(&written(&name)).expect("a name");
        prop_assert_eq!(expression.names(), [name.as_str()]);
    }
}
