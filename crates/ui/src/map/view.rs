//! The map view.

use egui::{Pos2, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};
use pilotage_core::frames::{GroundPoint, GroundRect, LocalFrame};
use pilotage_core::navigator::StepReport;

use super::button::MapButton;
use super::correction::{ShownBelief, shown_belief};
use super::furniture::{
    LensScene, coordinates_text, height_text, paint_attribution, paint_lens, paint_scale_bar,
};
use super::labels::{LandmarkLabel, PlacedLabels};
use super::landmarks::{LandmarkScene, paint_landmarks};
use super::layer::MapLayer;
use super::layers::{Layer, Layers};
use super::look_alike::LookAlikeOnMap;
use super::picking::{Drag, box_between};
use super::readouts::paint_readouts;
use super::roads::DrawnRoads;
use super::symbols::{
    paint_aircraft, paint_ellipses, paint_footprint, paint_halo_text, paint_sigma,
};
use super::tiles::TileCache;
use super::tool::{MapCanvas, MapStage, MapTool};
use super::tracks::{DrawnTrack, TrackStyle};
use super::transform::{MapCamera, ScreenFromWorld};
use crate::context::{DrawnTimes, ViewContext};
use crate::documents::OpenedTerrain;
use crate::shell::BELOW_HUD;
use crate::tokens::Tokens;
use crate::views::picking::{RECENT, recent_frame};
use crate::views::placed_lately;
use pilotage_jobs::MapInfo;

/// Most points of the screen that a pixel of the map is drawn across.
const POINTS_PER_PIXEL: f64 = 6.0;

/// Points of a track by which names keep off it.
const TRACK_POINTS: usize = 200;

/// Data that the map needs beside what every view is given.
pub struct MapExtra<'a> {
    /// Description of the map.
    pub map: Option<&'a MapInfo>,
    /// Generation of the run; another number is another run.
    pub run_generation: u64,
    /// Generation of the ghost.
    pub ghost_generation: u64,
    /// The strongest look-alike of the selected landmark.
    pub look_alike: Option<LookAlikeOnMap>,
    /// The world frame, if it has a place on the globe.
    pub frame: Option<LocalFrame>,
    /// The height of the ground.
    pub ground: &'a OpenedTerrain,
    /// Whom to thank for the map, shown wherever it is.
    pub attribution: Option<&'a str>,
    /// Layers of the features, over the tracks.
    pub layers: &'a [&'a dyn MapLayer],
    /// Buttons of the features among the controls.
    pub buttons: &'a [MapButton],
}

/// The map's own state: how it is looked at, its textures and thinned tracks.
#[derive(Default)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a switch of its own on screen"
)]
pub struct MapView {
    /// View of the map: middle, scale and direction.
    pub camera: MapCamera,
    /// The map's pixels.
    pub tiles: TileCache,
    /// Layers that are on.
    pub layers: Layers,
    /// Whether the flight's direction is kept at the top.
    pub track_up: bool,
    /// Whether the aircraft is kept in the middle.
    pub follow: bool,
    /// Whether the next drag draws a landmark.
    pub picking: bool,
    /// Whether it is marked what a key takes in the middle.
    pub(super) marks_middle: bool,
    /// Whether a place of the flight that is open was chosen for it, to be fitted to nothing else.
    pub is_placed: bool,
    /// Whether the map that is open is to be shown whole once it is known how far it reaches.
    pub fits_when_known: bool,
    /// Least metres per point that people may zoom to: nearer, the map's pixels are nothing but blots.
    pub(super) finest: f64,
    /// The landmark that is being named in place.
    pub naming: Option<u32>,
    /// Whether the plan is shown.
    pub(super) planning: bool,
    /// Whether a layer has tracks beside that of the flight.
    pub(super) has_recorded: bool,
    pub(super) drag: Drag,
    pub(super) name_draft: String,
    estimate: DrawnTrack,
    unaided: DrawnTrack,
    truth: DrawnTrack,
    ghost: DrawnTrack,
    roads: DrawnRoads,
    wants_fit: Option<GroundRect>,
    /// Whether something else than the flight is looked at.
    is_aside: bool,
    /// Place in the other surroundings: at the flight, or at something else.
    elsewhere: Option<MapPlace>,
    /// Centre and scale to which the map was fitted last.
    fitted: Option<(GroundPoint, f64)>,
    rect: Option<Rect>,
    drawn: Option<DrawnTimes>,
    /// Parts of the map that panels cover: names of landmarks keep away from them.
    covered: Vec<Rect>,
    covering: Vec<Rect>,
    /// Names on the map.
    names: PlacedLabels,
}

