//! PDDL read as graph: dictionary, conditions as patterns, effects as edits.
