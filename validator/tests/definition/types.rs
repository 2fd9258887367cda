//! The types of random tasks, as text, and what belongs to them, by the words of the definition.
//!
//! Two types have a supertype and a subtype in common. An object of both is written in each way that PDDL has: with
//! `either`, by two declarations, or as a constant that the problem declares again with the other type.

use crate::sample::Named;

pub const HIERARCHY: &str = "t4 - (either t1 t3) t1 t3 - t0";
pub const BOTH: &str = "(either t1 t3)";

fn named(of: &str) -> impl Iterator<Item = &str> {
    of.trim_matches(['(', ')']).split(' ').filter(|&word| word != "either")
}

fn is_below(of: &str, wanted: &str) -> bool {
    of == wanted
        || match of {
            "t1" | "t3" => wanted == "t0",
            "t4" => ["t0", "t1", "t3"].contains(&wanted),
            _ => false,
        }
}

/// Whether something can stand where a type is wanted: an object, because one of its types is below it; a variable,
/// because whatever it stands for is.
pub fn fits((name, of): &Named, wanted: &str) -> bool {
    let is_one = |of: &str| named(wanted).any(|wanted| is_below(of, wanted));
    if name.starts_with('?') { named(of).all(is_one) } else { named(of).any(is_one) }
}

/// In which of the ways an object of both types is declared: its number decides.
fn way((name, of): &Named) -> Option<usize> {
    (*of == BOTH).then(|| name[1..].parse::<usize>().unwrap() % 3)
}

/// The constants that a domain declares.
pub fn constants(objects: &[Named]) -> String {
    let declared = objects.iter().filter(|object| way(object) == Some(2));
    declared.map(|(name, _)| format!("{name} - t1 ")).collect()
}

/// The objects that a problem declares.
pub fn objects(objects: &[Named]) -> String {
    let declared = |object: &Named| match (object, way(object)) {
        ((name, _), Some(1)) => format!("{name} - t1 {name} - t3 "),
        ((name, _), Some(2)) => format!("{name} - t3 "),
        ((name, of), _) => format!("{name} - {of} "),
    };
    objects.iter().map(declared).collect()
}
