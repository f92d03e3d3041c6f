//! Bytes at a place that tell what a file is, one kind a line.

use super::kind::{
    CONVERT, FILM, Foreign, GRID, JPEG, LOG, MODEL, OTHER_FILM, PHOTO, RECEIVER, ROADS, SHAPE,
    TO_CSV, TO_GEOJSON, TO_MCAP, UNPACK, kind,
};

/// Bytes at a place of a file that tell what it is.
struct FileSignature {
    /// Bytes at its beginning that have to be there as well.
    begins: &'static [u8],
    offset: usize,
    bytes: &'static [u8],
    is: Foreign,
}

const fn mark(bytes: &'static [u8], what: &'static str, advice: &'static str) -> FileSignature {
    mark_at(0, bytes, what, advice)
}

const fn mark_at(
    offset: usize,
    bytes: &'static [u8],
    what: &'static str,
    advice: &'static str,
) -> FileSignature {
    behind(b"", offset, bytes, what, advice)
}

/// Kind of a RIFF file: its word stands behind the length.
const fn riff(bytes: &'static [u8], what: &'static str, advice: &'static str) -> FileSignature {
    behind(b"RIFF", 8, bytes, what, advice)
}

/// Kind of a recording that begins with a message of RTCM: its number stands behind its length.
const fn rtcm(number: &'static [u8]) -> FileSignature {
    let what = "corrections of satellite navigation (RTCM)";
    behind(b"\xd3", 3, number, what, CORRECTIONS)
}

/// Kind of a file that begins so and has those bytes at a place behind that.
const fn behind(
    begins: &'static [u8],
    offset: usize,
    bytes: &'static [u8],
    what: &'static str,
    advice: &'static str,
) -> FileSignature {
    FileSignature {
        begins,
        offset,
        bytes,
        is: kind(what, advice),
    }
}

const DECRYPT: &str = "decrypt it with the private key of its aircraft (PX4's Tools/decrypt_ulog.py) and open the .ulg";
const DECODE: &str = "make a table of it (`blackbox_decode file`) and open the CSV";
const CARD: &str = "copy it again from the aircraft, if it is still there";
const CLOUD: &str = "points of a laser are not read: make a GeoTIFF of their heights (PDAL, QGIS) and open that as a map";
const TO_MAT: &str = "save it with `save('file.mat', '-v7')`, or its tables as CSV, and open that; of a grid (NetCDF 4) make a GeoTIFF (`gdal_translate`)";
const NETWORK: &str = "open the telemetry log that the ground station wrote";
const GPX_OF: &str = "make a GPX or CSV of it (gpsbabel) and open that";
const CORRECTIONS: &str = "open the log of the aircraft, or what the receiver recorded";
const FDR: &str = "keep its DATA rows under a row of their names as CSV and open that";
const MAP: &str = "open it as a map";
const TIFF: &str = "open it as a map; photos with places are read from JPEG and PNG: save them so";

