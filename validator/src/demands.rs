//! Trajectory constraints and preferences over the trajectory of one plan.
//!
//! The constraints of the domain and the problem are grounded once, before the first state. Each
//! state is recorded when it is reached. At the end the hard constraints are judged and the
//! violated soft ones are counted.

use crate::axiom::{Needs, Strata};
use crate::number::Number;
use crate::preference::violated;
use crate::scene::{Binding, Clock, Scene, each_instance};
use crate::state::State;
use crate::trace::{Demand, Watched};
use crate::trajectory::{Asked, Broken, Formula, Since, Trajectory};
use crate::universe::Universe;
use crate::verdict::{Breach, Failure, File, Position, Unsatisfied, Violations};
use pddl::model::{Condition, Constraint, Domain, Preference, Problem, Variables};

/// A soft constraint for one binding of its enclosing `forall`s.
#[derive(Clone, Debug)]
struct Soft<'a> {
    file: File,
    preference: &'a Preference<Constraint>,
    variables: &'a Variables,
    binding: Binding,
    formula: Formula,
}

/// The most violating states that are reported.
const STATES: usize = 16;

/// All demands on one plan during its execution.
#[derive(Clone, Debug)]
pub(crate) struct Demands<'a> {
    trajectory: Trajectory<'a>,
    hard: Vec<(File, Formula)>,
    soft: Vec<Soft<'a>>,
    needs: Needs,
    pub(crate) violations: Violations,
}

impl<'a> Demands<'a> {
    pub(crate) fn new(
        domain: &'a Domain,
        problem: &'a Problem,
        universe: &Universe,
        strata: &Strata,
        state: &State,
    ) -> Self {
        let mut demands = Self::none();
        for (file, constraints) in
            [(File::Domain, &domain.constraints), (File::Problem, &problem.constraints)]
        {
            let variables = &constraints.variables;
            let scene = Scene { universe, state, variables, clock: Clock::steps(0) };
            let mut binding = Binding::new(variables, &[]);
            for constraint in &constraints.hard {
                let formula = demands.trajectory.ground(scene, variables, constraint, &mut binding);
                demands.hard.push((file, formula));
            }
            for preference in &constraints.preferences {
                each_instance(scene, &preference.forall, &mut binding, &mut |binding| {
                    let formula = demands.trajectory.ground(scene, variables, &preference.body, binding);
                    demands.soft.push(Soft {
                        file,
                        preference,
                        variables,
                        binding: binding.clone(),
                        formula,
                    });
                });
            }
        }
        demands.needs = strata.needs(demands.trajectory.conditions().map(|(condition, ..)| condition));
        demands
    }

    /// No demands.
    pub(crate) fn none() -> Self {
        Self {
            trajectory: Trajectory::default(),
            hard: Vec::new(),
            soft: Vec::new(),
            needs: Needs::default(),
            violations: Violations::default(),
        }
    }

    /// Whether there are no demands, so states need not be recorded.
    pub(crate) fn are_none(&self) -> bool {
        self.hard.is_empty() && self.soft.is_empty()
    }

    /// The position of the last state.
    pub(crate) fn last(&self) -> Position {
        self.trajectory.last()
    }

    /// Whether the derived part of a state must be up to date when it is recorded.
    pub(crate) fn read_derived(&self) -> bool {
        !self.needs.are_none()
    }

    /// The derived predicates that must be up to date when a state is recorded.
    pub(crate) fn needs(&self) -> &Needs {
        &self.needs
    }

    /// The conditions whose truth is recorded.
    pub(crate) fn conditions(&self) -> impl Iterator<Item = (&'a Condition, &'a Variables, &Binding)> {
        self.trajectory.conditions()
    }

    /// Records a state.
    pub(crate) fn observe(&mut self, since: Since, universe: &Universe, state: &State) {
        if !self.are_none() {
            self.trajectory.observe(since, universe, state);
        }
    }

    /// Judges the hard constraints at the end. Returns the first violated one with its file.
    pub(crate) fn broken(&self) -> Option<(File, Broken)> {
        self.hard.iter().find_map(|(file, formula)| Some((*file, self.trajectory.broken(formula)?)))
    }

    /// The failure for a violated constraint and the unsatisfied parts of its condition.
    pub(crate) fn failure(&self, file: File, broken: &Broken, parts: Vec<Unsatisfied>) -> Box<Failure> {
        let time = |position| self.trajectory.time(position);
        let mut times: Vec<Number> = broken.states.iter().filter_map(|&position| time(position)).collect();
        times.dedup();
        let states = times.len();
        times.truncate(STATES);
        Box::new(Failure::Constraint {
            file,
            span: broken.span,
            breach: broken.breach,
            time: broken.breach.position().and_then(time),
            binding: self.trajectory.binding(broken),
            states,
            times,
            parts,
        })
    }

    /// The condition that was evaluated, its variables and their values.
    pub(crate) fn asked(&self, asked: Asked) -> (&'a Condition, &'a Variables, &Binding) {
        self.trajectory.asked_condition(asked)
    }

    /// Every constraint, with the intervals in which its conditions held.
    pub(crate) fn watched(&self) -> Vec<Watched> {
        let watched = |file, formula: &Formula, demand| {
            let breach = self.trajectory.breach(formula).map(|(_, breach)| breach);
            let time = |breach: Breach| breach.position().and_then(|at| self.trajectory.time(at));
            let broken = breach.map(|breach| (breach, time(breach)));
            let conditions = self.trajectory.stretches(formula);
            let binding = self.trajectory.values(formula);
            Watched { file, span: formula.span, demand, binding, broken, conditions }
        };
        let hard = self.hard.iter().map(|(file, formula)| watched(*file, formula, Demand::Hard));
        let soft = self
            .soft
            .iter()
            .map(|soft| watched(soft.file, &soft.formula, Demand::Preference(soft.preference.name.clone())));
        hard.chain(soft).collect()
    }

    /// Counts the violated soft constraints.
    pub(crate) fn count_soft(&mut self) {
        for soft in &self.soft {
            if !self.trajectory.satisfies(&soft.formula) {
                self.violations.add(violated(soft.preference, soft.variables, &soft.binding));
            }
        }
    }
}
