//! When a message was written, seconds since the autopilot started.

use super::super::gps_time::utc_of_gps;
use super::super::{FieldKind, FieldLayout, Log, Topic};
use super::format::MessageFormat;
use pilotage_base::text::by_count;

/// Kind of fix from which on a receiver knows the time.
const FULL_FIX: f64 = 3.0;
/// Week of GPS before which there were no such logs: that of 3 January 2010.
const FIRST_WEEK: f64 = 1565.0;
/// Weeks after which receivers count from 0 again.
const ROLLOVER: f64 = 1024.0;
/// Most full fixes that are asked for the date.
const DATES: usize = 1000;
/// A fix that lies further from the one before it is believed once the next one follows it, seconds.
const DOUBTFUL: f64 = 60.0;
/// Longest pause between two fixes, seconds.
const DAY: f64 = 86_400.0;
/// Milliseconds of a week, at whose end receivers that tell no week begin anew, and those around its end.
const WEEK: f64 = 604_800_000.0;
const AROUND: f64 = 60_000.0;
/// Most rows between two fixes whose times are found later.
const WAITING: usize = 1 << 16;

/// Time field of a message.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stamp {
    kind: FieldKind,
    offset: usize,
    per_second: f64,
}

impl Stamp {
    /// The time field of a kind of message: `TimeUS`, or in older logs `TimeMS`, if it comes first, or
    /// milliseconds in the field `T` of satellite receivers, whose `TimeMS` counts from the week's
    /// beginning. `TimeMS` of raw samples is another clock's. Logs of PX4's older format tell the time in
    /// messages of its own.
    pub fn of(format: &MessageFormat) -> Option<Self> {
        let (columns, _) = format.fields();
        let name = format.name.as_str();
        let find = |name: &str| columns.iter().find(|c| c.name == name);
        let first = columns.first()?;
        let is_raw = name.starts_with("ACC") || name.starts_with("GYR");
        let (column, per_second) = match first.name.as_str() {
            "TimeUS" => (first, 1e6),
            "TimeMS" if !is_raw => (first, 1e3),
            _ if is_receiver(name) => (find("T")?, 1e3),
            _ if name == "TIME" => (find("StartTime")?, 1e6),
            _ => return None,
        };
        let is_whole = !matches!(
            column.letter.kind,
            FieldKind::F16 | FieldKind::F32 | FieldKind::F64
        );
        (column.letter.kind.is_number() && is_whole).then_some(Self {
            kind: column.letter.kind,
            offset: column.offset,
            per_second,
        })
    }

    /// The time in a message, seconds.
    #[inline]
    fn read(&self, body: &[u8]) -> Option<f64> {
        let number = self.kind.number(body.get(self.offset..)?)?;
        Some(number / self.per_second)
    }
}

/// Whether a kind of message is from a satellite receiver.
pub fn is_receiver(name: &str) -> bool {
    name == "GPS" || name == "GPS2"
}

/// Clock by which the times of a log are counted.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Base {
    /// Nothing told the time so far.
    None,
    /// The autopilot's clock.
    Start,
    /// Satellite time, where messages have no other; counted from the first fix, at these
    /// milliseconds since the first week of GPS began.
    Satellites(f64),
}

/// A fix far from the one before it.
#[derive(Clone, Copy, Debug)]
struct Doubted {
    /// Its time, seconds.
    time: f64,
    /// Rows that waited for it.
    rows: usize,
}

/// The clock of a log.
#[derive(Clone, Debug)]
pub struct Clock {
    base: Base,
    now: f64,
    /// Whether a receiver with a full fix told the date.
    is_dated: bool,
    /// Times of second zero by full fixes, seconds since 1970; the first thousand.
    dates: Vec<f64>,
    /// Rows since the last fix, by place of the topic and number, where only fixes tell the time.
    waiting: Vec<(usize, usize)>,
    /// A fix that the next one has to agree with.
    doubted: Option<Doubted>,
    /// Fixes that the next ones did not agree with.
    unheeded: usize,
    /// Milliseconds of the last fix without a week, and weeks that began since the first.
    last: f64,
    weeks: f64,
}

impl Clock {
    /// A clock that was told nothing.
    pub fn new() -> Self {
        Self {
            base: Base::None,
            now: 0.0,
            is_dated: false,
            dates: Vec::new(),
            waiting: Vec::new(),
            doubted: None,
            unheeded: 0,
            last: 0.0,
            weeks: 0.0,
        }
    }

    /// Time of a message, seconds: its own, or that of the last one that had any.
    #[inline]
    pub fn time(&mut self, stamp: Option<&Stamp>, body: &[u8], log: &mut Log) -> f64 {
        if let Some(stamp) = stamp
            && let Some(time) = stamp.read(body)
        {
            match self.base {
                Base::Start => self.now = time,
                Base::None => self.start(time, log),
                Base::Satellites(_) => {}
            }
        }
        self.now
    }

    /// Starts the clock at the first time, and gives that time to all that was read before.
    fn start(&mut self, time: f64, log: &mut Log) {
        self.base = Base::Start;
        self.now = time;
        for topic in &mut log.topics {
            topic.times.fill(time);
        }
        let parameters = log.parameters.iter_mut().map(|p| &mut p.time);
        let messages = log.messages.iter_mut().map(|m| &mut m.time);
        let modes = log.modes.iter_mut().map(|m| &mut m.time);
        for earlier in parameters.chain(messages).chain(modes) {
            *earlier = time;
        }
    }

