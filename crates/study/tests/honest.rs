//! Ellipses that hold: of flights that are each judged once, as many end with the truth inside as the ellipse says.

use pilotage_core::training::evaluation::wilson;
use pilotage_study::{Study, StudyPlan};

/// Flights of each cell.
const FLIGHTS: u64 = 100;

/// Sums over the flights of each of the `count` cells of `plan` of `M` measures.
fn sums_by_cell<const M: usize>(plan: &str, count: usize) -> Vec<[f64; M]> {
    let plan = StudyPlan::read(plan).expect("the plan reads");
    let study = Study::new(plan).expect("the scenarios are there");
    let mut sums = vec![[0.0; M]; count];
    for run in 0..study.design().plan().runs() {
        let cell = study.design().run(run).expect("a run of it").cell as usize;
        let row = study.fly(run).expect("its settings make sense");
        for (sum, measured) in sums[cell].iter_mut().zip(row.measured) {
            *sum += measured.expect("it is flown to its end");
        }
    }
    sums
}

/// Asserts of each cell that the share of its flights that end inside of the ellipse of 95 % is that, and that the mean
/// normalized squares of the errors of position, of two degrees of freedom, and of the innovations, for each degree, are
/// near what they must be.
fn assert_honest(name: &str, cells: &str, count: usize) {
    let plan = format!(
        r#"
        name = "{name}"
        question = "Does the ellipse hold?"
        seed = 4711
        draws = {FLIGHTS}
        measure = [{{ of = "inside-95-end" }}, {{ of = "nees" }}, {{ of = "nis" }}]
        fixed.seconds = 60
        fixed.step = 0.25
        fixed.doubts = "no"
        {cells}
        "#
    );
    let sums = sums_by_cell::<3>(&plan, count);
    let flights = FLIGHTS as f64;
    for (cell, [inside, nees, nis]) in sums.into_iter().enumerate() {
        let (low, high) = wilson(inside, flights);
        let (nees, nis) = (nees / flights, nis / flights);
        println!("{name} {cell}: {inside} of {FLIGHTS} inside, NEES {nees:.2}, NIS {nis:.3}");
        assert!((low..=high).contains(&0.95), "{low:.3} to {high:.3}");
        assert!((1.5..2.6).contains(&nees) && (0.9..1.1).contains(&nis));
    }
}

#[test]
fn the_ellipse_of_every_scenario_holds_the_truth_as_often_as_it_says() {
    assert_honest(
        "scenarios",
        r#"cross.scenario = ["distinct-400ft-calm", "distinct-400ft-wind", "distinct-1000ft-extended"]"#,
        3,
    );
}

#[test]
fn the_ellipse_of_every_airplane_model_holds_the_truth_in_winds_that_nobody_told() {
    assert_honest(
        "vehicles",
        r#"
        cross.vehicle = ["airplane-full", "airplane-gust", "airplane-wind"]
        draw.wind-speed = { uniform = [0, 8] }
        draw.wind-from = { uniform = [0, 360] }
        "#,
        3,
    );
}

#[test]
fn sound_instruments_are_seldom_doubted_and_a_late_camera_always() {
    let plan = |cells: &str, draws: u32| {
        format!(
            r#"
            name = "doubts"
            question = "Who is doubted?"
            seed = 4712
            draws = {draws}
            measure = [{{ of = "doubted" }}]
            fixed.seconds = 60
            fixed.step = 0.25
            {cells}
            "#
        )
    };
    let scenarios = r#"cross.scenario = ["distinct-400ft-calm", "distinct-400ft-wind", "distinct-1000ft-extended"]"#;
    let sound = sums_by_cell::<1>(&plan(scenarios, 80), 3);
    let late = r#"
        fixed.scenario = "distinct-400ft-wind"
        fixed.fault-from = 20
        fixed.fault-delay = 1
        fixed.fault = "camera-late"
        "#;
    let late = sums_by_cell::<1>(&plan(late, 20), 1);
    println!("doubted: {sound:?} of 80 sound, {late:?} of 20 late");
    // A camera is thought to be late in one flight of a hundred.
    assert!(sound.iter().all(|[doubted]| *doubted <= 3.0), "{sound:?}");
    assert_eq!(late, [[20.0]]);
}
