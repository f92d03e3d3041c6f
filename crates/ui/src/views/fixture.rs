//! A plausible flight and run for tests: a linearised filter flies past five landmarks.

use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::io::Cursor;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Matrix2, Matrix2x4, Matrix4, Point3, Vector2, Vector4, dvector};
use pilotage_core::camera::CameraModel;
use pilotage_core::flight::{Flight, Frame, StartFix, Truth, TruthState};
use pilotage_core::frames::{Attitude, Geodetic, GroundPoint, GroundRect, Pose};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{
    CandidateReport, Control, Estimate, FrameReport, JointReport, KnownReport, NavigatorSettings,
    Outcome, PairReport, Refusal, Run, SeenReport, SightedKind, SightingReport, SigmaSets,
    StepReport, StepTiming, UpdateReport,
};
use pilotage_core::raster::Gray;
use pilotage_core::reference::GenericClass;
use pilotage_core::roads::SharedRoads;

use pilotage_jobs::MatchPictures;

use crate::command::Command;
use crate::context::ViewContext;
use crate::tokens::Tokens;
use crate::units::Units;

/// Seconds between steps, and steps between frames.
const STEP: f64 = 0.05;
const STEPS_PER_FRAME: usize = 10;
const AIRSPEED: f64 = 15.0;
const HEIGHT: f64 = 122.0;
/// Standard deviation of a landmark's measured turn and log scale.
const TURN_SIGMA: f64 = 0.01;
/// Gate for four degrees of freedom at 99.7 %.
const THRESHOLD: f64 = 16.0;

/// Jacobian and innovation of a landmark's pixel, the variance of its noise, and its measured turn
/// and log scale.
type Row = (Matrix2x4<f64>, Vector2<f64>, f64, [f64; 2]);

/// A flight, its mission and a finished run.
pub(crate) struct Fixture {
    pub mission: Mission,
    pub flight: Flight,
    pub run: Run,
    pictures: RefCell<HashMap<usize, Arc<[u8]>>>,
}

/// Uniform numbers in [-1, 1] from a seed (a linear congruential generator).
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// About Gaussian with standard deviation 1.
    fn gaussian(&mut self) -> f64 {
        (0..12).map(|_| self.next()).sum::<f64>() * 0.5
    }
}

fn landmarks() -> Vec<Landmark> {
    [
        ("Church", 120.0, 150.0),
        ("Factory", 20.0, 300.0),
        ("Barn", -80.0, 460.0),
        ("School", -170.0, 640.0),
        ("Pool", 240.0, 815.0),
    ]
    .into_iter()
    .enumerate()
    .map(|(i, (name, north, east))| {
        let bounds = GroundRect::centered(GroundPoint::new(north, east), 24.0, 24.0);
        Landmark::new(i as u32 + 1, name, bounds)
    })
    .collect()
}

fn heading(time: f64) -> f64 {
    let turn = ((time - 50.0) / 10.0).clamp(0.0, 1.0);
    (120.0 - 75.0 * turn).to_radians()
}

/// A reading of GPS whose innovation lay so far off, taken in if it has a gain.
pub(crate) fn reading_of_gps(nis: f64, gain: Option<DMatrix<f64>>) -> UpdateReport {
    UpdateReport {
        aid: "gps-position".to_owned(),
        measured: dvector![1.0, 2.0],
        innovation: dvector![0.5, 0.5],
        innovation_covariance: DMatrix::identity(2, 2),
        nis,
        degrees_of_freedom: 2,
        threshold: 11.6,
        gain,
    }
}

/// Report of an aid: a building that was used, a tree that is too unsure, and two things without a partner.
pub(crate) fn sighting() -> SightingReport {
    let kind = |class| SightedKind::Landmark(class);
    let seen = |class, at: f64, size, similar, pair: Option<(usize, f64)>| SeenReport {
        kind: kind(class),
        pixel: nalgebra::Point2::new(10.0 * at, 100.0),
        place: GroundPoint::new(at, 2.0),
        size,
        similar,
        pair: pair.map(|(known, probability)| PairReport {
            known,
            probability: Some(probability),
            accepted: probability > 0.9,
        }),
    };
    let known = |class, at: f64, size| KnownReport {
        kind: kind(class),
        place: GroundPoint::new(at, 0.0),
        size,
    };
    SightingReport {
        aid: "generic-landmarks".to_owned(),
        seen: vec![
            seen(GenericClass::Building, 10.0, 14.0, 2, Some((0, 0.98))),
            seen(GenericClass::Tree, 20.0, 6.0, 5, Some((1, 0.41))),
            seen(GenericClass::Water, 30.0, 30.0, 3, None),
            seen(GenericClass::Parking, 40.0, 20.0, 0, None),
        ],
        known: vec![
            known(GenericClass::Building, 11.0, 14.5),
            known(GenericClass::Tree, 21.0, 6.5),
        ],
        probability: Some(0.997),
    }
}

