//! Layout of the window: top bar, map, side column, plots, timeline; reflowed for narrow windows.

use egui::{Frame, Margin, Panel, Stroke, Ui, vec2};

use pilotage_core::frames::LocalFrame;

use super::{App, SideTab, Views, is_sheet};
use crate::command::Command;
use crate::context::ViewContext;
use crate::dialogs::settings_sheet;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureId, FeaturePlace, PictureButton, examined, lack};
use crate::map::{LookAlikeOnMap, MapExtra, MapTool};
use crate::shell::{MenuTable, TopBar, column_tabs, icon_button, top_bar};
use crate::timeline::TimelineExtra;
use crate::tokens::Tokens;

/// Windows narrower than this stack the side column below the map.
const NARROW: f32 = 900.0;
/// Windows lower than this have no room for a column below the map.
const LOW: f32 = 560.0;
/// Least height of the map that plots below it leave, points.
const LEAST_MAP: f32 = 200.0;
const BAR_HEIGHT: f32 = 48.0;
const PLOTS_HEIGHT: f32 = 234.0;
const STRIP_HEIGHT: f32 = 216.0;

/// Everything that the views are drawn from, but the views themselves.
struct Scene<'a> {
    documents: &'a Documents,
    tokens: &'a Tokens,
    view: &'a mut crate::documents::ViewState,
    playback: &'a crate::timeline::Playback,
    selection: Option<u32>,
    side_tab: &'a mut SideTab,
    settings: &'a mut bool,
    job_words: Option<String>,
}

impl Scene<'_> {
    /// Whether the flight has pictures.
    fn has_frames(&self) -> bool {
        let flight = self.documents.flight.measured.as_ref();
        flight.is_some_and(|flight| !flight.frames.is_empty())
    }

    /// Lends the documents to a view.
    fn with_context<R>(
        &self,
        commands: &mut Vec<Command>,
        show: impl FnOnce(&mut ViewContext<'_>) -> R,
    ) -> R {
        let pictures = |index: usize| self.documents.flight.pictures.key(index);
        show(&mut ViewContext {
            mission: &self.documents.mission,
            flight: self.documents.flight.measured.as_ref(),
            run: self.documents.run.navigated.as_ref(),
            ghost: self.documents.run.ghost.as_ref(),
            time: self.playback.time,
            clock_zero: self.documents.clock_zero(),
            is_recorded: self.documents.flight.log.is_some(),
            selected_span: self.playback.selected_span,
            playing: self.playback.playing,
            motion: self.playback.motion(),
            selection: self.selection,
            route: self.documents.mission.route,
            pictures: &pictures,
            tokens: self.tokens,
            units: self.view.units,
            flying: self.job_words.as_deref(),
            commands,
        })
    }
}

impl App {
    pub(super) fn layout(&mut self, ui: &mut Ui, now: f64, commands: &mut Vec<Command>) {
        self.turn_to_panels();
        let tokens = self.tokens.clone();
        let screen = ui.ctx().content_rect();
        let narrow = screen.width() < NARROW;
        let plots_open = self.are_plots_open(screen);
        let is_side_open = self.is_side_open(screen);
        let title = self.documents.title();
        let workspace = self.view.workspace;
        let mut features = self.views.features.iter();
        let next = features.find_map(|it| it.next_step(workspace, &self.documents));
        let lack = |command: &Command| {
            lack(
                command,
                &self.views.features,
                &self.documents,
                self.selection,
            )
        };
        bar(&tokens, BAR_HEIGHT).show(ui, |ui| {
            let bar = TopBar {
                workspace,
                title: &title,
                progress: self.progress(),
                settings_open: self.dialogs.settings,
                next,
                table: MenuTable {
                    catalog: &self.catalog,
                    lack: &lack,
                },
            };
            ui.horizontal_centered(|ui| top_bar(ui, &tokens, &bar, commands));
        });
        let (mut scene, views) = self.scene(&tokens);
        let is_flight_hidden = views.hide_flight(scene.view.workspace);
        let filling = views.fills_window(scene.view.workspace);
        if let Some(index) = views.beside_map() {
            let room = beside_map(ui, &mut scene, views, index, commands);
            self.overlays(ui, &tokens, now, commands, room);
            return;
        }
        if is_flight_hidden {
            if plots_open && views.fills_strip(scene.view.workspace, scene.documents) {
                strip(ui, &mut scene, views, commands);
            }
        } else {
            timeline(ui, &scene, views, commands);
        }
        if let Some(index) = filling {
            let room = window(ui, &scene, views, index, commands, narrow);
            self.overlays(ui, &tokens, now, commands, room);
            return;
        }
        if is_side_open || *scene.settings {
            if narrow {
                lower(ui, &mut scene, views, commands);
            } else {
                side(ui, &mut scene, views, commands);
            }
        }
        let has_plots = plots_open && !narrow && !is_flight_hidden;
        let documents = scene.documents;
        let mut features = views.features.iter();
        let room;
        if has_plots && features.any(|it| it.leaves_map_empty(documents)) {
            room = ui.available_rect_before_wrap();
            egui::CentralPanel::default()
                .frame(plain_frame(&tokens, Margin::symmetric(8, 8)))
                .show(ui, |ui| all_plots(ui, &scene, views, commands));
        } else {
            if has_plots {
                plots(ui, &mut scene, views, commands);
            }
            room = ui.available_rect_before_wrap();
            map(ui, &scene, views, commands);
        }
        self.overlays(ui, &tokens, now, commands, room);
    }

