//! A picture of a state: nodes in rows, so that most edges point down.
//!
//! Layout crates for Rust either ask for graphviz or abort on graphs that they do not like; what a person wants to see at
//! once is small, so this is the plain layered method without dummy nodes: edges that close a cycle are turned round, a node
//! stands below whatever points at it, and each row is ordered by the mean place of its neighbours, up and down a few
//! times. Rows that are too wide are broken. Source: Sugiyama, Tagawa & Toda, "Methods for visual understanding of
//! hierarchical system structures", IEEE SMC 1981, steps 1, 2 and 4.
//!
//! Cost: linear in edges times the number of sweeps.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::{View, escaped};
use crate::id::NodeId;

/// Widest row, in nodes.
const WIDEST: usize = 8;
const SWEEPS: usize = 8;
const HEIGHT: f64 = 40.0;
const GAP: f64 = 40.0;
const STEP: f64 = 120.0;

struct Edge {
    from: usize,
    to: usize,
    label: String,
    dashed: bool,
}

struct Spot {
    x: f64,
    y: f64,
    width: f64,
}

pub(super) fn draw(view: &View<'_>) -> String {
    let ids: Vec<_> = view.nodes().map(|node| node.id).collect();
    let index: BTreeMap<NodeId, usize> = ids.iter().enumerate().map(|(at, id)| (*id, at)).collect();
    let place = |from: NodeId, to: NodeId| Some((*index.get(&from)?, *index.get(&to)?));
    let mut edges = Vec::new();
    for (parent, child) in view.transforms() {
        if let Some((from, to)) = place(parent, child) {
            edges.push(Edge { from, to, label: "RT".to_owned(), dashed: true });
        }
    }
    for key in view.edges() {
        if let Some((from, to)) = place(key.from, key.to) {
            edges.push(Edge { from, to, label: view.label(key).to_owned(), dashed: false });
        }
    }
    let rows = ordered(&ranks(ids.len(), &edges), &edges);
    let texts: Vec<_> = view.nodes().map(|node| (node.name().to_owned(), view.type_of(node))).collect();
    let spots = spots(&rows, &texts);
    let width = spots.iter().map(|spot| spot.x + spot.width / 2.0).fold(100.0, f64::max) + GAP;
    let height = spots.iter().map(|spot| spot.y).fold(0.0, f64::max) + HEIGHT + GAP;

    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
         height=\"{height:.0}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <defs><marker id=\"end\" viewBox=\"0 0 8 8\" refX=\"8\" refY=\"4\" markerWidth=\"8\" markerHeight=\"8\" \
         orient=\"auto\"><path d=\"M0 0L8 4L0 8z\"/></marker></defs>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    let mut drawn: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for edge in &edges {
        let nth = drawn.entry((edge.from, edge.to)).or_default();
        line(&mut svg, &spots[edge.from], &spots[edge.to], edge, *nth);
        *nth += 1;
    }
    for (spot, (name, node_type)) in spots.iter().zip(&texts) {
        let (x, y) = (spot.x - spot.width / 2.0, spot.y - HEIGHT / 2.0);
        let _ = writeln!(
            svg,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{HEIGHT}\" rx=\"6\" fill=\"#eef3fa\" \
             stroke=\"#345\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-weight=\"bold\">{}</text>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" fill=\"#567\">{}</text>",
            spot.width,
            spot.x,
            spot.y - 3.0,
            escaped(name),
            spot.x,
            spot.y + 13.0,
            escaped(node_type)
        );
    }
    svg.push_str("</svg>\n");
    svg
}

/// How far down each node stands: below whatever points at it, cycles cut where a walk closes them.
fn ranks(count: usize, edges: &[Edge]) -> Vec<usize> {
    let mut out = vec![Vec::new(); count];
    for edge in edges {
        out[edge.from].push(edge.to);
    }
    // Depth first, without recursion: 0 unseen, 1 on the path, 2 done.
    let (mut colour, mut order) = (vec![0_u8; count], Vec::new());
    let mut forward = vec![Vec::new(); count];
    for start in 0..count {
        if colour[start] != 0 {
            continue;
        }
        colour[start] = 1;
        let mut path = vec![(start, 0)];
        while let Some((node, next)) = path.last_mut() {
            let node = *node;
            let Some(&to) = out[node].get(*next) else {
                colour[node] = 2;
                order.push(node);
                path.pop();
                continue;
            };
            *next += 1;
            match colour[to] {
                1 => forward[to].push(node),
                seen => {
                    forward[node].push(to);
                    if seen == 0 {
                        colour[to] = 1;
                        path.push((to, 0));
                    }
                }
            }
        }
    }
    // An edge that was turned round may point backwards in this order; it then only counts for the order of rows.
    let mut rank = vec![0; count];
    for &node in order.iter().rev() {
        for &to in &forward[node] {
            rank[to] = rank[to].max(rank[node] + 1);
        }
    }
    rank
}

