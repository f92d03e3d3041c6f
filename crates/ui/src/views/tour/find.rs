//! Telling moment of each stop in a run, and the words on it.

use pilotage_core::flight::Flight;
use pilotage_core::navigator::{CandidateReport, Outcome, Run, StepReport};

use super::super::inspector::sentence::sigma;
use super::super::parts::figures;
use super::super::picking;
use super::moment::TourMoment;
use super::stop::Stop;
use crate::units::Units;

/// Finds the moment of `stop` in `run`; `None` while the run has not got there.
pub(crate) fn find(
    stop: Stop,
    run: &Run,
    flight: Option<&Flight>,
    units: Units,
) -> Option<TourMoment> {
    match stop {
        Stop::FirstLandmark => first_landmark(run),
        Stop::Shrinking => shrinking(run, units),
        Stop::Gate => gate(run),
        Stop::Refused => refused(run),
        Stop::Wind => wind(run, flight, units),
        Stop::DeadReckoning => dead_reckoning(run, units),
        Stop::Growing => growing(run, units),
        Stop::Reacquired => reacquired(run, units),
        Stop::Alpha => alpha(run),
        Stop::Consistency => consistency(run),
        Stop::YourTurn => your_turn(run),
    }
}

/// The accepted landmark of a step with the best score.
fn best_accepted(step: &StepReport) -> Option<&CandidateReport> {
    step.frame
        .as_ref()?
        .accepted()
        .max_by(|a, b| a.score.total_cmp(&b.score))
}

fn first_landmark(run: &Run) -> Option<TourMoment> {
    let index = run.steps.iter().position(StepReport::corrected)?;
    let candidate = best_accepted(&run.steps[index])?;
    let name = picking::landmark_name(run, candidate.landmark);
    let distance = candidate.innovation.map_or(0.0, |v| v.norm());
    let text = format!(
        "The navigator expected “{name}” at the white ring and searched only around it; it found it {} pixels away. \
         That difference, the innovation, is all it ever learns from the camera.",
        figures(distance)
    );
    Some(TourMoment::new(run, index, text).landmark(Some(candidate.landmark)))
}

/// The correction that shrank σ by the largest factor.
fn shrinking(run: &Run, units: Units) -> Option<TourMoment> {
    let index = (0..run.steps.len())
        .filter(|i| run.steps[*i].corrected())
        .max_by(|a, b| {
            let ratio =
                |i: usize| sigma(&run.steps[i].predicted) / sigma(&run.steps[i].after).max(1e-9);
            ratio(*a).total_cmp(&ratio(*b))
        })?;
    let step = &run.steps[index];
    let (factor, unit) = units.length();
    let text = format!(
        "The sigma points are a handful of guesses that together stand for how unsure the filter is; each is asked where the landmark would appear. \
         The estimate moves toward what the camera saw, and the less spread remains, the surer it is: here the 1σ shrinks from {} to {} {unit} in one step.",
        figures(factor * sigma(&step.predicted)),
        figures(factor * sigma(&step.after))
    );
    Some(TourMoment::new(run, index, text).landmark(best_accepted(step).map(|c| c.landmark)))
}

/// Every candidate with a NIS, with the index of its step.
fn judged(run: &Run) -> impl Iterator<Item = (usize, &CandidateReport, f64)> {
    run.steps.iter().enumerate().flat_map(|(i, step)| {
        step.frame
            .iter()
            .flat_map(|f| &f.candidates)
            .filter_map(move |c| Some((i, c, c.nis?)))
    })
}

/// The accepted match that came closest to the gate.
fn gate(run: &Run) -> Option<TourMoment> {
    let (index, candidate, nis) = judged(run)
        .filter(|(_, c, _)| c.outcome == Outcome::Accepted)
        .max_by(|a, b| a.2.total_cmp(&b.2))?;
    let name = picking::landmark_name(run, candidate.landmark);
    let text = format!(
        "The filter knows how far a landmark may lie from its expected place; the squared distance in those units is the NIS, and above {} the gate shuts. \
         “{name}” here came closest to it of all that were let in, with a NIS of {}.",
        figures(candidate.threshold),
        figures(nis)
    );
    Some(TourMoment::new(run, index, text).landmark(Some(candidate.landmark)))
}

