//! Outlines of COCO's labels.

/// The box around the polygons of a `segmentation`: left and top, right and bottom edge, pixels. `None` of what is no list of
/// polygons, such as a mask by the lengths of its runs.
pub(super) fn extent(segmentation: &str) -> Option<[[f64; 2]; 2]> {
    let polygons: Vec<Vec<f64>> = serde_json::from_str(segmentation).ok()?;
    let mut corners = polygons
        .iter()
        .flat_map(|polygon| polygon.as_chunks::<2>().0);
    let first = *corners.next()?;
    Some(corners.fold([first; 2], |[low, high], corner| {
        let with = |edge: [f64; 2], of: fn(f64, f64) -> f64| {
            [of(edge[0], corner[0]), of(edge[1], corner[1])]
        };
        [with(low, f64::min), with(high, f64::max)]
    }))
}
