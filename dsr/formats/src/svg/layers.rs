//! The layout of a picture: nodes in rows, so that lines point down, and no label or node covers another.
//!
//! Problem: a line that spans several rows would run through the nodes in between, and labels would cover each other.
//! Idea: the layered method. Lines that close a cycle are reversed, and each node is placed below the nodes that point
//! at it. A line has a cell in each row that it passes. Between two rows of nodes is a row for labels, so each label
//! has a cell of its own. Rows are ordered by the mean position of their neighbours, up and down, and the order with
//! the fewest crossings is kept. Then each row is moved as near to its neighbours as the widths allow, long lines with
//! the most weight; for one row this is a regression under an order constraint, which pooling solves exactly. The Rust
//! crates for layout either call graphviz or abort on some graphs.
//!
//! Cost: the number of sweeps times the number of cells; the cells are at most the lines times the rows. Beyond
//! [`MOST`] cells, a line has a cell for its label only and runs behind what is in its way.
//!
//! Source: Sugiyama, Tagawa & Toda, "Methods for visual understanding of hierarchical system structures", IEEE SMC
//! 1981; Gansner, Koutsofios, North & Vo, "A technique for drawing directed graphs", IEEE TSE 19, 1993, §4 (weights);
//! Barlow et al., "Statistical inference under order restrictions", 1972 (pooling).

/// Most cells of lines.
const MOST: usize = 4_000;
const SWEEPS: usize = 24;
/// Heights of nodes and of rows for labels.
pub(super) const NODE: f64 = 40.0;
const LABEL: f64 = 18.0;
/// Between nodes, and between lines, side by side.
const APART: f64 = 28.0;
const NEAR: f64 = 12.0;
/// The least and the most distance between two rows.
const GAP: (f64, f64) = (24.0, 90.0);
/// The margin around the picture.
const MARGIN: f64 = 30.0;
/// The distance between two lines at a node.
const PORT: f64 = 14.0;

/// A line to lay out.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub(super) from: usize,
    pub(super) to: usize,
    /// The width of its label.
    pub(super) label: f64,
}

pub(super) type Point = (f64, f64);

/// The course of a line: straight between points above each other, curved otherwise.
pub(super) struct Run {
    pub(super) points: Vec<Point>,
    /// The middle of its label.
    pub(super) label: Point,
}

pub(super) struct Layout {
    /// The middle of each node.
    pub(super) nodes: Vec<Point>,
    pub(super) runs: Vec<Run>,
    pub(super) size: Point,
}

/// An item of a row: a node, or a line that passes.
struct Cell {
    row: usize,
    width: f64,
    x: f64,
    /// Its neighbours above and below, each with a weight.
    near: Vec<(usize, f64)>,
    is_node: bool,
}

/// Lays out nodes of these widths, with lines between different ones.
pub(super) fn lay_out(widths: &[f64], lines: &[Line]) -> Layout {
    let ranks = ranks(widths.len(), lines);
    let mut cells: Vec<_> =
        widths.iter().zip(&ranks).map(|(&width, rank)| Cell::new(2 * rank, width, true)).collect();
    let chains = chains(&mut cells, lines);
    let mut rows = vec![Vec::new(); cells.iter().map(|cell| cell.row + 1).max().unwrap_or(0)];
    let (linked, alone): (Vec<_>, Vec<_>) = (0..cells.len()).partition(|&at| !cells[at].near.is_empty());
    linked.iter().for_each(|&at| rows[cells[at].row].push(at));
    order(&mut rows, &cells);
    straighten(&rows, &mut cells);

    let left = linked.iter().map(|&at| cells[at].left()).fold(f64::INFINITY, f64::min);
    linked.iter().for_each(|&at| cells[at].x += MARGIN - left);
    let mut right = linked.iter().map(|&at| cells[at].right()).fold(0.0, f64::max);
    let (middles, mut y) = heights(&rows, &cells);
    let mut nodes: Vec<_> = (0..widths.len()).map(|at| (cells[at].x, middles[cells[at].row])).collect();
    // Nodes without lines come last, side by side.
    let (mut x, broad) = (MARGIN, right.max(900.0));
    y += NODE / 2.0;
    for at in alone {
        if x > MARGIN && x + cells[at].width > broad {
            (x, y) = (MARGIN, y + NODE + GAP.0);
        }
        nodes[at] = (x + cells[at].width / 2.0, y);
        x += cells[at].width + APART;
        right = right.max(x - APART);
    }
    let bottom = nodes.iter().map(|(_, y)| y + NODE / 2.0).fold(0.0, f64::max);
    let runs = runs(&cells, &chains, lines, &middles);
    Layout { nodes, runs, size: (right + MARGIN, bottom + MARGIN) }
}

