//! Sentence in words on what a step did.

use std::fmt::Write;

use nalgebra::Vector2;
use pilotage_core::filter::probability_words;
use pilotage_core::flight::{ChannelName, Flight};
use pilotage_core::navigator::{
    AidInfo, CandidateReport, Doubt, Estimate, FrameReport, Instrument, Outcome,
    RegistrationReport, Run, SensorFault, StepReport,
};
use pilotage_core::registration::RegistrationMethod;

use super::super::parts::figures;
use super::super::plots::{DEAD_RECKONING_AFTER, placed_lately};
use super::super::{ellipse, picking};
use crate::units::Units;

/// Motion of the estimate that is not worth a number, metres.
const LITTLE: f64 = 0.02;

/// Summary of step `index` of the run, for people; `last` is the last one up to it in which anything told the place.
pub(crate) fn sentence(
    run: &Run,
    (index, last): (usize, Option<usize>),
    flight: Option<&Flight>,
    units: Units,
) -> String {
    let doubts = run.steps.get(index).map_or_else(String::new, disbelieved);
    capitalised(&format!(
        "{}{doubts}",
        what_happened(run, (index, last), flight, units)
    ))
}

/// Sentences on the instruments that are not believed, each after a space.
fn disbelieved(step: &StepReport) -> String {
    let sentence = |doubt: &Doubt| {
        let what = match (doubt.why, doubt.instrument) {
            (SensorFault::MayBeLate, _) => ": the estimate spreads over all lags that may be",
            (SensorFault::Late { .. }, _) => ": its pictures show what was before",
            (SensorFault::Contradicted, _) => ": the estimate spreads over all headings",
            (SensorFault::Turned { .. }, _) => "",
            (_, Instrument::Channel(ChannelName::Airspeed)) => {
                " and not believed: what it usually flies is assumed in its place"
            }
            (_, Instrument::Channel(ChannelName::Heading)) => {
                " and not believed: the last one is held, and doubted more and more"
            }
            _ => " and not believed: landmarks are not looked for without it",
        };
        format!(" {}{what}.", doubt.words())
    };
    step.doubts.iter().map(sentence).collect()
}

/// The same with whatever first letter a landmark's name has.
fn what_happened(
    run: &Run,
    (index, last): (usize, Option<usize>),
    flight: Option<&Flight>,
    units: Units,
) -> String {
    let Some(step) = run.steps.get(index) else {
        return "There is no step here.".to_owned();
    };
    if let Some(frame) = &step.frame {
        if let Some(trouble) = &frame.trouble {
            return format!("This picture could not be used: {trouble}.");
        }
        if frame.joint.is_some() {
            return match frame.laid.as_ref().filter(|laid| laid.is_believed()) {
                Some(laid) => whole_picture(step, frame, laid, units),
                None => correction(run, step, frame, flight, units),
            };
        }
        if let Some(cause) = frame.laid.as_ref().and_then(|laid| laid.refusal.as_ref()) {
            let rest = refusals(run, frame);
            return format!(
                "The whole picture was not used: {cause}. {rest} The estimate stays as predicted."
            )
            .replace("  ", " ");
        }
        if !frame.candidates.is_empty() {
            let verdicts = refusals(run, frame);
            let then = if step.placed_by().next().is_some() {
                by_aids(step, units)
            } else {
                "The estimate stays as predicted.".to_owned()
            };
            return format!("{verdicts} {then}");
        }
    }
    if step.placed_by().next().is_some() {
        return by_aids(step, units);
    }
    dead_reckoning(run, last, step, units)
}

/// Aids that told the place, and what that did to the estimate, in words.
fn by_aids(step: &StepReport, units: Units) -> String {
    let names: Vec<&str> = step.placed_by().map(|aid| aid.label).collect();
    let moved = step.after.position().distance(&step.predicted.position());
    format!(
        "{} moved the estimate by {}: its 1σ goes from {} to {}.",
        names.join(" and "),
        units.short(moved),
        units.short(sigma(&step.predicted)),
        units.short(sigma(&step.after))
    )
}

/// Name of everything that told the place last, at step `index` or a moment before; `None` while the aircraft is dead
/// reckoning.
pub(crate) fn placed_by(run: &Run, index: usize) -> Option<String> {
    let step = placed_lately(run, index)?;
    let frame = step.frame.as_ref().filter(|frame| frame.joint.is_some());
    let of_frame = frame.map(|frame| match &frame.laid {
        Some(laid) if laid.is_believed() => "the whole picture",
        _ => "landmarks",
    });
    let all: Vec<&str> = of_frame
        .into_iter()
        .chain(step.placed_by().map(|aid| aid.label))
        .collect();
    Some(all.join(" and "))
}

