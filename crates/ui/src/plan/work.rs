//! Jobs of the plan: what it is missing is asked for, and what comes of it is taken.

use std::time::Duration;

use pilotage_core::landmark::Landmark;

use super::flown::flown_height;
use super::planner::Planner;
use crate::feature::FeatureContext;
use pilotage_jobs::{JobEvent, JobId, MapSource};

/// Time after which to look again whether what rests is to be computed.
const LOOK_AGAIN: Duration = Duration::from_millis(60);

impl Planner {
    /// Takes what a worker says about the plan; false if nothing of it waits for that.
    pub(super) fn receive(
        &mut self,
        id: JobId,
        event: &JobEvent,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        self.forecast.receive(id, event, context)
            || self.remedies.receive(id, event)
            || self.rehearsal.receive(id, event)
            || self.heat.receive(id, event)
            || self.finder.receive(id, event)
            || self.suggestions.receive(id, event)
            || self.untested.receive(id, event)
            || self.trainings.receive(id, event)
            || self.examined(id, event)
            || self.brief_event(id, event, context)
            || self.assessments.receive(id, event)
    }

    /// Asks the workers for what the plan is missing.
    pub(super) fn work(&mut self, context: &mut FeatureContext<'_>) {
        let mut waits = self.examine(context);
        self.settle(context.documents);
        if context.is_shown {
            let height = flown_height(context.documents);
            self.assessments.keep_to(context.documents, height);
        }
        self.assessments.work(context);
        self.tell_left(context);
        self.trainings.work(context);
        self.keep_detectors(context);
        self.check_incursions(context.documents);
        if context.is_shown {
            waits |= self.measure_drawn(context);
            self.measure_ahead(context);
            waits |= self.work_on_route(context);
        }
        if waits {
            context.egui.request_repaint_after(LOOK_AGAIN);
        }
    }

    /// Has a landmark measured that was drawn or changed; true if it must rest first.
    fn measure_drawn(&mut self, context: &FeatureContext<'_>) -> bool {
        let documents = &*context.documents;
        let landmarks = &documents.mission.landmarks;
        let (drawn, waits) = self.drawn.rested(landmarks, context.host.now());
        let drawn = drawn.and_then(|id| documents.mission.landmark(id));
        let drawn = drawn.filter(|it| it.enabled && self.assessments.of(it).is_none());
        if let Some(landmark) = drawn.filter(|_| documents.map.info.is_some()) {
            let order = self.assessment(landmark, documents);
            self.assessments.ask(vec![order]);
        }
        waits
    }

    /// Has landmarks measured for which nobody asked, while the workers have time: what is selected before what is in
    /// view before the others; and boxes at random, for what is not measured yet. Of a map of the web only what people look
    /// at is asked of its server.
    fn measure_ahead(&mut self, context: &mut FeatureContext<'_>) {
        let documents = &*context.documents;
        let may = self.preferences.tests_ahead && context.host.works_ahead();
        let of_web = matches!(documents.map.source, MapSource::Web(_));
        let matters = may || self.untested.is_known();
        let order = matters.then(|| self.untested_order(documents)).flatten();
        if let Some(order) = order.as_ref().filter(|_| !may) {
            self.untested.keep_to(order);
        }
        let order = order.filter(|_| may);
        let is_idle = order.is_some() && self.assessments.is_idle();
        let next = is_idle.then(|| {
            let view = context.map.rect().zip(context.map.screen_from_world());
            let seen = view.map(|(rect, transform)| transform.visible(rect));
            let rank = |it: &&Landmark| {
                let is_selected = *context.selection == Some(it.id);
                let is_seen = seen.is_some_and(|seen| seen.overlaps(&it.bounds));
                (!is_selected, !is_seen)
            };
            let untested = self.untested_landmarks(documents);
            let fit = untested.filter(|it| self.assessments.trouble(it).is_none());
            let next = fit.min_by_key(rank)?;
            (!of_web || rank(&next) != (true, true)).then_some(next)
        });
        let next = next.flatten();
        let next = next.map(|landmark| self.assessment(landmark, documents));
        self.untested.work(order.filter(|_| !of_web), context);
        if let Some(next) = next {
            self.assessments.measure_ahead(next, context);
        }
    }

    /// Asks for what is shown along the routes; true if time must pass first.
    fn work_on_route(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let ground = context.documents.mission.planned_ground();
        if !self.fitted && (ground.is_some() || context.documents.map.info.is_some()) {
            self.fitted = true; // over an empty map, too: what is drawn there first must not move it
            if let Some(ground) = ground {
                context.map.fit(ground);
            }
        }
        let heat = self.heat_order(context.documents);
        let blind = self.preferences.heat.blind;
        let map = context.documents.map.source.clone();
        self.heat.keep_to(&map, context);
        let mut waits = self.heat.work(heat, blind, context);
        self.finder.keep_to_mission(context);
        let asks = self.finder.asks();
        let question = asks.then(|| self.find_question(context.documents));
        self.finder.work(question.flatten(), context);
        self.suggestions.keep_to(&map, context);
        let asks = self.suggestions.asks();
        let order = asks.then(|| self.suggest_order(context.documents));
        self.suggestions.work(order.flatten(), context);
        let order = self.order(context.documents);
        let limit = self.preferences.limit;
        waits |= self.forecast.work(order, limit, context);
        self.work_on_brief(context);
        let hoped = self.hoped(context.documents);
        self.remedies.work(&self.forecast, limit, hoped, context);
        let preferences = &self.preferences.rehearsal;
        waits |= self.rehearsal.work(&self.forecast, preferences, context);
        waits
    }
}
