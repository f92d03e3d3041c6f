use egui::{ColorImage, Key, Modifiers, ViewportCommand, ViewportId};
use image::{Rgba, RgbaImage};

use super::support::rig;

/// The pixels of a window in which every one is of another colour than its neighbours.
fn screen([width, height]: [usize; 2]) -> RgbaImage {
    RgbaImage::from_fn(width as u32, height as u32, |x, y| {
        Rgba([x as u8, y as u8, (x / 7 + y) as u8, 255])
    })
}

#[test]
fn a_picture_of_the_screen_is_saved_as_it_is_after_the_palette_is_gone() {
    let mut rig = rig();
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness.event(egui::Event::Text("screenshot".into()));
    rig.frames(2);
    // Within one frame, of which the harness keeps what it asked for.
    let press = egui::Event::Key {
        key: Key::Enter,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::NONE,
    };
    rig.harness.input_mut().events.push(press);
    let asked = (0..4).find_map(|_| {
        rig.frames(1);
        let viewport = rig
            .harness
            .output()
            .viewport_output
            .get(&ViewportId::ROOT)?;
        viewport.commands.iter().find_map(|command| match command {
            ViewportCommand::Screenshot(callback) => Some(callback.clone()),
            _ => None,
        })
    });
    let asked = asked.expect("a picture of the frame is asked for");
    rig.frames(1);
    assert_eq!(rig.state()["dialogs"]["palette"], false);
    assert!(rig.host().saved.is_empty(), "there is nothing to save yet");
    let window = rig.harness.ctx.content_rect().size();
    let size = [window.x as usize, window.y as usize];
    let pixels = screen(size);
    asked.complete(ColorImage::from_rgba_unmultiplied(size, &pixels).into());
    rig.frames(2);
    let (name, png) = rig.host().saved.pop().expect("a file");
    assert_eq!(name, "Village-in-wind-0-00-3.png");
    let saved = image::load_from_memory(&png).expect("a picture");
    assert!(
        saved.into_rgba8() == pixels,
        "another picture than that of the screen"
    );
    assert_eq!(rig.state()["toasts"][0]["title"], "Picture saved");
    rig.frames(3);
    assert!(rig.host().saved.is_empty(), "one picture is one file");
}
