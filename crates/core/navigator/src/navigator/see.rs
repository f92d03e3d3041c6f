//! See, associate, gate: from a picture to the measurements that may correct the estimate.

use nalgebra::{DMatrix, DVector, Matrix4, MatrixXx4, Point2, Point3, Vector4};

use super::attention::{attended, probability_of_view};
use super::engine::{Engine, MeasurementModel, frame_noise};
use super::expected::{Anchor, AppearanceModel, appearances};
use super::looks::{LooksAtLandmarks, lasting_variances, weakened};
use super::observation::{GaussianInnovation, Observation, PicturePart};
use super::place_on_map::PlaceOnMap;
use super::region::{may_be_in_view, reach};
use super::tilt::ByTilt;
use super::{CandidateReport, Outcome};
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_estimation::filter::{FilterError, Gate};
use pilotage_estimation::vehicle::Kinematics;
use pilotage_mission::settings::NavigatorSettings;
use pilotage_raster::raster::Pyramid;
use pilotage_vision::geometry::{AppearanceError, COMPONENTS, joint_noise};
use pilotage_vision::landmark::{
    Detector, FrameView, Landmark, Refusal, SearchRequest, Sighting, measured,
};

/// Pixel, rotation and log scale at which a landmark was seen, and their covariance without the error of the
/// camera's pose.
pub type SightedPlace = (Vector4<f64>, Matrix4<f64>);

/// A landmark that was found and passed its own gate.
pub struct Measurement<'a> {
    pub landmark: &'a Landmark,
    /// Anchor at which the landmark was found.
    pub anchor: Anchor,
    /// Index of its report.
    pub report: usize,
    /// Pixel, rotation and log scale.
    pub seen: Vector4<f64>,
    pub covariance: Matrix4<f64>,
    pub jacobian: Matrix4<f64>,
    /// Number of the look at the landmark, and the part of the variances that every look at it has in common.
    pub look: u32,
    pub lasting: Vector4<f64>,
}

impl Measurement<'_> {
    /// Degrees of freedom of its normalized innovation squared.
    fn degrees(&self) -> usize {
        measured(&self.covariance)
    }

    /// Its covariance as that of a look with nothing in common with others, beside an error of the camera's pose with the
    /// covariance `pose`.
    fn weakened(&self, pose: &Matrix4<f64>) -> Matrix4<f64> {
        let of_pose = self.jacobian * pose * self.jacobian.transpose();
        weakened(self.look, &self.covariance, &of_pose, &self.lasting)
    }
}

/// Degrees of freedom of the joint normalized innovation squared of several.
pub fn degrees(measurements: &[Measurement<'_>]) -> usize {
    measurements.iter().map(Measurement::degrees).sum()
}

/// A landmark, the index of its report and where it was found.
pub type FoundPlace<'l> = (&'l Landmark, usize, SightedPlace);

/// Measurements that agree in a frame, their joint normalized innovation squared and its threshold.
pub type Agreed<'l> = (Vec<Measurement<'l>>, f64, f64);

/// Everything that stays the same while a frame is worked on.
pub struct Associator<'a> {
    pub settings: &'a NavigatorSettings,
    pub engine: &'a dyn Engine,
    pub model: AppearanceModel<'a>,
    pub pose: Pose,
    /// Number of the frame.
    pub frame: usize,
    /// Looks at landmarks before it.
    pub looks: &'a LooksAtLandmarks,
}

