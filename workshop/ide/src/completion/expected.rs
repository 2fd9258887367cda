//! What kind of thing is expected at a cursor.

use crate::context::{Context, Open};

/// The kind of thing that is expected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Expected {
    /// A whole definition, with its parenthesis or without.
    Definition { parenthesis: bool },
    /// A section of a domain or a problem, with its parentheses or without.
    Section { parenthesis: bool },
    /// A requirement flag.
    Requirement,
    /// The name of a domain.
    Domain,
    /// A type.
    Type,
    /// A key of an action, method …
    Key,
    /// A condition, an effect or a number, with its parenthesis or without.
    Form { form: Form, parenthesis: bool },
    /// An argument of the symbol at the head of the innermost list.
    Argument,
    /// A side of an equation: a term or a function.
    Side,
    /// `start`, `end` or `all`.
    Time,
    /// `minimize` or `maximize`.
    Objective,
    /// A subtask's id.
    SubtaskId,
}

/// The possible roles of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Condition,
    TimedCondition,
    Constraint,
    Effect,
    TimedEffect,
    Number,
    Fact,
    Step,
    Task,
    DerivedHead,
    Duration,
}

const LOGIC: &[&str] = &["and", "or", "not", "imply", "forall", "exists", "when", "preference"];
const NUMERIC: &[&str] =
    &["<", ">", "<=", ">=", "+", "-", "*", "/", "assign", "increase", "decrease", "scale-up", "scale-down"];
const TRAJECTORY: &[&str] = &[
    "always",
    "sometime",
    "within",
    "at-most-once",
    "sometime-after",
    "sometime-before",
    "always-within",
    "hold-during",
    "hold-after",
];

fn one_of(word: &str, words: &[&str]) -> bool {
    words.iter().any(|w| w.eq_ignore_ascii_case(word))
}

/// What is expected at the cursor; `None` where any new name may stand.
pub(super) fn expected(context: &Context<'_>, is_plan: bool) -> Option<Expected> {
    let Some(inner) = context.inner() else {
        return Some(if is_plan {
            Expected::Form { form: Form::Step, parenthesis: true }
        } else {
            Expected::Definition { parenthesis: true }
        });
    };
    if is_plan {
        let head = Expected::Form { form: Form::Step, parenthesis: false };
        return Some(if inner.items.is_empty() { head } else { Expected::Argument });
    }
    if !context.open[0].is_headed("define") {
        let first = context.open.len() == 1 && inner.items.is_empty();
        return first.then_some(Expected::Definition { parenthesis: false });
    }
    let Some(section) = context.section() else {
        return (inner.items.len() > 1).then_some(Expected::Section { parenthesis: true });
    };
    let depth = context.open.len();
    if depth == 2 && inner.items.is_empty() {
        return (context.open[0].items.len() > 1).then_some(Expected::Section { parenthesis: false });
    }
    let keyword = section.head().to_ascii_lowercase();
    match keyword.as_str() {
        ":requirements" => Some(Expected::Requirement),
        ":domain" | ":import" => Some(Expected::Domain),
        ":types" | ":constants" | ":objects" | ":predicates" | ":functions" => {
            inner.expects_type().then_some(Expected::Type)
        }
        ":metric" if depth == 2 && inner.items.len() == 1 => Some(Expected::Objective),
        ":metric" => form(context, Form::Number, 2),
        ":init" => form(context, Form::Fact, 2),
        ":goal" => form(context, Form::Condition, 2),
        ":constraints" => form(context, Form::Constraint, 2),
        ":derived" if depth == 2 && inner.items.len() == 1 => {
            Some(Expected::Form { form: Form::DerivedHead, parenthesis: true })
        }
        ":derived" if depth == 3 && section.items.len() == 1 => match inner.items.is_empty() {
            true => Some(Expected::Form { form: Form::DerivedHead, parenthesis: false }),
            false => inner.expects_type().then_some(Expected::Type),
        },
        ":derived" => form(context, Form::Condition, 2),
        ":action" | ":durative-action" | ":task" | ":method" | ":process" | ":event" | ":invariant"
        | ":htn" => keyed(context, section, &keyword),
        _ => None,
    }
}

