//! Headings and turns that the way-points of a template have in common, for waylines, which state them at each.

use std::fmt::Write;

use super::super::xml::{NamedText, XmlElement};
use super::{TEMPLATE, text_of};

/// Heading and turn of way-points of which nothing says one.
pub(super) const HEADING: &str = "<wpml:waypointHeadingMode>followWayline</wpml:waypointHeadingMode>\
     <wpml:waypointHeadingPathMode>followBadArc</wpml:waypointHeadingPathMode>";
pub(super) const TURN: &str = "toPointAndStopWithDiscontinuityCurvature";
/// The turn that begins before its way-point, and how far before where nothing says that, metres: 0 is not allowed.
const EARLY_TURN: &str = "coordinateTurn";
const EARLY: f64 = 0.2;
/// Members of a way-point that both files have, and the member of a template's that says that the common one goes before it.
const OF_BOTH: [(&str, Option<&str>); 5] = [
    ("waypointHeadingParam", Some("useGlobalHeadingParam")),
    ("waypointTurnParam", Some("useGlobalTurnParam")),
    ("useStraightLine", None),
    ("waypointGimbalHeadingParam", None),
    ("actionGroup", None),
];

/// Values that a template's way-points have in common.
pub(super) struct SharedParameters {
    /// Elements of the heading.
    heading: Option<String>,
    /// Mode of turns.
    turn: Option<String>,
}

impl SharedParameters {
    /// Those among the elements of a template's folder.
    pub fn of(folder: &str) -> Self {
        let root = elements(folder);
        let child = |name: &str| root.as_ref()?.child(name);
        Self {
            heading: child("globalWaypointHeadingParam").map(|e| text_of(e.children.iter())),
            turn: child("globalWaypointTurnMode").map(|e| e.text.clone()),
        }
    }

    /// Elements of a way-point, with those that waylines need and its file did not have.
    pub fn complete(&self, mut rest: String) -> String {
        if !rest.contains("<wpml:waypointHeadingParam>") {
            let heading = self.heading.as_deref().unwrap_or(HEADING);
            let heading =
                format!("<wpml:waypointHeadingParam>{heading}</wpml:waypointHeadingParam>");
            rest.insert_str(0, &heading);
        }
        if !rest.contains("<wpml:waypointTurnParam>") {
            let turn = self.turn.as_deref().unwrap_or(TURN);
            let before = if turn == EARLY_TURN { EARLY } else { 0.0 };
            // Writing into a string cannot fail.
            let _ = write!(
                rest,
                "<wpml:waypointTurnParam><wpml:waypointTurnMode>{turn}</wpml:waypointTurnMode>\
                 <wpml:waypointTurnDampingDist>{before}</wpml:waypointTurnDampingDist></wpml:waypointTurnParam>"
            );
        }
        rest
    }

    /// Those of the members of a template's way-point that the waylines have as well.
    pub fn of_both(&self, template: &str) -> String {
        let is_known = [self.heading.is_some(), self.turn.is_some()];
        elements(template).map_or_else(String::new, |root| {
            let is = |name: &str| root.child_text(name) == Some("1");
            let both = |child: &&XmlElement| {
                let at = OF_BOTH.iter().position(|(name, _)| *name == child.name);
                at.is_some_and(|at| {
                    let is_common = OF_BOTH[at].1.is_some_and(is);
                    !(is_common && is_known.get(at) == Some(&true))
                })
            };
            text_of(root.children.iter().filter(both))
        })
    }
}

/// Elements out of text that was written by us; of what somebody changed by hand there may be none.
fn elements(text: &str) -> Option<XmlElement> {
    let text = format!("<all>{text}</all>");
    let source = NamedText {
        file: TEMPLATE,
        text: &text,
    };
    source.root().ok()
}
