//! Sample of a column: its name, its unit, and its cells as numbers or texts.

/// A column: its name, its unit, and some of its cells in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ColumnSample {
    /// Name as the table has it.
    pub name: String,
    /// Unit as the table says it beside the name, or empty.
    pub unit: String,
    /// Numbers of the cells that are numbers.
    pub numbers: Vec<f64>,
    /// Cells that are no numbers and not empty.
    pub texts: Vec<String>,
    /// Cells that are empty.
    pub empty: usize,
}

impl ColumnSample {
    /// Whether nearly all cells that are not empty are numbers.
    pub fn is_numeric(&self) -> bool {
        self.numbers.iter().any(|n| n.is_finite()) && self.numbers.len() >= 19 * self.texts.len()
    }

    /// Smallest and largest number.
    pub fn range(&self) -> Option<(f64, f64)> {
        let finite = self.numbers.iter().copied().filter(|v| v.is_finite());
        finite.fold(None, |range, v| {
            let (low, high) = range.unwrap_or((v, v));
            Some((v.min(low), v.max(high)))
        })
    }

    /// Smallest and largest number, without the hundredth at either end where that lies far off.
    pub fn inner_range(&self) -> Option<(f64, f64)> {
        let mut sorted: Vec<f64> = self
            .numbers
            .iter()
            .copied()
            .filter(|v| v.is_finite())
            .collect();
        sorted.sort_by(f64::total_cmp);
        let skipped = sorted.len() / 100 + usize::from(sorted.len() > 20);
        let inner = sorted.get(skipped..sorted.len().checked_sub(skipped)?)?;
        let (low, high) = (*inner.first()?, *inner.last()?);
        let far = high - low;
        let (first, last) = (*sorted.first()?, *sorted.last()?);
        let near = |end: f64, inner: f64| {
            if (end - inner).abs() > far {
                inner
            } else {
                end
            }
        };
        Some((near(first, low), near(last, high)))
    }

    /// Largest amount of a number.
    pub fn reach(&self) -> f64 {
        self.range()
            .map_or(0.0, |(low, high)| low.abs().max(high.abs()))
    }

    /// Whether all numbers are the same.
    pub fn is_constant(&self) -> bool {
        self.range().is_none_or(|(low, high)| low == high)
    }

    /// Whether all numbers are whole.
    pub fn is_whole(&self) -> bool {
        self.numbers.iter().all(|v| v.fract() == 0.0)
    }

    /// The number in the middle.
    pub fn median(&self) -> Option<f64> {
        let finite = self.numbers.iter().copied().filter(|v| v.is_finite());
        median(finite.collect())
    }

    /// Whether the numbers hardly ever go back, and grow now and then: a clock may be coarser than the rows.
    pub fn goes_on(&self) -> bool {
        let steps = self.numbers.windows(2).filter(|w| w[1] > w[0]).count();
        let back = self.numbers.windows(2).filter(|w| w[1] < w[0]).count();
        steps >= 10 && 100 * steps >= self.numbers.len() && 50 * back < self.numbers.len()
    }

    /// Whether the numbers hardly ever stand still or go back.
    pub fn grows(&self) -> bool {
        let steps = self.numbers.windows(2).filter(|w| w[1] > w[0]).count();
        let back = self.numbers.windows(2).filter(|w| w[1] < w[0]).count();
        let is_few = |back: usize| 50 * back < self.numbers.len();
        self.numbers.len() > 1
            && 10 * steps >= 5 * (self.numbers.len() - 1)
            && (is_few(back) || is_few(back - self.beginnings()))
    }

    /// Times that a counter of 16 to 32 bits begins anew: it goes back from less than three usual steps before its end to as
    /// little behind its beginning.
    fn beginnings(&self) -> usize {
        let steps = self.numbers.windows(2).map(|w| w[1] - w[0]);
        let Some(usual) = median(steps.filter(|step| *step > 0.0).collect()) else {
            return 0;
        };
        let near = 3.0 * usual;
        let ends_near = |number: f64| {
            let lengths = [16, 24, 32].map(|bits| 2_f64.powi(bits));
            let mut lengths = lengths.into_iter().filter(|length| near < 0.1 * length);
            lengths.any(|length| number < length && number > length - near)
        };
        let is_begun = |w: &&[f64]| (0.0..near).contains(&w[1]) && ends_near(w[0]);
        let windows = self.numbers.windows(2).filter(|w| w[1] < w[0]);
        windows.filter(is_begun).count()
    }
}

/// The number in the middle of some, the larger of both if there are two; `None` of none.
pub(crate) fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}
