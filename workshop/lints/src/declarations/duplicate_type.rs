//! A type that is declared twice.

use pddl::FileKind;
use pddl::model::Name;
use pddl::syntax::Node;
use rustc_hash::FxHashMap;

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::text;
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "duplicate-type",
    level: Level::Default,
    explanation: explanation!("W0713"),
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
            let finding = LINT.finding(place::domain(declaration.name.span()), message);
            found.report(finding.label(place::domain(earlier.name.span()), "first declared here"));
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
