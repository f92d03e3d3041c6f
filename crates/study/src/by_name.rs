//! Settings by their names. A plan has few, and the page, which has plans too, links no tree for them.

use std::fmt::{Formatter, Result as FormatResult};
use std::marker::PhantomData;

use serde::de::{Error as _, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Values by name, in the order of the names.
#[derive(Clone, Debug, PartialEq)]
pub struct ByName<T>(Vec<(String, T)>);

impl<T> Default for ByName<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T> ByName<T> {
    /// Number of them.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The one of that name.
    pub fn get(&self, name: &str) -> Option<&T> {
        let found = self.0.iter().find(|(own, _)| own == name);
        found.map(|(_, value)| value)
    }

    /// Adds one in its place; false where there is one of that name, which stays.
    pub(crate) fn add(&mut self, name: String, value: T) -> bool {
        let at = self.0.partition_point(|(own, _)| *own < name);
        let is_new = self.0.get(at).is_none_or(|(own, _)| *own != name);
        if is_new {
            self.0.insert(at, (name, value));
        }
        is_new
    }

    /// All names.
    pub fn keys(&self) -> impl DoubleEndedIterator<Item = &String> {
        self.0.iter().map(|(name, _)| name)
    }

    /// All values.
    pub fn values(&self) -> impl DoubleEndedIterator<Item = &T> {
        self.0.iter().map(|(_, value)| value)
    }

    /// All of them with their names, each made something else.
    pub(crate) fn into_named<U>(self, make: impl Fn(T) -> U) -> Vec<(String, U)> {
        let values = self.0.into_iter();
        values.map(|(name, value)| (name, make(value))).collect()
    }

    /// Of values in the order of their names, each made of something else.
    pub(crate) fn of_named<U>(named: Vec<(String, U)>, make: impl Fn(U) -> T) -> Self {
        let values = named.into_iter();
        Self(values.map(|(name, value)| (name, make(value))).collect())
    }

    /// All of them with their names.
    pub fn iter(&self) -> impl Iterator<Item = (&String, &T)> {
        self.0.iter().map(|(name, value)| (name, value))
    }
}

impl<T: Serialize> Serialize for ByName<T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.iter())
    }
}

impl<'d, T: Deserialize<'d>> Deserialize<'d> for ByName<T> {
    fn deserialize<D: Deserializer<'d>>(from: D) -> Result<Self, D::Error> {
        struct Named<T>(PhantomData<T>);

        impl<'d, T: Deserialize<'d>> Visitor<'d> for Named<T> {
            type Value = ByName<T>;

            fn expecting(&self, to: &mut Formatter<'_>) -> FormatResult {
                to.write_str("settings by their names")
            }

            fn visit_map<A: MapAccess<'d>>(self, mut map: A) -> Result<ByName<T>, A::Error> {
                let mut named = ByName::default();
                while let Some((name, value)) = map.next_entry::<String, T>()? {
                    let words = format!("\"{name}\" is set twice");
                    if !named.add(name, value) {
                        return Err(A::Error::custom(words));
                    }
                }
                Ok(named)
            }
        }

        from.deserialize_map(Named(PhantomData))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_come_in_the_order_of_their_names_and_none_twice() {
        let named: ByName<f64> = basic_toml::from_str("wind = 2\nalpha = 1\n").unwrap();
        assert_eq!(named.keys().collect::<Vec<_>>(), ["alpha", "wind"]);
        assert_eq!(named.values().rev().collect::<Vec<_>>(), [&2.0, &1.0]);
        assert_eq!(
            (named.get("wind"), named.get("w"), named.len()),
            (Some(&2.0), None, 2)
        );
        assert_eq!(
            basic_toml::to_string(&named).unwrap(),
            "alpha = 1.0\nwind = 2.0\n"
        );
        let twice = basic_toml::from_str::<ByName<f64>>("wind = 2\nwind = 1\n");
        assert!(twice.unwrap_err().to_string().contains("wind"));
    }
}
