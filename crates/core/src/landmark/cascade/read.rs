//! OpenCV's cascade files: the present layout (`opencv-cascade-classifier`, which MATLAB writes, too) and
//! that of before 2010 (`opencv-haar-classifier`).

use std::str::FromStr;

use super::CascadeError;
use super::model::{Area, Cascade, Feature, HaarFeature, Node, Stage, Tree};
use super::xml::{self, Element};

/// What OpenCV takes from each stage's threshold, against rounding.
const THRESHOLD_SLACK: f32 = 1e-5;
/// Longest side of a window that is read, pixels.
const LONGEST: usize = 2048;

/// An element on the way down and what it is called in complaints.
struct Place<'a> {
    file: &'a str,
    path: String,
    element: &'a Element,
}

impl<'a> Place<'a> {
    fn fail<T>(&self, cause: impl Into<String>) -> Result<T, CascadeError> {
        Err(CascadeError::Content {
            file: self.file.to_owned(),
            place: self.path.clone(),
            cause: cause.into(),
        })
    }

    fn below(&self, name: &str, element: &'a Element) -> Self {
        Place {
            file: self.file,
            path: format!("{} / {name}", self.path),
            element,
        }
    }

    fn child(&self, name: &str) -> Result<Self, CascadeError> {
        match self.element.child(name) {
            Some(element) => Ok(self.below(name, element)),
            None => self.fail(format!("no <{name}> in it")),
        }
    }

    fn items(&self, name: &str) -> impl Iterator<Item = Self> {
        let items = self.element.items().enumerate();
        items.map(move |(i, e)| self.below(&format!("{name} {i}"), e))
    }

    fn numbers<T: FromStr>(&self, least: usize) -> Result<Vec<T>, CascadeError> {
        match self.element.numbers() {
            Some(numbers) if numbers.len() >= least => Ok(numbers),
            Some(numbers) => self.fail(format!("{} numbers instead of {least}", numbers.len())),
            None => self.fail("not a row of numbers"),
        }
    }

    fn number<T: FromStr + Copy>(&self) -> Result<T, CascadeError> {
        Ok(self.numbers::<T>(1)?[0])
    }
}

/// An empty cascade for a window of that size.
fn empty(place: &Place<'_>, width: i64, height: i64) -> Result<Cascade, CascadeError> {
    let side = |v: i64| {
        usize::try_from(v)
            .ok()
            .filter(|v| (3..=LONGEST).contains(v))
    };
    let (Some(width), Some(height)) = (side(width), side(height)) else {
        return place.fail(format!("a window of {width} × {height} pixels"));
    };
    Ok(Cascade {
        width,
        height,
        features: Vec::new(),
        stages: Vec::new(),
        trees: Vec::new(),
        nodes: Vec::new(),
        leaves: Vec::new(),
        subsets: Vec::new(),
    })
}

impl Cascade {
    /// Reads the file `name` with the content `text`.
    ///
    /// # Errors
    /// Names the file, the element and what is wrong with it.
    pub fn read(name: &str, text: &str) -> Result<Self, CascadeError> {
        let root = xml::read(name, text)?;
        let top = Place {
            file: name,
            path: root.name.clone(),
            element: &root,
        };
        if let Ok(cascade) = top.child("cascade") {
            return present(&cascade);
        }
        let old = |e: &&Element| e.type_id.as_deref() == Some("opencv-haar-classifier");
        match root.children.iter().find(old) {
            Some(element) => former(&top.below(&element.name, element)),
            None => {
                top.fail("neither <cascade> nor an element of type opencv-haar-classifier in it")
            }
        }
    }

    fn check(self, place: &Place<'_>) -> Result<Self, CascadeError> {
        if self.stages.is_empty() {
            return place.fail("no stage in it");
        }
        let features = self.features.len() as u32;
        if let Some(node) = self.nodes.iter().find(|n| n.feature >= features) {
            return place.fail(format!(
                "feature {} of {features} is asked for",
                node.feature
            ));
        }
        Ok(self)
    }

