(define (domain hall)
  (:requirements :typing :durative-actions :hierarchy :fluents :derived-predicates)
  (:types lamp room)
  (:predicates (lit ?x - lamp) (bright ?r - room) (in ?x - lamp ?r - room))
  (:functions (time-of ?r - room))
  (:task brighten :parameters (?r - room))
  (:action switch :parameters (?x - lamp ?y - room) :effect (lit ?x))
  (:durative-action wait
    :parameters (?x - lamp ?r - room ?q - room)
    :duration (= ?duration (time-of ?r))
    :effect (at end (lit ?x)))
  ; The head of an axiom names its parameters, and so does the task of a method.
  (:derived (bright ?r - room) (exists (?x - lamp) (lit ?x)))
  (:method by-hand
    :parameters (?r - room ?x - lamp ?other - lamp)
    :task (brighten ?r)
    :ordered-subtasks (and (switch ?x ?r))))
