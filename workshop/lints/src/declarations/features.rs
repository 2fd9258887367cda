//! Which parts of the language a file uses, and which requirements announce them.
//!
//! Read from the text, not from the model: a model may say the same in another way (`(p (f ?x))` becomes an
//! `exists`) than the author has. Where standards differ, the gentler reading counts: `(not (= ?x ?y))` needs
//! `:equality` alone (in `:constraints` of HDDL nothing at all), although some read `:negative-preconditions` into it.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, §A; Kovacs, "BNF definition of PDDL 3.1", 2011; Höller et al., "HDDL",
//! AAAI 2020.

use pddl::model::{AssignOperator, FunctionValue, Requirement, Requirements};
use pddl::syntax::{Node, NodeKind};
use pddl::{FileKind, Span};

use crate::text;
use crate::view::{DomainView, ProblemView, is_here};
use analysis::walk::Part;

/// A part of the language where it is used first.
#[derive(Clone, Debug)]
pub(super) struct Need {
    /// What announces it.
    pub(super) requirement: Requirement,
    /// Another one that does, in this place.
    or: Option<Requirement>,
    pub(super) span: Span,
    /// The subject of a sentence.
    pub(super) what: &'static str,
}

/// Whether a flag announces what is needed.
pub(super) fn grants(flag: Requirement, need: &Need) -> bool {
    use Requirement as R;
    let aggregates: &[R] = match need.requirement {
        R::Typing
        | R::NegativePreconditions
        | R::DisjunctivePreconditions
        | R::Equality
        | R::ConditionalEffects => &[R::Adl],
        R::ExistentialPreconditions | R::UniversalPreconditions => &[R::Adl, R::QuantifiedPreconditions],
        R::NumericFluents | R::ObjectFluents => &[R::Fluents],
        R::DurativeActions => &[R::TimedInitialLiterals, R::ContinuousEffects, R::DurationInequalities],
        // The duration of a rule is a bound for its skill, and always an inequality.
        R::DurationInequalities => &[R::AgentRules],
        R::TimedInitialFluents => &[R::TimedInitialLiterals],
        _ => &[],
    };
    flag == need.requirement || Some(flag) == need.or || aggregates.contains(&flag)
}

/// Whether one of the declared flags announces it.
pub(super) fn is_granted(need: &Need, declared: &Requirements) -> bool {
    declared.0.iter().any(|&flag| grants(flag, need))
}

/// Collects needs, the first of each kind.
#[derive(Default)]
struct Needs(Vec<Need>);

impl Needs {
    fn add(&mut self, requirement: Requirement, span: Span, what: &'static str) {
        self.add_or(requirement, None, span, what);
    }

    fn add_or(&mut self, requirement: Requirement, or: Option<Requirement>, span: Span, what: &'static str) {
        if self.0.iter().all(|n| n.requirement != requirement || n.or != or) {
            self.0.push(Need { requirement, or, span, what });
        }
    }

    fn condition(&mut self, node: Node<'_>) {
        use Requirement as R;
        let at = text::first_word(node);
        let mut skip = 1;
        match () {
            () if node.is_headed("or") => self.add(R::DisjunctivePreconditions, at, "`or`"),
            () if node.is_headed("imply") => self.add(R::DisjunctivePreconditions, at, "`imply`"),
            () if node.is_headed("not") => self.negation(node),
            () if node.is_headed("=") => {
                let is_term = |n: Node<'_>| matches!(n.kind(), NodeKind::Name | NodeKind::Variable);
                if node.children().skip(1).all(|n| is_term(n) && !n.is("?duration")) {
                    self.add(R::Equality, at, "`=` between objects");
                }
            }
            () if node.is_headed("exists") => {
                self.add(R::ExistentialPreconditions, at, "`exists`");
                skip = 2;
            }
            () if node.is_headed("forall") => {
                self.add(R::UniversalPreconditions, at, "`forall` in a condition");
                skip = 2;
            }
            () if node.is_headed("preference") => self.add(R::Preferences, at, "`preference`"),
            () => {}
        }
        node.children().skip(skip).filter(|child| child.is_list()).for_each(|child| self.condition(child));
    }

    fn negation(&mut self, node: Node<'_>) {
        let Some(inner) = node.children().nth(1) else { return };
        let at = text::first_word(node);
        if inner.is_headed("=") {
            return;
        }
        let compound = ["and", "or", "not", "imply", "exists", "forall"];
        if compound.iter().any(|word| inner.is_headed(word)) {
            let or = Some(Requirement::DisjunctivePreconditions);
            self.add_or(Requirement::NegativePreconditions, or, at, "`not`");
        } else {
            self.add(Requirement::NegativePreconditions, at, "`not` in a condition");
        }
    }

    fn effect(&mut self, node: Node<'_>) {
        let at = text::first_word(node);
        if node.is_headed("when") {
            self.add(Requirement::ConditionalEffects, at, "`when`");
            let mut parts = node.children().skip(1);
            parts.next().into_iter().for_each(|condition| self.condition(condition));
            parts.for_each(|effect| self.effect(effect));
            return;
        }
        if node.is_headed("forall") {
            self.add(Requirement::ConditionalEffects, at, "`forall` in an effect");
        }
        if node.is("#t") {
            self.add(Requirement::ContinuousEffects, node.span(), "`#t`");
        }
        node.children().for_each(|child| self.effect(child));
    }