/// Every signature, in the order in which they are tried.
#[rustfmt::skip]
const MARKS: &[FileSignature] = &[
    // Logs.
    mark(b"ULogEnc", "an encrypted log of PX4 (.ulge)", DECRYPT),
    mark(b"ULog\x01", "a log of PX4 (.ulg) that is cut off", CARD),
    mark(b"#ROSBAG V", "a bag of ROS 1", TO_MCAP),
    mark(b"\x89MCAP", "an MCAP that is cut off or damaged", "repair it (`mcap recover in.mcap -o out.mcap`) and open that"),
    mark(b"H Product:Blackbox", "a blackbox log of Betaflight, INAV or Cleanflight", DECODE),
    mark(&[0xa3, 0x95], "a log of ArduPilot or an old one of PX4 (.px4log) whose beginning is damaged or cut off", CARD),
    mark_at(8, b".FIT", "an activity of Garmin (FIT)", GPX_OF),
    mark(&[0xb5, 0x62], "a recording of a u-blox receiver (UBX)", RECEIVER),
    mark(b"$@", "a recording of a Septentrio receiver (SBF)", RECEIVER),
    mark(&[0xaa, 0x44, 0x12], "a recording of a NovAtel receiver", RECEIVER),
    rtcm(&[0x3e]),
    rtcm(&[0x3f]),
    rtcm(&[0x43]),
    rtcm(&[0x44]),
    rtcm(&[0x45]),
    rtcm(&[0x46]),
    rtcm(&[0x4c]),
    behind(&[0x7e, 0], 10, &[0x7e], "a recording of a traffic receiver (GDL 90)", GPX_OF),
    mark(b"A\n4\n", "a flight data recording of X-Plane (.fdr)", FDR),
    mark(b"A\r\n4\r\n", "a flight data recording of X-Plane (.fdr)", FDR),
    mark(b"A\n3\n", "a flight data recording of X-Plane (.fdr)", FDR),
    mark(b"A\r\n3\r\n", "a flight data recording of X-Plane (.fdr)", FDR),
    mark(&[0xd4, 0xc3, 0xb2, 0xa1], "a recording of a network (pcap)", NETWORK),
    mark(&[0x4d, 0x3c, 0xb2, 0xa1], "a recording of a network (pcap)", NETWORK),
    mark(&[0x0a, 0x0d, 0x0d, 0x0a], "a recording of a network (pcapng)", NETWORK),
    // In place of a file.
    mark(b"version https://git-lfs", "a pointer of Git LFS in place of a file", "fetch the file itself (`git lfs pull`) and open that"),
    mark(b"/annex/objects/", "a pointer of git-annex in place of a file", "fetch the file itself (`git annex get`) and open that"),
    mark(b"L\0\0\0\x01\x14\x02\0", "a shortcut of Windows to a file (.lnk)", "open the file that it leads to"),
    mark(b"bplist00", "a list of settings of macOS (plist)", LOG),
    mark(&[0, 5, 0x16, 7], "what macOS keeps beside a file (AppleDouble)", "open the file of the same name without `._`"),
    mark(b"\0\0\0\x01Bud1", "what macOS keeps of a folder (.DS_Store)", LOG),
    // Packed.
    mark(&[0x1f, 0x8b, 8], "a file packed with gzip", UNPACK),
    mark(&[0x1f, 0x9d], "a file packed with compress (.Z)", UNPACK),
    mark(b"BZh", "a file packed with bzip2", UNPACK),
    mark(&[0xfd, b'7', b'z', b'X', b'Z', 0], "a file packed with xz", UNPACK),
    mark(b"LZIP", "a file packed with lzip", UNPACK),
    mark(&[0x28, 0xb5, 0x2f, 0xfd], "a file packed with Zstandard", UNPACK),
    mark(&[0x04, 0x22, 0x4d, 0x18], "a file packed with LZ4", UNPACK),
    mark(b"7z\xbc\xaf\x27\x1c", "a 7-Zip archive", UNPACK),
    mark(b"Rar!\x1a\x07", "a RAR archive", UNPACK),
    mark(b"MSCF\0\0\0\0", "a cabinet of Windows (.cab)", UNPACK),
    mark(b"!<arch>", "an archive of Unix (ar, .deb)", UNPACK),
    mark(b"PK\x05\x06", "an empty zip", "pack it again with the files in it"),
    mark(b"PK\x03\x04", "a zip", "if a flight or a map is in it, give it the ending .zip and open it; else unpack it and open what is in it"),
    mark_at(257, b"ustar", "a tar archive", UNPACK),
    // Pictures.
    mark(&[0xff, 0xd8, 0xff], "a photo (JPEG)", PHOTO),
    mark(b"\x89PNG\r\n\x1a\n", "a picture (PNG)", "open it as a map, with a world file beside it; photos say where they were taken in EXIF, and two of them make a flight"),
    mark(b"II*\0\x10\0\0\0CR", "a raw photo (CR2)", JPEG),
    mark(b"IIRO", "a raw photo (ORF)", JPEG),
    mark(b"IIU\0", "a raw photo (RW2)", JPEG),
    mark(b"FUJIFILMCCD-RAW", "a raw photo (RAF)", JPEG),
    mark(b"II*\0", "a picture or a map (TIFF)", TIFF),
    mark(b"MM\0*", "a picture or a map (TIFF)", TIFF),
    mark(b"II+\0", "a map (BigTIFF)", MAP),
    mark(b"MM\0+", "a map (BigTIFF)", MAP),
    mark(b"GIF8", "a picture (GIF)", LOG),
    mark(b"8BPS\0", "a picture of Photoshop (PSD)", WORLD_OF),
    mark(b"\0\0\0\x0cjP  \r\n\x87\n", "a picture (JPEG 2000)", GRID),
    mark(&[0xff, 0x4f, 0xff, 0x51], "a picture (JPEG 2000)", GRID),
    mark(b"\0\0\0\x0cJXL \r\n\x87\n", "a picture (JPEG XL)", JPEG),
    mark(&[0xff, 0x0a], "a picture (JPEG XL)", JPEG),
    riff(b"WEBP", "a picture (WebP)", JPEG),
    mark(b"%PDF", "a document (PDF)", "save its map as GeoTIFF (QGIS, `gdal_translate`) if there is one in it, else open the log of its flight"),
    mark(b"%!PS", "a drawing (PostScript, EPS)", WORLD_OF),
    mark(&[0xc5, 0xd0, 0xd3, 0xc6], "a drawing (EPS)", WORLD_OF),
    mark(b"PMTiles", "a map of tiles (PMTiles)", MAP),
    // Films and sounds.
    riff(b"AVI ", "a film (AVI)", OTHER_FILM),
    riff(b"WAVE", "a sound recording", LOG),
    mark_at(4, b"moov", "a film (MOV)", FILM),
    mark_at(4, b"mdat", "a film (MOV) whose end is missing or comes late", FILM),
    mark(&[0x1a, 0x45, 0xdf, 0xa3], "a film (Matroska or WebM)", FILM),
    mark(b"FLV\x01", "a film (Flash)", OTHER_FILM),
    mark(&[0x30, 0x26, 0xb2, 0x75, 0x8e, 0x66, 0xcf, 0x11], "a film or sound of Windows (ASF, WMV)", OTHER_FILM),
    mark(&[0, 0, 1, 0xba], "a film (MPEG)", OTHER_FILM),
    mark(&[0, 0, 0, 1, 0x67], "a film without its frame (H.264)", OTHER_FILM),
    mark(&[0, 0, 0, 1, 0x40, 1], "a film without its frame (H.265)", OTHER_FILM),
    mark(b"OggS\0", "a sound or film (Ogg)", LOG),
    mark(b"fLaC\0", "a sound recording (FLAC)", LOG),
    mark(b"ID3\x03", "a sound recording (MP3)", LOG),
    mark(b"ID3\x04", "a sound recording (MP3)", LOG),
    // Tables and numbers.
    mark(b"PAR1", "a Parquet table", TO_CSV),
    mark(b"ARROW1", "a table of Arrow (Feather)", TO_CSV),
    mark(b"FEA1", "a table of Arrow (Feather)", TO_CSV),
    mark(b"Obj\x01", "a table (Avro)", TO_CSV),
    mark(b"\x89HDF\r\n\x1a\n", "an HDF5 file, as MATLAB 7.3 and NetCDF 4 write them", TO_MAT),
    mark_at(512, b"\x89HDF\r\n\x1a\n", "a file of MATLAB 7.3 (HDF5)", TO_MAT),
    mark(b"\x93NUMPY", "an array of NumPy", TO_CSV),
    mark(&[0x80, 4, 0x95], "objects of Python (pickle)", TO_CSV),
    mark(&[0x80, 5, 0x95], "objects of Python (pickle)", TO_CSV),
    mark_at(4, b"Standard Jet DB", "a database of Access (.mdb)", TO_CSV),
    mark_at(4, b"Standard ACE DB", "a database of Access (.accdb)", TO_CSV),
    mark(b"RDX3\n", "data of R", TO_CSV),
    mark(&[0x37, 0x7f, 6, 0x82], "what SQLite keeps beside a database (-wal)", "open the database itself"),
    // Maps, clouds of points, models.
    mark(b"CDF\x01", "a grid of NetCDF", GRID),
    mark(b"CDF\x02", "a grid of NetCDF", GRID),
    mark(b"CDF\x05", "a grid of NetCDF", GRID),
    mark(&[0x0e, 3, 0x13, 1], "a grid of HDF 4", GRID),
    mark(b"UHL1", "heights of the ground (DTED)", GRID),
    mark(b"EHFA_HEADER_TAG", "a map of ERDAS Imagine (.img)", GRID),
    mark(b"msid", "a map of MrSID (.sid)", GRID),
    mark(b"NITF0", "a picture of NITF (.ntf)", GRID),
    mark(b"DSAA", "a grid of Surfer (.grd)", GRID),
    mark(b"DSBB", "a grid of Surfer (.grd)", GRID),
    mark(b"DSRB", "a grid of Surfer (.grd)", GRID),
    mark(b"binterr1.", "a grid of heights of VTP (.bt)", GRID),
    mark(b"ENVI\n", "the header of a map of ENVI (.hdr)", GRID),
    mark(b"ENVI\r\n", "the header of a map of ENVI (.hdr)", GRID),
    mark_at(4, b"\x0a\x09OSMHeader", "a road map of OpenStreetMap (PBF)", ROADS),
    mark(b"TDSm", "measurements of LabVIEW (TDMS)", TO_CSV),
    mark(b"MDF     ", "measurements of a data bus (MDF)", TO_CSV),
    mark(b"GRIB", "a grid of the weather (GRIB)", LOG),
    mark(b"LASF", "a cloud of points (LAS, LAZ)", CLOUD),
    mark(b"ASTM-E57", "a cloud of points (E57)", CLOUD),
    mark(b"ply\n", "a model or cloud of points (PLY)", CLOUD),
    mark(b"ply\r\n", "a model or cloud of points (PLY)", CLOUD),
    mark(b"# .PCD v", "a cloud of points (PCD)", CLOUD),
    mark(b"solid ", "a model (STL)", MODEL),
    mark(b"glTF", "a model (glTF)", MODEL),
    mark(b"Kaydara FBX", "a model (FBX)", MODEL),
    mark(b"BLENDER", "a model (Blender)", MODEL),
    mark(&[0, 0, 0x27, 0x0a], "a part of a shapefile (.shp, .shx)", SHAPE),
    mark(b"fgb\x03fgb", "a layer of features (FlatGeobuf)", TO_GEOJSON),
    // Programs.
    mark(&[0x7f, b'E', b'L', b'F'], "a program", LOG),
    mark(&[0xcf, 0xfa, 0xed, 0xfe], "a program of macOS", LOG),
    mark(&[0xca, 0xfe, 0xba, 0xbe], "a program (Java or macOS)", LOG),
    mark(b"\0asm", "a program (WebAssembly)", LOG),
    // Texts.
    mark(b"QGC WPL", "a mission of way-points", CONVERT),
    mark(b"{\\rtf", "a document (RTF)", LOG),
    mark(b"-----BEGIN ", "a key or certificate", LOG),
];

const WORLD_OF: &str = "save it as PNG and open that as a map, with a world file beside it";

/// Kind of the file that begins so, by the first signature that is there.
pub(super) fn of(head: &[u8]) -> Option<Foreign> {
    let is_there = |mark: &&FileSignature| {
        head.get(mark.offset..)
            .is_some_and(|rest| rest.starts_with(mark.bytes) && head.starts_with(mark.begins))
    };
    MARKS.iter().find(is_there).map(|mark| mark.is)
}
