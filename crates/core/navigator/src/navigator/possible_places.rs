//! Places at which the aircraft may be while frames leave it open.
//!
//! A frame that cannot be believed for itself may lie at several places, each with a probability, or at none that was
//! found. Each is followed by a filter of its own, as a multiple hypothesis tracker does (Reid 1979), until one of
//! them has nearly all the probability. Beside them runs a belief that knows where the aircraft was last but not
//! how it moved since: an aircraft may turn or stop as no model of its motion foresees, and is then looked for as
//! far away as it can have got.
//!
//! A frame is looked for within one wide prior, and what is found is weighed for every belief: that it lies at a place
//! by the belief's weight, the place's probability within the prior, and how much likelier the belief made that place
//! than the prior did, both as uncertain as the place itself is; that it lies at none of them by the belief's weight and
//! the probability that is left.

use super::Estimate;
use super::aids::take;
use super::engine::{Engine, PredictedStep, engine};
use super::found_places::{FoundPlaces, SearchedRegion};
use super::frame_registration::{Believed, SeenPlace};
use super::observation::Observation;
use super::observed_at::ObservedAt;
use super::registration_refusal::RegistrationRefusal;
use pilotage_base::statistics::probability_words;
use pilotage_estimation::filter::{FilterError, Gate};
use pilotage_estimation::vehicle::ControlInput;
use pilotage_mission::settings::NavigatorSettings;
use pilotage_vision::registration::{Follower, Registration};

/// Probability that the aircraft moves between two frames as its model does not foresee.
const UNFORESEEN: f64 = 0.02;
/// Probability from which a place is the one.
const SURE: f64 = 0.95;
/// Probability below which a place is given up, and how many are followed.
const GIVEN_UP: f64 = 1e-3;
const FOLLOWED: usize = 8;
/// A belief that is wider than another by this factor is worth a search of its own.
const WIDER: f64 = 1.5;

/// Belief about where the aircraft is.
struct PlaceBelief {
    engine: Box<dyn Engine>,
    follower: Follower,
    weight: f64,
    /// Its last prediction.
    step: Option<PredictedStep>,
}

/// Likelihood ratio of each of the places: its density by what `engine` expects over that by what was
/// searched.
fn likelier(engine: &dyn Engine, found: &FoundPlaces) -> Vec<f64> {
    let state = engine.state();
    let of_place = |place: &Registration| {
        found.density_believed(&state, place) / found.density_searched(place)
    };
    found.places.iter().map(of_place).collect()
}

impl PlaceBelief {
    fn new(engine: Box<dyn Engine>, follower: Follower, weight: f64) -> Self {
        Self {
            engine,
            follower,
            weight,
            step: None,
        }
    }
}

/// All that is thought possible beside what the navigator goes by.
pub struct PossiblePlaces {
    /// Probability of what the navigator goes by.
    main: f64,
    /// Belief that knows where the aircraft was last, and nothing of how it moved since.
    unforeseen: Option<PlaceBelief>,
    others: Vec<PlaceBelief>,
}

/// A belief that nearly everything speaks for.
pub struct Sure {
    pub engine: Box<dyn Engine>,
    pub follower: Follower,
    /// The prediction that brought it here, if it is not the navigator's own.
    pub step: Option<PredictedStep>,
    /// The place of this frame that it believes, and what that did.
    pub believed: Option<(usize, Believed)>,
}

impl PossiblePlaces {
    /// Nothing but what the navigator goes by.
    pub fn new() -> Self {
        Self {
            main: 1.0,
            unforeseen: None,
            others: Vec::new(),
        }
    }

    /// Two places: that which the navigator goes by, of the probability `main`, and that of `other`.
    #[cfg(test)]
    pub fn two(main: f64, other: Box<dyn Engine>) -> Self {
        let follower = Follower::new(pilotage_vision::registration::FollowSettings::default());
        Self {
            main,
            unforeseen: None,
            others: vec![PlaceBelief::new(other, follower, 1.0 - main)],
        }
    }

