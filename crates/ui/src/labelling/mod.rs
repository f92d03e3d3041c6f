//! Labelling: boxes put around landmarks in the pictures of a flight, by hand or from a proposal.

mod canvas;
mod catalog;
mod drag;
mod edit;
mod feature;
mod panel;
mod propose;

pub use feature::Labelling;

use egui::{Color32, Rect, Vec2};
use pilotage_core::exchange::labels::LabelFormat;
use pilotage_core::mission::{FrameLabels, LabelBox};

use crate::command::Command;
use crate::context::ViewContext;
use crate::feature_command::{FeatureCommand, FeatureId};

/// Identity of the feature.
const ID: FeatureId = "labelling";

/// Something about labels.
#[derive(Clone, Debug, PartialEq)]
pub enum LabelCommand {
    /// Begin to label the pictures of the flight, or stop.
    Toggle,
    /// Put a box into the picture of a frame; `finished` is false while a drag goes on.
    Set {
        /// Index of the frame in the flight.
        frame: usize,
        /// The box.
        label: LabelBox,
        /// Whether the drag is over (one undo step).
        finished: bool,
    },
    /// Take away what is said of the selected landmark in the picture.
    Delete,
    /// The selected landmark is certainly not in the picture.
    MarkAbsent,
    /// The selected landmark is hard to see in the picture, or is not.
    ToggleDifficult,
    /// Propose the box where the pose of the frame sees the selected landmark.
    Propose,
    /// Take the proposal.
    Accept,
    /// Select the landmark so many rows further down the list.
    Choose(i32),
    /// Save all labels as a file of other programs.
    Export(LabelFormat),
}

impl From<LabelCommand> for Command {
    fn from(command: LabelCommand) -> Self {
        Self::Feature(FeatureCommand::new(ID, command))
    }
}

/// Colours of landmarks: those of Okabe and Ito, which colour-blind people tell apart.
const COLORS: [Color32; 7] = [
    Color32::from_rgb(230, 159, 0),
    Color32::from_rgb(86, 180, 233),
    Color32::from_rgb(0, 158, 115),
    Color32::from_rgb(240, 228, 66),
    Color32::from_rgb(213, 94, 0),
    Color32::from_rgb(204, 121, 167),
    Color32::from_rgb(0, 114, 178),
];

/// The view in which pictures are labelled; the labels themselves are the mission's.
#[derive(Default)]
pub struct Labeller {
    /// Nearness beyond the whole picture: 0 shows all, each step doubles.
    nearness: f32,
    /// Shift of the picture's centre from the middle of the view, pixels.
    shift: Vec2,
    drag: Option<drag::BoxDrag>,
    /// Whether a box is proposed in every picture.
    always: bool,
    /// Frame and landmark for which a proposal was asked.
    asked: Option<(usize, u32)>,
    /// Frame and proposal that were drawn last.
    proposal: Option<(usize, LabelBox)>,
    /// Part of the screen on which the picture was drawn last, and its size in pixels.
    drawn: Option<(Rect, (u32, u32))>,
}

impl Labeller {
    /// Part of the screen on which the whole picture was drawn last.
    pub fn picture_rect(&self) -> Option<Rect> {
        self.drawn.map(|(rect, _)| rect)
    }

    /// The frame at the cursor and the proposal drawn for it.
    pub fn proposal(&self) -> Option<&(usize, LabelBox)> {
        self.proposal.as_ref()
    }

    /// Asks for a proposal.
    pub fn ask(&mut self, frame: usize, landmark: u32) {
        self.asked = Some((frame, landmark));
    }

    /// Asks for no proposal in this picture any more.
    pub fn decline(&mut self) {
        self.asked = None;
    }

    /// Works the proposal out anew for what is at the cursor.
    fn propose(&mut self, context: &ViewContext<'_>, frame: usize) {
        let found = || {
            let id = context.selection?;
            let is_asked = self.always || self.asked == Some((frame, id));
            if !is_asked || said_of(context, frame).is_some_and(|l| l.tells_of(id)) {
                return None;
            }
            propose::proposed(context, frame, context.mission.landmark(id)?)
        };
        self.proposal = found().map(|label| (frame, label));
    }
}

/// Labels of a frame of the flight that is open, in pixels of its camera.
fn said_of(context: &ViewContext<'_>, frame: usize) -> Option<FrameLabels> {
    let flight = context.flight?;
    let frame = flight.frames.get(frame)?;
    let said = context.mission.labels_of(&flight.identity(), &frame.name)?;
    Some(said.at_size((flight.camera.width as u32, flight.camera.height as u32)))
}

/// Colour of the landmark in that row of the list.
fn color(row: usize) -> Color32 {
    COLORS[row % COLORS.len()]
}

/// Colour of a landmark of the mission.
fn color_of(context: &ViewContext<'_>, id: u32) -> Color32 {
    let landmarks = &context.mission.landmarks;
    let row = landmarks.iter().position(|l| l.id == id);
    row.map_or(Color32::GRAY, color)
}
