//! Longitudes whose hemisphere is an O: the east in German, the west in French, Spanish and Italian.

use super::hemispheres::{letter, tells_of_letters};
use super::table_text::{ANGLES, Changes, TableText, words};
use pilotage_base::angle_text::{meaning_of_o, with_letter_for_o};

/// Cells to change where an O stands alone in the longitudes of a table or in the letters beside them, with E or W in its
/// place, and a sentence where nothing tells which it is.
pub(super) fn as_east_or_west(table: &TableText) -> (Changes, Vec<String>) {
    let separator = table.separator;
    let is_longitude = |at: &usize| {
        let mut words = words(&table.titles[*at]).into_iter();
        words.any(|word| ANGLES[1].contains(&word.as_str()))
    };
    let longitudes: Vec<usize> = (0..table.titles.len()).filter(is_longitude).collect();
    if longitudes.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let some = table.some_cells();
    let cells = |at: usize| some.iter().filter_map(move |row| row.get(at).copied());
    let has_o = |at: &usize| cells(*at).any(|cell| with_letter_for_o(cell, 'E').is_some());
    let is_letter = |cell: &str| {
        cell.is_empty()
            || cell.eq_ignore_ascii_case("o")
            || matches!(letter(cell), Some(b'E' | b'W'))
    };
    let are_letters = |at: &usize| {
        let is_beside = longitudes.iter().any(|angle| angle.abs_diff(*at) == 1);
        (is_beside || tells_of_letters(&table.titles[*at], false)) && cells(*at).all(is_letter)
    };
    let of_longitude = |at: &usize| longitudes.contains(at) || are_letters(at);
    let all: Vec<usize> = (0..table.titles.len()).filter(of_longitude).collect();
    let with_o: Vec<usize> = all.iter().copied().filter(has_o).collect();
    if with_o.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let names = table.titles.iter().map(AsRef::as_ref);
    let Some(meant) = meaning_of_o(names, &all.iter().flat_map(|at| cells(*at))) else {
        let name = &table.titles[with_o[0]];
        let told = format!(
            "the O in column \"{name}\" may be east (Ost) or west (Ouest, Oeste): write E or W in its place"
        );
        return (Vec::new(), vec![told]);
    };
    let mut changes = Vec::new();
    let mut begin = table.start;
    for line in table.rows.split_inclusive('\n') {
        let places = separator.places(line);
        for place in with_o.iter().filter_map(|at| places.get(*at)) {
            if let Some(cell) = with_letter_for_o(&line[place.clone()], meant) {
                changes.push((begin + place.start..begin + place.end, cell.into_bytes()));
            }
        }
        begin += line.len();
    }
    (changes, Vec::new())
}

#[cfg(test)]
mod tests {
    use std::borrow::Cow;

    use super::super::table_text::with_changes;
    use super::*;

    fn read(text: &str) -> (String, Vec<String>) {
        let (read, told) = with_changes(Cow::Borrowed(text.as_bytes()), &[as_east_or_west]);
        (String::from_utf8(read.into_owned()).unwrap(), told)
    }

    fn table(names: &str, row: &dyn Fn(usize) -> String) -> String {
        let rows: String = (0..6).map(row).collect();
        format!("{names}\n{rows}")
    }

    #[test]
    fn an_o_is_the_east_beside_w_or_german_names_and_the_west_beside_e_or_others() {
        let own = |i: usize| format!("{i};33,85{i} S;18,42{i} O;120\n");
        for (names, letter) in [
            ("Zeit;Breite;Länge;Höhe", "E"),
            ("t;latitude;longitude;hauteur", "W"),
            ("t;latitud;longitud;altitud", "W"),
        ] {
            let (found, told) = read(&table(names, &own));
            let row = format!("\n3;33,853 S;18,423 {letter};120\n");
            assert!(found.contains(&row), "{found}");
            assert_eq!(told, Vec::<String>::new());
        }
        let beside = |other: &'static str| {
            move |i: usize| {
                let letter = if i < 3 { "O" } else { other };
                format!("{i},33.85{i},S,0.42{i},{letter},120\n")
            }
        };
        let names = "t,lat,NS,lon,EW,alt";
        let (found, _) = read(&table(names, &beside("W")));
        assert!(found.contains("\n1,33.851,S,0.421,E,120\n"), "{found}");
        assert!(found.contains("\n4,33.854,S,0.424,W,120\n"), "{found}");
        let (found, _) = read(&table(names, &beside("E")));
        assert!(found.contains("\n1,33.851,S,0.421,W,120\n"), "{found}");
    }

    #[test]
    fn an_o_of_which_nothing_tells_is_told_and_other_tables_stay() {
        let own = |i: usize| format!("{i};33.85{i} S;18.42{i} O;120\n");
        let text = table("t;lat;lon;alt", &own);
        let (found, told) = read(&text);
        assert_eq!(found, text);
        assert!(told[0].contains("column \"lon\""), "{told:?}");
        // A column of states is no hemisphere.
        let state = |i: usize| format!("{i};33.85{i};18.42{i};120;O\n");
        let text = table("t;lat;lon;alt;state", &state);
        assert_eq!(read(&text), (text, Vec::new()));
    }
}
