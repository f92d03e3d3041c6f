//! A long flight made of a short one, for measuring what long flights cost.

use super::Documents;

impl Documents {
    /// Lets the flight that is shown, with its run and its pictures, be flown lap after lap until
    /// the run has at least so many steps; returns how many it has then. Nothing is computed anew:
    /// every lap repeats the first one at a later time.
    pub fn repeat_laps(&mut self, least_steps: usize) -> usize {
        let Some(run) = &mut self.run.navigated else {
            return 0;
        };
        let (lap_steps, Some((first, last))) = (run.steps.len(), run.span()) else {
            return 0;
        };
        let laps = least_steps.div_ceil(lap_steps);
        let lap_frames = self.flight.measured.as_ref().map_or(0, |f| f.frames.len());
        let interval = (last - first) / (lap_steps.max(2) - 1) as f64;
        let lap_time = last - first + interval;
        run.steps.reserve_exact(laps.saturating_sub(1) * lap_steps);
        for lap in 1..laps {
            for index in 0..lap_steps {
                let mut step = run.steps[index].clone();
                step.time += lap as f64 * lap_time;
                if let Some(frame) = &mut step.frame {
                    frame.index += lap * lap_frames;
                }
                run.steps.push(step);
            }
        }
        self.flight.pictures.repeat(lap_frames);
        let steps = run.steps.len();
        if let Some(flight) = &mut self.flight.measured {
            repeat(&mut flight.frames, laps, lap_time, |f| &mut f.time);
            if let Some(truth) = &mut flight.truth {
                truth.states.retain(|s| s.time < first + lap_time);
                repeat(&mut truth.states, laps, lap_time, |s| &mut s.time);
                truth.frames = truth.frames.repeat(laps);
            }
            for channel in &mut flight.channels {
                let rows = channel.times.iter().zip(&channel.values);
                let mut rows: Vec<_> = rows.map(|(t, v)| (*t, *v)).collect();
                rows.retain(|row| row.0 < first + lap_time);
                repeat(&mut rows, laps, lap_time, |row| &mut row.0);
                (channel.times, channel.values) = rows.into_iter().unzip();
            }
        }
        self.run.generation += 1;
        steps
    }
}

/// Appends what is there again and again, each time `lap_time` seconds later.
fn repeat<T: Clone>(
    rows: &mut Vec<T>,
    laps: usize,
    lap_time: f64,
    time: impl Fn(&mut T) -> &mut f64,
) {
    let lap_rows = rows.len();
    for lap in 1..laps {
        for index in 0..lap_rows {
            let mut row = rows[index].clone();
            *time(&mut row) += lap as f64 * lap_time;
            rows.push(row);
        }
    }
}
