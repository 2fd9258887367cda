//! What the wheel keeps between two events.

use super::clock::Clock;
use super::course::Course;
use super::errand::Errand;
use super::failures::Failures;
use super::patience::Patience;
use super::policy::Policy;
use super::sight::Sight;
use crate::Model;
use crate::arrivals::{Arrival, Arrivals};
use crate::decision_support::{Decision, RequestId};
use crate::goal::GoalId;
use crate::goals::Agenda;
use dsr::{AgentId, Edit, Interest, Time};
use high_to_low::{Methods, Moment};
use low_to_high::Perception;
use planner::{FactId, Goal, OperatorId, State};
use std::sync::Arc;
use std::time::Duration;

/// PELEA between two events.
///
/// It decides only with its own writes in view: between asking for a write and seeing it in the graph, it
/// takes in what happens and does nothing. It takes old writes back before it writes anything new, so that no intention
/// is mistaken for the remains of another.
pub struct Wheel {
    pub(super) model: Arc<Model>,
    pub(super) methods: Arc<Methods>,
    pub(super) perception: Arc<Perception>,
    pub(super) policy: Policy,
    /// When the run ends whatever happens, on the clock.
    pub(super) horizon: Option<Time>,
    pub(super) clock: Clock,
    /// The present turn, in the wheel's own time.
    pub(super) moment: Moment,
    /// LowToHigh over the last graph seen; `None` before the first.
    pub(super) sight: Option<Sight>,
    pub(super) hand: Hand,
    /// The facts of the state that are the wheel's own: actions whose start was seen.
    pub(super) under_way: Vec<FactId>,
    /// The question that Decision Support has not answered.
    pub(super) inquiry: Option<Inquiry>,
    /// The mission's goals over time.
    pub(super) agenda: Agenda,
    /// Each goal for the planner.
    pub(super) aims: Vec<Goal>,
    /// Which nodes are objects that have appeared; `None` if none is.
    pub(super) arrivals: Option<Arc<Arrivals>>,
    /// The objects that have appeared and are there.
    pub(super) arrived: Vec<Arrival>,
    /// Those for which the last decision was made.
    pub(super) considered_objects: Vec<Arrival>,
    /// Where the plan under way should be after its last step; `None` if it serves all goals that are wanted.
    pub(super) expected: Option<State>,
    pub(super) failures: Failures,
    pub(super) patience: Patience,
    pub(super) next_request: u64,
    pub(super) plans: u32,
    /// A write was asked for and not yet answered.
    pub(super) unanswered: bool,
    /// A decision that came while its own write was out of view.
    pub(super) deferred: Option<(RequestId, Decision)>,
    pub(super) ended: bool,
    /// The goals that held when it ended well; what was committed before anybody knew may still change that.
    pub(super) accomplished: Vec<GoalId>,
}

/// What is being carried out.
pub(super) enum Hand {
    /// Nothing.
    Empty,
    /// A plan. While a question is open, the plan does not fit: its steps keep their intentions, and no other starts.
    Plan(Course),
    /// Nothing yet: the only plans need a step that has just failed.
    Rest(Rest),
    /// A task of the mission's own, outside any plan.
    Errand(Box<Errand>),
}

/// A wait for the time when a step may be tried again.
pub(super) struct Rest {
    /// The state; when it changes, the wait is over.
    pub(super) from: State,
    pub(super) until: Time,
}

/// A question to Decision Support.
pub(super) struct Inquiry {
    pub(super) id: RequestId,
    /// The state that it was asked for.
    pub(super) from: State,
    pub(super) asked: Time,
    /// What was left of a plan whose current step had ended.
    pub(super) stopped: Vec<OperatorId>,
    /// The decision takes longer than the mission allows.
    pub(super) late: bool,
    /// It was asked because of the goals: the plan under way may still fit.
    pub(super) review: bool,
}

impl Wheel {
    /// A wheel at rest; the first [`Event::Seen`](super::Event::Seen) sets it in motion.
    pub fn new(
        model: Arc<Model>,
        perception: Arc<Perception>,
        methods: Arc<Methods>,
        policy: Policy,
    ) -> Self {
        let failures = Failures::new(policy.attempts);
        let patience = Patience::new(policy.bounds);
        let agenda = Agenda::new(model.goals());
        let aims = (0..).map(GoalId).zip(model.goals()).map(|(id, _)| model.goal(&[id])).collect();
        Self {
            model,
            methods,
            perception,
            policy,
            horizon: None,
            clock: Clock::default(),
            moment: Moment::at(Time(0)),
            sight: None,
            hand: Hand::Empty,
            under_way: Vec::new(),
            inquiry: None,
            agenda,
            aims,
            arrivals: None,
            arrived: Vec::new(),
            considered_objects: Vec::new(),
            expected: None,
            failures,
            patience,
            next_request: 0,
            plans: 0,
            unanswered: false,
            deferred: None,
            ended: false,
            accomplished: Vec::new(),
        }
    }

    /// The same wheel, for a run that ends at `horizon` whatever happens. Without one it calls until a human comes.
    #[must_use]
    pub fn until(mut self, horizon: Time) -> Self {
        self.horizon = Some(horizon);
        self
    }

    /// The same wheel, for a world in which objects may appear.
    #[must_use]
    pub fn with_arrivals(mut self, arrivals: Arc<Arrivals>) -> Self {
        self.arrivals = Some(arrivals);
        self
    }

    /// The same wheel, for a clock on which it can stand still: it asks to be woken at least every `pulse` while it waits
    /// for any time, and takes a much later turn for a stop. A simulated clock waits for the wheel and needs none.
    #[must_use]
    pub fn with_pulse(mut self, pulse: Duration) -> Self {
        self.clock.pulse = Some(pulse);
        self
    }

    /// Whether it has ended. A wheel whose goal holds no longer goes on.
    pub fn has_ended(&self) -> bool {
        self.ended
    }

    /// The model it plans with; Decision Support needs it.
    pub fn model(&self) -> &Arc<Model> {
        &self.model
    }

    /// The part of the graph that it reads as this writer: the tokens of perception and of the methods, and its own
    /// commits.
    pub fn interest(&self, writer: AgentId) -> Interest {
        let mut interest = Interest::default();
        interest.add_tokens(&self.perception.mentions());
        interest.add_tokens(&self.methods.mentions());
        interest.follow_commits(writer);
        interest
    }

    /// What takes back all that it intends now, if it is gone: the edits of the reflex that guards its intentions.
    pub fn withdrawal(&self) -> Vec<Edit> {
        match &self.hand {
            Hand::Plan(course) => course.withdrawal(&self.methods),
            Hand::Errand(errand) => errand.withdrawal(&self.methods),
            Hand::Empty | Hand::Rest(_) => Vec::new(),
        }
    }

    /// Takes what is being carried out, to be put back or replaced.
    pub(super) fn take_hand(&mut self) -> Hand {
        std::mem::replace(&mut self.hand, Hand::Empty)
    }
}

impl Hand {
    /// What is left of a plan, and its steps that are being carried out.
    pub(super) fn left(&self) -> (Vec<OperatorId>, Vec<OperatorId>) {
        let Self::Plan(course) = self else { return (Vec::new(), Vec::new()) };
        (course.left(), course.running().into_iter().map(|step| course.operator(step)).collect())
    }
}