    /// Turns to the panels of the workspace; a recorded flight has others than a simulated one.
    fn turn_to_panels(&mut self) {
        let is_log = self.documents.flight.log.is_some() && !self.is_flight_hidden();
        let work = self.view.workspace.label();
        self.view.turn_to_panels(if is_log { "Log" } else { work });
    }

    /// Everything that the views are drawn from, and the views.
    fn scene<'a>(&'a mut self, tokens: &'a Tokens) -> (Scene<'a>, &'a mut Views) {
        let job_words = self.progress().map(|(_, words)| words.to_owned());
        let scene = Scene {
            documents: &self.documents,
            tokens,
            view: &mut self.view,
            playback: &self.playback,
            selection: self.selection,
            side_tab: &mut self.side_tab,
            settings: &mut self.dialogs.settings,
            job_words,
        };
        (scene, &mut self.views)
    }

    /// Whether plots are shown in a window of this size: as people said, else where there is room and they matter.
    pub(super) fn are_plots_open(&self, screen: egui::Rect) -> bool {
        let has_room = screen.width() >= NARROW || !self.is_flight_hidden();
        let is_usual = has_room && screen.height() >= 760.0 && !self.is_flight_aside();
        self.view.plots_open.unwrap_or(is_usual)
    }

    /// Whether the column is shown in a window of this size: as people said, else unless it would leave no map.
    pub(super) fn is_side_open(&self, screen: egui::Rect) -> bool {
        let is_usual = screen.width() >= NARROW || screen.height() >= LOW;
        self.view.side_open.unwrap_or(is_usual)
    }

    /// Draws what lies over the rest; notices lie over `room`, which the panels leave.
    fn overlays(
        &mut self,
        ui: &mut Ui,
        tokens: &Tokens,
        now: f64,
        commands: &mut Vec<Command>,
        room: egui::Rect,
    ) {
        let (features, documents) = (&self.views.features, &self.documents);
        let lack = |command: &Command| lack(command, features, documents, self.selection);
        let table = MenuTable {
            catalog: &self.catalog,
            lack: &lack,
        };
        let notices = (&self.toasts, now);
        self.dialogs.show(ui, tokens, &table, notices, commands);
        let (scene, views) = self.scene(tokens);
        for feature in &mut views.features {
            scene.with_context(commands, |context| {
                if feature.info().place == FeaturePlace::Dialog {
                    feature.panel(ui, context, scene.documents);
                }
                feature.overlay(ui, context, scene.documents);
            });
        }
        self.dialogs.notices |= self.toasts.show(ui, tokens, now, room);
    }
}

/// The window as the feature at `index` fills it, and its panel beside that or below, which leaves the room returned.
fn window(
    ui: &mut Ui,
    scene: &Scene<'_>,
    views: &mut Views,
    index: usize,
    commands: &mut Vec<Command>,
    narrow: bool,
) -> egui::Rect {
    let (tokens, documents) = (scene.tokens, scene.documents);
    let feature = &mut views.features[index];
    let panel = if narrow {
        let height = ui.ctx().content_rect().height();
        Panel::bottom("below the window").exact_size(0.4 * height)
    } else {
        Panel::right("beside the window").exact_size(344.0)
    };
    let frame = plain_frame(tokens, Margin::symmetric(12, 8));
    panel.frame(frame).show(ui, |ui| {
        let width = ui.available_width();
        egui::ScrollArea::vertical()
            .auto_shrink(false)
            .show(ui, |ui| {
                ui.set_max_width(width);
                scene.with_context(commands, |context| feature.panel(ui, context, documents));
            });
    });
    let room = ui.available_rect_before_wrap();
    scene.with_context(commands, |context| {
        feature.window(ui, context, documents, &mut views.camera);
    });
    room
}

