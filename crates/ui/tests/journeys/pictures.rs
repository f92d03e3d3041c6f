//! Pictures of the whole app over the built-in demo, for people to look at:
//! `PILOTAGE_PICTURES=folder cargo test -p pilotage-ui --test journeys pictures`.
//! `PILOTAGE_SCENES=name,name` draws only some of them.

use egui::{Key, Modifiers, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use pilotage_ui::app::App;

use super::support::canvas::{Textures, folder};
use super::support::inline::InlineHost;

struct Page {
    app: Option<App>,
    host: InlineHost,
}

struct Scene {
    harness: Harness<'static, Page>,
    textures: Textures,
    size: Vec2,
}

impl Scene {
    fn new(size: Vec2) -> Self {
        let page = Page {
            app: None,
            host: InlineHost::default(),
        };
        let textures = Textures::default();
        let harness = Harness::builder()
            .with_size(size)
            .renderer(textures.clone())
            .build_ui_state(
                |ui, page: &mut Page| {
                    let app = page
                        .app
                        .get_or_insert_with(|| App::new(ui.ctx(), &page.host));
                    app.ui(ui, &mut page.host);
                },
                page,
            );
        Self {
            harness,
            textures,
            size,
        }
    }

    /// Lets the workers work and time pass.
    fn work(&mut self, frames: usize, milliseconds: f64) {
        for _ in 0..frames {
            self.harness.state_mut().host.pass_time(milliseconds);
            self.harness.step();
        }
    }

    fn key(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.work(3, 20.0);
    }

    fn tab(&mut self, label: &str) {
        self.harness
            .get_by_role_and_label(egui::accesskit::Role::Tab, label)
            .click();
        self.work(3, 20.0);
    }

    fn click(&mut self, label: &str) {
        self.harness.get_by_label(label).click();
        self.work(3, 20.0);
    }

    /// State of the app.
    fn state(&self) -> serde_json::Value {
        let app = self.harness.state().app.as_ref().expect("drawn");
        serde_json::from_str(&app.state_json()).expect("the app writes JSON")
    }

    /// Lets the workers work until the state has something there.
    fn until(&mut self, pointer: &str) {
        for _ in 0..20_000 {
            self.work(1, 20.0);
            if self.state().pointer(pointer).is_some() {
                return;
            }
        }
        panic!("no {pointer}");
    }

    fn save(&self, name: &str) {
        let Some(folder) = folder() else { return };
        let output = self.harness.output();
        let picture = self.textures.draw(&self.harness.ctx, output, self.size);
        let path = folder.join(format!("app-{name}.png"));
        picture.save(&path).expect("the folder can be written to");
    }
}

/// Flies until `seconds` of the flight are on screen.
fn flown(size: Vec2, seconds: f64) -> Scene {
    let mut scene = Scene::new(size);
    for _ in 0..4000 {
        scene.work(1, 20.0);
        let app = scene.harness.state().app.as_ref().expect("drawn");
        let state: serde_json::Value =
            serde_json::from_str(&app.state_json()).expect("the app writes JSON");
        let enough = state["run_steps"].as_f64() > Some(seconds * 20.0);
        if enough || state["run_complete"] == true {
            break;
        }
    }
    scene.key(Modifiers::NONE, Key::Space);
    for _ in 0..(seconds / 5.0) as usize {
        scene.key(Modifiers::SHIFT, Key::ArrowRight);
    }
    scene.work(120, 20.0);
    scene
}

#[test]
fn the_app_is_drawn_for_people_to_look_at() {
    if folder().is_none() {
        println!("skipped: PILOTAGE_PICTURES names no folder");
        return;
    }
    let only = std::env::var("PILOTAGE_SCENES").unwrap_or_default();
    let wanted = |name: &str| only.is_empty() || only.split(',').any(|n| n == name);
    let wide = vec2(1440.0, 900.0);
    if wanted("start") {
        let mut scene = Scene::new(wide);
        scene.work(2, 20.0);
        scene.save("start");
    }
    if wanted("replay") {
        flown(wide, 60.0).save("replay");
    }
    if wanted("small") {
        flown(vec2(1024.0, 700.0), 60.0).save("small");
    }
    if wanted("tablet") {
        flown(vec2(768.0, 1024.0), 60.0).save("tablet");
    }
    if wanted("plan") {
        let mut scene = flown(wide, 2.0);
        scene.tab("Plan");
        scene.work(160, 20.0);
        scene.save("plan");
        scene.tab("Landmarks");
        let label = "Suggest 6 landmarks for this route";
        scene.click(label);
        scene.until("/plan/suggested/list/0");
        scene.work(20, 20.0);
        scene.save("plan-suggested");
        scene.click("Dismiss");
        let row = scene.harness.get_by_label_contains("church: ");
        row.click();
        scene.work(40, 20.0);
        scene.click("Test how well it is found");
        scene.until("/plan/measured/0");
        scene.click("Best altitude");
        scene.until("/plan/envelopes/0");
        while !scene.state()["plan"]["surveying"].is_null() {
            scene.work(1, 20.0);
        }
        scene.save("plan-landmarks");
        let at = vec2(1200.0, 700.0).to_pos2();
        scene.harness.hover_at(at);
        for _ in 0..40 {
            scene.harness.event(egui::Event::MouseWheel {
                unit: egui::MouseWheelUnit::Point,
                delta: vec2(0.0, -200.0),
                phase: egui::TouchPhase::Move,
                source: egui::MouseWheelSource::Wheel,
                modifiers: Modifiers::NONE,
            });
            scene.work(1, 20.0);
        }
        scene.work(20, 20.0);
        scene.save("plan-landmarks-below");
    }
    if wanted("panels") {
        let mut scene = flown(wide, 40.0);
        scene.key(Modifiers::NONE, Key::F);
        scene.work(80, 20.0);
        scene.tab("Landmarks");
        let name = {
            let app = scene.harness.state().app.as_ref().expect("drawn");
            let state: serde_json::Value =
                serde_json::from_str(&app.state_json()).expect("the app writes JSON");
            state["landmarks"][0]["name"]
                .as_str()
                .unwrap_or_default()
                .to_owned()
        };
        scene.click(&name);
        scene.work(60, 20.0);
        scene.save("landmarks");
        scene.click("Filter settings");
        scene.save("settings");
        scene.click("Close");
        scene.key(Modifiers::COMMAND, Key::K);
        scene.save("palette");
        scene.key(Modifiers::NONE, Key::Escape);
        scene.key(Modifiers::NONE, Key::M);
        scene.save("simulate");
        scene.key(Modifiers::NONE, Key::Escape);
        scene.key(Modifiers::NONE, Key::Questionmark);
        scene.save("help");
        scene.key(Modifiers::NONE, Key::Escape);
        scene.tab("Learn");
        scene.work(40, 20.0);
        scene.save("learn");
        scene.click("View");
        scene.save("view menu");
        scene.click("Dark or light");
        scene.tab("Replay");
        scene.work(10, 20.0);
        scene.save("light");
    }
}
