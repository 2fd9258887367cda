//! A picture of a state: nodes in rows, so that most edges point down.
//!
//! The module `layers` computes the layout. All edges from one node to another share a line, which carries all their
//! labels; transforms are dashed. A label lies on a white rectangle over its line, so a viewer needs no masks.

mod layers;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use dsr::NodeId;

use self::layers::{Layout, Line, NODE, Point, Run, lay_out};
use crate::view::View;
use crate::xml::escaped;

/// Edges between two nodes, in one direction.
struct Bundle {
    line: Line,
    label: String,
    is_transform: bool,
}

/// Draws the view as an SVG picture.
pub fn svg(view: &View<'_>) -> String {
    let index: BTreeMap<NodeId, usize> = view.nodes().enumerate().map(|(at, node)| (node.id, at)).collect();
    let texts: Vec<_> = view.nodes().map(|node| (node.name(), view.type_of(node))).collect();
    let widths: Vec<_> =
        texts.iter().map(|(name, kind)| wide(name, 7.8).max(wide(kind, 6.8)) + 20.0).collect();
    let bundles = bundles(view, &index);
    let lines: Vec<_> = bundles.iter().map(|bundle| bundle.line).collect();
    let Layout { nodes, runs, size: (width, height) } = lay_out(&widths, &lines);

    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
         height=\"{height:.0}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <defs><marker id=\"end\" viewBox=\"0 0 8 8\" refX=\"8\" refY=\"4\" markerWidth=\"8\" markerHeight=\"8\" \
         orient=\"auto\"><path d=\"M0 0L8 4L0 8z\" fill=\"#345\"/></marker></defs>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    for (bundle, run) in bundles.iter().zip(&runs) {
        let dash = if bundle.is_transform { " stroke-dasharray=\"5 4\"" } else { "" };
        let _ = writeln!(
            svg,
            "<path d=\"{}\" fill=\"none\" stroke=\"#345\"{dash} marker-end=\"url(#end)\"/>",
            path(&run.points)
        );
    }
    for (Bundle { label, line, .. }, Run { label: (x, y), .. }) in bundles.iter().zip(&runs) {
        let _ = writeln!(
            svg,
            "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"14\" fill=\"white\"/>\
             <text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"11\" text-anchor=\"middle\" fill=\"#834\">{}</text>",
            x - line.label / 2.0,
            y - 7.0,
            line.label,
            y + 4.0,
            escaped(label)
        );
    }
    for (((x, y), width), (name, kind)) in nodes.iter().zip(&widths).zip(&texts) {
        let _ = writeln!(
            svg,
            "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{width:.1}\" height=\"{NODE}\" rx=\"6\" fill=\"#eef3fa\" \
             stroke=\"#345\"/>\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-weight=\"bold\">{}</text>\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#567\">{}</text>",
            x - width / 2.0,
            y - NODE / 2.0,
            y - 3.0,
            escaped(name),
            y + 13.0,
            escaped(kind)
        );
    }
    svg.push_str("</svg>\n");
    svg
}

fn bundles(view: &View<'_>, index: &BTreeMap<NodeId, usize>) -> Vec<Bundle> {
    let mut labels: BTreeMap<(usize, usize, bool), Vec<&str>> = BTreeMap::new();
    let transforms = view.transforms().map(|(parent, child)| (parent, child, true, "RT"));
    let edges = view.edges().map(|key| (key.from, key.to, false, view.label(key)));
    for (from, to, is_transform, label) in transforms.chain(edges) {
        if let (Some(&from), Some(&to)) = (index.get(&from), index.get(&to)) {
            labels.entry((from, to, is_transform)).or_default().push(label);
        }
    }
    let bundle = |((from, to, is_transform), labels): (_, Vec<&str>)| {
        let label = labels.join(", ");
        Bundle { line: Line { from, to, label: wide(&label, 6.2) + 6.0 }, label, is_transform }
    };
    labels.into_iter().map(bundle).collect()
}

/// The approximate width of a text whose letters have this width.
#[expect(clippy::cast_precision_loss, reason = "lengths of names")]
fn wide(text: &str, letter: f64) -> f64 {
    text.chars().count() as f64 * letter
}

fn path(points: &[Point]) -> String {
    let mut path = String::new();
    let mut last: Option<Point> = None;
    for &(x, y) in points {
        let _ = match last {
            None => write!(path, "M{x:.1} {y:.1}"),
            Some((before, _)) if (before - x).abs() < 0.05 => write!(path, "L{x:.1} {y:.1}"),
            Some((before, above)) => {
                let middle = f64::midpoint(above, y);
                write!(path, "C{before:.1} {middle:.1} {x:.1} {middle:.1} {x:.1} {y:.1}")
            }
        };
        last = Some((x, y));
    }
    path
}
