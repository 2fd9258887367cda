//! The search: can the grammar yield the steps of the plan, and by which decomposition?
//!
//! Idea: consume the steps from the left. In each [`Situation`], the next step comes from a node whose predecessors
//! can all vanish, that is, yield no step. That node becomes the focus and is expanded, rule by rule, down to the
//! action. Decisions are made as late as possible: a task is expanded when its first step comes, and a node that
//! yields no step vanishes when a successor begins, as early as it can, which never hurts. Situations that were seen
//! are not entered again. A situation that cannot yield exactly the rest of the plan is pruned: too few or too many
//! steps, an action that no node can yield, or one that the nodes must yield more often than it occurs.
//!
//! The search is complete and terminates. If a task is its own descendant and no node beside it yields a step, the
//! cycle can be left out. So on the way down from a focus whose siblings may vanish, either all of them do, and then
//! no task occurs twice, or one of them must yield a step; and the number of steps is finite.
//!
//! Cost: exponential in the worst case, as the problem is NP-complete, and bounded; reaching the bound is no answer.
//!
//! Source: Höller, Behnke, Bercher & Biundo, "Plan and goal recognition as HTN planning", ICTAI 2018, and "HTN
//! planning as heuristic progression search", JAIR 2020; Behnke, Höller & Biundo, "On the complexity of HTN plan
//! verification", ICAPS 2015, and "This is a solution! (… but is it though?)", ICAPS 2017.

use super::grammar::{Grammar, RuleId, Slot, Symbol, SymbolId};
use super::outlook::Outlook;
use super::situation::{Duty, NodeId, Part, Pending, Situation};
use budget::{Interrupted, Meter};
use rustc_hash::FxHashSet;

/// What happened to a node.
#[derive(Clone, Copy, Debug)]
pub(super) enum Event {
    /// It was expanded by a rule, whose nodes are numbered from `first`.
    Applied { node: NodeId, rule: RuleId, first: u32 },
    /// It began at `start` and yielded no step.
    Vanished { node: NodeId, symbol: SymbolId, start: Slot },
    /// It yielded this step.
    Taken { node: NodeId, step: u32 },
}

#[derive(Debug)]
pub(super) enum Answer {
    /// The events of a decomposition, in order.
    Found(Vec<Event>),
    /// No decomposition yields the steps.
    None,
    /// The budget is exhausted.
    Limit,
}

/// How far ahead of the next step the search looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ahead {
    /// To the end of the plan: prunes situations that cannot yield the rest.
    Far,
    /// Only to the steps that a decomposition still needs, to find the longest prefix of the plan that a decomposition
    /// begins with.
    Near,
}

/// How a situation was entered: from which one, and by which events.
struct Entered {
    from: Option<u32>,
    events: Box<[Event]>,
}

pub(super) struct Search<'g> {
    grammar: &'g Grammar,
    outlook: &'g Outlook,
    /// By action: the steps with this action.
    places: Vec<Vec<u32>>,
    /// By step: the set of actions from this step on.
    rest: Vec<Box<[u64]>>,
    /// By action: how often it must occur. Scratch.
    demand: Vec<u32>,
    seen: FxHashSet<Box<[u32]>>,
    story: Vec<Entered>,
    open: Vec<(Situation, u32)>,
    ahead: Ahead,
    /// The length of the longest prefix of the plan that a decomposition begins with.
    pub(super) explained: u32,
}

impl<'g> Search<'g> {
    pub(super) fn new(
        grammar: &'g Grammar,
        outlook: &'g Outlook,
        ahead: Ahead,
        meter: &Meter<'_>,
    ) -> Result<Self, Interrupted> {
        let words = grammar.actions.div_ceil(64);
        meter.spend((grammar.steps.len() + 1) * words)?;
        let mut places = vec![Vec::new(); grammar.actions];
        let mut rest = vec![vec![0u64; words].into_boxed_slice()];
        for (step, &symbol) in grammar.steps.iter().enumerate().rev() {
            let mut coming = rest[rest.len() - 1].clone();
            if let Symbol::Action(action) = grammar.symbols[symbol] {
                places[action as usize].push(u32::try_from(step).unwrap_or(u32::MAX));
                coming[action as usize / 64] |= 1 << (action % 64);
            }
            rest.push(coming);
        }
        rest.reverse();
        places.iter_mut().for_each(|places: &mut Vec<u32>| places.reverse());
        Ok(Self {
            grammar,
            outlook,
            demand: vec![0; places.len()],
            places,
            rest,
            seen: FxHashSet::default(),
            story: Vec::new(),
            open: Vec::new(),
            ahead,
            explained: 0,
        })
    }

