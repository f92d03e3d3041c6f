//! The plan that is written down, and what it would take to fly it.

use pilotage_core::text::capitalised;
use pilotage_study::{DrawBy, SHIPPED_PLANS, StudyDesign, StudyError, StudyPlan};
use serde_json::{Value, json};

/// Most flights of a study in the page: a minute or two.
pub const MOST_FLIGHTS: u64 = 2000;
/// Flights of each setting that can be chosen.
pub const DRAWS: std::ops::RangeInclusive<u64> = 10..=200;
/// Flights of each setting at first, of a plan that compares settings.
const USUAL_DRAWS: u64 = 40;

/// Plan that is written down.
#[derive(Clone, Debug)]
pub struct StudyDraft {
    text: String,
    plan: Result<StudyPlan, String>,
    /// Number of the shipped plan that it is but for its flights; `None` of one's own.
    chosen: Option<usize>,
}

impl Default for StudyDraft {
    fn default() -> Self {
        Self::shipped(0)
    }
}

impl StudyDraft {
    /// A plan that comes with the program, with as few flights as a page flies at once.
    pub fn shipped(number: usize) -> Self {
        let text = SHIPPED_PLANS[number % SHIPPED_PLANS.len()];
        let mut draft = Self::written(text.to_owned());
        draft.chosen = Some(number);
        let cells = draft.plan.as_ref().map_or(1, StudyPlan::cells);
        draft.set_draws(if cells > 1 { USUAL_DRAWS } else { *DRAWS.end() });
        draft
    }

    /// A plan as text.
    pub fn written(text: String) -> Self {
        Self {
            plan: StudyPlan::read(&text).map_err(|why| match why {
                StudyError::NoPlan(_) => capitalised(&why.to_string()),
                StudyError::Plan { .. } => format!("In the plan, {why}"),
            }),
            text,
            chosen: None,
        }
    }

    /// The draft of an earlier visit, as [`StudyDraft::kept`] wrote it; a shipped plan as it is today, with as many
    /// flights as then.
    pub fn of_kept(saved: &str) -> Option<Self> {
        let saved: Value = serde_json::from_str(saved).ok()?;
        let written = Self::written(saved["plan"].as_str()?.to_owned());
        let Some(chosen) = saved["chosen"].as_u64() else {
            return Some(written);
        };
        let mut draft = Self::shipped(chosen as usize);
        if let Ok(plan) = written.plan() {
            draft.set_draws(plan.draws);
        }
        Some(draft)
    }

    /// JSON of the draft, to be remembered between visits.
    pub fn kept(&self) -> String {
        json!({ "plan": self.text, "chosen": self.chosen }).to_string()
    }

    /// Its text, TOML.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The plan, or why it cannot be followed.
    pub fn plan(&self) -> Result<&StudyPlan, &str> {
        self.plan.as_ref().map_err(String::as_str)
    }

    /// Number of the shipped plan that it is but for its flights.
    pub fn chosen(&self) -> Option<usize> {
        self.chosen
    }

    /// Sets how often each setting is flown, or a little more where Sobol's points come in scrambles.
    pub fn set_draws(&mut self, draws: u64) {
        let step = match &self.plan {
            Ok(plan) if plan.draw_by == DrawBy::Sobol => plan.scrambles.max(1),
            _ => 1,
        };
        let text = with_draws(&self.text, draws.next_multiple_of(step));
        *self = Self {
            chosen: self.chosen,
            ..Self::written(text)
        };
    }

    /// Why the page does not fly it, if so, and what does.
    pub fn refusal(&self) -> Option<String> {
        let plan = match self.plan() {
            Ok(plan) => plan,
            Err(why) => return Some(why.to_owned()),
        };
        let flights = plan.runs();
        (flights > MOST_FLIGHTS).then(|| {
            format!(
                "These are {flights} flights; the page flies up to {MOST_FLIGHTS}. Fly fewer of each setting, or save the \
                 plan and fly it on the terminal: pilotage study {}.toml",
                plan.name
            )
        })
    }

