//! A flight along a bent line over four landmarks, and a run that half believes it.

use nalgebra::{DMatrix, DVector, Matrix2, Matrix4, Point2, Point3, Vector2};
use pilotage_core::camera::CameraModel;
use pilotage_core::flight::{Channel, ChannelName, Flight, Frame, StartFix, Truth, TruthState};
use pilotage_core::frames::{Attitude, Geodetic, GroundPoint, GroundRect, Pose};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{
    CandidateReport, Control, Estimate, FrameReport, JointReport, Outcome, Refusal, Run, SigmaSets,
    StepReport, StepTiming,
};
use pilotage_ui::documents::empty_mission;

/// Length of the flight, seconds.
pub const SECONDS: f64 = 60.0;
const STEP: f64 = 0.1;
const HEIGHT: f64 = 120.0;

fn place(time: f64) -> (GroundPoint, f64) {
    let along = 16.0 * time;
    let bend = 90.0 * (time / 14.0).sin();
    let heading = std::f64::consts::FRAC_PI_2 - (90.0 / 14.0 * (time / 14.0).cos()).atan2(16.0);
    (GroundPoint::new(bend, along - 400.0), heading)
}

/// The mission of the invented scenario.
pub fn mission() -> Mission {
    let names = ["Barn", "Chapel", "Pool", "Mill"];
    let landmarks = names.iter().enumerate().map(|(index, name)| {
        let (center, _) = place(8.0 + 13.0 * index as f64);
        let center = GroundPoint::new(center.north + 18.0, center.east);
        Landmark::new(
            index as u32 + 1,
            *name,
            GroundRect::centered(center, 24.0, 30.0),
        )
    });
    Mission {
        name: "Invented".into(),
        landmarks: landmarks.collect(),
        origin: Geodetic::from_degrees(47.0, 8.0, 0.0),
        ..empty_mission()
    }
}

/// The flight, without its pictures.
pub fn flight() -> Flight {
    let times: Vec<f64> = (0..=600).map(|i| 0.1 * f64::from(i)).collect();
    let channel = |name, of: &dyn Fn(f64) -> f64| Channel {
        name,
        times: times.clone(),
        values: times.iter().map(|t| of(*t)).collect(),
    };
    Flight {
        name: "Invented".into(),
        frame_on_globe: None,
        camera: CameraModel::pinhole(640, 480, 0.8),
        ground_down: 0.0,
        channels: vec![
            channel(ChannelName::Airspeed, &|_| 16.0),
            channel(ChannelName::Heading, &|t| place(t).1),
            channel(ChannelName::Roll, &|_| 0.0),
            channel(ChannelName::Pitch, &|_| 0.0),
            channel(ChannelName::HeightAboveGround, &|_| HEIGHT),
        ],
        frames: (0..120)
            .map(|i| Frame {
                time: 0.5 * f64::from(i),
                name: i.to_string(),
                stored_turn: 0.0,
            })
            .collect(),
        start: StartFix {
            time: 0.0,
            position: place(0.0).0,
            standard_deviation: 3.0,
        },
        truth: Some(Truth {
            states: times.iter().map(|t| truth_state(*t)).collect(),
            frames: Vec::new(),
        }),
    }
}

fn truth_state(time: f64) -> TruthState {
    let (p, heading) = place(time);
    TruthState {
        time,
        position: Point3::new(p.north, p.east, -HEIGHT),
        attitude: Some(Attitude::level(heading)),
        wind: Some(Vector2::new(-3.0, 4.0)),
    }
}

/// The head of a run over these landmarks.
pub fn run_head(mission: &Mission) -> Run {
    Run {
        name: "Invented".into(),
        settings: mission.navigator.clone(),
        landmarks: mission.landmarks.clone(),
        state_names: [
            ("north", "m"),
            ("east", "m"),
            ("wind north", "m/s"),
            ("wind east", "m/s"),
        ]
        .map(|(a, b)| (a.to_owned(), b.to_owned()))
        .to_vec(),
        steps: Vec::new(),
    }
}

/// A run with all its steps.
pub fn run(mission: &Mission) -> Run {
    let mut run = run_head(mission);
    let mut variance: f64 = 9.0;
    let mut error = Vector2::new(4.0, -3.0);
    let mut step = 0;
    while f64::from(step) * STEP <= SECONDS {
        let time = f64::from(step) * STEP;
        let report = step_report(mission, time, &mut variance, &mut error, step);
        run.steps.push(report);
        step += 1;
    }
    run
}

fn estimate(at: GroundPoint, variance: f64) -> Estimate {
    Estimate {
        mean: DVector::from_vec(vec![at.north, at.east, -2.5, 3.6]),
        covariance: DMatrix::from_diagonal(&DVector::from_vec(vec![
            variance,
            1.6 * variance,
            0.4,
            0.4,
        ])),
    }
}

