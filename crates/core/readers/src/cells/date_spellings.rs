//! Dates and times in spellings of many programs, rewritten in that of ISO 8601.

const MONTHS: [&str; 12] = [
    "january",
    "february",
    "march",
    "april",
    "may",
    "june",
    "july",
    "august",
    "september",
    "october",
    "november",
    "december",
];

const DAYS: [&str; 7] = [
    "monday",
    "tuesday",
    "wednesday",
    "thursday",
    "friday",
    "saturday",
    "sunday",
];

/// Place among `names` of the one that a word is, whole or cut off behind three letters or more.
fn named(names: &[&str], word: &str) -> Option<usize> {
    let lower = word.to_lowercase();
    let found = names.iter().position(|name| name.starts_with(&lower));
    found.filter(|_| lower.len() >= 3)
}

/// The same date and time as ISO 8601 writes it, where it is written without seams (`20240513T100000.5Z`), with dashes
/// all along (`2024-05-13-10-00-00`), or with the name of its month (`13-May-2024 10:00:00`, `May 13, 2024 10:00:00`,
/// `Mon May 13 10:00:00.5 2024`).
pub(super) fn in_iso(text: &str) -> Option<String> {
    without_seams(text)
        .or_else(|| with_dashes(text))
        .or_else(|| with_month(text))
        .or_else(|| with_day(text))
}

/// `Tue 09:30:12 AM`: the day of the week says no date.
fn with_day(text: &str) -> Option<String> {
    let (day, rest) = text.split_once(' ')?;
    named(&DAYS, day.trim_end_matches([',', '.']))?;
    rest.contains(':').then(|| rest.to_owned())
}

fn are_digits(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit())
}

/// `20240513T100000.5Z`, `20240513 10:00:00`, `20240513_100000`, `20240513100000`.
fn without_seams(text: &str) -> Option<String> {
    let (date, time) = text
        .split_at_checked(8)
        .filter(|(date, _)| are_digits(date))?;
    let time = time.strip_prefix(['T', 't', ' ', '_', '-']).unwrap_or(time);
    let time = match time.split_at_checked(6) {
        Some((clock, rest))
            if are_digits(clock) && !rest.starts_with(|c: char| c.is_ascii_digit()) =>
        {
            format!("{}:{}:{}{rest}", &clock[..2], &clock[2..4], &clock[4..])
        }
        _ if time.contains(':') => time.to_owned(),
        _ => return None,
    };
    Some(format!(
        "{}-{}-{}T{time}",
        &date[..4],
        &date[4..6],
        &date[6..]
    ))
}

/// `2024-05-13-10-00-00.5`, `2024-05-13_10:00:00`, `2024_05_13_10_00_00_500`; `2024:134:10:00:00.5` by the day of the year.
fn with_dashes(text: &str) -> Option<String> {
    let end = text
        .find(|c: char| !(c.is_ascii_digit() || "-_:.".contains(c)))
        .unwrap_or(text.len());
    let (clock, zone) = text.split_at(end);
    let parts: Vec<&str> = clock.splitn(6, ['-', '_', ':']).collect();
    if let [year, day, hour, minute, second] = parts.as_slice() {
        let fit = year.len() == 4 && day.len() == 3 && are_digits(day);
        return fit.then(|| format!("{year}-{day}T{hour}:{minute}:{second}{zone}"));
    }
    let [year, month, day, hour, minute, second] = parts.as_slice() else {
        return None;
    };
    let second = second.replacen('_', ".", 1);
    let lengths = [(year, 4), (month, 2), (day, 2), (hour, 2), (minute, 2)];
    let fit = |(text, length): &(&&str, usize)| text.len() == *length && are_digits(text);
    lengths
        .iter()
        .all(fit)
        .then(|| format!("{year}-{month}-{day}T{hour}:{minute}:{second}{zone}"))
}

/// A date whose month is a word, before its time or around it.
fn with_month(text: &str) -> Option<String> {
    let (mut month, mut numbers, mut time, mut rest) = (None, Vec::new(), None, String::new());
    let mut place_in = |word: &str| -> Option<()> {
        if word.contains(':') && !word.starts_with(['+', '-']) {
            time.is_none().then(|| time = Some(word.to_owned()))
        } else if are_digits(word) {
            numbers.push(word.to_owned());
            Some(())
        } else if let Some(at) = named(&MONTHS, word) {
            month.is_none().then(|| month = Some(at + 1))
        } else if named(&DAYS, word).is_some() {
            Some(())
        } else if time.is_some() {
            rest = format!("{rest} {word}");
            Some(())
        } else {
            None
        }
    };
    // A T between two numbers parts date and time; others belong to words.
    let around = |at: usize| {
        let neighbours = [at.checked_sub(1), Some(at + 1)];
        neighbours.map(|at| at.and_then(|at| text.as_bytes().get(at)))
    };
    let is_seam = |at: usize| {
        around(at)
            .iter()
            .all(|byte| byte.is_some_and(u8::is_ascii_digit))
    };
    let spaced: String = text
        .char_indices()
        .map(|(at, c)| if c == 'T' && is_seam(at) { ' ' } else { c })
        .collect();
    for piece in spaced.split([' ', ',']).filter(|piece| !piece.is_empty()) {
        // A zone behind the time begins with its sign: -0700 is no year.
        let is_zone = piece.starts_with(['+', '-']);
        if piece.contains(':') || is_zone {
            place_in(piece)?;
        } else {
            let parts = piece.split(['-', '/', '.']).filter(|part| !part.is_empty());
            parts.map(&mut place_in).collect::<Option<Vec<()>>>()?;
        }
    }
    let [a, b] = numbers.as_slice() else {
        return None;
    };
    let (day, year) = match (a.len(), b.len()) {
        (1 | 2, 4) => (a.clone(), b.clone()),
        (4, 1 | 2) => (b.clone(), a.clone()),
        (1 | 2, 2) => (a.clone(), format!("20{b}")),
        _ => return None,
    };
    Some(format!("{year}-{:02}-{day:0>2}T{}{rest}", month?, time?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spellings_of_many_programs_are_those_of_iso() {
        for text in [
            "20240513T100000.5Z",
            "2024-05-13-10-00-00.5Z",
            "2024-05-13_10:00:00.5Z",
            "2024_05_13_10_00_00_5Z",
            "13-May-2024 10:00:00.5Z",
            "May 13, 2024 10:00:00.5Z",
            "Mon May 13 10:00:00.5Z 2024",
            "Monday, 13 May 24 10:00:00.5Z",
            "Tue 13-MAY-2024T10:00:00.5Z",
        ] {
            assert_eq!(
                in_iso(text).as_deref(),
                Some("2024-05-13T10:00:00.5Z"),
                "{text}"
            );
        }
        // A zone is no year, whatever stands before it.
        assert_eq!(
            in_iso("May 13 2024 10:00:00 -0700").as_deref(),
            Some("2024-05-13T10:00:00 -0700")
        );
        assert_eq!(in_iso("May 13 10:00:00 -0700"), None);
        assert_eq!(in_iso("Marker 3 2024 10:00:00"), None);
        assert_eq!(
            in_iso("May 3 2024 4:00:00 PM").as_deref(),
            Some("2024-05-03T4:00:00 PM")
        );
        for text in [
            "10:00:00",
            "20240513",
            "March",
            "mayor 5 2024 10:00:00 x",
            "",
        ] {
            let found = in_iso(text);
            assert!(
                found.is_none_or(|found| super::super::date::date_and_time(&found).is_none()),
                "{text}"
            );
        }
    }
}
