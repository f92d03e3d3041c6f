//! Cascades as OpenCV's files, in the layouts that [`super::read`] reads.

use std::fmt::Write as _;
use std::ops::Range;

use super::CascadeError;
use super::build::writable;
use super::model::{Cascade, CascadeFeature, CascadeKind, HaarFeature, Tree, TreeNode};

/// Text before everything else: the XML declaration and the tag that encloses the rest.
const HEAD: &str = "<?xml version=\"1.0\"?>\n<opencv_storage>\n";
/// See [`HEAD`].
const FOOT: &str = "</opencv_storage>\n";

/// Appends formatted text; writing to a string does not fail.
macro_rules! put {
    ($out:expr, $($arguments:tt)*) => {
        let _ = write!($out, $($arguments)*);
    };
}

/// All digits, so that nobody who reads it rounds.
fn number(value: f32) -> String {
    format!("{:e}", f64::from(value))
}

impl Cascade {
    /// The present layout of OpenCV (`opencv-cascade-classifier`), which OpenCV 2.4 to 4 and MATLAB's
    /// `vision.CascadeObjectDetector` read; HOG features only OpenCV 2.4 and MATLAB.
    ///
    /// Reading it gives an equal cascade.
    ///
    /// ```
    /// use pilotage_vision::landmark::cascade::{
    ///     Cascade, CascadeFeature, NodeSplit, TrainedStage, TrainedTree,
    /// };
    ///
    /// let codes = [u32::MAX, 0, 0, 0, 0, 0, 0, 0];
    /// let trees = vec![TrainedTree::stump(0, NodeSplit::Codes(codes), -1.0, 1.0)];
    /// let features = vec![CascadeFeature::Lbp([2, 2, 4, 4])];
    /// let stage = TrainedStage { trees, threshold: 0.25 };
    /// let cascade = Cascade::from_parts(24, 24, features, &[stage])?;
    /// let text = cascade.to_xml();
    /// assert!(text.contains("opencv-cascade-classifier"));
    /// assert_eq!(Cascade::read("cascade.xml", &text)?, cascade);
    /// # Ok::<(), pilotage_vision::landmark::cascade::CascadeError>(())
    /// ```
    pub fn to_xml(&self) -> String {
        let kind = self.kind();
        let mut out = HEAD.to_owned();
        let (name, categories, size) = match kind {
            CascadeKind::Haar => ("HAAR", 0, 1),
            CascadeKind::Lbp => ("LBP", 256, 1),
            CascadeKind::Hog => ("HOG", 0, 36),
        };
        let most = self.stages.iter().map(|s| s.trees.len()).max().unwrap_or(0);
        let depth = self.trees.iter().map(|t| t.nodes.len()).max().unwrap_or(1);
        put!(
            out,
            "<cascade type_id=\"opencv-cascade-classifier\">\n\
             <stageType>BOOST</stageType>\n<featureType>{name}</featureType>\n\
             <height>{}</height>\n<width>{}</width>\n\
             <stageParams><boostType>GAB</boostType><maxDepth>{depth}</maxDepth>\
             <maxWeakCount>{most}</maxWeakCount></stageParams>\n\
             <featureParams><maxCatCount>{categories}</maxCatCount><featSize>{size}</featSize>{}\
             </featureParams>\n<stageNum>{}</stageNum>\n<stages>\n",
            self.height,
            self.width,
            if kind == CascadeKind::Haar {
                "<mode>ALL</mode>"
            } else {
                ""
            },
            self.stages.len(),
        );
        for stage in &self.stages {
            put!(
                out,
                "<_>\n<maxWeakCount>{}</maxWeakCount>\n<stageThreshold>{}</stageThreshold>\n\
                 <weakClassifiers>\n",
                stage.trees.len(),
                number(writable(stage.threshold).0),
            );
            for tree in &self.trees[stage.trees.clone()] {
                self.put_tree(&mut out, tree);
            }
            out.push_str("</weakClassifiers></_>\n");
        }
        out.push_str("</stages>\n<features>\n");
        for feature in &self.features {
            out.push_str("<_>");
            match feature {
                CascadeFeature::Haar(haar) => put_haar(&mut out, haar),
                CascadeFeature::Lbp([x, y, w, h]) => {
                    put!(out, "<rect>{x} {y} {w} {h}</rect>");
                }
                CascadeFeature::Hog {
                    cell: [x, y, w, h],
                    component,
                } => {
                    put!(out, "<rect>{x} {y} {w} {h} {component}</rect>");
                }
            }
            out.push_str("</_>\n");
        }
        out.push_str("</features></cascade>\n");
        out + FOOT
    }

