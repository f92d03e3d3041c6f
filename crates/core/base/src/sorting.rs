//! Sorting by one machine code for all types.

use std::cmp::Ordering;

/// Sorts stably, in O(n log n) comparisons and n swaps.
///
/// The library's sort is compiled for each type and order anew, which costs the page's program three kilobytes each;
/// this one only for its swaps. It is for lists of what people see, not for millions of numbers.
///
/// ```
/// let mut heights = [("mast", 61.0_f64), ("barn", 9.5), ("church", 32.0)];
/// pilotage_base::sorting::sort(&mut heights, &|a, b| b.1.total_cmp(&a.1));
/// assert_eq!(heights[1], ("church", 32.0));
/// ```
pub fn sort<T>(items: &mut [T], order: &dyn Fn(&T, &T) -> Ordering) {
    let mut places = places(items.len(), &|a, b| order(&items[a], &items[b]));
    // Each cycle of the permutation by itself; a place that points to itself is done.
    for first in 0..places.len() {
        let mut at = first;
        loop {
            let from = std::mem::replace(&mut places[at], at);
            if from == first {
                break;
            }
            items.swap(at, from);
            at = from;
        }
    }
}

/// Places of the items in their order.
fn places(count: usize, order: &dyn Fn(usize, usize) -> Ordering) -> Vec<usize> {
    let mut places: Vec<usize> = (0..count).collect();
    places.sort_by(|a, b| order(*a, *b));
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_sorts_as_the_library_does_and_as_stably() {
        let mut state = 1_u32;
        let mut drawn = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state >> 16
        };
        for count in [0, 1, 2, 3, 7, 40, 500] {
            let mut own: Vec<(u32, usize)> = (0..count).map(|i| (drawn() % 17, i)).collect();
            let mut expected = own.clone();
            sort(&mut own, &|a, b| a.0.cmp(&b.0));
            expected.sort_by_key(|it| it.0);
            assert_eq!(own, expected);
        }
    }
}