/// The most telling refusal: by the gate, then by contradiction, then the most ambiguous one.
/// Without any, the closest call.
fn refused(run: &Run) -> Option<TourMoment> {
    let candidates = || {
        run.steps.iter().enumerate().flat_map(|(i, step)| {
            step.frame
                .iter()
                .flat_map(|f| &f.candidates)
                .map(move |c| (i, c))
        })
    };
    let refusal = candidates()
        .filter_map(|(i, c)| match c.outcome {
            Outcome::Refused(refusal) => Some((i, c, refusal)),
            Outcome::Accepted => None,
        })
        .max_by(|a, b| {
            use pilotage_core::navigator::Refusal;
            let limit = run.settings.detector.greatest_ambiguity;
            let rank = |(_, c, r): &(usize, &CandidateReport, Refusal)| match r {
                Refusal::OutsideGate => 4,
                Refusal::Contradicted => 3,
                Refusal::Ambiguous if picking::ambiguity(c) > limit => 2,
                Refusal::Ambiguous => 1,
                _ => 0,
            };
            rank(a).cmp(&rank(b)).then(a.1.score.total_cmp(&b.1.score))
        });
    if let Some((index, candidate, refusal)) = refusal {
        let name = picking::landmark_name(run, candidate.landmark);
        let numbers = candidate.nis.map_or_else(
            || {
                if candidate.second_score > 0.0 {
                    format!(
                        "score {:.2}, runner-up {:.2}",
                        candidate.score, candidate.second_score
                    )
                } else {
                    format!("score {:.2}", candidate.score)
                }
            },
            |nis| format!("score {:.2}, NIS {}", candidate.score, figures(nis)),
        );
        let text = format!(
            "“{name}” was looked for and something was found, but {} ({numbers}). \
             One false landmark does more harm than ten missing ones, so the filter rather goes without.",
            picking::reason(run, candidate, refusal)
        );
        return Some(TourMoment::new(run, index, text).landmark(Some(candidate.landmark)));
    }
    let (index, candidate) =
        candidates().max_by(|a, b| picking::ambiguity(a.1).total_cmp(&picking::ambiguity(b.1)))?;
    let name = picking::landmark_name(run, candidate.landmark);
    let text = format!(
        "In this run nothing was refused so far. The closest call was “{name}”: a second place scored {:.0} % of the best, and from {:.0} % on it would have been refused as ambiguous.",
        100.0 * picking::ambiguity(candidate),
        100.0 * run.settings.detector.greatest_ambiguity
    );
    Some(TourMoment::new(run, index, text).landmark(Some(candidate.landmark)))
}

/// Parts of the start's error, or σ, at which the wind counts as learned: the smallest that the run
/// comes to.
const LEARNED: [f64; 3] = [0.15, 0.3, 0.5];

/// When the wind's error (or, without a truth, its σ) has first come down to a small part of the
/// start's.
fn wind(run: &Run, flight: Option<&Flight>, units: Units) -> Option<TourMoment> {
    let (north, east) = run
        .state_index("wind north")
        .zip(run.state_index("wind east"))?;
    let spread = |s: &StepReport| {
        (s.after.covariance[(north, north)] + s.after.covariance[(east, east)])
            .max(0.0)
            .sqrt()
    };
    let error = |s: &StepReport| {
        let wind = flight?.truth.as_ref()?.wind(s.time)?;
        Some((s.after.mean[north] - wind.x).hypot(s.after.mean[east] - wind.y))
    };
    let (factor, unit) = units.speed();
    let first = run.steps.first()?;
    let measured = error(first).filter(|e| *e > 0.5);
    let (index, text) = if let Some(start) = measured {
        let index = first_below(run, start, error)?;
        let text = format!(
            "No instrument measures the wind, yet by now its error has fallen from {} to {} {unit}. \
             Each time a landmark shows that the aircraft has drifted, the filter blames the wind in proportion, because position and wind err together.",
            figures(factor * start),
            figures(factor * error(&run.steps[index]).unwrap_or(0.0))
        );
        (index, text)
    } else {
        let start = spread(first);
        let index = first_below(run, start, |s| Some(spread(s)))?;
        let text = format!(
            "No instrument measures the wind, yet by now its uncertainty has fallen from {} to {} {unit}. \
             Each time a landmark shows that the aircraft has drifted, the filter blames the wind in proportion, because position and wind err together.",
            figures(factor * start),
            figures(factor * spread(&run.steps[index]))
        );
        (index, text)
    };
    Some(TourMoment::new(run, index, text).from(first.time))
}

/// Number of steps for which the wind has to stay learned.
const LASTING: usize = 100;

