//! Hardware abstraction: one trait per capability, and simulated devices.