    /// Seconds of flight in all.
    pub fn flown_seconds(&self) -> f64 {
        let Ok(plan) = self.plan() else { return 0.0 };
        let cells = plan.cells().min(MOST_FLIGHTS);
        let design = StudyDesign::new(plan.clone());
        let seconds = (0..cells).filter_map(|cell| Some(design.run(cell).ok()?.settings.seconds));
        seconds.sum::<f64>() * plan.draws as f64
    }
}

/// The text of a plan with another number of draws.
fn with_draws(text: &str, draws: u64) -> String {
    let is_number = |line: &str| {
        let rest = line.trim_start().strip_prefix("draws");
        rest.is_some_and(|rest| rest.trim_start().starts_with('='))
    };
    let mut is_done = false;
    let lines = text.lines().map(|line| {
        if is_done || !is_number(line) {
            return line.to_owned();
        }
        is_done = true;
        format!("draws = {draws}")
    });
    lines.collect::<Vec<_>>().join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shipped_plan_is_small_enough_for_the_page_with_as_many_flights_as_can_be_chosen() {
        for (number, text) in SHIPPED_PLANS.iter().enumerate() {
            let mut draft = StudyDraft::shipped(number);
            assert_eq!(draft.refusal(), None);
            draft.set_draws(*DRAWS.end());
            assert_eq!(draft.refusal(), None, "{}", draft.text());
            let draws = draft.plan().unwrap().draws;
            assert!((200..=208).contains(&draws), "{draws}");
            assert_eq!(draft.chosen(), Some(number));
            // Nothing else of it changes.
            let lines = |text: &str| text.lines().map(str::to_owned).collect::<Vec<_>>();
            let (own, shipped) = (lines(draft.text()), lines(text));
            let others = own.iter().zip(&shipped).filter(|(own, it)| own != it);
            assert!(others.count() <= 1);
            assert_eq!(own.len(), shipped.len());
        }
    }

    #[test]
    fn a_plan_that_makes_no_sense_is_refused_with_its_place_and_a_large_one_with_another_way() {
        let text = SHIPPED_PLANS[0];
        let wrong = StudyDraft::written(text.replace("wind-speed", "wind-sped"));
        let why = wrong.refusal().unwrap();
        assert!(why.contains("cross.wind-sped"), "{why}");
        let broken = StudyDraft::written(text.replace("draws = ", "draws "));
        let why = broken.refusal().unwrap();
        assert!(why.contains("line 5"), "{why}");
        let large = StudyDraft::written(with_draws(text, 1000));
        let why = large.refusal().unwrap();
        assert!(
            why.contains("6000 flights") && why.contains("pilotage study wind.toml"),
            "{why}"
        );
    }

    #[test]
    fn a_plan_of_ones_own_and_a_number_of_flights_come_back_at_the_next_visit() {
        let own = StudyDraft::written(SHIPPED_PLANS[0].replace("[0, 2,", "[1, 3,"));
        let back = StudyDraft::of_kept(&own.kept()).unwrap();
        assert_eq!((back.text(), back.chosen()), (own.text(), None));
        let broken = StudyDraft::written("draws 7".to_owned());
        let back = StudyDraft::of_kept(&broken.kept()).unwrap();
        assert_eq!(back.refusal(), broken.refusal());
        let mut shipped = StudyDraft::shipped(2);
        shipped.set_draws(70);
        let back = StudyDraft::of_kept(&shipped.kept()).unwrap();
        assert_eq!((back.text(), back.chosen()), (shipped.text(), Some(2)));
        assert!(StudyDraft::of_kept("{}").is_none() && StudyDraft::of_kept("").is_none());
    }

    #[test]
    fn the_time_in_the_air_is_that_of_all_flights() {
        let draft = StudyDraft::shipped(0);
        assert_eq!(draft.flown_seconds(), 60.0 * 6.0 * 40.0);
    }
}
