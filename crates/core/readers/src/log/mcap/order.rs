//! Rows in the order of their times, where a file has them in another.

use crate::log::{Rows, Topic};

/// Fewest rows of a stretch that a clock which was set, or a recording of its own, is believed to have left.
const LONG: usize = 10;
/// Most times that two stretches take turns where a chunk or a message came late, and no clock was set.
const TURNS: usize = 3;

/// Puts the rows of a topic in order: messages may stand in a file as they reached its writer, and count by the time at
/// which they were logged. Where the clock was set back, or another recording follows, so that long stretches would be mixed
/// row by row, rows stay as they are.
pub(super) fn put_in_order(topic: &mut Topic) {
    let times = &topic.times;
    if times.is_sorted() {
        return;
    }
    let mut long: Vec<&[f64]> = times
        .chunk_by(|before, after| before <= after)
        .filter(|stretch| stretch.len() >= LONG)
        .collect();
    long.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut latest: Option<&[f64]> = None;
    for stretch in long {
        if latest.is_some_and(|before| take_turns(before, stretch)) {
            return;
        }
        if latest.is_none_or(|before| before.last() <= stretch.last()) {
            latest = Some(stretch);
        }
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

/// Whether two rising stretches of times, the second of which begins later, would be mixed row by row.
fn take_turns(first: &[f64], second: &[f64]) -> bool {
    let mut rest = [first, second];
    let (mut of, mut turns) = (0, 0);
    while turns <= TURNS {
        let Some(next) = rest[1 - of].first() else {
            return false;
        };
        // Of equal times the first stretch's go first.
        let taken =
            rest[of].partition_point(|time| if of == 0 { time <= next } else { time < next });
        rest[of] = &rest[of][taken..];
        of = 1 - of;
        turns += 1;
    }
    true
}
