//! E01: parentheses, sections and keys.

use super::Explanation;

pub(super) const EXPLANATIONS: &[Explanation] = &[
    Explanation {
        code: "E0101",
        title: "a parenthesis is never closed",
        meaning: "An opening parenthesis has no closing one. Which one it is, is told by the keys (`:effect` \
         cannot stand in a condition) and by the indentation of the lines; where they tell nothing, the \
         outermost list that is still open when a section begins inside another one, or at the end of \
         the file.",
        why: "Everything behind it would be read as a part of what it opens. The rest of the file is \
         read as if it had been closed before the next section, so that other mistakes are still \
         found.",
        wrong: &["\
(define (domain hall)
  (:predicates (lit ?x)
  (:action switch :parameters (?x) :effect (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:predicates (lit ?x))
  (:action switch :parameters (?x) :effect (lit ?x)))"],
    },
    Explanation {
        code: "E0102",
        title: "a parenthesis closes nothing",
        meaning: "A closing parenthesis has no opening one, or it closes the definition although more \
         sections follow.",
        why: "A definition that ends too early loses what stands behind it. The sections that follow are \
         read as if the parenthesis were not there.",
        wrong: &["\
(define (domain hall)
  (:predicates (lit ?x)))
  (:action switch :parameters (?x) :effect (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:predicates (lit ?x))
  (:action switch :parameters (?x) :effect (lit ?x)))"],
    },
    Explanation {
        code: "E0103",
        title: "lists are nested too deep",
        meaning: "There are more than a thousand lists around one place. In the example `(and …` and `…)` \
         stand for a thousand of them.",
        why: "No author writes this; a program did, and whatever reads the file next may run out of \
         stack. What is deeper is not read.",
        wrong: &["\
(define (domain hall)
  (:predicates (lit))
  (:action switch :precondition (and …(lit)…) :effect (lit)))"],
        right: &["\
(define (domain hall)
  (:predicates (lit))
  (:action switch :precondition (and (lit)) :effect (lit)))"],
    },
    Explanation {
        code: "E0104",
        title: "this is not a definition",
        meaning: "The file holds no `(define (domain …) …)` where a domain is to be read, or no `(define \
         (problem …) …)` where a problem is. Or it \
         should be a plan and holds no step. A file in RDDL is told by its name.",
        why: "Either the wrong file was given, for instance the problem in the place of the domain, or \
         the first line is misspelled. A text that is no plan must not pass for the empty one.",
        wrong: &["\
(define (domian hall)
  (:predicates (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:predicates (lit ?x)))"],
    },
    Explanation {
        code: "E0105",
        title: "something else should stand here",
        meaning: "The language does not allow what stands here; the message says what is expected in its \
         place.",
        why: "What cannot be read has no meaning, and a guess could be another one than yours.",
        wrong: &["\
(define (domain hall)
  (:predicates lit)
  (:action switch :parameters ()))"],
        right: &["\
(define (domain hall)
  (:predicates (lit))
  (:action switch :parameters ()))"],
    },
    Explanation {
        code: "E0106",
        title: "something required is missing",
        meaning: "A part that cannot be left out is not there: a problem without a goal, a method without \
         its task, a hyphen without a type.",
        why: "There is no value that could be taken in its place without changing what the file means.",
        wrong: &[
            "\
(define (domain hall)
  (:predicates (lit)))",
            "\
(define (problem evening)
  (:domain hall)
  (:init (lit)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:predicates (lit)))",
            "\
(define (problem evening)
  (:domain hall)
  (:init (lit))
  (:goal (lit)))",
        ],
    },
    Explanation {
        code: "E0107",
        title: "unknown section",
        meaning: "A list directly in `(define …)` starts with a keyword that is no section of a domain or of \
         a problem.",
        why: "A section that were skipped silently would be missing without a trace. Most often it is \
         misspelled, or it belongs into the other file.",
        wrong: &["\
(define (domain hall)
  (:predikates (lit)))"],
        right: &["\
(define (domain hall)
  (:predicates (lit)))"],
    },
    Explanation {
        code: "E0108",
        title: "unknown key",
        meaning: "An action, a method or another section has a key that it cannot have.",
        why: "The value of a misspelled `:precondition` would be ignored, and the action could always \
         happen.",
        wrong: &["\
(define (domain hall)
  (:predicates (lit))
  (:action switch :prekondition (lit) :effect (not (lit))))"],
        right: &["\
(define (domain hall)
  (:predicates (lit))
  (:action switch :precondition (lit) :effect (not (lit))))"],
    },
    Explanation {
        code: "E0109",
        title: "a section or key stands twice",
        meaning: "A section of which there can be one, or a key of an action, stands a second time in the \
         same place.",
        why: "Some readers take the first, some the last, some both. Write one, with everything in it.",
        wrong: &["\
(define (domain hall)
  (:predicates (lit) (locked))
  (:action switch :effect (lit) :effect (not (locked))))"],
        right: &["\
(define (domain hall)
  (:predicates (lit) (locked))
  (:action switch :effect (and (lit) (not (locked)))))"],
    },
    Explanation {
        code: "W0110",
        title: "text behind the end",
        meaning: "Something that is no definition stands behind the end of the domain or the problem, or \
         something behind the `<==` of a hierarchical plan. It is not read.",
        why: "Often a parenthesis too many ended the definition early, or two files were joined.",
        wrong: &["\
(define (domain hall)
  (:predicates (lit)))
(lit)"],
        right: &["\
(define (domain hall)
  (:predicates (lit)))"],
    },
    Explanation {
        code: "W0111",
        title: "an empty plan",
        meaning: "A plan file holds nothing, or nothing but comments.",
        why: "It is the plan without steps, which is right where the goal holds already. More often a \
         planner found nothing or was stopped.",
        wrong: &[
            "\
(define (domain hall)
  (:predicates (lit))
  (:action switch :effect (lit)))",
            "\
(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (lit)))",
            "; nothing found",
        ],
        right: &[
            "\
(define (domain hall)
  (:predicates (lit))
  (:action switch :effect (lit)))",
            "\
(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (lit)))",
            "(switch)",
        ],
    },
    Explanation {
        code: "W0112",
        title: "privacy is not looked at",
        meaning: "The domain is in MA-PDDL and says with `:private` what only one agent knows. That is read, and \
         then known to all: a plan is made for all agents together.",
        why: "A plan that is found may need one agent to know what is private to another.",
        wrong: &["\
(define (domain hall)
  (:requirements :factored-privacy)
  (:predicates (lit) (:private (tired))))"],
        right: &["\
(define (domain hall)
  (:predicates (lit) (tired)))"],
    },
];
