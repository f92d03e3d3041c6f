//! Plans as they pass from a worker to the page: every part in its place, for the wire names none. Whoever takes one
//! links no reader of TOML.

use serde::{Deserialize, Serialize};

use super::by_name::ByName;
use super::measure::MeasureKind;
use super::plan::{DrawBy, StopRule, StudyMeasure, StudyPlan};
use super::study_mission::{PlanMission, PlanMissionParts};
use super::value::{SettingDistribution, SettingValue};

/// Value of a setting, with its kind before it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum ValuePart {
    Number(f64),
    Text(String),
}

/// Distribution of a setting, with its kind before it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum DistributionPart {
    Uniform([f64; 2]),
    LogUniform([f64; 2]),
    Normal([f64; 2]),
    Choice(Vec<ValuePart>),
}

/// Parts of a [`StudyPlan`], in the order of its fields.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyPlanParts {
    name: String,
    question: String,
    seed: u64,
    draws: u64,
    draw_by: DrawBy,
    scrambles: u64,
    fixed: Vec<(String, ValuePart)>,
    cross: Vec<(String, Vec<ValuePart>)>,
    draw: Vec<(String, DistributionPart)>,
    measure: Vec<(MeasureKind, Option<String>, Option<f64>)>,
    stop: Option<(String, f64, u64)>,
    missions: Vec<(String, PlanMissionParts)>,
}

impl From<SettingValue> for ValuePart {
    fn from(value: SettingValue) -> Self {
        match value {
            SettingValue::Number(number) => Self::Number(number),
            SettingValue::Text(text) => Self::Text(text),
        }
    }
}

impl From<ValuePart> for SettingValue {
    fn from(value: ValuePart) -> Self {
        match value {
            ValuePart::Number(number) => Self::Number(number),
            ValuePart::Text(text) => Self::Text(text),
        }
    }
}

/// Each of the values as the other type.
fn all<A, B: From<A>>(values: Vec<A>) -> Vec<B> {
    values.into_iter().map(B::from).collect()
}

impl From<SettingDistribution> for DistributionPart {
    fn from(distribution: SettingDistribution) -> Self {
        match distribution {
            SettingDistribution::Uniform(ends) => Self::Uniform(ends),
            SettingDistribution::LogUniform(ends) => Self::LogUniform(ends),
            SettingDistribution::Normal(of) => Self::Normal(of),
            SettingDistribution::Choice(values) => Self::Choice(all(values)),
        }
    }
}

impl From<DistributionPart> for SettingDistribution {
    fn from(distribution: DistributionPart) -> Self {
        match distribution {
            DistributionPart::Uniform(ends) => Self::Uniform(ends),
            DistributionPart::LogUniform(ends) => Self::LogUniform(ends),
            DistributionPart::Normal(of) => Self::Normal(of),
            DistributionPart::Choice(values) => Self::Choice(all(values)),
        }
    }
}

impl From<StudyPlan> for StudyPlanParts {
    fn from(plan: StudyPlan) -> Self {
        let measure = plan.measure.into_iter();
        Self {
            name: plan.name,
            question: plan.question,
            seed: plan.seed,
            draws: plan.draws,
            draw_by: plan.draw_by,
            scrambles: plan.scrambles,
            fixed: plan.fixed.into_named(ValuePart::from),
            cross: plan.cross.into_named(all),
            draw: plan.draw.into_named(DistributionPart::from),
            measure: measure.map(|it| (it.of, it.name, it.at_most)).collect(),
            stop: (plan.stop).map(|stop| (stop.measure, stop.half_width, stop.every)),
            missions: plan.missions.into_named(PlanMission::into_parts),
        }
    }
}

impl From<StudyPlanParts> for StudyPlan {
    fn from(parts: StudyPlanParts) -> Self {
        let measure = parts.measure.into_iter();
        Self {
            name: parts.name,
            question: parts.question,
            seed: parts.seed,
            draws: parts.draws,
            draw_by: parts.draw_by,
            scrambles: parts.scrambles,
            fixed: ByName::of_named(parts.fixed, SettingValue::from),
            cross: ByName::of_named(parts.cross, all),
            draw: ByName::of_named(parts.draw, SettingDistribution::from),
            measure: measure
                .map(|(of, name, at_most)| StudyMeasure { of, name, at_most })
                .collect(),
            missions: ByName::of_named(parts.missions, PlanMission::of_parts),
            stop: parts.stop.map(|(measure, half_width, every)| StopRule {
                measure,
                half_width,
                every,
            }),
        }
    }
}