fn sigma_points(mean: &Vector4<f64>, covariance: &Matrix4<f64>) -> DMatrix<f64> {
    let root = covariance.cholesky().map_or_else(Matrix4::zeros, |c| c.l()) * 2.0;
    DMatrix::from_fn(4, 9, |row, column| match column {
        0 => mean[row],
        1..=4 => mean[row] + root[(row, column - 1)],
        _ => mean[row] - root[(row, column - 5)],
    })
}

fn estimate(mean: &Vector4<f64>, covariance: &Matrix4<f64>) -> Estimate {
    Estimate {
        mean: DVector::from_column_slice(mean.as_slice()),
        covariance: DMatrix::from_fn(4, 4, |r, c| covariance[(r, c)]),
    }
}

impl Fixture {
    /// Context of a view at a time of the flight, seconds, without pictures.
    pub fn context<'a>(&'a self, time: f64, commands: &'a mut Vec<Command>) -> ViewContext<'a> {
        ViewContext {
            mission: &self.mission,
            flight: Some(&self.flight),
            run: Some(&self.run),
            ghost: None,
            time,
            is_recorded: false,
            clock_zero: 0.0,
            motion: 0.0,
            selected_span: None,
            playing: false,
            selection: None,
            route: None,
            pictures: &|_| None,
            tokens: Tokens::over_imagery(),
            units: Units::Metric,
            flying: None,
            commands,
        }
    }

    /// Ninety seconds with a correction twice a second at the start, a gap, and a pool at the end.
    pub fn new() -> Self {
        Self::lasting(90.0)
    }

    /// The same, `seconds` long.
    pub fn lasting(seconds: f64) -> Self {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let settings = NavigatorSettings::default();
        let mut flight = Self::flight(camera.clone(), seconds);
        let mut run = Run {
            name: "Fixture".to_owned(),
            settings: settings.clone(),
            landmarks: landmarks(),
            state_names: [
                ("north", "m"),
                ("east", "m"),
                ("wind north", "m/s"),
                ("wind east", "m/s"),
            ]
            .map(|(n, u)| (n.to_owned(), u.to_owned()))
            .to_vec(),
            steps: Vec::new(),
        };
        let mut flier = Flier::new();
        for number in 1..=(seconds / STEP).round() as usize {
            let step = flier.step(number, &camera, &mut flight, &run.landmarks);
            run.steps.push(step);
        }
        let mission = Mission {
            name: "Fixture".to_owned(),
            origin: Geodetic {
                latitude: 0.7,
                longitude: -1.3,
                height: 0.0,
            },
            map: None,
            landmarks: landmarks(),
            routes: Vec::new(),
            no_fly: Vec::new(),
            rally: Vec::new(),
            roads: SharedRoads::default(),
            labels: Vec::new(),
            camera: None,
            camera_to_log: None,
            navigator: settings,
            properties: BTreeMap::new(),
        };
        Self {
            mission,
            flight,
            run,
            pictures: RefCell::default(),
        }
    }

    fn flight(camera: CameraModel, seconds: f64) -> Flight {
        let frames = (1..=(seconds / STEP).round() as usize / STEPS_PER_FRAME)
            .map(|i| Frame {
                time: (i * STEPS_PER_FRAME) as f64 * STEP,
                name: format!("{i:04}.jpg"),
                stored_turn: 0.0,
            })
            .collect();
        Flight {
            name: "Fixture".to_owned(),
            frame_on_globe: None,
            camera,
            ground_down: 0.0,
            channels: Vec::new(),
            frames,
            start: StartFix {
                time: 0.0,
                position: GroundPoint::new(150.0, 0.0),
                standard_deviation: 3.0,
            },
            truth: Some(Truth::default()),
        }
    }

