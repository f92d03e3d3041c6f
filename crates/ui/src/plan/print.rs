//! The mission brief: asked for, and printed once its pictures are there.

use pilotage_core::frames::{GroundPoint, LocalFrame};
use pilotage_core::mission::Route;
use pilotage_core::sorting::sort;

use super::aircraft::energy_left;
use super::brief::{BriefScene, MOST_LANDMARKS, STYLE, brief, brief_area};
use super::emergency::{EmergencyScene, KnownLandmark, emergency, refuges};
use super::flown::{camera, way_back};
use super::legs::legs;
use super::planner::Planner;
use super::printing::{AskedPictures, BriefLandmark, Printing};
use super::route_tab::{assumptions, misled, stopped, wind_words};
use crate::documents::Documents;
use crate::feature::FeatureContext;
use crate::shell::CommandLack;
use crate::units::Units;
use pilotage_core::plan::cruise;
use pilotage_jobs::{BriefOrder, BriefPictures, Job, JobEvent, JobId};

/// Lack of a route, which a brief is of.
pub(super) const NO_ROUTE: CommandLack = CommandLack {
    what: "No route to print",
    advice: "Draw a route in the Plan workspace first.",
};

impl Planner {
    /// Has the brief of the selected route printed.
    pub(super) fn ask_for_brief(&mut self, context: &mut FeatureContext<'_>) {
        let Some(route) = context.documents.mission.selected_route() else {
            context.note(NO_ROUTE.what, NO_ROUTE.advice);
            return;
        };
        let route = route.id;
        self.forget_brief(context);
        self.printing = Some(Printing { route, asked: None });
        let text =
            "The browser's print opens as soon as its prediction and its pictures are there.";
        context.note("Preparing the mission brief", text);
    }

    fn forget_brief(&mut self, context: &mut FeatureContext<'_>) {
        let asked = self.printing.take().and_then(|old| old.asked);
        if let Some(asked) = asked {
            context.cancel(asked.job);
        }
    }

    /// Whether as much is predicted of the selected route as ever will be.
    fn is_foreseen(&self, documents: &Documents) -> bool {
        let may_be = self.forecast.trouble().is_none() && self.order(documents).is_some();
        !may_be || self.forecast.is_fine()
    }

    /// Has the pictures of the brief made once its route is predicted; gives it up where another route is selected.
    pub(super) fn work_on_brief(&mut self, context: &mut FeatureContext<'_>) {
        let Some(printing) = &self.printing else {
            return;
        };
        let of = printing.route;
        let is_asked = printing.asked.is_some();
        let route = context.documents.mission.selected_route();
        if route.is_none_or(|route| route.id != of) {
            self.forget_brief(context);
            let text = "Another route was selected before it was ready. Print the brief again.";
            context.note("The mission brief is not printed", text);
        } else if !is_asked && self.is_foreseen(context.documents) {
            let asked = self.ask_for_pictures(context);
            self.printing = asked.map(|asked| Printing {
                route: of,
                asked: Some(asked),
            });
        }
    }

    fn ask_for_pictures(&self, context: &mut FeatureContext<'_>) -> Option<AskedPictures> {
        let documents = &*context.documents;
        let route = documents.mission.selected_route()?.clone();
        let (landmarks, more) = self.brief_landmarks(documents);
        let rally = documents.mission.rally.iter().map(|point| point.position);
        let home = way_back(&route, documents).map(|[_, home]| home);
        let places = route.way_points.iter().map(|w| w.position);
        let places = places.chain(home).chain(rally);
        let boxes = landmarks.iter().flat_map(|l| {
            let b = l.landmark.bounds;
            [
                GroundPoint::new(b.north, b.west),
                GroundPoint::new(b.south, b.east),
            ]
        });
        let area = brief_area(places.chain(boxes))?;
        let order = BriefOrder {
            map: documents.map.source.clone(),
            area,
            boxes: landmarks.iter().map(|l| l.landmark.bounds).collect(),
        };
        Some(AskedPictures {
            order: self.order(documents),
            route,
            map: documents.map.source.clone(),
            job: context.start(Job::Brief(order)),
            area,
            landmarks,
            more,
        })
    }

    /// The page for emergencies; none without a place to land at.
    fn emergency_page(&self, route: &Route, documents: &Documents, units: Units) -> Option<String> {
        let mission = &documents.mission;
        let refuges = refuges(mission, route, units);
        let enabled = mission.landmarks.iter().filter(|l| l.enabled);
        let known = enabled.map(|landmark| {
            let measured = self.assessments.of(landmark);
            KnownLandmark {
                landmark,
                found: measured.map(|it| it.last.expected.probability()),
            }
        });
        let scene = EmergencyScene {
            mission: &mission.name,
            route,
            way_back: way_back(route, documents),
            frame: documents.world_origin().map(LocalFrame::new),
            refuges: &refuges,
            landmarks: &known.collect::<Vec<_>>(),
            units,
        };
        (!refuges.is_empty()).then(|| emergency(&scene))
    }