fn sigma(of: &Estimate) -> DMatrix<f64> {
    DMatrix::from_fn(4, 9, |row, column| {
        let spread = 2.0 * of.covariance[(row, row)].sqrt();
        let sign = match column {
            c if c == 2 * row + 1 => 1.0,
            c if c == 2 * row + 2 => -1.0,
            _ => 0.0,
        };
        of.mean[row] + sign * spread
    })
}

fn step_report(
    mission: &Mission,
    time: f64,
    variance: &mut f64,
    error: &mut Vector2<f64>,
    index: i32,
) -> StepReport {
    let (truth, heading) = place(time);
    let at = |e: &Vector2<f64>| GroundPoint::new(truth.north + e.x, truth.east + e.y);
    let before = estimate(at(error), *variance);
    *variance += 0.6;
    *error += Vector2::new(0.05, 0.03);
    let predicted = estimate(at(error), *variance);
    let frame = (index % 5 == 0).then(|| frame_report(mission, time, truth, heading));
    let corrected = frame.as_ref().is_some_and(|f| f.joint.is_some());
    if corrected {
        *variance = 0.35 * *variance + 1.0;
        *error *= 0.4;
    }
    let after = estimate(at(error), *variance);
    let drift = 0.9 * time;
    StepReport {
        time,
        dt: STEP,
        control: Control {
            airspeed: Some(16.0),
            heading,
            roll: 0.0,
            pitch: 0.0,
            height: HEIGHT,
        },
        sigma: SigmaSets {
            before_predict: sigma(&before),
            after_predict: sigma(&predicted),
            before_correct: corrected.then(|| sigma(&predicted)),
            after_correct: corrected.then(|| sigma(&after)),
        },
        before,
        predicted,
        after,
        doubts: Vec::new(),
        dead_reckoned: GroundPoint::new(truth.north + drift, truth.east - 0.6 * drift),
        frame,
        timing: StepTiming::default(),
        updates: Vec::new(),
        sightings: Vec::new(),
    }
}

fn frame_report(mission: &Mission, time: f64, truth: GroundPoint, heading: f64) -> FrameReport {
    let near = mission
        .landmarks
        .iter()
        .filter(|l| l.enabled && l.reference.distance(&truth) < 70.0);
    let candidates: Vec<CandidateReport> = near.map(|l| candidate(l, time)).collect();
    let accepted = candidates
        .iter()
        .filter(|c| c.outcome == Outcome::Accepted)
        .count();
    let (sin, cos) = heading.sin_cos();
    let corner = |ahead: f64, right: f64| {
        GroundPoint::new(
            truth.north + ahead * cos - right * sin,
            truth.east + ahead * sin + right * cos,
        )
    };
    FrameReport {
        index: (2.0 * time).round() as usize,
        assumed_pose: Pose {
            position_in_world: Point3::new(truth.north, truth.east, -HEIGHT),
            attitude: Attitude::level(heading),
        },
        footprint: vec![
            corner(38.0, -51.0),
            corner(38.0, 51.0),
            corner(-38.0, 51.0),
            corner(-38.0, -51.0),
        ],
        joint: (accepted > 0).then(|| JointReport {
            nis: 1.4,
            degrees_of_freedom: 4 * accepted,
            threshold: 11.0,
            gain: DMatrix::zeros(4, 4 * accepted),
            innovation: DVector::zeros(4 * accepted),
            innovation_covariance: DMatrix::identity(4 * accepted, 4 * accepted),
            recovered: None,
        }),
        candidates,
        laid: None,
        trouble: None,
    }
}

fn candidate(landmark: &Landmark, time: f64) -> CandidateReport {
    let refused = (2.0 * time) as i64 % 4 == 0;
    CandidateReport {
        landmark: landmark.id,
        predicted_pixel: Point2::new(300.0, 220.0),
        innovation_covariance: Matrix2::new(90.0, 20.0, 20.0, 60.0),
        search_region: landmark.bounds.grown(15.0),
        search_outline: vec![
            Point2::new(220.0, 150.0),
            Point2::new(400.0, 150.0),
            Point2::new(400.0, 300.0),
            Point2::new(220.0, 300.0),
        ],
        measured_pixel: Some(Point2::new(306.0, 226.0)),
        measurement_covariance: Some(Matrix4::identity()),
        rotation: Some(0.01),
        log_scale: Some(0.0),
        score: if refused { 0.38 } else { 0.83 },
        second_score: 0.31,
        probability: None,
        turn_and_size: [0.02, 0.01],
        innovation: Some(Vector2::new(6.0, 6.0)),
        nis: Some(1.1),
        threshold: 11.6,
        outcome: if refused {
            Outcome::Refused(Refusal::LowScore)
        } else {
            Outcome::Accepted
        },
    }
}
