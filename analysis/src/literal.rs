//! Atoms of which some arguments are open, and bindings of a schema's variables.

use pddl::model::{
    Application, Atom, Expression, ExpressionKind, FunctionId, Name, ObjectId, PredicateId, Term, VariableId,
    Variables,
};

use crate::instance::Instance;

/// An atom with open arguments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    /// Its predicate.
    pub predicate: PredicateId,
    /// Its arguments: an object, or the variable that stands for any object.
    pub arguments: Vec<Result<ObjectId, Name>>,
}

/// A condition on an atom with open arguments: that it holds, or that it does not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Literal {
    /// The atom.
    pub pattern: Pattern,
    /// Whether the atom must hold.
    pub positive: bool,
}

/// A numeric fluent of which some arguments may be open: the number of a variable.
pub(crate) type FluentKey = (FunctionId, Vec<Result<ObjectId, u32>>);

/// Objects for some variables of a schema.
#[derive(Clone, Debug)]
pub struct Binding<'a> {
    variables: &'a Variables,
    objects: Vec<Option<ObjectId>>,
}

impl<'a> Binding<'a> {
    /// All variables open.
    pub fn new(variables: &'a Variables) -> Self {
        Self { variables, objects: vec![None; variables.slots.len()] }
    }

    /// The variables that it binds.
    pub fn variables(&self) -> &'a Variables {
        self.variables
    }

    /// The object of a variable.
    pub fn get(&self, variable: VariableId) -> Option<ObjectId> {
        self.objects[variable.0 as usize]
    }

    /// Binds a variable, or opens it.
    pub fn set(&mut self, variable: VariableId, object: Option<ObjectId>) {
        self.objects[variable.0 as usize] = object;
    }

    /// Binds the parameters, in order.
    pub fn set_parameters(&mut self, objects: &[ObjectId]) {
        for (parameter, &object) in self.variables.parameter_ids().zip(objects) {
            self.set(parameter, Some(object));
        }
    }

    /// The object of the variable of that name.
    pub fn named(&self, name: &Name) -> Option<ObjectId> {
        self.variables
            .slots
            .ids()
            .filter(|&v| self.get(v).is_some())
            .find(|&v| self.name(v) == *name)
            .and_then(|v| self.get(v))
    }

    /// Binds the open variable of that name; `false` if the object is not of its type.
    pub fn set_named(&mut self, name: &Name, object: ObjectId, instance: Instance<'_>) -> bool {
        for v in self.variables.slots.ids() {
            if self.get(v).is_none() && self.name(v) == *name {
                self.set(v, Some(object));
                return instance.is_of(object, &self.variables[v].types);
            }
        }
        true
    }

    /// A name that no other variable of the schema has, even where one shadows another.
    fn name(&self, variable: VariableId) -> Name {
        let own = &self.variables[variable].name;
        let before = self.variables.slots.ids().take_while(|&v| v != variable);
        match before.filter(|&v| self.variables[v].name == *own).count() {
            0 => own.clone(),
            more => Name::new(&format!("{own}-{}", more + 1)),
        }
    }

    /// The object that a term stands for, or the name of its open variable.
    pub fn term(&self, term: Term) -> Result<ObjectId, Name> {
        match term {
            Term::Object(object) => Ok(object),
            Term::Variable(v) => self.get(v).ok_or_else(|| self.name(v)),
        }
    }

    /// An atom under the binding.
    pub fn pattern(&self, atom: &Atom) -> Pattern {
        let arguments = atom.arguments.iter().map(|&term| self.term(term)).collect();
        Pattern { predicate: atom.predicate, arguments }
    }

    /// A literal with the variables that are bound by now.
    pub fn literal(&self, literal: &Literal) -> Literal {
        let argument = |argument: &Result<ObjectId, Name>| match argument {
            Ok(object) => Ok(*object),
            Err(name) => self.named(name).ok_or_else(|| name.clone()),
        };
        let arguments = literal.pattern.arguments.iter().map(argument).collect();
        Literal { pattern: Pattern { predicate: literal.pattern.predicate, arguments }, ..*literal }
    }

    /// A fluent under the binding.
    pub(crate) fn fluent(&self, application: &Application) -> FluentKey {
        let argument = |&term: &Term| match term {
            Term::Object(object) => Ok(object),
            Term::Variable(v) => self.get(v).ok_or(v.0),
        };
        (application.function, application.arguments.iter().map(argument).collect())
    }

    /// The parameters' objects, or the names of those that are open.
    pub fn parameters(&self) -> Vec<Result<ObjectId, Name>> {
        self.variables.parameter_ids().map(|v| self.term(Term::Variable(v))).collect()
    }

    /// The binding that makes the atom match the pattern; `None` if they do not match.
    pub fn unified(&self, atom: &Atom, pattern: &Pattern, instance: Instance<'_>) -> Option<Self> {
        if atom.predicate != pattern.predicate {
            return None;
        }
        self.unified_terms(&atom.arguments, &pattern.arguments, instance)
    }

    /// The binding that makes the terms match the arguments; `None` if they do not match.
    pub fn unified_terms<V>(
        &self,
        terms: &[Term],
        arguments: &[Result<ObjectId, V>],
        instance: Instance<'_>,
    ) -> Option<Self> {
        let mut unified = self.clone();
        for (&term, argument) in terms.iter().zip(arguments) {
            let &Ok(object) = argument else { continue };
            match term {
                Term::Object(own) if own != object => return None,
                Term::Object(_) => {}
                Term::Variable(v) => {
                    let is_of = instance.is_of(object, &self.variables[v].types);
                    if !is_of || unified.get(v).is_some_and(|other| other != object) {
                        return None;
                    }
                    unified.set(v, Some(object));
                }
            }
        }
        Some(unified)
    }

    /// An expression as PDDL writes it, with the objects that are bound.
    pub fn text(&self, expression: &Expression, instance: Instance<'_>) -> String {
        match &expression.kind {
            ExpressionKind::Number(value) => value.to_string(),
            ExpressionKind::Fluent(application) => {
                let mut text = format!("({}", instance.domain.functions[application.function].name);
                for &argument in &application.arguments {
                    text.push(' ');
                    match self.term(argument) {
                        Ok(object) => text.push_str(instance.problem.objects[object].name.as_str()),
                        Err(variable) => {
                            text.push('?');
                            text.push_str(variable.as_str().trim_start_matches('?'));
                        }
                    }
                }
                text + ")"
            }
            ExpressionKind::Arithmetic(operator, parts) => {
                let parts: Vec<String> = parts.iter().map(|part| self.text(part, instance)).collect();
                format!("({} {})", operator.symbol(), parts.join(" "))
            }
            _ => "?".to_owned(),
        }
    }
}
