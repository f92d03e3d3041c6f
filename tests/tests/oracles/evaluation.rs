//! The evaluation of detectors against scikit-learn, and Wilson's interval against `SciPy`.

use nalgebra::{Matrix2, Vector2};
use pilotage_core::training::evaluation::{
    CurveKind, EvaluatedLook, EvaluatedMark, Isotonic, JudgedMark, Probability, RobustFit,
    average_precision, brier_score, log_loss, trace, wilson,
};
use pilotage_tests::oracle::ask;
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Question {
    roc: Scores,
    froc: Scores,
    marks: Marks,
    found: usize,
    present: usize,
    wilson: Vec<[usize; 2]>,
    isotonic: Samples,
    logistic_at: Vec<f64>,
    points: Vec<[f64; 2]>,
    stated: Vec<f64>,
    came_true: Vec<bool>,
}

#[derive(Serialize)]
struct Scores {
    right: Vec<f64>,
    wrong: Vec<f64>,
    looks: usize,
    present: usize,
}

#[derive(Serialize)]
struct Marks {
    scores: Vec<f64>,
    right: Vec<bool>,
}

#[derive(Serialize)]
struct Samples {
    samples: Vec<[f64; 3]>,
    at: Vec<f64>,
}

#[derive(Deserialize)]
struct Answer {
    roc: Vec<[f64; 3]>,
    froc: Vec<[f64; 3]>,
    precision_recall: Vec<[f64; 3]>,
    average_precision: f64,
    wilson: Vec<[f64; 2]>,
    isotonic: Vec<f64>,
    logistic: Vec<f64>,
    covariance: Covariance,
    brier: f64,
    log_loss: f64,
}

#[derive(Deserialize)]
struct Covariance {
    location: [f64; 2],
    covariance: [[f64; 2]; 2],
}

/// Even numbers between 0 and 1, and normal ones.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = (self.0)
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.next()).sum::<f64>() - 6.0
    }
}

/// Looks with up to five wrong marks and often the landmark; scores to two decimals, so that many are
/// equal.
fn looks(random: &mut Random) -> Vec<EvaluatedLook> {
    let mark = |score: f64, right| EvaluatedMark {
        score: (score * 100.0).round() / 100.0,
        offset: [0.0, 0.0],
        right,
        rotation: 0.0,
        log_scale: 0.0,
    };
    (0..400)
        .map(|i| {
            let wrong = (5.9 * random.next()) as usize;
            let mut marks: Vec<_> = (0..wrong).map(|_| mark(random.normal(), false)).collect();
            let present = i % 4 != 0;
            if present && random.next() < 0.93 {
                marks.push(mark(2.0 + random.normal(), true));
            }
            EvaluatedLook {
                day: i / 40,
                height: 100.0,
                tilt: 0.0,
                heading_error: 0.0,
                log_scale: 0.0,
                real: false,
                present,
                marks,
            }
        })
        .collect()
}

