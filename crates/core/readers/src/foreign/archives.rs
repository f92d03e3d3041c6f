//! Archives, databases, old documents of Office and films, named by what they say is in them, one kind a line.

use pilotage_base::bytes::ByteSource;

use super::kind::{
    CONVERT, FILM, Foreign, JPEG, LOG, REACH, SHAPE, TO_CSV, TO_GEOJSON, TO_MCAP, UNPACK, kind,
};

const fn name(
    name: &'static str,
    what: &'static str,
    advice: &'static str,
) -> (&'static str, Foreign) {
    (name, kind(what, advice))
}

const TILES: &str = "make a PMTiles of it (`pmtiles convert`) or a GeoTIFF (`gdal_translate`) and open that as a map";

/// Files within a zip that tell what it is: a whole name, the beginning of one before `*`, the end behind it.
#[rustfmt::skip]
const ENTRIES: &[(&str, Foreign)] = &[
    name("word/*", "a document of Word (.docx)", LOG),
    name("xl/*", "a workbook of Excel (.xlsx)", TO_CSV),
    name("ppt/*", "slides of PowerPoint (.pptx)", LOG),
    name("visio/*", "a drawing of Visio (.vsdx)", LOG),
    name("AndroidManifest.xml", "an app of Android (.apk)", LOG),
    name("META-INF/MANIFEST.MF", "a program (Java, .jar)", LOG),
    name("*.npy", "arrays of NumPy (.npz)", TO_CSV),
    name("3D/3dmodel.model", "a model (3MF)", LOG),
    name("*.qgs", "a project of QGIS (.qgz)", TO_GEOJSON),
    name("content.xml", "a document or workbook of LibreOffice (.odt, .ods)", TO_CSV),
    name("*.kml", "KML in a zip (KMZ)", CONVERT),
    name("*.wpml", "a way-point mission of DJI (KMZ)", CONVERT),
    name("*.shp", "a zipped shapefile", SHAPE),
    name("*.hgt", "heights of the ground in a zip (SRTM, .hgt)", UNPACK),
    name("*.plan", "a plan of QGroundControl in a zip", CONVERT),
    name("*.waypoints", "a mission of way-points in a zip", CONVERT),
    name("*.mission", "a mission in a zip", CONVERT),
    name("*.kmz", "KMZ in a zip", CONVERT),
];

/// Kinds that the first file of a zip states, stored as it is.
#[rustfmt::skip]
const STATED: &[(&str, Foreign)] = &[
    name("application/vnd.oasis.opendocument.spreadsheet", "a workbook (.ods)", TO_CSV),
    name("application/vnd.oasis.opendocument.text", "a document (.odt)", LOG),
    name("application/vnd.oasis.opendocument.presentation", "slides (.odp)", LOG),
    name("application/vnd.oasis.opendocument", "a document of LibreOffice", LOG),
    name("application/epub+zip", "a book (EPUB)", LOG),
];

/// Words of a database's schema that tell what it is.
#[rustfmt::skip]
const TABLES: &[(&str, Foreign)] = &[
    name("gpkg_contents", "a GeoPackage (.gpkg)", TO_GEOJSON),
    name("tile_column", "a map of tiles (MBTiles)", TILES),
    name("offered_qos_profiles", "a bag of ROS 2 (.db3)", TO_MCAP),
    name("serialization_format", "a bag of ROS 2 (.db3)", TO_MCAP),
    name("spatial_ref_sys", "layers of features (SpatiaLite)", TO_GEOJSON),
];
const DATABASE: Foreign = kind("a database of SQLite", TO_CSV);

/// Names of the streams of an old document of Office.
#[rustfmt::skip]
const STREAMS: &[(&str, Foreign)] = &[
    name("WordDocument", "a document of Word (.doc)", LOG),
    name("Workbook", "a workbook of Excel (.xls)", TO_CSV),
    name("Book", "a workbook of Excel (.xls)", TO_CSV),
    name("PowerPoint Document", "slides of PowerPoint (.ppt)", LOG),
    name("__properties_version1.0", "a message of Outlook (.msg)", LOG),
];
const OLD_OFFICE: Foreign = kind("an old document of Office (.doc, .xls, .ppt)", TO_CSV);

