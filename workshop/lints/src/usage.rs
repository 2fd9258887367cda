//! Which names are used: counted once for a domain and once for a problem, for all lints about what is unused.

use pddl::model::{
    ActionId, Domain, DurativeActionId, Fact, FluentFact, FluentValue, FunctionId, FunctionValue, Idx,
    IndexVec, ObjectId, PredicateId, Problem, SubtaskHead, TaskId, Term, TimedChange, TokenSymbol, TypeId,
    Variables,
};

use crate::schema::{Schema, network};
use analysis::walk::{self, Part, Polarity};

/// What conditions and effects do with a predicate.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PredicateUse {
    /// A condition asks for it.
    pub(crate) needed_true: bool,
    /// A condition asks that it be false.
    pub(crate) needed_false: bool,
    pub(crate) added: bool,
    pub(crate) deleted: bool,
    pub(crate) derived: bool,
    /// An agent may write it.
    pub(crate) permitted: bool,
    /// It changes by itself at some time.
    pub(crate) timed: bool,
}

impl PredicateUse {
    pub(crate) fn needed(self) -> bool {
        self.needed_true || self.needed_false
    }

    pub(crate) fn produced(self) -> bool {
        self.added || self.derived || self.permitted
    }

    /// Whether anything changes it.
    pub(crate) fn fluent(self) -> bool {
        self.produced() || self.deleted
    }
}

/// What conditions and effects do with a function.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FunctionUse {
    pub(crate) read: bool,
    pub(crate) written: bool,
    /// It changes by itself at some time.
    pub(crate) timed: bool,
}

/// Which names a domain or a problem uses.
#[derive(Debug)]
pub(crate) struct Usage {
    pub(crate) predicates: IndexVec<PredicateId, PredicateUse>,
    pub(crate) functions: IndexVec<FunctionId, FunctionUse>,
    pub(crate) objects: IndexVec<ObjectId, bool>,
    pub(crate) types: IndexVec<TypeId, bool>,
    pub(crate) tasks: IndexVec<TaskId, bool>,
    pub(crate) actions: IndexVec<ActionId, bool>,
    pub(crate) durative_actions: IndexVec<DurativeActionId, bool>,
}

impl Usage {
    fn new(domain: &Domain, objects: usize) -> Self {
        Self {
            predicates: vec![PredicateUse::default(); domain.predicates.len()].into(),
            functions: vec![FunctionUse::default(); domain.functions.len()].into(),
            objects: vec![false; objects].into(),
            types: vec![false; domain.types.len()].into(),
            tasks: vec![false; domain.tasks.len()].into(),
            actions: vec![false; domain.actions.len()].into(),
            durative_actions: vec![false; domain.durative_actions.len()].into(),
        }
    }