/// Place at which the map is looked at.
#[derive(Clone, Debug)]
struct MapPlace {
    camera: MapCamera,
    track_up: bool,
    follow: bool,
    wants_fit: Option<GroundRect>,
    fitted: Option<(GroundPoint, f64)>,
}

impl MapView {
    /// Turns to where the flight was looked at last, or else (`is_aside`) something else; stays where that was not yet.
    pub fn turn(&mut self, is_aside: bool) {
        if self.is_aside == is_aside {
            return;
        }
        self.is_aside = is_aside;
        let place = MapPlace {
            camera: self.camera,
            track_up: self.track_up,
            follow: self.follow,
            wants_fit: self.wants_fit,
            fitted: self.fitted,
        };
        if let Some(place) = self.elsewhere.replace(place) {
            self.camera = place.camera;
            self.track_up = place.track_up;
            self.follow = place.follow;
            self.wants_fit = place.wants_fit;
            self.fitted = place.fitted;
        }
    }

    /// Zooms by `factor` about a point of the screen, as near as the map's pixels allow.
    pub(super) fn zoom(&mut self, rect: Rect, factor: f64, about: Pos2) {
        let nearest = (self.camera.metres_per_point / self.finest).max(1.0);
        self.camera.zoom(rect, factor.min(nearest), about);
    }

    /// Forgets where something else was looked at: another flight or map is open.
    pub fn forget_elsewhere(&mut self) {
        self.elsewhere = None;
    }

    /// Shows all of `ground` in the next frame.
    pub fn fit(&mut self, ground: GroundRect) {
        self.wants_fit = Some(ground);
        self.follow = false;
    }

    /// Stays at what its camera shows now.
    pub fn stay(&mut self) {
        self.is_placed = true;
        self.wants_fit = None;
        self.follow = false;
    }

    /// Whether nobody moved the map since it was fitted.
    pub fn is_fitted(&self) -> bool {
        let now = (self.camera.center, self.camera.metres_per_point);
        self.wants_fit.is_some() || (!self.follow && self.fitted == Some(now))
    }

    /// Step whose aircraft was drawn last.
    pub fn drawn(&self) -> Option<DrawnTimes> {
        self.drawn
    }

    /// Says that a panel covers this part of the map, until the map is drawn anew.
    pub fn cover(&mut self, rect: Rect) {
        self.covering.push(rect);
    }

    /// Whether it is marked what a key takes in the middle of the map.
    pub fn marks_middle(&self) -> bool {
        self.marks_middle
    }

    /// Part of the screen on which the map was drawn last.
    pub fn rect(&self) -> Option<Rect> {
        self.rect
    }

    /// The transform of the last frame.
    pub fn screen_from_world(&self) -> Option<ScreenFromWorld> {
        Some(self.camera.screen_from_world(self.rect?))
    }

