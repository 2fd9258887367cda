//! An effect without its connectives: every change, and where it stands.

use pddl::model::{
    Application, AssignOperator, AssignedValue, Atom, Condition, Effect, EffectKind, VariableId,
};

/// A change.
pub enum Change<'a> {
    /// An atom becomes true.
    Add(&'a Atom),
    /// An atom becomes false.
    Delete(&'a Atom),
    /// A fluent changes.
    Assign(AssignOperator, &'a Application, &'a AssignedValue),
}

/// Where a change stands: under which conditions, for all values of which slots.
#[derive(Clone, Default)]
pub struct Context<'a> {
    /// The conditions of the `when`s around it.
    pub when: Vec<&'a Condition>,
    /// The slots of the `forall`s around it.
    pub forall: Vec<VariableId>,
}

/// Visits every change of an effect.
pub fn changes<'a>(effect: &'a Effect, visit: &mut dyn FnMut(&Context<'a>, &Change<'a>)) {
    walk(effect, &mut Context::default(), visit);
}

fn walk<'a>(effect: &'a Effect, context: &mut Context<'a>, visit: &mut dyn FnMut(&Context<'a>, &Change<'a>)) {
    match &effect.kind {
        EffectKind::And(parts) => parts.iter().for_each(|p| walk(p, context, visit)),
        EffectKind::Add(atom) => visit(context, &Change::Add(atom)),
        EffectKind::Delete(atom) => visit(context, &Change::Delete(atom)),
        EffectKind::Assign(operator, application, value) => {
            visit(context, &Change::Assign(*operator, application, value));
        }
        EffectKind::Forall(variables, inner) => {
            context.forall.extend(variables);
            walk(inner, context, visit);
            context.forall.truncate(context.forall.len() - variables.len());
        }
        EffectKind::When(condition, inner) => {
            context.when.push(condition);
            walk(inner, context, visit);
            context.when.pop();
        }
    }
}
