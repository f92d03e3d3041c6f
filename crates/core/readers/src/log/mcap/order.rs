//! Rows in the order of their times, where a file has them in another.

use crate::log::{Rows, Topic};

/// Puts the rows of a topic in order: messages may stand in a file as they reached its writer, and count by the time at
/// which they were logged. Where the clock was set back once, or another recording follows, rows stay as they are.
pub(super) fn put_in_order(topic: &mut Topic) {
    let times = &topic.times;
    let mut back = (1..times.len()).filter(|row| times[*row] < times[row - 1]);
    let Some(first) = back.next() else { return };
    let of = |part: &[f64]| {
        let least = part.iter().copied().fold(f64::INFINITY, f64::min);
        (
            least,
            part.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        )
    };
    let (before, after) = times.split_at(first);
    let (before, after) = (of(before), of(after));
    if back.next().is_none() && before.0 <= after.1 && after.0 <= before.1 {
        return;
    }
    let mut order: Vec<usize> = (0..times.len()).collect();
    order.sort_by(|a, b| times[*a].total_cmp(&times[*b]));
    let mut rows = Rows::new(topic.rows.width());
    for row in order.iter().filter_map(|row| topic.rows.get(*row)) {
        rows.push(row);
    }
    topic.times = order.iter().map(|row| times[*row]).collect();
    topic.rows = rows;
}
