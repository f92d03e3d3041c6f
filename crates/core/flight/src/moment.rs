//! Moments in sentences: whoever shows a sentence tells them by its own clock.

/// Mark before and behind a moment, which nobody sees.
const MARK: char = '\u{2063}';

/// A moment in a sentence, seconds in the log's time base; [`with_moments`] tells it by another clock.
pub fn moment(time: f64) -> String {
    format!("{MARK}{time:.1} s{MARK}")
}

/// The sentence with its moments as `clock` tells them, which is given seconds in the log's time base.
///
/// ```
/// use pilotage_flight::{moment, with_moments};
///
/// let told = format!("There is no sample between {} and {}.", moment(400.0), moment(412.34));
/// let by_log = with_moments(&told, |time| format!("{time:.1} s"));
/// assert_eq!(by_log, "There is no sample between 400.0 s and 412.3 s.");
/// let since_take_off = with_moments(&told, |time| format!("0:{:02.0}", time - 380.0));
/// assert_eq!(since_take_off, "There is no sample between 0:20 and 0:32.");
/// ```
pub fn with_moments(text: &str, clock: impl Fn(f64) -> String) -> String {
    let parts = text.split(MARK).enumerate();
    let told = parts.map(|(number, part)| {
        let time = part.strip_suffix(" s").and_then(|time| time.parse().ok());
        match time.filter(|_| number % 2 == 1) {
            Some(time) => clock(time),
            None => part.to_owned(),
        }
    });
    told.collect()
}

/// The sentence with its moments in seconds of the log's time base.
pub fn in_log_time(text: &str) -> String {
    with_moments(text, |time| format!("{time:.1} s"))
}
