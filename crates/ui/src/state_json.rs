//! Objects of the state that journeys read.

use serde::Serialize;
use serde_json::Value;

/// Object of keys and values, as `serde_json::json!` writes it for one level. That macro puts an insertion into a map at
/// every key, hundreds of times; this one a pair into a list.
macro_rules! object {
    ({ $($key:literal : $value:expr),* $(,)? }) => {
        $crate::state_json::object_of(vec![$(($key, $crate::state_json::value(&$value))),*])
    };
}

pub(crate) use object;

/// Value as JSON; null if it cannot be.
#[inline(never)]
pub fn value<T: Serialize>(of: &T) -> Value {
    serde_json::to_value(of).unwrap_or_default()
}

/// Object of these pairs.
pub fn object_of(pairs: Vec<(&'static str, Value)>) -> Value {
    let pairs = pairs
        .into_iter()
        .map(|(key, value)| (key.to_owned(), value));
    Value::Object(pairs.collect())
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    #[test]
    fn an_object_is_what_the_common_macro_writes() {
        let (name, none) = (String::from("a"), None::<u8>);
        let of = object!({"name": name, "pair": [1, 2], "none": none, "in": object!({"x": 1.5})});
        let like = json!({"name": "a", "pair": [1, 2], "none": null, "in": {"x": 1.5}});
        assert_eq!(of, like);
    }
}