/// Several landmarks of a frame as one observation of 4m components with their joint noise, as a camera of `model`
/// at the assumed `pose` saw them.
pub fn observation(
    settings: &NavigatorSettings,
    measurements: &[Measurement<'_>],
    model: &AppearanceModel<'_>,
    pose: &Pose,
) -> Observation<'static> {
    let mut measured = DVector::zeros(COMPONENTS * measurements.len());
    for (i, m) in measurements.iter().enumerate() {
        measured
            .fixed_rows_mut::<COMPONENTS>(COMPONENTS * i)
            .copy_from(&m.seen);
    }
    let own: Vec<_> = measurements.iter().map(|m| m.covariance).collect();
    let jacobians: Vec<_> = measurements.iter().map(|m| m.jacobian).collect();
    let are_new = measurements.iter().all(|m| m.look == 1);
    let of_pose = frame_noise(settings).pose_covariance();
    let weakened = (!are_new).then(|| {
        let own: Vec<_> = measurements.iter().map(|m| m.weakened(&of_pose)).collect();
        noise(settings, &own, &jacobians)
    });
    let landmarks = measurements.iter();
    let landmarks = landmarks.map(|m| (m.landmark, m.anchor, m.jacobian));
    let scale = settings.measurement_scale;
    let mut part = PicturePart {
        by_pose: MatrixXx4::zeros(measured.len()),
        own: DMatrix::zeros(measured.len(), measured.len()),
    };
    for (i, m) in measurements.iter().enumerate() {
        let row = COMPONENTS * i;
        let by_pose = m.jacobian * scale.sqrt();
        part.by_pose
            .fixed_rows_mut::<COMPONENTS>(row)
            .copy_from(&by_pose);
        part.own
            .fixed_view_mut::<COMPONENTS, COMPONENTS>(row, row)
            .copy_from(&(m.covariance * scale));
    }
    Observation {
        measured,
        noise: noise(settings, &own, &jacobians),
        weakened,
        model: expected(landmarks.collect(), model, pose),
        degrees: degrees(measurements),
        in_picture: Some(part),
    }
}

/// Appearances of landmarks, with their changes with the pose, to a camera of `model` at the assumed `pose`.
fn expected(
    landmarks: Vec<(&Landmark, Anchor, Matrix4<f64>)>,
    model: &AppearanceModel<'_>,
    pose: &Pose,
) -> MeasurementModel<'static> {
    let (attitude, pose) = (model.attitude, *pose);
    let jacobians: Vec<_> = landmarks.iter().map(|(_, _, slope)| *slope).collect();
    let by_tilt = ByTilt::of_landmarks(&jacobians);
    let places: Vec<(GroundPoint, Anchor)> = landmarks
        .into_iter()
        .map(|(landmark, anchor, _)| (landmark.reference, anchor))
        .collect();
    MeasurementModel::of_pose(move |seen: &Kinematics| {
        let bias = seen.heading_bias.unwrap_or(0.0);
        let mut appearances = appearances(&attitude, &places, &pose, seen.on_map, bias);
        by_tilt.add(&mut appearances, seen);
        Some(appearances)
    })
}

fn noise(
    settings: &NavigatorSettings,
    own: &[Matrix4<f64>],
    jacobians: &[Matrix4<f64>],
) -> DMatrix<f64> {
    let pose = frame_noise(settings).pose_covariance();
    joint_noise(own, jacobians, &pose, settings.measurement_scale)
}

impl<'a> Associator<'a> {
    /// Prepares the expectations for frame number `frame`, after some `looks`, from where `engine` believes to be.
    pub fn new(
        settings: &'a NavigatorSettings,
        engine: &'a dyn Engine,
        model: AppearanceModel<'a>,
        (frame, looks): (usize, &'a LooksAtLandmarks),
    ) -> Self {
        let pose = model.pose(engine.seen_from(), engine.heading_bias());
        Self {
            settings,
            engine,
            model,
            pose,
            frame,
            looks,
        }
    }

    /// The same, but judged by what another filter believes.
    pub fn judged_by<'b>(&self, engine: &'b dyn Engine) -> Associator<'b>
    where
        'a: 'b,
    {
        Associator { engine, ..*self }
    }

    /// The same frame from where another filter believes to be, and by another `model`.
    pub fn seen_by<'b>(&self, engine: &'b dyn Engine, model: AppearanceModel<'b>) -> Associator<'b>
    where
        'a: 'b,
    {
        Associator::new(self.settings, engine, model, (self.frame, self.looks))
    }

    /// Least covariance of what is measured of `landmark`: what no detector knows of its own error, and the map's
    /// error as far as it is no state of the filter, which all landmarks would have in common.
    fn floor(&self, landmark: &Landmark, anchor: &Anchor) -> Matrix4<f64> {
        let own = self.unknown(landmark, anchor, self.settings.sensors.pixel);
        let on_map = PlaceOnMap::of(self.settings, self.settings.detector.map_deviation);
        own + anchor.in_pixels(on_map.beyond_state().sqrt())
    }

