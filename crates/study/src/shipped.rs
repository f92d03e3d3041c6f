//! Plans that come with the program.

/// Texts of the plans that come with the program, the simplest first.
pub const SHIPPED_PLANS: [&str; 6] = [
    include_str!("../../../studies/wind.toml"),
    include_str!("../../../studies/hostile.toml"),
    include_str!("../../../studies/vehicles.toml"),
    include_str!("../../../studies/scenarios.toml"),
    include_str!("../../../studies/sensitivity.toml"),
    include_str!("../../../studies/hundred-thousand.toml"),
];

/// The question that the text of a plan asks, where it stands in a line of its own, as in those above; whoever asks need
/// not read the plan.
pub fn question_of(plan: &str) -> Option<&str> {
    let line = plan
        .lines()
        .find_map(|line| line.strip_prefix("question"))?;
    let text = line.trim_start().strip_prefix('=')?.trim();
    text.strip_prefix('"')?.strip_suffix('"')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::StudyPlan;

    #[test]
    fn every_plan_that_comes_with_the_program_can_be_followed_and_has_a_name_of_its_own() {
        let plans = SHIPPED_PLANS.map(|text| StudyPlan::read(text).unwrap());
        for (plan, text) in plans.iter().zip(SHIPPED_PLANS) {
            assert_eq!(question_of(text), Some(plan.question.as_str()));
        }
        let mut names = plans.map(|plan| plan.name);
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{names:?}");
    }
}
