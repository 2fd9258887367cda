//! Soft goals as costs of actions.
//!
//! Problem: a plan should reach as many soft goals as are worth their price, and the planner minimises costs only. Idea:
//! a plan first works, then stops, then settles each soft goal: by *collecting* it, which costs nothing and needs it to
//! hold, or by *forgoing* it, which costs its penalty. A plan of the compiled problem that costs least is a plan of the
//! mission with the best sum of costs and penalties. Without a metric each step costs 1, so a penalty is counted in steps.
//! Invariant: the actions of the domain keep their ids; the added ones follow them. Cost: two actions for each soft goal,
//! and one; no action has more parameters than before.
//!
//! Source: Keyder & Geffner, "Soft goals can be compiled away", JAIR 2009.

use pddl::Span;
use pddl::model::{
    Action, ActionId, Application, ArithmeticOperator, AssignOperator, AssignedValue, Atom, Condition,
    ConditionKind, Domain, Effect, EffectKind, Expression, ExpressionKind, Fact, FluentFact, FluentValue,
    Function, FunctionId, FunctionValue, GroundApplication, Idx, Metric, Name, Objective, Predicate,
    PredicateId, Problem, Variables,
};

const SPAN: Span = Span::new(0, 0);

/// The compiled problem.
pub(crate) struct Compilation {
    pub(crate) domain: Domain,
    pub(crate) problem: Problem,
    /// The first action that is not the mission's.
    pub(crate) first: ActionId,
    /// For each soft goal, the action that collects it.
    pub(crate) collects: Vec<ActionId>,
}

/// Compiles soft goals, each a conjunction with its penalty, into a domain and a problem.
pub(crate) fn compile(domain: &Domain, problem: &Problem, soft: &[(Vec<Condition>, f64)]) -> Compilation {
    let (mut domain, mut problem) = (domain.clone(), problem.clone());
    let first = ActionId::from_index(domain.actions.len());
    // No name of a text has a blank.
    let works = predicate(&mut domain, "at work");
    let stopped = predicate(&mut domain, "at rest");
    let penalty = function(&mut domain, "penalties paid");
    for id in domain.actions.ids().collect::<Vec<_>>() {
        let own = domain.actions[id].precondition.clone();
        domain.actions[id].precondition = all(vec![own, atom(works)]);
    }
    let stop = effects(vec![EffectKind::Delete(bare(works)), EffectKind::Add(bare(stopped))]);
    action(&mut domain, "stop working", atom(works), stop);
    let mut goal = vec![problem.goal.clone()];
    let (mut collects, mut before) = (Vec::new(), atom(stopped));
    for (at, (conditions, price)) in soft.iter().enumerate() {
        let settled = predicate(&mut domain, &format!("settled {at}"));
        // In one order: others would be the same plan again.
        let open = all(vec![atom(stopped), before, not(atom(settled))]);
        before = atom(settled);
        let done = || EffectKind::Add(bare(settled));
        let held = all(conditions.iter().cloned().chain([open.clone()]).collect());
        collects.push(action(&mut domain, &format!("collect {at}"), held, effects(vec![done()])));
        let paid = AssignedValue::Number(number(*price));
        let pay = EffectKind::Assign(AssignOperator::Increase, fluent(penalty), paid);
        action(&mut domain, &format!("forgo {at}"), open, effects(vec![done(), pay]));
        goal.push(atom(settled));
    }
    problem.goal = all(goal);
    problem.init.push(Fact { predicate: works, arguments: Vec::new(), span: SPAN });
    problem.fluents.push(FluentFact {
        application: GroundApplication { function: penalty, arguments: Vec::new() },
        value: FluentValue::Number(0.0),
        span: SPAN,
    });
    problem.metric = Some(metric(problem.metric.take(), penalty));
    Compilation { domain, problem, first, collects }
}

/// The mission's metric, or the number of steps, plus the penalties.
fn metric(own: Option<Metric>, penalty: FunctionId) -> Metric {
    let kind = |kind| Expression { kind, span: SPAN };
    let own = match own {
        None => kind(ExpressionKind::TotalTime),
        Some(Metric { objective: Objective::Minimize, expression }) => expression,
        Some(Metric { objective: Objective::Maximize, expression }) => {
            kind(ExpressionKind::Arithmetic(ArithmeticOperator::Subtract, vec![expression]))
        }
    };
    let paid = kind(ExpressionKind::Fluent(fluent(penalty)));
    let sum = kind(ExpressionKind::Arithmetic(ArithmeticOperator::Add, vec![own, paid]));
    Metric { objective: Objective::Minimize, expression: sum }
}

fn predicate(domain: &mut Domain, name: &str) -> PredicateId {
    let (variables, name) = (Variables::default(), Name::new(name));
    domain.predicates.push(Predicate { name, variables, derived: false, span: SPAN })
}

fn function(domain: &mut Domain, name: &str) -> FunctionId {
    let (variables, value) = (Variables::default(), FunctionValue::Number);
    domain.functions.push(Function { name: Name::new(name), variables, value, span: SPAN })
}

fn action(domain: &mut Domain, name: &str, precondition: Condition, effect: Effect) -> ActionId {
    domain.actions.push(Action {
        name: Name::new(name),
        variables: Variables::default(),
        precondition,
        preferences: Vec::new(),
        effect,
        span: SPAN,
        name_span: SPAN,
    })
}

fn bare(predicate: PredicateId) -> Atom {
    Atom { predicate, arguments: Vec::new(), span: SPAN }
}

fn atom(predicate: PredicateId) -> Condition {
    Condition { kind: ConditionKind::Atom(bare(predicate)), span: SPAN }
}

fn not(condition: Condition) -> Condition {
    Condition { kind: ConditionKind::Not(Box::new(condition)), span: SPAN }
}

fn all(parts: Vec<Condition>) -> Condition {
    Condition { kind: ConditionKind::And(parts), span: SPAN }
}

fn effects(kinds: Vec<EffectKind>) -> Effect {
    let parts = kinds.into_iter().map(|kind| Effect { kind, span: SPAN }).collect();
    Effect { kind: EffectKind::And(parts), span: SPAN }
}

fn fluent(function: FunctionId) -> Application {
    Application { function, arguments: Vec::new(), span: SPAN }
}

fn number(value: f64) -> Expression {
    Expression { kind: ExpressionKind::Number(value), span: SPAN }
}
