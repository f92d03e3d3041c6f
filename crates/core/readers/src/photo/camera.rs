//! The camera that took photos, as far as they tell.

use super::read::Photo;

/// Width and diagonal of film that focal lengths are compared by, metres.
const FILM_DIAGONAL: f64 = 0.043_266_6;
/// Focal length over the picture's width of a small drone's wide lens (79.6° across), where nothing is told.
const USUAL_FOCAL_PER_WIDTH: f64 = 0.6;
/// Width over height of most sensors; what is flatter is cut out of them.
const SENSOR_ASPECT: f64 = 4.0 / 3.0;

/// Focal length of a photo in pixels, and in words where it comes from.
pub fn focal_in_pixels(photo: &Photo) -> (f64, &'static str) {
    told(photo).unwrap_or((
        USUAL_FOCAL_PER_WIDTH * photo.width as f64,
        "assumed: they tell nothing of it",
    ))
}

/// Focal length of a photo in pixels, if it tells anything of it.
pub fn told_focal(photo: &Photo) -> Option<f64> {
    told(photo).map(|(focal, _)| focal)
}

fn told(photo: &Photo) -> Option<(f64, &'static str)> {
    if let Some(focal) = photo.calibrated_focal {
        return Some((focal, "as calibrated by the maker"));
    }
    if let Some((focal, pitch)) = photo.focal_length.zip(photo.pixel_pitch) {
        let whence = "from its length and the size of the sensor's pixels";
        return Some((focal / pitch, whence));
    }
    // Both have the same angle from corner to corner, of the sensor as a whole: a picture of 16 : 9 shows
    // all of its width.
    let focal = photo.focal_length_35?;
    let (width, height) = (photo.width as f64, photo.height as f64);
    let (long, short) = (width.max(height), width.min(height));
    let diagonal = long.hypot(short.max(long / SENSOR_ASPECT));
    Some((
        focal * diagonal / FILM_DIAGONAL,
        "from what it would be on film of 35 mm",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn photo(width: usize, height: usize) -> Photo {
        Photo {
            width,
            height,
            ..Photo::default()
        }
    }

    #[test]
    fn the_same_lens_has_the_same_focal_length_in_a_picture_cut_flat() {
        let of = |width, height| {
            let photo = Photo {
                focal_length_35: Some(0.020),
                ..photo(width, height)
            };
            focal_in_pixels(&photo).0
        };
        // 43.2666 mm of diagonal are 5000 pixels of 4000 by 3000.
        assert!((of(4000, 3000) - 20.0 * 5000.0 / 43.2666).abs() < 0.01);
        assert_eq!(of(4000, 2250), of(4000, 3000));
        assert_eq!(of(3000, 4000), of(4000, 3000));
    }

    #[test]
    fn what_is_measured_counts_before_what_is_compared() {
        let measured = Photo {
            focal_length: Some(0.0045),
            pixel_pitch: Some(1.5494e-6),
            focal_length_35: Some(0.025),
            ..photo(4000, 3000)
        };
        assert!((focal_in_pixels(&measured).0 - 2904.3).abs() < 0.1);
        let calibrated = Photo {
            calibrated_focal: Some(3666.7),
            ..measured
        };
        assert_eq!(focal_in_pixels(&calibrated).0, 3666.7);
        assert_eq!(focal_in_pixels(&photo(1000, 500)).0, 600.0);
        assert_eq!(told_focal(&photo(1000, 500)), None);
        assert_eq!(told_focal(&calibrated), Some(3666.7));
    }
}