/// Brands that films and pictures of the same frame state (`ftyp`); what states none of these is a film.
#[rustfmt::skip]
const BRANDS: &[(&str, Foreign)] = &[
    name("avif", "a picture (AVIF)", JPEG),
    name("avis", "a picture (AVIF)", JPEG),
    name("heic", "a photo (HEIC)", JPEG),
    name("heix", "a photo (HEIC)", JPEG),
    name("heim", "a photo (HEIC)", JPEG),
    name("heis", "a photo (HEIC)", JPEG),
    name("hevc", "a photo (HEIC)", JPEG),
    name("hevx", "a photo (HEIC)", JPEG),
    name("mif1", "a photo (HEIF)", JPEG),
    name("msf1", "a photo (HEIF)", JPEG),
    name("crx ", "a raw photo (CR3)", JPEG),
    name("jp2 ", "a picture (JPEG 2000)", JPEG),
    name("M4A ", "a sound recording (M4A)", LOG),
    name("M4B ", "a sound recording (M4A)", LOG),
];
const MP4: Foreign = kind("a film (MP4 or MOV)", FILM);

/// Kind of an archive, a database, an old document or a film that begins with `head`.
pub(super) fn within(head: &[u8], source: &dyn ByteSource) -> Option<Foreign> {
    if head.starts_with(b"PK\x03\x04") {
        return zip(head, source);
    }
    if head.starts_with(b"SQLite format 3\0") {
        return Some(database(&beginning(source)));
    }
    if head.starts_with(&[0xd0, 0xcf, 0x11, 0xe0]) {
        return Some(old_office(source));
    }
    if head.get(4..8) == Some(b"ftyp") {
        return Some(film(head));
    }
    None
}

fn beginning(source: &dyn ByteSource) -> Vec<u8> {
    let length = REACH.min(source.length()) as usize;
    source.read(0, length).unwrap_or_default()
}

fn holds(bytes: &[u8], word: &[u8]) -> bool {
    bytes.windows(word.len()).any(|part| part == word)
}

fn database(bytes: &[u8]) -> Foreign {
    // The number of the application, as file(1) knows them: GPKG, GP10, GP11, MPBX.
    match bytes.get(68..72) {
        Some(b"GPKG" | b"GP10" | b"GP11") => return TABLES[0].1,
        Some(b"MPBX") => return TABLES[1].1,
        _ => {}
    }
    let found = TABLES
        .iter()
        .find(|(word, _)| holds(bytes, word.as_bytes()));
    found.map_or(DATABASE, |(_, is)| *is)
}

/// Its first sector says where the names of its streams stand, which are UTF-16 (MS-CFB, 2.2 and 2.6).
fn old_office(source: &dyn ByteSource) -> Foreign {
    let head = beginning(source);
    let number = |at: usize| {
        let bytes = head.get(at..at + 4)?.first_chunk()?;
        Some(u64::from(u32::from_le_bytes(*bytes)))
    };
    let shift = head.get(30).copied().unwrap_or(9).clamp(7, 12);
    let directory = number(48).map_or(0, |sector| (sector + 1) << shift);
    let rest = source.length().saturating_sub(directory);
    let names = source
        .read(directory.min(source.length()), rest.min(4096) as usize)
        .unwrap_or_default();
    let is_there = |word: &str| {
        let wide: Vec<u8> = word.encode_utf16().flat_map(u16::to_le_bytes).collect();
        holds(&names, &wide)
    };
    let found = STREAMS.iter().find(|(word, _)| is_there(word));
    found.map_or(OLD_OFFICE, |(_, is)| *is)
}

/// The first brand is that of the file; of a frame for any picture the others tell.
fn film(head: &[u8]) -> Foreign {
    let of = |brand: &[u8]| {
        let found = BRANDS.iter().find(|(name, _)| name.as_bytes() == brand);
        found.map(|(_, is)| *is)
    };
    let length = head
        .first_chunk()
        .map_or(0, |n| u32::from_be_bytes(*n) as usize);
    let main = head.get(8..12).unwrap_or_default();
    let others = head.get(16..length.min(head.len())).unwrap_or_default();
    if main == b"mif1" || main == b"msf1" {
        let more = others.chunks_exact(4);
        let mut told = more.filter(|brand| *brand != b"mif1" && *brand != b"msf1");
        if let Some(is) = told.find_map(of) {
            return is;
        }
    }
    of(main).unwrap_or(MP4)
}