    /// A picture of frame `index` as PNG, drawn once.
    pub fn picture(&self, index: usize) -> Option<Arc<[u8]>> {
        let known = self.pictures.borrow().get(&index).cloned();
        known.or_else(|| {
            let picture = self.draw_picture(index)?;
            self.pictures.borrow_mut().insert(index, picture.clone());
            Some(picture)
        })
    }

    /// Fields in stripes, landmarks as bright blocks.
    fn draw_picture(&self, index: usize) -> Option<Arc<[u8]>> {
        let time = self.flight.frames.get(index)?.time;
        let position = self.flight.truth.as_ref()?.position(time)?;
        let pose = Pose {
            position_in_world: position,
            attitude: Attitude::level(heading(time)),
        };
        let camera = &self.flight.camera;
        let picture = image::RgbImage::from_fn(640, 480, |x, y| {
            let pixel = nalgebra::Point2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let Some(ground) = camera.ground_at(&pose, &pixel, 0.0) else {
                return image::Rgb([150, 170, 190]);
            };
            if let Some(landmark) = self
                .run
                .landmarks
                .iter()
                .find(|l| l.bounds.contains(&ground))
            {
                let ridge = (ground.north - landmark.reference.north).abs() < 1.0;
                return image::Rgb(if ridge {
                    [120, 60, 50]
                } else {
                    [196, 120, 100]
                });
            }
            let field = ((ground.north / 60.0).floor() + 2.0 * (ground.east / 80.0).floor()) as i64;
            let furrow = if (ground.east / 3.0).floor() as i64 % 2 == 0 {
                6
            } else {
                0
            };
            match field.rem_euclid(4) {
                0 => image::Rgb([104 + furrow, 122 + furrow, 70]),
                1 => image::Rgb([150 + furrow, 138 + furrow, 92]),
                2 => image::Rgb([84, 108 + furrow, 62]),
                _ => image::Rgb([128 + furrow, 128, 84]),
            }
        });
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, image::ImageFormat::Png).ok()?;
        Some(bytes.into_inner().into())
    }
}

/// Pictures that explain a match, with one clear peak and a weaker one.
pub(crate) fn match_pictures(time: f64, landmark: u32) -> MatchPictures {
    let texture = |c: f64, r: f64| (96.0 + 60.0 * (c * 0.31).sin() * (r * 0.23).cos()) as f32;
    let hill = |c: f64, r: f64, at: (f64, f64), width: f64| {
        (-((c - at.0).powi(2) + (r - at.1).powi(2)) / width).exp()
    };
    let (peak, second) = ((61.4, 38.2), (22.0, 57.0));
    MatchPictures {
        time,
        landmark,
        patch: Gray::from_fn(48, 48, |c, r| {
            if (12..36).contains(&c) && (12..36).contains(&r) {
                190.0
            } else {
                texture(c as f64, r as f64)
            }
        }),
        rectified: Gray::from_fn(144, 144, |c, r| {
            if c.abs_diff(85) < 12 && r.abs_diff(62) < 12 {
                180.0
            } else {
                texture(c as f64 + 3.0, r as f64 * 1.1)
            }
        }),
        surface: Gray::from_fn(97, 97, |c, r| {
            let (c, r) = (c as f64, r as f64);
            (0.85 * hill(c, r, peak, 40.0) + 0.42 * hill(c, r, second, 60.0)
                - 0.05 * (c * 0.2).sin()) as f32
        }),
        peak: Some(peak),
        second: Some(second),
        gsd: 0.5,
    }
}

/// The state of the simulation while the run is made.
struct Flier {
    truth: Vector4<f64>,
    mean: Vector4<f64>,
    covariance: Matrix4<f64>,
    dead_reckoned: Vector2<f64>,
    noise: Noise,
}

impl Flier {
    fn new() -> Self {
        Self {
            truth: Vector4::new(150.0, 0.0, 2.0, -3.0),
            mean: Vector4::new(152.0, -2.0, 0.0, 0.0),
            covariance: Matrix4::from_diagonal(&Vector4::new(9.0, 9.0, 16.0, 16.0)),
            dead_reckoned: Vector2::new(152.0, -2.0),
            noise: Noise(7),
        }
    }

