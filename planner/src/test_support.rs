//! Shared helpers for tests of random tasks: from two texts to a grounded task, from a plan to a
//! verdict.

use crate::heuristics::{Costs, Estimate, HeuristicKind, View};
use crate::ids::{OperatorId, StateId};
use crate::search::{Bound, Job, Query, SearchMeter, Shared};
use crate::{GroundOptions, State, Task, ground};
use budget::Budget;

/// A grounded task with its model.
pub(crate) struct Grounded {
    pub(crate) task: Task,
    pub(crate) domain: pddl::model::Domain,
    pub(crate) problem: pddl::model::Problem,
}

impl Grounded {
    /// Parses and grounds a domain and a problem; panics on mistakes.
    pub(crate) fn new((domain, problem): (String, String)) -> Self {
        let parsed = pddl::parse_domain(&pddl::Source::new("domain", domain.clone()), &[]);
        let model = parsed.model.unwrap_or_else(|| panic!("{domain}\n{:?}", parsed.diagnostics));
        let parsed = pddl::parse_problem(&pddl::Source::new("problem", problem.clone()), &model);
        let problem = parsed.model.unwrap_or_else(|| panic!("{problem}\n{:?}", parsed.diagnostics));
        let task = ground(&model, &problem, &GroundOptions::default()).unwrap();
        Self { task, domain: model, problem }
    }

    /// The validator's verdict on these steps from the initial state.
    pub(crate) fn verdict<'o>(
        &self,
        operators: impl IntoIterator<Item = &'o OperatorId>,
    ) -> validator::Verdict {
        let steps = operators.into_iter().map(|&o| self.task.operator(o)).map(|o| pddl::PlanStep {
            action: o.action,
            arguments: o.arguments.to_vec(),
            span: pddl::Span::default(),
        });
        validator::validate(&self.domain, &self.problem, &pddl::SequentialPlan::new(steps.collect()))
    }

    /// The estimate of a heuristic that starts in `state`, for the problem's goal, and the
    /// operators that it prefers there.
    pub(crate) fn estimate(&self, kind: HeuristicKind, state: &State) -> (Estimate, Vec<OperatorId>) {
        let task = &self.task;
        let query = Query { state, ..Query::of(task) };
        let (barred, meter) = (query.barred(task), SearchMeter::new(Budget::default()));
        let (bound, shared) = (Bound::none(), Shared::default());
        let goal = query.goal;
        let job = Job { task, state, goal, barred: &barred, meter: &meter, bound: &bound, shared: &shared };
        let mut heuristic = kind.build(&job, Costs::Real);
        heuristic.start(StateId(0), state.words());
        let applicable = task.applicable(state);
        let view = View { id: StateId(0), words: state.words(), applicable: &applicable };
        let mut preferred = Vec::new();
        let estimate = heuristic.estimate(&view, Some(&mut preferred));
        assert!(preferred.iter().all(|o| applicable.contains(o)), "{kind:?} prefers what cannot be done");
        (estimate, preferred)
    }
}