impl Cell {
    fn new(row: usize, width: f64, is_node: bool) -> Self {
        Self { row, width, x: 0.0, near: Vec::new(), is_node }
    }

    fn left(&self) -> f64 {
        self.x - self.width / 2.0
    }

    fn right(&self) -> f64 {
        self.x + self.width / 2.0
    }

    fn half_height(&self) -> f64 {
        if self.row.is_multiple_of(2) { NODE / 2.0 } else { LABEL / 2.0 }
    }
}

/// The rank of each node: below every node that points at it. A cycle is cut where a walk closes it.
fn ranks(count: usize, lines: &[Line]) -> Vec<usize> {
    let mut out = vec![Vec::new(); count];
    for line in lines {
        out[line.from].push(line.to);
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
    // A reversed line, like all others, now leads from a node of the path to one that was done before it.
    let mut rank = vec![0; count];
    for &node in order.iter().rev() {
        for &to in &forward[node] {
            rank[to] = rank[to].max(rank[node] + 1);
        }
    }
    // A node without incoming lines is placed just above the first node that it points at.
    let mut has_above = vec![false; count];
    forward.iter().flatten().for_each(|&to| has_above[to] = true);
    for node in (0..count).filter(|&node| !has_above[node]) {
        rank[node] = forward[node].iter().map(|&to| rank[to] - 1).min().unwrap_or(0);
    }
    rank
}

/// A line as the cells from its upper to its lower end, and the cell of its label.
struct Chain {
    cells: Vec<usize>,
    label: usize,
}

fn chains(cells: &mut Vec<Cell>, lines: &[Line]) -> Vec<Chain> {
    let ends = |cells: &[Cell], line: &Line| {
        let (a, b) = (cells[line.from].row, cells[line.to].row);
        if a < b { (line.from, line.to) } else { (line.to, line.from) }
    };
    let passed: usize = lines.iter().map(|line| cells[line.from].row.abs_diff(cells[line.to].row)).sum();
    let mut chains = Vec::with_capacity(lines.len());
    for line in lines {
        let (upper, lower) = ends(cells, line);
        let (first, last) = (cells[upper].row, cells[lower].row);
        // A row for labels near the middle; between two rows of nodes there is one.
        let middle = usize::midpoint(first, last) | 1;
        let rows = if passed > MOST { middle..middle + 1 } else { first + 1..last };
        let mut chain = Chain { cells: vec![upper], label: 0 };
        for row in rows {
            if row == middle {
                chain.label = cells.len();
            }
            chain.cells.push(cells.len());
            cells.push(Cell::new(row, if row == middle { line.label } else { 0.0 }, false));
        }
        chain.cells.push(lower);
        for pair in chain.cells.windows(2) {
            let weight = match (cells[pair[0]].is_node, cells[pair[1]].is_node) {
                (true, true) => 1.0,
                (false, false) => 8.0,
                _ => 2.0,
            };
            cells[pair[0]].near.push((pair[1], weight));
            cells[pair[1]].near.push((pair[0], weight));
        }
        chains.push(chain);
    }
    chains
}

/// Orders each row so that neighbours are near each other.
fn order(rows: &mut Vec<Vec<usize>>, cells: &[Cell]) {
    let mut place = vec![0.0; cells.len()];
    #[expect(clippy::cast_precision_loss, reason = "places in a picture")]
    let settle = |row: &[usize], place: &mut [f64]| {
        for (at, &cell) in row.iter().enumerate() {
            place[cell] = at as f64 - (row.len() as f64 - 1.0) / 2.0;
        }
    };
    rows.iter().for_each(|row| settle(row, &mut place));
    let is_small = cells.len() <= 4 * MOST;
    let mut best = (usize::MAX, rows.clone());
    for sweep in 0..SWEEPS {
        for step in 0..rows.len() {
            let is_down = sweep % 2 == 0;
            let at = if is_down { step } else { rows.len() - 1 - step };
            let mean = |cell: usize| {
                let seen = cells[cell].near.iter().filter(|(other, _)| (cells[*other].row < at) == is_down);
                let (sum, count) = seen.fold((0.0, 0.0), |(s, c), (other, _)| (s + place[*other], c + 1.0));
                if count > 0.0 { sum / count } else { place[cell] }
            };
            let mut keyed: Vec<_> = rows[at].iter().map(|&cell| (mean(cell), cell)).collect();
            keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
            rows[at] = keyed.into_iter().map(|(_, cell)| cell).collect();
            settle(&rows[at], &mut place);
        }
        // In a large graph crossings are not counted; the last order is kept.
        let found = if is_small { crossings(rows, cells, &place) } else { 0 };
        if found < best.0 || !is_small {
            best = (found, rows.clone());
        }
    }
    *rows = best.1;
}

/// The number of crossings between consecutive rows.
fn crossings(rows: &[Vec<usize>], cells: &[Cell], place: &[f64]) -> usize {
    let mut count = 0;
    for row in rows {
        // Lines from left to right by their upper ends; each crosses those before it that end further right.
        let mut ends: Vec<f64> = Vec::new();
        for &cell in row {
            let below = cells[cell].near.iter().filter(|(other, _)| cells[*other].row == cells[cell].row + 1);
            let here: Vec<f64> = below.map(|(other, _)| place[*other]).collect();
            count +=
                here.iter().map(|end| ends.len() - ends.partition_point(|seen| seen <= end)).sum::<usize>();
            for end in here {
                ends.insert(ends.partition_point(|seen| *seen <= end), end);
            }
        }
    }
    count
}

/// Moves each row as near to its neighbours as its order and the widths allow.
fn straighten(rows: &[Vec<usize>], cells: &mut [Cell]) {
    let apart = |a: &Cell, b: &Cell| {
        let room = |cell: &Cell| cell.width / 2.0 + if cell.is_node { APART } else { NEAR } / 2.0;
        room(a) + room(b)
    };
    for row in rows {
        for pair in row.windows(2) {
            cells[pair[1]].x = cells[pair[0]].x + apart(&cells[pair[0]], &cells[pair[1]]);
        }
        let middle = row.last().map_or(0.0, |&last| cells[last].x / 2.0);
        row.iter().for_each(|&cell| cells[cell].x -= middle);
    }
    for sweep in 0..SWEEPS {
        for step in 0..rows.len() {
            let row = &rows[if sweep % 2 == 0 { step } else { rows.len() - 1 - step }];
            // Blocks of touching cells: the position of the first, the weight, the number of cells.
            let mut blocks: Vec<(f64, f64, usize)> = Vec::new();
            let mut offsets = Vec::with_capacity(row.len());
            for (at, &cell) in row.iter().enumerate() {
                let offset = match at.checked_sub(1) {
                    Some(before) => offsets[before] + apart(&cells[row[before]], &cells[cell]),
                    None => 0.0,
                };
                offsets.push(offset);
                let (wanted, weight) = wanted(&cells[cell], cells, sweep % 2 == 0);
                let mut block = (wanted - offset, weight, 1);
                while let Some(before) = blocks.pop_if(|before| before.0 > block.0) {
                    let weight = before.1 + block.1;
                    let at = (before.0 * before.1 + block.0 * block.1) / weight;
                    block = (at, weight, before.2 + block.2);
                }
                blocks.push(block);
            }
            let starts = blocks.iter().flat_map(|&(start, _, count)| std::iter::repeat_n(start, count));
            for ((&cell, start), offset) in row.iter().zip(starts).zip(offsets) {
                cells[cell].x = start + offset;
            }
        }
    }
}

/// The position that a cell would have alone in its row, and its weight. A node: in the middle of its neighbours. A
/// line: straight on from the row that was moved before, so that a long line has few bends.
fn wanted(cell: &Cell, cells: &[Cell], is_down: bool) -> (f64, f64) {
    let all = cell.near.iter().map(|(_, weight)| weight).sum();
    let before = |other: usize| cell.is_node || (cells[other].row < cell.row) == is_down;
    let near = cell.near.iter().filter(|(other, _)| before(*other));
    let (sum, weight) = near.fold((0.0, 0.0), |(s, w), (other, own)| (s + cells[*other].x * own, w + own));
    (sum / weight, all)
}

/// The middle of each row, and the end of the last one. Rows are further apart if lines between them go far to the
/// side.
fn heights(rows: &[Vec<usize>], cells: &[Cell]) -> (Vec<f64>, f64) {
    let (mut middles, mut y) = (Vec::with_capacity(rows.len()), MARGIN);
    for row in rows {
        let half = row.first().map_or(0.0, |&cell| cells[cell].half_height());
        middles.push(y + half);
        let aside = |&cell: &usize| {
            let here = &cells[cell];
            let below =
                here.near.iter().map(|(other, _)| &cells[*other]).filter(|other| other.row > here.row);
            below.map(|other| (other.x - here.x).abs()).fold(0.0, f64::max)
        };
        let gap = (row.iter().map(aside).fold(0.0, f64::max) * 0.15).clamp(GAP.0, GAP.1);
        y += if row.is_empty() { 0.0 } else { 2.0 * half + gap };
    }
    // Nodes without lines have the first row, also in a graph without lines.
    if middles.is_empty() {
        middles.push(y);
    }
    (middles, y)
}

fn runs(cells: &[Cell], chains: &[Chain], lines: &[Line], middles: &[f64]) -> Vec<Run> {
    // At a node, lines are side by side in the order in which they leave.
    let mut sides: Vec<[Vec<(f64, usize)>; 2]> = cells.iter().map(|_| [Vec::new(), Vec::new()]).collect();
    for (line, chain) in chains.iter().enumerate() {
        if let ([upper, second, ..], [.., before, lower]) = (&chain.cells[..], &chain.cells[..]) {
            sides[*upper][1].push((cells[*second].x, line));
            sides[*lower][0].push((cells[*before].x, line));
        }
    }
    let mut ports = vec![[0.0; 2]; chains.len()];
    for (cell, both) in cells.iter().zip(&mut sides) {
        for (side, all) in both.iter_mut().enumerate() {
            all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            #[expect(clippy::cast_precision_loss, reason = "places in a picture")]
            for (at, (_, line)) in all.iter().enumerate() {
                let (at, count) = (at as f64, all.len() as f64);
                let apart = PORT.min((cell.width - 12.0) / count);
                ports[*line][side] = cell.x + (at - (count - 1.0) / 2.0) * apart;
            }
        }
    }
    let run = |(at, chain): (usize, &Chain)| {
        let mut points = Vec::with_capacity(2 * chain.cells.len());
        for &cell in &chain.cells {
            let (here, y) = (&cells[cell], middles[cells[cell].row]);
            let (top, bottom) = (y - here.half_height(), y + here.half_height());
            if !here.is_node {
                points.extend([(here.x, top), (here.x, bottom)]);
            } else if points.is_empty() {
                points.push((ports[at][1], bottom));
            } else {
                points.push((ports[at][0], top));
            }
        }
        if cells[lines[at].from].row > cells[lines[at].to].row {
            points.reverse();
        }
        let label = &cells[chain.label];
        Run { points, label: (label.x, middles[label.row]) }
    };
    chains.iter().enumerate().map(run).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Left, top, right, bottom.
    type Area = [f64; 4];

    fn area((x, y): Point, width: f64, height: f64) -> Area {
        [x - width / 2.0, y - height / 2.0, x + width / 2.0, y + height / 2.0]
    }

    fn meet(a: &Area, b: &Area) -> bool {
        a[0] < b[2] - 0.01 && b[0] < a[2] - 0.01 && a[1] < b[3] - 0.01 && b[1] < a[3] - 0.01
    }

    proptest! {
        /// Nothing overlaps, no line runs through a node or another label, and everything is in the picture.
        #[test]
        fn everything_has_its_place(
            widths in prop::collection::vec(40.0..140.0_f64, 1..14),
            lines in prop::collection::vec((0..14_usize, 0..14_usize, 10.0..90.0_f64), 0..24),
        ) {
            let count = widths.len();
            let lines: Vec<_> = lines
                .into_iter()
                .map(|(from, to, label)| Line { from: from % count, to: to % count, label })
                .filter(|line| line.from != line.to)
                .collect();
            let Layout { nodes, runs, size } = lay_out(&widths, &lines);
            let boxes: Vec<_> = nodes.iter().zip(&widths).map(|(at, width)| area(*at, *width, NODE)).collect();
            let labels: Vec<_> =
                runs.iter().zip(&lines).map(|(run, line)| area(run.label, line.label, LABEL)).collect();
            let all: Vec<_> = boxes.iter().chain(&labels).collect();
            for (at, one) in all.iter().enumerate() {
                prop_assert!(one.iter().all(|number| number.is_finite()));
                prop_assert!(one[0] >= 0.0 && one[1] >= 0.0 && one[2] <= size.0 && one[3] <= size.1, "{one:?} {size:?}");
                prop_assert!(all[..at].iter().all(|other| !meet(one, other)), "{one:?}");
            }
            for (own, (run, line)) in runs.iter().zip(&lines).enumerate() {
                let (first, last) = (run.points[0], *run.points.last().unwrap());
                prop_assert!((first.0 - nodes[line.from].0).abs() < widths[line.from] / 2.0);
                prop_assert!((last.0 - nodes[line.to].0).abs() < widths[line.to] / 2.0);
                for pair in run.points.windows(2) {
                    // A curve stays between its ends; where it passes a row it is straight.
                    let [(x, a), (_, b)] = [pair[0], pair[1]];
                    let piece = [x, a.min(b) + 0.1, x + 0.1, a.max(b) - 0.1];
                    if (pair[0].0 - pair[1].0).abs() < 0.05 {
                        prop_assert!(boxes.iter().all(|node| !meet(&piece, node)), "{piece:?}");
                        let others = labels.iter().enumerate().filter(|(at, _)| *at != own);
                        prop_assert!(others.into_iter().all(|(_, label)| !meet(&piece, label)), "{piece:?}");
                    } else {
                        let between = [f64::NEG_INFINITY, piece[1], f64::INFINITY, piece[3]];
                        prop_assert!(all.iter().all(|other| !meet(&between, other)), "{between:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_long_chain_and_a_wide_fan_are_laid_out() {
        let chain: Vec<_> = (1..400).map(|to| Line { from: to - 1, to, label: 20.0 }).collect();
        let fan: Vec<_> = (1..400).map(|to| Line { from: 0, to, label: 20.0 }).collect();
        let rows = |lines: &[Line]| {
            let mut ys: Vec<_> = lay_out(&[60.0; 400], lines).nodes.iter().map(|(_, y)| *y).collect();
            ys.sort_by(f64::total_cmp);
            ys.dedup();
            ys.len()
        };
        assert_eq!((rows(&chain), rows(&fan), rows(&[chain.clone(), fan.clone()].concat())), (400, 2, 400));
    }
}