    /// Nodes and leaves as rows of numbers.
    fn put_tree(&self, out: &mut String, tree: &Tree) {
        out.push_str("<_><internalNodes>\n");
        for index in tree.nodes.clone() {
            let node = &self.nodes[index];
            put!(out, "{} {} {}", node.left, node.right, node.feature);
            match self.subsets.get(index) {
                Some(words) => {
                    for word in words {
                        put!(out, " {}", word.cast_signed());
                    }
                }
                None => {
                    put!(out, " {}", number(node.threshold));
                }
            }
            out.push('\n');
        }
        out.push_str("</internalNodes>\n<leafValues>");
        for (i, leaf) in self.leaves[leaves(tree)].iter().enumerate() {
            put!(out, "{}{}", if i == 0 { "" } else { " " }, number(*leaf));
        }
        out.push_str("</leafValues></_>\n");
    }

    /// The layout of before 2010 (`opencv-haar-classifier`), which OpenCV 1 to 4 read. Reading it gives
    /// a cascade that says the same, with a feature for each node.
    ///
    /// # Errors
    /// For features other than Haar's, stages without trees, and trees in which a node is not reached in
    /// exactly one way: that layout cannot say them.
    pub fn to_former_xml(&self) -> Result<String, CascadeError> {
        let fail = |place: String, cause: &str| CascadeError::Parts {
            place,
            cause: cause.to_owned(),
        };
        if self.kind() != CascadeKind::Haar {
            let cause = "the former layout knows Haar features only";
            return Err(fail("the cascade".to_owned(), cause));
        }
        let mut out = HEAD.to_owned();
        put!(
            out,
            "<detector type_id=\"opencv-haar-classifier\">\n<size>{} {}</size>\n<stages>\n",
            self.width,
            self.height
        );
        for (s, stage) in self.stages.iter().enumerate() {
            if stage.trees.is_empty() {
                return Err(fail(format!("stage {s}"), "the former layout needs trees"));
            }
            out.push_str("<_>\n<trees>\n");
            for (t, tree) in self.trees[stage.trees.clone()].iter().enumerate() {
                if !self.put_former_tree(&mut out, tree) {
                    let cause = "the former layout reaches every node in one way";
                    return Err(fail(format!("stage {s}, tree {t}"), cause));
                }
            }
            put!(
                out,
                "</trees>\n<stage_threshold>{}</stage_threshold>\n<parent>{}</parent>\n\
                 <next>-1</next></_>\n",
                number(writable(stage.threshold).0),
                s as i64 - 1,
            );
        }
        out.push_str("</stages></detector>\n");
        Ok(out + FOOT)
    }

    /// Nodes with their features; answers whether each is reached in exactly one way.
    fn put_former_tree(&self, out: &mut String, tree: &Tree) -> bool {
        let mut reached = vec![0; tree.nodes.len()];
        out.push_str("<_>\n");
        for node in &self.nodes[tree.nodes.clone()] {
            let Some(CascadeFeature::Haar(haar)) = self.features.get(node.feature as usize) else {
                return false;
            };
            out.push_str("<_><feature>");
            put_haar(out, haar);
            if !haar.tilted {
                out.push_str("<tilted>0</tilted>");
            }
            put!(
                out,
                "</feature>\n<threshold>{}</threshold>",
                number(node.threshold)
            );
            self.put_former_way(out, tree, node, &mut reached);
            out.push_str("</_>\n");
        }
        out.push_str("</_>\n");
        reached.iter().skip(1).all(|&ways| ways == 1)
    }

    /// Writes the next nodes of a node, or the values of its leaves.
    fn put_former_way(&self, out: &mut String, tree: &Tree, node: &TreeNode, reached: &mut [u32]) {
        for (side, next) in [("left", node.left), ("right", node.right)] {
            if next > 0 {
                reached[next as usize] += 1;
                put!(out, "<{side}_node>{next}</{side}_node>");
            } else {
                let leaf = self.leaves[tree.first_leaf + next.unsigned_abs() as usize];
                put!(out, "<{side}_val>{}</{side}_val>", number(leaf));
            }
        }
    }
}

/// Places of a tree's leaves among all.
pub(super) fn leaves(tree: &Tree) -> Range<usize> {
    tree.first_leaf..tree.first_leaf + tree.nodes.len() + 1
}

fn put_haar(out: &mut String, haar: &HaarFeature) {
    out.push_str("<rects>");
    for ([x, y, w, h], weight) in haar.areas.iter().filter(|(_, weight)| *weight != 0.0) {
        put!(out, "<_>{x} {y} {w} {h} {}</_>", number(*weight));
    }
    out.push_str("</rects>");
    if haar.tilted {
        out.push_str("<tilted>1</tilted>");
    }
}
