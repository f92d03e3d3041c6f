//! Intervals of few flights, and of flights that are all alike: nothing is claimed that they do not tell.

use pilotage_core::training::evaluation::wilson;
use pilotage_study::{
    IntervalBy, MeanSummary, StudyDesign, StudyPlan, StudyRecord, StudyRow, StudySummary,
    StudyTally,
};

fn design(more: &str) -> StudyDesign {
    let plan = format!(
        r#"
        name = "few"
        question = "?"
        draws = 64
        {more}
        draw.wind-speed = {{ uniform = [0, 8] }}
        measure = [{{ of = "error-rms" }}, {{ of = "error-max", name = "near", at_most = 1 }}]
        "#
    );
    StudyDesign::new(StudyPlan::read(&plan).expect("the plan reads"))
}

/// Summary of the first `draws` draws, until it is enough, with these numbers by draw.
fn summary(design: &StudyDesign, draws: u64, measured: impl Fn(u64) -> [f64; 2]) -> StudySummary {
    let mut tally = StudyTally::new(design);
    for run in 0..draws {
        let measured = measured(run).map(Some).to_vec();
        tally.take(StudyRow { run, measured }).expect("in order");
    }
    tally.summary()
}

fn mean(summary: &StudySummary, measure: usize) -> MeanSummary {
    let measure = &summary.cells[0].measures[measure];
    measure.mean.clone().expect("there are numbers")
}

#[test]
fn flights_that_are_all_alike_do_not_end_a_study() {
    let stop = |measure: &str, width: f64| {
        format!("stop = {{ measure = \"{measure}\", half_width = {width}, every = 16 }}")
    };
    for by in ["", "draw_by = \"sobol\"\n"] {
        for (measure, width) in [("error-rms", 100.0), ("near", 0.01)] {
            let design = design(&format!("{by}{}", stop(measure, width)));
            let all = summary(&design, 64, |_| [3.0, 0.0]);
            assert_eq!((all.draws, all.is_stopped), (64, false), "{by}{measure}");
            assert_eq!(mean(&all, 0).interval, None, "{by}");
            // No flight of 64: up to 5.7 % of all by Wilson's interval, however they were drawn.
            let near = mean(&all, 1);
            assert_eq!(near.interval_by, IntervalBy::Wilson, "{by}");
            let (low, high) = wilson(0.0, 64.0);
            assert_eq!(near.interval, Some([low, high]), "{by}");
            assert!((high - 0.0566).abs() < 1e-3);
        }
        // By Wilson's interval it is narrow enough once it is so.
        let design = design(&format!("{by}{}", stop("near", 0.04)));
        let enough = summary(&design, 64, |_| [3.0, 0.0]);
        assert!(enough.is_stopped && enough.draws == 48, "{}", enough.draws);
    }
}

#[test]
fn the_interval_of_a_share_by_scrambles_is_one_of_shares() {
    let design = design("draw_by = \"sobol\"");
    let all = summary(&design, 64, |draw| {
        [draw as f64, f64::from(u8::from(draw == 5))]
    });
    let near = mean(&all, 1);
    assert_eq!(near.interval_by, IntervalBy::Scrambles);
    let [low, high] = near.interval.expect("scrambles differ");
    assert!(low == 0.0 && (0.03..0.06).contains(&high), "{low} {high}");
    let text = all.table();
    assert!(
        text.contains("Student's, of the means of scrambles.\n"),
        "{text}"
    );
    let none = summary(&design, 64, |draw| [draw as f64, 0.0]);
    let text = none.table();
    assert!(
        text.contains("Wilson's of shares that are the same in all"),
        "{text}"
    );
}

#[test]
fn quantiles_that_few_flights_do_not_bound_have_no_interval() {
    let design = design("");
    let few = summary(&design, 64, |draw| [draw as f64 + 1.0, 0.0]);
    let bounded: Vec<f64> = few.cells[0].measures[0]
        .quantiles
        .iter()
        .filter(|quantile| quantile.interval.is_some())
        .map(|quantile| quantile.share)
        .collect();
    // 1.96 deviations of the ranks of 64: 0.5 ± 0.12, 0.25 ± 0.11, 0.05 ± 0.053.
    assert_eq!(bounded, [0.25, 0.5, 0.75]);
    let json = serde_json::to_value(&few).expect("it is written");
    let quantiles = &json["cells"][0]["measures"][0]["quantiles"];
    assert!(quantiles[0].get("interval").is_none() && quantiles[3].get("interval").is_some());
    let said = "Not enough flights for an interval of the 95 % quantile of error-rms.\n";
    assert!(few.table().ends_with(said), "{}", few.table());
    assert!(!few.table().contains("of the median"));
}

/// Summary of 64 draws in two cells, of which the second has numbers in the first `has` draws only, with the lines of its record.
fn of_two(stop: &str, has: u64) -> StudySummary {
    let design = design(&format!(
        "cross.vehicle = [\"airplane-wind\", \"airplane-full\"]\n{stop}"
    ));
    let mut tally = StudyTally::new(&design);
    for run in 0..128 {
        let number = |value: f64| (run % 2 == 0 || run / 2 < has).then_some(value);
        let measured = vec![number(run as f64), number(f64::from(u8::from(run < 60)))];
        tally.take(StudyRow { run, measured }).expect("in order");
    }
    tally.summary()
}

#[test]
fn a_setting_that_yields_no_number_does_not_hide_and_says_why_the_rule_did_not_end_the_study() {
    let stop = "stop = { measure = \"near\", half_width = 0.2, every = 16 }";
    let none = of_two(stop, 0);
    assert_eq!((none.draws, none.is_stopped), (64, false));
    let table = none.table();
    assert!(
        table.contains("Flights without a number of near: 64 of 64 of vehicle airplane-full.\n"),
        "{table}"
    );
    let said = "The rule to stop did not end it: near was to be known to ± 0.200 in every cell: \
                vehicle airplane-full; no flight has a number of it.\n";
    assert!(table.ends_with(said), "{table}");
    let record = StudyRecord {
        made: "today".to_owned(),
        plan: design("").plan().clone(),
        summary: none,
        first: Vec::new(),
    };
    let lines = record.lines();
    assert!(
        lines.contains("near - of 0 flights |") && !lines.contains("of 64"),
        "{lines}"
    );
    // Numbers of some flights are too wide, or too few.
    let wide = of_two(stop, 5).not_enough.expect("it was not enough");
    assert!(wide.contains("its interval is ± 0."), "{wide}");
    let few = of_two(&stop.replace("near", "error-rms"), 5);
    let few = few.not_enough.expect("it was not enough");
    assert!(
        few.contains("its numbers are too few or all alike"),
        "{few}"
    );
    // Who meets the rule, or has none, needs no reason.
    let met = of_two(stop, 64);
    assert!(met.is_stopped && met.not_enough.is_none() && !met.table().contains("did not end"));
    assert_eq!(of_two("", 0).not_enough, None);
}

#[test]
fn an_interval_that_narrows_after_the_last_look_is_not_called_too_wide() {
    let said = |every: u64| {
        let stop = format!("stop = {{ measure = \"near\", half_width = 0.125, every = {every} }}");
        of_two(&stop, 64).not_enough
    };
    let known = "near was to be known to ± 0.125 in every cell: vehicle airplane-wind; it is, to ± 0.119, but it";
    let late = format!("{known} was not when it was last looked at, after 48 draws");
    assert_eq!(said(48), Some(late));
    let never = format!("{known} would first have been looked at after 80 draws");
    assert_eq!(said(80), Some(never));
    assert_eq!(said(32), None);
}