/// The picture of the feature at `index`, the map beside it, and its panel, which leaves the room returned.
fn beside_map(
    ui: &mut Ui,
    scene: &mut Scene<'_>,
    views: &mut Views,
    index: usize,
    commands: &mut Vec<Command>,
) -> egui::Rect {
    let (tokens, documents) = (scene.tokens, scene.documents);
    let feature = &mut views.features[index];
    let width = ui.ctx().content_rect().width();
    Panel::right("beside the map")
        .exact_size(if width >= 1180.0 { 344.0 } else { 300.0 })
        .frame(plain_frame(tokens, Margin::symmetric(12, 8)))
        .show(ui, |ui| {
            let width = ui.available_width();
            egui::ScrollArea::vertical()
                .auto_shrink(false)
                .show(ui, |ui| {
                    ui.set_max_width(width);
                    scene.with_context(commands, |context| feature.panel(ui, context, documents));
                });
        });
    let room = ui.available_rect_before_wrap();
    let half = 0.5 * room.width();
    Panel::left("picture")
        .resizable(true)
        .default_size(half)
        .size_range(160.0..=1.6 * half)
        .frame(Frame::new().fill(tokens.background))
        .show(ui, |ui| {
            scene.with_context(commands, |context| {
                feature.window(ui, context, documents, &mut views.camera);
            });
        });
    map(ui, scene, views, commands);
    room
}

fn plain_frame(tokens: &Tokens, margin: Margin) -> Frame {
    Frame::new().fill(tokens.surface).inner_margin(margin)
}

fn bar(tokens: &Tokens, height: f32) -> Panel {
    Panel::top("top bar")
        .exact_size(height)
        .frame(plain_frame(tokens, Margin::symmetric(8, 0)))
}

fn timeline(ui: &mut Ui, scene: &Scene<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    let height = if ui.available_width() < 720.0 {
        64.0 + scene.tokens.target()
    } else {
        64.0
    };
    Panel::bottom("timeline")
        .exact_size(height)
        .frame(plain_frame(scene.tokens, Margin::symmetric(8, 8)))
        .show(ui, |ui| {
            let extra = TimelineExtra {
                playback: scene.playback,
                span: scene.documents.span(),
                complete: scene.documents.run.is_complete,
                generation: scene.documents.run.generation,
                bookmarks: &scene.documents.flight.bookmarks,
            };
            scene.with_context(commands, |context| views.timeline.show(ui, context, &extra));
        });
}

fn plots(ui: &mut Ui, scene: &mut Scene<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    let screen = ui.ctx().content_rect();
    let usual = if views.features.iter().any(|it| it.has_plots()) {
        0.42 * screen.height()
    } else {
        PLOTS_HEIGHT
    };
    let id = panel_id("plots", scene);
    let panel = Panel::bottom(id)
        .resizable(true)
        .default_size(scene.view.plots_height.unwrap_or(usual))
        .size_range(96.0..=(ui.available_height() - LEAST_MAP).max(96.0))
        .frame(plain_frame(scene.tokens, Margin::symmetric(8, 8)))
        .show(ui, |ui| all_plots(ui, scene, views, commands));
    if is_resized(ui, id) {
        scene.view.plots_height = Some(panel.response.rect.height());
    }
}

/// The plots: a flight that has plots of its own is looked at by those first.
fn all_plots(ui: &mut Ui, scene: &Scene<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    scene.with_context(commands, |context| {
        let mut features = views.features.iter_mut();
        if let Some(feature) = features.find(|it| it.has_plots()) {
            feature.plots(ui, context, scene.documents);
            if !feature.leaves_room_for_run() {
                return;
            }
        }
        views.plots.show(ui, context);
    });
    ui.take_available_space();
}

