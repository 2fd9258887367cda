//! E05: preferences, constraints, metrics.

use super::Explanation;

pub(super) const EXPLANATIONS: &[Explanation] = &[
    Explanation {
        code: "E0506",
        title: "a misplaced preference",
        meaning: "`(preference …)` stands below `or`, `not`, `when` or another preference, or in a condition \
         that has none: an axiom's, a method's, an effect's.",
        why: "A plan is judged by the preferences that it violates, so each must be something on its own that \
         holds or does not. They stand at the top of a goal, a precondition, a condition of a durative \
         action or a constraint, below `and` and `forall` only.",
        wrong: &["\
(define (domain hall)
  (:requirements :adl :preferences)
  (:predicates (lit) (quiet))
  (:action read
    :precondition (or (lit) (preference silence (quiet)))
    :effect (not (quiet))))"],
        right: &["\
(define (domain hall)
  (:requirements :adl :preferences)
  (:predicates (lit) (quiet))
  (:action read
    :precondition (and (lit) (preference silence (quiet)))
    :effect (not (quiet))))"],
    },
    Explanation {
        code: "E0507",
        title: "a constraint in a condition",
        meaning: "A modal operator such as `always` or `sometime` stands in a precondition, a goal or another \
         condition on one state.",
        why: "What it says is about all states that a plan goes through: it belongs into the `:constraints` of \
         the problem or the domain.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :constraints)
  (:predicates (lit)))",
            "\
(define (problem evening)
  (:domain hall)
  (:init (lit))
  (:goal (always (lit))))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :constraints)
  (:predicates (lit)))",
            "\
(define (problem evening)
  (:domain hall)
  (:init (lit))
  (:goal (lit))
  (:constraints (always (lit))))",
        ],
    },
    Explanation {
        code: "E0508",
        title: "a condition without its states",
        meaning: "`:constraints` hold a condition on one state without a modal operator around it.",
        why: "It does not say in which states of the plan it must hold: in all (`always`), in some \
         (`sometime`), in the last one (`at end`).",
        wrong: &["\
(define (domain hall)
  (:requirements :constraints)
  (:predicates (lit))
  (:constraints (lit)))"],
        right: &["\
(define (domain hall)
  (:requirements :constraints)
  (:predicates (lit))
  (:constraints (always (lit))))"],
    },
    Explanation {
        code: "E0509",
        title: "a word without a meaning here",
        meaning: "`total-time` or `is-violated` stands outside of a metric, or `#t` outside of what a process or a \
         durative action changes continuously.",
        why: "The first two are about a whole plan, which is only there once it is finished; `#t` is the time that \
         something has been going on.",
        wrong: &["\
(define (domain hall)
  (:requirements :numeric-fluents)
  (:predicates (lit))
  (:action switch
    :precondition (< (total-time) 5)
    :effect (lit)))"],
        right: &["\
(define (domain hall)
  (:requirements :numeric-fluents)
  (:predicates (lit))
  (:functions (clock))
  (:action switch
    :precondition (< (clock) 5)
    :effect (lit)))"],
    },
    Explanation {
        code: "E0510",
        title: "a change that is not linear in `#t`",
        meaning: "The change of a continuous effect is not a rate times `#t`.",
        why: "`#t` is the time since the process or action began; what multiplies it is by how much the fluent \
         changes in a second. That rate may itself depend on fluents that change.",
        wrong: &["\
(define (domain hall)
  (:requirements :time :fluents)
  (:functions (heat))
  (:process burn
    :parameters ()
    :effect (increase (heat) (* #t #t))))"],
        right: &["\
(define (domain hall)
  (:requirements :time :fluents)
  (:functions (heat) (speed))
  (:process speed
    :parameters ()
    :effect (increase (speed) (* #t 2)))
  (:process burn
    :parameters ()
    :effect (increase (heat) (* #t (speed)))))"],
    },
];
