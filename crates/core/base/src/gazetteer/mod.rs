//! Towns of the globe by their names, from one small file.
//!
//! The file (`www/places.bin`, made by `tests/oracles/places_file.py`; numbers little-endian):
//!
//! | bytes | content |
//! |---|---|
//! | 8 | `places 1` |
//! | 3 × 4 | number *n* of places, bytes of the regions, bytes of the names |
//! | as told | regions as lines in UTF-8: number of places, tabulator, name |
//! | as told | names of the places as lines in UTF-8, region by region |
//! | 2 *n* | latitudes, hundredths of a degree: differences from the one before, all low bytes, then all high bytes |
//! | 2 *n* | longitudes, likewise |
//! | *n* | numbers of people: quarters of the binary logarithm of their multiple of the smallest |

mod fold;
#[cfg(test)]
mod tests;

use self::fold::folded;
use crate::frames::Geodetic;
use crate::sorting::sort;

/// First bytes of the file.
const MARK: &[u8] = b"places 1";

/// Towns of the globe by their names.
#[derive(Clone, Debug, Default)]
pub struct Gazetteer {
    /// Names of the regions: as they are written, and folded.
    regions: Vec<[String; 2]>,
    /// Names of the towns, as lines.
    names: String,
    /// The same, folded.
    folded: String,
    /// Their numbers, in the same order.
    towns: Vec<Town>,
}

#[derive(Clone, Copy, Debug)]
struct Town {
    region: usize,
    /// Latitude and longitude, hundredths of a degree.
    hundredths: [i16; 2],
    size: u8,
}

/// Town whose name was looked for.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundTown {
    /// Name.
    pub name: String,
    /// Country, with the state where it is of many.
    pub region: String,
    /// Place at height zero, to a hundredth of a degree.
    pub place: Geodetic,
}

impl Gazetteer {
    /// Reads the file; `None` if it is damaged.
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let mut rest = bytes.strip_prefix(MARK)?;
        let mut take = |count: usize| {
            let (part, behind) = rest.split_at_checked(count)?;
            rest = behind;
            Some(part)
        };
        let mut number = || Some(u32::from_le_bytes(*take(4)?.as_array()?) as usize);
        let [count, of_regions, of_names] = [number()?, number()?, number()?];
        let regions = str::from_utf8(take(of_regions)?).ok()?;
        let names = str::from_utf8(take(of_names)?).ok()?;
        let latitudes = column(take(count.checked_mul(2)?)?);
        let longitudes = column(take(2 * count)?);
        let sizes = take(count)?;
        let mut read = Self {
            names: names.to_owned(),
            ..Self::default()
        };
        let mut numbers = latitudes.zip(longitudes).zip(sizes);
        for line in regions.lines() {
            let (count, name) = line.split_once('\t')?;
            let region = read.regions.len();
            for _ in 0..count.parse().ok()? {
                let ((latitude, longitude), size) = numbers.next()?;
                let is_on_globe =
                    latitude.unsigned_abs() <= 9_000 && longitude.unsigned_abs() <= 18_000;
                read.towns.push(is_on_globe.then_some(Town {
                    region,
                    hundredths: [latitude, longitude],
                    size: *size,
                })?);
            }
            read.regions.push([name.to_owned(), folded(name)]);
        }
        let mut lines = 0;
        for name in names.lines() {
            read.folded += &folded(name);
            read.folded.push('\n');
            lines += 1;
        }
        let is_whole = rest.is_empty() && read.towns.len() == count && lines == count;
        is_whole.then_some(read)
    }

    /// At most so many towns that have words beginning with all those of a text, without accents and case; words but the
    /// first may be of their regions. First come those nearby, for which `distance` knows metres, the nearest before the
    /// others, then the larger before the smaller.
    pub fn find(
        &self,
        text: &str,
        most: usize,
        distance: &dyn Fn(&Geodetic) -> Option<f64>,
    ) -> Vec<FoundTown> {
        let asked = folded(text).replace('\'', "");
        let mut asked = asked.split_whitespace();
        let Some(first) = asked.next() else {
            return Vec::new();
        };
        let others: Vec<&str> = asked.collect();
        let mut found = Vec::new();
        let lines = self.names.lines().zip(self.folded.lines());
        for ((name, folded), town) in lines.zip(&self.towns) {
            let [region, of_region] = &self.regions[town.region];
            let is_meant = |word: &&str| has_word(folded, word) || has_word(of_region, word);
            if has_word(folded, first) && others.iter().all(is_meant) {
                let [latitude, longitude] = town.hundredths.map(|it| 0.01 * f64::from(it));
                let place = Geodetic::from_degrees(latitude, longitude, 0.0);
                found.push((distance(&place), town.size, name, region, place));
            }
        }
        sort(&mut found, &|a, b| {
            let [near, other] = [a.0, b.0].map(|it| it.unwrap_or(f64::INFINITY));
            near.total_cmp(&other).then(b.1.cmp(&a.1))
        });
        let found = found.into_iter().take(most);
        let found = found.map(|(_, _, name, region, place)| FoundTown {
            name: name.to_owned(),
            region: region.clone(),
            place,
        });
        found.collect()
    }
}

/// Whether a word of a folded name begins with letters; that behind an apostrophe is one of its own, too.
fn has_word(folded: &str, beginning: &str) -> bool {
    let begins = |word: &str| {
        let mut letters = word.chars().filter(|c| *c != '\'');
        beginning.chars().all(|c| letters.next() == Some(c))
    };
    folded.split(' ').any(|word| {
        let behind = word.split_once('\'').map(|it| it.1);
        begins(word) || behind.is_some_and(begins)
    })
}

/// Numbers of a column.
fn column(bytes: &[u8]) -> impl Iterator<Item = i16> {
    let (low, high) = bytes.split_at(bytes.len() / 2);
    let steps = low.iter().zip(high);
    steps.scan(0_i16, |last, (low, high)| {
        *last = last.wrapping_add(i16::from_le_bytes([*low, *high]));
        Some(*last)
    })
}
