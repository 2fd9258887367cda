//! Operations of devices, and how they are stopped.
//!
//! The stop protocol is one rule: **dropping an operation stops the device at once**. There is no `stop` method that a
//! caller could forget, call too late or call for another caller's operation. A back end that talks to a process or a
//! bus keeps a guard in the future; the guard's `Drop` sends the stop.
//!
//! An operation does nothing before it is first polled. A device that does one thing at a time makes a second operation
//! wait until the first is finished or dropped, because a preempted caller may drop its operation a moment after the
//! preempting caller has started.

use std::future::Future;
use std::pin::Pin;

use crate::DeviceError;

/// A device at work. Dropping it stops the device.
pub type Operation<'a, T> = Pin<Box<dyn Future<Output = Result<T, DeviceError>> + Send + 'a>>;