fn side(ui: &mut Ui, scene: &mut Scene<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    let width = ui.ctx().content_rect().width();
    let default = if width >= 1280.0 { 376.0 } else { 320.0 };
    let tokens = scene.tokens;
    let id = panel_id("side", scene);
    let panel = Panel::right(id)
        .resizable(true)
        .default_size(scene.view.side_width.unwrap_or(default))
        .size_range(288.0..=0.45 * width)
        .frame(plain_frame(tokens, Margin::ZERO))
        .show(ui, |ui| {
            let inner = Frame::new().inner_margin(Margin::symmetric(12, 8));
            if *scene.settings {
                inner.show(ui, |ui| settings(ui, scene, commands));
                return;
            }
            let owner = views.owner(scene.view.workspace);
            if owner.is_some_and(Feature::keeps_picture) {
                let picture = picture_size(ui.available_size(), scene).y;
                let height = (ui.available_height() - picture).max(320.0);
                let size = vec2(ui.available_width(), height);
                ui.allocate_ui(size, |ui| {
                    inner.show(ui, |ui| {
                        ui.set_min_height(height - 16.0);
                        workspace(ui, scene, views, commands);
                    });
                });
                camera(ui, scene, views, commands);
            } else if owner.is_some() {
                inner.show(ui, |ui| workspace(ui, scene, views, commands));
            } else if is_sheet(*scene.side_tab, &views.features) {
                inner.show(ui, |ui| sheet(ui, scene, views, commands));
            } else {
                let has_log = scene.documents.flight.log.is_some();
                if !has_log || scene.has_frames() {
                    camera(ui, scene, views, commands);
                }
                inner.show(ui, |ui| {
                    let rest = [SideTab::Filter, SideTab::Landmarks];
                    let tabs = with_features([&[], &rest], views);
                    tabbed(ui, scene, views, commands, &tabs);
                });
            }
            ui.take_available_space();
        });
    if is_resized(ui, id) {
        scene.view.side_width = Some(panel.response.rect.width());
    }
}

/// Identity of a panel that each kind of work has its own of.
fn panel_id(name: &str, scene: &Scene<'_>) -> egui::IdSalt {
    egui::IdSalt::new((name, &scene.view.panels_of, scene.view.resets))
}

/// Whether people draw the edge of a panel just now.
fn is_resized(ui: &Ui, panel: egui::IdSalt) -> bool {
    let edge = ui.scope_id().with(panel).with("__resize");
    let response = ui.read_response(edge);
    response.is_some_and(|edge| edge.dragged() || edge.drag_stopped())
}

/// The part below the map in a narrow window.
fn lower(ui: &mut Ui, scene: &mut Scene<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    let height = ui.ctx().content_rect().height();
    let most = ((ui.available_height() - LEAST_MAP).min(0.7 * height)).max(160.0);
    Panel::bottom("lower")
        .resizable(true)
        .default_size((0.40 * height).min(most))
        .size_range(160.0..=most)
        .frame(plain_frame(scene.tokens, Margin::symmetric(12, 8)))
        .show(ui, |ui| {
            if *scene.settings {
                settings(ui, scene, commands);
            } else if views.owner(scene.view.workspace).is_some() {
                workspace(ui, scene, views, commands);
            } else if is_sheet(*scene.side_tab, &views.features) {
                sheet(ui, scene, views, commands);
            } else {
                let front = [SideTab::Camera];
                let rest = [SideTab::Filter, SideTab::Plots, SideTab::Landmarks];
                let tabs = with_features([&front, &rest], views);
                tabbed(ui, scene, views, commands, &tabs);
            }
            ui.take_available_space();
        });
}

fn settings(ui: &mut Ui, scene: &mut Scene<'_>, commands: &mut Vec<Command>) {
    let usual = || scene.documents.usual_navigator();
    let close = scene.with_context(commands, |context| settings_sheet(ui, context, usual));
    if close {
        *scene.settings = false;
    }
}

/// The camera picture's size in a column: as wide as the column, at most half as high as `room`.
fn picture_size(room: egui::Vec2, scene: &Scene<'_>) -> egui::Vec2 {
    let aspect = scene.documents.flight.measured.as_ref().map_or(0.75, |f| {
        f.camera.height as f32 / f.camera.width.max(1) as f32
    });
    vec2(room.x, (room.x * aspect).min(0.5 * room.y.max(120.0)))
}

/// The camera picture of the flight; in a workspace of a feature, it takes what is left of the column.
fn camera(ui: &mut Ui, scene: &Scene<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    let is_owned = views.owner(scene.view.workspace).is_some();
    let mut size = picture_size(ui.available_size(), scene);
    if is_owned {
        size.y = ui.available_height();
    }
    let (rect, _) = ui.allocate_exact_size(size, egui::Sense::hover());
    let mut inside = ui.new_child(egui::UiBuilder::new().max_rect(rect).id_salt("camera"));
    inside.set_clip_rect(rect.intersect(ui.clip_rect()));
    scene.with_context(commands, |context| views.camera.show(&mut inside, context));
    if !is_owned && scene.documents.flight.measured.is_some() {
        let buttons = views.features.iter().filter_map(|it| it.picture_button());
        picture_buttons(ui, scene.tokens, rect, buttons, commands);
    }
}

