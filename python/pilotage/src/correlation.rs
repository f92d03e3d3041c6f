//! Patches matched with pictures by normalized correlation.

use numpy::{AllowTypeChange, PyArray2, PyArrayLike2};
use pilotage_core::raster::{Gray, Raster, Template, highest_peak, rival_peak};
use pyo3::prelude::*;

use crate::arrays::rows;
use crate::error::refusal;
use crate::interruption::unless_interrupted;

/// A grey picture of whoever calls: rows of pixels, of any kind of number.
type GrayArray<'py> = PyArrayLike2<'py, f32, AllowTypeChange>;
/// Pixels that count.
type MaskArray<'py> = PyArrayLike2<'py, bool>;

/// Peak of a correlation surface: where the patch lies in the picture.
#[pyclass(name = "Match", module = "pilotage", frozen, get_all)]
pub struct PythonMatch {
    /// Column of the patch's left edge in the picture, between the pixels.
    x: f64,
    /// Row of its top edge.
    y: f64,
    /// Score at the summit, -1 to 1.
    score: f64,
    /// Score of the highest other peak, at least half a patch away; None if there is none.
    second_score: Option<f64>,
}

#[pymethods]
impl PythonMatch {
    fn __repr__(&self) -> String {
        let Self { x, y, score, .. } = self;
        format!("<Match at x {x:.2}, y {y:.2}: score {score:.3}>")
    }
}

fn gray(array: &GrayArray<'_>, what: &str) -> PyResult<Gray> {
    let array = array.as_array();
    let (height, width) = array.dim();
    let pixels: Vec<f32> = array.iter().copied().collect();
    Gray::from_pixels(width, height, pixels)
        .ok_or_else(|| refusal(format!("{what} has no rows of pixels")))
}

fn template(patch: &GrayArray<'_>, mask: Option<&MaskArray<'_>>) -> PyResult<Template> {
    let patch = gray(patch, "the patch")?;
    let made = match mask {
        None => Template::new(&patch),
        Some(mask) => {
            let mask = mask.as_array();
            let (height, width) = mask.dim();
            let counts = mask.iter().copied().collect();
            let mask = Raster::from_pixels(width, height, counts);
            mask.and_then(|mask| Template::masked(&patch, &mask))
        }
    };
    made.ok_or_else(|| {
        refusal("the patch matches nothing: it is empty or flat, or the mask has another size")
    })
}

/// Correlation surface of patch and picture, checked for their sizes.
fn surface(
    py: Python<'_>,
    picture: &GrayArray<'_>,
    patch: &GrayArray<'_>,
    mask: Option<&MaskArray<'_>>,
) -> PyResult<Gray> {
    let template = template(patch, mask)?;
    let picture = gray(picture, "the picture")?;
    if template.width() > picture.width() || template.height() > picture.height() {
        let (w, h) = (template.width(), template.height());
        let (width, height) = (picture.width(), picture.height());
        return Err(refusal(format!(
            "the patch of {w} × {h} pixels does not fit into the picture of {width} × {height}"
        )));
    }
    unless_interrupted(py, move |_| Ok(template.correlate(&picture)))
}

/// Zero-mean normalized correlation of a patch at all places of a picture, -1 to 1 (OpenCV's `TM_CCOEFF_NORMED`, but 0
/// where the window or the patch is flat), float32.
///
/// Of the patch only the pixels count where `mask` is true.
#[pyfunction]
#[pyo3(signature = (picture, patch, *, mask = None))]
pub fn correlate<'py>(
    py: Python<'py>,
    picture: GrayArray<'py>,
    patch: GrayArray<'py>,
    mask: Option<MaskArray<'py>>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let surface = surface(py, &picture, &patch, mask.as_ref())?;
    let width = surface.width();
    rows(py, width, surface.pixels().to_vec())
}

/// The place of a patch in a picture by normalized correlation, to a fraction of a pixel, with the runner-up's score.
#[pyfunction]
#[pyo3(signature = (picture, patch, *, mask = None))]
pub fn match_patch<'py>(
    py: Python<'py>,
    picture: GrayArray<'py>,
    patch: GrayArray<'py>,
    mask: Option<MaskArray<'py>>,
) -> PyResult<PythonMatch> {
    let away = {
        let (height, width) = patch.as_array().dim();
        0.5 * width.min(height) as f64
    };
    let surface = surface(py, &picture, &patch, mask.as_ref())?;
    let peak = highest_peak(&surface)
        .ok_or_else(|| refusal("the correlation has no peak: a pixel is no number"))?;
    Ok(PythonMatch {
        x: peak.x,
        y: peak.y,
        score: peak.value,
        second_score: rival_peak(&surface, &peak, away).map(|rival| rival.value),
    })
}
