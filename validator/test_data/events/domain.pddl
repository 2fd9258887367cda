; Events of one time: some leave each other alone, some do not.
(define (domain events)
  (:requirements :strips :typing :negative-preconditions :numeric-fluents :timed-initial-literals
                 :time)
  (:types bell)
  (:predicates (armed ?b - bell) (rung ?b - bell) (rope) (shared ?b - bell) (on) (open) (shut-out))
  (:functions (clock) (count) (limit ?b - bell))

  (:process ticking :parameters () :precondition (on) :effect (increase (clock) (* #t 1)))

  ; Each bell rings by itself, and all rings are counted.
  (:event ring
    :parameters (?b - bell)
    :precondition (and (armed ?b) (>= (clock) (limit ?b)))
    :effect (and (not (armed ?b)) (rung ?b) (increase (count) 1)))

  ; Bells that share a rope: the first takes it.
  (:event pull
    :parameters (?b - bell)
    :precondition (and (shared ?b) (rope) (>= (clock) (limit ?b)))
    :effect (and (not (shared ?b)) (not (rope)) (rung ?b)))

  ; A door that lets through at one time.
  (:event pass
    :parameters ()
    :precondition (and (open) (not (shut-out)) (>= (clock) 5))
    :effect (shut-out))

  (:action start :parameters () :precondition (not (on)) :effect (on))
  (:action mend :parameters () :precondition (not (rope)) :effect (rope))
  (:action stop :parameters () :precondition (on) :effect (not (on))))