    /// Of a domain alone.
    pub(crate) fn of_domain<'a>(domain: &'a Domain, schemas: impl Iterator<Item = Schema<'a>>) -> Self {
        let mut usage = Self::new(domain, domain.constants.len());
        for schema in schemas {
            schema.parts(&mut |part| usage.part(part));
            usage.variables(schema.variables());
        }
        for predicate in &domain.predicates {
            usage.variables(&predicate.variables);
        }
        for function in &domain.functions {
            usage.variables(&function.variables);
            if let FunctionValue::Object(types) = &function.value {
                usage.types(&types.0);
            }
        }
        walk::constraints(&domain.constraints, &mut |part| usage.asked(part));
        usage.variables(&domain.constraints.variables);
        for invariant in &domain.invariants {
            walk::invariant(invariant, &mut |part| usage.asked(part));
            usage.variables(&invariant.variables);
        }
        domain.constants.iter().for_each(|constant| usage.types(constant.types.declared()));
        domain.tasks.iter().for_each(|task| usage.variables(&task.variables));
        for pattern in domain.permissions.iter().flat_map(|permission| &permission.tokens) {
            match pattern.symbol {
                TokenSymbol::Predicate(id) => usage.predicates[id].permitted = true,
                TokenSymbol::Function(id) => usage.functions[id].written = true,
                TokenSymbol::Type(id) => usage.types[id] = true,
            }
            pattern.arguments.iter().flatten().for_each(|&object| usage.objects[object] = true);
        }
        usage
    }

    /// Of a problem alone; its initial state counts as adding and assigning.
    pub(crate) fn of_problem(domain: &Domain, problem: &Problem) -> Self {
        let mut usage = Self::new(domain, problem.objects.len());
        problem.init.iter().for_each(|fact| usage.fact(fact).added = true);
        problem.fluents.iter().for_each(|fact| usage.value(fact));
        for timed in &problem.timed {
            match &timed.change {
                TimedChange::Add(fact) => {
                    let used = usage.fact(fact);
                    (used.added, used.timed) = (true, true);
                }
                TimedChange::Delete(fact) => usage.fact(fact).timed = true,
                TimedChange::Assign(fact) => {
                    usage.value(fact);
                    usage.functions[fact.application.function].timed = true;
                }
                TimedChange::Undefine(application) => {
                    usage.functions[application.function].timed = true;
                    application.arguments.iter().for_each(|&object| usage.objects[object] = true);
                }
            }
        }
        walk::condition(&problem.goal, Polarity::Positive, &mut |part| usage.part(part));
        for preference in &problem.preferences {
            walk::preference(preference, &preference.body, &mut |part| usage.part(part));
        }
        walk::constraints(&problem.constraints, &mut |part| usage.asked(part));
        if let Some(metric) = &problem.metric {
            walk::expression(&metric.expression, &mut |part| usage.part(part));
        }
        if let Some((variables, tasks)) = &problem.htn {
            network(tasks, &mut |part| usage.part(part));
            usage.variables(variables);
        }
        usage
    }

    fn fact(&mut self, fact: &Fact) -> &mut PredicateUse {
        fact.arguments.iter().for_each(|&object| self.objects[object] = true);
        &mut self.predicates[fact.predicate]
    }

    fn value(&mut self, fact: &FluentFact) {
        self.functions[fact.application.function].written = true;
        fact.application.arguments.iter().for_each(|&object| self.objects[object] = true);
        if let FluentValue::Object(object) = fact.value {
            self.objects[object] = true;
        }
    }

    /// Part of a trajectory constraint. It may hold without the atom: `at-most-once` and
    /// `sometime-before` hold if it is never true.
    fn asked(&mut self, part: Part<'_>) {
        match part {
            Part::Needs(atom, _) => self.part(Part::Needs(atom, Polarity::Negative)),
            part => self.part(part),
        }
    }

    fn part(&mut self, part: Part<'_>) {
        for term in part.terms() {
            if let Term::Object(object) = term {
                self.objects[*object] = true;
            }
        }
        match part {
            Part::Needs(atom, Polarity::Positive) => self.predicates[atom.predicate].needed_true = true,
            Part::Needs(atom, Polarity::Negative) => self.predicates[atom.predicate].needed_false = true,
            Part::Adds(atom) => self.predicates[atom.predicate].added = true,
            Part::Deletes(atom) => self.predicates[atom.predicate].deleted = true,
            Part::Derives(predicate) => self.predicates[predicate].derived = true,
            Part::Reads(application) => self.functions[application.function].read = true,
            Part::Writes(_, application) => self.functions[application.function].written = true,
            Part::Subtask(SubtaskHead::Task(id)) => self.tasks[id] = true,
            Part::Subtask(SubtaskHead::Action(id)) => self.actions[id] = true,
            Part::Subtask(SubtaskHead::DurativeAction(id)) => self.durative_actions[id] = true,
            Part::Binds(_) | Part::Term(_) => {}
        }
    }

    fn variables(&mut self, variables: &Variables) {
        variables.slots.iter().for_each(|variable| self.types(&variable.types.0));
    }

    fn types(&mut self, types: &[TypeId]) {
        types.iter().for_each(|&id| self.types[id] = true);
    }

    /// Whether the object is named; false for an id that came later.
    pub(crate) fn names(&self, object: ObjectId) -> bool {
        self.objects.as_slice().get(object.index()).copied().unwrap_or(false)
    }
}
