//! Lag of the pictures, estimated in flight.
//!
//! A picture that comes τ late shows what was before, and puts the aircraft τ of its way behind. On a straight
//! leg a constant lag looks like a place; but the flight began at a known one, the aircraft rolls in gusts,
//! and in turns its heading tells the time. So a few filters are flown beside the first, each of which assumes
//! another lag. All are shown the same found places; what each makes of them weighs it by Bayes' rule.
//!
//! A camera may also begin to be late: a hypothesis that is less likely than that goes on from where the first is.
//!
//! As long as the first is likelier than the share of the truth that its ellipse holds, the others belong to
//! what is left out. Beyond that the belief that is reported spreads over all of them, and once hardly
//! anything speaks for the first any more, the likeliest takes its place.

use std::collections::BTreeMap;

use nalgebra::DMatrix;

use super::aids::take;
use super::engine::Engine;
use super::observation::Observation;
use super::observed_at::ObservedAt;
use super::onlooker::Onlooker;
use super::recovery::believed;
use super::see::{Associator, FoundPlace, SightedPlace, observation};
use super::{CandidateReport, Doubt, Estimate, Instrument, SensorFault};
use pilotage_base::frames::{Pose, wrap_pi};
use pilotage_estimation::filter::{FilterError, Gate};
use pilotage_estimation::vehicle::ControlInput;

/// Longest lag that is thought of, seconds …
const LONGEST: f64 = 2.0;
/// … and how many of them beside none. Nearer lags differ by less than the noise of the attitudes that are
/// read at their times, which would decide between them; what lies between two is shared by both.
const HYPOTHESES: u32 = 4;
/// Probability that pictures come late, before anything is seen: of a hundred flights one …
const LATE: f64 = 1e-2;
/// … and that they begin to, for each second: of a thousand flights of a hundred seconds one.
const BEGINS: f64 = 1e-5;
/// Share of the truth that the ellipse is drawn for.
const ELLIPSE: f64 = 0.95;
/// Who is less likely than this has to give way.
const UNLIKELY: f64 = 0.01;
/// Most evidence of one landmark, whenever it is seen alone, as odds: it may be drawn, or found, in a wrong place every
/// time, and must not lead the belief astray.
const ODDS_OF_ONE: f64 = 100.0;

/// A filter that assumes another lag.
struct Hypothesis {
    lag: f64,
    engine: Box<dyn Engine>,
    /// Probability, of all the filters together one.
    weight: f64,
    /// Evidence against the first by each landmark while it was found alone, natural logarithm of odds.
    alone: BTreeMap<u32, f64>,
}

impl Hypothesis {
    /// Takes in that what was `found` is by `evidence` likelier than the first believes, as a logarithm.
    ///
    /// Landmarks that were found together speak for themselves. One alone may be wrong every time, and then speaks
    /// for whatever explains it: all that it says, for or against, comes to no more than the odds that it is right.
    fn weigh(&mut self, found: &[FoundPlace<'_>], evidence: f64) {
        let counted = if let [(landmark, ..)] = found {
            let most = ODDS_OF_ONE.ln();
            let all = self.alone.entry(landmark.id).or_default();
            let before = all.clamp(-most, most);
            *all += evidence;
            all.clamp(-most, most) - before
        } else {
            evidence
        };
        self.weight *= counted.exp();
    }
}

/// Lag of the pictures as far as the flight tells it.
pub struct PictureLag {
    /// Lag that the first filter assumes, seconds.
    assumed: f64,
    /// Probability of that.
    weight: f64,
    hypotheses: Vec<Hypothesis>,
    /// When a picture was shown to all of them last, seconds.
    shown: Option<f64>,
    /// Since when the first lag is doubted, and whether it was given up, seconds.
    doubted: Option<f64>,
    replaced: Option<f64>,
}

impl PictureLag {
    /// Before the first picture, which `engine` takes for punctual.
    pub fn new(engine: &dyn Engine) -> Result<Self, FilterError> {
        let hypothesis = |number: u32| {
            Ok(Hypothesis {
                lag: LONGEST * f64::from(number) / f64::from(HYPOTHESES),
                engine: engine.faded(1.0)?,
                weight: LATE / f64::from(HYPOTHESES),
                alone: BTreeMap::new(),
            })
        };
        Ok(Self {
            assumed: 0.0,
            weight: 1.0 - LATE,
            hypotheses: (1..=HYPOTHESES).map(hypothesis).collect::<Result<_, _>>()?,
            shown: None,
            doubted: None,
            replaced: None,
        })
    }

