//! Keeps the accessibility tree of the last frame, which eframe drops on the web, and hands the app what is asked of
//! its nodes: `www/mirror.js` shows the tree to screen readers, browser tests find widgets by role and name.

use core::mem;

use egui::accesskit::{Action, ActionData, ActionRequest, Node, NodeId, Role, TreeId, TreeUpdate};
use egui::{Event, Key, Modifiers};
use serde_json::{Value, json};

/// Plugin that keeps the tree.
#[derive(Default)]
pub struct KeptTree {
    update: Option<TreeUpdate>,
    /// Whether a frame was drawn since the tree was told last.
    is_fresh: bool,
    /// The lines that were told last.
    told: String,
    /// Events for the next frame.
    asked: Vec<Event>,
}

impl egui::Plugin for KeptTree {
    fn debug_name(&self) -> &'static str {
        "kept accessibility tree"
    }

    fn input_hook(&mut self, _context: &egui::Context, input: &mut egui::RawInput) {
        input.events.append(&mut self.asked);
    }

    fn output_hook(&mut self, _context: &egui::Context, output: &mut egui::FullOutput) {
        if let Some(update) = output.platform_output.accesskit_update.take() {
            self.update = Some(update);
            self.is_fresh = true;
        }
    }
}

impl KeptTree {
    /// Tells the whole tree at the next call of [`KeptTree::changed_lines`].
    pub fn tell_again(&mut self) {
        self.told.clear();
        self.is_fresh = self.update.is_some();
    }

    /// Node that is to have the keyboard from the next frame on, if one was asked to.
    fn asked_focus(&self) -> Option<NodeId> {
        let mut asked = self.asked.iter().rev();
        asked.find_map(|event| match event {
            Event::AccessKitActionRequest(request) if request.action == Action::Focus => {
                Some(request.target_node)
            }
            _ => None,
        })
    }

    /// The tree for `www/mirror.js`: on the first line the node that has the keyboard or was asked to have it, then a JSON list for each node
    /// that can be named or used, in the tree's order. Empty if nothing changed since the last call. `zoom` is CSS
    /// pixels per point.
    pub fn changed_lines(&mut self, zoom: f64) -> String {
        let fresh = mem::take(&mut self.is_fresh);
        let Some(TreeUpdate { nodes, focus, .. }) = self.update.as_ref().filter(|_| fresh) else {
            return String::new();
        };
        let mut lines = self.asked_focus().unwrap_or(*focus).0.to_string();
        let mut waiting = vec![(egui::accesskit_root_id().accesskit_id(), 0)];
        while let Some((id, depth)) = waiting.pop() {
            let Some(node) = node_of(nodes, id) else {
                continue;
            };
            if let Some(line) = line(nodes, id, node, depth, zoom) {
                lines.push('\n');
                lines.push_str(&line);
            }
            waiting.extend(node.children().iter().rev().map(|id| (*id, depth + 1)));
        }
        if lines == self.told {
            return String::new();
        }
        self.told.clone_from(&lines);
        lines
    }

    /// Asks an action of a node: one by its name in AccessKit, or its value as a text or a number.
    pub fn ask(&mut self, node: u64, action: &str, text: Option<String>, number: Option<f64>) {
        let action = match action {
            "Click" => Action::Click,
            "Focus" => Action::Focus,
            "Increment" => Action::Increment,
            "Decrement" => Action::Decrement,
            _ => Action::SetValue,
        };
        let text = text.map(|text| ActionData::Value(text.into()));
        let mut request = ActionRequest {
            action,
            target_tree: TreeId::ROOT,
            target_node: node.into(),
            data: text.or(number.map(ActionData::NumericValue)),
        };
        if action == Action::Focus {
            let shown = request.clone();
            self.asked.push(Event::AccessKitActionRequest(shown));
            request.action = Action::ScrollIntoView;
        }
        self.asked.push(Event::AccessKitActionRequest(request));
    }

    /// Presses a key and lets it go.
    pub fn press(&mut self, key: &str, shift: bool, command: bool) {
        let Some(key) = Key::from_name(key) else {
            return;
        };
        let modifiers = Modifiers {
            shift,
            ctrl: command,
            command,
            ..Modifiers::NONE
        };
        self.asked.extend([true, false].map(|pressed| Event::Key {
            key,
            physical_key: None,
            pressed,
            repeat: false,
            modifiers,
        }));
    }
}

