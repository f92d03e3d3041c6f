//! Maps of few entries.

use std::borrow::Borrow;

/// Map of few entries: a list of pairs that is looked through from its start. A hash map costs some three kilobytes of
/// the page's program for each type of its entries, which a dozen of them are not worth.
#[derive(Clone, Debug)]
pub struct ShortMap<K, V>(Vec<(K, V)>);

impl<K, V> Default for ShortMap<K, V> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<K: PartialEq, V> ShortMap<K, V> {
    fn place<Q: PartialEq + ?Sized>(&self, key: &Q) -> Option<usize>
    where
        K: Borrow<Q>,
    {
        self.0.iter().position(|(own, _)| own.borrow() == key)
    }

    /// Value of a key.
    pub fn get<Q: PartialEq + ?Sized>(&self, key: &Q) -> Option<&V>
    where
        K: Borrow<Q>,
    {
        self.place(key).map(|at| &self.0[at].1)
    }

    /// Whether it has a key.
    pub fn contains_key<Q: PartialEq + ?Sized>(&self, key: &Q) -> bool
    where
        K: Borrow<Q>,
    {
        self.place(key).is_some()
    }

    /// Puts a value under a key, in the place of the one that was there.
    ///
    /// ```
    /// use pilotage_ui::short_map::ShortMap;
    ///
    /// let mut map = ShortMap::default();
    /// map.insert("a", 1);
    /// map.insert("a", 2);
    /// assert_eq!(map.iter().collect::<Vec<_>>(), [(&"a", &2)]);
    /// ```
    pub fn insert(&mut self, key: K, value: V) {
        match self.place::<K>(&key) {
            Some(at) => self.0[at].1 = value,
            None => self.0.push((key, value)),
        }
    }

    /// Takes a key away; its value, if it was there.
    pub fn remove<Q: PartialEq + ?Sized>(&mut self, key: &Q) -> Option<V>
    where
        K: Borrow<Q>,
    {
        self.place(key).map(|at| self.0.remove(at).1)
    }

    /// Forgets the entries whose values are not to be kept.
    pub fn retain(&mut self, mut is_kept: impl FnMut(&mut V) -> bool) {
        self.0.retain_mut(|(_, value)| is_kept(value));
    }

    /// Entries in the order in which their keys came.
    pub fn iter(&self) -> impl Iterator<Item = (&K, &V)> {
        self.0.iter().map(|(key, value)| (key, value))
    }

    /// Takes all entries away.
    pub fn drain(&mut self) -> impl Iterator<Item = (K, V)> + '_ {
        self.0.drain(..)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Forgets all entries.
    pub fn clear(&mut self) {
        self.0.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_has_one_value_and_entries_keep_their_order() {
        let mut map = ShortMap::default();
        map.insert(3, "c");
        map.insert(1, "a");
        map.insert(3, "d");
        assert_eq!(map.get(&3), Some(&"d"));
        assert_eq!(map.iter().collect::<Vec<_>>(), [(&3, &"d"), (&1, &"a")]);
        assert_eq!((map.remove(&3), map.remove(&3)), (Some("d"), None));
        assert!(map.contains_key(&1) && !map.contains_key(&3));
        map.insert(2, "b");
        map.retain(|value| *value != "b");
        assert_eq!(map.drain().collect::<Vec<_>>(), [(1, "a")]);
        assert!(map.is_empty());
    }
}
