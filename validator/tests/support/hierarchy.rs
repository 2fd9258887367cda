//! Small task networks made at random, as data and as text, and what the definition says of them.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Random numbers; the seed alone decides them.
pub(crate) struct Chance(Pcg64Mcg);

impl Chance {
    pub(crate) fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// A number below `n`.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        usize::try_from(self.0.next_u64() % (n as u64)).unwrap()
    }
}

const OBJECTS: usize = 2;
const PREDICATES: usize = 2;
const ACTIONS: usize = 3;
const TASKS: usize = 3;

/// `(p0 ?x)` or `(not (p0 ?y))`; variables are numbers, 0 is the task's or action's argument.
#[derive(Clone, Copy, Debug)]
struct Literal {
    predicate: usize,
    variable: usize,
    holds: bool,
}

/// An atom of objects.
type Fact = (usize, usize);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Head {
    Action(usize),
    Task(usize),
}

#[derive(Clone, Debug)]
struct Network {
    /// What, and with which variable.
    subtasks: Vec<(Head, usize)>,
    /// Pairs of places, the first before the second.
    order: Vec<(usize, usize)>,
}

/// What may stand behind a hyphen: which of the types `a` and `b` it names. A variable stands for an object of any of
/// them, an object belongs to each of them.
const TYPES: [(&str, [bool; 2]); 3] =
    [("(either a b)", [true, true]), ("a", [true, false]), ("b", [false, true])];

fn fits(object: usize, variable: usize) -> bool {
    let named = |types: usize, of: usize| TYPES[types].1[of];
    (0..2).any(|of| named(object, of) && named(variable, of))
}

#[derive(Clone, Debug)]
struct Method {
    task: usize,
    /// The types of its two variables.
    types: [usize; 2],
    precondition: Vec<Literal>,
    network: Network,
    /// Whether its two variables must differ.
    distinct: bool,
}

#[derive(Clone, Debug)]
struct Action {
    precondition: Vec<Literal>,
    effect: Vec<Literal>,
}

/// A step of a plan: which action, and of which object.
pub(crate) type Step = (usize, usize);

/// A domain with a problem. All tasks and actions have one argument, methods have two variables.
#[derive(Clone, Debug)]
pub(crate) struct Task {
    actions: Vec<Action>,
    methods: Vec<Method>,
    root: Network,
    init: BTreeSet<Fact>,
    /// The types of each object.
    types: [usize; OBJECTS],
}

/// A plan that was made by decomposing.
pub(crate) struct Made {
    pub(crate) plan: String,
    pub(crate) steps: Vec<Step>,
}

/// Something that is left to do.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Item {
    Node(Head, usize),
    /// The precondition of a method, with its variables' objects.
    Guard(usize, [usize; 2]),
}

/// With a number, and the numbers of what comes first.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Pending {
    id: usize,
    item: Item,
    before: BTreeSet<usize>,
}

/// What became of the tasks: per number the task, the method, the object, and the numbers of the subtasks.
type Apart = BTreeMap<usize, (usize, usize, usize, Vec<usize>)>;

fn literals(chance: &mut Chance, most: usize, variables: usize) -> Vec<Literal> {
    (0..chance.below(most + 1))
        .map(|_| Literal {
            predicate: chance.below(PREDICATES),
            variable: chance.below(variables),
            holds: chance.below(3) > 0,
        })
        .collect()
}

fn network(chance: &mut Chance, most: usize) -> Network {
    let heads = |chance: &mut Chance| match chance.below(5) {
        0..2 => Head::Task(chance.below(TASKS)),
        _ => Head::Action(chance.below(ACTIONS)),
    };
    let count = chance.below(most + 1);
    let subtasks: Vec<_> = (0..count).map(|_| (heads(chance), chance.below(2))).collect();
    let likely = [0, 1, 3][chance.below(3)];
    let mut order = Vec::new();
    for later in 1..count {
        for earlier in 0..later {
            if chance.below(3) < likely {
                order.push((earlier, later));
            }
        }
    }
    Network { subtasks, order }
}

fn holds(literals: &[Literal], objects: [usize; 2], state: &BTreeSet<Fact>) -> bool {
    literals.iter().all(|l| state.contains(&(l.predicate, objects[l.variable])) == l.holds)
}