    fn step(
        &mut self,
        number: usize,
        camera: &CameraModel,
        flight: &mut Flight,
        landmarks: &[Landmark],
    ) -> StepReport {
        let time = number as f64 * STEP;
        let heading = heading(time);
        let air = Vector2::new(heading.cos(), heading.sin()) * AIRSPEED;
        let before = estimate(&self.mean, &self.covariance);
        let before_sigma = sigma_points(&self.mean, &self.covariance);
        let move_state = |x: &Vector4<f64>| {
            Vector4::new(
                x[0] + STEP * (air.x + x[2]),
                x[1] + STEP * (air.y + x[3]),
                x[2],
                x[3],
            )
        };
        self.truth = move_state(&self.truth);
        self.mean = move_state(&self.mean);
        self.dead_reckoned += air * STEP;
        let mut transition = Matrix4::identity();
        transition[(0, 2)] = STEP;
        transition[(1, 3)] = STEP;
        let process = Vector4::new(0.02, 0.02, 0.0025, 0.0025) * STEP;
        self.covariance = transition * self.covariance * transition.transpose()
            + Matrix4::from_diagonal(&process);
        let predicted = estimate(&self.mean, &self.covariance);
        let predicted_sigma = sigma_points(&self.mean, &self.covariance);
        if let Some(truth) = flight.truth.as_mut() {
            truth.states.push(TruthState {
                time,
                position: Point3::new(self.truth[0], self.truth[1], -HEIGHT),
                attitude: Some(Attitude::level(heading)),
                wind: Some(Vector2::new(self.truth[2], self.truth[3])),
            });
        }
        let frame = number
            .is_multiple_of(STEPS_PER_FRAME)
            .then(|| self.frame(number / STEPS_PER_FRAME - 1, heading, camera, landmarks));
        let corrected = frame.as_ref().is_some_and(|f| f.joint.is_some());
        StepReport {
            time,
            dt: STEP,
            control: Control {
                airspeed: Some(AIRSPEED),
                heading,
                roll: 0.0,
                pitch: 0.0,
                height: HEIGHT,
            },
            before,
            predicted,
            after: estimate(&self.mean, &self.covariance),
            sigma: SigmaSets {
                before_predict: before_sigma,
                after_predict: predicted_sigma.clone(),
                before_correct: corrected.then_some(predicted_sigma),
                after_correct: corrected.then(|| sigma_points(&self.mean, &self.covariance)),
            },
            dead_reckoned: self.dead_reckoned.into(),
            doubts: Vec::new(),
            frame,
            timing: StepTiming {
                predict: 0.01,
                see: 1.2,
                update: 0.03,
            },
            updates: Vec::new(),
            sightings: Vec::new(),
        }
    }

    fn pose(state: &Vector4<f64>, heading: f64) -> Pose {
        Pose {
            position_in_world: Point3::new(state[0], state[1], -HEIGHT),
            attitude: Attitude::level(heading),
        }
    }

