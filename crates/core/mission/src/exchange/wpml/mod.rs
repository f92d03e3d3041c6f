//! DJI's way-point missions (WPML): a zip with `wpmz/waylines.wpml`, which is flown, and
//! `wpmz/template.kml`, which people edit.
//!
//! <https://developer.dji.com/doc/cloud-api-tutorial/en/api-reference/dji-wpml/overview.html>. What a
//! way-point of ours cannot state is kept as it stands: turns, headings, the gimbal and actions.

mod folder;
mod heights;
mod hover;
mod name;
mod read;
mod shared;
mod write;

use std::fmt::Write;

use super::file_look::FileLook;
use super::shadow::is_shadow;
use super::xml::XmlElement;
use pilotage_base::files::FileSet;
use pilotage_base::text::without_markup;

pub(super) use name::NAME;
pub(super) use read::read;
pub(super) use write::write;

/// Names of the two files in the zip.
const WAYLINES: &str = "wpmz/waylines.wpml";
const TEMPLATE: &str = "wpmz/template.kml";
/// Name space of DJI's elements where no file said another; newer ones have other numbers, and DJI Fly has
/// another host.
const NAME_SPACE: &str = "http://www.dji.com/wpmz/1.0.2";

/// Properties of a route: the name space, the mission's configuration, and what else the folders of the
/// waylines and of the template say.
const OWN_NAME_SPACE: &str = "dji.name_space";
const MISSION: &str = "dji.mission";
/// Properties of a route and of a way-point: what else the waylines and the template say of it.
const IN_WAYLINES: &str = "dji.waylines";
const IN_TEMPLATE: &str = "dji.template";
/// Property of a way-point: its number in the file, by which groups of actions name it.
const INDEX: &str = "dji.index";
/// Property of a way-point: height of mean sea level above the ellipsoid, metres; `null` where its
/// altitude is above the ellipsoid itself.
const UNDULATION: &str = "dji.undulation";
/// Property of a way-point above ground: height above the ellipsoid at which its file flies it, metres, with the latitude,
/// longitude and height above ground that this belongs to.
const EXECUTED: &str = "dji.executed";

/// Word for a return home at the end.
const GO_HOME: &str = "goHome";

/// Whether a text is one of the two files, by its name space.
pub(super) fn is_text(head: &str) -> bool {
    head.contains(".com/wpmz/") || head.contains("<wpml:")
}

/// Whether a zip is such a mission, by the names in it.
pub(super) fn is_zip(look: &FileLook<'_>) -> bool {
    look.has(b".wpml") || look.has(TEMPLATE.as_bytes())
}

/// The first file in a set whose name ends so, whatever its folder.
fn ending(files: &dyn FileSet, end: &str) -> Option<(String, Vec<u8>)> {
    let mut names = files.names();
    names.sort();
    let name = names
        .into_iter()
        .find(|name| name.to_ascii_lowercase().ends_with(end) && !is_shadow(name))?;
    let bytes = files.read(&name)?;
    Some((name, bytes))
}

/// Elements as text, all in DJI's name space.
fn text_of<'a>(elements: impl Iterator<Item = &'a XmlElement>) -> String {
    let mut text = String::new();
    for element in elements {
        let inside = text_of(element.children.iter()) + &without_markup(&element.text);
        // Writing into a string cannot fail.
        let _ = write!(text, "<wpml:{0}>{inside}</wpml:{0}>", element.name);
    }
    text
}