/// Place of a whole picture, and its correction of the estimate, in words.
fn whole_picture(
    step: &StepReport,
    frame: &FrameReport,
    laid: &RegistrationReport,
    units: Units,
) -> String {
    let off = frame.joint.as_ref().map_or(0.0, |j| j.innovation.norm());
    let agreeing = laid.place.as_ref().map_or(0, |place| place.matches.len());
    let by = match (laid.laid_by, laid.probability) {
        (RegistrationMethod::WholeFrame, Some(probability)) => format!(
            "by its edges, which fit nowhere else as well ({})",
            probability_words(probability)
        ),
        _ => format!("{agreeing} of {} patches agreeing", laid.tried),
    };
    let mut text = format!(
        "The whole picture lies {} from where expected, {by}: the 1σ of the estimate goes from {} to {}.",
        units.short(off),
        units.short(sigma(&step.predicted)),
        units.short(sigma(&step.after))
    );
    if frame.joint.as_ref().is_some_and(|j| j.recovered.is_some()) {
        text.push_str(
            " That is more than the filter expected and cannot be chance, so the filter gave way.",
        );
    }
    if laid.place.as_ref().is_some_and(|p| p.stored_turn != 0.0) {
        text.push_str(" The picture was stored turned.");
    }
    text
}

/// Who was found how far from where expected, and what that did to the estimate.
fn correction(
    run: &Run,
    step: &StepReport,
    frame: &FrameReport,
    flight: Option<&Flight>,
    units: Units,
) -> String {
    let names: Vec<String> = frame
        .accepted()
        .map(|c| picking::landmark_name(run, c.landmark))
        .collect();
    let metres: Vec<f64> = frame
        .accepted()
        .filter_map(|c| miss_on_ground(frame, c, flight))
        .collect();
    let found = if metres.is_empty() {
        let pixels: Vec<f64> = frame
            .accepted()
            .filter_map(|c| Some(c.innovation?.norm()))
            .collect();
        format!("{} px", figures(mean(&pixels)))
    } else {
        units.short(mean(&metres))
    };
    let shift = step.after.position().to_vector() - step.predicted.position().to_vector();
    let moved = if shift.norm() < LITTLE {
        "hardly moved".to_owned()
    } else {
        format!("moved {} {}", units.short(shift.norm()), compass(&shift))
    };
    let (before, after) = (sigma(&step.predicted), sigma(&step.after));
    let [before_words, after_words] = [before, after].map(|it| units.short(it));
    let spread = if after < 0.98 * before && before_words != after_words {
        format!("shrank from {before_words} to {after_words}")
    } else {
        format!("stayed at {after_words}")
    };
    let verdicts = refusals(run, frame);
    let average = if names.len() > 1 { " on average" } else { "" };
    let mut text = format!(
        "{} found {found}{average} from where expected: the estimate {moved} and its 1σ {spread}.",
        listed(&names)
    );
    if let Some(fading) = frame.joint.as_ref().and_then(|j| j.recovered) {
        let spread = figures(fading.sqrt());
        let _ = write!(
            text,
            " The filter had refused them: they agree with an earlier refused landmark against it, so it gave way, with a spread {spread} times as large."
        );
    }
    if !verdicts.is_empty() {
        text.push(' ');
        text.push_str(&verdicts);
    }
    text
}

