//! What the conditions of a schema certainly need, under a binding of some of its variables.

use super::oracle::Oracle;
use super::{Pattern, Wanted};
use pddl::model::{
    Atom, Comparison, Condition, ConditionKind, Expression, Name, ObjectId, Term, VariableId, Variables,
};

/// Objects for some variables of a schema.
#[derive(Clone)]
pub(super) struct Binding<'a> {
    pub(super) variables: &'a Variables,
    objects: Vec<Option<ObjectId>>,
}

/// A comparison that must hold.
#[derive(Clone, Copy)]
pub(super) struct Compared<'a> {
    pub(super) comparison: Comparison,
    pub(super) left: &'a Expression,
    pub(super) right: &'a Expression,
}

/// Parts of a conjunction.
#[derive(Clone, Default)]
pub(super) struct Needs<'a> {
    pub(super) literals: Vec<Wanted>,
    pub(super) comparisons: Vec<Compared<'a>>,
    /// What is known to be false: two objects that are not the same, or of another type.
    pub(super) is_false: bool,
}

impl<'a> Binding<'a> {
    pub(super) fn new(variables: &'a Variables) -> Self {
        Self { variables, objects: vec![None; variables.slots.len()] }
    }

    pub(super) fn get(&self, variable: VariableId) -> Option<ObjectId> {
        self.objects[variable.0 as usize]
    }

    pub(super) fn set(&mut self, variable: VariableId, object: Option<ObjectId>) {
        self.objects[variable.0 as usize] = object;
    }

    /// The object of the variable of that name.
    pub(super) fn named(&self, name: &Name) -> Option<ObjectId> {
        self.variables
            .slots
            .ids()
            .filter(|&v| self.get(v).is_some())
            .find(|&v| self.name(v) == *name)
            .and_then(|v| self.get(v))
    }

    /// Binds the variable of that name; whether the object is of its type.
    pub(super) fn set_named(&mut self, name: &Name, object: ObjectId, oracle: &Oracle<'_>) -> bool {
        for v in self.variables.slots.ids() {
            if self.get(v).is_none() && self.name(v) == *name {
                self.set(v, Some(object));
                return oracle.is_of(object, &self.variables[v].types);
            }
        }
        true
    }

    /// A name that no other variable of the schema has, whatever stands in the shadow of what.
    fn name(&self, variable: VariableId) -> Name {
        let own = &self.variables[variable].name;
        let before = self.variables.slots.ids().take_while(|&v| v != variable);
        match before.filter(|&v| self.variables[v].name == *own).count() {
            0 => own.clone(),
            more => Name::new(&format!("{own}-{}", more + 1)),
        }
    }

    pub(super) fn term(&self, term: Term) -> Result<ObjectId, Name> {
        match term {
            Term::Object(object) => Ok(object),
            Term::Variable(v) => self.get(v).ok_or_else(|| self.name(v)),
        }
    }

    pub(super) fn pattern(&self, atom: &Atom) -> Pattern {
        let arguments = atom.arguments.iter().map(|&term| self.term(term)).collect();
        Pattern { predicate: atom.predicate, arguments }
    }

    /// What its parameters are bound to.
    pub(super) fn parameters(&self) -> Vec<Result<ObjectId, Name>> {
        self.variables.parameter_ids().map(|v| self.term(Term::Variable(v))).collect()
    }

    /// Binds what it takes for the atom to fit the pattern; `None` if it does not.
    pub(super) fn unified(&self, atom: &Atom, pattern: &Pattern, oracle: &Oracle<'_>) -> Option<Self> {
        if atom.predicate != pattern.predicate {
            return None;
        }
        self.unified_terms(&atom.arguments, &pattern.arguments, oracle)
    }

    /// The same of lists of arguments.
    pub(super) fn unified_terms(
        &self,
        terms: &[Term],
        arguments: &[Result<ObjectId, Name>],
        oracle: &Oracle<'_>,
    ) -> Option<Self> {
        let mut unified = self.clone();
        for (&term, argument) in terms.iter().zip(arguments) {
            let Ok(object) = *argument else { continue };
            match term {
                Term::Object(own) if own != object => return None,
                Term::Object(_) => {}
                Term::Variable(v) => {
                    let fits = oracle.is_of(object, &self.variables[v].types);
                    if !fits || unified.get(v).is_some_and(|other| other != object) {
                        return None;
                    }
                    unified.set(v, Some(object));
                }
            }
        }
        Some(unified)
    }
}

impl<'a> Needs<'a> {
    /// Adds what a condition certainly needs. What is inside of disjunctions and universal parts is left out.
    pub(super) fn add(
        &mut self,
        condition: &'a Condition,
        positive: bool,
        binding: &Binding<'_>,
        oracle: &Oracle<'_>,
    ) {
        let both = |left: Term, right: Term| match (binding.term(left), binding.term(right)) {
            (Ok(left), Ok(right)) => Some(left == right),
            _ => None,
        };
        match (&condition.kind, positive) {
            (ConditionKind::And(parts), true) | (ConditionKind::Or(parts), false) => {
                parts.iter().for_each(|part| self.add(part, positive, binding, oracle));
            }
            (ConditionKind::Not(inner), _) => self.add(inner, !positive, binding, oracle),
            (ConditionKind::Imply(if_, then), false) => {
                self.add(if_, true, binding, oracle);
                self.add(then, false, binding, oracle);
            }
            (ConditionKind::Exists(_, inner), true) | (ConditionKind::Forall(_, inner), false) => {
                self.add(inner, positive, binding, oracle);
            }
            (ConditionKind::Atom(atom), _) => {
                self.literals.push(Wanted { pattern: binding.pattern(atom), positive });
            }
            (ConditionKind::Same(left, right), _) => {
                self.is_false |= both(*left, *right).is_some_and(|same| same != positive);
            }
            (ConditionKind::HasType(term, types), _) => {
                self.is_false |= binding.term(*term).is_ok_and(|o| oracle.is_of(o, types) != positive);
            }
            (ConditionKind::Compare(comparison, left, right), true) => {
                self.comparisons.push(Compared { comparison: *comparison, left, right });
            }
            _ => {}
        }
    }
}