/// The first step at which `value` is below one of [`LEARNED`] of `start` and stays there a while.
fn first_below(run: &Run, start: f64, value: impl Fn(&StepReport) -> Option<f64>) -> Option<usize> {
    let below = |part: f64| {
        let low = |s: &StepReport| value(s).is_some_and(|v| v < part * start);
        (0..run.steps.len()).find(|i| {
            let end = run.steps.len().min(i + LASTING);
            run.steps[*i..end].iter().all(low)
        })
    };
    LEARNED.into_iter().find_map(below)
}

/// First and last step of the longest stretch between two corrections (or to the end).
pub(crate) fn longest_gap(run: &Run) -> Option<(usize, usize)> {
    let mut ends: Vec<usize> = (0..run.steps.len())
        .filter(|i| run.steps[*i].corrected())
        .collect();
    ends.push(run.steps.len().checked_sub(1)?);
    ends.windows(2).map(|w| (w[0], w[1])).max_by(|a, b| {
        let length = |g: &(usize, usize)| run.steps[g.1].time - run.steps[g.0].time;
        // Of equal ones the first.
        length(a).total_cmp(&length(b)).then(b.0.cmp(&a.0))
    })
}

fn dead_reckoning(run: &Run, units: Units) -> Option<TourMoment> {
    let (from, to) = longest_gap(run)?;
    let middle = usize::midpoint(from, to);
    let (start, end) = (&run.steps[from], &run.steps[to]);
    let elapsed = end.time - start.time;
    let (factor, unit) = units.length();
    let before_end = if end.corrected() {
        &end.predicted
    } else {
        &end.after
    };
    let rate = factor * (sigma(before_end) - sigma(&start.after)) / elapsed.max(1e-9);
    let text = format!(
        "For {elapsed:.1} seconds no landmark corrects the estimate: the filter adds up airspeed, heading and the wind it believes in, and nothing else. \
         The track turns blue and the uncertainty grows by about {} {unit} each second.",
        figures(rate)
    );
    Some(TourMoment::new(run, middle, text).from(start.time))
}

fn growing(run: &Run, units: Units) -> Option<TourMoment> {
    let (from, to) = longest_gap(run)?;
    let last = if run.steps[to].corrected() {
        to.saturating_sub(1).max(from)
    } else {
        to
    };
    let (factor, unit) = units.length();
    let text = format!(
        "Every sigma point flies on with its own guess of the wind, so that they drift apart: the 1σ has grown from {} to {} {unit}. \
         Nothing went wrong here: the filter honestly says how little it knows by now, and widens its search for the next landmark.",
        figures(factor * sigma(&run.steps[from].after)),
        figures(factor * sigma(&run.steps[last].after))
    );
    Some(TourMoment::new(run, last, text).from(run.steps[from].time))
}

fn reacquired(run: &Run, units: Units) -> Option<TourMoment> {
    let (from, to) = longest_gap(run)?;
    let step = &run.steps[to];
    if !step.corrected() {
        return None;
    }
    let name = best_accepted(step).map(|c| (c.landmark, picking::landmark_name(run, c.landmark)));
    let (factor, unit) = units.length();
    let shift = factor * step.after.position().distance(&step.predicted.position());
    let text = format!(
        "After {:.1} seconds {} comes into view where the widened search expects it, and the estimate jumps {} {unit} back. \
         The 1σ falls from {} to {} {unit}, and the wind that was believed in meanwhile is corrected as well.",
        step.time - run.steps[from].time,
        name.as_ref()
            .map_or_else(|| "a landmark".to_owned(), |n| format!("“{}”", n.1)),
        figures(shift),
        figures(factor * sigma(&step.predicted)),
        figures(factor * sigma(&step.after))
    );
    Some(
        TourMoment::new(run, to, text)
            .from(run.steps[from].time)
            .landmark(name.map(|n| n.0)),
    )
}

fn alpha(run: &Run) -> Option<TourMoment> {
    let index = run.steps.iter().position(StepReport::corrected)?;
    let text = format!(
        "α sets how far the sigma points stand from the middle; this run uses {}. \
         Drag it below: the points move, but the mean and ellipse that they give hardly change as long as the curve they go through is gentle.",
        run.settings.alpha
    );
    Some(TourMoment::new(run, index, text))
}

