//! Aids beside pictures: what they observed in a step, shown to all filters.

use std::sync::Arc;

use nalgebra::{DMatrix, Matrix3, Vector3, dvector};

use super::super::aids::{Aid, AidLook, AidMoment, AssumedAir, Taken, take};
use super::super::engine::{MeasurementModel, frame_noise, map_error, vehicle};
use super::super::expected::AppearanceModel;
use super::super::observation::{GaussianState, Observation};
use super::super::observed_at::ObservedAt;
use super::super::onlooker::Onlooker;
use super::super::picture_errors::PictureErrors;
use super::super::picture_lag::PictureLag;
use super::super::{AidInfo, StepReport, UpdateReport};
use super::{Navigator, SeenPicture};
use pilotage_base::frames::GroundPoint;
use pilotage_estimation::filter::{FilterError, Gate};
use pilotage_raster::raster::Picture;

impl Navigator {
    /// Whether an aid looks at pictures.
    pub(super) fn aids_see(&self) -> bool {
        self.aids.iter().any(|aid| aid.info().sees())
    }

    /// Takes in what the aids observed since `from`, seconds, after whatever a frame did in this step, and what they
    /// see in the picture of that frame, with its number.
    ///
    /// Filters that assume something else of the pictures, or follow another place, are shown the same, and gain or
    /// lose by it.
    pub(super) fn take_aids(
        &mut self,
        from: f64,
        seen: Option<(usize, SeenPicture)>,
        report: &mut StepReport,
    ) -> Result<(), FilterError> {
        let flight = Arc::clone(&self.flight);
        let (seen, landmarks) = match seen.filter(|_| self.aids_see()) {
            Some((index, (picture, landmarks))) => (Some((index, picture)), landmarks),
            None => (None, None),
        };
        let camera = seen
            .as_ref()
            .map(|(index, _)| flight.camera_of_frame(*index));
        let look = match (&seen, &camera) {
            (Some((index, picture)), Some(camera)) => {
                self.look_back(*index);
                Some(self.aid_look(picture, self.appearance_model(camera))?)
            }
            _ => None,
        };
        let input = self.inputs.between(&flight, self.time, self.time);
        let cruise = self.settings.process.cruise;
        let moment = AidMoment {
            flight: &flight,
            from,
            until: self.time,
            air: AssumedAir::of(&input, &vehicle(&self.settings), cruise),
            look,
        };
        let observed = |aid: &mut Box<dyn Aid>| {
            let observations = aid.observe(&moment);
            observations
                .into_iter()
                .map(|observation| (aid.info(), observation))
                .collect()
        };
        let observed: Vec<Vec<(&AidInfo, Observation<'static>)>> =
            self.aids.iter_mut().map(observed).collect();
        report.sightings = (self.aids.iter_mut())
            .filter_map(|aid| aid.sighting())
            .collect();
        let mut shared = PictureErrors::new(frame_noise(&self.settings).pose_covariance());
        if let Some(landmarks) = landmarks {
            shared.note(landmarks);
        }
        let onlooker = camera.as_ref().map(|camera| Onlooker {
            flight: &flight,
            inputs: &self.inputs,
            camera,
            time: self.time,
        });
        let gate = Gate {
            confidence: self.settings.gate_confidence,
        };
        let lag_of_pictures = self.lag.as_ref().map_or(0.0, PictureLag::assumed);
        for (aid, observation) in observed.into_iter().flatten() {
            let at = match onlooker {
                Some(onlooker) if aid.sees() => ObservedAt::Picture(onlooker),
                _ => ObservedAt::Now(&input),
            };
            at.turn(self.engine.as_mut(), lag_of_pictures);
            let given = shared.given(&observation);
            let told = given.as_ref().unwrap_or(&observation);
            let Some(taken) = take(self.engine.as_mut(), told, gate)? else {
                continue;
            };
            let own = taken.log_likelihood;
            if let Some(lag) = &mut self.lag {
                lag.take(told, (&at, gate, own))?;
            }
            if let Some(recovery) = &mut self.recovery {
                recovery.take(told, (&at, lag_of_pictures, gate))?;
            }
            self.possible.take(told, (&at, gate, own))?;
            report.updates.push(UpdateReport::of(aid.key, told, &taken));
            drop(given);
            if let Some(step) = taken.step {
                report.aided_by(step);
                shared.note(observation);
            }
        }
        Ok(())
    }

    /// Look of aids at `picture`, from the belief that was turned to it.
    fn aid_look<'a>(
        &self,
        picture: &'a Picture,
        model: AppearanceModel<'a>,
    ) -> Result<AidLook<'a>, FilterError> {
        let place_and_bias = MeasurementModel::of_pose(|seen| {
            let bias = seen.heading_bias.unwrap_or(0.0);
            Some(dvector![seen.on_map.north, seen.on_map.east, bias])
        });
        // A vehicle that knows no bias of its heading has no variance of it.
        let least = 1e-12 * DMatrix::identity(3, 3);
        let belief = self.engine.expect(&place_and_bias, &least)?;
        let mean = Vector3::from_column_slice(belief.mean.as_slice());
        Ok(AidLook {
            picture,
            pose: model.pose(GroundPoint::new(mean.x, mean.y), mean.z),
            model,
            belief: GaussianState {
                mean,
                covariance: Matrix3::from_column_slice(belief.covariance.as_slice()),
            },
            noise: frame_noise(&self.settings),
            map_deviation: map_error(&self.settings).map_or(0.0, |error| error.deviation),
        })
    }
}

impl UpdateReport {
    /// Report of what a filter did with an observation of `aid`.
    fn of(aid: &str, observation: &Observation<'_>, taken: &Taken) -> Self {
        Self {
            aid: aid.to_owned(),
            measured: observation.measured.clone(),
            innovation: taken.innovation.innovation.clone(),
            innovation_covariance: taken.innovation.covariance.clone(),
            nis: taken.verdict.nis,
            degrees_of_freedom: taken.verdict.dof,
            threshold: taken.verdict.threshold,
            gain: taken.step.as_ref().map(|step| step.gain.clone()),
        }
    }
}
