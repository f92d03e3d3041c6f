//! Instruments that stand still or fall silent in the air.

use super::series::{LONGEST_GAP, Series, SeriesValue};
use super::statistics::quantile_of_others;
use pilotage_flight::{Finding, Severity, moment};

/// Shortest time for which a sensor that moves shows the same number when it is stuck, seconds.
const STUCK: f64 = 3.0;
/// Times the longest usual stand-still from which on it is unusual.
const UNUSUAL: f64 = 4.0;
/// Fewest samples of a stuck stretch, and fewest other numbers that a sensor must have shown to be one that moves.
const FEWEST: usize = 5;
/// Share of the stand-stills that are usual, and from how many on there are unusual ones among them.
const USUAL: f64 = 0.99;
const MANY: usize = 100;
/// Share of the moments at which a stand-still is usual: those of straight legs are few among those of turns, but last.
const OF_MOMENTS: f64 = 0.9;

/// A stretch with one and the same number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StuckStretch {
    /// Its first sample, seconds.
    pub begin: f64,
    /// From when it could be noticed, seconds.
    pub noticed: f64,
    /// Its last sample, seconds.
    pub end: f64,
}

/// Stretches of `series` in the air with one and the same number: from when it could be noticed to the last
/// sample that shows it, seconds. The stretches in the air follow each other and do not overlap; one of `series` does not go on
/// in the next.
///
/// A sensor read out more often than it measures repeats itself as well, and a coarse one stands still in calm
/// air: what is usual is learnt from the rest of the series.
///
/// ```
/// use pilotage_navigator::instruments::{Series, stuck};
///
/// // Ten samples a second; the last 20 s show one and the same number.
/// let mut airspeed = Series::new();
/// for i in 0..400 {
///     let wags = if i < 200 { 0.1 * f64::from(i % 7) } else { 0.0 };
///     airspeed.push(0.1 * f64::from(i), 18.0 + wags);
/// }
/// let spans = stuck(&airspeed, &[(0.0, 40.0)]);
/// // Noticed after three seconds.
/// assert!(spans.len() == 1 && (spans[0].0 - 23.0).abs() < 0.2 && (spans[0].1 - 39.9).abs() < 1e-9);
/// ```
pub fn stuck(series: &Series, airborne: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let stretches = stuck_stretches(series, airborne).into_iter();
    stretches.map(|s| (s.noticed, s.end)).collect()
}

/// The same stretches with their beginnings.
pub fn stuck_stretches(series: &Series, airborne: &[(f64, f64)]) -> Vec<StuckStretch> {
    let mut runs: Vec<(f64, f64, usize)> = Vec::new();
    let mut last = None;
    for (time, value) in series.iter() {
        let flight = airborne.partition_point(|(_, landed)| *landed < time);
        if airborne.get(flight).is_none_or(|(begun, _)| *begun > time) {
            continue;
        }
        match runs.last_mut() {
            Some(run) if last == Some((flight, value)) => (run.1, run.2) = (time, run.2 + 1),
            _ => runs.push((time, time, 1)),
        }
        last = Some((flight, value));
    }
    if runs.len() <= FEWEST {
        return Vec::new();
    }
    let mut lengths: Vec<(f64, usize)> = runs.iter().map(|run| (run.1 - run.0, run.2)).collect();
    lengths.sort_by(|a, b| a.0.total_cmp(&b.0));
    let sorted: Vec<f64> = lengths.iter().map(|(length, _)| *length).collect();
    // Of few others the longest is usual, too.
    let share = if lengths.len() > MANY { USUAL } else { 1.0 };
    let long = runs
        .iter()
        .filter(|(from, to, count)| to - from >= STUCK && *count >= FEWEST);
    long.filter_map(|(from, to, count)| {
        let usual = quantile_of_others(&sorted, to - from, share);
        let usual = usual.max(usual_at_a_moment(&lengths, (to - from, *count)));
        let longest = (UNUSUAL * usual).max(STUCK);
        (to - from >= longest).then_some(StuckStretch {
            begin: *from,
            noticed: from + longest,
            end: *to,
        })
    })
    .collect()
}

/// Length of the stand-still that a series is in, at most, at a usual moment outside one: by the samples of each. `sorted`
/// are the lengths of all, seconds, and their samples, the shortest first.
fn usual_at_a_moment(sorted: &[(f64, usize)], one: (f64, usize)) -> f64 {
    let all: usize = sorted.iter().map(|(_, count)| count).sum();
    let wanted = OF_MOMENTS * (all - one.1) as f64;
    let mut one = Some(one);
    let mut counted = 0;
    for run in sorted {
        if one == Some(*run) {
            one = None;
            continue;
        }
        counted += run.1;
        if counted as f64 >= wanted {
            return run.0;
        }
    }
    0.0
}

/// Pauses of `series` in the air that are longer than it is held, seconds.
pub fn gaps<T: SeriesValue>(series: &Series<T>, airborne: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut gaps = Vec::new();
    for (from, to) in airborne.iter().copied() {
        let mut last = from;
        let times = series.between(from, to).map(|(time, _)| time);
        for time in times.chain([to]) {
            if time - last > LONGEST_GAP {
                gaps.push((last, time));
            }
            last = time;
        }
    }
    gaps
}

