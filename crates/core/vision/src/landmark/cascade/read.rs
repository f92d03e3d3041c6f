//! OpenCV's cascade files: the present layout (`opencv-cascade-classifier`, which MATLAB writes, too) and
//! that of before 2010 (`opencv-haar-classifier`).

use std::str::FromStr;

use super::CascadeError;
use super::check::{NO_AREA, empty};
use super::model::{Area, Cascade, CascadeFeature, CascadeKind, HaarFeature, TreeNode};
use super::xml::{self, CascadeElement};

/// Amount that OpenCV takes from each stage's threshold, against rounding.
pub(super) const THRESHOLD_SLACK: f32 = 1e-5;

/// An element on the way down and what it is called in complaints.
struct ElementPlace<'a> {
    file: &'a str,
    path: String,
    element: &'a CascadeElement,
}

impl<'a> ElementPlace<'a> {
    fn fail<T>(&self, cause: impl Into<String>) -> Result<T, CascadeError> {
        Err(CascadeError::Content {
            file: self.file.to_owned(),
            place: self.path.clone(),
            cause: cause.into(),
        })
    }

    fn checked<T>(&self, result: Result<T, String>) -> Result<T, CascadeError> {
        result.or_else(|cause| self.fail(cause))
    }

    fn below(&self, name: &str, element: &'a CascadeElement) -> Self {
        ElementPlace {
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

impl Cascade {
    /// Reads the file `name` with the content `text`.
    ///
    /// # Errors
    /// Names the file, the element and what is wrong with it.
    pub fn read(name: &str, text: &str) -> Result<Self, CascadeError> {
        let root = xml::read(name, text)?;
        let top = ElementPlace {
            file: name,
            path: root.name.clone(),
            element: &root,
        };
        if let Ok(cascade) = top.child("cascade") {
            return present(&cascade);
        }
        let old = |e: &&CascadeElement| e.type_id.as_deref() == Some("opencv-haar-classifier");
        match root.children.iter().find(old) {
            Some(element) => former(&top.below(&element.name, element)),
            None => {
                top.fail("neither <cascade> nor an element of type opencv-haar-classifier in it")
            }
        }
    }

    fn haar(&mut self, place: &ElementPlace<'_>) -> Result<(), CascadeError> {
        let tilted = match place.element.child("tilted") {
            Some(_) => place.child("tilted")?.number::<i32>()? != 0,
            None => false,
        };
        let mut areas = [NO_AREA; 3];
        let rects = place.child("rects")?;
        for (i, item) in rects.items("rectangle").enumerate() {
            let numbers = item.numbers::<f64>(5)?;
            let Some(area) = areas.get_mut(i) else {
                return item.fail("over three rectangles");
            };
            *area = (whole(&item, &numbers)?, numbers[4] as f32);
        }
        let feature = CascadeFeature::Haar(HaarFeature { areas, tilted });
        rects.checked(self.add_feature(feature))
    }
}

/// Four numbers that are whole.
fn whole(place: &ElementPlace<'_>, numbers: &[f64]) -> Result<Area, CascadeError> {
    if numbers[..4]
        .iter()
        .all(|v| v.fract() == 0.0 && v.abs() < 1e6)
    {
        Ok(std::array::from_fn(|i| numbers[i] as i32))
    } else {
        place.fail("a rectangle of broken pixels")
    }
}

/// The present layout.
fn present(place: &ElementPlace<'_>) -> Result<Cascade, CascadeError> {
    let size = |name| place.child(name)?.number::<i64>();
    let mut cascade = place.checked(empty(size("width")?, size("height")?))?;
    let kind = place.child("featureType")?;
    let kind = match kind.element.text.trim() {
        "HAAR" => CascadeKind::Haar,
        "LBP" => CascadeKind::Lbp,
        "HOG" => CascadeKind::Hog,
        other => return kind.fail(format!("features of the kind {other} are not known")),
    };
    for item in place.child("features")?.items("feature") {
        if kind == CascadeKind::Haar {
            cascade.haar(&item)?;
            continue;
        }
        let rect = item.child("rect")?;
        let numbers = rect.numbers::<f64>(if kind == CascadeKind::Hog { 5 } else { 4 })?;
        let area = whole(&rect, &numbers)?;
        let feature = if kind == CascadeKind::Lbp {
            CascadeFeature::Lbp(area)
        } else {
            if numbers[4].fract() != 0.0 || !(0.0..256.0).contains(&numbers[4]) {
                return rect.fail(format!("component {}", numbers[4]));
            }
            CascadeFeature::Hog {
                cell: area,
                component: numbers[4] as u8,
            }
        };
        rect.checked(cascade.add_feature(feature))?;
    }
    for stage in place.child("stages")?.items("stage") {
        let first_tree = cascade.trees.len();
        for tree in stage.child("weakClassifiers")?.items("tree") {
            let nodes = nodes(
                &mut cascade,
                &tree.child("internalNodes")?,
                kind == CascadeKind::Lbp,
            )?;
            let leaves = tree.child("leafValues")?.numbers::<f32>(2)?;
            tree.checked(cascade.grow(&nodes, &leaves))?;
        }
        let threshold = stage.child("stageThreshold")?.number::<f32>()?;
        stage.checked(cascade.end_stage(first_tree, threshold - THRESHOLD_SLACK))?;
    }
    place.checked(cascade.check())
}

/// Rows of left, right, feature, threshold, or in place of the threshold eight words of codes.
fn nodes(
    cascade: &mut Cascade,
    place: &ElementPlace<'_>,
    lbp: bool,
) -> Result<Vec<TreeNode>, CascadeError> {
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
        nodes.push(TreeNode {
            left: row[0] as i32,
            right: row[1] as i32,
            feature: row[2] as u32,
            threshold: if lbp { 0.0 } else { row[3] as f32 },
        });
    }
    Ok(nodes)
}

/// The layout of before 2010, Haar only: features stand in the nodes.
fn former(place: &ElementPlace<'_>) -> Result<Cascade, CascadeError> {
    let size = place.child("size")?.numbers::<i64>(2)?;
    let mut cascade = place.checked(empty(size[0], size[1]))?;
    for stage in place.child("stages")?.items("stage") {
        let first_tree = cascade.trees.len();
        for tree in stage.child("trees")?.items("tree") {
            let (mut nodes, mut leaves) = (Vec::new(), Vec::new());
            for node in tree.items("node") {
                cascade.haar(&node.child("feature")?)?;
                let mut next = |side: &str| -> Result<i32, CascadeError> {
                    if let Ok(value) = node.child(&format!("{side}_val")) {
                        leaves.push(value.number::<f32>()?);
                        return Ok(1 - leaves.len() as i32);
                    }
                    node.child(&format!("{side}_node"))?.number()
                };
                nodes.push(TreeNode {
                    left: next("left")?,
                    right: next("right")?,
                    feature: cascade.features.len() as u32 - 1,
                    threshold: node.child("threshold")?.number()?,
                });
            }
            tree.checked(cascade.grow(&nodes, &leaves))?;
        }
        let threshold = stage.child("stage_threshold")?.number::<f32>()?;
        stage.checked(cascade.end_stage(first_tree, threshold - THRESHOLD_SLACK))?;
    }
    place.checked(cascade.check())
}
