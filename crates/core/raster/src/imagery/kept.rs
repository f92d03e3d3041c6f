//! Cache of values that were expensive to make, kept while memory allows.

use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Arc, Mutex, PoisonError};

/// Values by key up to a number of bytes, least recently used out first.
pub struct RecentValues<K, V> {
    inner: Mutex<Inner<K, V>>,
    most_bytes: usize,
}

struct Inner<K, V> {
    values: HashMap<K, RecentEntry<V>>,
    bytes: usize,
    clock: u64,
}

struct RecentEntry<V> {
    used: u64,
    bytes: usize,
    value: Arc<V>,
}

impl<K: Eq + Hash + Copy, V> RecentValues<K, V> {
    /// Keeps at most that many bytes, but always the newest value.
    pub fn new(most_bytes: usize) -> Self {
        Self {
            inner: Mutex::new(Inner {
                values: HashMap::new(),
                bytes: 0,
                clock: 0,
            }),
            most_bytes,
        }
    }

    /// The value of `key`, made by `make` (with its size in bytes) unless it is kept.
    pub fn get_or_make<E>(
        &self,
        key: K,
        make: impl FnOnce() -> Result<(V, usize), E>,
    ) -> Result<Arc<V>, E> {
        {
            let mut inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
            inner.clock += 1;
            let now = inner.clock;
            if let Some(entry) = inner.values.get_mut(&key) {
                entry.used = now;
                return Ok(Arc::clone(&entry.value));
            }
        }
        // Made outside the lock, so that two threads can work at once.
        let (value, bytes) = make()?;
        let value = Arc::new(value);
        let mut inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        if inner.bytes + bytes > self.most_bytes {
            inner.forget(self.most_bytes.saturating_sub(bytes));
        }
        inner.clock += 1;
        let kept = RecentEntry {
            used: inner.clock,
            bytes,
            value: Arc::clone(&value),
        };
        inner.bytes += bytes;
        if let Some(old) = inner.values.insert(key, kept) {
            inner.bytes -= old.bytes;
        }
        Ok(value)
    }

    /// Bytes that are kept.
    #[cfg(test)]
    pub fn bytes(&self) -> usize {
        let inner = self.inner.lock().unwrap_or_else(PoisonError::into_inner);
        inner.bytes
    }
}

impl<K: Eq + Hash + Copy, V> Inner<K, V> {
    /// Forgets the oldest until no more than three quarters of `most_bytes` are kept: several at
    /// once, so that the search for the oldest is rare.
    fn forget(&mut self, most_bytes: usize) {
        let mut ages: Vec<(u64, K)> = self.values.iter().map(|(k, v)| (v.used, *k)).collect();
        ages.sort_unstable_by_key(|(used, _)| *used);
        for (_, key) in ages {
            if self.bytes <= most_bytes / 4 * 3 {
                break;
            }
            if let Some(old) = self.values.remove(&key) {
                self.bytes -= old.bytes;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn get(kept: &RecentValues<u32, u32>, key: u32) -> Arc<u32> {
        let made: Result<_, ()> = kept.get_or_make(key, || Ok((key * 2, 10)));
        made.unwrap()
    }

    #[test]
    fn what_was_used_last_survives() {
        let kept = RecentValues::new(100);
        for key in 0..50 {
            assert_eq!(*get(&kept, key), key * 2);
            get(&kept, 0);
            assert!(kept.bytes() <= 100);
        }
        let mut made = false;
        let zero: Result<_, ()> = kept.get_or_make(0, || {
            made = true;
            Ok((1, 10))
        });
        assert_eq!((*zero.unwrap(), made), (0, false));
    }

    #[test]
    fn a_value_larger_than_everything_is_still_given() {
        let kept = RecentValues::new(5);
        assert_eq!(*get(&kept, 7), 14);
        assert_eq!(*get(&kept, 8), 16);
        assert_eq!(kept.bytes(), 10);
    }

    #[test]
    fn a_failure_is_passed_on_and_not_kept() {
        let kept: RecentValues<u32, u32> = RecentValues::new(100);
        assert_eq!(kept.get_or_make(1, || Err("no")), Err("no"));
        assert_eq!(*get(&kept, 1), 2);
    }
}
