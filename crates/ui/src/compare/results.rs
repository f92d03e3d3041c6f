//! The comparisons on screen, made anew when what they depend on has changed.

use pilotage_core::flight::Flight;
use pilotage_core::flight::trajectory::{
    ComparisonSettings, NotComparable, Trajectory, TrajectoryComparison, compare,
};
use pilotage_core::frames::GroundPoint;
use pilotage_core::navigator::{Run, StepReport};

use super::command::TrackId;
use super::contest::ContestState;
use super::shelf::Shelf;
use crate::context::ViewContext;

/// Share by which a run grows before it is compared again while it goes on.
const GROWTH: f64 = 1.25;

/// A trajectory beside the reference.
pub(super) struct ResultRow {
    pub id: TrackId,
    pub name: String,
    /// `None` for the reference itself.
    pub comparison: Option<Result<TrajectoryComparison, NotComparable>>,
}

/// Key of the comparisons: everything that they depend on.
#[derive(Clone, Debug, PartialEq)]
struct Key {
    settings: ComparisonSettings,
    reference: TrackId,
    generations: [u64; 2],
    kept: Vec<u32>,
}

/// The comparisons on screen.
#[derive(Default)]
pub(super) struct Results {
    key: Option<Key>,
    /// Steps that the run had when it was compared, and whether it was over.
    steps: (usize, bool),
    pub rows: Vec<ResultRow>,
    /// Times that they were made.
    pub made: u64,
}

/// Trajectories that are open, apart from what every view is given.
pub struct CompareScene<'a> {
    /// Trajectories that were kept.
    pub shelf: &'a Shelf,
    /// Generations of the run and of its ghost.
    pub generations: [u64; 2],
    /// Whether the run is over.
    pub is_complete: bool,
    /// Every estimator on the flight that is open.
    pub contest: &'a ContestState,
    /// Progress of the run that is being smoothed, in words.
    pub smoothing: Option<&'a str>,
    /// Whether that judged the mission as it was before.
    pub is_contest_of_before: bool,
    /// Seconds since 1970 at the flight's time zero, where known.
    pub utc_at_zero: Option<f64>,
}

/// The trajectories of what is open; `utc_at_zero` as in [`CompareScene`]. A track that a log has recorded counts as the
/// truth and is not called so.
pub fn open_tracks(
    flight: Option<&Flight>,
    run: Option<&Run>,
    ghost: Option<&Run>,
    utc_at_zero: Option<f64>,
    is_recorded: bool,
) -> Vec<(TrackId, Trajectory)> {
    let frame = flight.and_then(|f| f.frame_on_globe);
    let of_run = |id, run: &Run, name: &str, place: fn(&StepReport) -> GroundPoint| {
        let places = run.steps.iter().map(|step| {
            let place = place(step);
            (step.time, place.north, place.east)
        });
        let mut track = Trajectory::on_the_ground(name.to_owned(), frame, places);
        track.utc_at_zero = utc_at_zero;
        (id, track)
    };
    let estimate = |step: &StepReport| step.after.position();
    let mut found = Vec::new();
    if let Some(mut truth) = flight.and_then(Trajectory::of_truth) {
        let name = if is_recorded {
            "Recorded track"
        } else {
            "Truth"
        };
        name.clone_into(&mut truth.name);
        truth.utc_at_zero = utc_at_zero;
        found.push((TrackId::Truth, truth));
    }
    if let Some(run) = run {
        found.push(of_run(TrackId::Run, run, "This run", estimate));
        let alone = "Dead reckoning alone";
        found.push(of_run(TrackId::Unaided, run, alone, |s| s.dead_reckoned));
    }
    found.extend(ghost.map(|ghost| of_run(TrackId::Ghost, ghost, "Previous run", estimate)));
    found
}

impl Results {
    /// Makes them anew if need be; the reference is `wanted`, or the first there is.
    pub fn update(
        &mut self,
        context: &ViewContext<'_>,
        scene: &CompareScene<'_>,
        settings: ComparisonSettings,
        wanted: TrackId,
    ) {
        let key = Key {
            settings,
            reference: wanted,
            generations: scene.generations,
            kept: scene.shelf.kept().iter().map(|k| k.number).collect(),
        };
        let steps = context.run.map_or(0, |run| run.steps.len());
        let (before, was_complete) = self.steps;
        let has_grown = steps as f64 >= GROWTH * before as f64 && steps != before;
        let is_over = scene.is_complete && !was_complete;
        if self.key.as_ref() == Some(&key) && !has_grown && !is_over {
            return;
        }
        self.key = Some(key);
        self.steps = (steps, scene.is_complete);
        let (flight, run, ghost) = (context.flight, context.run, context.ghost);
        let mut tracks = open_tracks(flight, run, ghost, scene.utc_at_zero, context.is_recorded);
        let kept = scene.shelf.kept().iter();
        tracks.extend(kept.map(|k| (TrackId::Kept(k.number), k.track.clone())));
        let reference = tracks.iter().position(|(id, _)| *id == wanted).unwrap_or(0);
        let against = |(i, (id, track)): (usize, &(TrackId, Trajectory))| ResultRow {
            id: *id,
            name: track.name.clone(),
            comparison: (i != reference).then(|| compare(&tracks[reference].1, track, &settings)),
        };
        self.rows = tracks.iter().enumerate().map(against).collect();
        self.made += 1;
    }

    /// The reference, if there is any trajectory.
    pub fn reference(&self) -> Option<&ResultRow> {
        self.rows.iter().find(|row| row.comparison.is_none())
    }
}
