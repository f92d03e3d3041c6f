//! Finding a route: its two ends, its budget, no-fly areas, and what was found.

use pilotage_core::frames::units::GRAVITY;
use pilotage_core::frames::{Altitude, AltitudeFrame, AltitudeReference, GroundPoint, GroundRect};
use pilotage_core::mission::NoFlyZone;
use pilotage_core::plan::{Aim, BudgetOf, Turns};
use pilotage_core::simulate::GuidanceSettings;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::command::AreaChange;
use super::heat::HeatOf;
use super::planner::{Planner, cruise, ground_down, height, line, usual_altitude};
use super::routes::Step;
use super::words::Outlook;
use crate::documents::Documents;
use crate::host::Host;
use crate::jobs::{
    FindOrder, Foreseen, FoundPlan, HighGround, Job, JobEvent, JobId, PredictionOrder,
};

/// What is looked for; remembered between visits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FindPreferences {
    /// Greatest cost over that of the shortest route.
    pub budget: f64,
    /// What the cost is.
    pub budget_of: BudgetOf,
    /// What is to be least.
    pub aim: Aim,
    /// What it shall lead over.
    pub over: HeatOf,
    /// Distance that is kept from no-fly areas, metres.
    pub clearance: f64,
    /// Height that is kept above the ground of the elevation model, metres.
    pub ground_clearance: f64,
}

impl Default for FindPreferences {
    fn default() -> Self {
        Self {
            budget: 1.3,
            budget_of: BudgetOf::default(),
            aim: Aim::default(),
            over: HeatOf::default(),
            clearance: 50.0,
            ground_clearance: 60.0,
        }
    }
}

/// What the next click on the map says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FindPick {
    /// Nothing.
    #[default]
    Nothing,
    /// Where the route begins.
    From,
    /// Where it ends.
    To,
    /// The next corner of a no-fly area.
    Area,
}

/// What people can ask of the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FindCommand {
    /// Choose both ends on the map, one after the other.
    Begin,
    /// Say what the next click means.
    Pick(FindPick),
    /// A click on the map.
    Click(GroundPoint),
    /// Finish the no-fly area that is being drawn.
    FinishArea,
    /// Look for other things.
    Set(FindPreferences),
    /// Search.
    Start,
    /// Stop searching.
    Stop,
    /// Make a route of what was found.
    Accept,
    /// Forget what was found.
    Dismiss,
    /// Delete a no-fly area, by its number.
    DeleteArea(usize),
}

/// One route of the comparison in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compared {
    /// Length over the way-points, metres.
    pub length: f64,
    /// How long it takes with its turns, seconds.
    pub time: f64,
    /// Largest predicted standard deviation, metres.
    pub worst: f64,
    /// Its mean along the route, metres.
    pub mean: f64,
}

impl Compared {
    /// What a route comes to; `None` without a prediction.
    pub fn of(foreseen: &Foreseen) -> Option<Self> {
        let samples = &foreseen.prediction.samples;
        let outlook = Outlook::of(&foreseen.prediction)?;
        let sum: f64 = samples.iter().map(|s| s.corridor.sigma_major).sum();
        Some(Self {
            length: foreseen.route.length,
            time: samples.last()?.time,
            worst: outlook.sigma,
            mean: sum / samples.len() as f64,
        })
    }
}

/// The search.
#[derive(Debug, Default)]
pub struct Finder {
    /// Where the route begins.
    pub from: Option<GroundPoint>,
    /// Where it ends.
    pub to: Option<GroundPoint>,
    /// What the next click says.
    pub pick: FindPick,
    /// Corners of the no-fly area that is being drawn.
    pub corners: Vec<GroundPoint>,
    /// What was found.
    pub found: Option<Box<FoundPlan>>,
    /// Why nothing was found.
    pub trouble: Option<String>,
    asked: Option<JobId>,
    progress: (f32, String),
    wants: Option<bool>,
}

impl Finder {
    /// How far the search is, 0 to 1, and in words.
    pub fn under_way(&self) -> Option<(f32, &str)> {
        self.asked?;
        Some((self.progress.0, self.progress.1.as_str()))
    }

