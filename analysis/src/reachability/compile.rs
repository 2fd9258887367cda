//! Compiles a domain, with or without a problem, to Datalog rules over an initial database.
//!
//! Invariant: the rules derive every atom that a plan can make true. A durative action becomes two rules. The start
//! rule needs the conditions at the start; the end rule needs all conditions of the action, so that the effects of its
//! own start count. Each conditional effect becomes a rule of its own. A head whose slots are among the slots of
//! another head shares its rule. Any other head gets its own rule, because a join for fewer slots is cheaper.

use std::rc::Rc;

use crate::changes::{Change, changes};
use pddl::model::{
    AssignedValue, Condition, FluentFact, FluentValue, FunctionValue, Idx, ObjectId, PredicateId,
    SubtaskHead, TaskNetwork, Term, TimedChange, VariableId, Variables,
};

use crate::happening::{Happening, Phase, Schema, happenings};
use crate::intervals::Hulls;
use crate::walk::Polarity;

use super::database::{RelationId, Rows};
use super::evaluate::Evaluator;
use super::relax::{Conjunction, Knowledge, Relaxer, free_slots, slots_of};
use super::rule::{Check, Origin, Pattern, Rule};
use super::world::{Range, World};

/// The input of the evaluation.
pub(crate) struct Compiled<'a> {
    pub(crate) evaluator: Evaluator<'a>,
    pub(crate) rows: Rows,
    pub(crate) tasks: Vec<RelationId>,
    pub(crate) rules: Vec<Rule>,
    /// Every origin in the domain, with or without a rule.
    pub(crate) origins: Vec<Origin>,
}

/// Compiles everything except the task hierarchy.
pub(crate) fn compile<'a>(world: &Rc<World<'a>>, hulls: &Rc<Hulls>) -> Compiled<'a> {
    let domain = world.domain;
    let mut rows = Rows::default();
    let predicates: Vec<_> = domain.predicates.iter().map(|p| rows.declare(p.variables.parameters)).collect();
    let fluents: Vec<_> = domain.functions.iter().map(|f| rows.declare(f.variables.parameters + 1)).collect();
    let tasks: Vec<_> = domain.tasks.iter().map(|t| rows.declare(t.variables.parameters)).collect();
    let happenings = happenings(domain);

    let basic = if world.problem.is_some() { Knowledge::Kept } else { Knowledge::Open };
    let mut known = vec![basic; rows.relations()];
    for (id, predicate) in domain.predicates.enumerate().filter(|(_, p)| p.derived) {
        debug_assert_eq!(predicates[id.index()].0 as usize, id.index(), "{}", predicate.name);
        known[id.index()] = Knowledge::Deletable;
    }
    tasks.iter().for_each(|t| known[t.0 as usize] = Knowledge::Deletable);
    if world.problem.is_some() {
        for effect in happenings.iter().flat_map(|h| &h.effects) {
            changes(effect, &mut |_, change| match change {
                Change::Delete(atom) => known[atom.predicate.index()] = Knowledge::Deletable,
                Change::Assign(_, application, _) => {
                    known[fluents[application.function.index()].0 as usize] = Knowledge::Deletable;
                }
                Change::Add(_) => {}
            });
        }
    }
    for timed in world.problem.iter().flat_map(|p| &p.timed) {
        let relation = match &timed.change {
            TimedChange::Add(_) => continue,
            TimedChange::Delete(fact) => predicates[fact.predicate.index()],
            TimedChange::Assign(fact) => fluents[fact.application.function.index()],
            TimedChange::Undefine(application) => fluents[application.function.index()],
        };
        known[relation.0 as usize] = Knowledge::Deletable;
    }
    load(world, &predicates, &fluents, &mut rows);
    let (world, hulls) = (Rc::clone(world), Rc::clone(hulls));
    let evaluator = Evaluator { world, hulls, predicates, fluents, known };
    let mut compiled = Compiled { evaluator, rows, tasks, rules: Vec::new(), origins: Vec::new() };
    for happening in &happenings {
        compiled.happening(happening);
    }
    for (i, axiom) in domain.axioms.iter().enumerate() {
        let origin = Origin { schema: Schema::Axiom(i), phase: Phase::Whole, when: None };
        let slots = compiled.slots(&axiom.variables);
        let arguments = axiom.variables.parameter_ids().map(Term::Variable).collect();
        let head = compiled.pattern(axiom.predicate, arguments, axiom.span);
        let body = compiled.relaxer().conjoin(&[&axiom.body]);
        compiled.add(&origin, &axiom.variables, &slots, &body, &[head]);
    }
    compiled
}

