//! Rows and what they were announced as.

use std::collections::HashMap;

use super::super::px4_modes;
use super::super::{FieldKind, FieldLayout, Log, ModeChange, TopicName};
use super::definition::{Definitions, RowLength};

/// Most fields of all topics together. Names take more memory than the rows of a file made to harm.
const MOST_FIELDS: usize = 1 << 20;
/// The year 2000 in microseconds since 1970: no receiver is older, and one without time says 0.
const YEAR_2000: f64 = 946_684_800e6;
/// Times further apart do not follow one another, seconds.
const DAY: f64 = 86_400.0;
/// Type of fix from which on a receiver has a position in space.
const FIX_IN_SPACE: f64 = 3.0;

/// Subscription of rows with one number.
struct Subscription {
    name: TopicName,
    length: Option<RowLength>,
    opened: OpenedTopic,
}

enum OpenedTopic {
    NotYet,
    Refused,
    At(Box<RowTopic>),
}

/// Topic of rows, and their fields that tell more than a row.
struct RowTopic {
    topic: usize,
    timestamp: Option<FieldLayout>,
    navigation_state: Option<FieldLayout>,
    utc: Option<FieldLayout>,
    fix: Option<FieldLayout>,
}

/// Subscriptions that were announced, and the state that the rows so far have told.
#[derive(Default)]
pub(super) struct Subscriptions {
    by_number: HashMap<u16, Subscription>,
    fields: usize,
    mode: Option<u8>,
    has_utc_of_fix: bool,
    /// Time of the last row, seconds.
    last: Option<f64>,
}

/// Agreement of a row with its announcement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RowFit {
    /// It does.
    Yes,
    /// Its number was never announced, or of what cannot be read.
    Unknown,
    /// It has another length.
    No,
}

impl Subscriptions {
    /// Rows with `number` are of that name from now on. A name without a definition that makes sense is
    /// refused.
    pub fn announce(
        &mut self,
        number: u16,
        name: TopicName,
        definitions: &mut Definitions,
        log: &mut Log,
    ) {
        let length = definitions.row_length(&name.name);
        if length.is_none() {
            log.report
                .remark(format!("{}: no definition that makes sense", name.name));
        }
        let subscription = Subscription {
            name,
            length,
            opened: OpenedTopic::NotYet,
        };
        self.by_number.insert(number, subscription);
    }

    /// Forgets what was announced: another log begins.
    pub fn forget(&mut self) {
        self.by_number.clear();
    }

    /// Tells whether a row of `length` bytes with that number is as announced.
    pub fn fit(&self, number: u16, length: usize) -> RowFit {
        let subscription = self.by_number.get(&number);
        let Some(expected) = subscription.and_then(|subscription| subscription.length) else {
            return RowFit::Unknown;
        };
        if (expected.shortest..=expected.longest).contains(&length) {
            RowFit::Yes
        } else {
            RowFit::No
        }
    }

    /// Stores a row that fits. `time` is the latest time so far, seconds, and moves on with the row's.
    /// Returns whether the row was stored.
    pub fn store(
        &mut self,
        number: u16,
        row: &[u8],
        definitions: &mut Definitions,
        time: &mut f64,
        log: &mut Log,
    ) -> bool {
        let Some(subscription) = self.by_number.get_mut(&number) else {
            return false;
        };
        if matches!(subscription.opened, OpenedTopic::NotYet) {
            let place = open(&subscription.name, &mut self.fields, definitions, log);
            subscription.opened = place.map_or(OpenedTopic::Refused, |place| {
                OpenedTopic::At(Box::new(place))
            });
        }
        let OpenedTopic::At(place) = &subscription.opened else {
            return false;
        };
        let microseconds = place.timestamp.as_ref().and_then(|field| field.value(row));
        let own = microseconds.map_or(*time, |t| t / 1e6);
        // Two rows of one day in a row: one wrong time moves nothing on.
        if self.last.is_none_or(|last| (own - last).abs() < DAY) {
            let is_of_day = (own - *time).abs() < DAY;
            *time = if is_of_day { time.max(own) } else { own };
        }
        self.last = Some(own);
        log.topics[place.topic].push(own, row);
        let value = |field: &Option<FieldLayout>| field.as_ref().and_then(|field| field.value(row));
        if let Some(state) = value(&place.navigation_state)
            && self.mode != Some(state as u8)
        {
            self.mode = Some(state as u8);
            let name = px4_modes::of_navigation_state(state as u8);
            log.modes.push(ModeChange {
                time: own,
                mode: name.map_or_else(|| state.to_string(), str::to_owned),
            });
        }
        if !self.has_utc_of_fix
            && let Some(utc) = value(&place.utc).filter(|utc| *utc > YEAR_2000)
        {
            // A receiver without a fix may have the time of its own clock only.
            self.has_utc_of_fix = value(&place.fix).is_some_and(|fix| fix >= FIX_IN_SPACE);
            if self.has_utc_of_fix || log.utc_at_zero.is_none() {
                log.utc_at_zero = Some(utc / 1e6 - own);
            }
        }
        true
    }
}

/// Makes the topic of that name, or finds it; `None` (and a remark) where it cannot be.
fn open(
    name: &TopicName,
    fields_so_far: &mut usize,
    definitions: &mut Definitions,
    log: &mut Log,
) -> Option<RowTopic> {
    let Some(fields) = definitions.fields(&name.name) else {
        log.report
            .remark(format!("{}: a definition of too many fields", name.name));
        return None;
    };
    if *fields_so_far + fields.len() > MOST_FIELDS {
        log.report.remark("rows are left out: too many fields");
        return None;
    }
    let topic = log.topic_or_new(name, || fields.clone());
    if log.topics[topic].fields != fields {
        log.report.remark(format!(
            "{name}: rows of a second, different definition are left out"
        ));
        return None;
    }
    if log.topics[topic].is_empty() {
        *fields_so_far += fields.len();
    }
    let field = |name: &str| fields.iter().find(|field| field.name == name).cloned();
    let is_whole = |field: &FieldLayout| field.kind == FieldKind::U64;
    let is_receiver = matches!(name.name.as_str(), "vehicle_gps_position" | "sensor_gps");
    let is_status = name.name == "vehicle_status" && name.instance == Some(0);
    Some(RowTopic {
        topic,
        timestamp: field("timestamp").filter(|field| field.kind.is_number()),
        navigation_state: field("nav_state").filter(|_| is_status),
        utc: field("time_utc_usec").filter(|field| is_receiver && is_whole(field)),
        fix: field("fix_type"),
    })
}
