//! The files beside a picture that say where it lies.

use pilotage_base::georeference::{Georeference, WorldFile};

/// Whether a file belongs beside the picture `name`, by its name: `area.jgw`, `area.prj` and
/// `area_georef.json` belong to `area.jpg`.
pub fn belongs_to(file: &str, name: &str) -> bool {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let rest = file.strip_prefix(stem);
    rest.is_some_and(|rest| rest.starts_with('.') || rest.starts_with("_georef"))
}

/// The files that put the picture `name` where `place` says, as `open_map` reads
/// them: names and contents.
///
/// ```
/// use pilotage_base::georeference::Georeference;
/// use pilotage_mission::mission::place_files;
///
/// let place = Georeference::from_world_file("0.5\n0\n0\n-0.5\n100\n200\n")?;
/// let files = place_files("maps/town.png", &place);
/// assert_eq!(files[0].0, "maps/town.pgw");
/// let text = String::from_utf8_lossy(&files[0].1);
/// assert_eq!(Georeference::from_world_file(&text)?, place);
/// # Ok::<(), pilotage_base::georeference::GeoreferenceError>(())
/// ```
pub fn place_files(name: &str, place: &Georeference) -> Vec<(String, Vec<u8>)> {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let lower = name.to_ascii_lowercase();
    let ending = match lower.rsplit('.').next() {
        Some("jpg" | "jpeg") => "jgw",
        Some("tif" | "tiff") => "tfw",
        Some("png") => "pgw",
        _ => "wld",
    };
    let world_file = |file: &WorldFile| (format!("{stem}.{ending}"), file.to_string().into_bytes());
    match place {
        Georeference::Metres(file) => vec![world_file(file)],
        Georeference::Projected { system, file } => {
            let text = system.well_known_text();
            vec![world_file(file), (format!("{stem}.prj"), text.into_bytes())]
        }
        other => {
            let text = other.to_json().unwrap_or_default();
            vec![(format!("{stem}_georef.json"), text.into_bytes())]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_beside_a_picture_is_told_by_its_name() {
        for file in ["a/map.JPG", "a/map.jgw", "a/map.prj", "a/map_georef.json"] {
            assert!(belongs_to(file, "a/map.JPG"), "{file}");
        }
        for file in ["a/map_2.jpg", "a/mapping.jgw", "b/map.jgw"] {
            assert!(!belongs_to(file, "a/map.JPG"), "{file}");
        }
    }
}
