; PDDL 1.2: what the precondition binds
(define (domain crane)
  (:requirements :adl :preferences)
  (:types box place)
  (:predicates (on ?b - box ?p - place) (clear ?b - box) (held ?b - box))
  (:action lift :parameters (?b - box) :vars (?p - place ?q) :precondition (and (on ?b ?p) (clear ?b) (preference first (held ?b))) :effect (and (held ?b) (not (on ?b ?p))))
  (:action rest :parameters () :vars (?b - box) :effect (not (held ?b)))
  (:action wait :parameters () :vars () :precondition () :effect ())
  (:action look :parameters (?b - box) :vars (?p - place) :precondition (on ?b ?p)))