impl Task {
    pub(crate) fn random(chance: &mut Chance) -> Self {
        let actions = (0..ACTIONS)
            .map(|_| {
                // Few, so that many sequences can be taken and it is the network that decides.
                let most = usize::from(chance.below(3) == 0);
                let precondition = literals(chance, most, 1);
                let mut effect = literals(chance, 2, 1);
                // One literal an atom, so that it cannot matter which of two effects wins.
                effect.dedup_by_key(|literal| literal.predicate);
                Action { precondition, effect }
            })
            .collect();
        let mut methods = Vec::new();
        for task in 0..TASKS {
            for _ in 0..=chance.below(2) {
                let distinct = chance.below(4) == 0;
                let most = chance.below(3);
                let precondition = literals(chance, most, 2);
                // Most variables are for every object.
                let types = [(); 2].map(|()| [0, 0, 0, 1, 2][chance.below(5)]);
                methods.push(Method { task, types, precondition, network: network(chance, 3), distinct });
            }
        }
        let mut root = network(chance, 3);
        if root.subtasks.is_empty() {
            root.subtasks.push((Head::Task(0), 0));
        }
        let facts = (0..PREDICATES).flat_map(|p| (0..OBJECTS).map(move |o| (p, o)));
        let init = facts.filter(|_| chance.below(2) == 0).collect();
        let types = [(); OBJECTS].map(|()| chance.below(TYPES.len()));
        Self { actions, methods, root, init, types }
    }

    /// The domain and the problem.
    pub(crate) fn texts(&self) -> (String, String) {
        let mut domain =
            "(define (domain d) (:requirements :hierarchy :typing :negative-preconditions :equality)\n\
                          (:types a b - object) (:predicates (p0 ?x) (p1 ?x))\n"
                .to_owned();
        for task in 0..TASKS {
            writeln!(domain, "(:task t{task} :parameters (?v0))").unwrap();
        }
        for (name, method) in self.methods.iter().enumerate() {
            let constraints = if method.distinct { ":constraints (and (not (= ?v0 ?v1)))" } else { "" };
            writeln!(
                domain,
                "(:method m{name} :parameters (?v0 - {} ?v1 - {}) :task (t{} ?v0) :precondition {} {} {constraints})",
                TYPES[method.types[0]].0,
                TYPES[method.types[1]].0,
                method.task,
                condition(&method.precondition),
                network_text(&method.network, "?v"),
            )
            .unwrap();
        }
        for (name, action) in self.actions.iter().enumerate() {
            let (needs, does) = (condition(&action.precondition), condition(&action.effect));
            writeln!(domain, "(:action a{name} :parameters (?v0) :precondition {needs} :effect {does})")
                .unwrap();
        }
        domain.push(')');
        let init: String = self.init.iter().map(|(p, o)| format!(" (p{p} o{o})")).collect();
        let root = network_text(&self.root, "o");
        let object = |(number, of): (usize, &usize)| format!(" o{number} - {}", TYPES[*of].0);
        let objects: String = self.types.iter().enumerate().map(object).collect();
        let problem =
            format!("(define (problem p) (:domain d) (:objects{objects}) (:htn {root}) (:init{init}))");
        (domain, problem)
    }

    pub(crate) fn sequence(&self, steps: &[Step]) -> String {
        let line = |(action, object): &Step| format!("(a{action} o{object})\n");
        format!("; a sequence\n{}", steps.iter().map(line).collect::<String>())
    }

    /// The sequence with a step dropped, moved, added or changed.
    pub(crate) fn mutated(&self, steps: &[Step], chance: &mut Chance) -> Vec<Step> {
        let mut steps = steps.to_vec();
        let any = |chance: &mut Chance| (chance.below(ACTIONS), chance.below(OBJECTS));
        match (chance.below(4), steps.len()) {
            (0, 2..) => {
                let step = steps.remove(chance.below(steps.len()));
                steps.insert(chance.below(steps.len() + 1), step);
            }
            (1, 1..) => {
                let place = chance.below(steps.len());
                steps[place] = any(chance);
            }
            (2, 1..) => {
                steps.remove(chance.below(steps.len()));
            }
            _ => steps.insert(chance.below(steps.len() + 1), any(chance)),
        }
        steps.truncate(5);
        steps
    }

    fn start(&self) -> (Vec<Pending>, usize) {
        let mut next = 0;
        let pending = expanded(&self.root, [0, 1], &BTreeSet::new(), &mut next);
        (pending, next)
    }

