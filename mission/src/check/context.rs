//! What a check looks at.

use std::collections::BTreeMap;

use super::grounding::Grounding;
use crate::mission::Mission;

/// The outcomes besides `end` of each skill that rules may name, by the skill's name.
pub type SkillOutcomes = BTreeMap<&'static str, &'static [&'static str]>;

/// What a check looks at.
pub(super) struct Context<'m> {
    pub(super) mission: &'m Mission,
    /// The outcomes of the skills.
    pub(super) skills: &'m SkillOutcomes,
    /// Everything that may happen.
    pub(super) grounding: &'m Grounding<'m>,
}
