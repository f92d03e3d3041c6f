//! Places as KML writes them.

use crate::mission::found::{LonLat, on_globe};

/// The places of a list of coordinates as they stand: between them is space, and some programs write
/// space beside the commas in them as well.
pub(super) fn tuples(text: &str) -> Vec<String> {
    let mut tuples: Vec<String> = Vec::new();
    for part in text.split_whitespace() {
        // Some programs begin every place with a comma, and behind a comma for a height that lacks the next one begins.
        let inner = part.trim_start_matches(',');
        let is_next = |last: &String| {
            let commas = last.trim_end_matches(',').matches(',').count();
            let has_begun = last.matches(',').count() >= 2 || part.starts_with(',') && commas == 1;
            has_begun && inner.contains(',')
        };
        match tuples.last_mut() {
            Some(last) if is_next(last) => tuples.push(inner.to_owned()),
            Some(last) if last.ends_with(',') || part.starts_with(',') => last.push_str(part),
            _ if inner.is_empty() => {}
            _ => tuples.push(inner.to_owned()),
        }
    }
    tuples
}

/// A place of longitude, latitude and perhaps a height, metres; `None` where there are more numbers, as of decimal commas or
/// where the blank between two places lacks, or where the height is none.
pub(super) fn place<'a>(parts: impl Iterator<Item = &'a str>) -> Option<(LonLat, Option<f64>)> {
    let mut parts = parts.map(str::trim);
    let mut number = || parts.next()?.parse::<f64>().ok();
    let (longitude, latitude) = (number()?, number()?);
    let height = match parts.next() {
        None | Some("") => None,
        Some(height) => Some(height.parse::<f64>().ok()?).filter(|metres| metres.is_finite()),
    };
    let is_over = parts.all(str::is_empty);
    (is_over && on_globe(longitude, latitude)).then_some(((longitude, latitude), height))
}
