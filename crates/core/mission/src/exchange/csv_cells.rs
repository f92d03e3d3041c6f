//! The cells of a line of a table.

use std::borrow::Cow;

/// Whether a cell is a number.
pub(super) fn is_number(cell: &str) -> bool {
    cell.parse::<f64>().is_ok()
}

/// The cells of a line of a table, without the quotation marks around them, a number between other seams than commas with a
/// point before its decimals.
///
/// ```
/// use pilotage_mission::exchange::cells_of_row;
///
/// assert_eq!(cells_of_row("\"P; 1\"; 8,5;x", ';'), ["P; 1", "8.5", "x"]);
/// assert_eq!(cells_of_row("\"P 1\"  8,5 x", ' '), ["P 1", "8.5", "x"]);
/// ```
pub fn cells_of_row(line: &str, seam: char) -> Vec<String> {
    // Of several blanks only those within quotation marks count.
    let line = if seam == ' ' {
        Cow::Owned(with_single_blanks(line))
    } else {
        Cow::Borrowed(line)
    };
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .delimiter(seam as u8)
        .trim(csv::Trim::All)
        .from_reader(line.as_bytes());
    let record = reader.records().next().and_then(Result::ok);
    let cells = record.iter().flatten().map(|cell| {
        let with_point = cell.replace(',', ".");
        let is_comma = seam != ',' && is_number(&with_point);
        if is_comma {
            with_point
        } else {
            cell.to_owned()
        }
    });
    cells.collect()
}

/// A line with one blank for each run of them, but for those within cells in quotation marks.
fn with_single_blanks(line: &str) -> String {
    let mut text = String::with_capacity(line.len());
    let mut is_quoted = false;
    for letter in line.trim().chars() {
        let is_mark = letter == '"' && (is_quoted || text.is_empty() || text.ends_with(' '));
        is_quoted ^= is_mark;
        match letter {
            letter if is_quoted || !letter.is_whitespace() => text.push(letter),
            _ if text.ends_with(' ') => {}
            _ => text.push(' '),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::read_any;

    #[test]
    fn decimal_commas_and_quotation_marks_are_read_between_any_seams() {
        for seam in ["\t", ";", ","] {
            let number = |text: &str| match seam {
                "," => text.to_owned(),
                _ => text.replace('.', ","),
            };
            let names = ["Label", "X/Longitude", "Y/Latitude", "Z/Altitude"].join(seam);
            let row = [
                format!("\"A{seam} 1\""),
                number("8.7654321"),
                number("47.1234567"),
                number("520.5"),
            ];
            let table = format!("#{names}\n{}\n", row.join(seam));
            let read = read_any("a.txt", table.as_bytes(), None).expect(seam);
            let way_point = &read.routes[0].way_points[0];
            assert_eq!(
                way_point.properties["name"],
                format!("{:?}", format!("A{seam} 1"))
            );
            assert!((way_point.altitude.metres - 520.5).abs() < 1e-9, "{seam}");
            let place = read.frame.geodetic_from_ground(&way_point.position);
            assert!(
                (place.latitude.to_degrees() - 47.123_456_7).abs() < 1e-9,
                "{seam}"
            );
            assert!(
                (place.longitude.to_degrees() - 8.765_432_1).abs() < 1e-9,
                "{seam}"
            );
        }
    }

    #[test]
    fn names_with_blanks_stand_in_quotation_marks_between_blanks() {
        let table = "#Label X/Longitude Y/Latitude Z/Altitude\n\"my photo 1\" 8.7654321   47.1234567 520.5\n";
        let read = read_any("a.txt", table.as_bytes(), None).unwrap();
        assert_eq!(
            read.routes[0].way_points[0].properties["name"],
            "\"my photo 1\""
        );
    }
}