fn load(world: &World<'_>, predicates: &[RelationId], fluents: &[RelationId], rows: &mut Rows) {
    let Some(problem) = world.problem else { return };
    let mut row = Vec::new();
    for fact in &problem.init {
        row.clear();
        row.extend(fact.arguments.iter().map(|o| o.0));
        rows.insert(predicates[fact.predicate.index()], &row);
    }
    for fact in &problem.fluents {
        if let FluentValue::Object(value) = fact.value {
            row.clear();
            row.extend(fact.application.arguments.iter().chain([&value]).map(|o| o.0));
            rows.insert(fluents[fact.application.function.index()], &row);
        }
    }
    rows.seal();
    for timed in &problem.timed {
        row.clear();
        match &timed.change {
            TimedChange::Add(fact) => {
                row.extend(fact.arguments.iter().map(|o| o.0));
                rows.insert(predicates[fact.predicate.index()], &row);
            }
            TimedChange::Assign(FluentFact { application, value: FluentValue::Object(value), .. }) => {
                row.extend(application.arguments.iter().chain([value]).map(|o| o.0));
                rows.insert(fluents[application.function.index()], &row);
            }
            TimedChange::Assign(_) | TimedChange::Delete(_) | TimedChange::Undefine(_) => {}
        }
    }
}

