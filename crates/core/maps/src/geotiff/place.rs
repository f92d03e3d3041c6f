//! Placement of the pixels of a `GeoTIFF`, in the coordinates of its reference system.

use super::super::tiff::{Directory, Tag, TiffError};
use pilotage_base::georeference::WorldFile;

/// Coordinates of the pixels from the tags of a directory; `None` if there are no such tags.
///
/// `is_point` says that the tags count from the centre of the first pixel, not from its corner.
pub fn world_file(directory: &Directory, is_point: bool) -> Result<Option<WorldFile>, TiffError> {
    let matrix = directory.reals(Tag::ModelTransformation)?;
    let scale = directory.reals(Tag::ModelPixelScale)?;
    let ties = directory.reals(Tag::ModelTiepoint)?;
    let (tag, [a, b, d, e, x, y]) = if let [a, b, _, x, d, e, _, y, ..] = matrix[..] {
        (Tag::ModelTransformation, [a, b, d, e, x, y])
    } else if let ([width, height, ..], [column, row, _, x, y, _, ..]) = (&scale[..], &ties[..]) {
        // Pixels down go south, whatever sign the height has: so do GDAL and all programs that stand on it.
        let (a, e) = (*width, -height.abs());
        let corner = [a, 0.0, 0.0, e, x - column * a, y - row * e];
        (Tag::ModelPixelScale, corner)
    } else if ties.len() >= 6 {
        return Err(directory.blame(&Tag::ModelTiepoint.name()).unsupported(
            "the map is tied to the ground by points only; warp it with them (gdalwarp), or \
             georeference it anew",
        ));
    } else {
        return Ok(None);
    };
    // World files count from the centre of the first pixel.
    let half = if is_point { 0.0 } else { 0.5 };
    let file = WorldFile {
        a,
        d,
        b,
        e,
        c: x + half * (a + b),
        f: y + half * (d + e),
    };
    let area = a * e - b * d;
    if area.is_finite() && area != 0.0 && file.c.is_finite() && file.f.is_finite() {
        Ok(Some(file))
    } else {
        Err(directory
            .blame(&tag.name())
            .damaged("its numbers do not span an area"))
    }
}

/// Whether the height of pixels is negative, which no document defines, where nothing goes before it.
pub fn has_negative_height(directory: &Directory) -> bool {
    let [matrix, scale] = [Tag::ModelTransformation, Tag::ModelPixelScale]
        .map(|tag| directory.reals(tag).unwrap_or_default());
    matrix.is_empty() && scale.get(1).is_some_and(|height| *height < 0.0)
}

/// Scale and offset of samples that are heights, by the third numbers of pixel and tie: height = scale · sample + offset.
/// `None` where they say nothing; a scale of 0 stands where it is not known.
pub fn heights_scale(directory: &Directory) -> Option<(f64, f64)> {
    let scale = directory.reals(Tag::ModelPixelScale).ok()?;
    let ties = directory.reals(Tag::ModelTiepoint).ok()?;
    let (&[_, _, scale, ..], &[_, _, sample, _, _, height, ..]) = (&scale[..], &ties[..]) else {
        return None;
    };
    let offset = height - sample * scale;
    let is_said = scale != 0.0 && scale.is_finite() && offset.is_finite();
    (is_said && (scale, offset) != (1.0, 0.0)).then_some((scale, offset))
}

/// Whether coefficients of a satellite's camera place the pixels.
pub(super) fn is_placed_by_camera(directory: &Directory) -> bool {
    (directory.reals(Tag::RpcCoefficients)).is_ok_and(|numbers| !numbers.is_empty())
}
