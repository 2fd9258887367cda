//! E02: names that nothing declares.

use super::Explanation;

pub(super) const EXPLANATIONS: &[Explanation] = &[
    Explanation {
        code: "E0201",
        title: "unknown type",
        meaning: "A type is used that `:types` does not declare.",
        why: "Nothing could be of that type. Declare it; `object` alone needs no declaration.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lmap)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp)))"],
    },
    Explanation {
        code: "E0202",
        title: "unknown predicate",
        meaning: "A condition, an effect or a fact uses a predicate that `:predicates` does not declare.",
        why: "It would never hold, or never be read: a misspelled name makes an action that can never \
         happen.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lti ?x)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))"],
    },
    Explanation {
        code: "E0203",
        title: "unknown function",
        meaning: "A term uses a function that `:functions` does not declare.",
        why: "A function without a declaration has neither parameters nor a type.",
        wrong: &["\
(define (domain hall)
  (:requirements :numeric-fluents)
  (:predicates (lit))
  (:functions (power))
  (:action switch :precondition (> (powr) 5) :effect (lit)))"],
        right: &["\
(define (domain hall)
  (:requirements :numeric-fluents)
  (:predicates (lit))
  (:functions (power))
  (:action switch :precondition (> (power) 5) :effect (lit)))"],
    },
    Explanation {
        code: "E0204",
        title: "unknown object",
        meaning: "A name stands where an object is needed, and neither `:constants` nor `:objects` declares \
         it.",
        why: "A domain knows its constants only; the objects of a problem are known in that problem.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init (lit left))
  (:goal (lit rigth)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init (lit left))
  (:goal (lit right)))",
        ],
    },
    Explanation {
        code: "E0205",
        title: "unknown variable",
        meaning: "A variable is used that no `:parameters`, `forall` or `exists` around it binds.",
        why: "Nothing says what it stands for. Declare it as a parameter, or bind it with `forall` or \
         `exists`.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?y)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))"],
    },
    Explanation {
        code: "E0206",
        title: "unknown action",
        meaning: "A step of a plan names an action that the domain does not have.",
        why: "A plan can hold actions of its domain only; perhaps it is a plan for another version of \
         it.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init (lit left))
  (:goal (lit right)))",
            "\
(swich right)",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left right - lamp)
  (:init (lit left))
  (:goal (lit right)))",
            "\
(switch right)",
        ],
    },
    Explanation {
        code: "E0207",
        title: "unknown task",
        meaning: "A method names a task in `:task` that no `(:task …)` declares. Actions are no compound \
         tasks.",
        why: "Such a method could never be chosen.",
        wrong: &["\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brihgten)
    :subtasks (and (first (switch)) (second (switch)))
    :ordering (< first second)))"],
        right: &["\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brighten)
    :subtasks (and (first (switch)) (second (switch)))
    :ordering (< first second)))"],
    },
    Explanation {
        code: "E0208",
        title: "unknown task or action",
        meaning: "A subtask is neither a declared task nor an action.",
        why: "It could be neither refined nor carried out, and no method with it would ever succeed.",
        wrong: &["\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brighten)
    :subtasks (and (first (switch)) (second (swithc)))
    :ordering (< first second)))"],
        right: &["\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brighten)
    :subtasks (and (first (switch)) (second (switch)))
    :ordering (< first second)))"],
    },
    Explanation {
        code: "E0209",
        title: "unknown method",
        meaning: "A hierarchical plan names a method that the domain does not have.",
        why: "A plan that uses a method which does not exist is not a plan for this domain.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brighten)
    :subtasks (switch)))",
            "\
(define (problem evening)
  (:domain hall)
  (:htn :subtasks (brighten))
  (:init))",
            "\
==>
0 switch
root 1
1 brighten -> by-foot 0
<==",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brighten)
    :subtasks (switch)))",
            "\
(define (problem evening)
  (:domain hall)
  (:htn :subtasks (brighten))
  (:init))",
            "\
==>
0 switch
root 1
1 brighten -> by-hand 0
<==",
        ],
    },
    Explanation {
        code: "E0210",
        title: "unknown subtask",
        meaning: "An ordering names the id of a subtask that the task network does not have.",
        why: "The ordering would order nothing, and the subtasks could come in a sequence that you did \
         not want.",
        wrong: &["\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brighten)
    :subtasks (and (first (switch)) (second (switch)))
    :ordering (< first secnod)))"],
        right: &["\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brighten)
    :subtasks (and (first (switch)) (second (switch)))
    :ordering (< first second)))"],
    },
    Explanation {
        code: "E0211",
        title: "unknown token",
        meaning: "`:writes` names a token of the graph that is neither a predicate nor a function nor a \
         type.",
        why: "The agent would be allowed to write something that does not exist, and not what was meant.",
        wrong: &["\
(define (domain vocabulary)
  (:requirements :typing :vocabulary)
  (:types robot state)
  (:predicates (is ?r - robot ?s - state))
  (:writes speech iz))"],
        right: &["\
(define (domain vocabulary)
  (:requirements :typing :vocabulary)
  (:types robot state)
  (:predicates (is ?r - robot ?s - state))
  (:writes speech is))"],
    },
    Explanation {
        code: "E0212",
        title: "unknown domain",
        meaning: "`(:import …)` names a domain that was not found.",
        why: "What it declares is missing here. It is looked for among the files given, beside the file \
         that imports it, and in the folders of the robots.",
        wrong: &[
            "\
(define (domain vocabulary)
  (:requirements :typing :vocabulary)
  (:types robot state)
  (:predicates (is ?r - robot ?s - state))
  (:writes speech is))",
            "\
(define (domain rules)
  (:requirements :typing)
  (:import dictoinary)
  (:predicates (silent)))",
        ],
        right: &[
            "\
(define (domain vocabulary)
  (:requirements :typing :vocabulary)
  (:types robot state)
  (:predicates (is ?r - robot ?s - state))
  (:writes speech is))",
            "\
(define (domain rules)
  (:requirements :typing)
  (:import vocabulary)
  (:predicates (silent ?r - robot)))",
        ],
    },
    Explanation {
        code: "W0213",
        title: "unknown requirement",
        meaning: "`:requirements` names something that is no requirement of PDDL, HDDL or of ours.",
        why: "It changes nothing here, but other tools may refuse the file.",
        wrong: &["\
(define (domain hall)
  (:requirements :typping)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch :parameters (?x - lamp) :effect (lit ?x)))"],
    },
    Explanation {
        code: "E0214",
        title: "unknown number in a plan",
        meaning: "The root or a task of a hierarchical plan names an action or a task by a number that no line \
         of the plan has.",
        why: "What is missing may have been what carries the task out, so the plan cannot be checked.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brighten)
    :subtasks (switch)))",
            "\
(define (problem evening)
  (:domain hall)
  (:htn :subtasks (brighten))
  (:init))",
            "\
==>
0 switch
root 2
1 brighten -> by-hand 0
<==",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :hierarchy)
  (:predicates (lit))
  (:task brighten :parameters ())
  (:action switch :effect (lit))
  (:method by-hand
    :parameters ()
    :task (brighten)
    :subtasks (switch)))",
            "\
(define (problem evening)
  (:domain hall)
  (:htn :subtasks (brighten))
  (:init))",
            "\
==>
0 switch
root 1
1 brighten -> by-hand 0
<==",
        ],
    },
    Explanation {
        code: "W0215",
        title: "unknown preference",
        meaning: "`(is-violated NAME)` in a metric names a preference that neither the domain nor the problem \
         has.",
        why: "No plan can violate what is not there, so this part of the metric is always 0.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :preferences)
  (:predicates (lit)))",
            "\
(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (preference bright (lit)))
  (:metric minimize (is-violated brigth)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :preferences)
  (:predicates (lit)))",
            "\
(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (preference bright (lit)))
  (:metric minimize (is-violated bright)))",
        ],
    },
];
