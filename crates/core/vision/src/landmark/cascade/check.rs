//! Requirements on a cascade, wherever it comes from.

use super::model::{Area, COMPONENTS, Cascade, CascadeFeature, HaarFeature, Stage, Tree, TreeNode};

/// Longest side of a window, pixels.
const LONGEST: usize = 2048;
/// Most pixels of a window, so that no sum of its squares leaves 32 bits.
const LARGEST: usize = 1 << 16;

/// A rectangle that stands for none, in any window, upright or turned.
pub(super) const NO_AREA: (Area, f32) = ([1, 0, 1, 1], 0.0);

/// An empty cascade for a window of that size.
pub(super) fn empty(width: i64, height: i64) -> Result<Cascade, String> {
    let side = |v: i64| {
        usize::try_from(v)
            .ok()
            .filter(|v| (3..=LONGEST).contains(v))
    };
    match (side(width), side(height)) {
        (Some(width), Some(height)) if width * height <= LARGEST => Ok(Cascade {
            width,
            height,
            features: Vec::new(),
            stages: Vec::new(),
            trees: Vec::new(),
            nodes: Vec::new(),
            leaves: Vec::new(),
            subsets: Vec::new(),
        }),
        _ => Err(format!("a window of {width} × {height} pixels")),
    }
}

impl Cascade {
    /// Appends a feature that lies in the window.
    pub(super) fn add_feature(&mut self, mut feature: CascadeFeature) -> Result<(), String> {
        match &mut feature {
            CascadeFeature::Haar(haar) => {
                for area in haar.areas.iter_mut().filter(|(_, weight)| *weight == 0.0) {
                    *area = NO_AREA;
                }
                haar.areas.sort_by_key(|(_, weight)| *weight == 0.0);
                self.check_haar(haar)?;
            }
            CascadeFeature::Lbp(area) => self.check_area(*area, 3)?,
            CascadeFeature::Hog { cell, component } => {
                self.check_area(*cell, 2)?;
                if *component >= COMPONENTS {
                    return Err(format!("component {component} of {COMPONENTS}"));
                }
            }
        }
        if self
            .features
            .first()
            .is_some_and(|f| f.kind() != feature.kind())
        {
            return Err("features of two kinds".to_owned());
        }
        self.features.push(feature);
        Ok(())
    }

    fn check_haar(&self, haar: &HaarFeature) -> Result<(), String> {
        if haar.areas[0].1 == 0.0 {
            return Err("no rectangle with a weight".to_owned());
        }
        for (area, weight) in haar.areas {
            if !weight.is_finite() {
                return Err(format!("a weight of {weight}"));
            }
            if haar.tilted {
                self.check_tilted_area(area)?;
            } else {
                self.check_area(area, 1)?;
            }
        }
        Ok(())
    }

    /// Checks that so many rectangles side by side and below each other lie in the window.
    fn check_area(&self, [x, y, w, h]: Area, repeated: i32) -> Result<(), String> {
        let fits = |at: i32, side: i32, limit: usize| {
            (0..=LONGEST as i32).contains(&at)
                && (1..=LONGEST as i32).contains(&side)
                && at + repeated * side <= limit as i32
        };
        if fits(x, w, self.width) && fits(y, h, self.height) {
            Ok(())
        } else {
            Err(format!("the rectangle {x} {y} {w} {h} leaves the window"))
        }
    }

    /// A turned rectangle goes from its uppermost corner `w` pixels down to the right and `h` down to
    /// the left.
    fn check_tilted_area(&self, [x, y, w, h]: Area) -> Result<(), String> {
        let side = 1..=LONGEST as i32;
        let inside = (0..=LONGEST as i32).contains(&x)
            && (0..=LONGEST as i32).contains(&y)
            && side.contains(&w)
            && side.contains(&h)
            && x - h >= 0
            && x + w <= self.width as i32
            && y + w + h <= self.height as i32;
        if inside {
            Ok(())
        } else {
            Err(format!(
                "the turned rectangle {x} {y} {w} {h} leaves the window"
            ))
        }
    }

    /// Appends a tree. A next node lies behind its own, so that every walk ends.
    pub(super) fn grow(&mut self, nodes: &[TreeNode], leaves: &[f32]) -> Result<(), String> {
        if nodes.is_empty() || leaves.len() != nodes.len() + 1 {
            return Err(format!(
                "{} nodes with {} leaves",
                nodes.len(),
                leaves.len()
            ));
        }
        if !leaves.iter().all(|v| v.is_finite()) {
            return Err("a leaf that is no finite number".to_owned());
        }
        for (i, node) in nodes.iter().enumerate() {
            if !node.threshold.is_finite() {
                return Err(format!("node {i} compares with {}", node.threshold));
            }
            for next in [node.left, node.right] {
                let is_node = next > 0 && (next as usize) < nodes.len() && next as usize > i;
                let is_leaf = next <= 0 && (next.unsigned_abs() as usize) < leaves.len();
                if !is_node && !is_leaf {
                    return Err(format!("node {i} leads to {next}"));
                }
            }
        }
        let first = self.nodes.len();
        self.trees.push(Tree {
            nodes: first..first + nodes.len(),
            first_leaf: self.leaves.len(),
        });
        self.nodes.extend(nodes);
        self.leaves.extend(leaves);
        Ok(())
    }

    /// Makes a stage of the trees from `first_tree` on.
    pub(super) fn end_stage(&mut self, first_tree: usize, threshold: f32) -> Result<(), String> {
        if !threshold.is_finite() {
            return Err(format!("a stage's threshold of {threshold}"));
        }
        self.stages.push(Stage {
            trees: first_tree..self.trees.len(),
            threshold,
        });
        Ok(())
    }

    /// Checks what only shows when all is there.
    pub(super) fn check(self) -> Result<Self, String> {
        if self.stages.is_empty() {
            return Err("no stage in it".to_owned());
        }
        let features = self.features.len() as u32;
        match self.nodes.iter().find(|n| n.feature >= features) {
            Some(node) => Err(format!(
                "feature {} of {features} is asked for",
                node.feature
            )),
            None => Ok(self),
        }
    }
}
