//! Several numbers in one option.

/// The numbers of `text`, with commas between; the error names the option.
pub fn numbers<const N: usize>(text: &str, option: &str) -> Result<[f64; N], String> {
    let parts: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    parts
        .ok()
        .and_then(|parts| parts.try_into().ok())
        .filter(|parts: &[f64; N]| parts.iter().all(|v| v.is_finite()))
        .ok_or_else(|| format!("{option}: \"{text}\" is not {N} numbers with commas between"))
}
