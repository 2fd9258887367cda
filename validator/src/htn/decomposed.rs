//! Checking a plan with its decomposition.

use super::matching::{self, Assignment, Child, Limit, Match, Matching};
use super::placing::{Reading, Slot, place};
use super::schema::{Schema, unify};
use super::tree::{Tree, references};
use crate::cause::Causes;
use crate::prepared::Prepared;
use crate::scene::{Binding, Clock};
use crate::sequential;
use crate::state::State;
use crate::trace::Trace;
use crate::verdict::{Failure, Feature, NetworkFault, Parent, StepFault, Stop, Unsupported, Valid};
use pddl::model::{IndexVec, MethodId, SubtaskHead};
use pddl::{DecompositionId, HierarchicalPlan, PlanNode};
use rustc_hash::FxHashMap;

/// The most evaluations of preconditions in one plan.
const EVALUATIONS: u64 = 20_000_000;
/// The most combinations of readings that are tried.
const COMBINATIONS: u32 = 4096;

/// Judges a plan with its decomposition, starting in the initial state.
pub(crate) fn run(
    prepared: &Prepared<'_>,
    plan: &HierarchicalPlan,
    state: &mut State,
    trace: Option<&mut Trace>,
) -> Result<Valid, Stop> {
    let Some((variables, network)) = &prepared.problem.htn else {
        return Err(NetworkFault::NoNetwork.into());
    };
    let tree = Tree::new(plan)?;
    names_fit(prepared, plan)?;
    let root = Schema::of_problem(variables, network);
    let mut schemas = FxHashMap::<MethodId, Schema<'_>>::default();
    for task in &plan.decompositions {
        schemas
            .entry(task.method)
            .or_insert_with(|| Schema::of_method(&prepared.domain.methods[task.method]));
    }
    let decomposed = Decomposed { prepared, plan, tree, root, schemas };
    let mut tries = matching::TRIES;
    let root = decomposed.readings(Parent::Root, state, &mut tries)?;
    let mut tasks = IndexVec::new();
    for task in plan.decompositions.ids() {
        tasks.push(decomposed.readings(Parent::Task(task), state, &mut tries)?);
    }
    decomposed.execute(Readings { root, tasks }, state, trace)
}

/// Repeats the checks of the parser for a plan that was not parsed from text.
fn names_fit(prepared: &Prepared<'_>, plan: &HierarchicalPlan) -> Result<(), NetworkFault> {
    for (task, decomposition) in plan.decompositions.enumerate() {
        let schema = prepared.domain.tasks.get(decomposition.task);
        let method = prepared.domain.methods.get(decomposition.method);
        let (Some(schema), Some(_)) = (schema, method) else { return Err(NetworkFault::Unknown { task }) };
        prepared
            .fits(&schema.variables, &decomposition.arguments)
            .map_err(|fault: StepFault| NetworkFault::Arguments { task, fault })?;
    }
    Ok(())
}

/// The assignments of one task's subtasks that give the same order.
struct Alike {
    assignments: Vec<Assignment>,
    reading: Reading,
}

struct Several {
    alike: Vec<Alike>,
    /// Whether there may be further assignments.
    more: bool,
}

struct Readings {
    root: Several,
    tasks: IndexVec<DecompositionId, Several>,
}

impl Readings {
    fn of(&self, parent: Parent) -> &Several {
        match parent {
            Parent::Root => &self.root,
            Parent::Task(task) => &self.tasks[task],
        }
    }

    fn are_more(&self) -> bool {
        self.root.more || self.tasks.iter().any(|several| several.more)
    }
}

struct Decomposed<'d, 'a> {
    prepared: &'d Prepared<'a>,
    plan: &'d HierarchicalPlan,
    tree: Tree,
    root: Schema<'d>,
    schemas: FxHashMap<MethodId, Schema<'d>>,
}