    /// Starts or stops what is wanted.
    pub fn work(&mut self, order: impl FnOnce() -> Option<FindOrder>, host: &mut dyn Host) {
        let Some(start) = self.wants.take() else {
            return;
        };
        if let Some(id) = self.asked.take() {
            host.cancel(id);
        }
        if !start {
            return;
        }
        self.trouble = None;
        self.found = None;
        if let Some(order) = order() {
            self.progress = (0.0, "Waiting for a worker".to_owned());
            self.asked = Some(host.start(Job::Find(Box::new(order))));
        } else {
            let why = "choose A and B on the map first, and wait until the map is there.";
            self.trouble = Some(why.to_owned());
        }
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(&mut self, id: JobId, event: &JobEvent) -> bool {
        if self.asked != Some(id) {
            return false;
        }
        match event {
            JobEvent::Progress(fraction, words) => self.progress = (*fraction, words.clone()),
            JobEvent::FoundPlan(plan) => self.found = Some(plan.clone()),
            JobEvent::Failed(why) => {
                self.trouble = Some(why.clone());
                self.asked = None;
            }
            JobEvent::Finished | JobEvent::Cancelled => self.asked = None,
            _ => {}
        }
        true
    }

    fn click(&mut self, at: GroundPoint) {
        match self.pick {
            FindPick::Nothing => {}
            FindPick::From => {
                self.from = Some(at);
                self.found = None;
                self.pick = if self.to.is_none() {
                    FindPick::To
                } else {
                    FindPick::Nothing
                };
            }
            FindPick::To => {
                self.to = Some(at);
                self.found = None;
                self.pick = FindPick::Nothing;
            }
            FindPick::Area => self.corners.push(at),
        }
    }
}

impl Planner {
    /// Which route to find; `None` while an end or the map is missing.
    pub fn find_order(&self, documents: &Documents) -> Option<FindOrder> {
        let mission = &documents.mission;
        let (from, to) = (self.finder.from?, self.finder.to?);
        let wanted = &self.preferences.find;
        let height = height(
            &line(&[from, to], self.found_altitude(documents)),
            documents,
        );
        let mut field = self.field_order(documents, wanted.over, height)?;
        if wanted.over == HeatOf::Map {
            // No farther around than a route within a usual budget leads.
            let far = 0.5 * from.distance(&to) + height;
            let near = GroundRect::around([from, to])?.grown(far);
            if !near.overlaps(&field.region) {
                return None;
            }
            field.region = GroundRect {
                south: near.south.max(field.region.south),
                north: near.north.min(field.region.north),
                west: near.west.max(field.region.west),
                east: near.east.min(field.region.east),
            };
        }
        let wind = self.wind(documents);
        let bank = self.preferences.bank;
        let guidance = GuidanceSettings::within(bank);
        let speed = cruise() + wind.speed;
        let enabled = mission.landmarks.iter().filter(|l| l.enabled);
        Some(FindOrder {
            from,
            to,
            flight: PredictionOrder {
                way_points: vec![from, to],
                height: field.view.height,
                targets: Vec::new(),
                airspeed: None,
                bank: Some(bank),
                wind,
                camera: field.view.camera.clone(),
                ground_down: ground_down(documents),
                navigator: mission.navigator.clone(),
                landmarks: enabled
                    .map(|l| (l.clone(), self.assessments.expected(l)))
                    .collect(),
                worlds: 0,
            },
            field,
            no_fly: mission.no_fly.iter().map(|z| z.corners.clone()).collect(),
            clearance: wanted.clearance,
            high_ground: self.highest_ground(documents).and_then(|highest| {
                Some(HighGround {
                    heights: documents.terrain.heights()?.as_ref().clone(),
                    highest,
                })
            }),
            turns: Turns {
                radius: speed * speed / (GRAVITY * guidance.planned_bank.tan()),
                roll_in: speed * guidance.roll_in,
            },
            budget: wanted.budget,
            budget_of: wanted.budget_of,
            aim: wanted.aim,
        })
    }

    /// The altitude of a route that is found: that of the selected route.
    pub fn found_altitude(&self, documents: &Documents) -> Altitude {
        let route = self.selected(&documents.mission);
        let first = route.and_then(|r| r.way_points.first());
        first.map_or_else(|| usual_altitude(documents), |w| w.altitude)
    }

    /// Height above which ground is flown around, metres above the datum of the elevation model, where
    /// one is open and A is chosen.
    pub fn highest_ground(&self, documents: &Documents) -> Option<f64> {
        let altitude = self.found_altitude(documents);
        let clearance = self.preferences.find.ground_clearance;
        documents.terrain.heights()?;
        let reference = AltitudeReference {
            take_off: documents.relief().at(&self.finder.from?),
            ground: 0.0,
        };
        match altitude.frame {
            // It follows the ground; too low is too low everywhere.
            AltitudeFrame::AboveGround if altitude.metres >= clearance => None,
            AltitudeFrame::AboveGround => Some(f64::NEG_INFINITY),
            AltitudeFrame::Amsl | AltitudeFrame::AboveTakeOff => {
                Some(altitude.amsl(&reference) - clearance)
            }
        }
    }