/// Numbers measured per landmark: the degrees of freedom of a single one's NIS.
pub(crate) fn degrees_of_freedom(run: &Run) -> usize {
    run.steps
        .iter()
        .find_map(|step| {
            let frame = step.frame.as_ref()?;
            let joint = frame.joint.as_ref()?;
            joint
                .degrees_of_freedom
                .checked_div(frame.accepted().count())
        })
        .unwrap_or(2)
}

/// NIS of every single accepted landmark.
pub(crate) fn accepted_nis(run: &Run) -> Vec<f64> {
    judged(run)
        .filter(|(_, c, _)| c.outcome == Outcome::Accepted)
        .map(|(_, _, nis)| nis)
        .collect()
}

fn consistency(run: &Run) -> Option<TourMoment> {
    let values = accepted_nis(run);
    let index = run.steps.iter().rposition(StepReport::corrected)?;
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    let expected = degrees_of_freedom(run);
    let verdict = if mean < 0.6 * expected as f64 {
        "lower: it is more careful than it needs to be"
    } else if mean > 1.4 * expected as f64 {
        "higher: it is surer than it should be"
    } else {
        "close: it knows how wrong it is"
    };
    let text = format!(
        "If the filter's uncertainties are honest, the NIS of a landmark follows the chi-square curve with a mean of {expected}. \
         Over the {} matches so far the mean is {}, which is {verdict}.",
        values.len(),
        figures(mean)
    );
    Some(TourMoment::new(run, index, text))
}

fn your_turn(run: &Run) -> Option<TourMoment> {
    let index = run.steps.len().checked_sub(1)?;
    let text = "Now pick something that looks like nothing else around it: drag a box on the map, name it, and fly again. \
                The old run stays as a ghost, so that you see at once whether your landmark helped."
        .to_owned();
    Some(TourMoment::new(run, index, text))
}

#[cfg(test)]
mod tests {
    use super::super::super::fixture::Fixture;
    use super::*;

    fn moment(fixture: &Fixture, stop: Stop) -> TourMoment {
        find(stop, &fixture.run, Some(&fixture.flight), Units::Metric).unwrap()
    }

    #[test]
    fn every_stop_finds_its_moment_in_a_whole_flight() {
        let fixture = Fixture::new();
        for stop in Stop::ALL {
            let moment = moment(&fixture, stop);
            assert!((fixture.run.steps[moment.index].time - moment.time).abs() < 1e-9);
            assert!(
                moment.text.matches(['.', '?']).count() >= 2,
                "{}",
                moment.text
            );
        }
    }

    #[test]
    fn the_first_landmark_is_at_the_first_correction() {
        let fixture = Fixture::new();
        let moment = moment(&fixture, Stop::FirstLandmark);
        assert!(fixture.run.steps[moment.index].corrected());
        assert!(
            !fixture.run.steps[..moment.index]
                .iter()
                .any(StepReport::corrected)
        );
    }

    #[test]
    fn the_longest_gap_is_longer_than_any_other() {
        let fixture = Fixture::new();
        let run = &fixture.run;
        let (from, to) = longest_gap(run).unwrap();
        assert!(!run.steps[from + 1..to].iter().any(StepReport::corrected));
        let length = run.steps[to].time - run.steps[from].time;
        assert!(length > 10.0, "{length}");
    }

    #[test]
    fn after_the_gap_a_landmark_is_found_again() {
        let fixture = Fixture::new();
        let moment = moment(&fixture, Stop::Reacquired);
        assert!(fixture.run.steps[moment.index].corrected());
        assert!(moment.text.contains("Pool"), "{}", moment.text);
    }

    #[test]
    fn a_run_without_refusals_says_so_and_shows_the_closest_call() {
        let mut fixture = Fixture::lasting(20.0);
        for step in &mut fixture.run.steps {
            if let Some(frame) = &mut step.frame {
                frame.candidates.retain(|c| c.outcome == Outcome::Accepted);
            }
        }
        let moment = moment(&fixture, Stop::Refused);
        assert!(
            moment.text.contains("nothing was refused"),
            "{}",
            moment.text
        );
        assert!(moment.landmark.is_some());
    }

    #[test]
    fn the_wind_is_learned_when_little_of_its_error_is_left() {
        let fixture = Fixture::new();
        let moment = moment(&fixture, Stop::Wind);
        let error = |i: usize| {
            let step = &fixture.run.steps[i];
            (step.after.mean[2] - 2.0).hypot(step.after.mean[3] + 3.0)
        };
        assert!(error(moment.index) < 0.5 * error(0));
        assert!(error(moment.index - 1) > error(moment.index));
    }
}
