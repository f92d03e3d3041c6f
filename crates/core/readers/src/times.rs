//! Credibility of the times of a series: the one place that judges them, for every reader.

/// Verdict on one time of a series beside the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TimeVerdict {
    /// It stands where it belongs: sound times never go back.
    Sound,
    /// It goes back a little, or is one of many that another start of the clock tells.
    OutOfOrder,
    /// It lies far from those around it: a damaged byte, a clock that was not set.
    Wrong,
}

/// Largest distance of a time from those around it: in usual steps, and in seconds.
const FAR_STEPS: f64 = 100.0;
const FAR: f64 = 1.0;
/// Of few times, which have no usual step, one has to lie further off.
const FAR_OF_FEW: f64 = 60.0;
/// The same for the first or last few times, which have neighbours on one side only.
const FAR_AT_AN_END: f64 = 10.0;
/// Most times at an end that can be wrong together, and the least that a clock's other start tells.
const FEW: usize = 10;
/// Times that stand for all those before another start, about.
const SOME: usize = 64;
/// Series of fewer times have no usual step.
const ENOUGH: usize = 20;
/// The same for zero at the beginning, in usual steps: a clock that was not set says zero.
const FAR_FROM_ZERO: f64 = 5.0;
/// Times further apart than this are of two clocks, seconds: no flight pauses for thirty days.
const ERA: f64 = 30.0 * 86_400.0;

/// Judges the times of one series in the order of its file, seconds. `None` if all are sound.
///
/// Most decide: sound are those of the [era](eras) and of the start of the clock that most times tell, and among them
/// as many as can be so that they never go back. Of the few at either end those are wrong that lie over a hundred usual
/// steps and ten seconds off.
pub(crate) fn judge(times: &[f64]) -> Option<Vec<TimeVerdict>> {
    let grows = times.windows(2).all(|w| w[1] >= w[0]) && times.iter().all(|t| t.is_finite());
    if grows && !has_far_end(times) && !has_far_parts(times) {
        return None;
    }
    let era = most_told_era(times.iter().copied());
    let is_of_era =
        |time: f64| time.is_finite() && era.is_none_or(|(a, b)| (a..=b).contains(&time));
    let candidates: Vec<usize> = (0..times.len()).filter(|i| is_of_era(times[*i])).collect();
    let starts = starts(times, &candidates);
    let longest = starts.iter().max_by_key(|part| (part.len(), part.end));
    let bulk = longest.map_or(&candidates[..], |part| &candidates[part.clone()]);
    let mut kept = longest_growing(times, bulk);
    let usual = usual_step(times, &kept);
    let ends = trim_ends(times, &mut kept, usual);
    if !ends.is_empty() {
        // Without those, others may fit.
        let rest: Vec<usize> = bulk.iter().copied().filter(|i| !ends.contains(i)).collect();
        kept = longest_growing(times, &rest);
    }
    let mut verdicts = vec![TimeVerdict::Wrong; times.len()];
    for part in starts.iter().filter(|part| part.len() >= FEW) {
        let is_bulk = candidates[part.start] == bulk[0];
        for index in candidates[part.clone()].iter().filter(|_| !is_bulk) {
            verdicts[*index] = TimeVerdict::OutOfOrder;
        }
    }
    let are_few = kept.len() < ENOUGH;
    let tolerance = if are_few {
        FAR_OF_FEW
    } else {
        FAR.max(FAR_STEPS * usual)
    };
    let mut next = 0;
    for index in bulk {
        while kept.get(next).is_some_and(|kept| kept < index) {
            next += 1;
        }
        let after = kept.get(next).map(|kept| times[*kept]);
        let before = next.checked_sub(1).map(|before| times[kept[before]]);
        let time = times[*index];
        let is_far = after.is_some_and(|after| time > after + tolerance)
            || before.is_some_and(|before| time < before - tolerance)
            || before.is_none() && after.is_some_and(|after| time < after - tolerance)
            || after.is_none() && before.is_some_and(|before| time > before + tolerance);
        // Zero out of its place is no time that was told.
        if !is_far && (are_few || time != 0.0) {
            verdicts[*index] = TimeVerdict::OutOfOrder;
        }
    }
    for index in kept {
        verdicts[index] = TimeVerdict::Sound;
    }
    Some(verdicts)
}