    fn frame(
        &mut self,
        index: usize,
        heading: f64,
        camera: &CameraModel,
        landmarks: &[Landmark],
    ) -> FrameReport {
        let assumed_pose = Self::pose(&self.mean, heading);
        let true_pose = Self::pose(&self.truth, heading);
        let mut candidates = Vec::new();
        let mut rows: Vec<Row> = Vec::new();
        for landmark in landmarks {
            let point = landmark.reference_in_world(0.0);
            let predicted = camera.project(&assumed_pose, &point);
            let actual = camera.project(&true_pose, &point);
            let (Some(predicted), Some(actual)) = (predicted, actual) else {
                continue;
            };
            if !camera.in_picture(&actual, 30.0) {
                continue;
            }
            let sigma = 3.0;
            let actual =
                actual + sigma * Vector2::new(self.noise.gaussian(), self.noise.gaussian());
            let mut jacobian = Matrix2x4::zeros();
            for axis in 0..2 {
                let mut moved = self.mean;
                moved[axis] += 0.1;
                if let Some(pixel) = camera.project(&Self::pose(&moved, heading), &point) {
                    jacobian.set_column(axis, &((pixel - predicted) / 0.1));
                }
            }
            let innovation = actual - predicted;
            let covariance = jacobian * self.covariance * jacobian.transpose()
                + Matrix2::identity() * sigma * sigma;
            let nis = covariance.try_inverse().map_or(0.0, |inverse| {
                (innovation.transpose() * inverse * innovation)[0]
            });
            let turn = TURN_SIGMA * self.noise.gaussian();
            let scale = TURN_SIGMA * self.noise.gaussian();
            let nis = nis + (turn * turn + scale * scale) / (TURN_SIGMA * TURN_SIGMA);
            let threshold = THRESHOLD;
            // One landmark has a look-alike: it is ambiguous in every third frame.
            let outcome = if landmark.id == 3 && index.is_multiple_of(3) {
                Outcome::Refused(Refusal::Ambiguous)
            } else if nis > threshold {
                Outcome::Refused(Refusal::OutsideGate)
            } else {
                Outcome::Accepted
            };
            let accepted = outcome == Outcome::Accepted;
            if accepted {
                rows.push((jacobian, innovation, sigma * sigma, [turn, scale]));
            }
            let reach = 4.0
                + 3.5
                    * self.covariance[(0, 0)]
                        .sqrt()
                        .max(self.covariance[(1, 1)].sqrt());
            let search_region = landmark.bounds.grown(reach);
            let corner =
                |north, east| camera.project(&assumed_pose, &Point3::new(north, east, 0.0));
            candidates.push(CandidateReport {
                landmark: landmark.id,
                predicted_pixel: predicted,
                innovation_covariance: covariance,
                search_outline: [
                    corner(search_region.north, search_region.west),
                    corner(search_region.north, search_region.east),
                    corner(search_region.south, search_region.east),
                    corner(search_region.south, search_region.west),
                ]
                .into_iter()
                .flatten()
                .collect(),
                search_region,
                measured_pixel: Some(actual),
                rotation: Some(turn),
                log_scale: Some(scale),
                measurement_covariance: Some(Matrix4::from_diagonal(&Vector4::new(
                    sigma * sigma,
                    sigma * sigma,
                    TURN_SIGMA * TURN_SIGMA,
                    TURN_SIGMA * TURN_SIGMA,
                ))),
                score: 0.78 + 0.08 * self.noise.next(),
                second_score: if accepted { 0.41 } else { 0.74 } + 0.03 * self.noise.next(),
                probability: None,
                turn_and_size: [0.02, 0.01],
                innovation: Some(innovation),
                nis: Some(nis),
                threshold,
                outcome,
            });
        }
        let joint = self.correct(&rows);
        FrameReport {
            index,
            assumed_pose,
            footprint: Vec::new(),
            candidates,
            joint,
            laid: None,
            trouble: None,
        }
    }

    fn correct(&mut self, rows: &[Row]) -> Option<JointReport> {
        if rows.is_empty() {
            return None;
        }
        // Turn and scale are reported, and do not move this filter.
        let size = 4 * rows.len();
        let jacobian = DMatrix::from_fn(size, 4, |r, c| {
            if r % 4 < 2 {
                rows[r / 4].0[(r % 4, c)]
            } else {
                0.0
            }
        });
        let innovation = DVector::from_fn(size, |r, _| {
            let row = &rows[r / 4];
            if r % 4 < 2 {
                row.1[r % 4]
            } else {
                row.3[r % 4 - 2]
            }
        });
        let covariance = DMatrix::from_fn(4, 4, |r, c| self.covariance[(r, c)]);
        let noise = DMatrix::from_diagonal(&DVector::from_fn(size, |r, _| {
            if r % 4 < 2 {
                rows[r / 4].2
            } else {
                TURN_SIGMA * TURN_SIGMA
            }
        }));
        let innovation_covariance = &jacobian * &covariance * jacobian.transpose() + noise;
        let inverse = innovation_covariance.clone().try_inverse()?;
        let gain = &covariance * jacobian.transpose() * &inverse;
        let nis = (innovation.transpose() * &inverse * &innovation)[0];
        let shift = &gain * &innovation;
        let shrunk = &covariance - &gain * &innovation_covariance * gain.transpose();
        self.mean += Vector4::from_column_slice(shift.as_slice());
        self.covariance = Matrix4::from_fn(|r, c| 0.5 * (shrunk[(r, c)] + shrunk[(c, r)]));
        Some(JointReport {
            nis,
            degrees_of_freedom: size,
            threshold: THRESHOLD,
            gain,
            innovation,
            innovation_covariance,
            recovered: None,
        })
    }
}
