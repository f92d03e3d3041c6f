//! Whole frames laid on the map, and what is thought possible where that leaves it open.

use super::super::frame_registration::{FrameRegistration, RegisteredFrame, measured};
use super::super::possible_places::Sure;
use super::super::{Estimate, JointReport, StepReport};
use super::Navigator;
use pilotage_estimation::filter::FilterError;
use pilotage_raster::raster::Pyramid;

impl Navigator {
    /// Lays the whole frame on the map, if that is wanted; whether it corrected the estimate.
    pub(super) fn lay(
        &mut self,
        index: usize,
        luminance: &Pyramid,
        report: &mut StepReport,
        begun: f64,
        stopwatch: &dyn Fn() -> f64,
    ) -> Result<bool, FilterError> {
        let Some(mut whole_frames) = self.whole_frames.take() else {
            return Ok(false);
        };
        let laid = self.laid(&mut whole_frames, index, luminance, report);
        let follower = whole_frames.follower().clone();
        self.whole_frames = Some(whole_frames);
        let (laid, joint) = laid?;
        let seen = stopwatch();
        let corrected = joint.is_some();
        if corrected {
            self.recovery = None;
            self.possible
                .settle(&self.settings, &report.after, &follower)?;
        }
        let mut frame = self.blind(index, None);
        if let (true, Some(place)) = (corrected, &laid.report.place) {
            frame.assumed_pose = place.pose;
            frame.footprint = laid.footprint;
        }
        frame.joint = joint;
        frame.laid = Some(laid.report);
        report.frame = Some(frame);
        report.timing.see = seen - begun;
        report.timing.update = stopwatch() - seen;
        Ok(corrected)
    }

    /// Lays the frame around where the aircraft is believed to be, and where that leaves it open, wherever it can be.
    fn laid(
        &mut self,
        whole_frames: &mut FrameRegistration,
        index: usize,
        luminance: &Pyramid,
        report: &mut StepReport,
    ) -> Result<(RegisteredFrame, Option<JointReport>), FilterError> {
        let measured = measured(&self.flight, &self.inputs, self.time);
        let flight = &self.flight;
        let mut first = None;
        if !self.possible.are_open() {
            let mut laid = whole_frames.lay(flight, &measured, index, luminance, &report.predicted);
            if let Some(believed) = laid.correct(&self.settings, &mut self.engine)? {
                whole_frames.learn(&laid);
                report.corrected_by(believed.predicted, believed.step);
                return Ok((laid, Some(believed.joint)));
            }
            first = Some(laid);
        }
        let wider = self
            .possible
            .wider(&report.predicted, |believed| whole_frames.around(believed));
        let mut laid = match (first, wider) {
            (Some(first), None) => first,
            (_, around) => {
                let around = around.as_ref().unwrap_or(&report.predicted);
                whole_frames.lay(flight, &measured, index, luminance, around)
            }
        };
        let sure = self.possible.weigh(
            &self.settings,
            self.engine.as_ref(),
            whole_frames.follower(),
            &laid.found,
        )?;
        let Some(sure) = sure else {
            laid.report.left_open(self.possible.words());
            return Ok((laid, None));
        };
        let Sure {
            engine,
            follower,
            step,
            believed,
        } = sure;
        let spread = |estimate: &Estimate| estimate.position_covariance().trace();
        let before = spread(&report.predicted);
        let is_another = step.is_some();
        if let Some(step) = step {
            report.begun_by(step);
        }
        self.engine = engine;
        whole_frames.go_on_by(follower);
        report.predicted = self.engine.state();
        report.after = report.predicted.clone();
        let Some((place, mut believed)) = believed else {
            self.possible
                .settle(&self.settings, &report.after, whole_frames.follower())?;
            let followed = "a place of an earlier frame is gone on by";
            laid.report.left_open(followed.to_owned());
            return Ok((laid, None));
        };
        if let Some(place) = laid.found.places.get(place) {
            (laid.report, laid.footprint) = whole_frames.laid_at(flight, index, luminance, place);
        }
        let widened = spread(&believed.predicted) / before;
        believed.joint.recovered = is_another.then(|| widened.max(1.0));
        report.corrected_by(believed.predicted, believed.step);
        Ok((laid, Some(believed.joint)))
    }
}