    fn apply(&self, (action, object): Step, state: &BTreeSet<Fact>) -> Option<BTreeSet<Fact>> {
        let action = &self.actions[action];
        let mut after = state.clone();
        if !holds(&action.precondition, [object; 2], state) {
            return None;
        }
        for literal in action.effect.iter().filter(|literal| !literal.holds) {
            after.remove(&(literal.predicate, object));
        }
        for literal in action.effect.iter().filter(|literal| literal.holds) {
            after.insert((literal.predicate, object));
        }
        Some(after)
    }

    /// Takes a task apart by each method and with each object; answers what is left, and the numbers of the subtasks.
    fn apart(&self, pending: &[Pending], place: usize, next: usize) -> Vec<(usize, usize, Vec<Pending>)> {
        let Item::Node(Head::Task(task), object) = pending[place].item else { return Vec::new() };
        let mut ways = Vec::new();
        for (name, method) in self.methods.iter().enumerate().filter(|(_, method)| method.task == task) {
            let is_of = |object: usize, variable: usize| fits(self.types[object], method.types[variable]);
            let others = (0..OBJECTS).filter(|&other| is_of(object, 0) && is_of(other, 1));
            for other in others.filter(|&other| !method.distinct || other != object) {
                let objects = [object, other];
                let mut left = pending.to_vec();
                let gone = left.remove(place);
                let mut number = next + 1;
                let guard = Pending { id: next, item: Item::Guard(name, objects), before: BTreeSet::new() };
                let inside = expanded(&method.network, objects, &BTreeSet::from([next]), &mut number);
                for later in left.iter_mut().filter(|later| later.before.contains(&gone.id)) {
                    later.before.remove(&gone.id);
                    later.before.extend(next..number);
                }
                left.push(guard);
                left.extend(inside);
                ways.push((name, number, left));
            }
        }
        ways
    }

    /// Whether the steps come out of the root, with so many tasks taken apart at most.
    pub(crate) fn yields(&self, steps: &[Step], apart: u32) -> bool {
        let mut states = vec![self.init.clone()];
        for &step in steps {
            match self.apply(step, &states[states.len() - 1]) {
                Some(state) => states.push(state),
                None => return false,
            }
        }
        let (pending, next) = self.start();
        let mut failed = BTreeMap::new();
        self.goes_on(&pending, next, steps, 0, &states, apart, &mut failed)
    }

    #[expect(clippy::too_many_arguments, reason = "what a step of the enumeration is about")]
    fn goes_on(
        &self,
        pending: &[Pending],
        next: usize,
        steps: &[Step],
        taken: usize,
        states: &[BTreeSet<Fact>],
        apart: u32,
        failed: &mut BTreeMap<(Vec<Pending>, usize), u32>,
    ) -> bool {
        if pending.is_empty() {
            return taken == steps.len();
        }
        let actions = pending.iter().filter(|p| matches!(p.item, Item::Node(Head::Action(_), _))).count();
        let tasks = pending.iter().filter(|p| matches!(p.item, Item::Node(Head::Task(_), _))).count();
        if actions > steps.len() - taken || tasks > apart as usize {
            return false;
        }
        let key = (renumbered(pending), taken);
        if failed.get(&key).is_some_and(|&known| known >= apart) {
            return false;
        }
        for (place, one) in pending.iter().enumerate().filter(|(_, one)| one.before.is_empty()) {
            let found = match one.item {
                Item::Node(Head::Action(action), object) => {
                    steps.get(taken) == Some(&(action, object))
                        && self.goes_on(
                            &without(pending, place),
                            next,
                            steps,
                            taken + 1,
                            states,
                            apart,
                            failed,
                        )
                }
                Item::Guard(method, objects) => {
                    holds(&self.methods[method].precondition, objects, &states[taken])
                        && self.goes_on(&without(pending, place), next, steps, taken, states, apart, failed)
                }
                Item::Node(Head::Task(_), _) => {
                    apart > 0
                        && self.apart(pending, place, next).into_iter().any(|(_, next, left)| {
                            self.goes_on(&left, next, steps, taken, states, apart - 1, failed)
                        })
                }
            };
            if found {
                return true;
            }
        }
        failed.insert(key, apart);
        false
    }

    /// A plan, if some tries come to one.
    pub(crate) fn decompose(&self, chance: &mut Chance) -> Option<Made> {
        (0..20).find_map(|_| self.decompose_once(chance))
    }

