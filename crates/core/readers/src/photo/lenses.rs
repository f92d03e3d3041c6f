//! Photos of several lenses of one aircraft, which may have one size.

use super::read::Photo;

/// Ratio of two focal lengths from which on they are of two lenses.
const OTHER: f64 = 1.05;

/// Reads a focal length of a photo, metres.
type FocalLength = fn(&Photo) -> Option<f64>;

/// Leaves the photos of the lens that took most of them, of equals the one that sees most, and those that tell no focal
/// length, with a note that calls all of them `what`.
pub(super) fn of_one_lens(photos: &mut Vec<Photo>, what: &str, notes: &mut Vec<String>) {
    let count = |of: FocalLength| photos.iter().filter_map(of).count();
    let film: FocalLength = |photo| photo.focal_length_35;
    let own: FocalLength = |photo| photo.focal_length;
    let focal = if count(film) >= count(own) { film } else { own };
    let mut lengths: Vec<f64> = photos.iter().filter_map(focal).collect();
    lengths.sort_by(f64::total_cmp);
    let lenses: Vec<&[f64]> = lengths.chunk_by(|a, b| *b < OTHER * a).collect();
    let most = lenses.iter().rev().max_by_key(|lens| lens.len());
    let Some(most) = most.filter(|_| lenses.len() > 1) else {
        return;
    };
    let millimetres = |lens: &[f64]| format!("{:.0} mm", 1e3 * lens[lens.len() / 2]);
    let others = lenses.iter().filter(|lens| lens != &most);
    let others: Vec<String> = others
        .map(|lens| format!("{} of {}", lens.len(), millimetres(lens)))
        .collect();
    notes.push(format!(
        "{what} are of several lenses: those of a focal length of {} are taken, others were left out: {}. Put them into a \
         folder of their own to open them",
        millimetres(most),
        others.join(", ")
    ));
    photos.retain(|photo| focal(photo).is_none_or(|length| most.contains(&length)));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn photos(lengths: &[(usize, Option<f64>)]) -> Vec<Photo> {
        let of = |(count, millimetres): &(usize, Option<f64>)| {
            let photo = Photo {
                focal_length_35: millimetres.map(|length| 1e-3 * length),
                ..Photo::default()
            };
            vec![photo; *count]
        };
        lengths.iter().flat_map(of).collect()
    }

    #[test]
    fn the_lens_of_most_photos_is_taken_and_the_others_are_told() {
        let mut found = photos(&[(6, Some(24.0)), (4, Some(162.0)), (1, None)]);
        let mut notes = Vec::new();
        of_one_lens(&mut found, "the photos", &mut notes);
        assert_eq!(found.len(), 7);
        assert!(
            notes[0].contains("24 mm") && notes[0].contains("4 of 162 mm"),
            "{notes:?}"
        );
        // Of equals the wide one; what differs by less than a twentieth is one lens.
        let mut found = photos(&[(3, Some(162.0)), (2, Some(24.0)), (1, Some(24.5))]);
        of_one_lens(&mut found, "the photos", &mut Vec::new());
        assert!(found.iter().all(|it| it.focal_length_35 < Some(0.1)) && found.len() == 3);
        let mut found = photos(&[(3, Some(24.0)), (2, None)]);
        let mut notes = Vec::new();
        of_one_lens(&mut found, "the photos", &mut notes);
        assert!(found.len() == 5 && notes.is_empty());
    }
}
