//! The part of the flight that is flown.

use pilotage_core::flight::{ChannelName, Flight};
use pilotage_core::navigator::Run;

use super::Documents;

/// Whether a run reaches the end of its flight: it is neither under way, nor was it stopped or broken off before.
fn reaches_end(run: &Run, flight: &Flight) -> bool {
    let drives = [ChannelName::Airspeed, ChannelName::Heading].map(|name| flight.channel(name));
    let readings = drives
        .into_iter()
        .flatten()
        .filter_map(|it| it.times.last());
    let frames = flight.frames.iter().map(|frame| &frame.time);
    let last = readings
        .chain(frames)
        .fold(f64::NEG_INFINITY, |a, b| a.max(*b));
    // What comes sooner than that after a step is no step of its own.
    let apart = run.settings.shortest_step.max(1e-6);
    run.span().is_some_and(|(_, end)| end + apart > last)
}

impl Documents {
    /// Whether the run reaches the end of the flight.
    pub fn is_run_whole(&self) -> bool {
        let run = self.run.navigated.as_ref();
        run.is_some_and(|run| match &self.flight.measured {
            Some(flight) => reaches_end(run, flight),
            None => self.run.is_complete,
        })
    }

    /// Time of the last step of a run that does not reach the end of the flight, seconds: beyond it nothing is known, and
    /// what was known last would stand there as though it were of that time.
    pub fn flown_until(&self) -> Option<f64> {
        let run = self.run.navigated.as_ref()?.span().map(|span| span.1);
        run.filter(|_| !self.is_run_whole())
    }

    /// The part of the flight that is flown, in words, unless it is all of it.
    pub fn part_flown(&self) -> Option<String> {
        let (first, last) = self.span()?;
        let until = self.flown_until()?;
        Some(format!(
            "the first {:.0} s of {:.0} s",
            until - first,
            last - first
        ))
    }
}
