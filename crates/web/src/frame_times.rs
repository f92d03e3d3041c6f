//! Time that the app itself took for the last frames.

use std::collections::VecDeque;

/// Number of frames looked back on.
const KEPT: usize = 300;

/// Milliseconds of the page thread per frame, without the time the graphics card takes.
#[derive(Default)]
pub struct FrameTimes {
    kept: VecDeque<f64>,
    total: u64,
}

impl FrameTimes {
    /// Notes a frame, milliseconds.
    pub fn note(&mut self, milliseconds: f64) {
        self.total += 1;
        self.kept.push_back(milliseconds);
        if self.kept.len() > KEPT {
            self.kept.pop_front();
        }
    }

    /// Forgets the frames kept, to measure from now on.
    pub fn forget(&mut self) {
        self.kept.clear();
    }

    /// Frames since the start; and of those kept the number, median, 95th percentile and mean.
    pub fn json(&self) -> String {
        let mut sorted: Vec<f64> = self.kept.iter().copied().collect();
        sorted.sort_by(f64::total_cmp);
        let at = |fraction: f64| {
            let index = ((sorted.len().max(1) - 1) as f64 * fraction).round() as usize;
            sorted.get(index).copied()
        };
        let mean = (!sorted.is_empty()).then(|| sorted.iter().sum::<f64>() / sorted.len() as f64);
        serde_json::json!({
            "frames": self.total,
            "kept": sorted.len(),
            "median": at(0.5),
            "p95": at(0.95),
            "mean": mean,
        })
        .to_string()
    }
}
