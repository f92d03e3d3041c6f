//! Keeps the accessibility tree of the last frame, which eframe drops on the web, so that browser
//! tests find widgets by role and name.

use egui::accesskit::Node;
use serde_json::{Value, json};

/// Plugin that keeps the tree.
#[derive(Default)]
pub struct KeptTree {
    nodes: Vec<(u64, Node)>,
}

impl egui::Plugin for KeptTree {
    fn debug_name(&self) -> &'static str {
        "kept accessibility tree"
    }

    fn output_hook(&mut self, _context: &egui::Context, output: &mut egui::FullOutput) {
        if let Some(update) = &output.platform_output.accesskit_update {
            self.nodes = update
                .nodes
                .iter()
                .map(|(id, node)| (id.0, node.clone()))
                .collect();
        }
    }
}

/// The named nodes of the last frame as a JSON list; `rect` is left, top, right, bottom in pixels
/// of the canvas.
pub fn tree_json(context: &egui::Context) -> String {
    let nodes = context
        .with_plugin(|plugin: &mut KeptTree| plugin.nodes.clone())
        .unwrap_or_default();
    let pixels_per_point = f64::from(context.pixels_per_point());
    let list: Vec<Value> = nodes
        .iter()
        .filter(|(_, node)| node.label().is_some() || node.value().is_some())
        .map(|(id, node)| {
            json!({
                "id": id.to_string(),
                "role": format!("{:?}", node.role()),
                "label": node.label(),
                "value": node.value(),
                "number": node.numeric_value(),
                "toggled": node.toggled().map(|t| format!("{t:?}")),
                "disabled": node.is_disabled(),
                "rect": node.bounds().map(|b| [b.x0, b.y0, b.x1, b.y1]),
                "pixels_per_point": pixels_per_point,
            })
        })
        .collect();
    Value::from(list).to_string()
}
