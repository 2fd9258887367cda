//! Grounding: makes the grammar of one plan.
//!
//! Problem: the tasks of a domain have far too many instances to list. Idea: only instances matter that yield steps
//! of the plan, or no step. They are a fixed point, built bottom-up. It starts with the actions of the plan. A method
//! adds an instance of its task as soon as all of its subtasks exist, its constraints hold, and each atom of its
//! precondition holds at some moment of the plan. Each new task triggers only the methods with such a subtask, and
//! the rest of the method is a join over the tables so far. Then instances that the problem's network does not reach
//! are dropped, and each guard is evaluated at each moment of the plan.
//!
//! Invariant: the grammar contains every decomposition that yields the steps. Cost: that of the joins, bounded.
//!
//! Source: Ramoul et al., "Grounding of HTN planning domain", IJAIT 2017; Behnke et al., "On succinct groundings of
//! HTN planning problems", AAAI 2020; semi-naive evaluation: Bancilhon & Ramakrishnan, SIGMOD 1986.

use super::grammar::{Grammar, Rule, RuleId, Symbol, SymbolId};
use crate::condition::Strictness;
use crate::htn::schema::{Schema, unify};
use crate::prepared::Prepared;
use crate::reads::each_predicate;
use crate::relation::Relation;
use crate::scene::{Binding, Clock};
use crate::sequential;
use crate::state::State;
use crate::work::Work;
use budget::{Interrupted, Meter};
use pddl::model::{
    Atom, Condition, ConditionKind, Idx, IndexVec, MethodId, ObjectId, PredicateId, SubtaskHead, Term,
    VariableId,
};
use pddl::{SequentialPlan, Span};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::VecDeque;
use std::ops::ControlFlow;

/// The result of grounding.
pub(super) enum Ground {
    Grammar(Grammar),
    /// No decomposition exists, because these subtasks of the problem's network cannot yield steps of the plan only.
    Impossible(Vec<Span>),
}

/// A method, or the problem's network, with the condition under which an instance matters.
struct Form<'a> {
    method: Option<MethodId>,
    schema: Schema<'a>,
    query: Condition,
}

type Objects = Box<[ObjectId]>;

struct Grounding<'g, 'a> {
    prepared: &'g Prepared<'a>,
    forms: Vec<Form<'a>>,
    /// By subtask: the forms that contain it, and the positions.
    occurrences: FxHashMap<SubtaskHead, Vec<(usize, usize)>>,
    /// The atoms that hold at some moment; further tables have the instances of tasks and actions found so far.
    table: State,
    tables: FxHashMap<SubtaskHead, PredicateId>,
    there: FxHashSet<(SubtaskHead, Objects)>,
    waiting: VecDeque<(SubtaskHead, Objects)>,
    instances: Vec<Instance>,
    seen: FxHashSet<(usize, Vec<Option<ObjectId>>)>,
    /// By task: the instances that decompose it.
    ways: FxHashMap<(SubtaskHead, Objects), Vec<usize>>,
    roots: Vec<usize>,
}

struct Instance {
    form: usize,
    values: Vec<Option<ObjectId>>,
}

/// Builds the grammar. The steps of the plan must be applicable.
pub(super) fn ground(
    prepared: &Prepared<'_>,
    plan: &SequentialPlan,
    meter: &Meter<'_>,
) -> Result<Ground, Interrupted> {
    let mut grounding = Grounding::new(prepared, plan, meter)?;
    grounding.close(plan, meter)?;
    if grounding.roots.is_empty() {
        return Ok(Ground::Impossible(grounding.impossible()));
    }
    grounding.grammar(plan, meter).map(Ground::Grammar)
}

