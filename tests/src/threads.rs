//! Work shared out among the processors.

use std::sync::Mutex;
use std::thread::ScopedJoinHandle;

/// Results of `work` on each of the items, in their order, on as many threads as there are processors.
///
/// # Panics
/// If the work does.
pub fn on_all_processors<I: Send, O: Send>(
    items: impl IntoIterator<Item = I, IntoIter: Send>,
    work: impl Fn(I) -> O + Sync,
) -> Vec<O> {
    let queue = Mutex::new(items.into_iter().enumerate());
    let next = || queue.lock().expect("no item fails to be taken").next();
    let some = || -> Vec<(usize, O)> {
        let items = std::iter::from_fn(next);
        items.map(|(number, item)| (number, work(item))).collect()
    };
    let processors = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let mut all: Vec<(usize, O)> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..processors).map(|_| scope.spawn(some)).collect();
        let done = threads.into_iter().map(ScopedJoinHandle::join);
        done.flat_map(|done| done.expect("the work is done"))
            .collect()
    });
    all.sort_by_key(|(number, _)| *number);
    all.into_iter().map(|(_, done)| done).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_made_of_items_comes_in_their_order_whoever_is_done_first() {
        let slow_first = |number: u64| {
            std::thread::sleep(std::time::Duration::from_millis(20 / (1 + number)));
            number * number
        };
        assert_eq!(on_all_processors(0..5, slow_first), [0, 1, 4, 9, 16]);
        assert!(on_all_processors(0..0, slow_first).is_empty());
    }
}
