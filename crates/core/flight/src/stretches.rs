//! Stretches of a flight in which something holds: when it stood, when it flew.

/// Speeds below this are those of something that stands, m/s.
pub const STANDING: f64 = 3.0;
/// Share of the fast speeds of the flight from which on it flies.
pub const FLYING_SHARE: f64 = 0.35;
/// Height above the start from which on it hovers at least, metres.
pub const HOVERING: f64 = 3.0;
/// Shortest stretch that counts, and longest pause inside one, seconds.
pub const LEAST: f64 = 3.0;

/// Joins what is less than a pause apart and leaves out what is shorter than that.
///
/// ```
/// use pilotage_flight::stretches::stretches;
///
/// // Flies from 2 s to 20 s and for a moment at 60 s; one sample a second, with a gap of two.
/// let flies = |t: usize| (2..=20).contains(&t) && t != 9 || t == 60;
/// let found = stretches((0..100).map(|t| (t as f64, flies(t))));
/// assert_eq!(found, [(2.0, 20.0)]);
/// ```
pub fn stretches(flying: impl IntoIterator<Item = (f64, bool)>) -> Vec<(f64, f64)> {
    stretches_within(flying, LEAST)
}

/// The same, with another longest pause inside one, seconds.
pub fn stretches_within(
    flying: impl IntoIterator<Item = (f64, bool)>,
    pause: f64,
) -> Vec<(f64, f64)> {
    let mut found: Vec<(f64, f64)> = Vec::new();
    for (time, _) in flying.into_iter().filter(|(_, is_flying)| *is_flying) {
        match found.last_mut() {
            Some((_, to)) if time - *to <= pause => *to = time,
            _ => found.push((time, time)),
        }
    }
    found.retain(|(from, to)| to - from >= LEAST);
    found
}