    pub(super) fn run(&mut self, meter: &Meter<'_>) -> Answer {
        match self.search(meter) {
            Ok(Some(events)) => Answer::Found(events),
            Ok(None) => Answer::None,
            Err(_) => Answer::Limit,
        }
    }

    fn search(&mut self, meter: &Meter<'_>) -> Result<Option<Vec<Event>>, Interrupted> {
        let root = Pending {
            symbol: self.grammar.root,
            duty: Duty::Open,
            start: 0,
            before: Vec::new(),
            node: NodeId(0),
        };
        let start = Situation { pending: vec![root], next: 1, ..Situation::default() };
        self.enter(start, None, Vec::new(), meter)?;
        while let Some((situation, place)) = self.open.pop() {
            self.explained = self.explained.max(situation.step);
            let known = self.open.len();
            match situation.focus {
                Some(focus) => self.expand(&situation, focus, place, meter)?,
                None if situation.step as usize == self.grammar.steps.len() => {
                    if let Some(events) = self.vanish_all(&situation) {
                        return Ok(Some(self.told(place, events)));
                    }
                }
                None => self.focus(&situation, place, meter)?,
            }
            // The stack returns the last situation first; the first one should be explored first.
            self.open[known..].reverse();
        }
        Ok(None)
    }

    /// The events on the way to a situation, followed by `events`.
    fn told(&self, place: u32, events: Vec<Event>) -> Vec<Event> {
        let mut chapters = vec![events.into_boxed_slice()];
        let mut next = Some(place);
        while let Some(entered) = next.and_then(|place| self.story.get(place as usize)) {
            chapters.push(entered.events.clone());
            next = entered.from;
        }
        chapters.into_iter().rev().flat_map(<[Event]>::into_vec).collect()
    }

    /// Adds a situation to the open ones, unless it was seen or cannot yield the rest of the plan.
    fn enter(
        &mut self,
        mut situation: Situation,
        from: Option<u32>,
        mut events: Vec<Event>,
        meter: &Meter<'_>,
    ) -> Result<(), Interrupted> {
        meter.spend(4 + 2 * situation.pending.len())?;
        if !self.settle(&mut situation, &mut events) || !self.may_be_the_rest(&situation, meter)? {
            return Ok(());
        }
        if self.seen.insert(self.key(&situation)) {
            let place = u32::try_from(self.story.len()).unwrap_or(u32::MAX);
            self.story.push(Entered { from, events: events.into() });
            self.open.push((situation, place));
        }
        Ok(())
    }

    /// Lets every node vanish that must and has no predecessor. Returns false if one of them cannot vanish.
    fn settle(&self, situation: &mut Situation, events: &mut Vec<Event>) -> bool {
        loop {
            let mut ends = vec![None; situation.pending.len()];
            let mut any = false;
            for (end, pending) in ends.iter_mut().zip(&situation.pending) {
                if pending.duty == Duty::Nothing && pending.before.is_empty() {
                    let Some(vanishing) = self.outlook.vanish(pending.symbol, pending.start) else {
                        return false;
                    };
                    *end = Some(vanishing.end);
                    any = true;
                    events.push(vanished(pending, pending.start));
                }
            }
            if !any {
                return true;
            }
            situation.without(&ends);
        }
    }

    /// Everything on which the future of a situation depends.
    fn key(&self, situation: &Situation) -> Box<[u32]> {
        let mut key = Vec::with_capacity(2 + 4 * situation.pending.len());
        key.push(situation.step);
        key.push(situation.focus.map_or(0, |focus| focus + 1));
        for pending in &situation.pending {
            // The start of a node matters only to guards, and to nodes that pass it on to guards.
            let matters = self.outlook.guarded[pending.symbol]
                || self.outlook.guarded[self.grammar.root] && self.outlook.least[pending.symbol] == 0;
            let start = pending.start.saturating_sub(if matters { 0 } else { situation.step });
            let duty = match pending.duty {
                Duty::Open => 0,
                Duty::Something => 1,
                Duty::Nothing => 2,
            };
            key.extend([
                pending.symbol.0,
                start,
                duty,
                u32::try_from(pending.before.len()).unwrap_or(u32::MAX),
            ]);
            key.extend(&pending.before);
        }
        key.into()
    }

    fn may_be_the_rest(&mut self, situation: &Situation, meter: &Meter<'_>) -> Result<bool, Interrupted> {
        meter.spend(self.rest[0].len() * situation.pending.len() / 4)?;
        let mut touched = Vec::new();
        let so = self.is_enough(situation, &mut touched);
        for action in touched {
            self.demand[action] = 0;
        }
        Ok(so)
    }

