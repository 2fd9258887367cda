//! The conditions of goals as literals of the planner.
//!
//! Problem: the planner has one goal, grounds it with the problem, and searches best for a conjunction of facts. Idea: a
//! conjunct that is a perceived fact, or its negation, is taken as it is; any other part of a goal becomes a derived
//! predicate without parameters, which stands for it. The goal of a plan is then the union of the literals of the goals
//! that it serves. Invariant: the ids of the domain and of the problem keep their meaning; only predicates and axioms are
//! added, behind those that are there.

use super::text::GoalText;
use pddl::Span;
use pddl::model::{
    Atom, Axiom, Condition, ConditionKind, Domain, Idx, Name, ObjectId, Predicate, PredicateId, Problem,
    Term, Variables,
};

/// A goal as literals over ground atoms.
#[derive(Clone, Debug, Default)]
pub(crate) struct Compiled {
    /// Each atom with its arguments, and whether it must hold.
    pub(crate) literals: Vec<(PredicateId, Vec<ObjectId>, bool)>,
}

impl Compiled {
    /// As conditions without variables.
    pub(crate) fn conditions(&self) -> impl Iterator<Item = Condition> + '_ {
        let span = Span::default();
        self.literals.iter().map(move |(predicate, arguments, positive)| {
            let arguments = arguments.iter().map(|&o| Term::Object(o)).collect();
            let kind = ConditionKind::Atom(Atom { predicate: *predicate, arguments, span });
            let atom = Condition { kind, span };
            if *positive { atom } else { Condition { kind: ConditionKind::Not(Box::new(atom)), span } }
        })
    }
}

/// Compiles the goals. `perceived`: the predicates of the domain whose facts are always kept.
pub(crate) fn compile(
    domain: &mut Domain,
    problem: &mut Problem,
    goals: &[GoalText],
    perceived: &[PredicateId],
) -> (Vec<Compiled>, Vec<PredicateId>) {
    let mut derived = Vec::new();
    let compiled: Vec<Compiled> = goals
        .iter()
        .map(|goal| {
            let mut conjuncts = Vec::new();
            flatten(&goal.condition, &mut conjuncts);
            let mut compiled = Compiled::default();
            for conjunct in conjuncts {
                let literal =
                    literal(conjunct).filter(|(p, ..)| perceived.contains(p)).unwrap_or_else(|| {
                        let predicate = stand_in(domain, goal, conjunct);
                        derived.push(predicate);
                        (predicate, Vec::new(), true)
                    });
                compiled.literals.push(literal);
            }
            compiled
        })
        .collect();
    let parts = compiled.iter().flat_map(Compiled::conditions).collect();
    problem.goal = Condition { kind: ConditionKind::And(parts), span: problem.goal_span };
    problem.goal_variables = Variables::default();
    (compiled, derived)
}

fn flatten<'c>(condition: &'c Condition, conjuncts: &mut Vec<&'c Condition>) {
    match &condition.kind {
        ConditionKind::And(parts) => parts.iter().for_each(|part| flatten(part, conjuncts)),
        _ => conjuncts.push(condition),
    }
}

fn literal(condition: &Condition) -> Option<(PredicateId, Vec<ObjectId>, bool)> {
    let (atom, positive) = match &condition.kind {
        ConditionKind::Atom(atom) => (atom, true),
        ConditionKind::Not(inner) => match &inner.kind {
            ConditionKind::Atom(atom) => (atom, false),
            _ => return None,
        },
        _ => return None,
    };
    let object = |term: &Term| match term {
        Term::Object(object) => Some(*object),
        Term::Variable(_) => None,
    };
    Some((atom.predicate, atom.arguments.iter().map(object).collect::<Option<_>>()?, positive))
}

/// A derived predicate that holds exactly where the condition does.
fn stand_in(domain: &mut Domain, goal: &GoalText, condition: &Condition) -> PredicateId {
    let base = format!("goal-{}", goal.name);
    let free = |name: &str| domain.predicate(name).is_none();
    let name = std::iter::once(base.clone())
        .chain((2..).map(|count| format!("{base}-{count}")))
        .find(|name| free(name))
        .expect("there are more numbers than predicates");
    let predicate = PredicateId::from_index(domain.predicates.len());
    domain.predicates.push(Predicate {
        name: Name::new(&name),
        variables: Variables::default(),
        derived: true,
        span: condition.span,
    });
    // The variables of a goal are all quantified; those of other conjuncts stay unused.
    let variables = Variables { slots: goal.variables.slots.clone(), parameters: 0 };
    domain.axioms.push(Axiom { predicate, variables, body: condition.clone(), span: condition.span });
    predicate
}