    fn decompose_once(&self, chance: &mut Chance) -> Option<Made> {
        let (mut pending, mut next) = self.start();
        let roots: Vec<usize> = pending.iter().map(|one| one.id).collect();
        let mut state = self.init.clone();
        let mut steps: Vec<(usize, Step)> = Vec::new();
        let mut apart = Apart::new();
        for _ in 0..60 {
            if pending.is_empty() {
                return Some(made(&steps, &roots, &apart));
            }
            let free: Vec<usize> = (0..pending.len()).filter(|&i| pending[i].before.is_empty()).collect();
            let place = free[chance.below(free.len())];
            let id = pending[place].id;
            match pending[place].item {
                Item::Node(Head::Action(action), object) => {
                    if steps.len() == 6 {
                        return None;
                    }
                    state = self.apply((action, object), &state)?;
                    steps.push((id, (action, object)));
                    pending = without(&pending, place);
                }
                Item::Guard(method, objects) => {
                    if !holds(&self.methods[method].precondition, objects, &state) {
                        // It may hold later, if there is anything else to do.
                        if free.len() == 1 {
                            return None;
                        }
                        continue;
                    }
                    pending = without(&pending, place);
                }
                Item::Node(Head::Task(_), object) => {
                    let mut ways = self.apart(&pending, place, next);
                    if ways.is_empty() {
                        return None;
                    }
                    let (method, after, left) = ways.swap_remove(chance.below(ways.len()));
                    apart
                        .insert(id, (self.methods[method].task, method, object, (next + 1..after).collect()));
                    next = after;
                    pending = left;
                }
            }
        }
        None
    }
}

fn condition(literals: &[Literal]) -> String {
    let literal = |l: &Literal| {
        let atom = format!("(p{} ?v{})", l.predicate, l.variable);
        if l.holds { atom } else { format!("(not {atom})") }
    };
    format!("(and {})", literals.iter().map(literal).collect::<Vec<_>>().join(" "))
}

fn network_text(network: &Network, variable: &str) -> String {
    let subtask = |(place, (head, of)): (usize, &(Head, usize))| match head {
        Head::Action(action) => format!("(s{place} (a{action} {variable}{of}))"),
        Head::Task(task) => format!("(s{place} (t{task} {variable}{of}))"),
    };
    let subtasks: Vec<String> = network.subtasks.iter().enumerate().map(subtask).collect();
    let order: Vec<String> = network.order.iter().map(|(a, b)| format!("(< s{a} s{b})")).collect();
    format!(":subtasks (and {}) :ordering (and {})", subtasks.join(" "), order.join(" "))
}

fn expanded(
    network: &Network,
    objects: [usize; 2],
    first: &BTreeSet<usize>,
    next: &mut usize,
) -> Vec<Pending> {
    let base = *next;
    *next += network.subtasks.len();
    let one = |(place, &(head, of)): (usize, &(Head, usize))| {
        let order = network.order.iter().filter(|(_, later)| *later == place);
        let before = order.map(|(earlier, _)| base + earlier).chain(first.iter().copied()).collect();
        Pending { id: base + place, item: Item::Node(head, objects[of]), before }
    };
    network.subtasks.iter().enumerate().map(one).collect()
}

fn without(pending: &[Pending], place: usize) -> Vec<Pending> {
    let mut left = pending.to_vec();
    let gone = left.remove(place).id;
    for one in &mut left {
        one.before.remove(&gone);
    }
    left
}

/// The same with the numbers 0, 1, …
fn renumbered(pending: &[Pending]) -> Vec<Pending> {
    let places: BTreeMap<usize, usize> = pending.iter().enumerate().map(|(i, one)| (one.id, i)).collect();
    let one = |one: &Pending| Pending {
        id: places[&one.id],
        item: one.item.clone(),
        before: one.before.iter().map(|before| places[before]).collect(),
    };
    pending.iter().map(one).collect()
}

/// As the hierarchical track writes it; the methods' subtasks in any order.
fn made(steps: &[(usize, Step)], roots: &[usize], apart: &Apart) -> Made {
    let list = |numbers: &[usize]| numbers.iter().map(|n| format!(" {n}")).collect::<String>();
    let mut plan = "==>\n".to_owned();
    for (id, (action, object)) in steps {
        writeln!(plan, "{id} a{action} o{object}").unwrap();
    }
    writeln!(plan, "root{}", list(roots)).unwrap();
    for (id, (task, method, object, below)) in apart {
        writeln!(plan, "{id} t{task} o{object} -> m{method}{}", list(below)).unwrap();
    }
    plan.push_str("<==\n");
    Made { plan, steps: steps.iter().map(|(_, step)| *step).collect() }
}
