//! Counts of what was found.

use std::fmt;

use pilotage_roads::lost::LostBelief;
use pilotage_training::evaluation::wilson;

/// Probability from which on a place is believed.
const BELIEVED: f64 = 0.99;
/// Upper ends of the classes of probability.
const CLASSES: [f64; 8] = [0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0];

/// Processor time of this thread, seconds, where the system tells it; others share the machine.
pub fn processor_time() -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let first = told.split(' ').next();
    1e-9 * first.and_then(|f| f.parse::<f64>().ok()).unwrap_or(0.0)
}

/// Outcome of many views.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    views: usize,
    right: usize,
    believed: usize,
    wrong: usize,
    others: usize,
    others_believed: usize,
    agreement: [(usize, usize); 4],
    seconds: Vec<f64>,
    /// Likeliest places by class of probability: number, sum of probabilities, number of right ones.
    classes: [(usize, f64, usize); CLASSES.len()],
}

impl Tally {
    /// Counts a belief: the place in it that is right, and whether the view is of the map that was searched.
    pub fn count(&mut self, belief: &LostBelief, right: Option<usize>, is_own: bool, seconds: f64) {
        let is_first = right == Some(0);
        let is_believed = belief.place(BELIEVED).is_some();
        self.seconds.push(seconds);
        if let Some(likeliest) = belief.places.first() {
            let of = CLASSES.partition_point(|end| *end < likeliest.probability);
            let class = &mut self.classes[of.min(CLASSES.len() - 1)];
            class.0 += 1;
            class.1 += likeliest.probability;
            class.2 += usize::from(is_first);
        }
        if is_own {
            self.views += 1;
            self.right += usize::from(is_first);
            self.believed += usize::from(is_believed);
            self.wrong += usize::from(is_believed && !is_first);
        } else {
            self.others += 1;
            self.others_believed += usize::from(is_believed);
        }
    }

    pub fn agree(&mut self, counts: [(usize, usize); 4]) {
        for (own, more) in self.agreement.iter_mut().zip(counts) {
            *own = (own.0 + more.0, own.1 + more.1);
        }
    }

    pub fn add(&mut self, other: &Self) {
        self.views += other.views;
        self.right += other.right;
        self.believed += other.believed;
        self.wrong += other.wrong;
        self.others += other.others;
        self.others_believed += other.others_believed;
        self.agree(other.agreement);
        self.seconds.extend(&other.seconds);
        for (own, more) in self.classes.iter_mut().zip(other.classes) {
            *own = (own.0 + more.0, own.1 + more.1, own.2 + more.2);
        }
    }

    /// Probabilities as stated, against the share that was right.
    pub fn print_reliability(&self) {
        for (end, (count, sum, right)) in CLASSES.iter().zip(self.classes) {
            let (low, high) = wilson(right as f64, count as f64);
            let all = count.max(1) as f64;
            println!(
                "p up to {end}: {count} places, stated {:.3}, right {:.3} [{low:.3}, {high:.3}]",
                sum / all,
                right as f64 / all
            );
        }
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = wilson(self.wrong as f64, self.believed as f64);
        let (least, most) = wilson(self.others_believed as f64, self.others as f64);
        write!(
            f,
            "{} views, likeliest right {}, believed {}, of these wrong {} [{low:.4}, {high:.4}], unsure {}; of other maps \
             {} believed of {} [{least:.4}, {most:.4}]",
            self.views,
            self.right,
            self.believed,
            self.wrong,
            self.views - self.believed,
            self.others_believed,
            self.others
        )?;
        let shares = self
            .agreement
            .map(|(part, whole)| part as f64 / whole.max(1) as f64);
        let [points, road, crossings, found] = shares;
        let mut seconds = self.seconds.clone();
        seconds.sort_by(f64::total_cmp);
        let at = |share: f64| {
            seconds
                .get((share * seconds.len() as f64) as usize)
                .copied()
        };
        write!(
            f,
            "; points true {points:.2}, road found {road:.2}, crossings true {crossings:.2}, found {found:.2}; {:.2} s, 95 % \
             {:.2} s",
            at(0.5).unwrap_or(0.0),
            at(0.95).unwrap_or(0.0)
        )
    }
}