    fn is_enough(&mut self, situation: &Situation, touched: &mut Vec<usize>) -> bool {
        let step = situation.step;
        let coming = &self.rest[step as usize];
        let left = self.grammar.steps.len() - step as usize;
        let mut least = 0u32;
        let mut may = vec![0u64; coming.len()];
        for (place, pending) in (0u32..).zip(&situation.pending) {
            if pending.duty == Duty::Nothing {
                continue;
            }
            let symbol = pending.symbol;
            let something = pending.duty == Duty::Something || situation.focus == Some(place);
            let own = self.outlook.least[symbol].max(u32::from(something));
            least = least.saturating_add(own);
            if least as usize > left {
                return false;
            }
            may.iter_mut().zip(self.outlook.may.get(symbol)).for_each(|(all, one)| *all |= one);
            if own == 0 {
                continue;
            }
            for (word, &bits) in self.outlook.must.get(symbol).iter().enumerate() {
                let mut bits = bits;
                while bits != 0 {
                    let action = word * 64 + bits.trailing_zeros() as usize;
                    bits &= bits - 1;
                    let Some(places) = self.places.get(action) else { continue };
                    touched.push(action);
                    self.demand[action] += 1;
                    let gone = places.partition_point(|&place| place < step);
                    if self.demand[action] as usize > places.len() - gone {
                        return false;
                    }
                }
            }
        }
        self.ahead == Ahead::Near || coming.iter().zip(may).all(|(coming, may)| coming & !may == 0)
    }

    /// The start and the end of each node if all nodes vanish as early as possible; `None` where this is impossible.
    fn vanishing(&self, situation: &Situation) -> Vec<(Option<Slot>, Option<Slot>)> {
        let mut moments: Vec<(Option<Slot>, Option<Slot>)> = Vec::with_capacity(situation.pending.len());
        for pending in &situation.pending {
            let start = pending.before.iter().try_fold(pending.start, |start, &before| {
                moments[before as usize].1.map(|end| start.max(end))
            });
            let end = start.filter(|_| pending.duty != Duty::Something);
            let end = end.and_then(|start| self.outlook.vanish(pending.symbol, start)).map(|v| v.end);
            moments.push((start, end));
        }
        moments
    }

    /// Lets all remaining nodes vanish; `None` if one cannot.
    fn vanish_all(&self, situation: &Situation) -> Option<Vec<Event>> {
        let moments = self.vanishing(situation);
        let mut events = Vec::with_capacity(moments.len());
        for (pending, (start, end)) in situation.pending.iter().zip(moments) {
            end?;
            events.push(vanished(pending, start?));
        }
        Some(events)
    }

    /// Whether a symbol can yield the step as its first.
    fn begins(&self, symbol: SymbolId, step: u32) -> bool {
        match self.grammar.symbols[self.grammar.steps[step as usize]] {
            Symbol::Action(action) => self.outlook.first.has(symbol, action),
            Symbol::Root | Symbol::Task { .. } | Symbol::Guard(_) => false,
        }
    }

    /// Chooses the node that yields the next step.
    fn focus(&mut self, situation: &Situation, place: u32, meter: &Meter<'_>) -> Result<(), Interrupted> {
        let moments = self.vanishing(situation);
        let mut tried: Vec<usize> = Vec::new();
        for (index, pending) in situation.pending.iter().enumerate() {
            let Some(start) = moments[index].0.filter(|&start| start <= situation.step) else { continue };
            if pending.duty == Duty::Nothing || !self.begins(pending.symbol, situation.step) {
                continue;
            }
            if tried.iter().any(|&other| twins(situation, other, index)) {
                continue;
            }
            tried.push(index);
            let mut events = Vec::new();
            let mut ends = vec![None; situation.pending.len()];
            let mut waiting = pending.before.clone();
            while let Some(before) = waiting.pop() {
                let before = before as usize;
                if ends[before].is_none()
                    && let (Some(start), Some(end)) = moments[before]
                {
                    ends[before] = Some(end);
                    events.push(vanished(&situation.pending[before], start));
                    waiting.extend(&situation.pending[before].before);
                }
            }
            let mut next = situation.clone();
            next.pending[index].start = start;
            next.focus = u32::try_from(index).ok();
            next.trail.clear();
            next.without(&ends);
            self.enter(next, Some(place), events, meter)?;
        }
        Ok(())
    }