    /// Appends a tree. A next node lies behind its own, so that every walk ends.
    fn grow(
        &mut self,
        place: &Place<'_>,
        nodes: &[Node],
        leaves: &[f32],
    ) -> Result<(), CascadeError> {
        if nodes.is_empty() || leaves.len() != nodes.len() + 1 {
            return place.fail(format!(
                "{} nodes with {} leaves",
                nodes.len(),
                leaves.len()
            ));
        }
        for (i, node) in nodes.iter().enumerate() {
            for next in [node.left, node.right] {
                let is_node = next > 0 && (next as usize) < nodes.len() && next as usize > i;
                let is_leaf = next <= 0 && (next.unsigned_abs() as usize) < leaves.len();
                if !is_node && !is_leaf {
                    return place.fail(format!("node {i} leads to {next}"));
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

    fn end_stage(&mut self, first_tree: usize, threshold: f32) {
        self.stages.push(Stage {
            trees: first_tree..self.trees.len(),
            threshold: threshold - THRESHOLD_SLACK,
        });
    }

    fn area(&self, place: &Place<'_>, numbers: &[f64], grown: i32) -> Result<Area, CascadeError> {
        let whole = |i: usize| {
            let v = numbers[i];
            (v.fract() == 0.0 && v.abs() < 1e6).then_some(v as i32)
        };
        let area = [whole(0), whole(1), whole(2), whole(3)];
        let [Some(x), Some(y), Some(w), Some(h)] = area else {
            return place.fail("a rectangle of broken pixels");
        };
        let (width, height) = (self.width as i32, self.height as i32);
        let inside = x >= 0 && y >= 0 && w > 0 && h > 0;
        if !inside || x + grown * w > width || y + grown * h > height {
            return place.fail(format!("the rectangle {x} {y} {w} {h} leaves the window"));
        }
        Ok([x, y, w, h])
    }

    fn haar(&self, place: &Place<'_>) -> Result<Feature, CascadeError> {
        let tilted = match place.element.child("tilted") {
            Some(_) => place.child("tilted")?.number::<i32>()? != 0,
            None => false,
        };
        let mut areas = [([1, 0, 1, 1], 0.0); 3];
        let rects = place.child("rects")?;
        for (i, item) in rects.items("rectangle").enumerate() {
            let numbers = item.numbers::<f64>(5)?;
            let Some(area) = areas.get_mut(i) else {
                return item.fail("over three rectangles");
            };
            *area = if tilted {
                (self.tilted_area(&item, &numbers)?, numbers[4] as f32)
            } else {
                (self.area(&item, &numbers, 1)?, numbers[4] as f32)
            };
        }
        if areas[0].1 == 0.0 {
            return rects.fail("no rectangle with a weight");
        }
        Ok(Feature::Haar(HaarFeature { areas, tilted }))
    }

    /// A turned rectangle goes from its uppermost corner `w` pixels down to the right and `h` down to
    /// the left.
    fn tilted_area(&self, place: &Place<'_>, numbers: &[f64]) -> Result<Area, CascadeError> {
        let [x, y, w, h] = [0, 1, 2, 3].map(|i| numbers[i] as i32);
        let inside = (0..=LONGEST as i32).contains(&x)
            && y >= 0
            && (1..=LONGEST as i32).contains(&w)
            && (1..=LONGEST as i32).contains(&h);
        if !inside
            || x - h < 0
            || x + w > self.width as i32
            || y.saturating_add(w + h) > self.height as i32
        {
            return place.fail(format!(
                "the turned rectangle {x} {y} {w} {h} leaves the window"
            ));
        }
        Ok([x, y, w, h])
    }
}

/// The present layout.
fn present(place: &Place<'_>) -> Result<Cascade, CascadeError> {
    let size = |name| place.child(name)?.number::<i64>();
    let mut cascade = empty(place, size("width")?, size("height")?)?;
    let kind = place.child("featureType")?;
    let kind_name = kind.element.text.trim();
    let lbp = match kind_name {
        "HAAR" => false,
        "LBP" => true,
        other => return kind.fail(format!("features of the kind {other} are not known")),
    };
    for item in place.child("features")?.items("feature") {
        let feature = if lbp {
            let rect = item.child("rect")?;
            Feature::Lbp(cascade.area(&rect, &rect.numbers::<f64>(4)?, 3)?)
        } else {
            cascade.haar(&item)?
        };
        cascade.features.push(feature);
    }
    for stage in place.child("stages")?.items("stage") {
        let first_tree = cascade.trees.len();
        for tree in stage.child("weakClassifiers")?.items("tree") {
            let nodes = nodes(&mut cascade, &tree.child("internalNodes")?, lbp)?;
            let leaves = tree.child("leafValues")?.numbers::<f32>(2)?;
            cascade.grow(&tree, &nodes, &leaves)?;
        }
        let threshold = stage.child("stageThreshold")?.number::<f32>()?;
        cascade.end_stage(first_tree, threshold);
    }
    cascade.check(place)
}

/// Rows of left, right, feature, threshold, or in place of the threshold eight words of codes.
fn nodes(cascade: &mut Cascade, place: &Place<'_>, lbp: bool) -> Result<Vec<Node>, CascadeError> {
    let numbers = place.numbers::<f64>(1)?;
    let step = if lbp { 11 } else { 4 };
    if !numbers.len().is_multiple_of(step) {
        return place.fail(format!(
            "{} numbers, which is no multiple of {step}",
            numbers.len()
        ));
    }
    let mut nodes = Vec::new();
    for row in numbers.chunks_exact(step) {
        if lbp {
            let word = |i: usize| (row[3 + i] as i64) as u32;
            cascade.subsets.push(std::array::from_fn(word));
        }
        nodes.push(Node {
            left: row[0] as i32,
            right: row[1] as i32,
            feature: row[2] as u32,
            threshold: if lbp { 0.0 } else { row[3] as f32 },
        });
    }
    Ok(nodes)
}

/// The layout of before 2010, Haar only: features stand in the nodes.
fn former(place: &Place<'_>) -> Result<Cascade, CascadeError> {
    let size = place.child("size")?.numbers::<i64>(2)?;
    let mut cascade = empty(place, size[0], size[1])?;
    for stage in place.child("stages")?.items("stage") {
        let first_tree = cascade.trees.len();
        for tree in stage.child("trees")?.items("tree") {
            let (mut nodes, mut leaves) = (Vec::new(), Vec::new());
            for node in tree.items("node") {
                let feature = cascade.haar(&node.child("feature")?)?;
                cascade.features.push(feature);
                let mut next = |side: &str| -> Result<i32, CascadeError> {
                    if let Ok(value) = node.child(&format!("{side}_val")) {
                        leaves.push(value.number::<f32>()?);
                        return Ok(1 - leaves.len() as i32);
                    }
                    node.child(&format!("{side}_node"))?.number()
                };
                nodes.push(Node {
                    left: next("left")?,
                    right: next("right")?,
                    feature: cascade.features.len() as u32 - 1,
                    threshold: node.child("threshold")?.number()?,
                });
            }
            cascade.grow(&tree, &nodes, &leaves)?;
        }
        let threshold = stage.child("stage_threshold")?.number::<f32>()?;
        cascade.end_stage(first_tree, threshold);
    }
    cascade.check(place)
}
