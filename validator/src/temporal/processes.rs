//! Processes and events: a process acts while its condition holds, an event happens when its condition becomes true.
//!
//! At every instant at which a condition of either can change, and between any two of them, a query finds the
//! processes that act and the events that are due. An event must make its own condition false, or it would happen
//! endlessly; a cascade in which one event happens a hundred times at one time is endless, too. An event or process
//! whose condition holds only just after an instant (`>`, not `>=`) begins at that instant.
//!
//! An event that is due at the time of a happening happens before it, and an event that the happening triggers
//! happens after it. All events that are due in one state read that state. So none of them may change what another
//! reads or changes: the outcome would depend on an order that the domain does not define. The same holds between an
//! event and a timed literal at its time. An event that adds an atom which holds already changes nothing.
//!
//! Source: Fox & Long, "Modelling mixed discrete-continuous domains for planning", JAIR 2006, §4.

use super::active::Active;
use super::flow::{Flow, Running, each_running};
use super::footprint::{Footprint, Reader};
use super::run::{Checked, Run};
use crate::cause::Cause;
use crate::condition::Strictness;
use crate::effect::Changes;
use crate::number::Number;
use crate::reads::each_guard;
use crate::root::Instant;
use crate::scene::{Binding, Clock};
use crate::trace::Diff;
use crate::verdict::Failure;
use pddl::model::{Condition, EventId, ObjectId, ProcessId, Variables};
use rustc_hash::FxHashMap;
use std::ops::ControlFlow;

/// The most times that one event may happen at one time.
const MOST_OFTEN: usize = 100;

/// A process or event with its arguments.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Instance<I> {
    pub(super) id: I,
    pub(super) arguments: Vec<ObjectId>,
}

/// The processes that run and the events that are due at an instant.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Autonomous {
    pub(super) processes: Vec<Instance<ProcessId>>,
    pub(super) events: Vec<Instance<EventId>>,
}

