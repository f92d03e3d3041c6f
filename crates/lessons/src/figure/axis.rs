//! Axes with round numbers.

/// Axis of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Number at its begin.
    pub from: f64,
    /// Number at its end.
    pub to: f64,
    /// Words with the unit.
    pub label: String,
}

impl Axis {
    /// Axis over a range.
    pub fn new([from, to]: [f64; 2], label: impl Into<String>) -> Self {
        Self {
            from,
            to,
            label: label.into(),
        }
    }

    /// Share of the way from its begin to its end.
    pub fn share(&self, number: f64) -> f64 {
        (number - self.from) / (self.to - self.from)
    }

    /// Round numbers along it, about `count` of them, with the decimals that they need.
    ///
    /// ```
    /// use pilotage_lessons::figure::Axis;
    ///
    /// // A fifth of a kilometre apart: -0.2, 0.0, 0.2, 0.4 and 0.6 km.
    /// let (ticks, decimals) = Axis::new([-0.3, 0.7], "distance, km").ticks(5);
    /// assert_eq!((ticks.len(), decimals), (5, 1));
    /// assert!((ticks[0] + 0.2).abs() < 1e-12 && (ticks[4] - 0.6).abs() < 1e-12);
    /// ```
    pub fn ticks(&self, count: usize) -> (Vec<f64>, usize) {
        let span = (self.to - self.from).abs();
        let raw = span / count.max(1) as f64;
        let order = 10f64.powf(raw.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .into_iter()
            .map(|factor| factor * order)
            .find(|step| *step >= raw * 0.999)
            .unwrap_or(order);
        let (low, high) = (self.from.min(self.to), self.from.max(self.to));
        let first = (low / step - 1e-9).ceil() as i64;
        let last = (high / step + 1e-9).floor() as i64;
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        ((first..=last).map(|n| n as f64 * step).collect(), decimals)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within_the_axis() {
        let (ticks, decimals) = Axis::new([0.0, 60.0], "time, s").ticks(6);
        assert_eq!(ticks, [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
        assert_eq!(decimals, 0);
        let (ticks, decimals) = Axis::new([-0.25, 0.25], "x").ticks(5);
        assert_eq!(ticks.len(), 5);
        assert_eq!(decimals, 1);
        assert!((Axis::new([10.0, 0.0], "down").share(2.5) - 0.75).abs() < 1e-12);
    }
}