impl<'g, 'a> Grounding<'g, 'a> {
    fn new(
        prepared: &'g Prepared<'a>,
        plan: &SequentialPlan,
        meter: &Meter<'_>,
    ) -> Result<Self, Interrupted> {
        let domain = prepared.domain;
        let mut table = State::empty(domain, &vec![true; domain.predicates.len()]);
        table.work = Work::for_steps(plan.steps.len());
        let heads = domain.tasks.ids().map(SubtaskHead::Task);
        let heads = heads.chain(domain.actions.ids().map(SubtaskHead::Action));
        let mut tables = FxHashMap::default();
        for head in heads {
            let arity = match head {
                SubtaskHead::Task(task) => domain.tasks[task].variables.parameters,
                SubtaskHead::Action(action) => domain.actions[action].variables.parameters,
                SubtaskHead::DurativeAction(_) => 0,
            };
            tables.insert(head, table.facts.push(Relation::indexed(arity)));
            table.derived.push(Relation::plain());
        }
        let methods = domain.methods.enumerate().map(|(id, method)| (Some(id), Schema::of_method(method)));
        let root = prepared.problem.htn.as_ref();
        let root = root.map(|(variables, network)| (None, Schema::of_problem(variables, network)));
        let mut forms = Vec::new();
        let mut occurrences = FxHashMap::<SubtaskHead, Vec<(usize, usize)>>::default();
        for (method, schema) in methods.chain(root) {
            // A plan without times has no durative actions.
            if schema.durative().is_some() {
                continue;
            }
            for (place, subtask) in schema.network.subtasks.iter().enumerate() {
                occurrences.entry(subtask.head).or_default().push((forms.len(), place));
            }
            let query = query(&schema, &tables);
            forms.push(Form { method, schema, query });
        }
        let mut grounding = Self {
            prepared,
            forms,
            occurrences,
            table,
            tables,
            there: FxHashSet::default(),
            waiting: VecDeque::new(),
            instances: Vec::new(),
            seen: FxHashSet::default(),
            ways: FxHashMap::default(),
            roots: Vec::new(),
        };
        grounding.fill(plan, meter)?;
        Ok(grounding)
    }

    /// Adds the atoms that hold at some moment.
    fn fill(&mut self, plan: &SequentialPlan, meter: &Meter<'_>) -> Result<(), Interrupted> {
        let prepared = self.prepared;
        let mut read = Vec::new();
        for form in &self.forms {
            each_predicate(&form.query, true, &mut |predicate, _| {
                if predicate.index() < prepared.domain.predicates.len() && !read.contains(&predicate) {
                    read.push(predicate);
                }
            });
        }
        let derived = read.iter().any(|&predicate| prepared.strata.derives(predicate));
        let table = &mut self.table;
        let mut outcome = Ok(());
        sequential::replay(prepared, plan.steps.iter(), plan.steps.len(), &mut |slot, state| {
            if derived {
                prepared.derive(state, slot);
            }
            for &predicate in &read {
                for arguments in state.facts[predicate].holding().chain(state.derived[predicate].holding()) {
                    if outcome.is_err() {
                        return;
                    }
                    outcome = meter.spend(1);
                    table.facts[predicate].add(arguments, 0);
                }
            }
        });
        outcome
    }

    /// Computes the fixed point.
    fn close(&mut self, plan: &SequentialPlan, meter: &Meter<'_>) -> Result<(), Interrupted> {
        for step in &plan.steps {
            self.appears(SubtaskHead::Action(step.action), step.arguments.as_slice().into());
        }
        for form in 0..self.forms.len() {
            if self.forms[form].schema.network.subtasks.is_empty() {
                self.join(form, None, meter)?;
            }
        }
        while let Some((head, objects)) = self.waiting.pop_front() {
            let places = self.occurrences.get(&head).cloned().unwrap_or_default();
            for (form, place) in places {
                self.join(form, Some((place, &objects)), meter)?;
            }
        }
        Ok(())
    }

    fn appears(&mut self, head: SubtaskHead, objects: Objects) {
        let Some(&table) = self.tables.get(&head) else { return };
        if self.there.insert((head, objects.clone())) {
            self.table.facts[table].add(&objects, 0);
            self.waiting.push_back((head, objects));
        }
    }

