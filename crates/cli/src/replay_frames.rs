//! Outcomes of the frames of a replay, in lines.

use std::collections::BTreeMap;

use pilotage_core::flight::{Flight, Truth};
use pilotage_core::navigator::{
    CandidateReport, FrameReport, Outcome, Refusal, RegistrationRefusal, RegistrationReport, Run,
    StepReport, Summary, is_wrong, place_error,
};
use pilotage_core::registration::RegistrationMethod;

/// Prints a line for each frame, one for its laying on the map as a whole, and one for each landmark.
pub fn print_frames(flight: &Flight, run: &Run) {
    for step in &run.steps {
        let Some(frame) = &step.frame else { continue };
        println!("{}", frame_line(flight, step, frame));
        if let Some(laid) = &frame.laid {
            println!("    {}", laid_line(laid));
        }
        if let Some(trouble) = &frame.trouble {
            println!("    not used: {trouble}");
        }
        for candidate in &frame.candidates {
            println!(
                "    {}",
                candidate_line(flight, run, frame.index, candidate)
            );
        }
    }
}

fn frame_line(flight: &Flight, step: &StepReport, frame: &FrameReport) -> String {
    let name = flight.frames.get(frame.index).map_or("", |f| &f.name);
    let of_frame = |t: &Truth| Some(t.frames.get(frame.index)?.position);
    let truth = flight.truth.as_ref();
    let truth = truth.and_then(|t| of_frame(t).or_else(|| t.position(step.time)));
    let position = step.after.position();
    let error = truth.map_or("unknown".to_owned(), |t| {
        format!(
            "{:6.2} m",
            (position.north - t.x).hypot(position.east - t.y)
        )
    });
    let spread = step.after.position_covariance().trace().sqrt();
    format!(
        "{:8.2} s {name:14} error {error}, 1σ {spread:5.2} m, see {:6.1} ms",
        step.time, step.timing.see
    )
}

fn laid_line(laid: &RegistrationReport) -> String {
    let probability = laid.probability.map_or(String::new(), |p| {
        format!(", {:.2} % by the whole frame", 100.0 * p)
    });
    if let Some(refusal) = &laid.refusal {
        return format!("not laid: {refusal}{probability}");
    }
    let by = match laid.laid_by {
        RegistrationMethod::Patches => "patches",
        RegistrationMethod::WholeFrame => "its edges as a whole",
    };
    let agreeing = laid.place.as_ref().map_or(0, |place| place.matches.len());
    format!(
        "laid by {by}: {agreeing} of {} patches agree{probability}",
        laid.tried
    )
}

fn candidate_line(flight: &Flight, run: &Run, frame: usize, candidate: &CandidateReport) -> String {
    let landmark = run.landmarks.iter().find(|l| l.id == candidate.landmark);
    let error = place_error(flight, run, frame, candidate);
    let is_wrong = error.is_some() && is_wrong(flight, run, frame, candidate);
    let (pixels, metres) = error.unwrap_or((f64::NAN, f64::NAN));
    let outcome = match candidate.outcome {
        Outcome::Accepted => "accepted".to_owned(),
        Outcome::Refused(refusal) => format!("refused: {}", refusal.reason()),
    };
    format!(
        "{:22} score {:5.2} second {:5.2} NIS {:6.1} off {pixels:5.1} px {metres:5.2} m {outcome}{}",
        landmark.map_or("?", |l| &l.name),
        candidate.score,
        candidate.second_score,
        candidate.nis.unwrap_or(f64::NAN),
        if is_wrong { "  WRONG PLACE" } else { "" }
    )
}

/// Prints the refusals of frames and landmarks, counted by reason.
pub fn print_refusals(summary: &Summary) {
    let frames: usize = summary.frames_refused.values().sum();
    if frames + summary.frames_laid > 0 {
        let words = |key: &str| {
            let kind = RegistrationRefusal::ALL
                .into_iter()
                .find(|kind| kind.key() == key);
            kind.map_or("they could not be used", RegistrationRefusal::reason)
        };
        let all = frames + summary.frames_laid;
        println!("whole frames refused: {frames} of {all}");
        print_counts(&summary.frames_refused, words);
    }
    let looks: usize = summary.updates_refused.values().sum();
    if looks + summary.updates_accepted > 0 {
        let words = |key: &str| {
            let refusal = Refusal::ALL.into_iter().find(|r| r.key() == key);
            refusal.map_or("", Refusal::reason)
        };
        let all = looks + summary.updates_accepted;
        println!("looks at landmarks refused: {looks} of {all}");
        print_counts(&summary.updates_refused, words);
    }
}

/// Prints a line for each reason, the most frequent first.
fn print_counts(counts: &BTreeMap<String, usize>, words: impl Fn(&str) -> &'static str) {
    let mut counts: Vec<(&String, &usize)> = counts.iter().filter(|(_, n)| **n > 0).collect();
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    for (key, count) in counts {
        println!("{count:8}  {key}: {}", words(key));
    }
}