    /// Consumes the step if the focus is an action, or expands the focus by each of its rules.
    fn expand(
        &mut self,
        situation: &Situation,
        focus: u32,
        place: u32,
        meter: &Meter<'_>,
    ) -> Result<(), Interrupted> {
        let grammar = self.grammar;
        let pending = &situation.pending[focus as usize];
        if matches!(grammar.symbols[pending.symbol], Symbol::Action(_)) {
            let step = situation.step;
            let mut next = situation.clone();
            next.step += 1;
            next.focus = None;
            next.trail.clear();
            let mut ends = vec![None; next.pending.len()];
            ends[focus as usize] = Some(next.step);
            next.without(&ends);
            return self.enter(next, Some(place), vec![Event::Taken { node: pending.node, step }], meter);
        }
        for &id in grammar.ways[pending.symbol].iter().filter(|id| self.outlook.alive[**id]) {
            let rule = &grammar.rules[id];
            meter.spend(1 + rule.nodes.len())?;
            // The start and the end of each node if all its predecessors vanish, as in a situation.
            let mut moments: Vec<(Option<Slot>, Option<Slot>)> = Vec::with_capacity(rule.nodes.len());
            for (&node, before) in rule.nodes.iter().zip(&rule.before) {
                let start = before
                    .iter()
                    .try_fold(pending.start, |start, &b| moments[b as usize].1.map(|end| start.max(end)));
                let end = start.and_then(|start| self.outlook.vanish(node, start)).map(|v| v.end);
                moments.push((start, end));
            }
            for next in 0..rule.nodes.len() {
                let begins = moments[next].0.is_some_and(|start| start <= situation.step);
                if begins && self.begins(rule.nodes[next], situation.step) {
                    self.descend(situation, focus, place, id, next, &moments, meter)?;
                }
            }
        }
        Ok(())
    }

    /// Expands the focus by a rule whose node `next` yields the next step.
    #[expect(clippy::too_many_arguments, reason = "one step of one search")]
    fn descend(
        &mut self,
        situation: &Situation,
        focus: u32,
        place: u32,
        id: RuleId,
        next: usize,
        moments: &[(Option<Slot>, Option<Slot>)],
        meter: &Meter<'_>,
    ) -> Result<(), Interrupted> {
        let rule = &self.grammar.rules[id];
        let pending = &situation.pending[focus as usize];
        let first = situation.next;
        let mut events = vec![Event::Applied { node: pending.node, rule: id, first }];
        let mut parts = vec![Part::Left(Duty::Open); rule.nodes.len()];
        let mut waiting = rule.before[next].clone();
        while let Some(before) = waiting.pop() {
            let before = before as usize;
            if let (Part::Left(_), (Some(start), Some(end))) = (parts[before], moments[before]) {
                parts[before] = Part::Gone(end);
                let node = NodeId(first + u32::try_from(before).unwrap_or(u32::MAX));
                events.push(Event::Vanished { node, symbol: rule.nodes[before], start });
                waiting.extend(&rule.before[before]);
            }
        }
        let mut optional = Vec::new();
        let mut takes = false;
        for (index, &node) in rule.nodes.iter().enumerate() {
            if index == next || matches!(parts[index], Part::Gone(_)) {
                continue;
            }
            if matches!(self.grammar.symbols[node], Symbol::Guard(_)) {
                parts[index] = Part::Left(Duty::Nothing);
            } else if self.outlook.least[node] > 0 {
                takes = true;
            } else {
                optional.push(index);
            }
        }
        let starts = vec![pending.start; rule.nodes.len()];
        let mut trail = situation.trail.clone();
        trail.push(pending.symbol);
        let mut go = |parts: &[Part], trail: Vec<SymbolId>| {
            let mut after = situation.clone();
            after.trail = trail;
            after.expand(focus, rule, parts, &starts, next);
            self.enter(after, Some(place), events.clone(), meter)
        };
        if takes {
            return go(&parts, Vec::new());
        }
        // Either all siblings vanish, and then no symbol may occur twice on the way down, or one of them yields a step.
        let mut none = parts.clone();
        optional.iter().for_each(|&index| none[index] = Part::Left(Duty::Nothing));
        if !trail.contains(&rule.nodes[next]) {
            go(&none, trail)?;
        }
        for (position, &index) in optional.iter().enumerate() {
            let mut some = parts.clone();
            optional[..position].iter().for_each(|&earlier| some[earlier] = Part::Left(Duty::Nothing));
            some[index] = Part::Left(Duty::Something);
            go(&some, Vec::new())?;
        }
        Ok(())
    }
}

fn vanished(pending: &Pending, start: Slot) -> Event {
    Event::Vanished { node: pending.node, symbol: pending.symbol, start }
}

/// Whether two nodes are interchangeable.
fn twins(situation: &Situation, one: usize, other: usize) -> bool {
    let (left, right) = (&situation.pending[one], &situation.pending[other]);
    let place = |index: usize| u32::try_from(index).unwrap_or(u32::MAX);
    (left.symbol, left.duty, left.start, &left.before)
        == (right.symbol, right.duty, right.start, &right.before)
        && situation
            .pending
            .iter()
            .all(|later| later.before.contains(&place(one)) == later.before.contains(&place(other)))
}