/// Names of the files of a zip, by the list at its end; without that those that its beginning has.
fn zip(head: &[u8], source: &dyn ByteSource) -> Option<Foreign> {
    let stated = head.get(30..).filter(|rest| rest.starts_with(b"mimetype"));
    if let Some(rest) = stated.and_then(|rest| rest.get(8..)) {
        let found = STATED
            .iter()
            .find(|(kind, _)| rest.starts_with(kind.as_bytes()));
        if let Some((_, is)) = found {
            return Some(*is);
        }
    }
    let Some(names) = listed(source) else {
        return Some(kind("a zip that is cut off", "copy or download it again"));
    };
    let is_it = |wanted: &str, name: &str| match wanted.split_once('*') {
        Some((begin, end)) => name.starts_with(begin) && name.ends_with(end),
        None => name == wanted,
    };
    let found = ENTRIES
        .iter()
        .find(|(wanted, _)| names.iter().any(|name| is_it(wanted, name)));
    if let Some((_, is)) = found {
        return Some(*is);
    }
    let is_zip = |name: &String| name.to_lowercase().ends_with(".zip");
    let are_zips = !names.is_empty() && names.iter().all(is_zip);
    are_zips.then_some(kind("a zip of zips", UNPACK))
}

/// Names of the files in a zip (PKWARE's APPNOTE, 4.3.12 and 4.3.16); `None` where the list is not there.
fn listed(source: &dyn ByteSource) -> Option<Vec<String>> {
    let length = source.length();
    let from = length.saturating_sub(REACH + 22);
    let end = source.read(from, (length - from) as usize).ok()?;
    let mark = end.windows(4).rposition(|part| part == b"PK\x05\x06")?;
    let number = |bytes: &[u8], at: usize| {
        let bytes = bytes.get(at..at + 4)?.first_chunk()?;
        Some(u64::from(u32::from_le_bytes(*bytes)))
    };
    let (size, offset) = (number(&end, mark + 12)?, number(&end, mark + 16)?);
    if offset > length {
        // A zip of more than 4 GB: nothing is told of its names.
        return Some(Vec::new());
    }
    let size = size.min(length - offset).min(1 << 20) as usize;
    let list = source.read(offset, size).ok()?;
    let mut names = Vec::new();
    let mut at = 0;
    while list
        .get(at..)
        .is_some_and(|rest| rest.starts_with(b"PK\x01\x02"))
    {
        let short = |place: usize| {
            let bytes = list.get(at + place..at + place + 2)?.first_chunk()?;
            Some(usize::from(u16::from_le_bytes(*bytes)))
        };
        let lengths = short(28).zip(short(30)).zip(short(32));
        let Some(((name, extra), comment)) = lengths else {
            break;
        };
        let Some(bytes) = list.get(at + 46..at + 46 + name) else {
            break;
        };
        if !bytes.ends_with(b"/") {
            names.push(String::from_utf8_lossy(bytes).into_owned());
        }
        at += 46 + name + extra + comment;
    }
    Some(names)
}

#[cfg(test)]
mod tests {
    use super::super::foreign_file;
    use pilotage_base::bytes::MemoryBytes;
    use pilotage_base::files::{FileSink, ZipSink};

