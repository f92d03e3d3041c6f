//! Hemispheres that change from row to row, in columns beside those of their angles.
//!
//! A flight over the equator or over Greenwich has `N` in some rows and `S` in others. South and west become signs of the
//! latitudes and longitudes, and all letters those of north and east, so that the rest of a table is read as any other.

use std::ops::Range;

use super::table_text::{ANGLES, Changes, TableText, words};
use crate::cells::Separator;
use pilotage_base::angle_text::hemisphere;
use pilotage_base::text::by_count;

/// Letters that leave an angle as it is, and those that turn it.
const PAIRS: [[u8; 2]; 2] = [*b"NS", *b"EW"];
/// Words of names of columns of letters.
const LETTERS: [&[&str]; 2] = [
    &["n", "s", "ns", "north", "south"],
    &["e", "w", "ew", "east", "west"],
];
/// Words that names of either may have.
const EITHER: [&str; 8] = [
    "hemisphere",
    "hemi",
    "dir",
    "direction",
    "ref",
    "ind",
    "indicator",
    "sign",
];
/// Words of names of minutes and seconds of angles.
const PARTS: [&str; 8] = [
    "m", "min", "minute", "minutes", "sec", "second", "seconds", "mins",
];
/// Of so many cells with something in them one may be no letter, or no angle without a sign.
const ODD: usize = 10;

/// A column of angles, that of their letters, and these.
struct Letters {
    angle: usize,
    at: usize,
    pair: [u8; 2],
}

/// The letter of a cell, alone or by its word in English, German, French, Spanish or Italian, as a capital.
pub(crate) fn letter(cell: &str) -> Option<u8> {
    let word = cell.to_lowercase();
    // Alone in its cell it is no zone of a time.
    let letter = hemisphere(&word).or((word == "est").then_some('E'))?;
    u8::try_from(letter).ok()
}

/// The number of a cell.
fn number(cell: &str) -> Option<f64> {
    let number = cell.parse().or_else(|_| cell.replacen(',', ".", 1).parse());
    number.ok().filter(|number: &f64| number.is_finite())
}

/// Whether a cell is an angle without a sign.
fn is_angle(cell: &str) -> bool {
    cell.starts_with(|c: char| c.is_ascii_digit()) && number(cell).is_some()
}

/// Whether the name of a column says that letters of hemispheres stand in it: of latitudes, or of longitudes.
pub(crate) fn tells_of_letters(name: &str, of_latitude: bool) -> bool {
    let kind = usize::from(!of_latitude);
    let is_one = |word: &String| {
        let lists = [LETTERS[kind], &EITHER, ANGLES[kind]];
        lists.iter().any(|list| list.contains(&word.as_str()))
    };
    words(name).iter().any(is_one)
}

