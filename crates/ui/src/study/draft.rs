//! The plan that is written down, and what it would take to fly it.

use pilotage_core::mission::Mission;
use pilotage_jobs::ReadStudyPlan;
use pilotage_study::{DrawBy, SHIPPED_PLANS, StudyDesign, StudyPlan};
use serde_json::{Value, json};

/// Most flights of a study in the page: a minute or two.
pub const MOST_FLIGHTS: u64 = 2000;
/// Flights of each setting that can be chosen.
pub const DRAWS: std::ops::RangeInclusive<u64> = 10..=200;
/// Flights of each setting at first, of a plan that compares settings.
const USUAL_DRAWS: u64 = 40;

/// Number of flights of each setting that a plan is given once it is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum WantedDraws {
    /// That which its text says.
    AsWritten,
    /// As few as a page flies at once.
    Usual,
    /// So many.
    Count(u64),
}

/// Plan that is written down. A worker reads it: `plan` is what the text said when it was read last.
#[derive(Clone, Debug)]
pub struct StudyDraft {
    text: String,
    plan: Option<Result<StudyPlan, String>>,
    /// Sentences on what may surprise of the plan as it was read last.
    notes: Vec<String>,
    /// Draws that it gets once it is read; `None` where it is.
    awaited: Option<WantedDraws>,
    /// Number of the shipped plan that it is but for its flights; `None` of one's own.
    chosen: Option<usize>,
}

impl Default for StudyDraft {
    fn default() -> Self {
        let mut draft = Self {
            text: String::new(),
            plan: None,
            notes: Vec::new(),
            awaited: None,
            chosen: None,
        };
        draft.choose(0);
        draft
    }
}

impl StudyDraft {
    /// Takes a plan that comes with the program, with as few flights as a page flies at once.
    pub fn choose(&mut self, number: usize) {
        SHIPPED_PLANS[number % SHIPPED_PLANS.len()].clone_into(&mut self.text);
        self.awaited = Some(WantedDraws::Usual);
        self.chosen = Some(number);
    }

    /// Takes a plan as text.
    pub fn write(&mut self, text: String) {
        self.text = text;
        self.awaited = Some(WantedDraws::AsWritten);
        self.chosen = None;
    }

    /// The draft of an earlier visit, as [`StudyDraft::kept`] wrote it; a shipped plan as it is today, with as many
    /// flights as then.
    pub fn of_kept(saved: &str) -> Option<Self> {
        let saved: Value = serde_json::from_str(saved).ok()?;
        let text = saved["plan"].as_str()?.to_owned();
        let mut draft = Self::default();
        match saved["chosen"].as_u64() {
            Some(chosen) => {
                draft.choose(chosen as usize);
                if let Some(draws) = text.lines().find_map(draws_in) {
                    draft.awaited = Some(WantedDraws::Count(draws));
                }
            }
            None => draft.write(text),
        }
        Some(draft)
    }

    /// JSON of the draft, to be remembered between visits.
    pub fn kept(&self) -> String {
        let text = match self.awaited {
            Some(WantedDraws::Count(draws)) => &with_draws(&self.text, draws),
            _ => &self.text,
        };
        json!({ "plan": text, "chosen": self.chosen }).to_string()
    }

    /// Its text, TOML.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Whether its text names missions.
    pub fn flies_missions(&self) -> bool {
        self.text.contains("mission")
    }

    /// Has its text read again, for what it names is another.
    pub fn read_again(&mut self) {
        self.awaited = self.awaited.or(Some(WantedDraws::AsWritten));
    }

    /// Its text with the missions that it flies, for the terminal.
    pub fn packed(&self) -> String {
        let missions = self.plan().map(|plan| &plan.missions);
        let mut text = self.text.clone();
        if let Some(missions) = missions.filter(|it| !it.is_empty() && !text.contains("[missions"))
        {
            text.push_str("\n[missions]\n");
            for (name, mission) in missions.iter() {
                // A text of JSON may say an apostrophe in another way.
                let mission = mission.as_str().replace('\'', "\\u0027");
                let entry = [&quoted(name), " = '''\n", &mission, "'''\n"];
                text.extend(entry);
            }
        }
        text
    }

    /// The text that a worker has to read.
    pub fn unread(&self) -> Option<&str> {
        self.awaited.map(|_| self.text.as_str())
    }

    /// Takes what a worker read in the text.
    pub fn take(&mut self, read: Result<ReadStudyPlan, String>) {
        let wanted = self.awaited.take();
        self.notes.clear();
        self.plan = Some(read.map(|read| {
            self.notes = read.notes;
            StudyPlan::from(read.parts)
        }));
        let Some(Ok(plan)) = &self.plan else { return };
        match wanted {
            Some(WantedDraws::Usual) if plan.cells() > 1 => self.set_draws(USUAL_DRAWS),
            Some(WantedDraws::Usual) => self.set_draws(*DRAWS.end()),
            Some(WantedDraws::Count(draws)) => self.set_draws(draws),
            Some(WantedDraws::AsWritten) | None => {}
        }
    }

