//! Durative actions, each as one instantaneous action, for a planner that knows no time.
//!
//! Problem: between the start and the end of a durative action its effects hold that its start gives, and its conditions
//! must hold until then. Idea: nothing else happens meanwhile, so start and end become one step. What holds `over all`
//! or `at end` is regressed through the effects at start; what the end takes back of the start is dropped. Beside this
//! *whole* stands the *rest* of an action that has started: its conditions from then on, and its effects at end. Invariant:
//! the step leads exactly where the action leads if nothing else happens, and it can be taken exactly if the action can.
//!
//! What is lost is concurrency that is *required*: what holds only during an action cannot serve another one. Such
//! effects are listed ([`Meanwhile`]), and an action that can never run alone is refused by name.
//!
//! Source: Coles, Fox, Halsey, Long & Smith, "Managing concurrency in temporal planning using planner-scheduler
//! interaction", AIJ 2009, §4 (compression-safe actions); required concurrency: Cushing, Kambhampati, Mausam & Weld, "When
//! is temporal planning really temporal?", IJCAI 2007. Deviation: effects at start that are conditional or quantified are
//! refused where a later condition reads them.

mod action;
mod error;
mod logic;

pub use error::CompressionError;

use action::{Compressing, Passing};
use pddl::model::{
    ActionId, Condition, ConditionKind, Domain, DurativeAction, DurativeActionId, Effect, EffectKind, Name,
    Predicate, PredicateId, Problem, TimeSpecifier, Variables,
};

/// The two steps of a durative action.
#[derive(Clone, Debug)]
pub(crate) struct Steps {
    pub(crate) durative: DurativeActionId,
    pub(crate) whole: ActionId,
    pub(crate) rest: ActionId,
    /// That it is under way: after its start was perceived, before its end.
    pub(crate) under_way: PredicateId,
}

/// An action that could use what another one gives only while it runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Meanwhile {
    /// The action that could use it.
    pub action: Name,
    /// What it needs.
    pub predicate: Name,
    /// The action that gives it.
    pub giver: Name,
}

/// A domain without durative actions.
#[derive(Clone, Debug)]
pub(crate) struct Compressed {
    pub(crate) domain: Domain,
    pub(crate) steps: Vec<Steps>,
    /// What is lost: with one of these, an answer "no plan" is about plans that need no concurrency.
    pub(crate) meanwhile: Vec<Meanwhile>,
}

/// The domain with each durative action as two instantaneous ones, behind those that it has.
///
/// # Errors
/// The first action that can never run alone, or that is not followed; and the first that needs what another one gives
/// only while it runs, if nothing else gives it in this problem.
pub(crate) fn compress(domain: &Domain, problem: &Problem) -> Result<Compressed, CompressionError> {
    let mut sequential = domain.clone();
    sequential.durative_actions = Default::default();
    let (mut steps, mut passing) = (Vec::new(), Vec::new());
    for (durative, action) in domain.durative_actions.enumerate() {
        let compressing = Compressing::new(domain, action)?;
        let parameters = action.variables.parameters().iter().cloned().collect();
        let variables = Variables { slots: parameters, parameters: action.variables.parameters };
        let predicate =
            Predicate { name: under_way(&action.name), variables, derived: false, span: action.name_span };
        let under_way = sequential.predicates.push(predicate);
        let whole = sequential.actions.push(compressing.whole(under_way, &mut passing)?);
        let rest = sequential.actions.push(compressing.rest(under_way));
        steps.push(Steps { durative, whole, rest, under_way });
    }
    let rests: Vec<ActionId> = steps.iter().map(|own: &Steps| own.rest).collect();
    let mut meanwhile = Vec::new();
    for Passing { giver, predicate, positive } in passing {
        let readers = sequential.actions.enumerate().filter(|(id, action)| {
            let by = |condition: &Condition| reads(condition, predicate, positive);
            !rests.contains(id) && (by(&action.precondition) || guards(&action.effect, &by))
        });
        for (_, action) in readers {
            let predicate_name = domain.predicates[predicate].name.clone();
            let is_given = !positive
                || problem.init.iter().any(|fact| fact.predicate == predicate)
                || lasts(domain, predicate);
            if !is_given {
                let (action, span) = (action.name.clone(), action.name_span);
                return Err(CompressionError::OnlyMeanwhile {
                    action,
                    predicate: predicate_name,
                    giver,
                    span,
                });
            }
            let (action, giver) = (action.name.clone(), giver.clone());
            meanwhile.push(Meanwhile { action, predicate: predicate_name, giver });
        }
    }
    Ok(Compressed { domain: sequential, steps, meanwhile })
}

/// Whether some action makes an atom of the predicate true for good.
fn lasts(domain: &Domain, predicate: PredicateId) -> bool {
    let gives = |effect: &Effect, wanted: bool| {
        let mut found = false;
        effect.each(&mut |part| match &part.kind {
            EffectKind::Add(atom) => found |= wanted && atom.predicate == predicate,
            EffectKind::Delete(atom) => found |= !wanted && atom.predicate == predicate,
            _ => {}
        });
        found
    };
    let at = |action: &DurativeAction, when: &TimeSpecifier, adds: bool| {
        action.effects.iter().any(|timed| timed.when == *when && gives(&timed.effect, adds))
    };
    let (start, end) = (&TimeSpecifier::Start, &TimeSpecifier::End);
    domain.actions.iter().any(|action| gives(&action.effect, true))
        || domain
            .durative_actions
            .iter()
            .any(|action| at(action, end, true) || at(action, start, true) && !at(action, end, false))
}

/// Whether a condition can be helped by an atom of the predicate that is true, or that is false.
fn reads(condition: &Condition, predicate: PredicateId, positive: bool) -> bool {
    match &condition.kind {
        ConditionKind::Atom(atom) => positive && atom.predicate == predicate,
        ConditionKind::Not(part) => reads(part, predicate, !positive),
        ConditionKind::Imply(if_, then) => {
            reads(if_, predicate, !positive) || reads(then, predicate, positive)
        }
        _ => condition.parts().any(|part| reads(part, predicate, positive)),
    }
}

fn guards(effect: &Effect, by: &impl Fn(&Condition) -> bool) -> bool {
    matches!(&effect.kind, EffectKind::When(condition, _) if by(condition))
        || effect.parts().iter().any(|part| guards(part, by))
}

/// No name of PDDL has a space.
fn under_way(action: &Name) -> Name {
    Name::new(&format!("{action} under way"))
}