/// Columns of letters that belong to a latitude or a longitude, by the names of the columns and the cells of some rows. A
/// column belongs to the one that it stands behind or before; that of a latitude is taken where its name says what it is, or
/// that of a longitude stands so too.
fn found(names: &[Vec<String>], rows: &[Vec<&str>]) -> Vec<Letters> {
    let says = |at: usize, of: &[&str]| names[at].iter().any(|word| of.contains(&word.as_str()));
    let cells = |at: usize| {
        let cells = rows.iter().filter_map(move |row| row.get(at).copied());
        cells.filter(|cell| !cell.is_empty())
    };
    let is_of = |at: usize, pair: [u8; 2]| {
        let letters = cells(at).filter(|cell| letter(cell).is_some_and(|l| pair.contains(&l)));
        let count = letters.count();
        count > 0 && (cells(at).count() - count) * ODD <= cells(at).count()
    };
    let are_of: Vec<Option<usize>> = (0..names.len())
        .map(|at| (0..2).find(|kind| is_of(at, PAIRS[*kind])))
        .collect();
    let mut taken = Vec::new();
    let mut found: Vec<(Letters, usize, bool)> = Vec::new();
    for (at, kind) in are_of.iter().enumerate() {
        let Some(kind) = *kind else { continue };
        // Degrees with parts in other columns have a sign together.
        if (0..names.len()).any(|part| says(part, ANGLES[kind]) && says(part, &PARTS)) {
            continue;
        }
        let is_named = says(at, LETTERS[kind]) || says(at, &EITHER) || says(at, ANGLES[kind]);
        let is_place = |angle: &usize| {
            *angle < names.len()
                && are_of[*angle].is_none()
                && says(*angle, ANGLES[kind])
                && !taken.contains(angle)
        };
        let beside = [at.checked_sub(1), Some(at + 1)];
        let beside = beside.into_iter().flatten().find(is_place);
        // Letters may stand behind both.
        let mut others = (0..names.len()).filter(is_place);
        let only = others
            .next()
            .filter(|_| is_named && others.next().is_none());
        let Some(angle) = beside.or(only) else {
            continue;
        };
        taken.push(angle);
        let pair = PAIRS[kind];
        found.push((Letters { angle, at, pair }, kind, is_named));
    }
    let is_there: Vec<(usize, bool)> = found
        .iter()
        .map(|(letters, kind, _)| (*kind, letters.angle.abs_diff(letters.at) == 1))
        .collect();
    found.retain(|(_, kind, is_named)| *is_named || is_there.contains(&(1 - kind, true)));
    found.into_iter().map(|(letters, ..)| letters).collect()
}

/// Cells to change for the signs that the letters of hemispheres of a table tell, where these change, and sentences that
/// tell it. A row whose letter or angle fits none has no place.
pub(super) fn as_signs(table: &TableText) -> (Changes, Vec<String>) {
    let TableText {
        separator,
        titles,
        start,
        rows,
        ..
    } = table;
    let names: Vec<Vec<String>> = titles.iter().map(|name| words(name)).collect();
    let is_angle = |word: &String| ANGLES.iter().any(|list| list.contains(&word.as_str()));
    if !names.iter().any(|words| words.iter().any(is_angle)) {
        return (Vec::new(), Vec::new());
    }
    let mut changes = Changes::new();
    let mut notes = Vec::new();
    for letters in found(&names, table.some_cells()) {
        let Some((own, lost)) = changes_by(&letters, rows, *separator) else {
            continue;
        };
        let own = own.into_iter();
        changes.extend(own.map(|(place, bytes)| (place.start + start..place.end + start, bytes)));
        let (name, of) = (&titles[letters.at], &titles[letters.angle]);
        notes.push(format!(
            "column \"{name}\" has letters of hemispheres: {} is negative in \"{of}\"",
            char::from(letters.pair[1])
        ));
        if lost > 0 {
            notes.push(format!(
                "{lost} {} no place, as \"{name}\" has no letter of a hemisphere there, or \"{of}\" a sign of its own",
                by_count(lost, "row has", "rows have")
            ));
        }
    }
    if changes.is_empty() {
        notes.clear();
    }
    (changes, notes)
}

