//! Fixes of photos against their truth.

use std::fmt;

use nalgebra::{Matrix2, Vector2};

/// Counts over photos.
#[derive(Clone, Debug, Default)]
pub struct FixTally {
    photos: usize,
    /// Distances from the truth, metres.
    errors: Vec<f64>,
    /// Sum of their normalized squares.
    squares: f64,
}

impl FixTally {
    /// Counts a photo, whose fix has this error (metres north, east) and covariance.
    pub fn add(&mut self, name: &str, probability: f64, fix: Option<(Vector2<f64>, Matrix2<f64>)>) {
        self.photos += 1;
        let Some((error, covariance)) = fix else {
            println!("{name}: no fix, probability {probability:.3}");
            return;
        };
        println!(
            "{name}: {:.1} m off, of a deviation of {:.1} m, probability {probability:.3}",
            error.norm(),
            covariance.trace().sqrt()
        );
        self.squares += (covariance.try_inverse().unwrap() * error).dot(&error);
        self.errors.push(error.norm());
    }

    /// Fixes at most so many metres off.
    pub fn within(&self, metres: f64) -> usize {
        self.errors.iter().filter(|error| **error <= metres).count()
    }
}

impl fmt::Display for FixTally {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut sorted = self.errors.clone();
        sorted.sort_by(f64::total_cmp);
        let fixes = sorted.len();
        write!(
            to,
            "{fixes} fixes of {} photos, {} within 15 m, {} wrong by over 20 m, median {:.1} m, NEES per degree {:.2}",
            self.photos,
            self.within(15.0),
            fixes - self.within(20.0),
            sorted.get(fixes / 2).copied().unwrap_or(f64::NAN),
            self.squares / (2 * fixes).max(1) as f64
        )
    }
}
