//! Fingers or a pointer.

use egui::{Event, InputState};

/// Whether fingers press what is on screen, by what came in this frame; as it was `before` if nothing of that did.
pub fn is_touched(input: &InputState, before: bool) -> bool {
    let has = |is: fn(&Event) -> bool| input.events.iter().any(is);
    // Fingers move the pointer, too.
    if input.any_touches() || has(|event| matches!(event, Event::Touch { .. })) {
        return true;
    }
    before && !has(|event| matches!(event, Event::PointerMoved(_)))
}

#[cfg(test)]
mod tests {
    use egui::{Context, RawInput, TouchDeviceId, TouchId, TouchPhase, pos2};

    use super::*;

    #[test]
    fn the_last_that_moved_is_what_people_use() {
        let context = Context::default();
        let mut is_now = false;
        let mut after = |events: Vec<Event>| {
            let input = RawInput {
                events,
                ..RawInput::default()
            };
            let mut output = context.run_ui(input, |ui| {
                is_now = ui.input(|input| is_touched(input, is_now));
            });
            output.textures_delta.clear();
            is_now
        };
        let at = pos2(5.0, 5.0);
        let touch = |phase| Event::Touch {
            device_id: TouchDeviceId(1),
            id: TouchId(1),
            phase,
            pos: at,
            force: None,
        };
        let moved = || Event::PointerMoved(at);
        assert!(!after(vec![moved()]));
        assert!(after(vec![touch(TouchPhase::Start), moved()]));
        assert!(after(vec![moved()]), "the finger moves on");
        assert!(after(vec![touch(TouchPhase::End), Event::PointerGone]));
        assert!(after(Vec::new()), "nothing moves");
        assert!(!after(vec![moved()]), "a mouse moves");
    }
}
