//! The rule runtime and the skills of the reactive agents.
