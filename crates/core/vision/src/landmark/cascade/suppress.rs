//! Windows that mean the same thing, told apart from those that do not by how much they overlap.

use super::scan::{Rectangle, Scanned};

/// Strength with which overlapping windows weaken each other: the square of the overlap at which a window
/// keeps exp(-1) of its margin.
const SPREAD: f64 = 0.1;

/// A window and what is left of its margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Suppressed {
    /// The window.
    pub window: Scanned,
    /// Its margin, less for every better window that it overlaps.
    pub score: f64,
}

impl Rectangle {
    /// Area shared with another rectangle, as a share of what the two cover together.
    ///
    /// ```
    /// use pilotage_vision::landmark::cascade::Rectangle;
    ///
    /// let at = |x| Rectangle { x, y: 0, width: 10, height: 10 };
    /// // Half of each is shared: 50 of 150 pixels.
    /// assert!((at(0).overlap(&at(5)) - 1.0 / 3.0).abs() < 1e-12);
    /// assert_eq!(at(0).overlap(&at(10)), 0.0);
    /// ```
    pub fn overlap(&self, other: &Self) -> f64 {
        let shared =
            |a: i32, b: i32, c: i32, d: i32| f64::from(((a + b).min(c + d) - a.max(c)).max(0));
        let both = shared(self.x, self.width, other.x, other.width)
            * shared(self.y, self.height, other.y, other.height);
        let area = |r: &Self| f64::from(r.width) * f64::from(r.height);
        let either = area(self) + area(other) - both;
        if either > 0.0 { both / either } else { 0.0 }
    }
}

/// The windows from the best to the worst, each weakened by those before it that it overlaps, without
/// those of which less than `least` of the margin is left (a share, 0 to 1).
///
/// Soft non-maximum suppression with a Gaussian (Bodla et al. 2017, "Soft-NMS", eq. 2). Windows that
/// passed more stages come first; only they are weakened by nobody that passed less.
pub fn soft_suppressed(windows: &[Scanned], least: f64) -> Vec<Suppressed> {
    let mut left: Vec<(Scanned, f64)> = windows.iter().map(|w| (*w, 1.0)).collect();
    let mut kept = Vec::new();
    let worth = |(window, share): &(Scanned, f64)| window.margin.max(0.0) * share;
    while let Some(best) = (0..left.len()).max_by(|&i, &j| {
        let (a, b) = (&left[i], &left[j]);
        let by_stages = a.0.stages.cmp(&b.0.stages);
        let by_worth = worth(a).total_cmp(&worth(b));
        // Of equals the first.
        by_stages.then(by_worth).then(j.cmp(&i))
    }) {
        let (window, share) = left.swap_remove(best);
        kept.push(Suppressed {
            window,
            score: window.margin * share,
        });
        left.retain_mut(|(other, share)| {
            let overlap = other.rectangle.overlap(&window.rectangle);
            *share *= (-overlap * overlap / SPREAD).exp();
            *share >= least
        });
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn window(x: i32, stages: usize, margin: f64) -> Scanned {
        Scanned {
            rectangle: Rectangle {
                x,
                y: 5,
                width: 20,
                height: 20,
            },
            score: 0.0,
            stages,
            margin,
        }
    }

    #[test]
    fn the_best_of_each_heap_is_left_with_what_it_had() {
        let windows = [
            window(0, 3, 1.0),
            window(2, 3, 2.0),
            window(3, 3, 1.5),
            window(60, 3, 0.5),
            window(62, 2, 9.0),
        ];
        let kept = soft_suppressed(&windows, 0.3);
        let places: Vec<i32> = kept.iter().map(|k| k.window.rectangle.x).collect();
        assert_eq!(places, [2, 60]);
        assert_eq!((kept[0].score, kept[1].score), (2.0, 0.5));
    }

    #[test]
    fn a_window_that_overlaps_a_little_is_weakened_and_not_lost() {
        let kept = soft_suppressed(&[window(0, 3, 2.0), window(15, 3, 1.0)], 0.3);
        assert_eq!(kept.len(), 2);
        assert!(
            kept[1].score < 1.0 && kept[1].score > 0.7,
            "{}",
            kept[1].score
        );
    }
}