impl Compiled<'_> {
    fn relaxer(&self) -> Relaxer<'_> {
        let Evaluator { predicates, fluents, known, hulls, .. } = &self.evaluator;
        Relaxer { predicates, fluents, known, hulls }
    }

    pub(crate) fn slots(&self, variables: &Variables) -> Rc<[Rc<Range>]> {
        variables.slots.iter().map(|v| self.evaluator.world.range(&v.types)).collect()
    }

    fn pattern(&self, predicate: PredicateId, arguments: Vec<Term>, span: pddl::Span) -> Pattern {
        Pattern { relation: self.evaluator.predicates[predicate.index()], arguments, span }
    }

    fn happening(&mut self, happening: &Happening<'_>) {
        let slots = self.slots(happening.variables);
        let base = self.relaxer().conjoin(&happening.conditions);
        let mut groups: Vec<(Vec<&Condition>, Vec<Pattern>)> = vec![(Vec::new(), Vec::new())];
        for effect in &happening.effects {
            changes(effect, &mut |context, change| {
                let head = match change {
                    Change::Add(atom) => self.pattern(atom.predicate, atom.arguments.clone(), atom.span),
                    Change::Assign(_, application, AssignedValue::Object(value))
                        if matches!(
                            self.evaluator.world.domain.functions[application.function].value,
                            FunctionValue::Object(_)
                        ) =>
                    {
                        let relation = self.evaluator.fluents[application.function.index()];
                        let arguments = application.arguments.iter().copied().chain([*value]).collect();
                        Pattern { relation, arguments, span: application.span }
                    }
                    // A conditional effect always gets a rule: a condition that never holds is reported.
                    _ if context.when.is_empty() => return,
                    _ => {
                        group(&mut groups, &context.when);
                        return;
                    }
                };
                group(&mut groups, &context.when).push(head);
            });
        }
        for (when, heads) in groups {
            let origin = Origin {
                schema: happening.schema.clone(),
                phase: happening.phase.clone(),
                when: when.last().map(|c| c.span),
            };
            let mut body = base.clone();
            if !when.is_empty() {
                let more = self.relaxer().conjoin(&when);
                // With too many alternatives, the effect's own condition is the more informative one.
                let both: Vec<_> = base.iter().flat_map(|b| more.iter().map(|m| b.and(m))).collect();
                body = if both.len() > 64 { more } else { both };
            }
            self.add(&origin, happening.variables, &slots, &body, &heads);
        }
    }

    fn add(
        &mut self,
        origin: &Origin,
        variables: &Variables,
        slots: &Rc<[Rc<Range>]>,
        body: &[Conjunction],
        heads: &[Pattern],
    ) {
        self.origins.push(origin.clone());
        for alternative in body {
            for heads in shared(heads.to_vec()) {
                self.push(origin, variables.parameters, slots, alternative.clone(), heads);
            }
        }
    }

    fn push(
        &mut self,
        origin: &Origin,
        parameters: usize,
        slots: &Rc<[Rc<Range>]>,
        conjunction: Conjunction,
        heads: Vec<Pattern>,
    ) {
        let Conjunction { mut body, checks } = conjunction;
        let mut seen = Vec::new();
        body.retain(|p| {
            let new = !seen.contains(&(p.relation, p.arguments.clone()));
            seen.push((p.relation, p.arguments.clone()));
            new
        });
        let needs = checks.iter().map(needs).collect();
        let slots = Rc::clone(slots);
        self.rules.push(Rule { origin: origin.clone(), slots, parameters, body, checks, needs, heads });
    }

    /// The rules of the hierarchy: a task can be decomposed if some method's condition holds, its
    /// primitive subtasks may be applied and its compound ones can be decomposed.
    pub(crate) fn hierarchy(&mut self) {
        let (domain, problem) = (self.evaluator.world.domain, self.evaluator.world.problem);
        for (id, method) in domain.methods.enumerate() {
            let origin = Origin { schema: Schema::Method(id), phase: Phase::Whole, when: None };
            let head = Pattern {
                relation: self.tasks[method.task.index()],
                arguments: method.task_arguments.clone(),
                span: method.span,
            };
            self.network(&origin, &method.variables, Some(&method.precondition), &method.network, &[head]);
        }
        if let Some((variables, network)) = problem.and_then(|p| p.htn.as_ref()) {
            for subtask in 0..network.subtasks.len() {
                let origin = Origin { schema: Schema::Initial(subtask), phase: Phase::Whole, when: None };
                let subtasks = vec![network.subtasks[subtask].clone()];
                let constraints = network.constraints.clone();
                let one = TaskNetwork { subtasks, constraints, ..TaskNetwork::default() };
                self.network(&origin, variables, None, &one, &[]);
            }
        }
    }

    fn network(
        &mut self,
        origin: &Origin,
        variables: &Variables,
        precondition: Option<&Condition>,
        network: &TaskNetwork,
        heads: &[Pattern],
    ) {
        let domain = self.evaluator.world.domain;
        let mut slots = self.slots(variables).to_vec();
        let mut rows =
            self.relaxer().conjoin(&precondition.into_iter().chain(&network.constraints).collect::<Vec<_>>());
        for subtask in &network.subtasks {
            let (callee, conditions): (&Variables, Vec<&Condition>) = match subtask.head {
                SubtaskHead::Task(task) => {
                    let relation = self.tasks[task.index()];
                    let arguments = subtask.arguments.clone();
                    let pattern = Pattern { relation, arguments, span: subtask.span };
                    rows.iter_mut().for_each(|r| r.body.push(pattern.clone()));
                    continue;
                }
                SubtaskHead::Action(action) => {
                    let action = &domain.actions[action];
                    (&action.variables, vec![&action.precondition])
                }
                SubtaskHead::DurativeAction(action) => {
                    let action = &domain.durative_actions[action];
                    let start =
                        |c: &&pddl::model::TimedCondition| c.when == pddl::model::TimeSpecifier::Start;
                    (
                        &action.variables,
                        action.conditions.iter().filter(start).map(|c| &c.condition).collect(),
                    )
                }
            };
            let alternatives = self.relaxer().conjoin(&conditions);
            // Further conditions are left out, which only makes more methods usable.
            let [alternative] = alternatives.as_slice() else {
                if alternatives.is_empty() {
                    rows.clear();
                }
                continue;
            };
            let own = self.slots(callee);
            let start = slots.len();
            slots.extend(own.iter().cloned());
            let into = |t: Term| match t {
                Term::Object(_) => t,
                Term::Variable(v) => subtask
                    .arguments
                    .get(v.index())
                    .copied()
                    .unwrap_or_else(|| Term::Variable(VariableId::from_index(start + v.index()))),
            };
            let inlined = inlined(alternative, &into);
            rows.iter_mut().for_each(|r| *r = r.and(&inlined));
        }
        let slots: Rc<[Rc<Range>]> = slots.into();
        self.origins.push(origin.clone());
        for row in rows {
            self.push(origin, variables.parameters, &slots, row, heads.to_vec());
        }
    }
}

/// A conjunction with its terms replaced, without its comparisons and residual checks.
fn inlined(conjunction: &Conjunction, into: &dyn Fn(Term) -> Term) -> Conjunction {
    let pattern = |p: &Pattern| Pattern {
        relation: p.relation,
        arguments: p.arguments.iter().map(|&t| into(t)).collect(),
        span: p.span,
    };
    let check = |c: &Check| match c {
        Check::Same(a, b) => Some(Check::Same(into(*a), into(*b))),
        Check::Different(a, b) => Some(Check::Different(into(*a), into(*b))),
        Check::Absent(p) => Some(Check::Absent(pattern(p))),
        Check::Compare(..) | Check::Residual(..) => None,
    };
    Conjunction {
        body: conjunction.body.iter().map(pattern).collect(),
        checks: conjunction.checks.iter().filter_map(check).collect(),
    }
}

