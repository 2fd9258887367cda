//! Plan validation by the semantics of PDDL, on its own evaluator.