    /// Draws the map over all of the space that is left, and takes the pointer.
    /// The last of `tools` has it first, and is drawn over the others.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        extra: &MapExtra<'_>,
        mut tools: Vec<&mut dyn MapTool>,
    ) {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Map"));
        if rect.width() < 8.0 || rect.height() < 8.0 {
            return;
        }
        self.rect = Some(rect);
        self.finest = (extra.map).map_or(0.0, |map| map.native_gsd / POINTS_PER_PIXEL);
        self.covered = std::mem::take(&mut self.covering);
        let belief = believed(context);
        if let Some(ground) = self.wants_fit.take() {
            self.camera.fit(rect, &ground);
            self.fitted = Some((self.camera.center, self.camera.metres_per_point));
        }
        self.steer(belief.as_ref());
        self.planning = tools.iter().any(|tool| tool.hides_flight());
        let rows = extra.layers.iter().filter_map(|layer| layer.row());
        self.has_recorded = rows.into_iter().any(|row| row == Layer::Recorded);
        let view = self.camera.screen_from_world(rect);
        self.take_escape(ui, &response, context);
        let tool_now = tools.last_mut();
        let is_busy = tool_now.is_some_and(|tool| tool.interact(ui, &view, &response, context));
        self.interact(ui, rect, &response, context, is_busy);
        let view = self.camera.screen_from_world(rect);
        let painter = ui.painter_at(rect);
        let theme = std::mem::replace(&mut context.tokens, Tokens::over_imagery());
        self.layers.touch = theme.touch;
        painter.rect_filled(rect, 0.0, context.tokens.background);
        if let Some(map) = extra.map {
            self.tiles.paint(&painter, &view, rect, map);
        }
        let pointer = response.hover_pos();
        let (mission, route) = (context.mission, context.route);
        let tokens = context.tokens;
        let show_tools = |map: &Self, show: &mut dyn FnMut(&dyn MapTool, &MapCanvas<'_>)| {
            let canvas = MapCanvas {
                painter: &painter,
                view: &view,
                rect,
                pointer,
                mission,
                route,
                layers: &map.layers,
                tokens,
            };
            for tool in &tools {
                show(&**tool, &canvas);
            }
        };
        let paint_tool =
            |map: &Self, stage| show_tools(map, &mut |tool, canvas| tool.paint(stage, canvas));
        paint_tool(self, MapStage::Ground);
        if self.layers.shows(Layer::Roads) {
            self.roads.follow(&mission.roads, view.metres_per_point);
            self.roads.paint(&painter, &view, rect, tokens);
        }
        self.paint_tracks(&painter, &view, rect, context, extra);
        paint_tool(self, MapStage::BelowMarks);
        let mut labels = Vec::new();
        show_tools(self, &mut |tool, canvas| labels.extend(tool.labels(canvas)));
        let now = (belief.as_ref(), labels);
        self.paint_now(&painter, &view, context, extra, &response, now);
        paint_tool(self, MapStage::AboveMarks);
        paint_tool(self, MapStage::Last);
        self.paint_drawing(&painter, &view, &response, context);
        let takes = |has_keyboard| tools.last().is_some_and(|it| it.takes_middle(has_keyboard));
        self.mark_middle(&painter, &response, takes, tokens);
        self.paint_furniture(&painter, &view, belief.as_ref(), context, extra, &response);
        self.legend(ui, rect, context);
        context.tokens = theme;
        let step = context.run.and_then(|r| r.step_at(context.time));
        if let Some(step) = step {
            let corner = rect.left_top() + vec2(16.0, 16.0);
            let covered =
                paint_readouts(ui, context, extra.ground, step, corner, rect.width() - 96.0);
            self.cover(covered);
        }
        for layer in extra.layers {
            let corner = rect.left_top() + vec2(16.0, BELOW_HUD);
            if let Some(covered) = layer.paint_scale(ui.painter(), corner, context.tokens) {
                self.cover(covered);
            }
        }
        if let Some(attribution) = extra.attribution {
            paint_attribution(ui, rect, attribution, context.tokens);
        }
        self.controls(ui, rect, extra.buttons, context);
        self.naming_field(ui, &view, rect, context);
    }

    /// Keeps the aircraft in the middle and its direction at the top, if so wished.
    fn steer(&mut self, belief: Option<&BeliefOfStep<'_>>) {
        let Some((belief, step)) = belief else {
            return;
        };
        // The ground keeps still under whoever is drawing on it.
        if self.follow && self.drag == Drag::None && !self.picking {
            self.camera.center = belief.position;
        }
        if self.track_up {
            self.camera.up = step.control.heading;
        }
    }

    fn paint_tracks(
        &mut self,
        painter: &egui::Painter,
        view: &ScreenFromWorld,
        rect: Rect,
        context: &ViewContext<'_>,
        extra: &MapExtra<'_>,
    ) {
        let tokens = context.tokens;
        let scale = view.metres_per_point;
        let style = |color, width, dash| TrackStyle {
            corrected: color,
            other: color,
            width,
            dash,
            other_dash: dash,
            outline: tokens.outline(),
        };
        let shown = |layer| self.layers.shows(layer);
        let (show_ghost, show_truth) = (shown(Layer::Ghost), shown(Layer::Truth));
        let (show_unaided, show_estimate) = (shown(Layer::Unaided), shown(Layer::Estimate));
        if let Some(ghost) = context.ghost.filter(|_| show_ghost) {
            self.ghost
                .follow_run(ghost, extra.ghost_generation, scale, |s| s.after.position());
            let look = style(tokens.ghost, 2.0, Some((2.0, 4.0)));
            self.ghost.paint(painter, view, rect, context.time, look);
        }
        let truth = context.flight.and_then(|f| f.truth.as_ref());
        let is_replaced = extra.layers.iter().any(|layer| layer.replaces_truth());
        if let Some(truth) = truth.filter(|_| show_truth && !is_replaced) {
            self.truth.follow_truth(truth, extra.run_generation, scale);
            let look = style(tokens.truth, 2.0, None);
            self.truth.paint(painter, view, rect, context.time, look);
        }
        if !self.planning {
            let layers = extra.layers.iter();
            for layer in layers.filter(|layer| layer.row().is_none_or(shown)) {
                layer.paint(painter, view, context, extra.frame);
            }
        }
        let Some(run) = context.run else { return };
        if show_unaided {
            self.unaided
                .follow_run(run, extra.run_generation, scale, |s| s.dead_reckoned);
            let look = style(tokens.unaided, 2.0, Some((8.0, 5.0)));
            self.unaided.paint(painter, view, rect, context.time, look);
        }
        if show_estimate {
            self.estimate
                .follow_run(run, extra.run_generation, scale, |s| s.after.position());
            let look = TrackStyle {
                corrected: tokens.corrected,
                other: tokens.dead_reckoning,
                width: 2.5,
                dash: None,
                other_dash: Some((5.0, 3.0)),
                outline: tokens.outline(),
            };
            self.estimate.paint(painter, view, rect, context.time, look);
        }
    }

    /// Lines on the screen that names must not cross, and marks that they must not cover: the routes while they
    /// are shown, the selected one with its marks, or else the estimated track.
    fn busy(
        &self,
        view: &ScreenFromWorld,
        context: &ViewContext<'_>,
    ) -> (Vec<[Pos2; 2]>, Vec<Rect>) {
        let route = context.selected_route().filter(|_| self.planning);
        let way_points = route.map_or(&[][..], |route| &route.way_points);
        let frame = LocalFrame::new(context.mission.origin);
        let home = route.and_then(|route| Some(route.way_back(&frame)?[1]));
        let on_route = way_points.iter().map(|w| w.position).chain(home);
        let on_route = on_route.map(|place| view.apply(&place));
        let steps = context.run.map_or(&[][..], |run| &run.steps);
        let is_shown = !self.planning && self.layers.shows(Layer::Estimate);
        let every = (steps.len() / TRACK_POINTS).max(1);
        let flown = steps.iter().filter(|_| is_shown).step_by(every);
        let on_track = flown.map(|step| view.apply(&step.after.position()));
        let marks = on_route.clone();
        let marks = marks.map(|at| Rect::from_center_size(at, vec2(26.0, 26.0)));
        let line: Vec<Pos2> = on_route.chain(on_track).collect();
        let others = context.mission.routes.iter();
        let others = others.filter(|it| self.planning && Some(it.id) != context.route);
        let others = others.flat_map(|it| it.way_points.windows(2));
        let others = others.map(|leg| [&leg[0], &leg[1]].map(|end| view.apply(&end.position)));
        let legs = line.windows(2).map(|leg| [leg[0], leg[1]]);
        (legs.chain(others).collect(), marks.collect())
    }

    /// Draws what belongs to the time cursor.
    fn paint_now(
        &mut self,
        painter: &egui::Painter,
        view: &ScreenFromWorld,
        context: &ViewContext<'_>,
        extra: &MapExtra<'_>,
        response: &egui::Response,
        (belief, mut labels): (Option<&BeliefOfStep<'_>>, Vec<LandmarkLabel>),
    ) {
        let (tokens, rect) = (context.tokens, response.rect);
        let frame_step = context
            .run
            .and_then(|run| recent_frame(run, context.time, RECENT));
        let shows = |layer| self.layers.shows(layer);
        if let Some(frame) = frame_step.and_then(|s| s.frame.as_ref())
            && shows(Layer::Footprint)
        {
            paint_footprint(painter, view, &frame.footprint, tokens);
        }
        if let Some(run) = context.run.filter(|_| shows(Layer::Sighted)) {
            let sightings = crate::views::sighted::last(run, context.time);
            super::sightings::paint(painter, view, rect, sightings, tokens);
        }
        let aircraft = belief.map(|(belief, _)| view.apply(&belief.position));
        let own = aircraft.map(|at| Rect::from_center_size(at, vec2(36.0, 36.0)));
        if let Some(look_alike) = &extra.look_alike {
            let most = context.mission.navigator.detector.greatest_ambiguity;
            labels.push(look_alike.paint(painter, view, most, tokens));
        }
        let shows_landmarks = shows(Layer::Landmarks);
        if shows_landmarks || !labels.is_empty() {
            let (lines, marks) = self.busy(view, context);
            let covered = self.covered.iter().copied().chain(own).chain(marks);
            let covered: Vec<Rect> = covered.collect();
            let hovered = response
                .hover_pos()
                .and_then(|p| super::picking::landmark_at(&context.mission.landmarks, view, p));
            let scene = LandmarkScene {
                landmarks: if shows_landmarks {
                    &context.mission.landmarks
                } else {
                    &[]
                },
                step: frame_step,
                selection: context.selection,
                hovered,
                names: view.metres_per_point < 4.0,
                covered: &covered,
                lines: &lines,
                lines_from: aircraft.filter(|_| shows(Layer::Matches)),
                lines_drawn: belief.map_or(1.0, |(belief, _)| belief.share),
            };
            let names = (labels, &mut self.names);
            paint_landmarks(painter, view, rect, &scene, names, tokens);
        }
        let Some((belief, step)) = belief else {
            return;
        };
        let heading = step.control.heading;
        if shows(Layer::Truth)
            && let Some(truth) = truth_at(context, step.time)
        {
            paint_aircraft(
                painter,
                view,
                view.apply(&truth),
                heading,
                13.0,
                tokens.truth.gamma_multiply(0.35),
                Stroke::new(1.5, tokens.truth),
            );
        }
        let color = status_color(context);
        let covariance = belief.covariance;
        if shows(Layer::Ellipses) {
            paint_ellipses(painter, view, &belief.position, &covariance, color, tokens);
        }
        let at = view.apply(&belief.position);
        let edge = Stroke::new(1.25, tokens.outline());
        paint_aircraft(painter, view, at, heading, 15.0, color, edge);
        self.drawn = context.drawn(step.time);
        if shows(Layer::Sigma) {
            let spread = view.points(covariance.diagonal().max().max(0.0).sqrt());
            if spread > 2.0 {
                paint_sigma(painter, view, &belief.sigma, tokens, 2.75);
            }
        }
    }

    fn paint_drawing(
        &self,
        painter: &egui::Painter,
        view: &ScreenFromWorld,
        response: &egui::Response,
        context: &ViewContext<'_>,
    ) {
        let tokens = context.tokens;
        if let (Drag::Draw(from), Some(to)) = (self.drag, response.interact_pointer_pos()) {
            let bounds = box_between(from, view.inverse(to));
            let corners = view.corners(&bounds);
            painter.add(egui::Shape::convex_polygon(
                corners.to_vec(),
                tokens.accent.gamma_multiply(0.18),
                Stroke::new(2.0, tokens.accent),
            ));
            let (factor, unit) = context.units.length();
            let text = format!(
                "{:.0} × {:.0} {unit}",
                bounds.width() * factor,
                bounds.height() * factor
            );
            let at = Rect::from_points(&corners).center_bottom() + vec2(0.0, 8.0);
            let align = egui::Align2::CENTER_TOP;
            paint_halo_text(painter, at, align, &text, tokens.small(), tokens.sigma);
        }
    }

    fn paint_furniture(
        &mut self,
        painter: &egui::Painter,
        view: &ScreenFromWorld,
        belief: Option<&BeliefOfStep<'_>>,
        context: &ViewContext<'_>,
        extra: &MapExtra<'_>,
        response: &egui::Response,
    ) {
        let (tokens, rect) = (context.tokens, response.rect);
        let corner = rect.right_bottom() - vec2(16.0, 16.0);
        let bar = paint_scale_bar(painter, view, corner, context.units, tokens);
        self.cover(bar);
        if let Some(pointer) = response.hover_pos() {
            let place = view.inverse(pointer);
            let mut text = coordinates_text(&place, extra.frame.as_ref(), context.units);
            if let Some(height) = height_text(&place, extra.ground, context.units) {
                text = format!("{height}   {text}");
            }
            paint_halo_text(
                painter,
                pos2(rect.right() - 18.0, rect.bottom() - 46.0),
                egui::Align2::RIGHT_BOTTOM,
                &text,
                tokens.small(),
                tokens.sigma,
            );
        }
        if let Some((belief, step)) = belief
            && self.layers.shows(Layer::Sigma)
            && rect.width() > 620.0
            && rect.height() > 420.0
        {
            let side = 152.0;
            let lens = Rect::from_min_size(
                pos2(rect.right() - side - 16.0, rect.bottom() - side - 72.0),
                vec2(side, side),
            );
            let truth = truth_at(context, step.time).filter(|_| self.layers.shows(Layer::Truth));
            self.cover(lens);
            let scene = LensScene {
                belief,
                truth,
                color: status_color(context),
            };
            paint_lens(painter, view, lens, &scene, context.units, tokens);
        }
    }
}

/// A belief as it is drawn, and its step.
type BeliefOfStep<'a> = (ShownBelief, &'a StepReport);

/// The belief to be drawn at the time cursor.
fn believed<'a>(context: &ViewContext<'a>) -> Option<BeliefOfStep<'a>> {
    let run = context.run?;
    let step = run.step_at(context.time)?;
    Some((shown_belief(run, step, context.time, context.motion), step))
}

fn truth_at(context: &ViewContext<'_>, time: f64) -> Option<GroundPoint> {
    let position = context.flight?.truth.as_ref()?.position(time)?;
    Some(GroundPoint::new(position.x, position.y))
}

/// Red where anything told the place lately, blue while dead reckoning.
fn status_color(context: &ViewContext<'_>) -> egui::Color32 {
    let run = context.run;
    let now = run.and_then(|run| Some((run, run.index_at(context.time)?)));
    if now.is_some_and(|(run, index)| placed_lately(run, index).is_some()) {
        context.tokens.corrected
    } else {
        context.tokens.dead_reckoning
    }
}
