//! Sections, keys and forms with placeholders.

/// A piece of text with placeholders, in the syntax of language servers.
pub(super) type Snippet = (&'static str, &'static str);

/// Whole definitions.
pub(super) const DEFINITIONS: &[Snippet] = &[
    (
        "domain",
        "define (domain ${1:name})\n  (:requirements :strips :typing)\n  (:types ${2:thing})\n  (:predicates (${3:done} ?x - ${2:thing}))\n  $0)",
    ),
    (
        "problem",
        "define (problem ${1:name})\n  (:domain ${2:domain})\n  (:objects ${3:a - object})\n  (:init $4)\n  (:goal (and $0)))",
    ),
];

/// What follows the opening parenthesis of a section.
pub(super) const SECTIONS: &[Snippet] = &[
    (":requirements", ":requirements :${1:typing})"),
    (":import", ":import ${1:domain})"),
    (":types", ":types\n  ${1:thing} - object)"),
    (":constants", ":constants\n  ${1:name} - ${2:object})"),
    (":predicates", ":predicates\n  (${1:name} ?${2:x} - ${3:object}))"),
    (":functions", ":functions\n  (${1:name} ?${2:x} - ${3:object}) - number)"),
    (
        ":action",
        ":action ${1:name}\n  :parameters (${2:?x - object})\n  :precondition (and $3)\n  :effect (and $0))",
    ),
    (
        ":durative-action",
        ":durative-action ${1:name}\n  :parameters (${2:?x - object})\n  :duration (= ?duration ${3:1})\n  :condition (and (at start $4))\n  :effect (and (at end $0)))",
    ),
    (":derived", ":derived (${1:name} ?${2:x} - ${3:object})\n  $0)"),
    (
        ":process",
        ":process ${1:name}\n  :parameters (${2:?x - object})\n  :precondition (and $3)\n  :effect (and $0))",
    ),
    (
        ":event",
        ":event ${1:name}\n  :parameters (${2:?x - object})\n  :precondition (and $3)\n  :effect (and $0))",
    ),
    (":task", ":task ${1:name}\n  :parameters (${2:?x - object}))"),
    (
        ":method",
        ":method ${1:name}\n  :parameters (${2:?x - object})\n  :task (${3:task} $4)\n  :precondition (and $5)\n  :ordered-subtasks (and $0))",
    ),
    (":writes", ":writes ${1:agent} $0)"),
    (":constraints", ":constraints (and $0))"),
    (
        ":invariant",
        ":invariant ${1:name}\n  :parameters (${2:?x - object})\n  :says (${3:sentence})\n  :constraint (always $0))",
    ),
    (":domain", ":domain ${1:name})"),
    (":objects", ":objects\n  ${1:name} - ${2:object})"),
    (":htn", ":htn\n  :parameters ()\n  :ordered-subtasks (and $0))"),
    (":init", ":init\n  $0)"),
    (":goal", ":goal (and $0))"),
    (":metric", ":metric ${1:minimize} $0)"),
];

/// Keys with their values.
pub(super) const KEYS: &[Snippet] = &[
    (":parameters", ":parameters (${1:?x - object})"),
    (":precondition", ":precondition (and $0)"),
    (":effect", ":effect (and $0)"),
    (":duration", ":duration (= ?duration ${1:1})"),
    (":condition", ":condition (and (at start $0))"),
    (":task", ":task (${1:task} $0)"),
    (":subtasks", ":subtasks (and $0)"),
    (":ordered-subtasks", ":ordered-subtasks (and $0)"),
    (":ordering", ":ordering (and (< $1 $2))"),
    (":constraints", ":constraints (and $0)"),
    (":skill", ":skill (${1:skill} $0)"),
    (":results", ":results (${1:?x - object})"),
    (":claims", ":claims ($0)"),
    (":priority", ":priority ${1:50}"),
];