    /// Moves all along.
    pub fn moved(&mut self, input: &ControlInput, dt: f64) {
        let moves = |belief: &mut PlaceBelief| {
            belief.step = belief.engine.predict(input, dt).ok();
            belief.step.is_some()
        };
        self.others.retain_mut(moves);
        if !self.unforeseen.as_mut().is_none_or(moves) {
            self.unforeseen = None;
        }
    }

    /// Shows all what an aid observed; the navigator's own filter, whose logarithm of the likelihood was `own`, was shown it elsewhere.
    pub fn take(
        &mut self,
        observation: &Observation<'_>,
        (at, gate, own): (&ObservedAt<'_>, Gate, f64),
    ) -> Result<(), FilterError> {
        let mut all = self.main;
        for belief in self.unforeseen.iter_mut().chain(&mut self.others) {
            at.turn(belief.engine.as_mut(), 0.0);
            if let Some(taken) = take(belief.engine.as_mut(), observation, gate)? {
                belief.weight *= (taken.log_likelihood - own).exp();
            }
            all += belief.weight;
        }
        self.main /= all;
        for belief in self.unforeseen.iter_mut().chain(&mut self.others) {
            belief.weight /= all;
        }
        Ok(())
    }

    /// The navigator knows where it is: everything else is forgotten.
    pub fn settle(
        &mut self,
        settings: &NavigatorSettings,
        believed: &Estimate,
        follower: &Follower,
    ) -> Result<(), FilterError> {
        let deviation = believed.greatest_variance().sqrt();
        let anew = engine(settings, believed.position(), deviation)?;
        self.main = 1.0 - UNFORESEEN;
        self.unforeseen = Some(PlaceBelief::new(anew, follower.clone(), UNFORESEEN));
        self.others.clear();
        Ok(())
    }

    /// Whether other places are as possible as to be asked at once.
    pub fn are_open(&self) -> bool {
        self.main < SURE && !self.others.is_empty()
    }

    /// The widest belief, if it is worth a search beside that around what is `believed`; `around` is what is searched.
    pub fn wider(
        &self,
        believed: &Estimate,
        around: impl Fn(&Estimate) -> SearchedRegion,
    ) -> Option<Estimate> {
        let widest = self.unforeseen.as_ref()?.engine.state();
        (around(&widest).deviation > WIDER * around(believed).deviation).then_some(widest)
    }

    /// Weighs everything by what was found of a frame; the belief that has nearly all the probability now, if one has,
    /// after which the rest is to be settled. `main` is what the navigator goes by.
    pub fn weigh(
        &mut self,
        settings: &NavigatorSettings,
        main: &dyn Engine,
        follower: &Follower,
        found: &FoundPlaces,
    ) -> Result<Option<Sure>, FilterError> {
        let told: f64 = found.places.iter().map(Registration::belief).sum();
        let scale = told.max(1.0).recip();
        let missed = (1.0 - told * scale).max(f64::EPSILON);
        let mut places: Vec<Heaviest<'_>> = Vec::new();
        places.resize_with(found.places.len(), Heaviest::default);
        let main = Parent {
            engine: main,
            follower,
            weight: self.main,
            step: None,
        };
        let parents = self.unforeseen.iter().chain(&self.others).map(Parent::from);
        let mut all = 0.0;
        for parent in std::iter::once(main).chain(parents) {
            all += parent.weight * missed;
            let likelier = likelier(parent.engine, found);
            for ((heaviest, place), likelier) in places.iter_mut().zip(&found.places).zip(likelier)
            {
                let weight = parent.weight * scale * place.belief() * likelier;
                all += weight;
                heaviest.offer(parent, weight);
            }
        }
        let mut sure = None;
        let mut here = Vec::new();
        for (index, (heaviest, place)) in places.into_iter().zip(&found.places).enumerate() {
            let weight = heaviest.together / all;
            let Some((parent, _)) = heaviest.parent.filter(|_| weight > GIVEN_UP) else {
                continue;
            };
            let (mut engine, mut follower) = (parent.engine.another(), parent.follower.clone());
            follower.learn(found.time, found.ground_down, &found.prior, place);
            let seen = SeenPlace::by(settings, engine.as_ref(), found, place)?;
            let believed = seen.correct(engine.as_mut(), None)?;
            if weight >= SURE {
                sure = Some(Sure {
                    engine,
                    follower,
                    step: parent.step.cloned(),
                    believed: Some((index, believed)),
                });
            } else {
                here.push(PlaceBelief::new(engine, follower, weight));
            }
        }
        if sure.is_some() {
            return Ok(sure);
        }
        self.main *= missed / all;
        for belief in self.unforeseen.iter_mut().chain(&mut self.others) {
            belief.weight *= missed / all;
        }
        self.others.append(&mut here);
        self.others.sort_by(|a, b| b.weight.total_cmp(&a.weight));
        self.others.retain(|belief| belief.weight > GIVEN_UP);
        self.others.truncate(FOLLOWED);
        let is_sure = self.others.first().is_some_and(|b| b.weight >= SURE);
        Ok(is_sure.then(|| self.others.swap_remove(0)).map(|b| Sure {
            engine: b.engine,
            follower: b.follower,
            step: b.step,
            believed: None,
        }))
    }

    /// Estimate of the likeliest place of the aircraft, only while that is open: the mean of the heaviest belief,
    /// with the spread of all about it, all of one state. `main` is what the navigator goes by.
    pub fn likeliest(&self, main: &Estimate) -> Option<Estimate> {
        if !self.are_open() {
            return None;
        }
        let mut all = vec![(self.main, main.clone())];
        let others = self.unforeseen.iter().chain(&self.others);
        all.extend(others.map(|belief| (belief.weight, belief.engine.state())));
        let heaviest = all.iter().max_by(|a, b| a.0.total_cmp(&b.0))?;
        let mean = heaviest.1.mean.clone();
        let sum: f64 = all.iter().map(|(weight, _)| weight).sum();
        let mut covariance = nalgebra::DMatrix::zeros(mean.len(), mean.len());
        for (weight, estimate) in &all {
            let off = &estimate.mean - &mean;
            covariance += (&estimate.covariance + &off * off.transpose()) * (weight / sum);
        }
        Some(Estimate { mean, covariance })
    }

    /// Places that are followed, in words.
    pub fn words(&self) -> String {
        let Some(likeliest) = self.others.first() else {
            return RegistrationRefusal::Open.reason().to_owned();
        };
        format!(
            "{} other places are followed, the likeliest with a probability of {}",
            self.others.len(),
            probability_words(likeliest.weight)
        )
    }
}

/// A belief before a frame.
#[derive(Clone, Copy)]
struct Parent<'a> {
    engine: &'a dyn Engine,
    follower: &'a Follower,
    weight: f64,
    step: Option<&'a PredictedStep>,
}

impl<'a> From<&'a PlaceBelief> for Parent<'a> {
    fn from(belief: &'a PlaceBelief) -> Self {
        Self {
            engine: belief.engine.as_ref(),
            follower: &belief.follower,
            weight: belief.weight,
            step: belief.step.as_ref(),
        }
    }
}

/// The belief from which a place follows most, and how much follows from all.
#[derive(Default)]
struct Heaviest<'a> {
    parent: Option<(Parent<'a>, f64)>,
    together: f64,
}

impl<'a> Heaviest<'a> {
    fn offer(&mut self, parent: Parent<'a>, weight: f64) {
        self.together += weight;
        if self.parent.is_none_or(|(_, most)| weight > most) {
            self.parent = Some((parent, weight));
        }
    }
}
