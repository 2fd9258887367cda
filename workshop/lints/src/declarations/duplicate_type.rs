//! A type that is declared twice.

use pddl::model::Name;
use pddl::syntax::Node;
use pddl::{Explanation, FileKind};
use rustc_hash::FxHashMap;

use crate::finding::Findings;
use crate::lint::Check;
use crate::text;
use crate::view::DomainView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "duplicate-type",
    level: Level::Default,
    explanation: Explanation {
        code: "W0713",
        title: "type declared twice",
        meaning: "A name stands twice on the left in `:types`, below the same supertype or once below `object`.",
        why: "pelea takes the supertypes of both; other tools take those of the first or of the last one, or refuse \
         the file. If it shall have two supertypes, write `(either a b)`.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp - thing room - object lamp - object thing - object)
  (:predicates (lit ?x - lamp) (in ?x - thing ?r - room))
  (:action switch
    :parameters (?x - lamp ?r - room)
    :precondition (in ?x ?r)
    :effect (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp - thing room - object thing - object)
  (:predicates (lit ?x - lamp) (in ?x - thing ?r - room))
  (:action switch
    :parameters (?x - lamp ?r - room)
    :precondition (in ?x ?r)
    :effect (lit ?x)))"],
    },
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    let types = text::sections(view.tree(), FileKind::Domain).filter(|section| section.is_headed(":types"));
    let declared: Vec<Declared<'_>> = types.flat_map(declarations).collect();
    let mut first: FxHashMap<Name, &Declared<'_>> = FxHashMap::default();
    for declaration in &declared {
        let name = Name::new(declaration.name.text());
        let Some(earlier) = first.get(&name) else {
            first.insert(name, declaration);
            continue;
        };
        let (here, there) = (declaration.parent(), earlier.parent());
        // Two different ones are a way to write two supertypes.
        if here == there || here == "object" || there == "object" {
            let message = if here == there {
                format!("type `{name}` is declared twice")
            } else {
                format!("type `{name}` is declared twice, once below `{here}` and once below `{there}`")
            };
            let finding = Finding::new(&LINT, Place::domain(declaration.name.span()), message);
            found.report(finding.label(Place::domain(earlier.name.span()), "first declared here"));
        }
    }
}

/// `name … - parent`
struct Declared<'t> {
    name: Node<'t>,
    parent: Option<Node<'t>>,
}

impl Declared<'_> {
    fn parent(&self) -> String {
        self.parent.map_or_else(|| "object".to_owned(), |parent| parent.text().to_ascii_lowercase())
    }
}

fn declarations(section: Node<'_>) -> Vec<Declared<'_>> {
    let (mut declared, mut untyped) = (Vec::new(), 0);
    let mut nodes = section.children().skip(1);
    while let Some(node) = nodes.next() {
        if node.is("-") {
            let parent = nodes.next();
            declared[untyped..].iter_mut().for_each(|d: &mut Declared<'_>| d.parent = parent);
            untyped = declared.len();
        } else if node.is_name() {
            declared.push(Declared { name: node, parent: None });
        }
    }
    declared
}