    /// Adds each instance of the form whose given subtask has these objects.
    fn join(
        &mut self,
        index: usize,
        given: Option<(usize, &[ObjectId])>,
        meter: &Meter<'_>,
    ) -> Result<(), Interrupted> {
        let prepared = self.prepared;
        let form = &self.forms[index];
        let schema = &form.schema;
        let mut binding = Binding::new(schema.variables, &[]);
        binding.reset(schema.variables, &[]);
        if let Some((place, objects)) = given {
            let terms = &schema.network.subtasks[place].arguments;
            let (universe, variables) = (&prepared.universe, schema.variables);
            if unify(universe, variables, terms, objects, &mut binding, &mut Vec::new()).is_err() {
                return Ok(());
            }
        }
        let open: Vec<VariableId> =
            schema.determined.iter().copied().filter(|&v| binding.get(v).is_none()).collect();
        let scene = prepared.scene(&self.table, schema.variables, Clock::steps(0));
        let mut found = Vec::new();
        let mut outcome = Ok(());
        let guards = [(&form.query, true)];
        let _ = scene.each_binding(&open, &guards, Strictness::Certain, &mut binding, &mut |binding| {
            outcome = meter.spend(1 + schema.determined.len());
            found.push(schema.determined.iter().map(|&v| binding.get(v)).collect::<Vec<_>>());
            // Without an open variable, one match is enough.
            if outcome.is_err() || open.is_empty() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        outcome?;
        if self.table.work.is_exhausted() {
            return Err(Interrupted::Work);
        }
        for values in found {
            self.add(index, values);
        }
        Ok(())
    }

    fn add(&mut self, form: usize, values: Vec<Option<ObjectId>>) {
        if !self.seen.insert((form, values.clone())) {
            return;
        }
        let instance = Instance { form, values };
        let index = self.instances.len();
        match self.forms[form].method {
            None => self.roots.push(index),
            Some(method) => {
                let task = self.prepared.domain.methods[method].task;
                let objects = self.objects(&instance, self.forms[form].schema.task_arguments);
                if self.prepared.fits(&self.prepared.domain.tasks[task].variables, &objects).is_err() {
                    return;
                }
                let head = SubtaskHead::Task(task);
                self.ways.entry((head, objects.clone())).or_default().push(index);
                self.appears(head, objects);
            }
        }
        self.instances.push(instance);
    }

    fn binding(&self, instance: &Instance) -> Binding {
        let schema = &self.forms[instance.form].schema;
        let mut binding = Binding::default();
        binding.reset(schema.variables, &[]);
        for (&variable, &value) in schema.determined.iter().zip(&instance.values) {
            binding.set(variable, value);
        }
        binding
    }

    fn objects(&self, instance: &Instance, terms: &[Term]) -> Objects {
        let binding = self.binding(instance);
        terms.iter().filter_map(|&term| binding.term(term)).collect()
    }

    /// The subtasks of the problem's network without an instance; all subtasks if each has one.
    fn impossible(&self) -> Vec<Span> {
        let Some((variables, network)) = &self.prepared.problem.htn else { return Vec::new() };
        let nothing_for = |subtask: &&pddl::model::Subtask| {
            let Some(&table) = self.tables.get(&subtask.head) else { return true };
            let mut tuples = self.table.facts[table].holding();
            !tuples.any(|objects| {
                let mut binding = Binding::default();
                binding.reset(variables, &[]);
                let universe = &self.prepared.universe;
                unify(universe, variables, &subtask.arguments, objects, &mut binding, &mut Vec::new()).is_ok()
            })
        };
        let lacking: Vec<Span> = network.subtasks.iter().filter(nothing_for).map(|s| s.span).collect();
        if lacking.is_empty() { network.subtasks.iter().map(|s| s.span).collect() } else { lacking }
    }

    /// The grammar of the instances that the problem's network reaches.
    fn grammar(&self, plan: &SequentialPlan, meter: &Meter<'_>) -> Result<Grammar, Interrupted> {
        let mut symbols = IndexVec::new();
        let mut ids = FxHashMap::<(SubtaskHead, Objects), SymbolId>::default();
        let mut steps = Vec::with_capacity(plan.steps.len());
        let mut actions = 0;
        for step in &plan.steps {
            let key = (SubtaskHead::Action(step.action), step.arguments.as_slice().into());
            let id = *ids.entry(key).or_insert_with(|| {
                actions += 1;
                symbols.push(Symbol::Action(actions - 1))
            });
            steps.push(id);
        }
        let root = symbols.push(Symbol::Root);
        let mut waiting: VecDeque<(SymbolId, &[usize])> = VecDeque::from([(root, self.roots.as_slice())]);
        let mut rules = IndexVec::<RuleId, Rule>::new();
        let mut guards: Vec<(SymbolId, usize)> = Vec::new();
        while let Some((head, ways)) = waiting.pop_front() {
            for &way in ways {
                let instance = &self.instances[way];
                let schema = &self.forms[instance.form].schema;
                meter.spend(1 + schema.network.subtasks.len())?;
                let guard = schema.precondition.is_some();
                let mut rule = Rule {
                    method: self.forms[instance.form].method,
                    head,
                    nodes: Vec::new(),
                    before: Vec::new(),
                    subtask: Vec::new(),
                };
                if guard {
                    let id = symbols.push(Symbol::Guard(Box::default()));
                    guards.push((id, way));
                    rule.nodes.push(id);
                    rule.before.push(Vec::new());
                    rule.subtask.push(None);
                }
                let mut places = vec![0; schema.order.len()];
                for &subtask in &schema.order {
                    let term = &schema.network.subtasks[subtask as usize];
                    let key = (term.head, self.objects(instance, &term.arguments));
                    let id = ids.get(&key).copied().unwrap_or_else(|| {
                        let SubtaskHead::Task(task) = key.0 else {
                            unreachable!("an action of an instance is one of the plan")
                        };
                        let id = symbols.push(Symbol::Task { task, arguments: key.1.clone() });
                        let ways = self.ways.get(&key).map_or(&[] as &[usize], Vec::as_slice);
                        waiting.push_back((id, ways));
                        ids.insert(key.clone(), id);
                        id
                    });
                    places[subtask as usize] = u32::try_from(rule.nodes.len()).unwrap_or(u32::MAX);
                    let before = &schema.before[subtask as usize];
                    let mut before: Vec<u32> = before.iter().map(|&b| places[b as usize]).collect();
                    if before.is_empty() && guard {
                        before.push(0);
                    }
                    before.sort_unstable();
                    rule.nodes.push(id);
                    rule.before.push(before);
                    rule.subtask.push(Some(subtask));
                }
                rules.push(rule);
            }
        }
        self.ask(plan, &guards, &mut symbols, meter)?;
        let mut ways: IndexVec<SymbolId, Vec<RuleId>> = symbols.iter().map(|_| Vec::new()).collect();
        for (id, rule) in rules.enumerate() {
            ways[rule.head].push(id);
        }
        Ok(Grammar { symbols, rules, ways, root, steps, actions: actions as usize })
    }

    /// Evaluates each guard at each moment.
    fn ask(
        &self,
        plan: &SequentialPlan,
        guards: &[(SymbolId, usize)],
        symbols: &mut IndexVec<SymbolId, Symbol>,
        meter: &Meter<'_>,
    ) -> Result<(), Interrupted> {
        let prepared = self.prepared;
        let mut holds = vec![Vec::with_capacity(plan.steps.len() + 1); guards.len()];
        let mut bindings: Vec<Binding> =
            guards.iter().map(|&(_, instance)| self.binding(&self.instances[instance])).collect();
        let mut outcome = Ok(());
        let enough = sequential::replay(prepared, plan.steps.iter(), plan.steps.len(), &mut |slot, state| {
            for ((&(_, instance), holds), binding) in guards.iter().zip(&mut holds).zip(&mut bindings) {
                let schema = &self.forms[self.instances[instance].form].schema;
                let Some(precondition) = &schema.precondition else { continue };
                if outcome.is_err() {
                    return;
                }
                outcome = meter.spend(2);
                prepared.derive_for(precondition, state, slot);
                let scene = prepared.scene(state, schema.variables, Clock::steps(slot));
                holds.push(scene.holds(precondition, binding));
            }
        });
        outcome?;
        if !enough {
            return Err(Interrupted::Work);
        }
        for (&(symbol, _), holds) in guards.iter().zip(holds) {
            symbols[symbol] = Symbol::Guard(holds.into());
        }
        Ok(())
    }
}

/// The condition that each subtask has an instance, and the weaker precondition that does not depend on the moment.
fn query(schema: &Schema<'_>, tables: &FxHashMap<SubtaskHead, PredicateId>) -> Condition {
    let span = Span::default();
    let mut parts = Vec::new();
    for subtask in &schema.network.subtasks {
        if let Some(&predicate) = tables.get(&subtask.head) {
            let atom = Atom { predicate, arguments: subtask.arguments.clone(), span };
            parts.push(Condition { kind: ConditionKind::Atom(atom), span });
        }
    }
    parts.push(schema.constraints.clone());
    parts.extend(schema.precondition.as_ref().map(relaxed));
    Condition { kind: ConditionKind::And(parts), span }
}

/// A weaker condition: each of its atoms must hold at some moment, but not all at the same one.
fn relaxed(condition: &Condition) -> Condition {
    let kind = match &condition.kind {
        ConditionKind::And(parts) => ConditionKind::And(parts.iter().map(relaxed).collect()),
        ConditionKind::Or(parts) => ConditionKind::Or(parts.iter().map(relaxed).collect()),
        ConditionKind::Exists(variables, body) => {
            ConditionKind::Exists(variables.clone(), Box::new(relaxed(body)))
        }
        ConditionKind::Atom(_) | ConditionKind::HasType(..) | ConditionKind::Same(..) => {
            condition.kind.clone()
        }
        ConditionKind::Not(part)
            if matches!(part.kind, ConditionKind::Same(..) | ConditionKind::HasType(..)) =>
        {
            condition.kind.clone()
        }
        ConditionKind::Not(_)
        | ConditionKind::Imply(..)
        | ConditionKind::Forall(..)
        | ConditionKind::Compare(..)
        | ConditionKind::FluentIs(..) => ConditionKind::And(Vec::new()),
    };
    Condition { kind, span: condition.span }
}
