; What the waiter owes a guest: one order an item, and no order that nobody gave.
(define (domain waiter-safety)
  (:requirements :typing :existential-preconditions :constraints :invariants)
  (:import waiter)
  (:invariant ordered-once
    :parameters (?i - item)
    :says (?i is ordered at most once)
    :constraint (at-most-once (exists (?o - option) (was_chosen_in ?o ?i))))
  (:invariant asked-before
    :parameters (?i - item)
    :says (?i is ordered only after a question)
    :constraint (sometime-before (exists (?o - option) (was_chosen_in ?o ?i))
                  (exists (?t - test ?q - question) (= (question ?t ?i) ?q)))))
