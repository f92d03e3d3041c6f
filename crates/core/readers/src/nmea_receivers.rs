//! Receivers that take turns in one file of sentences.

use std::collections::{BTreeMap, BTreeSet};

use crate::cells::median;
use crate::nmea_velocity::metres_between;

/// Fewest times that two receivers take turns.
const TURNS: usize = 4;
/// Steps from one receiver's place to the other's are so many times as long as those of one of them, and so many metres longer.
const TIMES: f64 = 1.5;
const MORE: f64 = 5.0;

/// Largest share of the moments of a receiver that it may have in common with another: one that names itself after the
/// satellites that it uses says its moments once, or the same by several sentences.
const SHARE: f64 = 0.5;
/// Half a day in seconds: a clock that falls back farther went round.
const HALF_DAY: f64 = 43_200.0;

/// Place in a sentence: the receiver's letters, its second of the day and its latitude and longitude in degrees.
pub(super) type SaidPlace<'a> = (&'a str, f64, [f64; 2]);

/// Letters of the receivers whose places make the track leap to and fro, as another receiver with more places tells other
/// ones at other moments; and a sentence about each.
pub(super) fn of_others<'a>(places: &[SaidPlace<'a>]) -> (BTreeSet<&'a str>, Vec<String>) {
    let mut moments: BTreeMap<&str, BTreeSet<(u32, u64)>> = BTreeMap::new();
    let (mut day, mut last) = (0, 0.0);
    for (talker, second, _) in places {
        // Another receiver may be a little behind at midnight.
        day += u32::from(last - second > HALF_DAY);
        let is_before = second - last > HALF_DAY && day > 0;
        if !is_before {
            last = *second;
        }
        let moment = (day - u32::from(is_before), (1e3 * second).round() as u64);
        moments.entry(talker).or_default().insert(moment);
    }
    let most = moments.iter().max_by_key(|(_, times)| times.len());
    let Some((main, main_times)) = most else {
        return Default::default();
    };
    let (mut others, mut told) = (BTreeSet::new(), Vec::new());
    for (talker, times) in moments.iter().filter(|(talker, _)| *talker != main) {
        let of_both = |place: &&SaidPlace| [main, talker].contains(&&place.0);
        let both: Vec<&SaidPlace> = places.iter().filter(of_both).collect();
        let step = |pair: &[&SaidPlace]| {
            let [north, east] = metres_between(pair[0].2, pair[1].2);
            north.hypot(east)
        };
        let turns = both.windows(2).filter(|pair| pair[0].0 != pair[1].0);
        let turns: Vec<f64> = turns.map(step).collect();
        let alone = [main, talker].map(|name| {
            let own = both.iter().copied().filter(|place| place.0 == *name);
            let own: Vec<&SaidPlace> = own.collect();
            own.windows(2).map(step).collect::<Vec<f64>>()
        });
        let apart = median(turns.clone()).unwrap_or(0.0);
        let common = times.intersection(main_times).count() as f64;
        let is_apart = apart > TIMES * median(alone.concat()).unwrap_or(0.0) + MORE;
        if turns.len() >= TURNS && is_apart && common <= SHARE * times.len() as f64 {
            others.insert(*talker);
            told.push(format!(
                "two receivers take turns, {apart:.0} m apart: the {} places of {talker} are left out, and the {} of {main} \
                 read",
                times.len(),
                main_times.len()
            ));
        }
    }
    (others, told)
}
