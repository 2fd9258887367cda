//! Types, constants, predicates, functions, permissions.

use super::Printer;
use crate::model::{FunctionValue, Object, TokenSymbol, TypeTable, Variables};

impl Printer<'_> {
    pub(super) fn type_section(&mut self) {
        let table = &self.domain.types;
        if table.len() < 2 {
            return;
        }
        self.push("\n  (:types");
        for (_, t) in table.enumerate().filter(|(id, _)| *id != TypeTable::OBJECT) {
            self.push("\n    ");
            self.push(&t.name);
            self.push(" - ");
            self.types(&t.parents);
        }
        self.push(")");
    }

    pub(super) fn object_section<'a>(&mut self, open: &str, objects: impl Iterator<Item = &'a Object>) {
        let mut any = false;
        for object in objects {
            self.push(if any { "\n    " } else { open });
            any = true;
            self.push(&object.name);
            self.push(" - ");
            self.types(object.types.declared());
        }
        if any {
            self.push(")");
        }
    }

    fn declaration(&mut self, name: &str, v: &Variables) {
        self.push("(");
        self.push(name);
        for slot in v.parameter_ids() {
            self.push(" ");
            self.variable(v, slot);
        }
        self.push(")");
    }

    pub(super) fn predicate_section(&mut self) {
        let domain = self.domain;
        if domain.predicates.is_empty() {
            return;
        }
        self.push("\n  (:predicates");
        for predicate in &domain.predicates {
            self.push("\n    ");
            self.declaration(&predicate.name, &predicate.variables);
        }
        self.push(")");
    }

    /// Prints a section for each function, so that a numeric function needs no `- number`, which would name
    /// a type if a type has that name.
    pub(super) fn function_sections(&mut self) {
        let domain = self.domain;
        for function in &domain.functions {
            self.push("\n  (:functions ");
            self.declaration(&function.name, &function.variables);
            if let FunctionValue::Object(types) = &function.value {
                self.push(" - ");
                self.types(&types.0);
            }
            self.push(")");
        }
    }

    pub(super) fn permission_sections(&mut self) {
        let domain = self.domain;
        for permission in &domain.permissions {
            self.push("\n  (:writes ");
            self.push(&permission.agent);
            for token in &permission.tokens {
                let name = match token.symbol {
                    TokenSymbol::Predicate(id) => &domain.predicates[id].name,
                    TokenSymbol::Function(id) => &domain.functions[id].name,
                    TokenSymbol::Type(id) => &domain.types[id].name,
                };
                self.push(" ");
                if token.arguments.is_empty() {
                    self.push(name);
                    continue;
                }
                self.push("(");
                self.list(name, &token.arguments, |p, argument| match argument {
                    Some(object) => p.push(&p.objects[*object].name),
                    None => p.push("_"),
                });
            }
            self.push(")");
        }
    }
}
