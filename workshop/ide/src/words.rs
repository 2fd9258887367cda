//! The meanings of the language's words, in a sentence each.
//!
//! Sources: Fox & Long, "PDDL2.1", JAIR 2003; Gerevini & Long, "Plan constraints and preferences in PDDL3",
//! 2005; Kovacs, "BNF definition of PDDL 3.1", 2011; Höller et al., "HDDL", AAAI 2020; `docs/rules.md` for
//! Pelea's own words.

/// The meaning of a word of the language; `None` for other words.
pub(crate) fn meaning(word: &str) -> Option<&'static str> {
    let word = word.to_ascii_lowercase();
    WORDS.iter().find(|(known, _)| *known == word).map(|(_, meaning)| *meaning)
}

const WORDS: &[(&str, &str)] = &[
    // Requirements.
    (":strips", "Conjunctions of atoms as conditions, adding and deleting atoms as effects. Always there."),
    (":typing", "Types of parameters and objects: `(:types …)` and `?x - type`."),
    (":negative-preconditions", "`not` in conditions."),
    (":disjunctive-preconditions", "`or` and `imply` in conditions."),
    (":equality", "`(= ?x ?y)`: two terms are the same object."),
    (":existential-preconditions", "`exists` in conditions."),
    (":universal-preconditions", "`forall` in conditions."),
    (":quantified-preconditions", "`exists` and `forall` in conditions."),
    (":conditional-effects", "`when` in effects, and `forall` around effects."),
    (":fluents", "Numeric and object fluents: `(:functions …)`, comparisons and assignments."),
    (":numeric-fluents", "Functions that yield numbers, comparisons, and `increase` and its like."),
    (":object-fluents", "Functions that yield objects, and their assignment."),
    (":adl", "Typing, `not`, `or`, `imply`, `=`, both quantifiers and conditional effects together."),
    (":durative-actions", "Actions that last: `(:durative-action …)`."),
    (":duration-inequalities", "Durations between bounds: `<=` and `>=` in `:duration`."),
    (":continuous-effects", "Effects that go on while an action lasts: `(increase (f) (* #t …))`."),
    (":derived-predicates", "Predicates that axioms derive: `(:derived …)`."),
    (":timed-initial-literals", "What becomes true or false by itself at a time: `(at 5 (p))` in `:init`."),
    (":timed-initial-fluents", "What gets a value by itself at a time: `(at 5 (= (f) 3))` in `:init`."),
    (":preferences", "Conditions that should hold, with a price where they do not: `(preference name …)`."),
    (":constraints", "Conditions on the whole course of a plan: `always`, `sometime`, `within` …"),
    (":action-costs", "The function `total-cost`, which effects increase and the metric minimises."),
    (":goal-utilities", "Goals with a value each, for plans that reach some of them."),
    (":time", "Processes and events: what happens by itself (PDDL+)."),
    (":hierarchy", "Tasks and methods that carry them out (HDDL)."),
    (":method-preconditions", "Conditions of methods (HDDL)."),
    (":multi-agent", "Several agents, who are planned for together (MA-PDDL)."),
    (":unfactored-privacy", "`:private` says what is private to whom, in one file for all agents (MA-PDDL)."),
    (":factored-privacy", "`:private` says what is private to the agent whose file this is (MA-PDDL)."),
    (":agent-rules", "Durative actions are rules of agents: skills, results, claims, priorities, outcomes."),
    (":vocabulary", "`(:writes agent token …)` says which agent may write what."),
    (":invariants", "`(:invariant name …)` says what every run of the robot must satisfy."),
    // Sections.
    ("define", "Opens a definition: `(define (domain name) …)` or `(define (problem name) …)`."),
    (":requirements", "Which parts of the language the file uses."),
    (":import", "Types, constants, predicates and functions of other domains are declared here too."),
    (":types", "The kinds of objects: `truck car - vehicle`."),
    (":constants", "Objects that every problem of the domain has."),
    (":predicates", "What can be true or false of objects: `(at ?who - person ?where - place)`."),
    (":functions", "Values that objects have: numbers, or other objects."),
    (":action", "A way to change the state at once."),
    (":durative-action", "A way to change the state that takes time."),
    (":derived", "An axiom: the predicate holds exactly where the condition does."),
    (":process", "A change that goes on by itself as long as its condition holds (PDDL+)."),
    (":event", "A change that happens by itself as soon as its condition holds (PDDL+)."),
    (":task", "Something to do that methods break down; in a method, what it carries out."),
    (":method", "A way to carry out a task."),
    (":writes", "Which tokens an agent may write."),
    (":domain", "The domain that the problem is for."),
    (":objects", "What there is in the problem, besides the domain's constants."),
    (":init", "What is true in the beginning; everything else is false."),
    (":goal", "What shall be true in the end."),
    (":metric", "What makes one plan better than another."),
    (":htn", "The tasks that shall be carried out."),
    (":axiom", "What follows from what: a derived predicate (PDDL 1.2)."),
    (":timeless", "Facts that hold in the beginning of every problem (PDDL 1.2)."),
    (":extends", "Domains whose declarations hold here too (PDDL 1.2)."),
    (":constraint", "What must hold in every state of a plan."),
    (":invariant", "What every run must satisfy; a monitor holds it against what happens."),
    (":length", "How long a plan may be; no planner reads it."),
    // Keys.
    (":parameters", "Which objects it is about; any that fit their types."),
    (":precondition", "What must be true for it to be possible."),
    (":effect", "What is true afterwards; the rest stays."),
    (":duration", "How long it takes: `(= ?duration 5)`, or bounds."),
    (":condition", "What must be true, and when: `(at start …)`, `(over all …)`, `(at end …)`."),
    (":subtasks", "Its parts, in any order that `:ordering` allows."),
    (":tasks", "Its parts, in any order that `:ordering` allows."),
    (":ordered-subtasks", "Its parts, one after the other."),
    (":ordered-tasks", "Its parts, one after the other."),
    (":ordering", "Which parts come before which: `(< first second)`."),
    (":skill", "What the agent calls between start and end."),
    (":results", "Variables that the skill binds when it ends."),
    (":claims", "Resources that are held from start to end."),
    (":priority", "Who wins a resource: higher before lower."),
    (":vars", "Variables that the precondition of an action binds (PDDL 1.2)."),
    (":context", "What an axiom's conclusion follows from (PDDL 1.2)."),
    (":implies", "What an axiom concludes (PDDL 1.2)."),
    (":agent", "Who does it: the first parameter (MA-PDDL)."),
    (":private", "What only some agents know (MA-PDDL); here all do."),
    (":order", "Which parts come before which: `(< first second)`."),
    // Forms.
    ("and", "All of them."),
    ("or", "At least one of them."),
    ("not", "In a condition: it does not hold. In an effect: it becomes false."),
    ("imply", "Where the first holds, the second does too."),
    ("forall", "For every object of the type."),
    ("exists", "For at least one object of the type."),
    ("when", "The effect happens where the condition held before."),
    ("either", "One of these types."),
    ("object", "The type of everything."),
    ("number", "What a numeric function yields."),
    ("assign", "The function gets this value."),
    ("increase", "The function's value grows by this much."),
    ("decrease", "The function's value shrinks by this much."),
    ("scale-up", "The function's value is multiplied by this."),
    ("scale-down", "The function's value is divided by this."),
    ("undefined", "No value at all."),
    ("?duration", "How long the action takes, in its own time unit."),
    ("#t", "The time since the action or process began."),
    ("total-time", "How long the plan takes."),
    ("minimize", "The less the better."),
    ("maximize", "The more the better."),
    ("preference", "A condition that should hold; the metric may count where it does not."),
    ("is-violated", "How often a preference did not hold."),
    ("always", "It holds in every state of the plan."),
    ("sometime", "It holds in some state of the plan."),
    ("within", "It holds at this time or before."),
    ("at-most-once", "It becomes true once at most."),
    ("sometime-after", "Wherever the first holds, the second holds then or later."),
    ("sometime-before", "Wherever the first holds, the second held before."),
    ("always-within", "Wherever the first holds, the second holds at most so much later."),
    ("hold-during", "It holds from the first time to the second."),
    ("hold-after", "It holds from this time on."),
    ("at", "A time: `(at start …)`, `(at end …)`; in `:init` `(at 5 …)`."),
    ("over", "`(over all …)`: all the time between start and end."),
    ("start", "When the action begins."),
    ("all", "All the time between start and end."),
    ("end", "When the action ends."),
];

#[cfg(test)]
mod tests {
    use super::meaning;

    #[test]
    fn every_requirement_has_a_meaning() {
        for requirement in pddl::model::Requirement::ALL {
            assert!(meaning(requirement.as_str()).is_some(), "{}", requirement.as_str());
        }
    }
}
