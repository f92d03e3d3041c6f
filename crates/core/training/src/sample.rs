//! Windows of ground cut from photos for training: one that is the landmark, and many that are not.

use super::envelope::FlightEnvelope;
use super::photo::{Assumed, TrainingPhoto};
use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{IntegralImage, Raster};
use pilotage_vision::landmark::cascade::Patch;
use pilotage_vision::landmark::trained::{DetectorWindow, Variant, to_bytes};
use pilotage_vision::landmark::{FrameView, rectify};

/// Share of the window's sides next to the landmark where a window is neither it nor something else.
const DOUBTFUL: f64 = 0.33;

/// The ground around a place as a detector is shown it.
pub struct TrainingSample {
    /// Grey levels.
    pub picture: Raster<u8>,
    /// Upper left corner of the window that is the landmark, if it is there.
    pub landmark: Option<(usize, usize)>,
    /// Mask: 1 for each window by its upper left corner that is something else, 0 for the others.
    pub others: Raster<u8>,
    size: (usize, usize),
}

impl TrainingSample {
    /// Of a photo in a variant, within `reach` metres of the place where the box appears; `phase` says by
    /// which parts of a pixel (east, south), -0.5 to 0.5, the windows miss it. In another variant than
    /// that which fits best there is no landmark, but what is around it is something else all the same.
    /// `None` where the box does not appear on the ground.
    pub fn of(
        photo: &TrainingPhoto,
        assumed: &Assumed,
        envelope: &FlightEnvelope,
        shown: &DetectorWindow,
        variant: &Variant,
        reach: f64,
        phase: (f64, f64),
    ) -> Option<Self> {
        let ground_down = envelope.ground_down;
        let view = FrameView {
            pose: variant.pose(&assumed.pose, ground_down),
            ..photo.view(assumed, ground_down)
        };
        let appears = photo.appears(&view.pose, ground_down)?;
        let best = shown
            .variants
            .nearest(assumed.rotation(), assumed.log_scale);
        let around = (reach / shown.gsd).ceil() as usize;
        let size = (shown.width, shown.height);
        let half = |side: usize| (0.5 * side as f64 + around as f64) * shown.gsd;
        let middle = GroundPoint::new(
            appears.north + phase.1 * shown.gsd,
            appears.east - phase.0 * shown.gsd,
        );
        let window = Window {
            north_edge: middle.north + half(size.1),
            west_edge: middle.east - half(size.0),
            gsd: shown.gsd,
            width: size.0 + 2 * around,
            height: size.1 + 2 * around,
        };
        let ground = rectify(&view, &window);
        let seen = (!ground.complete).then(|| IntegralImage::new(&ground.seen));
        let whole = (size.0 * size.1) as f64 - 0.5;
        let is_seen = |x: usize, y: usize| {
            seen.as_ref()
                .is_none_or(|s| s.sum(x, y, size.0, size.1) >= whole)
        };
        let near = (DOUBTFUL * size.0 as f64, DOUBTFUL * size.1 as f64);
        let others = Raster::from_fn(2 * around + 1, 2 * around + 1, |x, y| {
            let (dx, dy) = (x.abs_diff(around) as f64, y.abs_diff(around) as f64);
            let is_landmark = photo.present && dx <= near.0 && dy <= near.1;
            u8::from(is_seen(x, y) && !is_landmark)
        });
        let whole_in_picture = is_seen(around, around);
        let shows = photo.present && whole_in_picture && *variant == best;
        Some(Self {
            picture: to_bytes(&ground),
            landmark: shows.then_some((around, around)),
            others,
            size,
        })
    }

    /// The window with that upper left corner.
    pub fn patch(&self, (column, row): (usize, usize)) -> Option<Patch> {
        Patch::cut(&self.picture, column, row, self.size.0, self.size.1)
    }
}