/// Inside a section with keys.
fn keyed(context: &Context<'_>, section: &Open<'_>, keyword: &str) -> Option<Expected> {
    let inner = context.inner()?;
    let key = section.key().to_ascii_lowercase();
    let named = usize::from(keyword != ":htn");
    if context.open.len() == 2 {
        // A key expects its value, a value the next key.
        let after_key =
            inner.items.len() > 1 && inner.items.last().is_some_and(super::super::context::Item::is_keyword);
        if !after_key {
            return (inner.items.len() > named).then_some(Expected::Key);
        }
    }
    let durative = keyword == ":durative-action";
    match key.as_str() {
        ":parameters" | ":results" | ":vars" => inner.expects_type().then_some(Expected::Type),
        ":constraint" if keyword == ":invariant" => form(context, Form::Constraint, 2),
        ":precondition" | ":constraints" => form(context, Form::Condition, 2),
        ":condition" if durative => form(context, Form::TimedCondition, 2),
        ":effect" if durative => form(context, Form::TimedEffect, 2),
        ":effect" => form(context, Form::Effect, 2),
        ":duration" => form(context, Form::Duration, 2),
        ":task" => form(context, Form::Task, 2),
        ":subtasks" | ":tasks" | ":ordered-subtasks" | ":ordered-tasks" => form(context, Form::Step, 2),
        ":ordering" => inner.is_headed("<").then_some(Expected::SubtaskId),
        ":skill" | ":claims" if context.open.len() > 2 && !inner.items.is_empty() => Some(Expected::Argument),
        ":claims" if context.open.len() > 2 => Some(Expected::Argument),
        _ => None,
    }
}

/// Inside a condition, an effect or a similar form, which begins at `depth`.
fn form(context: &Context<'_>, form: Form, depth: usize) -> Option<Expected> {
    let inner = context.inner()?;
    let nested = &context.open[depth.min(context.open.len())..];
    if nested.is_empty() {
        return Some(Expected::Form { form: at(form, nested), parenthesis: true });
    }
    let binds = |list: &Open<'_>| list.is_headed("forall") || list.is_headed("exists");
    if nested.len() > 1 && context.outer().is_some_and(|outer| binds(outer) && outer.items.len() == 1) {
        return inner.expects_type().then_some(Expected::Type);
    }
    if inner.items.is_empty() {
        let around = &nested[..nested.len() - 1];
        return Some(Expected::Form { form: at(form, around), parenthesis: false });
    }
    let head = inner.head();
    let position = inner.items.len();
    if head.eq_ignore_ascii_case("at")
        && position == 1
        && matches!(form, Form::TimedCondition | Form::TimedEffect)
        || head.eq_ignore_ascii_case("over") && position == 1
    {
        return Some(Expected::Time);
    }
    if position == 1 && (binds(inner) || head.eq_ignore_ascii_case("preference")) {
        return None;
    }
    let timed = (head.eq_ignore_ascii_case("at") || head.eq_ignore_ascii_case("over"))
        && position == 2
        && matches!(form, Form::TimedCondition | Form::TimedEffect);
    if one_of(head, LOGIC) || one_of(head, NUMERIC) || one_of(head, TRAJECTORY) || timed {
        // An object fluent's value may be a term.
        if head.eq_ignore_ascii_case("assign") && position == 2 {
            return Some(Expected::Side);
        }
        return Some(Expected::Form { form: at(form, nested), parenthesis: true });
    }
    if head == "=" {
        return Some(if form == Form::Duration {
            Expected::Form { form: Form::Number, parenthesis: true }
        } else {
            Expected::Side
        });
    }
    Some(Expected::Argument)
}

/// What the enclosing lists expect.
fn at(form: Form, around: &[Open<'_>]) -> Form {
    let mut now = form;
    for list in around {
        let head = list.head();
        let time = head.eq_ignore_ascii_case("at") || head.eq_ignore_ascii_case("over");
        let position = list.items.len();
        now = match now {
            Form::TimedCondition if time => Form::Condition,
            Form::TimedEffect if time => Form::Effect,
            Form::TimedEffect if list.is_headed("when") && position == 1 => Form::TimedCondition,
            Form::Effect if list.is_headed("when") && position == 1 => Form::Condition,
            Form::Constraint if one_of(head, TRAJECTORY) => Form::Condition,
            _ if one_of(head, NUMERIC) || head == "=" => Form::Number,
            same => same,
        };
    }
    now
}
