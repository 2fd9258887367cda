//! The Deep State Representation: one typed, versioned graph that agents share.