impl Run<'_, '_, '_> {
    /// Whether the domain has processes or events.
    pub(super) fn has_processes_or_events(&self) -> bool {
        !self.prepared.domain.processes.is_empty() || !self.prepared.domain.events.is_empty()
    }

    /// The processes that run and the events that are due in the current state.
    pub(super) fn autonomous(&mut self, at: Number) -> Autonomous {
        Autonomous { processes: self.processes(at), events: self.due(at) }
    }

    /// The processes that run in the current state.
    pub(super) fn processes(&mut self, at: Number) -> Vec<Instance<ProcessId>> {
        let mut found = Vec::new();
        for (id, process) in self.prepared.domain.processes.enumerate() {
            let mut visit = |arguments| found.push(Instance { id, arguments });
            self.instances(&process.variables, &process.precondition, Strictness::Certain, at, &mut visit);
        }
        found.sort();
        found
    }

    /// The events that are due in the current state.
    pub(super) fn due(&mut self, at: Number) -> Vec<Instance<EventId>> {
        let mut found = Vec::new();
        for (id, event) in self.prepared.domain.events.enumerate() {
            let mut visit = |arguments| found.push(Instance { id, arguments });
            self.instances(&event.variables, &event.precondition, Strictness::Certain, at, &mut visit);
        }
        found.sort();
        found
    }

    fn instances(
        &mut self,
        variables: &Variables,
        condition: &Condition,
        strictness: Strictness,
        at: Number,
        visit: &mut dyn FnMut(Vec<ObjectId>),
    ) {
        self.derive_for(condition);
        let scene = self.prepared.scene(self.state, variables, Clock::at(at));
        let mut binding = Binding::new(variables, &[]);
        let parameters: Vec<_> = variables.parameter_ids().collect();
        if parameters.is_empty() {
            if scene.satisfied(condition, true, strictness, &mut binding) {
                visit(Vec::new());
            }
            return;
        }
        let flow =
            scene.each_binding(&parameters, &[(condition, true)], strictness, &mut binding, &mut |binding| {
                visit(parameters.iter().filter_map(|&p| binding.get(p)).collect());
                ControlFlow::Continue(())
            });
        debug_assert!(flow.is_continue());
    }

    /// Adds the instants inside `from..length` at which processes and events may begin or end.
    pub(super) fn critical_of_processes(
        &mut self,
        flow: &Flow,
        from: &Instant,
        length: Number,
        into: &mut Vec<Instant>,
    ) -> Checked {
        let domain = self.prepared.domain;
        let processes = domain.processes.iter().map(|p| (&p.variables, &p.precondition));
        let events = domain.events.iter().map(|e| (&e.variables, &e.precondition));
        // While the changing fluents are undefined, every comparison that reads them is possible,
        // so all processes and events that may ever begin are found.
        flow.forget(self.state);
        let mut candidates = Vec::new();
        for (variables, condition) in processes.chain(events) {
            self.instances(variables, condition, Strictness::Possible, self.now, &mut |arguments| {
                candidates.push((variables, condition, arguments));
            });
        }
        self.set(flow, from)?;
        for (variables, condition, arguments) in candidates {
            let scene = self.prepared.scene(self.state, variables, Clock::at(self.now));
            flow.critical(condition, scene, &mut Binding::new(variables, &arguments), length, into);
        }
        Ok(())
    }

    /// Executes the due events and the events that they trigger.
    pub(super) fn events(&mut self, mut due: Vec<Instance<EventId>>, mut diff: Option<&mut Diff>) -> Checked {
        let mut happened: FxHashMap<Instance<EventId>, usize> = FxHashMap::default();
        while !due.is_empty() {
            let mut changes = Vec::with_capacity(due.len());
            let mut together: Vec<(Cause, Footprint)> = Vec::new();
            for instance in &due {
                let event = &self.prepared.domain.events[instance.id];
                let at = Cause::Event(instance.id);
                let often = happened.entry(instance.clone()).or_insert(0);
                *often += 1;
                if *often > MOST_OFTEN {
                    return Err(self.endless(instance));
                }
                each_guard(&event.effect, &mut |guard, _| self.derive_for(guard));
                let scene = self.prepared.scene(self.state, &event.variables, Clock::at(self.now));
                let mut own = Changes::default();
                let mut binding = Binding::new(&event.variables, &instance.arguments);
                own.collect(scene, &event.effect, &mut binding)
                    .map_err(|fault| Box::new(Failure::Effect { at, fault }))?;
                if due.len() > 1 || self.timed_is_next {
                    let mut footprint = Footprint::default();
                    let reader =
                        Reader { scene, strata: &self.prepared.strata, dependencies: &self.dependencies };
                    reader.condition(&event.precondition, &mut binding, &mut footprint);
                    reader.effect(&event.effect, &mut binding, &mut footprint);
                    footprint.changes(&own);
                    footprint.only_changes_of(self.state);
                    if let Some((first, over)) = together
                        .iter()
                        .find_map(|(first, other)| Some((*first, other.interference(&footprint)?)))
                    {
                        return Err(Box::new(Failure::Interference { first, second: at, over }));
                    }
                    together.push((at, footprint));
                }
                changes.push((at, own));
            }
            if self.timed_is_next {
                self.beside_timed.append(&mut together);
            }
            for (at, own) in changes {
                self.causes.push(at);
                own.each_write(|_, _| self.wrote_fluents = true);
                let moment = self.moment();
                self.watch.changed(&own);
                own.apply(self.state, moment, diff.as_deref_mut())
                    .map_err(|fault| Box::new(Failure::Effect { at, fault }))?;
            }
            let next = self.due(self.now);
            if let Some(instance) = next.iter().find(|instance| due.contains(instance)) {
                return Err(self.endless(instance));
            }
            due = next;
        }
        Ok(())
    }

    fn endless(&self, event: &Instance<EventId>) -> Box<Failure> {
        Box::new(Failure::EndlessEvents { time: self.now, event: event.id })
    }

    /// All continuous effects that run now.
    pub(super) fn running(&self, processes: &[Instance<ProcessId>]) -> Checked<Vec<Running<'_>>> {
        let mut running = Vec::new();
        for Active { action, binding, duration, .. } in self.active.continuous() {
            let clock = Clock { duration: Some(*duration), ..Clock::at(self.now) };
            let scene = self.prepared.scene(self.state, &action.variables, clock);
            for effect in &action.continuous {
                each_running(scene, effect, binding.clone(), &mut running).map_err(|f| self.change(f))?;
            }
        }
        for Instance { id, arguments } in processes {
            let process = &self.prepared.domain.processes[*id];
            let scene = self.prepared.scene(self.state, &process.variables, Clock::at(self.now));
            let binding = Binding::new(&process.variables, arguments);
            for effect in &process.effects {
                each_running(scene, effect, binding.clone(), &mut running).map_err(|f| self.change(f))?;
            }
        }
        Ok(running)
    }
}