fn group<'g, 'c>(
    groups: &'g mut Vec<(Vec<&'c Condition>, Vec<Pattern>)>,
    when: &[&'c Condition],
) -> &'g mut Vec<Pattern> {
    let same = |g: &(Vec<&Condition>, _)| {
        g.0.len() == when.len() && g.0.iter().zip(when).all(|(a, b)| std::ptr::eq(*a, *b))
    };
    let at = groups.iter().position(same).unwrap_or_else(|| {
        groups.push((when.to_vec(), Vec::new()));
        groups.len() - 1
    });
    &mut groups[at].1
}

/// Groups heads by rule. Without heads, the result is one empty list.
fn shared(mut heads: Vec<Pattern>) -> Vec<Vec<Pattern>> {
    let slots = |p: &Pattern| -> Vec<usize> {
        let mut slots: Vec<usize> = slots_of(&p.arguments).collect();
        slots.sort_unstable();
        slots.dedup();
        slots
    };
    heads.sort_by_key(|p| std::cmp::Reverse(slots(p).len()));
    let mut all: Vec<(Vec<usize>, Vec<Pattern>)> = Vec::new();
    for head in heads {
        let own = slots(&head);
        match all.iter_mut().find(|(with, _)| own.iter().all(|s| with.contains(s))) {
            Some((_, group)) => group.push(head),
            None => all.push((own, vec![head])),
        }
    }
    if all.is_empty() { vec![Vec::new()] } else { all.into_iter().map(|(_, heads)| heads).collect() }
}

fn needs(check: &Check) -> Vec<usize> {
    let mut slots: Vec<usize> = match check {
        Check::Same(a, b) | Check::Different(a, b) => slots_of([a, b]).collect(),
        Check::Absent(pattern) => slots_of(&pattern.arguments).collect(),
        Check::Compare(_, _, sides, _) => {
            let mut slots = Vec::new();
            for side in [&sides.0, &sides.1] {
                crate::walk::expression(side, &mut |part| slots.extend(slots_of(part.terms())));
            }
            slots
        }
        Check::Residual(_, condition) => free_slots(condition),
    };
    slots.sort_unstable();
    slots.dedup();
    slots
}

/// The conjuncts of the goal, each with the values of its slots. A universal part contributes one conjunct per object.
pub(crate) fn goals<'a>(world: &World<'a>) -> Vec<(&'a Condition, Vec<(VariableId, ObjectId)>)> {
    use pddl::model::ConditionKind;
    /// A goal with more conjuncts is kept whole.
    const MOST: usize = 20_000;
    let Some(problem) = world.problem else { return Vec::new() };
    let mut goals = vec![(&problem.goal, Vec::new())];
    let mut at = 0;
    while at < goals.len() {
        let (condition, binding) = goals[at].clone();
        let parts: Vec<_> = match &condition.kind {
            ConditionKind::And(parts) => parts.iter().map(|p| (p, binding.clone())).collect(),
            ConditionKind::Forall(variables, inner) if variables.len() == 1 => {
                let range = world.range(&problem.goal_variables[variables[0]].types);
                let with = |&o: &u32| {
                    let mut binding = binding.clone();
                    binding.push((variables[0], ObjectId(o)));
                    (&**inner, binding)
                };
                range.objects.iter().map(with).collect()
            }
            _ => {
                at += 1;
                continue;
            }
        };
        if goals.len() + parts.len() > MOST {
            return vec![(&problem.goal, Vec::new())];
        }
        goals.splice(at..=at, parts);
    }
    goals
}

/// The alternatives of a goal as rules without heads.
pub(crate) fn goal_rules(
    compiled: &Compiled<'_>,
    number: usize,
    goal: &Condition,
    variables: &Variables,
) -> Vec<Rule> {
    let slots = compiled.slots(variables);
    let origin = Origin { schema: Schema::Goal(number), phase: Phase::Whole, when: None };
    let alternatives = compiled.relaxer().relax(goal, Polarity::Positive).into_iter();
    let rule = |Conjunction { body, checks }| {
        let needs = checks.iter().map(needs).collect();
        let slots = Rc::clone(&slots);
        Rule { origin: origin.clone(), slots, parameters: 0, body, checks, needs, heads: Vec::new() }
    };
    alternatives.map(rule).collect()
}