impl Decomposed<'_, '_> {
    fn schema(&self, of: Parent) -> &Schema<'_> {
        match of {
            Parent::Root => &self.root,
            Parent::Task(task) => &self.schemas[&self.plan.decompositions[task].method],
        }
    }

    fn limit(&self) -> Stop {
        Stop::Unsupported(Unsupported { feature: Feature::MatchLimit, span: self.plan.root_span })
    }

    /// The assignments of a task's subtasks to those of its method.
    fn readings(&self, of: Parent, state: &State, tries: &mut u64) -> Result<Several, Stop> {
        let (prepared, plan) = (self.prepared, self.plan);
        let schema = self.schema(of);
        if let Some(span) = schema.durative() {
            let feature = match of {
                Parent::Root => Feature::DurativeSubtaskOfProblem,
                Parent::Task(_) => Feature::DurativeSubtaskOfDomain,
            };
            return Err(Stop::Unsupported(Unsupported { feature, span }));
        }
        let mut binding = Binding::default();
        binding.reset(schema.variables, &[]);
        if let Parent::Task(task) = of {
            let decomposition = &plan.decompositions[task];
            if prepared.domain.methods[decomposition.method].task != decomposition.task {
                return Err(NetworkFault::Method { task }.into());
            }
            let (terms, objects) = (schema.task_arguments, &decomposition.arguments);
            unify(&prepared.universe, schema.variables, terms, objects, &mut binding, &mut Vec::new())
                .map_err(|position| {
                    let object = objects.get(position).copied();
                    let fault = StepFault::Arity { expected: terms.len(), found: objects.len() };
                    object.map_or(NetworkFault::Arguments { task, fault }, |object| {
                        NetworkFault::MethodArguments { task, object, position }
                    })
                })?;
        }
        let children: Vec<Child<'_>> = references(plan, of)
            .iter()
            .map(|&reference| {
                let (head, arguments) = match reference.node {
                    PlanNode::Step(step) => {
                        let step = &plan.steps[step].step;
                        (SubtaskHead::Action(step.action), step.arguments.as_slice())
                    }
                    PlanNode::Decomposition(task) => {
                        let task = &plan.decompositions[task];
                        (SubtaskHead::Task(task.task), task.arguments.as_slice())
                    }
                };
                Child { head, arguments, range: self.tree.range(reference.node), reference }
            })
            .collect();
        let matching =
            Matching { universe: &prepared.universe, state, schema, of, children: &children, binding };
        match matching.all(tries) {
            Err(Limit) => Err(self.limit()),
            Ok(Match::Fault(fault)) => Err(fault.into()),
            Ok(Match::Constraints(mut binding)) => {
                let scene = prepared.scene(state, schema.variables, Clock::steps(0));
                let parts = prepared.lacks(scene, Causes::Steps, &schema.constraints, &mut binding);
                Err(NetworkFault::Constraints { of, parts }.into())
            }
            Ok(Match::Found { assignments, more }) => Ok(Several { alike: alike(schema, assignments), more }),
        }
    }

    fn execute(
        &self,
        mut readings: Readings,
        state: &mut State,
        trace: Option<&mut Trace>,
    ) -> Result<Valid, Stop> {
        let prepared = self.prepared;
        let steps = Slot::try_from(self.plan.steps.len()).unwrap_or(Slot::MAX);
        let windows = self.windows(&readings, steps);
        let mut evaluations = EVALUATIONS;
        let mut open: Vec<DecompositionId> = Vec::new();
        let mut waiting = windows.iter().peekable();
        let result = sequential::run(
            prepared,
            self.plan.steps.iter().map(|step| &step.step),
            state,
            trace,
            &mut |slot, state| {
                while let Some(window) = waiting.next_if(|window| window.first <= slot) {
                    open.push(window.task);
                }
                open.retain(|&task| {
                    self.note(task, slot, state, &mut readings.tasks[task], &mut evaluations);
                    slot < self.last(task, steps)
                });
            },
        );
        if let Err(failure) = &result
            && !matches!(**failure, Failure::Goal { .. } | Failure::Constraint { .. })
        {
            return result.map_err(Stop::Failure);
        }
        if evaluations == 0 {
            return Err(self.limit());
        }
        match self.place_some(&readings)? {
            None => result.map_err(Stop::Failure),
            Some(_) if readings.are_more() => Err(self.limit()),
            Some((task, from)) => Err(self.unplaced(&readings, task, from)),
        }
    }

    /// The last moment at which a task's precondition may hold: just before its first step.
    fn last(&self, task: DecompositionId, steps: Slot) -> Slot {
        self.tree.range(PlanNode::Decomposition(task)).first.min(steps)
    }

    /// Records whether a task's precondition holds now.
    fn note(
        &self,
        task: DecompositionId,
        slot: Slot,
        state: &mut State,
        several: &mut Several,
        evaluations: &mut u64,
    ) {
        let schema = self.schema(Parent::Task(task));
        let Some(precondition) = &schema.precondition else { return };
        self.prepared.derive_for(precondition, state, slot);
        let scene = self.prepared.scene(state, schema.variables, Clock::steps(slot));
        for alike in &mut several.alike {
            let holds = alike.assignments.iter_mut().any(|assignment| {
                *evaluations = evaluations.saturating_sub(1);
                *evaluations > 0 && scene.holds(precondition, &mut assignment.binding)
            });
            if let Some(slots) = alike.reading.holds.as_mut().filter(|_| holds) {
                slots.push(slot);
            }
        }
    }

    /// The moments from which each precondition is checked, in order.
    fn windows(&self, readings: &Readings, steps: Slot) -> Vec<Window> {
        // If the order of each task's subtasks is unique, a walk that ignores preconditions gives
        // the earliest moment of each task.
        let clear = readings.tasks.iter().chain([&readings.root]).all(|several| several.alike.len() == 1);
        let mut first: IndexVec<DecompositionId, Slot> = self.plan.decompositions.iter().map(|_| 0).collect();
        if clear {
            let bare = |several: &Several| Reading { holds: None, ..several.alike[0].reading.clone() };
            let root = bare(&readings.root);
            let tasks: IndexVec<DecompositionId, Reading> = readings.tasks.iter().map(bare).collect();
            let reading = |of| match of {
                Parent::Root => &root,
                Parent::Task(task) => &tasks[task],
            };
            let placed = place(self.plan, |of| self.schema(of), reading, |task, slot| first[task] = slot);
            debug_assert!(placed.is_ok(), "orderings were checked where the subtasks were matched");
        }
        let needs = |task: &DecompositionId| self.schema(Parent::Task(*task)).precondition.is_some();
        let mut windows: Vec<Window> = (self.plan.decompositions.ids().filter(needs))
            .map(|task| Window { first: first[task].min(self.last(task, steps)), task })
            .collect();
        windows.sort_unstable_by_key(|window| window.first);
        windows
    }

    /// Whether some combination of readings places all preconditions. If not, returns the task that
    /// has no place in the first combination.
    fn place_some(&self, readings: &Readings) -> Result<Option<(DecompositionId, Slot)>, Stop> {
        let parents =
            || std::iter::once(Parent::Root).chain(self.plan.decompositions.ids().map(Parent::Task));
        let unclear: Vec<Parent> = parents().filter(|&of| readings.of(of).alike.len() > 1).collect();
        let mut choice: FxHashMap<Parent, usize> = unclear.iter().map(|&of| (of, 0)).collect();
        let mut first = None;
        for _ in 0..COMBINATIONS {
            let reading = |of| {
                let index = choice.get(&of).copied().unwrap_or(0);
                &readings.of(of).alike[index].reading
            };
            match place(self.plan, |of| self.schema(of), reading, |_, _| ()) {
                Ok(()) => return Ok(None),
                Err(unplaced) => first = first.or(Some(unplaced)),
            }
            let next = unclear.iter().find(|of| choice[of] + 1 < readings.of(**of).alike.len());
            let Some(&next) = next else { return Ok(first) };
            for of in unclear.iter().take_while(|of| **of != next) {
                choice.insert(*of, 0);
            }
            *choice.entry(next).or_default() += 1;
        }
        Err(self.limit())
    }

    /// The unsatisfied parts of a precondition at the last moment where it was needed.
    fn unplaced(&self, readings: &Readings, task: DecompositionId, from: Slot) -> Stop {
        let prepared = self.prepared;
        let schema = self.schema(Parent::Task(task));
        let range = self.tree.range(PlanNode::Decomposition(task));
        let after = match &readings.tasks[task].alike[0].reading.holds {
            // It holds nowhere: report what is missing just before its first step.
            Some(slots) if slots.is_empty() && !range.is_empty() => range.first,
            _ => from,
        };
        let mut binding = readings.tasks[task].alike[0].assignments[0].binding.clone();
        let mut parts = Vec::new();
        let steps = self.plan.steps.iter().map(|step| &step.step);
        let count = self.plan.steps.len();
        sequential::replay(prepared, steps.take(after as usize), count, &mut |slot, state| {
            if let Some(precondition) = schema.precondition.as_ref().filter(|_| slot == after) {
                prepared.derive_for(precondition, state, slot);
                let scene = prepared.scene(state, schema.variables, Clock::steps(slot));
                parts = prepared.lacks(scene, Causes::Steps, precondition, &mut binding);
            }
        });
        NetworkFault::Precondition { task, after, parts }.into()
    }
}

/// The moments at which a task's precondition is checked.
struct Window {
    first: Slot,
    task: DecompositionId,
}

/// Groups the assignments that give the plan's subtasks the same order.
fn alike(schema: &Schema<'_>, assignments: Vec<Assignment>) -> Vec<Alike> {
    let mut places = FxHashMap::<Vec<(u32, u32)>, usize>::default();
    let mut alike: Vec<Alike> = Vec::new();
    for assignment in assignments {
        let child = |subtask: u32| assignment.children[subtask as usize];
        let orderings = schema.network.orderings.iter();
        let mut order: Vec<_> = orderings.map(|o| (child(o.before), child(o.after))).collect();
        order.sort_unstable();
        let place = *places.entry(order).or_insert(alike.len());
        match alike.get_mut(place) {
            Some(alike) => alike.assignments.push(assignment),
            None => {
                let holds = schema.precondition.is_some().then(Vec::new);
                let reading = Reading { children: assignment.children.clone(), holds };
                alike.push(Alike { assignments: vec![assignment], reading });
            }
        }
    }
    alike
}
