//! What is left of a formula after the states so far: formula progression.
//!
//! Problem: a constraint is about all states of a run, and the run is not over. Idea: rewrite the formula at each state to
//! what the following states must satisfy. `False` means that no future can mend it. Time is dense: a state lasts until
//! the next one begins, and a formula holds or not at each moment of it. So a state that did not change a formula's facts
//! changes nothing of what is left of it, and only the facts that changed need to be looked at. Of the moments of one state
//! its first decides about what must hold at every moment, and its last, or the last one before a deadline, about what may
//! still come.
//!
//! Invariant: a residue is a set of what is open, without duplicates. Of two equal operators with different deadlines only
//! the earlier one stays below `All`, and only the later one below `Any`, so a residue does not grow with the run.
//!
//! Source: Bacchus & Kabanza, "Planning for temporally extended goals", AMAI 1998, §2.4; Gerevini & Long, "Plan
//! constraints and preferences in PDDL3", 2005, §3 (the operators, on finite traces).

use crate::compile::slot;
use crate::facts::{Facts, Key};
use crate::formula::{Formula, Part, PartId};
use dsr::NodeId;
use pddl::model::VariableId;
use smallvec::SmallVec;

/// A moment, in nanoseconds since the start of the graph.
pub(crate) type Moment = u64;

/// The nodes for the variables of a formula.
pub(crate) type Environment = SmallVec<[Option<NodeId>; 4]>;

/// What is left of a formula.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Residue {
    True,
    False,
    All(Vec<Residue>),
    Any(Vec<Residue>),
    Not(Box<Residue>),
    /// An operator that is not decided.
    Open(PartId, Environment, Waiting),
}

/// What an operator waits for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Waiting {
    /// For a window to open: its first moment, and its last one if it closes.
    Window { from: Moment, last: Option<Moment> },
    /// For every moment, up to the last one of the window if it closes.
    Every { last: Option<Moment> },
    /// For a state not later than this.
    State { by: Option<Moment> },
    /// For the last state.
    End,
    /// For the first series of states, for its end, and for a second one.
    Series(u8),
    /// For the second condition.
    Earlier,
}

/// A formula in the present state.
#[derive(Clone, Copy)]
pub(crate) struct At<'a> {
    pub(crate) formula: &'a Formula,
    pub(crate) facts: &'a Facts,
    pub(crate) now: Moment,
}

