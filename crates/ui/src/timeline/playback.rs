//! Motion of the time cursor, and the span of time that is selected.

use super::Span;

/// Slowest and fastest playback, times real time.
pub const SPEEDS: [f64; 2] = [0.1, 20.0];

/// The time cursor and its motion.
#[derive(Clone, Debug)]
pub struct Playback {
    /// The time cursor, seconds in the flight's time base.
    pub time: f64,
    /// Whether it moves by itself.
    pub playing: bool,
    /// Speed, times real time.
    pub speed: f64,
    /// Whether it starts over at the end.
    pub looping: bool,
    /// Whether nothing but the cursor moves by itself.
    pub is_still: bool,
    /// The span of time that is selected, if any: in order, not empty, within the flight.
    pub selected_span: Option<Span>,
}

impl Default for Playback {
    fn default() -> Self {
        Self {
            time: 0.0,
            playing: true,
            speed: 1.0,
            looping: true,
            is_still: false,
            selected_span: None,
        }
    }
}

impl Playback {
    /// Sets the speed within its limits.
    pub fn set_speed(&mut self, speed: f64) {
        self.speed = speed.clamp(SPEEDS[0], SPEEDS[1]);
    }

    /// Seconds of the flight in a second, for what moves along with the cursor; 0 while it stands still, and where nothing
    /// else is to move.
    pub fn motion(&self) -> f64 {
        if self.playing && !self.is_still {
            self.speed
        } else {
            0.0
        }
    }

    /// Moves the cursor to a time within the span.
    pub fn seek(&mut self, time: f64, span: Option<(f64, f64)>) {
        if let Some((first, last)) = span {
            self.time = time.clamp(first, last.max(first));
        }
    }

    /// Selects a span of time, as far as it lies within `whole`; nothing if nothing of it does.
    pub fn select(&mut self, span: Option<Span>, whole: Option<Span>) {
        self.selected_span = span.zip(whole).and_then(|((from, to), (first, last))| {
            let (from, to) = (from.max(first), to.min(last));
            (from < to).then_some((from, to))
        });
    }

    /// Lets the selected span begin at the cursor; it ends where it did, or else with `whole`.
    pub fn select_from_here(&mut self, whole: Option<Span>) {
        let end = self.selected_span.map(|s| s.1).filter(|e| *e > self.time);
        let end = end.or(whole.map(|w| w.1));
        self.select(end.map(|end| (self.time, end)), whole);
    }

    /// Lets the selected span end at the cursor; it begins where it did, or else with `whole`.
    pub fn select_to_here(&mut self, whole: Option<Span>) {
        let begin = self.selected_span.map(|s| s.0).filter(|b| *b < self.time);
        let begin = begin.or(whole.map(|w| w.0));
        self.select(begin.map(|begin| (begin, self.time)), whole);
    }

    /// Moves the cursor by `elapsed` seconds of real time. It waits at `streamed`, the last time computed so far, or where it
    /// stands beyond that: what is flown again comes there. It ends or starts over at the end of the span.
    ///
    /// ```
    /// use pilotage_ui::timeline::Playback;
    ///
    /// let mut playback = Playback { time: 10.0, speed: 4.0, ..Playback::default() };
    /// playback.advance(0.2, Some((0.0, 60.0)), 60.0, true);
    /// assert!((playback.time - 10.8).abs() < 1e-9);
    /// // Nothing is computed beyond 11 s so far.
    /// playback.advance(0.2, Some((0.0, 60.0)), 11.0, false);
    /// assert_eq!(playback.time, 11.0);
    /// ```
    pub fn advance(
        &mut self,
        elapsed: f64,
        span: Option<(f64, f64)>,
        streamed: f64,
        complete: bool,
    ) {
        let Some((first, last)) = span else { return };
        if !self.playing {
            return;
        }
        if self.time < first {
            self.time = first;
        }
        let before = self.time;
        // A page that slept for long does not leap.
        self.time += elapsed.clamp(0.0, 0.25) * self.speed;
        let end = if complete {
            last.min(streamed)
        } else {
            streamed
        };
        if self.time >= end {
            if !complete {
                self.time = end.max(before);
            } else if self.looping {
                self.time = first;
            } else {
                self.time = end;
                self.playing = false;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(time: f64) -> Playback {
        Playback {
            time,
            ..Playback::default()
        }
    }

    #[test]
    fn a_cursor_waits_where_it_stands_until_a_flight_that_is_flown_again_has_come_there() {
        let mut playback = at(84.0);
        let span = Some((0.0, 120.0));
        for streamed in [0.5, 40.0, 84.0] {
            playback.advance(0.1, span, streamed, false);
            assert_eq!(playback.time, 84.0, "at {streamed} s");
        }
        playback.advance(0.1, span, 100.0, false);
        assert!((playback.time - 84.1).abs() < 1e-9);
        // Stopped before it came there.
        let mut playback = at(84.0);
        playback.advance(0.1, span, 40.0, true);
        assert!(playback.time <= 40.0);
    }

    #[test]
    fn playback_waits_for_what_is_still_being_computed() {
        let mut playback = at(9.95);
        playback.advance(0.2, Some((0.0, 100.0)), 10.0, false);
        assert!(playback.playing);
        assert_eq!(playback.time, 10.0);
    }

    #[test]
    fn a_loop_starts_over_at_the_end() {
        let mut playback = at(99.95);
        playback.advance(0.2, Some((0.0, 100.0)), 100.0, true);
        assert_eq!(playback.time, 0.0);
        assert!(playback.playing);
    }

    #[test]
    fn without_a_loop_it_stops_at_the_end() {
        let mut playback = Playback {
            looping: false,
            ..at(99.95)
        };
        playback.advance(0.2, Some((0.0, 100.0)), 100.0, true);
        assert_eq!((playback.time, playback.playing), (100.0, false));
    }

    #[test]
    fn a_selected_span_lies_within_the_flight_and_is_not_empty() {
        let mut playback = at(30.0);
        let whole = Some((0.0, 100.0));
        playback.select(Some((-5.0, 20.0)), whole);
        assert_eq!(playback.selected_span, Some((0.0, 20.0)));
        playback.select(Some((120.0, 130.0)), whole);
        assert_eq!(playback.selected_span, None);
        playback.select(Some((7.0, 7.0)), whole);
        assert_eq!(playback.selected_span, None);
    }

    #[test]
    fn a_span_is_selected_from_the_cursor_to_the_cursor() {
        let whole = Some((0.0, 100.0));
        let mut playback = at(30.0);
        playback.select_from_here(whole);
        assert_eq!(playback.selected_span, Some((30.0, 100.0)));
        playback.time = 40.0;
        playback.select_to_here(whole);
        assert_eq!(playback.selected_span, Some((30.0, 40.0)));
        playback.time = 50.0;
        playback.select_from_here(whole);
        assert_eq!(playback.selected_span, Some((50.0, 100.0)));
        playback.time = 20.0;
        playback.select_to_here(whole);
        assert_eq!(playback.selected_span, Some((0.0, 20.0)));
    }

    #[test]
    fn speed_multiplies_time() {
        let mut playback = at(1.0);
        playback.set_speed(4.0);
        playback.advance(0.1, Some((0.0, 100.0)), 100.0, true);
        assert!((playback.time - 1.4).abs() < 1e-12);
    }
}