/// Buttons of features in a row, from the corner of the picture on.
fn picture_buttons(
    ui: &mut Ui,
    tokens: &Tokens,
    picture: egui::Rect,
    buttons: impl Iterator<Item = PictureButton>,
    commands: &mut Vec<Command>,
) {
    let side = tokens.target();
    let mut at = picture.left_top();
    for button in buttons {
        let corner = egui::Rect::from_min_size(at, vec2(side, side));
        let mut corner = ui.new_child(egui::UiBuilder::new().max_rect(corner));
        let painter = corner.painter();
        painter.rect_filled(corner.max_rect(), tokens.radius, tokens.over_map());
        if icon_button(&mut corner, tokens, button.icon, button.label).clicked() {
            commands.push(button.command);
        }
        at.x += side;
    }
}

/// The app's own tabs in two parts, and those of the features before, between and behind them.
fn with_features(own: [&[SideTab]; 2], views: &Views) -> Vec<SideTab> {
    let at = |place| {
        let features = views.features.iter().filter(|it| it.has_tab());
        let features = features.map(|it| it.info());
        let there: Vec<_> = features.filter(|info| info.place == place).collect();
        there.into_iter().map(|info| SideTab::Feature(info.id))
    };
    let [front, rest] = own.map(|tabs| tabs.iter().copied());
    let front = at(FeaturePlace::FirstTab).chain(front);
    let rest = at(FeaturePlace::PictureTab).chain(rest);
    front.chain(rest).chain(at(FeaturePlace::Tab)).collect()
}

fn tabbed(
    ui: &mut Ui,
    scene: &mut Scene<'_>,
    views: &mut Views,
    commands: &mut Vec<Command>,
    tabs: &[SideTab],
) {
    let tokens = scene.tokens;
    if !tabs.contains(scene.side_tab) {
        *scene.side_tab = tabs[0];
    }
    let labels: Vec<&str> = tabs.iter().map(|it| it.label(&views.features)).collect();
    let chosen = tabs.iter().position(|it| it == scene.side_tab);
    if let Some(clicked) = column_tabs(ui, tokens, &labels, chosen) {
        *scene.side_tab = tabs[clicked];
    }
    let line = ui.max_rect().x_range();
    let y = ui.cursor().top() - 4.0;
    ui.painter().hline(line, y, Stroke::new(1.0, tokens.line));
    match *scene.side_tab {
        SideTab::Filter => scene.with_context(commands, |c| views.inspector.show(ui, c)),
        SideTab::Landmarks => landmarks(ui, scene, views, commands),
        SideTab::Feature(id) => feature(ui, scene, &mut views.features, id, commands),
        SideTab::Camera => scene.with_context(commands, |c| views.camera.show(ui, c)),
        SideTab::Plots => scene.with_context(commands, |c| views.plots.show(ui, c)),
    }
}

/// Draws the sheet that takes the whole column.
fn sheet(ui: &mut Ui, scene: &Scene<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    let documents = scene.documents;
    if let SideTab::Feature(id) = *scene.side_tab {
        let features = views.features.iter_mut();
        if let Some(feature) = features.into_iter().find(|it| it.info().id == id) {
            scene.with_context(commands, |c| feature.panel(ui, c, documents));
        }
    }
}

/// Panel of a feature.
fn feature(
    ui: &mut Ui,
    scene: &Scene<'_>,
    features: &mut [Box<dyn Feature>],
    id: FeatureId,
    commands: &mut Vec<Command>,
) {
    let Some(feature) = features.iter_mut().find(|it| it.info().id == id) else {
        return;
    };
    let place = feature.info().place;
    if matches!(place, FeaturePlace::FirstTab | FeaturePlace::PictureTab) {
        scene.with_context(commands, |c| feature.panel(ui, c, scene.documents));
        return;
    }
    egui::ScrollArea::vertical()
        .id_salt(id)
        .auto_shrink(false)
        .show(ui, |ui| {
            scene.with_context(commands, |c| feature.panel(ui, c, scene.documents));
        });
}

/// The column of the open workspace, as its owner draws it.
fn workspace(ui: &mut Ui, scene: &Scene<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    if let Some(owner) = views.owner_mut(scene.view.workspace) {
        scene.with_context(commands, |context| {
            owner.panel(ui, context, scene.documents);
        });
    }
}