    /// The plan as it was read last, if it can be followed.
    pub fn plan(&self) -> Option<&StudyPlan> {
        self.plan.as_ref()?.as_ref().ok()
    }

    /// Sentences on what may surprise of the plan as it was read last.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The plan that the text is, once that is read and if it can be followed.
    pub fn ready(&self) -> Option<&StudyPlan> {
        self.plan().filter(|_| self.awaited.is_none())
    }

    /// Number of the shipped plan that it is but for its flights.
    pub fn chosen(&self) -> Option<usize> {
        self.chosen
    }

    /// Sets how often each setting is flown, or a little more where Sobol's points come in scrambles.
    pub fn set_draws(&mut self, draws: u64) {
        let Some(Ok(plan)) = &mut self.plan else {
            return;
        };
        let step = match plan.draw_by {
            DrawBy::Sobol => plan.scrambles.max(1),
            DrawBy::Random => 1,
        };
        let draws = draws.next_multiple_of(step);
        let text = with_draws(&self.text, draws);
        if text.lines().find_map(draws_in) == Some(draws) {
            (plan.draws, self.text) = (draws, text);
        }
    }

    /// Why the page does not fly it, if so, and what does.
    pub fn refusal(&self) -> Option<String> {
        let plan = match self.plan.as_ref()? {
            Ok(plan) => plan,
            Err(why) => return Some(why.clone()),
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
        let Some(plan) = self.plan() else { return 0.0 };
        let cells = plan.cells().min(MOST_FLIGHTS);
        let design = StudyDesign::new(plan.clone());
        let seconds = (0..cells).filter_map(|cell| Some(design.run(cell).ok()?.flight().lasts()));
        seconds.sum::<f64>() * plan.draws as f64
    }
}

/// A text in the quotation marks of TOML.
fn quoted(text: &str) -> String {
    Value::from(text).to_string()
}

/// Plan that compares the routes of a mission, in winds of up to 8 m/s from anywhere; `None` where it has none to fly.
pub fn plan_of_routes(mission: &Mission) -> Option<String> {
    let flown = mission
        .routes
        .iter()
        .filter(|route| route.way_points.len() > 1);
    let names: Vec<String> = flown.map(|route| quoted(&route.name)).collect();
    let routes = match &names[..] {
        [] => return None,
        [only] => format!("fixed.route = {only}"),
        names => format!("cross.route = [{}]", names.join(", ")),
    };
    Some(format!(
        "# Landmarks are found as the two lines below say, each alike. The navigator is that of the mission.\n\
         name = \"routes\"\n\
         question = \"How well is the place known along the routes of this mission, in any wind up to 8 m/s?\"\n\
         draws = {USUAL_DRAWS}\n\
         fixed.mission = {}\n\
         {routes}\n\
         fixed.recognised = 0.9 # share of days on which a landmark can be recognised\n\
         fixed.found = 0.7 # share of frames that find it then\n\
         fixed.step = 0.25\n\
         draw.wind-speed = {{ uniform = [0, 8] }}\n\
         draw.wind-from = {{ uniform = [0, 360] }}\n\
         measure = [\n\
         \x20 {{ of = \"error-rms\" }},\n\
         \x20 {{ of = \"error-max\", name = \"within 20 m all the time\", at_most = 20 }},\n\
         \x20 {{ of = \"inside-95-end\" }},\n\
         ]\n",
        quoted(&mission.name),
    ))
}

/// The number of draws that a line of a plan says.
fn draws_in(line: &str) -> Option<u64> {
    let rest = line.trim_start().strip_prefix("draws")?;
    let number = rest.trim_start().strip_prefix('=')?;
    number.split('#').next()?.trim().parse().ok()
}

/// The text of a plan with another number of draws.
pub fn with_draws(text: &str, draws: u64) -> String {
    let mut is_done = false;
    let lines = text.lines().map(|line| {
        if is_done || draws_in(line).is_none() {
            return line.to_owned();
        }
        is_done = true;
        format!("draws = {draws}")
    });
    lines.collect::<Vec<_>>().join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use pilotage_core::frames::{Altitude, AltitudeFrame, Geodetic, GroundPoint};
    use pilotage_core::mission::{Route, WayPoint};

    use super::*;

    /// The draft once a worker has read it.
    fn read(mut draft: StudyDraft) -> StudyDraft {
        let text = draft.unread().expect("something to read");
        let plan = StudyPlan::read(text).map_err(|why| why.to_string());
        draft.take(plan.map(Into::into));
        assert_eq!(draft.unread(), None);
        draft
    }

    fn shipped(number: usize) -> StudyDraft {
        let mut draft = StudyDraft::default();
        draft.choose(number);
        read(draft)
    }

    fn written(text: &str) -> StudyDraft {
        let mut draft = StudyDraft::default();
        draft.write(text.to_owned());
        read(draft)
    }

    #[test]
    fn the_routes_of_a_mission_become_a_plan_that_can_be_saved_with_the_mission_in_it() {
        let altitude = Altitude::new(120.0, AltitudeFrame::AboveGround);
        let route = |name: &str, ends: &[f64]| Route {
            name: name.to_owned(),
            way_points: (ends.iter())
                .map(|north| WayPoint::new(GroundPoint::new(*north, 0.0), altitude))
                .collect(),
            ..Route::default()
        };
        let mut mission = Mission::new("Bob's \"mill\"", Geodetic::from_degrees(47.0, 8.0, 400.0));
        assert_eq!(plan_of_routes(&mission), None);
        mission.routes = vec![route("There", &[0.0, 500.0]), route("Nowhere", &[0.0])];
        for (more, runs) in [(None, 40), (Some(route("It's \\ back", &[500.0, 0.0])), 80)] {
            mission.routes.extend(more);
            let text = plan_of_routes(&mission).unwrap();
            let read = |text: &str| StudyPlan::read_with(text, &mut |_| Ok(mission.clone()));
            let mut draft = StudyDraft::default();
            draft.write(text.clone());
            let plan = read(&text).map_err(|why| why.to_string());
            draft.take(plan.map(Into::into));
            assert_eq!(draft.refusal(), None);
            // Neither a landmark nor a camera.
            assert_eq!(draft.notes().len(), 2);
            let plan = draft.plan().unwrap();
            assert_eq!(plan.runs(), runs);
            // The terminal reads the same out of one file.
            let packed = StudyPlan::read(&draft.packed()).unwrap();
            assert_eq!(packed.cross, plan.cross);
            let missions = |plan: &StudyPlan| {
                let all = plan.missions.iter();
                all.map(|(name, text)| (name.clone(), text.read().unwrap()))
                    .collect::<Vec<_>>()
            };
            assert_eq!(missions(&packed), missions(plan));
        }
    }

    #[test]
    fn every_shipped_plan_is_small_enough_for_the_page_with_as_many_flights_as_can_be_chosen() {
        for (number, text) in SHIPPED_PLANS.iter().enumerate() {
            let mut draft = shipped(number);
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
        let wrong = written(&text.replace("wind-speed", "wind-sped"));
        let why = wrong.refusal().unwrap();
        assert!(why.contains("cross.wind-sped"), "{why}");
        let broken = written(&text.replace("draws = ", "draws "));
        let why = broken.refusal().unwrap();
        assert!(why.contains("line 5"), "{why}");
        let large = written(&with_draws(text, 1000));
        let why = large.refusal().unwrap();
        assert!(
            why.contains("6000 flights") && why.contains("pilotage study wind.toml"),
            "{why}"
        );
    }

    #[test]
    fn a_plan_of_ones_own_and_a_number_of_flights_come_back_at_the_next_visit() {
        let own = written(&SHIPPED_PLANS[0].replace("[0, 2,", "[1, 3,"));
        let back = read(StudyDraft::of_kept(&own.kept()).unwrap());
        assert_eq!((back.text(), back.chosen()), (own.text(), None));
        let broken = written("draws 7");
        let back = read(StudyDraft::of_kept(&broken.kept()).unwrap());
        assert_eq!(back.refusal(), broken.refusal());
        let mut chosen = shipped(2);
        chosen.set_draws(70);
        let unread = StudyDraft::of_kept(&chosen.kept()).unwrap();
        assert_eq!(
            unread.kept(),
            chosen.kept(),
            "kept again before it was read"
        );
        let back = read(unread);
        assert_eq!((back.text(), back.chosen()), (chosen.text(), Some(2)));
        assert!(StudyDraft::of_kept("{}").is_none() && StudyDraft::of_kept("").is_none());
    }

    #[test]
    fn the_time_in_the_air_is_that_of_all_flights() {
        let draft = shipped(0);
        assert_eq!(draft.flown_seconds(), 60.0 * 6.0 * 40.0);
    }

    #[test]
    fn what_was_read_before_stands_until_the_text_is_read_and_is_not_flown() {
        let mut draft = shipped(0);
        let flights = draft.plan().map(StudyPlan::runs);
        draft.write("draws 7".to_owned());
        assert_eq!(
            (draft.plan().map(StudyPlan::runs), draft.ready()),
            (flights, None)
        );
        let draft = read(draft);
        assert!(draft.plan().is_none() && draft.refusal().is_some());
    }
}