/// The keys that a section may have.
pub(super) fn keys_of(section: &str) -> &'static [&'static str] {
    match section.to_ascii_lowercase().as_str() {
        ":action" | ":process" | ":event" => &[":parameters", ":precondition", ":effect"],
        ":invariant" => &[":parameters", ":says", ":constraint"],
        ":durative-action" => &[
            ":parameters",
            ":duration",
            ":condition",
            ":effect",
            ":skill",
            ":results",
            ":claims",
            ":priority",
        ],
        ":task" => &[":parameters"],
        ":method" => &[
            ":parameters",
            ":task",
            ":precondition",
            ":ordered-subtasks",
            ":subtasks",
            ":ordering",
            ":constraints",
        ],
        ":htn" => &[":parameters", ":ordered-subtasks", ":subtasks", ":ordering", ":constraints"],
        _ => &[],
    }
}

/// What follows the opening parenthesis of a condition.
pub(super) const CONDITIONS: &[Snippet] = &[
    ("and", "and $0)"),
    ("or", "or $0)"),
    ("not", "not ($0))"),
    ("imply", "imply ($1) ($0))"),
    ("forall", "forall (?${1:x} - ${2:object}) ($0))"),
    ("exists", "exists (?${1:x} - ${2:object}) ($0))"),
    ("=", "= $1 $0)"),
    ("<", "< ($1) $0)"),
    ("<=", "<= ($1) $0)"),
    (">", "> ($1) $0)"),
    (">=", ">= ($1) $0)"),
    ("preference", "preference ${1:name} ($0))"),
];

pub(super) const TIMED_CONDITIONS: &[Snippet] = &[
    ("and", "and $0)"),
    ("forall", "forall (?${1:x} - ${2:object}) ($0))"),
    ("at start", "at start ($0))"),
    ("over all", "over all ($0))"),
    ("at end", "at end ($0))"),
    ("preference", "preference ${1:name} ($0))"),
];

pub(super) const CONSTRAINTS: &[Snippet] = &[
    ("and", "and $0)"),
    ("forall", "forall (?${1:x} - ${2:object}) ($0))"),
    ("preference", "preference ${1:name} ($0))"),
    ("always", "always ($0))"),
    ("sometime", "sometime ($0))"),
    ("within", "within ${1:10} ($0))"),
    ("at-most-once", "at-most-once ($0))"),
    ("sometime-after", "sometime-after ($1) ($0))"),
    ("sometime-before", "sometime-before ($1) ($0))"),
    ("always-within", "always-within ${1:10} ($2) ($0))"),
    ("hold-during", "hold-during ${1:0} ${2:10} ($0))"),
    ("hold-after", "hold-after ${1:10} ($0))"),
    ("at end", "at end ($0))"),
];

pub(super) const EFFECTS: &[Snippet] = &[
    ("and", "and $0)"),
    ("not", "not ($0))"),
    ("forall", "forall (?${1:x} - ${2:object}) ($0))"),
    ("when", "when ($1) ($0))"),
    ("assign", "assign ($1) $0)"),
    ("increase", "increase ($1) $0)"),
    ("decrease", "decrease ($1) $0)"),
    ("scale-up", "scale-up ($1) $0)"),
    ("scale-down", "scale-down ($1) $0)"),
];

pub(super) const TIMED_EFFECTS: &[Snippet] = &[
    ("and", "and $0)"),
    ("forall", "forall (?${1:x} - ${2:object}) ($0))"),
    ("when", "when ($1) ($0))"),
    ("at start", "at start ($0))"),
    ("at end", "at end ($0))"),
];

pub(super) const FACTS: &[Snippet] = &[("=", "= ($1) $0)"), ("at", "at ${1:5} ($0))")];

pub(super) const NUMBERS: &[Snippet] =
    &[("+", "+ $1 $0)"), ("-", "- $1 $0)"), ("*", "* $1 $0)"), ("/", "/ $1 $0)")];

pub(super) const DURATIONS: &[Snippet] = &[
    ("=", "= ?duration ${1:1})"),
    ("<=", "<= ?duration ${1:10})"),
    (">=", ">= ?duration ${1:1})"),
    ("and", "and $0)"),
];

pub(super) const SUBTASKS: &[Snippet] = &[("and", "and $0)")];