fn node_of(nodes: &[(NodeId, Node)], id: NodeId) -> Option<&Node> {
    Some(&nodes.iter().find(|(other, _)| *other == id)?.1)
}

/// The line of a node: id, depth, role, name, value, number, least, greatest, toggled, expanded, then whether it is
/// disabled, focusable, clickable, settable, to be incremented, to be decremented, read-only, and its left, top, width
/// and height in CSS pixels. `None` for what has neither name nor use.
fn line(
    nodes: &[(NodeId, Node)],
    id: NodeId,
    node: &Node,
    depth: usize,
    zoom: f64,
) -> Option<String> {
    let role = node.role();
    let label = node
        .labelled_by()
        .first()
        .and_then(|by| node_of(nodes, *by));
    let name = (node.label()).or_else(|| label.and_then(|label| label.label().or(label.value())));
    let is_used = node.supports_action(Action::Click) || node.supports_action(Action::Focus);
    let holds = matches!(role, Role::Dialog | Role::ListBox);
    if matches!(role, Role::TextRun | Role::ScrollBar)
        || !(name.is_some() || node.value().is_some() || is_used || holds)
    {
        return None;
    }
    let is = [
        node.is_disabled(),
        node.supports_action(Action::Focus),
        node.supports_action(Action::Click),
        node.supports_action(Action::SetValue),
        node.supports_action(Action::Increment),
        node.supports_action(Action::Decrement),
        node.is_read_only(),
    ];
    let place = node.bounds();
    let place = place.map(|b| [b.x0, b.y0, b.x1 - b.x0, b.y1 - b.y0].map(|l| (zoom * l).round()));
    let line = json!([
        id.0.to_string(),
        depth,
        format!("{role:?}"),
        name,
        node.value(),
        node.numeric_value(),
        node.min_numeric_value(),
        node.max_numeric_value(),
        node.toggled().map(|t| format!("{t:?}")),
        node.is_expanded(),
        is,
        place,
    ]);
    Some(line.to_string())
}

/// The named nodes of the last frame as a JSON list; `rect` is left, top, right, bottom in pixels
/// of the canvas.
pub fn tree_json(context: &egui::Context) -> String {
    let pixels_per_point = f64::from(context.pixels_per_point());
    let list = context.with_plugin(|plugin: &mut KeptTree| {
        let nodes = plugin.update.iter().flat_map(|update| &update.nodes);
        let focus = plugin.update.as_ref().map(|update| update.focus);
        let named = nodes.filter(|(_, node)| node.label().is_some() || node.value().is_some());
        let list = named.map(|(id, node)| {
            json!({
                "id": id.0.to_string(),
                "role": format!("{:?}", node.role()),
                "label": node.label(),
                "value": node.value(),
                "number": node.numeric_value(),
                "toggled": node.toggled().map(|t| format!("{t:?}")),
                "disabled": node.is_disabled(),
                "focused": focus == Some(*id),
                "rect": node.bounds().map(|b| [b.x0, b.y0, b.x1, b.y1]),
                "pixels_per_point": pixels_per_point,
            })
        });
        list.collect()
    });
    Value::Array(list.unwrap_or_default()).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_keyboard_is_told_where_it_was_asked_to_be_before_the_frame_that_moves_it() {
        let context = egui::Context::default();
        context.add_plugin(KeptTree::default());
        context.enable_accesskit();
        let frame = || {
            let mut second = None;
            let mut output = context.run_ui(egui::RawInput::default(), |ui| {
                let _ = ui.button("one");
                second = Some(ui.button("two").id.accesskit_id());
            });
            output.textures_delta.clear();
            second.expect("it was drawn").0
        };
        let second = frame();
        let told = || {
            let lines = context.with_plugin(|tree: &mut KeptTree| tree.changed_lines(1.0));
            let lines = lines.expect("the plugin is there");
            lines.lines().next().map(str::to_owned)
        };
        let before = told().expect("a tree");
        assert_ne!(before, second.to_string());
        frame();
        context.with_plugin(|tree: &mut KeptTree| tree.ask(second, "Focus", None, None));
        assert_eq!(told(), Some(second.to_string()));
        frame();
        // It is there by now, so that nothing has changed.
        assert_eq!(told(), None);
    }
}
