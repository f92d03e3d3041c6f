//! Surroundings of the views: look, top bar, palette, help, notices.

mod bar_menu;
pub mod catalog;
mod clicks;
mod entry;
mod fonts;
mod help;
mod hud;
pub mod icons;
pub mod keys;
mod notices;
mod number_field;
mod of_before;
mod palette;
pub mod search;
mod sentences;
mod theme;
mod toasts;
mod top_bar;
mod touch;
mod widgets;

pub use clicks::keep_slow_clicks;
pub use entry::{CommandLack, MenuTable};
pub use fonts::fonts;
pub use help::help_sheet;
pub use hud::{BELOW_HUD, Headline, Light, Readout, hud};
pub use notices::notices_sheet;
pub use number_field::NumberField;
pub use of_before::{FADED, of_before, of_before_again};
pub use palette::Palette;
pub use sentences::{counted, sentences, whole_sentences};
pub use theme::apply_theme;
pub use toasts::{Toast, Toasts};
pub use top_bar::{NextStep, TopBar, top_bar};
pub use touch::is_touched;
pub use widgets::{
    at_right, at_work, caption, chip, column_tabs, heading, icon_button, icon_toggle, is_entered,
    muted, paint_focus_ring, paint_row, reading, tab, text_button, title,
};
