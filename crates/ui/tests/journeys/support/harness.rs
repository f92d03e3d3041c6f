//! The app in a window, driven by role and label.

use std::time::Duration;

use egui::{Key, Modifiers, Pos2, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use pilotage_ui::app::App;
use serde_json::Value;

use super::host::ScriptedHost;

/// Margin that the harness leaves free around the app, both sides together.
pub const MARGIN: Vec2 = Vec2::splat(16.0);

/// The app and its host.
pub struct Page {
    /// The app.
    pub app: Option<App>,
    /// The host.
    pub host: ScriptedHost,
}

/// A window with the app in it.
pub struct Rig {
    /// The window.
    pub harness: Harness<'static, Page>,
}

/// The app in a window of 1440 × 900, with the demo flown and paused.
pub fn rig() -> Rig {
    rig_on(ScriptedHost::default(), Vec2::new(1440.0, 900.0))
}

/// The app on a host in a window of a size.
pub fn rig_on(mut host: ScriptedHost, size: Vec2) -> Rig {
    host.begin_visit();
    let page = Page { app: None, host };
    let harness = Harness::builder().with_size(size + MARGIN).build_ui_state(
        |ui, page: &mut Page| {
            page.host.now += 16.0;
            let app = page
                .app
                .get_or_insert_with(|| App::new(ui.ctx(), &page.host));
            app.ui(ui, &mut page.host);
        },
        page,
    );
    let mut rig = Rig { harness };
    rig.frames(3);
    rig.key(Key::Space);
    rig
}

impl Rig {
    /// Draws frames.
    pub fn frames(&mut self, count: usize) {
        for _ in 0..count {
            self.harness.step();
        }
    }

    /// Lets time pass so that everything that waits is due. As in a browser, a frame that nothing asks for is not drawn.
    pub fn settle(&mut self) {
        for _ in 0..4 {
            self.harness.state_mut().host.now += 1000.0;
            for _ in 0..3 {
                self.frames(1);
                if self.is_still() {
                    break;
                }
            }
        }
    }

    /// Whether the host has nothing to hand over, and the app asks for no frame within a second.
    fn is_still(&mut self) -> bool {
        let host = self.host();
        let hands_over = !host.events.is_empty() || !host.opened.is_empty();
        let output = self.harness.output().viewport_output.values();
        let asks = output
            .map(|view| view.repaint_delay)
            .any(|delay| delay < Duration::from_secs(1));
        !hands_over && !asks
    }

    /// Opens a tab.
    pub fn open_tab(&mut self, label: &str) {
        self.harness
            .get_by_role_and_label(egui::accesskit::Role::Tab, label)
            .click();
        self.frames(3);
    }

    /// Chooses from a menu of the top bar.
    pub fn menu(&mut self, menu: &str, item: &str) {
        self.harness.get_by_label(menu).click();
        self.frames(3);
        self.harness.get_by_label(item).click();
        self.frames(3);
    }

    /// Presses a key.
    pub fn key(&mut self, key: Key) {
        self.harness.key_press(key);
        self.frames(2);
    }

    /// Presses a key several times within one frame, as a fast hand does on a slow machine.
    pub fn key_times(&mut self, key: Key, times: usize) {
        for pressed in [true, false].repeat(times) {
            self.harness.input_mut().events.push(egui::Event::Key {
                key,
                physical_key: None,
                pressed,
                repeat: false,
                modifiers: Modifiers::NONE,
            });
        }
        self.frames(2);
    }

    /// Presses a key with modifiers.
    pub fn key_with(&mut self, modifiers: Modifiers, key: Key) {
        self.harness.key_press_modifiers(modifiers, key);
        self.frames(2);
    }

    /// Drags the pointer.
    pub fn drag(&mut self, from: Pos2, to: Pos2) {
        self.harness.hover_at(from);
        self.frames(1);
        self.harness.drag_at(from);
        self.frames(1);
        for part in 1..=5 {
            self.harness
                .hover_at(from + (part as f32 / 5.0) * (to - from));
            self.frames(1);
        }
        self.harness.drop_at(to);
        self.frames(2);
    }

    /// Drags the pointer with modifiers.
    pub fn drag_with(&mut self, modifiers: Modifiers, from: Pos2, to: Pos2) {
        let change = egui::Event::ModifiersChanged;
        self.harness.event(change(modifiers));
        self.drag(from, to);
        self.harness.event(change(Modifiers::NONE));
        self.frames(1);
    }

    /// The app's state, in which no fault of the program is told.
    pub fn state(&self) -> Value {
        let state = self.state_at_fault();
        let toasts = state["toasts"].to_string();
        assert!(!toasts.contains("a fault of the program"), "{toasts}");
        state
    }

    /// The app's state, whatever it tells.
    pub fn state_at_fault(&self) -> Value {
        let app = self.harness.state().app.as_ref().expect("drawn once");
        serde_json::from_str(&app.state_json()).expect("the app writes JSON")
    }

    /// The host.
    pub fn host(&mut self) -> &mut ScriptedHost {
        &mut self.harness.state_mut().host
    }

    /// A rectangle of the state.
    pub fn rect(&self, pointer: &str) -> egui::Rect {
        let state = self.state();
        let value = state.pointer(pointer).expect("a rectangle");
        let at = |i: usize| value[i].as_f64().expect("a number") as f32;
        egui::Rect::from_min_max(Pos2::new(at(0), at(1)), Pos2::new(at(2), at(3)))
    }
}