/// Finding on stretches in which an instrument is not used: one note, however many they are.
pub fn stuck_findings(what: &str, spans: &[(f64, f64)]) -> Vec<Finding> {
    let longest = spans
        .iter()
        .max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
    let Some((from, to)) = longest else {
        return Vec::new();
    };
    let more = match spans.len() {
        1 => String::new(),
        n => format!(" So it is {n} times; this is the longest."),
    };
    vec![Finding {
        severity: Severity::Warning,
        title: format!("{what} is stuck"),
        text: format!(
            "It shows one and the same number until {} and is refused from {} on, when that could be noticed.{more}",
            moment(*to),
            moment(*from)
        ),
        span: Some((*from, *to)),
    }]
}

/// Finding on pauses: the longest of them, with their number.
pub fn gap_findings(what: &str, spans: &[(f64, f64)]) -> Vec<Finding> {
    let longest = spans
        .iter()
        .max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
    let Some((from, to)) = longest else {
        return Vec::new();
    };
    let all: f64 = spans.iter().map(|(from, to)| to - from).sum();
    let more = match spans.len() {
        1 => String::new(),
        n => format!(" {n} pauses in the air take {all:.1} s together."),
    };
    vec![Finding {
        severity: Severity::Warning,
        title: format!("{what} is missing for {:.1} s in the air", to - from),
        text: format!(
            "There is no sample between {} and {}.{more}",
            moment(*from),
            moment(*to)
        ),
        span: Some((*from, *to)),
    }]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(value: impl Fn(f64) -> f64) -> Series {
        let mut series = Series::new();
        for i in 0..600 {
            let time = 0.1 * f64::from(i);
            series.push(time, value(time));
        }
        series
    }

    #[test]
    fn a_number_that_stays_is_refused_once_that_can_be_noticed() {
        let stays = |t: f64| {
            if (20.0..32.0).contains(&t) {
                17.0
            } else {
                18.0 + t.sin()
            }
        };
        let spans = stuck(&series(stays), &[(0.0, 60.0)]);
        assert_eq!(spans.len(), 1);
        assert!((spans[0].0 - 23.0).abs() < 0.11 && (spans[0].1 - 31.9).abs() < 0.11);
        assert_eq!(stuck(&series(stays), &[(0.0, 20.0), (40.0, 60.0)]), []);
    }

    #[test]
    fn a_rare_sensor_that_sticks_early_is_noticed_and_legs_of_a_survey_are_not() {
        let every_second = |last: u32, value: &dyn Fn(f64) -> f64| {
            let mut series = Series::new();
            for time in (0..last).map(f64::from) {
                series.push(time, value(time));
            }
            stuck(&series, &[(0.0, f64::from(last))])
        };
        let sticks = |t: f64| if t < 60.0 { 18.0 + t.sin() } else { 11.0 };
        assert_eq!(every_second(660, &sticks), [(63.0, 659.0)]);
        // A heading in whole degrees on legs of a minute, with turns between them.
        let legs = |t: f64| {
            let (leg, within) = ((t / 70.0).floor(), t % 70.0);
            180.0 * (leg % 2.0) + 18.0 * (within - 60.0).max(0.0)
        };
        assert_eq!(every_second(280, &legs), []);
        // Nothing is known of one that never moved.
        assert_eq!(every_second(100, &|_| 11.0), []);
    }

    #[test]
    fn legs_are_usual_though_few_among_the_readings_of_turns() {
        // A velocity in coarse steps: it stands on legs of half a minute, and wags in turns of twenty seconds.
        let legs = |t: f64| if t % 50.0 < 30.0 { 5.0 } else { t.sin() };
        let mut series = Series::new();
        for i in 0..1500 {
            let time = 0.1 * f64::from(i);
            series.push(time, legs(time));
        }
        assert_eq!(stuck(&series, &[(0.0, 150.0)]), []);
    }

    #[test]
    fn a_number_that_is_the_same_after_a_landing_did_not_stand_still_in_the_air() {
        let rests = |t: f64| {
            if (18.0..42.0).contains(&t) {
                17.0
            } else {
                18.0 + t.sin()
            }
        };
        assert_eq!(stuck(&series(rests), &[(0.0, 20.0), (40.0, 60.0)]), []);
    }

    #[test]
    fn a_sensor_that_is_read_out_too_often_is_not_stuck() {
        let held = |t: f64| (t / 2.0).floor().sin();
        assert_eq!(stuck(&series(held), &[(0.0, 60.0)]), []);
    }

    #[test]
    fn pauses_count_in_the_air_only() {
        let with_pause = series(|t| t).without(&[(10.0, 15.0), (40.0, 42.0)]);
        let found = gaps(&with_pause, &[(5.0, 30.0)]);
        assert_eq!(found.len(), 1);
        let title = &gap_findings("Airspeed", &found)[0].title;
        assert_eq!(title, "Airspeed is missing for 5.2 s in the air");
    }
}
