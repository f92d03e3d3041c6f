//! Files of which nothing but the ending of their names tells what they are: their bytes are measurements or packed.

use pilotage_base::files::has_ending;

use super::kind::{Foreign, GRID, kind};

const HEADER: &str =
    "make a GeoTIFF of it (`gdal_translate`), with its .hdr beside it, and open that";

/// Endings of names, and the kinds.
#[rustfmt::skip]
const ENDINGS: &[(&[&str], Foreign)] = &[
    (&["ecw"], kind("a map of ERDAS (ECW)", GRID)),
    (&["sid"], kind("a map of MrSID (.sid)", GRID)),
    (&["bil", "bip", "bsq"], kind("a grid of bare samples, which its header (.hdr) tells apart (BIL, BIP, BSQ)", HEADER)),
    (&["flt"], kind("a grid of bare heights, which its header (.hdr) tells apart (Esri .flt)", HEADER)),
    (&["adf"], kind("a part of a grid of Esri (.adf)", "make a GeoTIFF of its folder (`gdal_translate`) and open that")),
];

/// Kind of a file by its name; `None` of texts, which say themselves what they are.
pub(super) fn of(name: &str, head: &[u8]) -> Option<Foreign> {
    let is_text = head
        .iter()
        .all(|byte| *byte >= b' ' || byte.is_ascii_whitespace());
    let found = ENDINGS
        .iter()
        .find(|(endings, _)| has_ending(name, endings));
    found.filter(|_| !is_text).map(|(_, is)| *is)
}

#[cfg(test)]
mod tests {
    use pilotage_base::bytes::MemoryBytes;

    use super::super::foreign_file;

    #[test]
    fn what_has_no_mark_is_named_by_its_ending() {
        let bytes: Vec<u8> = (0..200_u8).map(|i| i.wrapping_mul(37) ^ 0x65).collect();
        let what = |name: &str, bytes: &[u8]| {
            let source = MemoryBytes::new(name, bytes);
            foreign_file(&source).map_or("", |is| is.what)
        };
        for (name, words) in [
            ("a.ecw", "ECW"),
            ("maps/A.ECW", "ECW"),
            ("a.sid", "MrSID"),
            ("a.bil", "BIL"),
            ("a.bip", "BIP"),
            ("a.bsq", "BSQ"),
            ("a.flt", ".flt"),
            ("a.xyz1", ""),
        ] {
            let found = what(name, &bytes);
            assert!(
                found.contains(words) && found.is_empty() == words.is_empty(),
                "{name}: {found}"
            );
        }
        // Its content counts before its name, and a text is none of them.
        assert!(what("a.ecw", b"\x89HDF\r\n\x1a\n").contains("HDF5"));
        assert_eq!(what("a.bil", b"time,lat,lon\n0,47,8\n"), "");
    }
}
