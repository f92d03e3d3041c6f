//! Doubts of the navigator besides what instruments say themselves: the lag of the pictures and the heading.

use std::sync::Arc;

use super::super::engine::{Engine, PredictedStep};
use super::super::frame_registration::RegisteredFrame;
use super::super::heading_doubt::{HeadingDoubt, TurnedCompass, turned_back};
use super::super::onlooker::Onlooker;
use super::super::picture_lag::PictureLag;
use super::super::{Control, JointReport, StepReport};
use super::Navigator;
use pilotage_estimation::filter::FilterError;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::Pyramid;

impl Navigator {
    /// Adds to the report what is open or doubted after all, and its effect on the estimate.
    pub(super) fn conclude(&self, report: &mut StepReport) {
        if let Some(likeliest) = self.possible.likeliest(&report.after) {
            report.after = likeliest;
        }
        if let Some(lag) = &self.lag {
            report.doubts.extend(lag.doubt());
            let onlooker = self.onlooker(&self.flight.camera);
            let past = |lag| onlooker.past(lag);
            if let Some(together) = lag.together(self.engine.as_ref(), &report.after, &past) {
                report.after = together;
            }
        }
        if let Some(heading) = &self.heading {
            report.doubts.extend(heading.doubt());
            let stray = heading.stray();
            for axis in 0..2 {
                report.after.covariance[(axis, axis)] += stray * stray;
            }
        }
    }

    /// Tries the heading by the whole frame where landmarks are missed that must be seen.
    pub(super) fn try_heading(
        &mut self,
        index: usize,
        luminance: &Pyramid,
        report: &mut StepReport,
    ) -> Result<(), FilterError> {
        let Some(mut doubt) = self.heading.take() else {
            return Ok(());
        };
        let Some(mut frame) = report.frame.take() else {
            self.heading = Some(doubt);
            return Ok(());
        };
        doubt.notice(&frame.candidates, self.engine.as_ref(), self.time)?;
        let laid = doubt.lay(
            &self.flight,
            &self.inputs,
            index,
            luminance,
            &report.predicted,
        );
        if let Some(mut laid) = laid {
            let camera = self.flight.camera_of_frame(index);
            let heading = self.appearance_model(&camera).attitude.yaw;
            if let Some(turned) = doubt.read(&mut laid, heading, &self.settings)? {
                frame.joint = self.turn_back(index, turned, &mut laid, report)?;
                doubt.confirm(self.engine.as_ref(), self.time)?;
            }
            frame.laid = Some(laid.report);
        }
        self.heading = Some(doubt);
        report.frame = Some(frame);
        Ok(())
    }

    /// Goes on by the heading turned back, from when it was right last, and by the frame that is `laid`.
    fn turn_back(
        &mut self,
        index: usize,
        turned: TurnedCompass,
        laid: &mut RegisteredFrame,
        report: &mut StepReport,
    ) -> Result<Option<JointReport>, FilterError> {
        self.flight = Arc::new(turned_back(&self.flight, turned.by, turned.since));
        if let Some(step) = self.reckon_anew(turned.engine, turned.since)? {
            report.begun_by(step);
        }
        report.control = Control::of(&self.flight, self.time);
        report.predicted = self.engine.state();
        report.after = report.predicted.clone();
        self.look_back(index);
        laid.report.refusal = None;
        let believed = laid.correct(&self.settings, &mut self.engine)?;
        if let Some(lag) = &mut self.lag {
            lag.restart(self.engine.as_ref())?;
        }
        Ok(believed.map(|believed| {
            report.corrected_by(believed.predicted, believed.step);
            believed.joint
        }))
    }

    /// Goes on from `engine`, as it was at `since` in seconds, with all inputs up to now; the last prediction.
    fn reckon_anew(
        &mut self,
        mut engine: Box<dyn Engine>,
        since: f64,
    ) -> Result<Option<PredictedStep>, FilterError> {
        let (mut time, mut last) = (since, None);
        let done = self.ticks[..self.next].iter().map(|tick| tick.time);
        for next in done.filter(|next| *next > since) {
            let input = self.inputs.between(&self.flight, time, next);
            last = Some(engine.predict(&input, next - time)?);
            time = next;
        }
        self.engine = engine;
        self.recovery = None;
        Ok(last)
    }

    /// Lets the filters look as far back as the pictures are late.
    pub(super) fn look_back(&mut self, index: usize) {
        let Some(lag) = self.lag.as_ref().map(PictureLag::assumed) else {
            return;
        };
        let camera = self.flight.camera_of_frame(index);
        let past = self.onlooker(&camera).past(lag);
        if let Some(recovery) = &mut self.recovery {
            recovery.look_back(past.clone());
        }
        self.engine.look_back(past);
    }

    /// The flight as a camera sees it now.
    fn onlooker<'a>(&'a self, camera: &'a CameraModel) -> Onlooker<'a> {
        Onlooker {
            flight: &self.flight,
            inputs: &self.inputs,
            camera,
            time: self.time,
        }
    }

    /// Whether whole frames are laid on the map, with landmarks or without.
    pub(super) fn is_laying(&self) -> bool {
        let heading = self.heading.as_ref();
        self.whole_frames.is_some() || heading.is_some_and(HeadingDoubt::is_trying)
    }
}
