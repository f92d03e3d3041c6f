//! JSON as programs write it that do not ask whether a number is one: `NaN` and `Infinity` (Python's `json`, R) are
//! no JSON.

/// The value in the place of one that is no number.
const NULL: &str = "null";

/// `json` without its numbers that are none, and how many these were; `None` if it has none. A value becomes `null`;
/// at the end of a list behind another value, such as the height of a place, it is left out with its comma. Lines stay
/// as they are, and so do the places in them but behind a `NaN` without a blank before it.
///
/// ```
/// use pilotage_base::loose_json::without_not_a_number;
///
/// let told = r#"{"name": "NaN", "score": NaN, "at": [8.5, 47.3, -Infinity]}"#;
/// let (json, count) = without_not_a_number(told).unwrap();
/// let kept: String = json.split_whitespace().collect();
/// assert_eq!(kept, r#"{"name":"NaN","score":null,"at":[8.5,47.3]}"#);
/// assert_eq!(count, 2);
/// assert_eq!(without_not_a_number(r#"{"name": "NaN"}"#), None);
/// ```
#[must_use]
pub fn without_not_a_number(json: &str) -> Option<(String, usize)> {
    let mut out = String::with_capacity(json.len());
    let mut lists = Vec::new(); // of what is open, whether it is a list
    let mut count = 0;
    // The run of them that was looked at last: bytes of `rest` at its end, and whether it ends its list.
    let mut run = (usize::MAX, false);
    let mut rest = json;
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '"' => length_of_text(rest),
            'N' | 'I' | '-' => match length_of_none(rest) {
                0 => first.len_utf8(),
                length => {
                    count += 1;
                    let is_in_list = lists.last() == Some(&true);
                    if rest.len() <= run.0 {
                        run = end_of_run(&rest[length..]);
                    }
                    if is_in_list && run.1 && take_comma(&mut out) {
                        out.extend(std::iter::repeat_n(' ', length));
                    } else {
                        if length < NULL.len() && out.ends_with(' ') {
                            out.pop();
                        }
                        out.push_str(NULL);
                        out.extend(std::iter::repeat_n(' ', length.saturating_sub(NULL.len())));
                    }
                    rest = &rest[length..];
                    continue;
                }
            },
            '[' | '{' => {
                lists.push(first == '[');
                1
            }
            ']' | '}' => {
                lists.pop();
                1
            }
            _ => first.len_utf8(),
        };
        out.push_str(&rest[..length]);
        rest = &rest[length..];
    }
    (count > 0).then_some((out, count))
}

/// Bytes of the text in quotation marks with which `rest` begins; all of it where it does not end.
fn length_of_text(rest: &str) -> usize {
    let mut is_escaped = true; // its own mark
    for (at, byte) in rest.bytes().enumerate() {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' => is_escaped = true,
            b'"' => return at + 1,
            _ => {}
        }
    }
    rest.len()
}

/// Bytes of the word for what is no number with which `rest` begins; none if it begins otherwise.
fn length_of_none(rest: &str) -> usize {
    let words = ["NaN", "Infinity", "-Infinity", "-NaN"];
    words
        .iter()
        .find(|word| rest.starts_with(**word))
        .map_or(0, |word| word.len())
}

/// Bytes that stand in `rest` behind the numbers that are none with which it goes on, and whether these end the list that
/// it is in.
fn end_of_run(mut rest: &str) -> (usize, bool) {
    loop {
        rest = rest.trim_start();
        if rest.starts_with(']') {
            return (rest.len(), true);
        }
        let behind = rest.strip_prefix(',').map(str::trim_start);
        match behind.map_or(0, length_of_none) {
            0 => return (rest.len(), false),
            length => rest = &behind.unwrap_or_default()[length..],
        }
    }
}

/// Takes the comma away with which `out` ends, blanks aside; whether there was one.
fn take_comma(out: &mut String) -> bool {
    let kept = out.trim_end();
    let Some(at) = kept.strip_suffix(',').map(str::len) else {
        return false;
    };
    out.replace_range(at..=at, " ");
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clean(json: &str) -> serde_json::Value {
        let (json, _) = without_not_a_number(json).unwrap();
        serde_json::from_str(&json).unwrap()
    }

    #[test]
    fn lists_lose_what_is_no_number_and_members_become_null() {
        assert_eq!(clean("[1, NaN]"), serde_json::json!([1]));
        // What comes behind it stays where it is: a height is no latitude.
        assert_eq!(
            clean("[8.5,\n NaN , 40]"),
            serde_json::json!([8.5, null, 40])
        );
        assert_eq!(clean("[1, NaN, -Infinity ]"), serde_json::json!([1]));
        assert_eq!(
            clean("[1, NaN, [NaN]]"),
            serde_json::json!([1, null, [null]])
        );
        assert_eq!(clean("[NaN, NaN]"), serde_json::json!([null]));
        assert_eq!(
            clean(r#"[{"a": Infinity, "b": [{"c": -NaN}]}]"#),
            serde_json::json!([{"a": null, "b": [{"c": null}]}])
        );
    }

    #[test]
    fn a_long_list_takes_no_longer_for_each_of_its_numbers() {
        // Of 200,000 each looked at up to its list's end: 2·10¹⁰ steps, minutes.
        for end in ["]", ", 2]"] {
            let told = format!("[1{}{end}", ", NaN".repeat(200_000));
            let (json, count) = without_not_a_number(&told).unwrap();
            assert_eq!((json.len(), count), (told.len(), 200_000));
        }
    }

    #[test]
    fn texts_lines_and_what_is_no_json_stay() {
        let told = "{\"a \\\" NaN, \": 1,\n\n\"é\": [2,\nNaN]}";
        let (json, count) = without_not_a_number(told).unwrap();
        assert_eq!(count, 1);
        assert_eq!(json.lines().count(), told.lines().count());
        for told in [
            "[1, NaN] @",
            "[1,-Infinity] @",
            "{\"a\": NaN} @",
            "{\"a\":Infinity} @",
        ] {
            let (json, _) = without_not_a_number(told).unwrap();
            assert_eq!(json.find('@'), told.find('@'), "{json}");
        }
        assert_eq!(clean(told)["é"], serde_json::json!([2]));
        assert_eq!(without_not_a_number("\"open NaN"), None);
        assert_eq!(without_not_a_number(""), None);
        assert_eq!(without_not_a_number("-1 Ink"), None);
    }
}
