//! `wait`: does nothing and never ends; the rule's duration ends it.

use crate::skill::{Call, Equipment, Signature, Skill, Work};

pub(super) struct Wait;

impl Skill for Wait {
    fn signature(&self) -> Signature {
        Signature { name: "wait", arguments: &[], results: &[], outcomes: &[] }
    }

    fn launch(&self, _: Call, _: &Equipment) -> Work {
        Box::pin(std::future::pending())
    }
}
