//! A box in the hand.

use pilotage_core::mission::LabelBox;

/// A box being drawn, moved or given another size.
#[derive(Clone, Debug)]
pub(super) struct BoxDrag {
    pub frame: usize,
    pub landmark: u32,
    /// The box when the drag began; corners of a new one are where the pointer went down.
    pub from: [[f64; 2]; 2],
    /// Place at which the pointer went down, pixels.
    pub at: [f64; 2],
    /// Edges that follow the pointer: of the first corner and of the second, by axis.
    pub edges: [[bool; 2]; 2],
    /// The label that is moved or given another size; none if one is drawn.
    pub of: Option<LabelBox>,
}

impl BoxDrag {
    /// The corners once the pointer is at `to`, pixels.
    pub fn corners(&self, to: [f64; 2]) -> [[f64; 2]; 2] {
        let mut corners = self.from;
        for (corner, edges) in corners.iter_mut().zip(self.edges) {
            for axis in 0..2 {
                if edges[axis] {
                    corner[axis] += to[axis] - self.at[axis];
                }
            }
        }
        corners
    }
}
