//! Windows that are still in the running.

/// Windows that are still in the running, and what the last stage said of them.
#[derive(Clone, Debug, Default)]
pub(in super::super) struct RunningWindows {
    /// Places in the tables, ascending.
    pub at: Vec<usize>,
    /// Factors on Haar values.
    pub factor: Vec<f32>,
    /// Sum of the votes of the last stage.
    pub votes: Vec<f64>,
    /// Sum over the stages met so far of votes less threshold.
    pub margin: Vec<f64>,
}

impl RunningWindows {
    /// Forgets them.
    pub fn clear(&mut self) {
        self.at.clear();
        self.factor.clear();
        self.votes.clear();
        self.margin.clear();
    }

    /// Adds a window.
    pub fn push(&mut self, at: usize, factor: f32, margin: f64) {
        self.at.push(at);
        self.factor.push(factor);
        self.votes.push(0.0);
        self.margin.push(margin);
    }

    /// Leaves only those of whose place, votes and margin `keep` says so.
    pub fn retain(&mut self, mut keep: impl FnMut(usize, f64, &mut f64) -> bool) {
        let mut kept = 0;
        for i in 0..self.at.len() {
            if keep(self.at[i], self.votes[i], &mut self.margin[i]) {
                self.at[kept] = self.at[i];
                self.factor[kept] = self.factor[i];
                self.margin[kept] = self.margin[i];
                kept += 1;
            }
        }
        self.at.truncate(kept);
        self.factor.truncate(kept);
        self.votes.truncate(kept);
        self.margin.truncate(kept);
    }
}