    /// Notes where a row was put.
    #[inline]
    pub fn put(&mut self, place: usize, row: usize) {
        if matches!(self.base, Base::Satellites(_)) && self.waiting.len() < WAITING {
            self.waiting.push((place, row));
        }
    }

    /// Takes the date, and if need be the time, from the last row of a receiver's topic.
    pub fn fix(&mut self, place: usize, log: &mut Log) {
        let topic = &log.topics[place];
        let Some(row) = topic.len().checked_sub(1) else {
            return;
        };
        let value = |names: &[&str]| {
            let field = names.iter().find_map(|name| topic.field(name))?;
            of_receiver(topic, field, row)
        };
        let week = value(&["GWk", "Week", "Wk"]).filter(|week| *week > 0.0);
        let Some(milliseconds) = value(&["GMS", "TimeMS", "TWk", "Time"]) else {
            return;
        };
        if week.is_none() && milliseconds == 0.0 {
            return;
        }
        if week.is_none() {
            let has_begun = self.last > WEEK - AROUND && milliseconds < AROUND;
            self.weeks += f64::from(u8::from(has_begun));
            self.last = milliseconds;
        }
        let since_1980 = week.unwrap_or(self.weeks) * WEEK + milliseconds;
        self.satellites(since_1980, log);
        if matches!(self.base, Base::Satellites(_)) {
            log.topics[place].times[row] = self.now;
        }
        let Some(week) = week else {
            return;
        };
        let topic = &log.topics[place];
        let status = topic.field("Status").and_then(|f| topic.value(f, row));
        let is_full = status.is_none_or(|status| status >= FULL_FIX);
        let week = if is_full && week < FIRST_WEEK {
            log.report.remark(format!(
                "the receiver counts its weeks from {ROLLOVER} weeks before, as old ones do: the date is that many later"
            ));
            week + ROLLOVER
        } else {
            week
        };
        let utc = utc_of_gps(week, milliseconds) - log.topics[place].times[row];
        if is_full && self.dates.len() < DATES {
            self.dates.push(utc);
        }
        if log.utc_at_zero.is_none() || (is_full && !self.is_dated) {
            log.utc_at_zero = Some(utc);
            self.is_dated |= is_full;
        }
    }

    /// The log is over: a date that most full fixes contradict, as one damaged time makes it, gives way to theirs.
    pub fn settle(&mut self, log: &mut Log) {
        let unheeded = self.unheeded + usize::from(self.doubted.is_some());
        if unheeded > 0 {
            log.report.remark(format!(
                "{unheeded} {} far from those around it: rows have their times by the others",
                by_count(unheeded, "fix has a time", "fixes have times")
            ));
        }
        let mut dates = std::mem::take(&mut self.dates);
        dates.sort_by(f64::total_cmp);
        let Some(middle) = dates.get(dates.len() / 2).copied() else {
            return;
        };
        let agree = |date: &f64| (date - middle).abs() <= 1.0;
        let most = 2 * dates.iter().filter(|date| agree(date)).count() > dates.len();
        if self.is_dated && most && log.utc_at_zero.is_some_and(|utc| !agree(&utc)) {
            log.utc_at_zero = Some(middle);
        }
    }

    /// Spreads messages without a time of their own evenly over the time between two fixes. One wrong time is not heeded.
    fn satellites(&mut self, milliseconds: f64, log: &mut Log) {
        let Base::Satellites(first) = self.base else {
            if self.base == Base::None {
                self.base = Base::Satellites(milliseconds);
            }
            self.waiting.clear();
            return;
        };
        let mut now = (milliseconds - first) / 1e3;
        let before = self.doubted.take();
        if (now - self.now).abs() > DOUBTFUL {
            let agrees = |doubted: &Doubted| (0.0..=DOUBTFUL).contains(&(now - doubted.time));
            let Some(doubted) = before.filter(agrees) else {
                self.unheeded += usize::from(before.is_some());
                self.doubted = Some(Doubted {
                    time: now,
                    rows: self.waiting.len(),
                });
                return;
            };
            let mut time = doubted.time;
            if !(0.0..DAY).contains(&(time - self.now)) {
                // Times of a clock that was set back, or that found out about the date, go on.
                let by = self.now - time + (now - time);
                let way = if time < self.now { "back" } else { "forward" };
                log.report.remark(format!(
                    "the receiver's clock was set {way} by {:.0} s at {:.0} s: times go on from there",
                    (self.now - time).abs(),
                    self.now
                ));
                self.base = Base::Satellites(first - by * 1e3);
                (time, now) = (time + by, now + by);
            }
            self.spread(doubted.rows, time, log);
        } else {
            self.unheeded += usize::from(before.is_some());
        }
        if now > self.now {
            // The fix itself is the last of those that wait.
            self.spread(self.waiting.len(), now, log);
        }
    }

    /// Gives the first rows that wait their times from now to a fix at `time`.
    fn spread(&mut self, rows: usize, time: f64, log: &mut Log) {
        let rows = self.waiting.drain(..rows.min(self.waiting.len()));
        let count = rows.len() as f64;
        for ((place, row), i) in rows.zip(1_u32..) {
            let part = f64::from(i) / count;
            if let Some(own) = log.topics[place].times.get_mut(row) {
                *own = self.now + (time - self.now) * part;
            }
        }
        self.now = time;
    }
}

/// The number as the receiver counts it, whatever unit the log would show it in.
fn of_receiver(topic: &Topic, field: &FieldLayout, row: usize) -> Option<f64> {
    field.kind.number(field.bytes(topic.rows.get(row)?)?)
}