/// The cells to change by a column of letters, and the number of rows that have no place then; `None` where letters neither
/// change nor are odd, or where too many rows fit none.
fn changes_by(letters: &Letters, rows: &str, separator: Separator) -> Option<(Changes, usize)> {
    let mut changes = Vec::new();
    let mut counts = [0_usize; 2];
    let (mut lost, mut odd, mut negative) = (0_usize, 0_usize, [0_usize; 2]);
    let none: &[u8] = if separator == Separator::Blanks {
        b"nan"
    } else {
        b""
    };
    let mut begin = 0;
    for line in rows.split_inclusive('\n') {
        let at = begin;
        begin += line.len();
        if line.trim().is_empty() || line.starts_with('#') {
            continue;
        }
        let places = separator.places(line);
        let Some((angle, word)) = places.get(letters.angle).zip(places.get(letters.at)) else {
            continue;
        };
        let found =
            letter(&line[word.clone()]).and_then(|l| letters.pair.iter().position(|p| *p == l));
        let (angle_text, word_text) = (&line[angle.clone()], &line[word.clone()]);
        let moved = |place: &Range<usize>| at + place.start..at + place.end;
        match found {
            Some(side) if is_angle(angle_text) => {
                counts[side] += 1;
                if side == 1 {
                    changes.push((at + angle.start..at + angle.start, b"-".to_vec()));
                    changes.push((moved(word), vec![letters.pair[0]]));
                }
            }
            // No fix.
            _ if number(angle_text).map_or(
                angle_text.is_empty() || angle_text.eq_ignore_ascii_case("nan"),
                |number| number == 0.0 && word_text.is_empty(),
            ) =>
            {
                changes.push((moved(angle), none.to_vec()));
                if found == Some(1) {
                    changes.push((moved(word), vec![letters.pair[0]]));
                }
            }
            _ => {
                if let Some((side, number)) = found.zip(number(angle_text)) {
                    negative[side] += usize::from(number < 0.0);
                }
                lost += usize::from(number(angle_text).is_some());
                odd += 1;
                changes.push((moved(angle), none.to_vec()));
                changes.push((moved(word), vec![letters.pair[0]]));
            }
        }
    }
    let total = counts[0] + counts[1];
    let has_signs = negative[1] > 0 && counts[1] == 0;
    let changes_side = counts.iter().all(|count| *count > 0) || counts[1] > 0 && odd > 0;
    (changes_side && !has_signs && odd * ODD <= total).then_some((changes, lost))
}

#[cfg(test)]
mod tests {
    use std::borrow::Cow;

    use super::super::table_text::with_changes;
    use super::*;