    fn what(bytes: &[u8]) -> &'static str {
        let source = MemoryBytes::new("a", bytes);
        foreign_file(&source).map_or("", |is| is.what)
    }

    fn zip(names: &[&str]) -> Vec<u8> {
        let mut sink = ZipSink::default();
        for name in names {
            sink.write(name, b"<x/>").unwrap();
        }
        sink.finish().unwrap()
    }

    #[test]
    fn zips_are_named_for_the_files_in_them() {
        let types = "[Content_Types].xml";
        for (names, words) in [
            (&[types, "_rels/.rels", "word/document.xml"][..], "Word"),
            (&[types, "xl/workbook.xml"], "Excel"),
            (&["classes.dex", "AndroidManifest.xml"], "Android"),
            (&["a.npy", "b.npy"], "NumPy"),
            (&["doc.kml"], "KMZ"),
            (&["mimetype", "content.xml"], "LibreOffice"),
            (&["a.zip", "b.ZIP"], "zip of zips"),
            (&["data/a.shp", "data/a.dbf"], "a zipped shapefile"),
            (&["N47E008.hgt"], "heights of the ground"),
            (&["m/a.plan"], "a plan of QGroundControl"),
            (&["a.csv", "notes/word.txt"], "a zip"),
        ] {
            assert!(
                what(&zip(names)).contains(words),
                "{names:?}: {}",
                what(&zip(names))
            );
        }
        let whole = zip(&["a.csv", "b.csv"]);
        assert!(what(&whole[..whole.len() - 30]).contains("cut off"));
    }

    #[test]
    fn a_stored_first_file_states_the_kind() {
        let stated = |kind: &str| {
            let mut bytes = vec![0; 30];
            bytes[..4].copy_from_slice(b"PK\x03\x04");
            bytes.extend(b"mimetype");
            bytes.extend(kind.as_bytes());
            bytes
        };
        let ods = stated("application/vnd.oasis.opendocument.spreadsheet");
        assert_eq!(what(&ods), "a workbook (.ods)");
        assert_eq!(
            what(&stated("application/vnd.oasis.opendocument.text")),
            "a document (.odt)"
        );
    }

    #[test]
    fn databases_are_named_by_their_number_or_their_tables() {
        let with = |at: usize, words: &[u8]| {
            let mut bytes = b"SQLite format 3\0".to_vec();
            bytes.resize(at, 0);
            bytes.extend(words);
            bytes.resize(8192, 0);
            bytes
        };
        for (bytes, words) in [
            (with(68, b"GPKG"), "GeoPackage"),
            (with(68, b"MPBX"), "MBTiles"),
            (
                with(3000, b"CREATE TABLE tiles (zoom_level, tile_column)"),
                "MBTiles",
            ),
            (
                with(6000, b"topics(id, serialization_format text)"),
                "ROS 2",
            ),
            (with(100, b"CREATE TABLE a (b)"), "a database of SQLite"),
        ] {
            assert!(what(&bytes).contains(words), "{words}: {}", what(&bytes));
        }
    }

    #[test]
    fn films_and_pictures_are_told_by_their_brands_and_documents_by_their_streams() {
        let brand = |brands: &[&str]| {
            let mut bytes = (8 + 4 * brands.len() as u32 + 4).to_be_bytes().to_vec();
            bytes.extend(b"ftyp");
            bytes.extend(brands[0].as_bytes());
            bytes.extend([0; 4]);
            brands[1..]
                .iter()
                .for_each(|brand| bytes.extend(brand.as_bytes()));
            bytes.resize(100, 0);
            bytes
        };
        assert!(what(&brand(&["avif", "mif1"])).contains("AVIF"));
        assert!(what(&brand(&["mif1", "mif1", "avif"])).contains("AVIF"));
        assert!(what(&brand(&["mif1", "heic"])).contains("HEIC"));
        assert!(what(&brand(&["isom", "avc1", "mp42"])).contains("film"));
        assert!(what(&brand(&["qt  ", "qt  "])).contains("film"));
        let office = |stream: &str| {
            let mut bytes = vec![0xd0, 0xcf, 0x11, 0xe0, 0xa1, 0xb1, 0x1a, 0xe1];
            bytes.resize(512 * 4, 0);
            bytes[30] = 9;
            bytes[48] = 2;
            let wide: Vec<u8> = stream.encode_utf16().flat_map(u16::to_le_bytes).collect();
            bytes[512 * 3..512 * 3 + wide.len()].copy_from_slice(&wide);
            bytes
        };
        assert!(what(&office("WordDocument")).contains("Word"));
        assert!(what(&office("Workbook")).contains("Excel"));
        assert!(what(&office("Else")).contains("old document"));
    }
}