    /// The lag that the first filter assumes, seconds.
    pub fn assumed(&self) -> f64 {
        self.assumed
    }

    /// Moves the others along as the first; who cannot be moved is no longer asked.
    pub fn predict(&mut self, input: &ControlInput, dt: f64) {
        self.hypotheses
            .retain_mut(|hypothesis| hypothesis.engine.predict(input, dt).is_ok());
    }

    /// Shows everybody the places `found` in a picture by `associator`, who looks with the first filter, which is
    /// corrected elsewhere.
    pub fn weigh(
        &mut self,
        associator: &Associator<'_>,
        onlooker: &Onlooker<'_>,
        found: &[FoundPlace<'_>],
        reports: &[CandidateReport],
    ) -> Result<(), FilterError> {
        if self.hypotheses.is_empty() || found.is_empty() {
            return Ok(());
        }
        self.let_begin(associator.engine, onlooker.time)?;
        let first = associator.seen_by(associator.engine, onlooker.model(self.assumed));
        let own = judged(&first, &all_seen_anew(found, associator, &first), reports)?;
        for hypothesis in &mut self.hypotheses {
            hypothesis.engine.look_back(onlooker.past(hypothesis.lag));
            let judge =
                associator.seen_by(hypothesis.engine.as_ref(), onlooker.model(hypothesis.lag));
            let places = all_seen_anew(found, associator, &judge);
            hypothesis.weigh(found, judged(&judge, &places, reports)? - own);
            // Believed and corrected by the readings as they are, as the first: who was corrected by better ones would be the
            // better filter.
            let model = onlooker.model_as_read(hypothesis.lag);
            let corrector = associator.seen_by(hypothesis.engine.as_ref(), model);
            let places = all_seen_anew(found, associator, &corrector);
            let (agreed, _, _) = believed(&corrector, &places, &mut reports.to_vec())?;
            if !agreed.is_empty() {
                let pose = corrector.pose;
                let seen = observation(associator.settings, &agreed, &model, &pose);
                seen.correct(hypothesis.engine.as_mut())?;
            }
        }
        self.share();
        let is_doubted = self.weight < 0.5;
        self.doubted = self.doubted.or(is_doubted.then_some(onlooker.time));
        Ok(())
    }

    /// Lets the camera begin, by `time` in seconds, to be as late as a hypothesis assumes where that is likelier than
    /// that it always was: the hypothesis goes on from the first, which is `engine`.
    fn let_begin(&mut self, engine: &dyn Engine, time: f64) -> Result<(), FilterError> {
        let since = self.shown.replace(time).map_or(0.0, |shown| time - shown);
        let begun = self.weight * BEGINS * since / f64::from(HYPOTHESES);
        for hypothesis in self.hypotheses.iter_mut().filter(|h| h.weight < begun) {
            hypothesis.engine = engine.faded(1.0)?;
            hypothesis.weight = begun;
            hypothesis.alone.clear();
        }
        Ok(())
    }

    /// Shows everybody what an aid observed; the first, whose logarithm of the likelihood was `own`, was shown it
    /// elsewhere. An aid that sees took the attitude of the moment that the first assumes: what it saw says
    /// nothing about the lag.
    pub fn take(
        &mut self,
        observation: &Observation<'_>,
        (at, gate, own): (&ObservedAt<'_>, Gate, f64),
    ) -> Result<(), FilterError> {
        for hypothesis in &mut self.hypotheses {
            at.turn(hypothesis.engine.as_mut(), hypothesis.lag);
            let taken = take(hypothesis.engine.as_mut(), observation, gate)?;
            if let (Some(taken), ObservedAt::Now(_)) = (taken, at) {
                hypothesis.weight *= (taken.log_likelihood - own).exp();
            }
        }
        self.share();
        Ok(())
    }

    /// Makes the probabilities sum to one.
    fn share(&mut self) {
        let all = self.weight
            + self
                .hypotheses
                .iter()
                .map(|hypothesis| hypothesis.weight)
                .sum::<f64>();
        self.weight /= all;
        for hypothesis in &mut self.hypotheses {
            hypothesis.weight /= all;
        }
    }

    /// Puts the likeliest in the place of `engine` if that has become too unlikely, at `time` in seconds;
    /// whether it did.
    pub fn replace(&mut self, engine: &mut Box<dyn Engine>, time: f64) -> bool {
        if self.weight >= UNLIKELY {
            return false;
        }
        let hypotheses = self.hypotheses.iter_mut();
        let Some(likeliest) = hypotheses.max_by(|a, b| a.weight.total_cmp(&b.weight)) else {
            return false;
        };
        std::mem::swap(&mut likeliest.engine, engine);
        std::mem::swap(&mut likeliest.weight, &mut self.weight);
        std::mem::swap(&mut likeliest.lag, &mut self.assumed);
        // Evidence is against the first, who is another now.
        let for_the_first = std::mem::take(&mut likeliest.alone);
        for hypothesis in &mut self.hypotheses {
            for (landmark, evidence) in &for_the_first {
                *hypothesis.alone.entry(*landmark).or_default() -= evidence;
            }
        }
        self.replaced.get_or_insert(time);
        true
    }

    /// The belief of all together, if the others matter beside `first`: the mean and the covariance of the
    /// mixture. `past` gives the inputs of the last so many seconds, the latest first.
    pub fn together(
        &self,
        engine: &dyn Engine,
        first: &Estimate,
        past: &dyn Fn(f64) -> Vec<(ControlInput, f64)>,
    ) -> Option<Estimate> {
        if self.replaced.is_none() && self.weight >= ELLIPSE {
            return None;
        }
        let hypotheses = self.hypotheses.iter();
        let hypotheses = hypotheses.map(|h| (h.weight, h.engine.as_ref(), h.engine.state(), h.lag));
        let own = (self.weight, engine, first.clone(), self.assumed);
        let beliefs: Vec<(f64, Estimate)> = hypotheses
            .chain([own])
            .map(|(weight, engine, belief, lag)| {
                (weight, spread_over_cell(belief, engine, (lag, &past(lag))))
            })
            .collect();
        let size = first.mean.len();
        let mut mean = nalgebra::DVector::zeros(size);
        for (weight, belief) in &beliefs {
            mean += *weight * &belief.mean;
        }
        let mut covariance = DMatrix::zeros(size, size);
        for (weight, belief) in &beliefs {
            let off = &belief.mean - &mean;
            covariance += *weight * (&belief.covariance + &off * off.transpose());
        }
        Some(Estimate { mean, covariance })
    }

    /// Begins anew from `engine`, but keeps what the lags are worth.
    pub fn restart(&mut self, engine: &dyn Engine) -> Result<(), FilterError> {
        for hypothesis in &mut self.hypotheses {
            hypothesis.engine = engine.faded(1.0)?;
        }
        Ok(())
    }

    /// Doubt about the lag of the pictures, if there is one.
    pub fn doubt(&self) -> Option<Doubt> {
        let mean = |sum, hypothesis: &Hypothesis| sum + hypothesis.weight * hypothesis.lag;
        let late = self
            .hypotheses
            .iter()
            .fold(self.weight * self.assumed, mean);
        let (why, since) = match (self.replaced, self.doubted) {
            (Some(since), _) => (SensorFault::Late { by: late }, since),
            (None, Some(since)) if self.weight < ELLIPSE => (SensorFault::MayBeLate, since),
            _ => return None,
        };
        Some(Doubt {
            instrument: Instrument::Camera,
            why,
            since,
        })
    }
}

/// The belief of a filter that stands for all lags nearer to its own than to the next: evenly spread over them,
/// of the variance of a uniform distribution. That without a lag stands for itself. `past` are the inputs in the lag.
fn spread_over_cell(
    mut belief: Estimate,
    engine: &dyn Engine,
    (lag, past): (f64, &[(ControlInput, f64)]),
) -> Estimate {
    if lag > 0.0 {
        let back =
            |state, (input, dt): &(ControlInput, f64)| engine.dead_reckon(&state, input, -dt);
        let then = past.iter().fold(belief.mean.clone(), back);
        let way = belief.mean.fixed_rows::<2>(0) - then.fixed_rows::<2>(0);
        let off = way * (LONGEST / f64::from(HYPOTHESES) / lag);
        let mut position = belief.covariance.fixed_view_mut::<2, 2>(0, 0);
        position += off * off.transpose() / 12.0;
    }
    belief
}

/// Logarithm of the likelihood that `judge` gives to what was found, up to what is the same for every judge.
///
/// Everything found counts together, whether believed or not: errors that landmarks share make their joint density many
/// times that of each by itself. Either all of it is right, or those that are not believed lie anywhere, as if each were on
/// the border of its gate; the likelier of the two counts.
fn judged(
    judge: &Associator<'_>,
    found: &[FoundPlace<'_>],
    reports: &[CandidateReport],
) -> Result<f64, FilterError> {
    let mut reports = reports.to_vec();
    let (agreed, _, _) = believed(judge, found, &mut reports)?;
    let all = found.iter();
    let all =
        all.filter_map(|(landmark, index, place)| judge.measurement(landmark, *index, *place));
    let all: Vec<_> = all.collect();
    if all.is_empty() {
        return Ok(0.0);
    }
    let is_agreed = |report: usize| agreed.iter().any(|m| m.report == report);
    let without = all.iter().filter(|m| !is_agreed(m.report));
    let mut apart: f64 = without.map(|m| reports[m.report].threshold).sum();
    if !agreed.is_empty() {
        apart += judge.innovation(&agreed)?.nis()?;
    }
    judge.innovation(&all)?.log_likelihood(apart)
}

/// Places that were `found` by `from`, for `to`, who assumes another pose.
fn all_seen_anew<'l>(
    found: &[FoundPlace<'l>],
    from: &Associator<'_>,
    to: &Associator<'_>,
) -> Vec<FoundPlace<'l>> {
    let as_seen = |place: &SightedPlace| seen_anew(place, &from.pose, &to.pose);
    found
        .iter()
        .map(|(landmark, report, place)| (*landmark, *report, as_seen(place)))
        .collect()
}

/// A place that was found by somebody who assumed the pose `from`, for one who assumes `to`: the pixel is the
/// same, but turn and scale of the surroundings are told against what is assumed.
fn seen_anew((seen, covariance): &SightedPlace, from: &Pose, to: &Pose) -> SightedPlace {
    let mut seen = *seen;
    seen[2] = wrap_pi(seen[2] + to.attitude.yaw - from.attitude.yaw);
    let height = |pose: &Pose| -pose.position_in_world.z;
    let (above, was) = (height(to), height(from));
    if above > 0.0 && was > 0.0 {
        seen[3] += (above / was).ln();
    }
    (seen, *covariance)
}

#[cfg(test)]
#[path = "picture_lag_tests.rs"]
mod tests;
