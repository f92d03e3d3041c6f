//! Numbers for people.

/// Number with a sensible number of digits.
pub(super) fn digits(value: f64) -> String {
    // What would be written as nothing below zero is nothing.
    let value = if value.abs() < 5e-6 { 0.0 } else { value };
    let places = match value.abs() {
        size if size >= 100.0 => 1,
        size if size >= 10.0 => 2,
        size if size >= 0.1 || size == 0.0 => 3,
        _ => 5,
    };
    format!("{value:.places$}")
}
