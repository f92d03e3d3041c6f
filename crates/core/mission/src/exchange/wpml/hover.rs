//! Hovering at way-points: an action of DJI's, among others that are kept as they stand.

use std::fmt::Write;

use super::super::xml::{NamedText, XmlElement};
use super::{TEMPLATE, text_of};

/// Number of the first group of actions that is ours: those of files are counted from zero.
const FIRST_GROUP: usize = 60_000;

/// Seconds of the hovering that elements of a way-point say; `None` without any. Groups that span way-points are no
/// matter of one of them.
pub(super) fn hover<'a>(elements: impl Iterator<Item = &'a XmlElement>) -> Option<f64> {
    let seconds = elements
        .filter(|e| is_own_group(e))
        .flat_map(|group| group.all("action"));
    let sum: f64 = seconds.filter_map(seconds_of).sum();
    (sum > 0.0).then_some(sum)
}

fn is_own_group(element: &XmlElement) -> bool {
    let index = |name| element.child_text(name);
    element.name == "actionGroup" && index("actionGroupStartIndex") == index("actionGroupEndIndex")
}

fn seconds_of(action: &XmlElement) -> Option<f64> {
    if action.child_text("actionActuatorFunc") != Some("hover") {
        return None;
    }
    let parameters = action.child("actionActuatorFuncParam")?;
    parameters.child_text("hoverTime")?.parse().ok()
}

/// Elements of way-point `index` as text, in which it hovers for so many seconds and no others.
pub(super) fn with_hover(rest: &str, index: usize, seconds: Option<f64>) -> String {
    let text = format!("<all>{rest}</all>");
    let source = NamedText {
        file: TEMPLATE,
        text: &text,
    };
    // What was read was written by us; what somebody changed by hand has no hovering.
    let Ok(mut root) = source.root() else {
        return rest.to_owned();
    };
    // A group of ours has the number of the way-point that it belonged to.
    let is_ours = |group: &XmlElement| {
        let number = group
            .child_text("actionGroupId")
            .and_then(|t| t.parse().ok());
        number.is_some_and(|number: usize| number >= FIRST_GROUP)
    };
    if hover(root.children.iter()) == seconds && !root.children.iter().any(is_ours) {
        return rest.to_owned();
    }
    for group in root.children.iter_mut().filter(|group| is_own_group(group)) {
        group.children.retain(|child| seconds_of(child).is_none());
    }
    let acts = |child: &XmlElement| child.name != "actionGroup" || child.child("action").is_some();
    root.children.retain(acts);
    let mut text = text_of(root.children.iter());
    if let Some(seconds) = seconds {
        let group = FIRST_GROUP + index;
        // Writing into a string cannot fail.
        let _ = write!(
            text,
            "<wpml:actionGroup><wpml:actionGroupId>{group}</wpml:actionGroupId>\
             <wpml:actionGroupStartIndex>{index}</wpml:actionGroupStartIndex>\
             <wpml:actionGroupEndIndex>{index}</wpml:actionGroupEndIndex>\
             <wpml:actionGroupMode>sequence</wpml:actionGroupMode><wpml:actionTrigger>\
             <wpml:actionTriggerType>reachPoint</wpml:actionTriggerType></wpml:actionTrigger><wpml:action>\
             <wpml:actionId>0</wpml:actionId><wpml:actionActuatorFunc>hover</wpml:actionActuatorFunc>\
             <wpml:actionActuatorFuncParam><wpml:hoverTime>{seconds}</wpml:hoverTime>\
             </wpml:actionActuatorFuncParam></wpml:action></wpml:actionGroup>"
        );
    }
    text
}
