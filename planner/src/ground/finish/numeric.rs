//! The numeric part of the final task: fluents, comparisons, effects and the metric.

use super::view::View;
use crate::ground::instantiate::{RawOperator, RawTask};
use crate::ground::normalise::{Fluents, STEPS};
use crate::ground::prune::Pruned;
use crate::ids::{FactId, FluentId};
use crate::number::{Expression, Number};
use crate::task::{Fluent, Metric, NumericEffects, Update, changed};
use pddl::model::{GroundApplication, Idx, ObjectId, Objective};

/// The fluents of the task: those in states first, then those that only the metric reads.
pub(crate) struct Chosen {
    pub(crate) fluents: Vec<Fluent>,
    pub(crate) stored: usize,
    numbers: Vec<Option<FluentId>>,
    pub(crate) metric: Option<Metric>,
}

impl Chosen {
    pub(crate) fn of(raw: &RawTask, pruned: &Pruned, fluents: &Fluents) -> Self {
        let mut chosen = Self {
            fluents: Vec::new(),
            stored: 0,
            numbers: vec![None; raw.numbers.keys.len()],
            metric: None,
        };
        let keys = || raw.numbers.keys.iter().enumerate();
        let stored = keys().filter(|&(i, _)| pruned.read[i]);
        let measured = keys().filter(|&(i, _)| pruned.measured[i] && !pruned.read[i]);
        chosen.stored = stored.clone().count();
        let mut steps = None;
        for (i, key) in stored.chain(measured) {
            let id = FluentId::from_index(chosen.fluents.len());
            chosen.numbers[i] = Some(id);
            let arguments = key.1.iter().map(|&o| ObjectId(o)).collect();
            let application = GroundApplication { function: key.0, arguments };
            let is_steps = key.0 == STEPS;
            let initial = if is_steps { Some(Number::ZERO) } else { fluents.initial(key) };
            steps = steps.or(is_steps.then_some(id));
            let sensed = fluents.is_sensed(key.0);
            chosen.fluents.push(Fluent { application, initial, sensed });
        }
        if let Some((objective, expression)) = &raw.metric {
            let expression = chosen.expression(expression);
            chosen.metric = Some(Metric { objective: *objective, expression, steps });
        }
        chosen
    }

    fn fluent(&self, fluent: u32) -> Option<FluentId> {
        self.numbers[fluent as usize]
    }

    /// Maps an expression whose fluents were all kept.
    pub(crate) fn expression(&self, expression: &Expression<u32>) -> Expression<FluentId> {
        expression.map(&mut |&f| self.fluent(f).expect("what is kept reads what is kept"))
    }

    /// The operator's effects on the fluents that were kept.
    pub(super) fn effects(&self, raw: &RawOperator<'_>, view: &View<'_>) -> Option<Box<NumericEffects>> {
        let (mut updates, mut metric) = (Vec::new(), Vec::new());
        for change in raw.numbers {
            let Some(fluent) = self.fluent(change.fluent) else { continue };
            let Some(condition) = view.literals(&change.condition) else { continue };
            let value = change.value.as_ref().map(|value| self.expression(value));
            let update = Update::new(condition, fluent, change.change, value);
            (if fluent.index() < self.stored { &mut updates } else { &mut metric }).push(update);
        }
        let any = !updates.is_empty() || !metric.is_empty();
        any.then(|| {
            Box::new(NumericEffects {
                updates: updates.into(),
                metric: metric.into(),
                ..NumericEffects::default()
            })
        })
    }

    /// The cost that guides the search: what the operator adds to the metric in the initial state,
    /// at least 0. Conditional effects are ignored.
    pub(crate) fn guess(&self, effects: Option<&NumericEffects>) -> f64 {
        let Some(metric) = &self.metric else { return 1.0 };
        let before: Vec<Option<Number>> = self.fluents.iter().map(|f| f.initial).collect();
        let mut after = before.clone();
        let updates = effects.into_iter().flat_map(|e| e.updates.iter().chain(&e.metric));
        for update in updates.filter(|u| u.condition.is_empty()) {
            let value = update.value.as_ref().and_then(|v| v.evaluate(&|f| before[f.index()]).ok());
            let place = &mut after[update.fluent.index()];
            *place = changed(update.change, *place, value);
        }
        if let Some(steps) = metric.steps {
            after[steps.index()] = Some(Number::ONE);
        }
        let value =
            |of: &[Option<Number>]| metric.expression.evaluate(&|f| of[f.index()]).map(Number::to_f64);
        match (value(&before), value(&after)) {
            (Ok(before), Ok(after)) if metric.objective == Objective::Minimize => (after - before).max(0.0),
            (Ok(before), Ok(after)) => (before - after).max(0.0),
            _ => 1.0,
        }
    }
}

/// The kept comparisons with their facts.
pub(super) fn comparisons(
    raw: &RawTask,
    chosen: &Chosen,
    fact: impl Fn(u32) -> Option<FactId>,
) -> Vec<(FactId, crate::number::Relation, Expression<FluentId>)> {
    let kept = raw.numbers.atoms.iter().filter_map(|(atom, c)| Some((fact(*atom)?, c)));
    kept.map(|(fact, c)| (fact, c.relation, chosen.expression(&c.expression))).collect()
}