    /// The landmarks that the prediction finds along the route, in that order; without a prediction
    /// those that are on. Beside them the number of those that are too many.
    fn brief_landmarks(&self, documents: &Documents) -> (Vec<BriefLandmark>, usize) {
        let of = |landmark: &pilotage_core::landmark::Landmark| {
            let found = match self.assessments.of(landmark) {
                Some(measured) => {
                    let percent = 100.0 * measured.last.expected.probability();
                    format!("found in {percent:.0} % of pictures")
                }
                None => "not tested".to_owned(),
            };
            BriefLandmark {
                landmark: landmark.clone(),
                found,
            }
        };
        let Some(shown) = self.forecast.shown() else {
            let landmarks = documents.mission.landmarks.iter();
            let on: Vec<_> = landmarks.filter(|l| l.enabled).collect();
            let more = on.len().saturating_sub(MOST_LANDMARKS);
            let shown = on.into_iter().take(MOST_LANDMARKS);
            return (shown.map(of).collect(), more);
        };
        let mut order: Vec<(f64, usize)> = (0..shown.order.landmarks.len())
            .filter_map(|index| {
                let samples = shown.prediction.samples.iter();
                let likely = |s: &&pilotage_core::plan::PredictionSample| {
                    s.detection.get(index).copied().unwrap_or(0.0)
                };
                let best = samples.max_by(|a, b| likely(a).total_cmp(&likely(b)))?;
                (likely(&best) > 0.02).then_some((best.distance, index))
            })
            .collect();
        sort(&mut order, &|a, b| a.0.total_cmp(&b.0));
        let landmarks = order.iter().take(MOST_LANDMARKS);
        let landmarks = landmarks.filter_map(|(_, index)| {
            let id = shown.order.landmarks[*index].0.id;
            documents.mission.landmark(id).map(of)
        });
        let more = order.len().saturating_sub(MOST_LANDMARKS);
        (landmarks.collect(), more)
    }

    /// Takes what the worker says of the brief; false if it is about something else.
    pub(super) fn brief_event(
        &mut self,
        id: JobId,
        event: &JobEvent,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let is_it = |asked: &mut AskedPictures| asked.job == id;
        let Some(printing) = &mut self.printing else {
            return false;
        };
        let Some(asked) = printing.asked.take_if(is_it) else {
            return false;
        };
        match event {
            JobEvent::BriefPictures(pictures) => {
                context.wait_no_more(id);
                let documents = &*context.documents;
                let is_of_now = documents.mission.selected_route() == Some(&asked.route)
                    && documents.map.source == asked.map
                    && self.order(documents) == asked.order
                    && self.is_foreseen(documents);
                // Where the plan is another one since, the pictures are made anew.
                if is_of_now {
                    self.printing = None;
                    self.print_brief(&asked, pictures, context);
                }
            }
            JobEvent::Failed(why) => {
                self.printing = None;
                context.trouble("The mission brief cannot be drawn", why.as_str());
            }
            JobEvent::Finished | JobEvent::Cancelled => self.printing = None,
            JobEvent::Progress(..) => printing.asked = Some(asked),
            _ => {
                printing.asked = Some(asked);
                return false;
            }
        }
        true
    }

    fn print_brief(
        &self,
        asked: &AskedPictures,
        pictures: &BriefPictures,
        context: &mut FeatureContext<'_>,
    ) {
        let documents = &*context.documents;
        let units = context.view.units;
        let route = &asked.route;
        let wind = self.wind(documents);
        let way_back = way_back(route, documents);
        let legs = legs(route, way_back, (cruise(), self.preferences.bank), &wind);
        let (speed, speed_unit) = units.speed();
        let camera = camera(documents);
        let across = camera.horizontal_fov();
        let cruise_words = format!(
            "Aircraft: cruise at {:.1} {speed_unit}, bank up to {:.0}°.",
            cruise() * speed,
            self.preferences.bank.to_degrees()
        );
        let mut assumed = vec![
            cruise_words,
            wind_words(self, documents, units),
            format!(
                "Camera of {} × {} pixels, {:.0}° across.",
                camera.width,
                camera.height,
                across.to_degrees()
            ),
        ];
        assumed.extend(assumptions(self, documents, route, units));
        let mut warnings = self.no_fly_sentences(units);
        warnings.extend(stopped(self).map(str::to_owned));
        warnings.extend(misled(self, documents));
        let scene = BriefScene {
            mission: &documents.mission.name,
            route,
            bank: self.preferences.bank,
            left: energy_left(&legs, &self.preferences),
            legs: &legs,
            way_back,
            rally: &documents.mission.rally,
            emergency: self.emergency_page(route, documents, units),
            frame: documents.world_origin().map(LocalFrame::new),
            prediction: self.forecast.shown().map(|s| &s.prediction),
            limit: self.preferences.limit,
            assumptions: assumed,
            warnings,
            no_fly: &documents.mission.no_fly,
            landmarks: &asked.landmarks,
            more_landmarks: asked.more,
            attribution: documents.map.attribution().unwrap_or_default(),
            area: asked.area,
            pictures,
            units,
        };
        context.host.print(STYLE, &brief(&scene));
    }
}