    /// Covariance of what no detector knows of its own error: that in the picture, `pixel`, and that on the ground.
    fn unknown(&self, landmark: &Landmark, anchor: &Anchor, pixel: f64) -> Matrix4<f64> {
        let height = (self.model.ground_down - self.model.camera_down).max(1.0);
        let half = 0.25 * (landmark.bounds.width() + landmark.bounds.height());
        let ground = self.settings.sensors.ground;
        let error = AppearanceError { pixel, ground };
        error.covariance(&anchor.to_pixel, self.model.camera.focal / height, half)
    }

    /// Landmarks that may be in view, the most central first, with the reports begun; not all of them
    /// if there are too many (see [`attended`]).
    pub fn candidates<'l>(
        &self,
        landmarks: &'l [Landmark],
    ) -> Vec<(&'l Landmark, CandidateReport)> {
        let camera = self.model.camera;
        let mut found: Vec<(f64, &Landmark, CandidateReport)> = Vec::new();
        let spread = self.engine.state().position_covariance();
        let reach = reach(camera, &self.pose, self.model.ground_down, &spread);
        let below = GroundPoint::from(self.pose.position_in_world.xy().coords);
        let near = |l: &&Landmark| {
            let half = 0.5 * l.bounds.width().hypot(l.bounds.height());
            l.enabled && l.bounds.center().distance(&below) <= reach + half
        };
        for landmark in landmarks.iter().filter(near) {
            let Some((report, anchor)) = self.begin(landmark) else {
                continue;
            };
            let point = landmark.reference_in_world(self.model.ground_down);
            let pose = anchor.seen_from(&self.pose, &point);
            let moved = report.predicted_pixel - anchor.pixel;
            let covariance = &report.innovation_covariance;
            if may_be_in_view(camera, &pose, landmark, point.z, &moved, covariance) {
                let off_center = (report.predicted_pixel - camera.principal).norm();
                found.push((off_center, landmark, report));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let in_view = |(_, _, r): &(f64, &Landmark, CandidateReport)| {
            probability_of_view(camera, &r.predicted_pixel, &r.innovation_covariance)
        };
        let in_view: Vec<f64> = found.iter().map(in_view).collect();
        let chosen = attended(&in_view, self.settings.most_landmarks, self.frame);
        let mut kept = Vec::with_capacity(chosen.len());
        for (index, (_, landmark, report)) in found.into_iter().enumerate() {
            if chosen.binary_search(&index).is_ok() {
                kept.push((landmark, report));
            }
        }
        kept
    }

    /// The report of a landmark before it is looked for; `None` if it cannot be in front of the lens.
    fn begin(&self, landmark: &Landmark) -> Option<(CandidateReport, Anchor)> {
        let model = self.model;
        let point = landmark.reference_in_world(model.ground_down);
        let anchor = Anchor::of(model.camera, &self.pose, &point)?;
        let jacobian = anchor.pose_jacobian(model.camera, &self.pose, &point)?;
        let noise = noise(self.settings, &[self.floor(landmark, &anchor)], &[jacobian]);
        let expected = expected(vec![(landmark, anchor, jacobian)], &model, &self.pose);
        let expected = self.engine.expect(&expected, &noise).ok()?;
        let covariance = expected.covariance.fixed_view::<2, 2>(0, 0).into_owned();
        let deviation = |i: usize| expected.covariance[(i, i)].max(0.0).sqrt();
        let report = CandidateReport {
            landmark: landmark.id,
            predicted_pixel: Point2::new(expected.mean[0], expected.mean[1]),
            innovation_covariance: covariance,
            search_region: landmark.bounds,
            search_outline: Vec::new(),
            measured_pixel: None,
            measurement_covariance: None,
            score: 0.0,
            second_score: 0.0,
            probability: None,
            turn_and_size: [deviation(2), deviation(3)],
            innovation: None,
            nis: None,
            rotation: None,
            log_scale: None,
            threshold: self.gate().threshold(COMPONENTS),
            outcome: Outcome::Refused(Refusal::OutOfPicture),
        };
        Some((report, anchor))
    }

    fn gate(&self) -> Gate {
        Gate {
            confidence: self.settings.gate_confidence,
        }
    }

    /// The request for a detector: the innovation covariance carried to the ground.
    pub fn request<'l>(
        &self,
        landmark: &'l Landmark,
        report: &CandidateReport,
    ) -> Option<SearchRequest<'l>> {
        let point = landmark.reference_in_world(self.model.ground_down);
        let anchor = Anchor::of(self.model.camera, &self.pose, &point)?;
        let to_ground = anchor.to_pixel.try_inverse()?;
        let covariance = to_ground * report.innovation_covariance * to_ground.transpose();
        Some(SearchRequest {
            landmark,
            displacement_covariance: covariance,
            turn_deviation: report.turn_and_size[0],
            log_scale_deviation: report.turn_and_size[1],
        })
    }

    /// View that a detector is shown.
    pub fn view(&self, luminance: &'a Pyramid) -> FrameView<'a> {
        FrameView {
            camera: self.model.camera,
            pose: self.pose,
            ground_down: self.model.ground_down,
            luminance,
        }
    }

    /// Looks for one landmark and fills in its report. The place is given, too, of one that was refused
    /// because it may be a look-alike: beside another landmark that can be told (see [`Self::confirm`]).
    pub fn look(
        &self,
        landmark: &Landmark,
        report: &mut CandidateReport,
        luminance: &'a Pyramid,
        detector: &mut dyn Detector,
    ) -> Option<SightedPlace> {
        let request = self.request(landmark, report)?;
        let region = request.region(self.settings.detector.search_sigmas);
        let (camera, ground_down) = (self.model.camera, self.model.ground_down);
        report.search_region = region;
        report.search_outline = [
            (region.north, region.west),
            (region.north, region.east),
            (region.south, region.east),
            (region.south, region.west),
        ]
        .into_iter()
        .filter_map(|(n, e)| camera.project(&self.pose, &Point3::new(n, e, ground_down)))
        .collect();
        let sighting = detector.detect(&self.view(luminance), &request);
        let place = sighting.best().and_then(|best| {
            report.score = best.score;
            report.second_score = best.second_score;
            report.probability = best.probability;
            let point = Point3::new(best.ground.north, best.ground.east, ground_down);
            let pixel = camera.project(&self.pose, &point)?;
            let anchor = Anchor::at(camera, &self.pose, &pixel, ground_down)?;
            let mut to_picture = Matrix4::identity();
            to_picture
                .fixed_view_mut::<2, 2>(0, 0)
                .copy_from(&anchor.to_pixel);
            let own = to_picture * best.covariance * to_picture.transpose();
            let covariance = own + self.floor(landmark, &anchor);
            report.measured_pixel = Some(pixel);
            report.rotation = Some(best.rotation);
            report.log_scale = Some(best.scale.ln());
            report.measurement_covariance = Some(covariance);
            report.innovation = Some(pixel - report.predicted_pixel);
            let seen = Vector4::new(pixel.x, pixel.y, best.rotation, best.scale.ln());
            Some((seen, covariance))
        });
        match sighting {
            Sighting::Found(_) => place,
            Sighting::Refused(refusal, _) => {
                report.outcome = Outcome::Refused(refusal);
                place.filter(|_| refusal == Refusal::LookAlike)
            }
        }
    }

    /// Judges a found place by its own innovation.
    pub fn judge<'l>(
        &self,
        landmark: &'l Landmark,
        report: &mut CandidateReport,
        index: usize,
        place: SightedPlace,
    ) -> Option<Measurement<'l>> {
        let measurement = self.measurement(landmark, index, place)?;
        let innovation = self.innovation(std::slice::from_ref(&measurement)).ok()?;
        let nis = innovation.nis().ok()?;
        report.innovation = Some(innovation.innovation.fixed_rows::<2>(0).into_owned());
        let covariance = innovation.covariance.fixed_view::<2, 2>(0, 0);
        report.innovation_covariance = covariance.into_owned();
        report.nis = Some(nis);
        report.threshold = self.gate().threshold(measurement.degrees());
        if nis > report.threshold {
            report.outcome = Outcome::Refused(Refusal::OutsideGate);
            return None;
        }
        report.outcome = Outcome::Accepted;
        Some(measurement)
    }

    /// A found place as a measurement, unjudged; `None` where it says nothing about the ground.
    pub fn measurement<'l>(
        &self,
        landmark: &'l Landmark,
        index: usize,
        (seen, covariance): SightedPlace,
    ) -> Option<Measurement<'l>> {
        let model = self.model;
        let point = landmark.reference_in_world(model.ground_down);
        let pixel = Point2::new(seen.x, seen.y);
        let anchor = Anchor::at(model.camera, &self.pose, &pixel, model.ground_down)?;
        let jacobian = anchor.pose_jacobian(model.camera, &self.pose, &point)?;
        Some(Measurement {
            landmark,
            anchor,
            report: index,
            seen,
            covariance,
            jacobian,
            look: self.looks.next(landmark.id),
            lasting: lasting_variances(
                &self.unknown(landmark, &anchor, 0.0),
                &frame_noise(self.settings),
                &jacobian,
            ),
        })
    }

    /// Joint innovation of several landmarks against where they are expected.
    pub fn innovation(
        &self,
        measurements: &[Measurement<'_>],
    ) -> Result<GaussianInnovation, FilterError> {
        observation(self.settings, measurements, &self.model, &self.pose).innovation(self.engine)
    }

    /// Takes out landmarks until the rest agree with each other and with the prediction.
    ///
    /// The errors of position and attitude are common to all landmarks of a frame, so that a wrong one
    /// stands out against two right ones far more than against its own gate. Of two that contradict
    /// each other nobody knows which is wrong: both go.
    pub fn agree<'l>(
        &self,
        mut measurements: Vec<Measurement<'l>>,
        reports: &mut [CandidateReport],
    ) -> Result<Agreed<'l>, FilterError> {
        let gate = self.gate();
        loop {
            if measurements.is_empty() {
                return Ok((measurements, 0.0, 0.0));
            }
            let nis = self.innovation(&measurements)?.nis()?;
            let threshold = gate.threshold(degrees(&measurements));
            if nis <= threshold {
                return Ok((measurements, nis, threshold));
            }
            let refused: Vec<usize> = if measurements.len() <= 2 {
                measurements.iter().map(|m| m.report).collect()
            } else {
                let mut best: Option<(f64, usize)> = None;
                for i in 0..measurements.len() {
                    let left_out = measurements.remove(i);
                    let nis = self.innovation(&measurements)?.nis()?;
                    if best.is_none_or(|(least, _)| nis < least) {
                        best = Some((nis, left_out.report));
                    }
                    measurements.insert(i, left_out);
                }
                best.map(|(_, report)| report).into_iter().collect()
            };
            for index in &refused {
                reports[*index].outcome = Outcome::Refused(Refusal::Contradicted);
            }
            measurements.retain(|m| !refused.contains(&m.report));
        }
    }

    /// Takes in landmarks that may be look-alikes and agree with those that are not; a look-alike would
    /// contradict them. Without such a one nothing can be told.
    pub fn confirm<'l>(
        &self,
        (mut agreed, mut nis, mut threshold): Agreed<'l>,
        doubtful: Vec<FoundPlace<'l>>,
        reports: &mut [CandidateReport],
    ) -> Result<Agreed<'l>, FilterError> {
        if agreed.is_empty() {
            return Ok((agreed, nis, threshold));
        }
        for (landmark, index, place) in doubtful {
            let Some(measurement) = self.judge(landmark, &mut reports[index], index, place) else {
                continue;
            };
            agreed.push(measurement);
            let with = self.innovation(&agreed)?.nis()?;
            let most = self.gate().threshold(degrees(&agreed));
            if with <= most {
                (nis, threshold) = (with, most);
            } else {
                agreed.pop();
                reports[index].outcome = Outcome::Refused(Refusal::Contradicted);
            }
        }
        Ok((agreed, nis, threshold))
    }
}
