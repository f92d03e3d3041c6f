//! A run summed up per pixel of the timeline, growing with the run.

use pilotage_core::navigator::{Outcome, Run};

/// Events within one pixel of time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EventBin {
    /// Landmarks accepted.
    pub accepted: u32,
    /// Landmarks refused.
    pub refused: u32,
    /// Largest standard deviation of the position, metres; zero without a step.
    pub deviation: f32,
}

/// The bins of a run over a span of time.
#[derive(Clone, Debug, Default)]
pub struct Bins {
    key: (u64, usize, u64, u64),
    used: usize,
    columns: Vec<EventBin>,
    largest: f32,
}

impl Bins {
    /// Brings the bins up to date; only new steps are looked at, unless the run, the span or the
    /// width changed.
    pub fn follow(&mut self, run: &Run, generation: u64, span: (f64, f64), width: usize) {
        let key = (generation, width, span.0.to_bits(), span.1.to_bits());
        if self.key != key || self.used > run.steps.len() {
            *self = Self {
                key,
                columns: vec![EventBin::default(); width.max(1)],
                ..Self::default()
            };
        }
        let scale = width as f64 / (span.1 - span.0).max(1e-9);
        for step in &run.steps[self.used..] {
            let index = ((step.time - span.0) * scale).max(0.0) as usize;
            let last = self.columns.len() - 1;
            let bin = &mut self.columns[index.min(last)];
            let deviation = step.after.position_covariance().trace().max(0.0).sqrt() as f32;
            bin.deviation = bin.deviation.max(deviation);
            self.largest = self.largest.max(deviation);
            for candidate in step.frame.iter().flat_map(|f| &f.candidates) {
                if candidate.outcome == Outcome::Accepted {
                    bin.accepted += 1;
                } else {
                    bin.refused += 1;
                }
            }
        }
        self.used = run.steps.len();
    }

    /// Bins, each of a pixel.
    pub fn bins(&self) -> &[EventBin] {
        &self.columns
    }

    /// The largest standard deviation, metres.
    pub fn largest(&self) -> f32 {
        self.largest
    }
}
