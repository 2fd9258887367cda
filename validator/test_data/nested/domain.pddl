(define (domain ward)
  (:requirements :adl :typing)
  (:types nurse doctor - staff patient - object)
  (:predicates (on-duty ?s - staff) (seen ?p - patient ?s - staff) (allergic ?p - patient)
               (treated ?p - patient)
               (discharged ?p - patient))
  (:action see
    :parameters (?s - (either nurse doctor) ?p - patient)
    :precondition (on-duty ?s)
    :effect (seen ?p ?s))
  (:action treat
    :parameters (?d - doctor ?p - patient)
    :precondition (and (seen ?p ?d) (imply (allergic ?p) (exists (?n - nurse) (seen ?p ?n))))
    :effect (treated ?p))
  (:action hand-over
    :parameters (?from ?to - staff)
    :precondition (and (on-duty ?from) (not (on-duty ?to)) (not (= ?from ?to)))
    :effect (and (on-duty ?to) (not (on-duty ?from))))
  (:action discharge
    :parameters (?p - patient)
    :precondition (and (treated ?p) (forall (?s - staff) (imply (on-duty ?s) (seen ?p ?s))))
    :effect (discharged ?p)))