    fn signed(text: &str) -> String {
        let text = with_changes(Cow::Borrowed(text.as_bytes()), &[as_signs])
            .0
            .into_owned();
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn letters_that_change_become_signs_and_others_stay() {
        let rows = |first: &str, last: &str, name: &str| {
            let row = |i: u32, letter: &str| format!("{i},47.{i},N,0.0{i},{letter},{}\r\n", i % 2);
            format!("t,lat,{name},lon,EW,ok\r\n")
                + &(0..20)
                    .map(|i| row(i, if i < 9 { first } else { last }))
                    .collect::<String>()
        };
        let found = signed(&rows("W", "E", "NS"));
        assert!(
            found.contains("\r\n3,47.3,N,-0.03,E,1\r\n")
                && found.contains("\r\n9,47.9,N,0.09,E,1\r\n")
        );
        for (west, east) in [
            ("west", "East"),
            ("Ouest", "Est"),
            ("West", "Ost"),
            ("ovest", "est"),
        ] {
            assert!(signed(&rows(west, east, "NS")).contains("3,47.3,N,-0.03,E,1\r\n"));
        }
        for same in [
            rows("W", "W", "NS"),
            rows("E", "E", "NS"),
            rows("W", "F", "NS"),
        ] {
            assert_eq!(signed(&same), same);
        }
        // Where an angle has a sign beside its letter, its row has no place.
        let negative = signed(&rows("W", "E", "NS").replace(",0.03,", ",-0.03,"));
        assert!(negative.contains("\r\n3,47.3,N,,E,1\r\n"), "{negative}");
        // Signs that say what letters say stay.
        let mut own = rows("W", "E", "NS");
        for row in 0..9 {
            own = own.replace(&format!(",0.0{row},W"), &format!(",-0.0{row},W"));
        }
        assert_eq!(signed(&own), own);
    }

    /// A table of these columns, of flight north over the equator and east over Greenwich.
    fn crossing(columns: &[(&str, &dyn Fn(i32) -> String)]) -> String {
        let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
        let row = |i: i32| {
            let cells: Vec<String> = columns.iter().map(|(_, cell)| cell(i)).collect();
            cells.join(",") + "\n"
        };
        names.join(",") + "\n" + &(-50..50).map(row).collect::<String>()
    }

    #[test]
    fn letters_turn_the_latitude_or_longitude_that_they_stand_beside_and_nothing_else() {
        let time = |i: i32| (i + 50).to_string();
        let angle = |i: i32| format!("0.{:04}", i.abs());
        let ns = |i: i32| if i < 0 { "S" } else { "N" }.to_owned();
        let ew = |i: i32| if i < 0 { "W" } else { "E" }.to_owned();
        let height = |i: i32| (500 + i).to_string();
        let after = crossing(&[
            ("t", &time),
            ("lat", &angle),
            ("lon", &angle),
            ("N/S", &ns),
            ("E/W", &ew),
            ("alt", &height),
        ]);
        assert!(signed(&after).contains("\n47,-0.0003,-0.0003,N,E,497\n"));
        let before = crossing(&[
            ("t", &time),
            ("N/S", &ns),
            ("lat", &angle),
            ("E/W", &ew),
            ("lon", &angle),
            ("alt", &height),
        ]);
        assert!(signed(&before).contains("\n47,N,-0.0003,E,-0.0003,497\n"));
        let parts = crossing(&[
            ("t", &time),
            ("lat_deg", &|_| "0".to_owned()),
            ("lat_min", &angle),
            ("N/S", &ns),
        ]);
        assert_eq!(signed(&parts), parts);
        for (name, letters) in [("level", &ew as &dyn Fn(i32) -> String), ("mode", &ns)] {
            let other = crossing(&[
                ("t", &time),
                ("lat", &angle),
                ("lon", &angle),
                ("alt", &height),
                (name, letters),
            ]);
            assert_eq!(signed(&other), other);
            let beside = crossing(&[
                ("t", &time),
                ("lat", &angle),
                ("mode", &ns),
                ("alt", &height),
            ]);
            assert_eq!(signed(&beside), beside);
        }
    }

    #[test]
    fn rows_that_do_not_fit_have_no_place_and_the_others_keep_theirs() {
        let time = |i: i32| (i + 50).to_string();
        let north = |_: i32| "51.5".to_owned();
        let n = |_: i32| "N".to_owned();
        let angle = |i: i32| format!("0.{:04}", i.abs());
        let ew = |i: i32| if i < 0 { "W" } else { "E" }.to_owned();
        let whole = crossing(&[
            ("t", &time),
            ("lat", &north),
            ("N/S", &n),
            ("lon", &angle),
            ("E/W", &ew),
        ]);
        let row = "\n47,51.5,N,-0.0003,E\n";
        let told = |text: &str| with_changes(Cow::Borrowed(text.as_bytes()), &[as_signs]).1;
        assert!(signed(&whole).contains(row));
        assert_eq!(told(&whole).len(), 1);
        let odd = whole.replace("0.0020,E", "0.0020,X");
        assert!(signed(&odd).contains(row) && signed(&odd).contains("\n70,51.5,N,,E\n"));
        assert!(
            told(&odd)[1].starts_with("1 row has no place"),
            "{:?}",
            told(&odd)
        );
        let header = whole.lines().next().unwrap();
        let repeated = whole.replace("\n60,", &format!("\n{header}\n60,"));
        assert!(signed(&repeated).contains(row));
        assert_eq!(told(&repeated).len(), 1);
        for none in [",,,", "nan,N,nan,W", "0,,0,", ",N,,W"] {
            let mut unfixed = whole.clone();
            for i in 0..20 {
                let fixed = format!("\n{i},51.5,N,{},W\n", angle(i - 50));
                assert!(unfixed.contains(&fixed));
                unfixed = unfixed.replace(&fixed, &format!("\n{i},{none}\n"));
            }
            assert!(signed(&unfixed).contains(row), "{none}");
            assert_eq!(told(&unfixed).len(), 1, "{none}");
        }
        let quoted = whole
            .replace(",N,", ",\"N\",")
            .replace(",E\n", ",\"E\"\n")
            .replace(",W\n", ",\"W\"\n");
        let found = signed(&quoted);
        assert!(found.contains("\n47,51.5,\"N\",-0.0003,\"E\"\n"), "{found}");
    }
}
