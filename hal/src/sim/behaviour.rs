//! How the simulated devices behave.

/// How a device behaves.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Behaviour {
    /// As it should.
    #[default]
    Works,
    /// Its operations fail at once.
    Fails,
    /// It reports success and does nothing. A sensor senses nothing.
    Lies,
    /// Its operations neither progress nor end.
    Stalls,
    /// It works, and reports each result some seconds late.
    Slow,
    /// It rejects every request, and is in order.
    Refuses,
    /// Its driver panics.
    Panics,
}