/// The panel of the open workspace below the map.
fn strip(ui: &mut Ui, scene: &mut Scene<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    let screen = ui.ctx().content_rect();
    let id = panel_id("strip", scene);
    let panel = Panel::bottom(id)
        .resizable(true)
        .default_size(scene.view.strip_height.unwrap_or(STRIP_HEIGHT))
        .size_range(
            112.0..=((ui.available_height() - LEAST_MAP).min(0.5 * screen.height())).max(112.0),
        )
        .frame(plain_frame(scene.tokens, Margin::symmetric(8, 8)))
        .show(ui, |ui| {
            if let Some(owner) = views.owner_mut(scene.view.workspace) {
                scene.with_context(commands, |context| {
                    owner.plots(ui, context, scene.documents);
                });
            }
            ui.take_available_space();
        });
    if is_resized(ui, id) {
        scene.view.strip_height = Some(panel.response.rect.height());
    }
}

fn landmarks(ui: &mut Ui, scene: &Scene<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    let (past, future) = scene.documents.mission.history.depth();
    let examined = examined(&views.features, scene.selection, scene.documents);
    egui::ScrollArea::vertical()
        .id_salt("landmarks")
        .auto_shrink(false)
        .show(ui, |ui| {
            scene.with_context(commands, |context| {
                let can_undo = (past > 0, future > 0);
                views.landmarks.show(ui, context, examined, can_undo);
            });
        });
}

fn map(ui: &mut Ui, scene: &Scene<'_>, views: &mut Views, commands: &mut Vec<Command>) {
    let tokens = scene.tokens;
    let beside = views.beside_map();
    let place = FeaturePlace::Workspace(scene.view.workspace);
    let is_flight_hidden = views.hide_flight(scene.view.workspace) && beside.is_none();
    egui::CentralPanel::default()
        .frame(Frame::new().fill(tokens.background))
        .show(ui, |ui| {
            let rect = ui.available_rect_before_wrap();
            let Views { map, features, .. } = views;
            let mut layers = Vec::new();
            let look_alike = examined(features, scene.selection, scene.documents);
            // Beside a picture that is put on the ground, nobody asks about the selected landmark.
            let look_alike = look_alike.found.filter(|_| beside.is_none());
            let look_alike = look_alike.and_then(LookAlikeOnMap::of);
            let buttons: Vec<_> = features.iter().filter_map(|it| it.map_button()).collect();
            let mut tools: Vec<&mut dyn MapTool> = Vec::new();
            for (index, feature) in features.iter_mut().enumerate() {
                let own = feature.info().place;
                let is_owner = own == place;
                if own == FeaturePlace::Nowhere && feature.tool().is_some() {
                    tools.extend(feature.tool());
                } else if beside.map_or(is_owner, |beside| beside == index) {
                    let tool = feature.tool();
                    tools.splice(0..0, tool);
                } else if !is_owner {
                    layers.extend(feature.layers());
                }
            }
            let extra = MapExtra {
                map: scene.documents.map.info.as_ref(),
                run_generation: scene.documents.run.generation,
                ghost_generation: scene.documents.run.ghost_generation,
                look_alike,
                frame: scene.documents.world_origin().map(LocalFrame::new),
                ground: &scene.documents.map.terrain,
                attribution: scene.documents.map.attribution(),
                layers: &layers,
                buttons: &buttons,
            };
            scene.with_context(commands, |context| {
                let is_covered = layers.iter().any(|layer| layer.hides_flight(extra.frame));
                if is_flight_hidden || beside.is_some() || is_covered {
                    // What was flown is Replay's; here lies something else.
                    (context.run, context.ghost, context.flight) = (None, None, None);
                }
                map.show(ui, context, &extra, tools);
            });
            for feature in features.iter() {
                let own = feature.info().place;
                if own == FeaturePlace::Nowhere || (own == place && beside.is_none()) {
                    let covered = scene.with_context(commands, |c| feature.over_map(ui, rect, c));
                    for part in covered {
                        map.cover(part);
                    }
                }
            }
            let is_owned = features.iter().any(|it| it.info().place == place);
            let needs_none = features.iter().any(|it| it.needs_no_advice());
            if is_owned || beside.is_some() || needs_none {
                return;
            }
            for feature in features.iter() {
                let covered = scene.with_context(commands, |context| {
                    feature.advice(ui, rect, context, scene.documents)
                });
                if let Some(covered) = covered {
                    map.cover(covered);
                }
            }
        });
}