impl At<'_> {
    /// What is left of a part that is to hold from this state on.
    pub(crate) fn begin(&self, id: PartId, environment: &Environment) -> Residue {
        let open = |waiting| self.progress(&Residue::Open(id, environment.clone(), waiting));
        match self.formula.part(id) {
            Part::Holds { condition, arguments } => {
                let nodes: Option<Key> = arguments.iter().map(|&v| environment[slot(v)]).collect();
                truth(nodes.is_some_and(|key| self.facts.holds(*condition, &key)))
            }
            Part::All(parts) => all(parts.iter().map(|&part| self.begin(part, environment))),
            Part::Any(parts) => any(parts.iter().map(|&part| self.begin(part, environment))),
            Part::Not(part) => not(self.begin(*part, environment)),
            Part::Every(variables, part) => {
                let environments = self.environments(variables, environment);
                all(environments.iter().map(|inner| self.begin(*part, inner)))
            }
            Part::Some(variables, part) => {
                let environments = self.environments(variables, environment);
                any(environments.iter().map(|inner| self.begin(*part, inner)))
            }
            Part::AtEnd(_) => open(Waiting::End),
            Part::Globally { from, until, .. } => {
                if until.is_some_and(|until| until <= from.unwrap_or_default()) {
                    return Residue::True;
                }
                let last = until.map(|until| self.now.saturating_add(until - 1));
                match from {
                    None => open(Waiting::Every { last }),
                    Some(from) => open(Waiting::Window { from: self.now.saturating_add(*from), last }),
                }
            }
            Part::Finally { within, .. } => {
                open(Waiting::State { by: within.map(|within| self.now.saturating_add(within)) })
            }
            Part::AtMostOnce(_) => open(Waiting::Series(0)),
            Part::Before(..) => open(Waiting::Earlier),
        }
    }

    /// Every way to complete an environment with nodes for these variables.
    pub(crate) fn environments(&self, variables: &[VariableId], around: &Environment) -> Vec<Environment> {
        let mut found = vec![around.clone()];
        for &variable in variables {
            let nodes = self.facts.nodes_of(&self.formula.variables[slot(variable)].1);
            let with = |environment: &Environment, node: NodeId| {
                let mut environment = environment.clone();
                environment[slot(variable)] = Some(node);
                environment
            };
            found = found.iter().flat_map(|e| nodes.iter().map(|&node| with(e, node))).collect();
        }
        found
    }

    /// What is left after this state, of what was left before it.
    pub(crate) fn progress(&self, residue: &Residue) -> Residue {
        match residue {
            Residue::True | Residue::False => residue.clone(),
            Residue::All(parts) => all(parts.iter().map(|part| self.progress(part))),
            Residue::Any(parts) => any(parts.iter().map(|part| self.progress(part))),
            Residue::Not(part) => not(self.progress(part)),
            Residue::Open(id, environment, waiting) => self.step(*id, environment, *waiting),
        }
    }

    fn step(&self, id: PartId, environment: &Environment, waiting: Waiting) -> Residue {
        let stays = |waiting| Residue::Open(id, environment.clone(), waiting);
        match (self.formula.part(id), waiting) {
            (_, Waiting::Every { last: Some(last) }) if last < self.now => Residue::True,
            // Of several versions at its first moment, the window opens on the last one.
            (_, Waiting::Window { .. }) => stays(waiting),
            (Part::Globally { part, .. }, Waiting::Every { last }) => {
                all([self.begin(*part, environment), stays(Waiting::Every { last })])
            }
            (_, Waiting::State { by: Some(by) }) if by < self.now => Residue::False,
            (Part::Finally { part, .. }, Waiting::State { .. }) => {
                any([self.begin(*part, environment), stays(waiting)])
            }
            (Part::AtMostOnce(part), Waiting::Series(series)) => {
                match (series, self.begin(*part, environment) == Residue::True) {
                    (0, true) => stays(Waiting::Series(1)),
                    (1, false) => stays(Waiting::Series(2)),
                    (2, true) => Residue::False,
                    _ => stays(waiting),
                }
            }
            (Part::Before(if_, then), Waiting::Earlier) => {
                if self.begin(*if_, environment) == Residue::True {
                    Residue::False
                } else if self.begin(*then, environment) == Residue::True {
                    Residue::True
                } else {
                    stays(waiting)
                }
            }
            _ => stays(waiting),
        }
    }

    /// A window that opens now.
    fn opened(&self, residue: &Residue) -> Residue {
        match residue {
            Residue::Open(id, environment, Waiting::Window { last, .. }) => {
                self.step(*id, environment, Waiting::Every { last: *last })
            }
            other => other.clone(),
        }
    }

    /// What is left when this state has lasted until just before a moment.
    pub(crate) fn elapse(&self, residue: &Residue, until: Moment) -> Residue {
        match residue {
            Residue::True | Residue::False => residue.clone(),
            Residue::All(parts) => all(parts.iter().map(|part| self.elapse(part, until))),
            Residue::Any(parts) => any(parts.iter().map(|part| self.elapse(part, until))),
            Residue::Not(part) => not(self.elapse(part, until)),
            Residue::Open(_, _, Waiting::Window { from, .. }) if *from < until => {
                let then = At { now: *from, ..*self };
                then.elapse(&then.opened(residue), until)
            }
            // What must hold at the last moment, or may hold then at the latest.
            Residue::Open(
                id,
                environment,
                Waiting::State { by: Some(last) } | Waiting::Every { last: Some(last) },
            ) if *last < until => match self.formula.part(*id) {
                Part::Finally { part, .. } | Part::Globally { part, .. } => {
                    let then = At { now: *last, ..*self };
                    then.elapse(&then.begin(*part, environment), until)
                }
                _ => residue.clone(),
            },
            Residue::Open(..) => residue.clone(),
        }
    }

    /// Whether the formula holds if this state is the last. `in_time`: the truth of what had time left to come; it counts
    /// as false where nothing is given.
    pub(crate) fn ends_well(&self, residue: &Residue, in_time: Option<bool>) -> bool {
        match residue {
            Residue::True => true,
            Residue::False => false,
            Residue::All(parts) => parts.iter().all(|part| self.ends_well(part, in_time)),
            Residue::Any(parts) => parts.iter().any(|part| self.ends_well(part, in_time)),
            Residue::Not(part) => !self.ends_well(part, in_time.map(|truth| !truth)),
            Residue::Open(id, environment, waiting) => match (self.formula.part(*id), waiting) {
                // The last state lasts for ever, so the window opens on it.
                (Part::Globally { part, .. }, Waiting::Window { .. }) | (Part::AtEnd(part), _) => {
                    self.ends_well(&self.begin(*part, environment), in_time)
                }
                (_, Waiting::State { by: Some(by) }) if *by >= self.now => in_time == Some(true),
                (_, Waiting::State { .. }) => false,
                _ => true,
            },
        }
    }
}

