//! Longest press that is a click.

/// Lets presses of a mouse be clicks however long they last, and those of a finger the usual while.
///
/// The toolkit takes a press and its release for no click where 0.8 s lie between the frames that see them, so that
/// on a machine whose frames take long, clicks are lost. It needs that limit only for fingers, whose long press asks
/// for a menu.
pub fn keep_slow_clicks(context: &egui::Context) {
    let is_touched = context.input(egui::InputState::any_touches);
    let usual = egui::InputOptions::default().max_click_duration;
    let longest = if is_touched { usual } else { f64::INFINITY };
    context.options_mut(|options| options.input_options.max_click_duration = longest);
}

#[cfg(test)]
mod tests {
    use egui::{Event, Modifiers, PointerButton, RawInput, Sense, pos2, vec2};

    use super::*;

    /// Whether a button takes a press and its release, in two frames that lie that many seconds apart, for a click.
    fn is_click(seconds: f64, keeps: bool) -> bool {
        let context = egui::Context::default();
        let at = pos2(20.0, 20.0);
        let mut clicked = false;
        let mut frame = |time: f64, events: Vec<Event>| {
            let input = RawInput {
                time: Some(time),
                events,
                ..RawInput::default()
            };
            let mut output = context.run_ui(input, |ui| {
                if keeps {
                    keep_slow_clicks(ui.ctx());
                }
                let (_, response) = ui.allocate_exact_size(vec2(200.0, 200.0), Sense::click());
                clicked |= response.clicked();
            });
            output.textures_delta.clear();
        };
        let button = |pressed| Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        frame(0.0, vec![Event::PointerMoved(at)]);
        frame(0.1, vec![button(true)]);
        frame(0.1 + seconds, vec![button(false)]);
        frame(0.2 + seconds, vec![]);
        clicked
    }

    #[test]
    fn a_press_is_a_click_however_slow_the_frames_are() {
        assert!(is_click(0.1, true));
        assert!(is_click(0.1, false));
        assert!(is_click(3.0, true));
        assert!(
            !is_click(3.0, false),
            "the toolkit no longer loses slow clicks: drop this"
        );
    }
}