    fn duration(&mut self, node: Node<'_>) {
        if node.is_headed("<=") || node.is_headed(">=") {
            let at = text::first_word(node);
            self.add(Requirement::DurationInequalities, at, "an inequality of durations");
        }
        node.children().for_each(|child| self.duration(child));
    }

    fn section(&mut self, section: Node<'_>) {
        use Requirement as R;
        let at = text::first_word(section);
        let value = |key: &str| text::value(section, key);
        match () {
            () if section.is_headed(":types") && section.children().nth(1).is_some() => {
                self.add(R::Typing, at, "`:types`");
            }
            () if section.is_headed(":action") => {}
            () if section.is_headed(":durative-action") => {
                self.add(R::DurativeActions, at, "a durative action");
            }
            () if section.is_headed(":derived") => {
                self.add(R::DerivedPredicates, at, "an axiom");
                section.children().skip(2).for_each(|body| self.condition(body));
            }
            () if section.is_headed(":process") => self.add(R::Time, at, "a process"),
            () if section.is_headed(":event") => self.add(R::Time, at, "an event"),
            () if section.is_headed(":task") => self.add(R::Hierarchy, at, "a task"),
            () if section.is_headed(":method") => {
                self.add(R::Hierarchy, at, "a method");
                // `()` and `(and)` say nothing.
                let is_empty =
                    |n: Node<'_>| n.children().nth(1).is_none() && (n.is_headed("and") || n.head().is_none());
                if let Some(precondition) = value(":precondition").filter(|&n| !is_empty(n)) {
                    self.add(R::MethodPreconditions, precondition.span(), "a method's precondition");
                }
            }
            () if section.is_headed(":htn") => self.add(R::Hierarchy, at, "a task network"),
            () if section.is_headed(":constraints") => {
                self.add(R::Constraints, at, "`:constraints`");
                section.children().skip(1).for_each(|body| self.condition(body));
            }
            () if section.is_headed(":goal") => {
                section.children().skip(1).for_each(|body| self.condition(body));
            }
            () => {}
        }
        [value(":precondition"), value(":condition")].into_iter().flatten().for_each(|n| self.condition(n));
        value(":effect").into_iter().for_each(|n| self.effect(n));
        value(":duration").into_iter().for_each(|n| self.duration(n));
    }
}

/// What a domain uses.
pub(super) fn of_domain(view: &DomainView<'_>) -> Vec<Need> {
    let mut needs = Needs::default();
    text::sections(view.tree(), FileKind::Domain).for_each(|section| needs.section(section));
    let hyphen = hyphen(view);
    if view.domain.types.len() > 1 || hyphen.is_some() {
        needs.add(Requirement::Typing, hyphen.unwrap_or_else(elsewhere), "a type");
    }
    functions(view, &mut needs);
    needs.0
}

/// The place of an imported declaration. The file that declares it must also have the requirement.
fn elsewhere() -> Span {
    Span::default()
}

/// Where a predicate or a parameter is written with a type.
fn hyphen(view: &DomainView<'_>) -> Option<Span> {
    let lists = text::sections(view.tree(), FileKind::Domain).flat_map(|section| {
        let parameters = text::value(section, ":parameters");
        let declared = section.is_headed(":predicates").then(|| section.children().skip(1));
        parameters.into_iter().chain(declared.into_iter().flatten())
    });
    lists.flat_map(Node::children).find(|child| child.is("-")).map(Node::span)
}

fn functions(view: &DomainView<'_>, needs: &mut Needs) {
    let domain = view.domain;
    let mut beyond_costs = false;
    for schema in view.schemas() {
        schema.parts(&mut |part| {
            if let Part::Writes(operator, application) = part {
                let name = &domain.functions[application.function].name;
                beyond_costs |= operator != AssignOperator::Increase || &**name != "total-cost";
            }
        });
    }
    let costs = (!beyond_costs).then_some(Requirement::ActionCosts);
    for function in &domain.functions {
        let at = if is_here(function.span) { function.span } else { elsewhere() };
        match function.value {
            FunctionValue::Number => needs.add_or(Requirement::NumericFluents, costs, at, "a function"),
            FunctionValue::Object(_) => needs.add(Requirement::ObjectFluents, at, "a function to objects"),
        }
        if &*function.name == "total-cost" {
            needs.add_or(Requirement::ActionCosts, Some(Requirement::NumericFluents), at, "`total-cost`");
        }
    }
}

/// What a problem uses.
pub(super) fn of_problem(view: &ProblemView<'_, '_>) -> Vec<Need> {
    let mut needs = Needs::default();
    for section in text::sections(view.tree(), FileKind::Problem) {
        needs.section(section);
        if section.is_headed(":init") {
            for fact in section.children().skip(1).filter(|fact| fact.is_headed("at")) {
                let mut parts = fact.children().skip(1);
                if let (Some(time), Some(what)) = (parts.next(), parts.next())
                    && time.kind() == NodeKind::Number
                    && what.is_list()
                {
                    let at = text::first_word(fact);
                    if what.is_headed("=") {
                        needs.add(Requirement::TimedInitialFluents, at, "a timed initial fluent");
                    } else {
                        needs.add(Requirement::TimedInitialLiterals, at, "a timed initial literal");
                    }
                }
            }
        }
    }
    needs.0
}