    /// Carries a command out; true if the mission changed.
    pub fn find_command(&mut self, command: FindCommand, documents: &mut Documents) -> bool {
        let finder = &mut self.finder;
        match command {
            FindCommand::Begin => {
                (finder.from, finder.to, finder.found) = (None, None, None);
                finder.trouble = None;
                finder.pick = FindPick::From;
            }
            FindCommand::Pick(pick) => {
                finder.pick = if finder.pick == pick {
                    FindPick::Nothing
                } else {
                    pick
                };
                finder.corners.clear();
            }
            FindCommand::Click(at) => finder.click(at),
            FindCommand::FinishArea => {
                let corners = std::mem::take(&mut finder.corners);
                finder.pick = FindPick::Nothing;
                if corners.len() >= 3 {
                    finder.found = None;
                    documents.add_no_fly(corners);
                    return true;
                }
            }
            FindCommand::Set(preferences) => self.preferences.find = preferences,
            FindCommand::Start => finder.wants = Some(true),
            FindCommand::Stop => finder.wants = Some(false),
            FindCommand::Accept => {
                let Some(found) = finder.found.take() else {
                    return false;
                };
                let altitude = self.found_altitude(documents);
                let found = line(&found.surest.route.way_points, altitude);
                let id = documents.add_route(Some("Found route"), found.way_points);
                self.route = Some(id);
                self.way_point = None;
                self.tab = super::planner::PlanTab::Route;
                return true;
            }
            FindCommand::Dismiss => finder.found = None,
            FindCommand::DeleteArea(index) => {
                finder.found = None;
                return documents.delete_no_fly(index);
            }
        }
        false
    }
}

impl Planner {
    /// The heat map for journeys.
    pub fn heat_json(&self) -> Value {
        let heat = &self.preferences.heat;
        let field = self.heat.field();
        json!({
            "shown": heat.shown,
            "blind": heat.blind,
            "known": field.map(pilotage_core::plan::Localizability::known),
            "blind_share": field.and_then(|f| f.blind_share(super::heat::BLIND)),
            "complete": self.heat.is_complete(),
            "progress": self.heat.under_way().map(|(share, _)| share),
            "trouble": self.heat.trouble(),
        })
    }

    /// The search for journeys.
    pub fn find_json(&self) -> Value {
        let finder = &self.finder;
        let place = |p: GroundPoint| json!([p.north, p.east]);
        let of = |foreseen: &Foreseen| {
            Compared::of(foreseen).map(|c| {
                json!({
                    "length": c.length,
                    "time": c.time,
                    "worst": c.worst,
                    "mean": c.mean,
                    "way_points": foreseen.route.way_points.len(),
                })
            })
        };
        json!({
            "from": finder.from.map(place),
            "to": finder.to.map(place),
            "pick": format!("{:?}", finder.pick),
            "progress": finder.under_way().map(|(share, _)| share),
            "trouble": finder.trouble,
            "shortest": finder.found.as_ref().and_then(|f| of(&f.shortest)),
            "surest": finder.found.as_ref().and_then(|f| of(&f.surest)),
        })
    }
}

impl Documents {
    /// Adds an area that must not be flown over.
    pub fn add_no_fly(&mut self, corners: Vec<GroundPoint>) {
        self.history.remember(&self.mission);
        self.mission_edited = true;
        let number = self.mission.no_fly.len() + 1;
        self.mission.no_fly.push(NoFlyZone {
            name: format!("No-fly area {number}"),
            corners,
            ..NoFlyZone::default()
        });
    }

    /// Changes an area that must not be flown over.
    pub fn edit_no_fly(&mut self, index: usize, step: Step, change: AreaChange) {
        let Some(zone) = self.mission.no_fly.get(index) else {
            return;
        };
        let mut zone = zone.clone();
        match change {
            AreaChange::Name(name) => zone.name = name,
            AreaChange::Corner(corner, to) => {
                if let Some(place) = zone.corners.get_mut(corner) {
                    *place = to;
                }
            }
        }
        if zone != self.mission.no_fly[index] {
            self.history.begin_drag(&self.mission);
            self.mission.no_fly[index] = zone;
            self.mission_edited = true;
        }
        if step == Step::Whole {
            self.history.finish_drag(&self.mission);
        }
    }

    /// Deletes an area that must not be flown over; false if there is none of that number.
    pub fn delete_no_fly(&mut self, index: usize) -> bool {
        if index >= self.mission.no_fly.len() {
            return false;
        }
        self.history.remember(&self.mission);
        self.mission_edited = true;
        self.mission.no_fly.remove(index);
        true
    }
}