/// The next moment at which the residue changes although the state does not.
pub(crate) fn deadline(residue: &Residue) -> Option<Moment> {
    match residue {
        Residue::True | Residue::False => None,
        Residue::All(parts) | Residue::Any(parts) => parts.iter().filter_map(deadline).min(),
        Residue::Not(part) => deadline(part),
        Residue::Open(_, _, Waiting::State { by } | Waiting::Every { last: by }) => *by,
        Residue::Open(_, _, Waiting::Window { from, .. }) => Some(*from),
        Residue::Open(..) => None,
    }
}

fn truth(holds: bool) -> Residue {
    if holds { Residue::True } else { Residue::False }
}

fn not(residue: Residue) -> Residue {
    match residue {
        Residue::True => Residue::False,
        Residue::False => Residue::True,
        Residue::Not(inner) => *inner,
        other => Residue::Not(Box::new(other)),
    }
}

fn all(parts: impl IntoIterator<Item = Residue>) -> Residue {
    let mut open = Vec::new();
    for part in parts {
        match part {
            Residue::True => {}
            Residue::False => return Residue::False,
            Residue::All(parts) => open.extend(parts),
            other => open.push(other),
        }
    }
    // The earlier of two deadlines implies the later one.
    gather(open, Residue::True, Residue::All, Ord::min)
}

fn any(parts: impl IntoIterator<Item = Residue>) -> Residue {
    let mut open = Vec::new();
    for part in parts {
        match part {
            Residue::False => {}
            Residue::True => return Residue::True,
            Residue::Any(parts) => open.extend(parts),
            other => open.push(other),
        }
    }
    gather(open, Residue::False, Residue::Any, Ord::max)
}

/// A set of parts, without duplicates, in which an operator that waits for a state occurs with one deadline.
fn gather(
    mut open: Vec<Residue>,
    none: Residue,
    several: fn(Vec<Residue>) -> Residue,
    prefer: fn(Moment, Moment) -> Moment,
) -> Residue {
    if open.len() > 1 {
        open.sort_unstable();
        open.dedup_by(|next, kept| match (next, kept) {
            (
                Residue::Open(next, around, Waiting::State { by: Some(other) }),
                Residue::Open(kept, environment, Waiting::State { by: Some(by) }),
            ) if next == kept && around == environment => {
                *by = prefer(*by, *other);
                true
            }
            (next, kept) => next == kept,
        });
    }
    match open.len() {
        0 => none,
        1 => open.remove(0),
        _ => several(open),
    }
}