/// Largest difference of two lists of numbers.
fn apart(ours: &[f64], theirs: &[f64]) -> f64 {
    assert_eq!(ours.len(), theirs.len());
    let differences = ours.iter().zip(theirs).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

fn question(looks: &[EvaluatedLook], random: &mut Random) -> Question {
    let present = looks.iter().filter(|l| l.present).count();
    let right: Vec<f64> = looks.iter().filter_map(EvaluatedLook::found_at).collect();
    let wrong = looks.iter().flat_map(EvaluatedLook::wrong_marks);
    let wrong: Vec<f64> = wrong.map(|m| m.score).collect();
    let scores = |wrong: Vec<f64>| Scores {
        right: right.clone(),
        wrong,
        looks: looks.len(),
        present,
    };
    let marks = Marks {
        scores: [right.clone(), wrong.clone()].concat(),
        right: [vec![true; right.len()], vec![false; wrong.len()]].concat(),
    };
    let samples: Vec<_> = (0..300)
        .map(|i| {
            let x = (random.next() * 50.0).round() / 10.0;
            [x, x + 2.0 * random.normal(), f64::from(1 + i % 3)]
        })
        .collect();
    Question {
        roc: scores(
            looks
                .iter()
                .filter_map(EvaluatedLook::deceived_at)
                .collect(),
        ),
        froc: scores(wrong.clone()),
        found: right.len(),
        present,
        wilson: vec![[0, 7], [3, 7], [7, 7], [196, 200], [18, 18], [1, 10_000]],
        isotonic: Samples {
            samples,
            at: (-5..65).map(|i| 0.09 * f64::from(i)).collect(),
        },
        logistic_at: (-30..60).map(|i| 0.1 * f64::from(i)).collect(),
        points: (0..500)
            .map(|i| {
                let (a, b) = (random.normal(), random.normal());
                let stray = if i % 5 == 0 { 9.0 } else { 0.0 };
                [0.5 + 1.3 * a + stray, -0.2 + 0.6 * a + 0.7 * b - stray]
            })
            .collect(),
        stated: (0..100).map(|_| 0.02 + 0.96 * random.next()).collect(),
        came_true: (0..100).map(|i| i % 3 == 0).collect(),
        marks,
    }
}

#[test]
fn curves_intervals_calibration_and_covariance_are_those_of_scikit_learn() {
    let mut random = Random(11);
    let looks = looks(&mut random);
    let question = question(&looks, &mut random);
    let Some(answer) = ask::<_, Answer>("sklearn_evaluation.py", &question) else {
        return;
    };

    let flat = |steps: &[[f64; 3]]| steps.concat();
    let ours = |kind| flat(&trace(&looks, kind));
    let roc = apart(&ours(CurveKind::Roc), &flat(&answer.roc));
    let froc = apart(&ours(CurveKind::Froc), &flat(&answer.froc));
    // Theirs ends where the recall does.
    let precision = ours(CurveKind::PrecisionRecall);
    let theirs = flat(&answer.precision_recall);
    let precision = apart(&precision[..theirs.len()], &theirs);
    let mean = (average_precision(&looks) - answer.average_precision).abs();
    println!(
        "{} steps of ROC, {} of FROC, {} of precision: apart {roc:.1e}, {froc:.1e}, {precision:.1e}; \
         average precision {mean:.1e}",
        answer.roc.len(),
        answer.froc.len(),
        answer.precision_recall.len()
    );
    assert!(roc < 1e-12 && froc < 1e-12 && precision < 1e-12 && mean < 1e-12);

    let intervals = question.wilson.iter().flat_map(|pair| {
        let (low, high) = wilson(pair[0] as f64, pair[1] as f64);
        [low, high]
    });
    let interval = apart(&intervals.collect::<Vec<_>>(), &answer.wilson.concat());
    let isotonic = Isotonic::rising(&question.isotonic.samples);
    let isotonic: Vec<f64> = question
        .isotonic
        .at
        .iter()
        .map(|x| isotonic.at(*x))
        .collect();
    let isotonic = apart(&isotonic, &answer.isotonic);
    let judged = question.marks.scores.iter().zip(&question.marks.right);
    let judged: Vec<JudgedMark> = judged
        .map(|(&score, &right)| JudgedMark { score, right })
        .collect();
    let logistic = Probability::logistic(&judged);
    let logistic: Vec<f64> = (question.logistic_at.iter())
        .map(|score| logistic.at(*score))
        .collect();
    let logistic = apart(&logistic, &answer.logistic);
    let brier = (brier_score(&question.stated, &question.came_true) - answer.brier).abs();
    let loss = (log_loss(&question.stated, &question.came_true) - answer.log_loss).abs();
    println!(
        "apart: Wilson {interval:.1e}, isotonic {isotonic:.1e}, logistic {logistic:.1e}, Brier {brier:.1e}, \
         log loss {loss:.1e}"
    );
    assert!(interval < 1e-12 && isotonic < 1e-12 && brier < 1e-12 && loss < 1e-12);
    assert!(logistic < 1e-5);

    let points: Vec<Vector2<f64>> = question.points.iter().map(|p| (*p).into()).collect();
    let fit = RobustFit::of(&points, 1).expect("500 points do not lie on a line");
    let [[a, b], [c, d]] = answer.covariance.covariance;
    let theirs = Matrix2::new(a, b, c, d);
    let covariance = (fit.covariance - theirs).norm() / theirs.norm();
    let location = (fit.mean - Vector2::from(answer.covariance.location)).norm();
    println!(
        "covariance apart {:.1} %, centre {location:.3} m",
        100.0 * covariance
    );
    assert!(covariance < 0.12 && location < 0.05);
}