/// "church", "church and factory", "church, factory and barn".
fn listed(names: &[String]) -> String {
    match names {
        [] => "Nothing".to_owned(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// The text with a capital letter at the start of each sentence that begins with a small one.
fn capitalised(text: &str) -> String {
    let mut begins = true;
    let mut previous = ' ';
    text.chars()
        .map(|c| {
            let upper = begins && c.is_alphabetic();
            begins = (begins && !c.is_alphanumeric()) || (previous == '.' && c == ' ');
            previous = c;
            if upper {
                c.to_uppercase().next().unwrap_or(c)
            } else {
                c
            }
        })
        .collect()
}

/// Sentences on the refused landmarks, of the first three.
fn refusals(run: &Run, frame: &FrameReport) -> String {
    let refused: Vec<String> = frame
        .candidates
        .iter()
        .filter_map(|c| match c.outcome {
            Outcome::Refused(refusal) => Some(format!(
                "{} refused: {}.",
                picking::landmark_name(run, c.landmark),
                refusal.reason()
            )),
            Outcome::Accepted => None,
        })
        .collect();
    let more = refused.len().saturating_sub(3);
    let mut text = refused[..refused.len() - more].join(" ");
    if more > 0 {
        text = format!("{text} {more} more refused.");
    }
    text
}

/// Time without a landmark, and growth of the uncertainty meanwhile, in words.
fn dead_reckoning(run: &Run, last: Option<usize>, step: &StepReport, units: Units) -> String {
    let (factor, unit) = units.length();
    let since_index = last.unwrap_or(0);
    let since = run.steps[since_index].time;
    let elapsed = step.time - since;
    let growth = factor * (sigma(&step.after) - sigma(&run.steps[since_index].after));
    if elapsed <= DEAD_RECKONING_AFTER {
        let is_believed = |name| step.doubts.iter().all(|doubt| !doubt.is_of(name));
        let airspeed = step.control.airspeed;
        let airspeed = airspeed.filter(|_| is_believed(ChannelName::Airspeed));
        let speed = airspeed.map_or_else(String::new, |v| {
            let (factor, unit) = units.speed();
            format!(" at {} {unit}", figures(factor * v))
        });
        return format!(
            "Between pictures the aircraft is moved on{speed} on heading {:03.0}° with the wind believed so far; 1σ is {} {unit}.",
            step.control.heading.to_degrees().rem_euclid(360.0).round() % 360.0,
            figures(factor * sigma(&step.after)),
        );
    }
    let rate = growth / elapsed;
    let mut aids = run.settings.aids.iter();
    let other = aids.any(|aid| AidInfo::named(&aid.key).is_ok_and(|info| info.tells_place));
    let nothing = if other {
        "Nothing told the place"
    } else {
        "No landmark"
    };
    let start = if last.is_some() {
        format!("{nothing} for {elapsed:.1} s")
    } else {
        format!("{nothing} yet, {elapsed:.1} s into the run")
    };
    let trend = if rate > 0.005 {
        format!(
            "the uncertainty grows by {} {unit} each second",
            figures(rate)
        )
    } else {
        "the uncertainty hardly grows".to_owned()
    };
    format!(
        "{start}: dead reckoning, {trend} and 1σ is now {} {unit}.",
        figures(factor * sigma(&step.after))
    )
}

/// Greatest standard deviation of the position over all directions, metres.
pub(crate) fn sigma(estimate: &Estimate) -> f64 {
    ellipse::largest_sigma(&estimate.position_covariance())
}

/// Distance on the ground between the expected and the found place, metres.
fn miss_on_ground(
    frame: &FrameReport,
    candidate: &CandidateReport,
    flight: Option<&Flight>,
) -> Option<f64> {
    let flight = flight?;
    let ground = |pixel| {
        flight
            .camera
            .ground_at(&frame.assumed_pose, pixel, flight.ground_down)
    };
    let expected = ground(&candidate.predicted_pixel)?;
    Some(expected.distance(&ground(&candidate.measured_pixel?)?))
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// Name of the compass point, of eight, towards which a (north, east) vector points.
fn compass(vector: &Vector2<f64>) -> &'static str {
    const WINDS: [&str; 8] = [
        "north",
        "north-east",
        "east",
        "south-east",
        "south",
        "south-west",
        "west",
        "north-west",
    ];
    let eighth = (vector.y.atan2(vector.x).to_degrees() / 45.0).round() as i64;
    WINDS[eighth.rem_euclid(8) as usize]
}

#[cfg(test)]
mod tests {
    use super::super::super::fixture::{Fixture, reading_of_gps};
    use super::*;
    use pilotage_core::navigator::Refusal;

    #[test]
    fn an_instrument_that_is_not_believed_is_named_with_what_takes_its_place() {
        let mut fixture = Fixture::lasting(15.0);
        fixture.run.steps[3].doubts.push(Doubt {
            instrument: Instrument::Channel(ChannelName::Airspeed),
            why: SensorFault::Stuck,
            since: 1.25,
        });
        let text = of(&fixture, 3);
        let told = "Airspeed is stuck since 1.2 s and not believed: what it usually flies is assumed in its place.";
        assert!(text.ends_with(told), "{text}");
        assert!(!text.contains(" m/s on heading"), "{text}");
    }

    #[test]
    fn a_flight_by_aids_is_not_told_to_be_dead_reckoning() {
        let mut fixture = Fixture::lasting(15.0);
        let index = 3;
        assert!(!fixture.run.steps[index].is_placed());
        let gain = || Some(nalgebra::DMatrix::zeros(4, 2));
        let mut reading = reading_of_gps(1.0, gain());
        fixture.run.steps[index].updates.push(reading.clone());
        let text = of(&fixture, index);
        assert!(
            text.starts_with("GPS position moved the estimate by"),
            "{text}"
        );
        // Of a heading, the place is as little known as before; of what was refused, too.
        reading.aid = "magnetic-heading".to_owned();
        fixture.run.steps[index].updates = vec![reading, reading_of_gps(30.0, None)];
        assert!(!fixture.run.steps[index].is_placed());
        let text = of(&fixture, index);
        assert!(!text.contains("moved the estimate"), "{text}");
    }

    #[test]
    fn the_place_is_told_by_what_told_it_last_and_by_nothing_after_a_while() {
        let mut fixture = Fixture::lasting(15.0);
        let last = fixture.run.steps.iter().rposition(StepReport::is_placed);
        let last = last.unwrap();
        let told = |fixture: &Fixture, index| placed_by(&fixture.run, index);
        assert_eq!(told(&fixture, last).as_deref(), Some("landmarks"));
        let alone = fixture.run.steps[last].clone();
        for late in [1.9, 2.1, 60.0] {
            let mut step = alone.clone();
            (step.frame, step.time) = (None, alone.time + late);
            fixture.run.steps.truncate(last + 1);
            fixture.run.steps.push(step);
            assert_eq!(told(&fixture, last + 1).is_some(), late < 2.0, "{late} s");
        }
        let gain = Some(nalgebra::DMatrix::zeros(4, 2));
        fixture.run.steps[last + 1]
            .updates
            .push(reading_of_gps(1.0, gain));
        assert_eq!(told(&fixture, last + 1).as_deref(), Some("GPS position"));
    }

    #[test]
    fn a_late_camera_and_a_turned_compass_are_told_with_their_numbers() {
        let mut fixture = Fixture::lasting(15.0);
        let doubts = &mut fixture.run.steps[3].doubts;
        doubts.push(Doubt {
            instrument: Instrument::Channel(ChannelName::Heading),
            why: SensorFault::Turned { by: -0.35 },
            since: 2.0,
        });
        doubts.push(Doubt {
            instrument: Instrument::Camera,
            why: SensorFault::Late { by: 1.04 },
            since: 3.0,
        });
        let text = of(&fixture, 3);
        let told = "Heading reads 20° too far left, corrected since 2.0 s. Camera is 1.0 s late, allowed for \
                    since 3.0 s: its pictures show what was before.";
        assert!(
            text.to_lowercase().ends_with(&told.to_lowercase()),
            "{text}"
        );
    }

    fn told(fixture: &Fixture, index: usize, units: Units) -> String {
        let steps = &fixture.run.steps[..=index];
        let last = steps.iter().rposition(StepReport::is_placed);
        sentence(&fixture.run, (index, last), Some(&fixture.flight), units)
    }

    fn of(fixture: &Fixture, index: usize) -> String {
        told(fixture, index, Units::Metric)
    }

    fn first_correction(run: &Run) -> usize {
        run.steps.iter().position(StepReport::corrected).unwrap()
    }

    #[test]
    fn a_correction_names_its_landmarks_and_what_they_did() {
        let fixture = Fixture::lasting(15.0);
        let text = of(&fixture, first_correction(&fixture.run));
        assert!(
            text.contains("from where expected: the estimate moved"),
            "{text}"
        );
        assert!(text.contains("its 1σ shrank from"), "{text}");
    }

    #[test]
    fn the_distance_is_that_on_the_ground() {
        let mut fixture = Fixture::lasting(15.0);
        let index = first_correction(&fixture.run);
        let height = fixture.run.steps[index].control.height;
        let focal = fixture.flight.camera.focal;
        let frame = fixture.run.steps[index].frame.as_mut().unwrap();
        frame.candidates.truncate(1);
        frame.candidates[0].outcome = Outcome::Accepted;
        let pixels = 10.0 * focal / height;
        frame.candidates[0].measured_pixel =
            Some(frame.candidates[0].predicted_pixel + Vector2::new(pixels, 0.0));
        let text = of(&fixture, index);
        assert!(text.contains("found 10 m from"), "{text}");
        let near = fixture.run.steps[index].frame.as_mut().unwrap();
        let predicted = near.candidates[0].predicted_pixel;
        near.candidates[0].measured_pixel = Some(predicted + Vector2::new(0.01 * pixels, 0.0));
        assert!(of(&fixture, index).contains("found 10 cm from"));
        let frame = fixture.run.steps[index].frame.as_mut().unwrap();
        frame.candidates[0].measured_pixel = Some(predicted + Vector2::new(pixels, 0.0));
        let feet = told(&fixture, index, Units::Aviation);
        assert!(feet.contains("found 33 ft from"), "{feet}");
    }

    #[test]
    fn a_recovery_is_told() {
        let mut fixture = Fixture::lasting(15.0);
        let index = first_correction(&fixture.run);
        let frame = fixture.run.steps[index].frame.as_mut().unwrap();
        frame.joint.as_mut().unwrap().recovered = Some(9.0);
        let text = of(&fixture, index);
        assert!(text.contains("it gave way, with a spread 3.0"), "{text}");
    }

    #[test]
    fn a_whole_picture_is_told_and_a_refused_one_with_its_cause() {
        let mut fixture = Fixture::lasting(15.0);
        let index = first_correction(&fixture.run);
        let frame = fixture.run.steps[index].frame.as_mut().unwrap();
        frame.candidates.clear();
        frame.joint.as_mut().unwrap().innovation = nalgebra::dvector![3.0, 4.0];
        let mut laid = RegistrationReport {
            place: None,
            refusal: None,
            refused_as: None,
            tried: 60,
            laid_by: RegistrationMethod::Patches,
            log_false_alarms: -30.0,
            probability: Some(1.0),
        };
        frame.laid = Some(laid.clone());
        let text = of(&fixture, index);
        assert!(
            text.starts_with("The whole picture lies 5.0 m from where expected"),
            "{text}"
        );
        let frame = fixture.run.steps[index].frame.as_mut().unwrap();
        let doubted = frame.laid.as_mut().unwrap();
        doubted.laid_by = RegistrationMethod::WholeFrame;
        doubted.probability = Some(0.9997);
        let text = of(&fixture, index);
        assert!(text.contains("nowhere else as well (> 99.9 %)"), "{text}");
        laid.refusal = Some("nothing within reach looks like the picture".to_owned());
        let frame = fixture.run.steps[index].frame.as_mut().unwrap();
        frame.joint = None;
        frame.laid = Some(laid);
        assert_eq!(
            of(&fixture, index),
            "The whole picture was not used: nothing within reach looks like the picture. The estimate stays as \
             predicted."
        );
    }

    #[test]
    fn a_frame_of_refusals_says_why_and_that_nothing_changed() {
        let mut fixture = Fixture::lasting(15.0);
        let index = first_correction(&fixture.run);
        let frame = fixture.run.steps[index].frame.as_mut().unwrap();
        frame.joint = None;
        frame.candidates.truncate(1);
        frame.candidates[0].outcome = Outcome::Refused(Refusal::Ambiguous);
        assert_eq!(
            of(&fixture, index),
            "Church refused: a second place looks nearly as good. The estimate stays as predicted."
        );
    }

    #[test]
    fn a_long_gap_is_dead_reckoning_with_its_growth() {
        let fixture = Fixture::new();
        let run = &fixture.run;
        let index = run.steps.len()
            - 1
            - run
                .steps
                .iter()
                .rev()
                .position(|s| (s.time - 62.0).abs() < 1e-6)
                .unwrap();
        let text = of(&fixture, index);
        assert!(text.starts_with("No landmark for"), "{text}");
        assert!(text.contains("the uncertainty grows by"), "{text}");
    }

    #[test]
    fn sentences_begin_with_a_capital_letter_whatever_the_landmark_is_called() {
        assert_eq!(
            capitalised("water tanks refused: 0.5 is too low. church found 1.2 m off."),
            "Water tanks refused: 0.5 is too low. Church found 1.2 m off."
        );
        assert_eq!(capitalised("3 masts found."), "3 masts found.");
    }

    #[test]
    fn a_shift_to_the_north_west_is_called_so() {
        assert_eq!(compass(&Vector2::new(1.0, -1.0)), "north-west");
        assert_eq!(compass(&Vector2::new(-3.0, 0.2)), "south");
        assert_eq!(compass(&Vector2::new(0.0, 2.0)), "east");
    }
}