/// First and last time of the era that most of them tell; `None` if there is one only, or if another is told by more than
/// half as many. Eras are over [`ERA`] apart.
pub(crate) fn most_told_era(times: impl Iterator<Item = f64> + Clone) -> Option<(f64, f64)> {
    let (mut first, mut last) = (f64::INFINITY, f64::NEG_INFINITY);
    for time in times.clone().filter(|time| time.is_finite()) {
        first = first.min(time);
        last = last.max(time);
    }
    // Nearly every log: nothing has to be counted.
    if first > last || last - first <= ERA {
        return None;
    }
    let mut eras = std::collections::BTreeMap::new();
    for time in times.filter(|time| time.is_finite()) {
        let era = eras.entry((time / ERA).floor() as i64);
        let (count, first, last) = era.or_insert((0_usize, time, time));
        *count += 1;
        *first = first.min(time);
        *last = last.max(time);
    }
    let mut joined: Vec<(usize, f64, f64)> = Vec::new();
    for (count, first, last) in eras.into_values() {
        match joined.last_mut() {
            Some(before) if first - before.2 <= ERA => {
                before.0 += count;
                before.2 = last;
            }
            _ => joined.push((count, first, last)),
        }
    }
    joined.sort_by_key(|(count, ..)| std::cmp::Reverse(*count));
    match joined.as_slice() {
        [(most, first, last), (second, ..), ..] if 2 * second <= *most => Some((*first, *last)),
        _ => None,
    }
}

/// Whether neighbours of a growing series lie so far apart that they are of two eras.
fn has_far_parts(times: &[f64]) -> bool {
    times.windows(2).any(|w| w[1] - w[0] > ERA)
}

/// Whether one of the first or last few of a growing series may be far off.
fn has_far_end(times: &[f64]) -> bool {
    let reach = (FEW + 1).min(times.len());
    let is_far = |w: &[f64]| w[1] - w[0] > FAR_AT_AN_END;
    times.len() >= ENOUGH
        && (times[0] == 0.0
            || times[..reach].windows(2).any(is_far)
            || times[times.len() - reach..].windows(2).any(is_far))
}

/// Ranges of the times between two starts of the clock that told them; those that are no number belong to either.
pub(crate) fn starts_of(times: &[f64]) -> Vec<std::ops::Range<usize>> {
    let finite: Vec<usize> = (0..times.len()).filter(|i| times[*i].is_finite()).collect();
    let parts = starts(times, &finite);
    let mut ranges: Vec<std::ops::Range<usize>> = Vec::with_capacity(parts.len());
    for part in parts {
        let begin = ranges.last().map_or(0, |before| before.end);
        let end = finite.get(part.end).copied().unwrap_or(times.len());
        ranges.push(begin..end);
    }
    ranges
}

/// Parts of the candidates that the clock told without being started again. It was, where times go back below most of
/// those before, and on from there.
fn starts(times: &[f64], candidates: &[usize]) -> Vec<std::ops::Range<usize>> {
    let mut parts = Vec::new();
    let mut begin = 0;
    let at = |i: usize| times[candidates[i]];
    for i in 1..candidates.len() {
        if at(i) >= at(i - 1) - FAR {
            continue;
        }
        let rest = (i..candidates.len()).take(FEW);
        let stays = rest.len() >= FEW.min(candidates.len() - begin);
        if !stays || !rest.clone().all(|j| at(j) < at(i - 1)) {
            continue;
        }
        // Some of those before tell of all.
        let stride = ((i - begin) / SOME).max(1);
        let before = (begin..i).step_by(stride);
        let (count, above) = before.fold((0, 0), |(count, above), j| {
            (count + 1, above + usize::from(at(j) > at(i)))
        });
        if 10 * above >= 9 * count {
            parts.push(begin..i);
            begin = i;
        }
    }
    if begin < candidates.len() {
        parts.push(begin..candidates.len());
    }
    parts
}

