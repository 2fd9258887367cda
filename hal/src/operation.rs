//! What a device does, and how it is stopped.
//!
//! The stop protocol is one rule: **dropping an operation stops the device at once**. There is no `stop`
//! method that could be forgotten, called too late or called for somebody else's operation. A back end that
//! talks to a process or a bus keeps a guard in the future, whose `Drop` sends the stop.
//!
//! An operation does nothing before it is first polled. A device that does one thing at a time makes a second
//! operation wait until the first is over or dropped, because the one who was preempted may hear of it a
//! moment later than the one who preempts.

use std::future::Future;
use std::pin::Pin;

use crate::DeviceError;

/// A device at work. Dropping it stops the device.
pub type Operation<'a, T> = Pin<Box<dyn Future<Output = Result<T, DeviceError>> + Send + 'a>>;