/// The rows, each in an order in which neighbours are near each other. Nodes without edges come last.
fn ordered(rank: &[usize], edges: &[Edge]) -> Vec<Vec<usize>> {
    let mut neighbours = vec![Vec::new(); rank.len()];
    for edge in edges {
        neighbours[edge.from].push(edge.to);
        neighbours[edge.to].push(edge.from);
    }
    let lowest = rank.iter().copied().max().unwrap_or(0);
    let mut rows = vec![Vec::new(); lowest + 2];
    for (node, &rank) in rank.iter().enumerate() {
        rows[if neighbours[node].is_empty() { lowest + 1 } else { rank }].push(node);
    }
    let mut place = vec![0.0; rank.len()];
    let settle = |row: &[usize], place: &mut Vec<f64>| {
        for (at, &node) in row.iter().enumerate() {
            #[expect(clippy::cast_precision_loss, reason = "places in a picture")]
            let offset = at as f64 - (row.len() as f64 - 1.0) / 2.0;
            place[node] = offset;
        }
    };
    rows.iter().for_each(|row| settle(row, &mut place));
    for sweep in 0..SWEEPS {
        let down: Vec<usize> = (0..rows.len()).collect();
        let order: Vec<usize> = if sweep % 2 == 0 { down } else { down.into_iter().rev().collect() };
        for at in order {
            let mean = |node: usize| {
                let near = &neighbours[node];
                #[expect(clippy::cast_precision_loss, reason = "places in a picture")]
                let count = near.len().max(1) as f64;
                near.iter().map(|&other| place[other]).sum::<f64>() / count
            };
            let mut keyed: Vec<_> = rows[at].iter().map(|&node| (mean(node), node)).collect();
            keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
            rows[at] = keyed.into_iter().map(|(_, node)| node).collect();
            settle(&rows[at], &mut place);
        }
    }
    rows.into_iter().flat_map(|row| row.chunks(WIDEST).map(<[usize]>::to_vec).collect::<Vec<_>>()).collect()
}

fn spots(rows: &[Vec<usize>], texts: &[(String, &str)]) -> Vec<Spot> {
    #[expect(clippy::cast_precision_loss, reason = "lengths of names")]
    let width = |node: usize| {
        let (name, node_type) = &texts[node];
        (name.chars().count().max(node_type.chars().count()) as f64 * 7.5 + 20.0).max(60.0)
    };
    let row_width = |row: &Vec<usize>| row.iter().map(|&node| width(node) + GAP).sum::<f64>();
    let widest = rows.iter().map(row_width).fold(0.0, f64::max);
    let mut spots: Vec<_> = texts.iter().map(|_| Spot { x: 0.0, y: 0.0, width: 0.0 }).collect();
    let mut y = GAP;
    for row in rows {
        let mut x = GAP + (widest - row_width(row)) / 2.0;
        for &node in row {
            let width = width(node);
            spots[node] = Spot { x: x + width / 2.0, y, width };
            x += width + GAP;
        }
        y += STEP;
    }
    spots
}

fn line(svg: &mut String, from: &Spot, to: &Spot, edge: &Edge, nth: usize) {
    #[expect(clippy::cast_precision_loss, reason = "edges between two nodes are few")]
    let shift = nth as f64 * 14.0;
    let half = HEIGHT / 2.0;
    let (y1, y2, bend) = if from.y < to.y {
        (from.y + half, to.y - half, (to.y - from.y) / 3.0)
    } else if from.y > to.y {
        (from.y - half, to.y + half, (to.y - from.y) / 3.0)
    } else {
        (from.y - half, to.y - half, -STEP / 3.0 - shift)
    };
    let (x1, x2) = (from.x + shift, to.x + shift);
    let (c1, c2) = if from.y == to.y { (y1 + bend, y2 + bend) } else { (y1 + bend, y2 - bend) };
    let dash = if edge.dashed { " stroke-dasharray=\"5 4\"" } else { "" };
    let (x, y) = ((x1 + x2) / 2.0, (y1 + 3.0 * c1 + 3.0 * c2 + y2) / 8.0 + shift);
    let _ = writeln!(
        svg,
        "<path d=\"M{x1:.1} {y1:.1}C{x1:.1} {c1:.1} {x2:.1} {c2:.1} {x2:.1} {y2:.1}\" fill=\"none\" stroke=\"#345\"{dash} \
         marker-end=\"url(#end)\"/><text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" fill=\"#834\" \
         stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\">{}</text>",
        escaped(&edge.label)
    );
}
