//! Photos in PNG files, as Pillow 12 writes them.

use super::read_photo;
use super::read_photos;
use super::tests::files;
use pilotage_base::bytes::MemoryBytes;

/// `Image.new("L", (4, 3)).save("a.png", exif=…)`: a place of 33° 30' S, 70° 15' W, 412.5 m, on 1 May 2024 at 10:20:30.
const WRITTEN: [&str; 7] = [
    "89504e470d0a1a0a0000000d4948445200000004000000030800000000919ff11a000000de655849664d4d002a000000",
    "080003011000020000000254000000876900040000000100000032882500040000000100000058000000000001900300",
    "02000000140000004400000000323032343a30353a30312031303a32303a333000000600010002000000025300000000",
    "02000500000003000000a60003000200000002570000000004000500000003000000be00050001000000010000000000",
    "06000500000001000000d60000000000000021000000010000001e000000010000000000000001000000460000000100",
    "00000f000000010000000000000001000003390000000222cd210c0000000b49444154789c6360400100000f0001b556",
    "293e0000000049454e44ae426082",
];

fn written() -> Vec<u8> {
    let digits = WRITTEN.concat();
    let pairs = digits.as_bytes().chunks(2);
    let byte = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).unwrap(), 16).unwrap();
    pairs.map(byte).collect()
}

fn chunk(kind: [u8; 4], contents: &[u8]) -> Vec<u8> {
    let body = [&kind[..], contents].concat();
    let length = u32::try_from(contents.len()).unwrap().to_be_bytes();
    let sum = crc32fast::hash(&body).to_be_bytes();
    [&length[..], &body, &sum].concat()
}

#[test]
fn a_png_says_where_and_when_it_was_taken() {
    let photo = read_photo(&MemoryBytes::new("a.png", written())).unwrap();
    assert_eq!((photo.width, photo.height), (4, 3));
    // date -u -d '2024-05-01 10:20:30' +%s
    assert_eq!(photo.taken, Some((1_714_558_830, 0.0)));
    let place = photo.place.unwrap();
    assert!((place.latitude.to_degrees() + 33.5).abs() < 1e-9);
    assert!((place.longitude.to_degrees() + 70.25).abs() < 1e-9);
    assert_eq!(place.altitude, Some(412.5));
    for end in 0..written().len() {
        let _ = read_photo(&MemoryBytes::new("a.png", written()[..end].to_vec()));
    }
}

#[test]
fn exif_counts_behind_the_pixels_and_not_with_a_wrong_check_sum() {
    let file = written();
    // The head takes 33 bytes, the chunk of EXIF 12 and what it says.
    let (head, rest) = file.split_at(33);
    let length = u32::from_be_bytes(*rest.first_chunk().unwrap()) as usize + 12;
    let (exif, pixels) = rest.split_at(length);
    let (pixels, end) = pixels.split_at(pixels.len() - 12);
    let behind = [head, pixels, exif, end].concat();
    let place = |bytes: Vec<u8>| read_photo(&MemoryBytes::new("a.png", bytes)).unwrap().place;
    assert_eq!(place(behind), place(file.clone()));
    let mut damaged = file.clone();
    damaged[33 + length - 20] ^= 4;
    assert_eq!(place(damaged), None);
}

#[test]
fn placed_pngs_are_a_flight_and_other_pngs_are_none() {
    let later = |seconds: &str| {
        let file = written();
        let at = file.windows(8).position(|w| w == b"10:20:30").unwrap() + 6;
        let mut contents = file[41..file.len() - 12].to_vec();
        contents[at - 41..at - 39].copy_from_slice(seconds.as_bytes());
        let length = u32::from_be_bytes(*file[33..].first_chunk().unwrap()) as usize;
        let exif = chunk(*b"eXIf", &contents[..length]);
        [&file[..33], &exif, &file[33 + 12 + length..]].concat()
    };
    let plain = {
        let file = written();
        let length = u32::from_be_bytes(*file[33..].first_chunk().unwrap()) as usize;
        [&file[..33], &file[33 + 12 + length..]].concat()
    };
    let folder = read_photos(&files(&[
        ("a.png", later("31")),
        ("b.PNG", later("33")),
        ("map.png", plain.clone()),
    ]))
    .unwrap();
    assert_eq!(folder.flight.frames.len(), 2);
    assert!((folder.flight.frames[1].time - folder.flight.frames[0].time - 2.0).abs() < 1e-9);
    assert!(!folder.notes.iter().any(|note| note.contains("map.png")));
    assert!(read_photos(&files(&[("a.png", plain.clone()), ("b.png", plain)])).is_none());
}

#[test]
fn a_png_without_exif_is_read_by_its_xmp() {
    let file = written();
    let length = u32::from_be_bytes(*file[33..].first_chunk().unwrap()) as usize;
    let packet = br#"<x:xmpmeta xmlns:x="adobe:ns:meta/"><rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">
<rdf:Description rdf:about="" xmlns:drone-dji="http://www.dji.com/drone-dji/1.0/" drone-dji:GpsLatitude="-33.5"
drone-dji:GpsLongitude="-70.25"/></rdf:RDF></x:xmpmeta>"#;
    let text = [&b"XML:com.adobe.xmp\0\0\0de\0Angaben\0"[..], packet].concat();
    let told = chunk(*b"iTXt", &text);
    let png = [&file[..33], &told, &file[33 + 12 + length..]].concat();
    let photo = read_photo(&MemoryBytes::new("a.png", png)).unwrap();
    let place = photo.place.unwrap();
    assert!((place.latitude.to_degrees() + 33.5).abs() < 1e-9);
    assert!((place.longitude.to_degrees() + 70.25).abs() < 1e-9);
}