/// The step that half of the steps between these times do not exceed, seconds; infinite for few times.
fn usual_step(times: &[f64], kept: &[usize]) -> f64 {
    if kept.len() < ENOUGH {
        return 0.0;
    }
    let steps = kept.windows(2).map(|w| times[w[1]] - times[w[0]]);
    let mut steps: Vec<f64> = steps.filter(|step| *step > 0.0).collect();
    if steps.is_empty() {
        return 0.0;
    }
    let middle = steps.len() / 2;
    *steps.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Takes away the few at either end that lie far off, and returns them.
fn trim_ends(times: &[f64], kept: &mut Vec<usize>, usual: f64) -> Vec<usize> {
    if kept.len() < ENOUGH {
        return Vec::new();
    }
    let far = FAR_AT_AN_END.max(FAR_STEPS * usual);
    let most = FEW.min(kept.len() / ENOUGH);
    let step = |kept: &[usize], i: usize| times[kept[i]] - times[kept[i - 1]];
    let last = (kept.len() - most..kept.len()).find(|i| step(kept, *i) > far);
    let mut ends = kept.split_off(last.unwrap_or(kept.len()));
    let is_unset = |i: usize| times[kept[i - 1]] == 0.0 && step(kept, i) > FAR_FROM_ZERO * usual;
    let first = (1..=most)
        .rev()
        .find(|i| step(kept, *i) > far || is_unset(*i));
    ends.extend(kept.drain(..first.unwrap_or(0)));
    ends
}

/// Those of `places` whose times are the longest part that never goes back; of equally long ones that with the earlier
/// places.
fn longest_growing(times: &[f64], places: &[usize]) -> Vec<usize> {
    // From the end to the beginning: the last of the best part of each length, and what stands behind each in its part.
    let mut last_of: Vec<usize> = Vec::new();
    let mut behind: Vec<Option<usize>> = vec![None; places.len()];
    for index in (0..places.len()).rev() {
        let time = times[places[index]];
        let length = last_of.partition_point(|other| times[places[*other]] >= time);
        behind[index] = length.checked_sub(1).map(|length| last_of[length]);
        if length == last_of.len() {
            last_of.push(index);
        } else {
            last_of[length] = index;
        }
    }
    let mut kept = Vec::with_capacity(last_of.len());
    let mut next = last_of.last().copied();
    while let Some(index) = next {
        kept.push(places[index]);
        next = behind[index];
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::TimeVerdict::{OutOfOrder, Sound, Wrong};
    use super::*;

    fn regular(count: usize) -> Vec<f64> {
        (0..count).map(|i| 100.0 + 0.1 * i as f64).collect()
    }

    /// Places of the times that are not sound, with what they are.
    fn odd(times: &[f64]) -> Vec<(usize, TimeVerdict)> {
        let verdicts = judge(times).unwrap_or_default();
        let odd = verdicts.into_iter().enumerate();
        odd.filter(|(_, verdict)| *verdict != Sound).collect()
    }

    #[test]
    fn times_that_grow_are_sound_whatever_pauses_they_have() {
        assert_eq!(judge(&regular(200)), None);
        let mut paused = regular(400);
        for time in &mut paused[200..] {
            *time += 7200.0;
        }
        assert_eq!(odd(&paused), []);
        let events = [3.0, 50.0, 51.0, 900.0];
        assert_eq!(odd(&events), []);
        assert_eq!(judge(&[]), None);
    }

    #[test]
    fn a_wrong_time_takes_only_itself_wherever_it_stands_and_whatever_it_is() {
        for at in [0, 1, 50, 198, 199] {
            for wrong in [9e12, -9e12, 0.0, -1.0, 400.0, f64::NAN, f64::INFINITY] {
                let mut times = regular(200);
                times[at] = wrong;
                assert_eq!(odd(&times), [(at, Wrong)], "{wrong} at {at}");
            }
        }
    }

    #[test]
    fn zero_is_no_time_unless_the_clock_begins_there() {
        let mut times: Vec<f64> = regular(200).iter().map(|time| time - 99.0).collect();
        times[0] = 0.0;
        assert_eq!(odd(&times), [(0, Wrong)]);
        times[1] = 0.0;
        assert_eq!(odd(&times), [(0, Wrong), (1, Wrong)]);
        times[0] = 1.0;
        assert_eq!(odd(&times), [(1, Wrong)]);
        let from_zero: Vec<f64> = regular(200).iter().map(|time| time - 100.0).collect();
        assert_eq!(odd(&from_zero), []);
    }

    #[test]
    fn several_wrong_times_in_a_row_take_only_themselves() {
        for from in [0, 60, 195] {
            for wrong in [-5.0, 9e12, 700.0] {
                let mut times = regular(200);
                for time in &mut times[from..from + 5] {
                    *time += wrong * 20.0;
                }
                let expected: Vec<_> = (from..from + 5).map(|i| (i, Wrong)).collect();
                assert_eq!(odd(&times), expected, "{wrong} from {from}");
            }
        }
    }

    #[test]
    fn a_clock_that_is_set_while_logging_leaves_the_era_of_most_times() {
        let mut times = regular(200);
        for time in &mut times[30..] {
            *time += 1.7e9;
        }
        let expected: Vec<_> = (0..30).map(|i| (i, Wrong)).collect();
        assert_eq!(odd(&times), expected);
    }

    #[test]
    fn a_clock_that_starts_again_is_no_wrong_time_and_is_not_mixed_with_the_first() {
        let mut times = regular(100);
        times.extend(regular(300).iter().map(|time| time - 99.0));
        let odd = odd(&times);
        assert_eq!(odd.len(), 100);
        assert!(
            odd.iter()
                .all(|(i, verdict)| *i < 100 && *verdict == OutOfOrder)
        );
    }

    #[test]
    fn a_little_disorder_is_no_wrong_time() {
        let mut times = regular(100);
        times.swap(40, 41);
        let odd = odd(&times);
        assert!(odd.len() == 1 && odd[0].1 == OutOfOrder, "{odd:?}");
    }

    #[test]
    fn of_few_times_the_one_that_leaps_is_wrong() {
        assert_eq!(odd(&[1.0, 2.0, 9e12, 3.0]), [(2, Wrong)]);
        assert_eq!(odd(&[1.0, 2.0, 3.0, 1.7e9]), [(3, Wrong)]);
        assert_eq!(odd(&[0.0, 1.7e9, 1.7e9 + 1.0]), [(0, Wrong)]);
    }
}
