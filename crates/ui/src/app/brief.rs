//! The mission brief: asked for, and printed once its pictures are there.

use pilotage_core::frames::GroundPoint;

use super::App;
use crate::host::Host;
use crate::plan::flown::{camera, cruise};
use crate::plan::legs::legs;
use crate::plan::route_tab::assumptions;
use crate::plan::{
    BRIEF_STYLE, BriefLandmark, BriefScene, MOST_LANDMARKS, brief, brief_area, energy_left,
};
use pilotage_jobs::{BriefOrder, BriefPictures, Job, JobEvent};

impl App {
    /// Has the pictures of the brief made.
    pub(super) fn ask_for_brief(&mut self, host: &mut dyn Host) {
        let Some(route) = self.documents.selected_route() else {
            let text = "Draw a route in the Plan workspace first.";
            self.toasts.note(host.now(), "No route to print", text);
            return;
        };
        let (landmarks, more) = self.brief_landmarks();
        let places = route.way_points.iter().map(|w| w.position);
        let boxes = landmarks.iter().flat_map(|l| {
            let b = l.landmark.bounds;
            [
                GroundPoint::new(b.north, b.west),
                GroundPoint::new(b.south, b.east),
            ]
        });
        let Some(area) = brief_area(places.chain(boxes)) else {
            return;
        };
        let order = BriefOrder {
            map: self.documents.map_source.clone(),
            area,
            boxes: landmarks.iter().map(|l| l.landmark.bounds).collect(),
        };
        if let Some((old, ..)) = self.jobs.brief.take() {
            host.cancel(old);
        }
        let id = host.start(Job::Brief(order));
        self.jobs.brief = Some((id, area, landmarks, more));
        let text = "The browser's print opens as soon as its pictures are drawn.";
        self.toasts
            .note(host.now(), "Preparing the mission brief", text);
    }

    /// The landmarks that the prediction finds along the route, in that order; without a prediction
    /// those that are on. Beside them the number of those that are too many.
    fn brief_landmarks(&self) -> (Vec<BriefLandmark>, usize) {
        let planner = &self.views.planner;
        let of = |landmark: &pilotage_core::landmark::Landmark| {
            let found = match planner.assessments.of(landmark) {
                Some(measured) => {
                    let percent = 100.0 * measured.last.expected.probability();
                    format!("found {percent:.0} % of the time")
                }
                None => "not measured".to_owned(),
            };
            BriefLandmark {
                landmark: landmark.clone(),
                found,
            }
        };
        let Some(shown) = planner.forecast.shown() else {
            let landmarks = self.documents.mission.landmarks.iter();
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
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let landmarks = order.iter().take(MOST_LANDMARKS);
        let landmarks = landmarks.map(|(_, index)| of(&shown.order.landmarks[*index].0));
        let more = order.len().saturating_sub(MOST_LANDMARKS);
        (landmarks.collect(), more)
    }

    /// Takes what the worker says of the brief.
    pub(super) fn brief_event(&mut self, host: &mut dyn Host, event: JobEvent) {
        match event {
            JobEvent::BriefPictures(pictures) => self.print_brief(host, &pictures),
            JobEvent::Failed(why) => {
                self.jobs.brief = None;
                let title = "The mission brief cannot be drawn";
                self.toasts.trouble(host.now(), title, why);
            }
            JobEvent::Finished | JobEvent::Cancelled => self.jobs.brief = None,
            _ => {}
        }
    }

    fn print_brief(&mut self, host: &mut dyn Host, pictures: &BriefPictures) {
        let Some((_, area, landmarks, more_landmarks)) = self.jobs.brief.take() else {
            return;
        };
        let documents = &self.documents;
        let planner = &self.views.planner;
        let Some(route) = documents.selected_route() else {
            return;
        };
        let wind = planner.wind(documents);
        let legs = legs(route, cruise(), &wind);
        let (speed, speed_unit) = self.view.units.speed();
        let camera = camera(documents);
        let across = 2.0 * (0.5 * camera.width as f64 / camera.focal).atan();
        let mut assumed = vec![
            format!(
                "Wind from {:03.0}° with {:.1} {speed_unit}.",
                wind.from.to_degrees().rem_euclid(360.0),
                wind.speed * speed
            ),
            format!(
                "Camera of {} × {} pixels, {:.0}° across.",
                camera.width,
                camera.height,
                across.to_degrees()
            ),
        ];
        assumed.extend(assumptions(planner, documents, route, self.view.units));
        let scene = BriefScene {
            mission: &documents.mission.name,
            route,
            left: energy_left(&legs, &planner.preferences),
            legs: &legs,
            prediction: planner.forecast.shown().map(|s| &s.prediction),
            limit: planner.preferences.limit,
            assumptions: assumed,
            landmarks: &landmarks,
            more_landmarks,
            attribution: documents.attribution().unwrap_or_default(),
            area,
            pictures,
            units: self.view.units,
        };
        host.print(BRIEF_STYLE, &brief(&scene));
    }
}
