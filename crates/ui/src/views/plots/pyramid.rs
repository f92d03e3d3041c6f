//! Least and greatest value of any range of a long series, in logarithmic time.

/// Values per block of the next level.
const FAN: usize = 4;

/// Least and greatest of some values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ValueExtent {
    /// Least value.
    pub low: f32,
    /// Greatest value.
    pub high: f32,
}

impl ValueExtent {
    /// Of no value at all.
    const EMPTY: Self = Self {
        low: f32::INFINITY,
        high: f32::NEG_INFINITY,
    };

    fn include(&mut self, other: Self) {
        self.low = self.low.min(other.low);
        self.high = self.high.max(other.high);
    }

    /// Of one value; of none if it is not finite.
    fn of(value: f32) -> Self {
        if value.is_finite() {
            Self {
                low: value,
                high: value,
            }
        } else {
            Self::EMPTY
        }
    }
}

/// A series that grows at its end, with extents of blocks of 4, 16, 64 … values.
///
/// Level k holds one extent per 4^(k+1) values, so the pyramid costs two thirds of the series
/// again, and a push touches one extent per level.
#[derive(Clone, Debug, Default)]
pub(crate) struct ExtentPyramid {
    values: Vec<f32>,
    levels: Vec<Vec<ValueExtent>>,
}

impl ExtentPyramid {
    /// Appends a value; what is not finite is a hole.
    pub fn push(&mut self, value: f32) {
        let mut index = self.values.len();
        self.values.push(value);
        let extent = ValueExtent::of(value);
        for level in &mut self.levels {
            index /= FAN;
            match level.get_mut(index) {
                Some(block) => block.include(extent),
                None => level.push(extent),
            }
        }
        let top = self.levels.last().map_or(self.values.len(), Vec::len);
        if top > FAN {
            let block_of = |members: &mut dyn Iterator<Item = ValueExtent>| {
                members.fold(ValueExtent::EMPTY, |mut all, e| {
                    all.include(e);
                    all
                })
            };
            let level = match self.levels.last() {
                Some(below) => below
                    .chunks(FAN)
                    .map(|c| block_of(&mut c.iter().copied()))
                    .collect(),
                None => self
                    .values
                    .chunks(FAN)
                    .map(|c| block_of(&mut c.iter().copied().map(ValueExtent::of)))
                    .collect(),
            };
            self.levels.push(level);
        }
    }

    /// Appends many values: each level once over what is new, instead of every level for each value.
    pub fn extend(&mut self, values: impl IntoIterator<Item = f32>) {
        let mut from = self.values.len();
        self.values.extend(values);
        let mut below = self.values.len();
        let mut level = 0;
        while below > FAN {
            from /= FAN;
            if level == self.levels.len() {
                self.levels.push(Vec::new());
                from = 0;
            }
            let (lower, upper) = self.levels.split_at_mut(level);
            let blocks = &mut upper[0];
            blocks.truncate(from);
            for block in from..below.div_ceil(FAN) {
                let members = FAN * block..(FAN * (block + 1)).min(below);
                let mut all = ValueExtent::EMPTY;
                match lower.last() {
                    Some(below) => below[members].iter().for_each(|e| all.include(*e)),
                    None => {
                        (self.values[members].iter())
                            .for_each(|v| all.include(ValueExtent::of(*v)));
                    }
                }
                blocks.push(all);
            }
            below = blocks.len();
            level += 1;
        }
    }

    /// Number of values.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// The value at `index`, if it is there and finite.
    pub fn get(&self, index: usize) -> Option<f32> {
        self.values.get(index).copied().filter(|v| v.is_finite())
    }

    /// Extent of the finite values in `from..to`, `None` if there is none.
    pub fn extent(&self, from: usize, to: usize) -> Option<ValueExtent> {
        let mut all = ValueExtent::EMPTY;
        let (mut from, mut to) = (from, to.min(self.values.len()));
        let mut level = 0;
        while from < to {
            // The values themselves count as level 0; `levels[level - 1]` holds the blocks.
            let get = |index: usize| match level {
                0 => ValueExtent::of(self.values[index]),
                _ => self.levels[level - 1][index],
            };
            let top = level == self.levels.len();
            while from < to && (top || !from.is_multiple_of(FAN)) {
                all.include(get(from));
                from += 1;
            }
            while from < to && !to.is_multiple_of(FAN) {
                to -= 1;
                all.include(get(to));
            }
            from /= FAN;
            to /= FAN;
            level += 1;
        }
        (all.low <= all.high).then_some(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers without a pattern, with holes.
    fn series(length: usize) -> Vec<f32> {
        let mut state = 1_u32;
        (0..length)
            .map(|i| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                if i % 37 == 5 {
                    f32::NAN
                } else {
                    (state >> 8) as f32 / 1000.0
                }
            })
            .collect()
    }

    #[test]
    fn the_extent_of_any_range_is_that_of_its_values() {
        let values = series(1234);
        let mut pyramid = ExtentPyramid::default();
        for value in &values {
            pyramid.push(*value);
        }
        for from in (0..1234).step_by(7) {
            for to in (from..=1234).step_by(11) {
                let finite = values[from..to].iter().copied().filter(|v| v.is_finite());
                let low = finite.clone().fold(f32::INFINITY, f32::min);
                let high = finite.fold(f32::NEG_INFINITY, f32::max);
                let expected = (low <= high).then_some(ValueExtent { low, high });
                assert_eq!(pyramid.extent(from, to), expected, "{from}..{to}");
            }
        }
    }

    #[test]
    fn a_pyramid_that_grows_answers_like_one_that_is_complete() {
        let values = series(300);
        let mut pyramid = ExtentPyramid::default();
        for (i, value) in values.iter().enumerate() {
            pyramid.push(*value);
            let finite = values[..=i].iter().copied().filter(|v| v.is_finite());
            let high = finite.fold(f32::NEG_INFINITY, f32::max);
            assert_eq!(pyramid.extent(0, i + 1).map(|e| e.high), Some(high));
        }
    }

    #[test]
    fn values_appended_in_pieces_give_the_same_pyramid_as_one_by_one() {
        let values = series(1300);
        for piece in [1, 3, 4, 17, 64, 1000, 1300] {
            let (mut single, mut pieces) = (ExtentPyramid::default(), ExtentPyramid::default());
            for values in values.chunks(piece) {
                for value in values {
                    single.push(*value);
                }
                pieces.extend(values.iter().copied());
                assert_eq!(single.levels, pieces.levels, "{piece}");
            }
            assert_eq!(pieces.len(), 1300);
        }
    }

    #[test]
    fn a_range_of_holes_has_no_extent() {
        let mut pyramid = ExtentPyramid::default();
        for _ in 0..40 {
            pyramid.push(f32::NAN);
        }
        assert_eq!(pyramid.extent(0, 40), None);
        assert_eq!(pyramid.extent(10, 10), None);
    }
}
