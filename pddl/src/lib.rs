//! PDDL and HDDL: lossless syntax, typed model, diagnostics, printer.
