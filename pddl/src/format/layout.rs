//! The second pass: writes the pieces, with a stack of the lists that are open and broken.
//!
//! Invariant that makes formatting idempotent: the output has a line end where the pass followed one of the
//! author's, and a line end that it writes for lack of room is one that it follows the next time.

use super::comments::{Trailing, align};
use super::measure::{List, Measured, WIDTH};
use super::rules::{Rules, Shape};
use crate::syntax::TokenKind;

/// Where the parts of a broken list go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Style {
    /// Outside of all lists.
    Top,
    /// Each on its own line.
    Rows,
    /// Each key on its own line.
    Keys,
    /// The author's lines, two columns in.
    Block,
    /// The author's lines, below the first argument.
    Aligned,
}

/// What starts a new line in a block, besides the author's line ends and a lack of room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Split {
    Nothing,
    EveryPart,
    EveryType,
}

/// A list that is open and broken.
struct Frame {
    style: Style,
    split: Split,
    beside: u32,
    /// The first part from which a hyphen separates a name from its type.
    types_from: u32,
    /// Whether the first part is a head, so that alignment is below the second part.
    headed: bool,
    /// The column of its lines, if its parts have lines of their own.
    indent: usize,
    /// The column of its closing parenthesis if that cannot stand behind its last part.
    base: usize,
    /// Parts so far.
    parts: u32,
    /// Line ends written in it so far.
    rows: u32,
    /// For keys: whether there was one, and the number of parts since.
    key: Option<u32>,
    /// The part before was a hyphen.
    hyphen: bool,
    /// The part before was the type behind one.
    typed: bool,
    /// The part before took more than a line.
    tall: bool,
}

impl Frame {
    fn top() -> Self {
        Self {
            style: Style::Top,
            split: Split::Nothing,
            beside: 0,
            types_from: u32::MAX,
            headed: false,
            indent: 0,
            base: 0,
            parts: 0,
            rows: 0,
            key: None,
            hyphen: false,
            typed: false,
            tall: false,
        }
    }

    /// A list that opens in column `column` and belongs to a key in column `key`.
    fn of(list: &List, column: usize, key: Option<usize>) -> Self {
        let Rules { shape, beside, .. } = list.rules;
        let junction = shape == Shape::Junction && (list.opened || !list.broken);
        let (style, split) = match shape {
            Shape::Define | Shape::Body | Shape::Wrapper => (Style::Rows, Split::Nothing),
            Shape::Junction if junction => (Style::Rows, Split::Nothing),
            Shape::Keyed => (Style::Keys, Split::Nothing),
            Shape::Section if beside > 1 || list.opened => (Style::Block, Split::Nothing),
            Shape::Section if !list.broken && !list.rules.is_flags => {
                let by_part = if list.holds_lists { Split::EveryPart } else { Split::EveryType };
                (Style::Block, by_part)
            }
            Shape::Section | Shape::Junction | Shape::Term | Shape::Plain => (Style::Aligned, Split::Nothing),
        };
        let base = if junction { key.unwrap_or(column) } else { column };
        let headed = shape != Shape::Plain;
        let aligned = style == Style::Aligned && headed;
        Self {
            style,
            split,
            beside: if aligned { 2 } else { beside },
            types_from: list.rules.types_from(),
            headed,
            indent: base + if headed { 2 } else { 1 },
            base,
            ..Self::top()
        }
    }
}

/// The separator between two pieces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Gap {
    None,
    Blank,
    Line(usize),
}

struct Writer<'m> {
    measured: &'m Measured<'m>,
    text: String,
    column: usize,
    /// A comment was written: the line is complete.
    ended: bool,
    paragraph: usize,
    stack: Vec<Frame>,
    comments: Vec<Trailing>,
}

pub(super) fn layout(measured: &Measured<'_>) -> String {
    let mut writer = Writer {
        measured,
        text: String::with_capacity(measured.text.len() + measured.text.len() / 8),
        column: 0,
        ended: false,
        paragraph: 0,
        stack: vec![Frame::top()],
        comments: Vec::new(),
    };
    let mut index = 0;
    while index < measured.pieces.len() {
        index = match measured.pieces[index].kind {
            TokenKind::Comment => writer.comment(index),
            TokenKind::Close => writer.close(index),
            _ => writer.part(index),
        };
    }
    if !writer.text.is_empty() {
        writer.text.push('\n');
    }
    align(&writer.text, &writer.comments)
}

impl Writer<'_> {
    fn frame(&mut self) -> &mut Frame {
        self.stack.last_mut().expect("the outermost frame is never popped")
    }

    fn line(&mut self, column: usize, empty_above: bool) {
        if !self.text.is_empty() {
            self.text.push('\n');
            if empty_above {
                self.text.push('\n');
                self.paragraph += 1;
            }
        }
        self.text.extend(std::iter::repeat_n(' ', column));
        self.column = column;
        self.ended = false;
    }

    /// A new line for the piece at `index`, with the empty line that the author had above it.
    fn line_for(&mut self, index: usize, column: usize) {
        let frame = self.frame();
        let after_head = frame.rows == 0 && frame.style != Style::Top && frame.parts <= frame.beside;
        let defined = frame.style == Style::Rows && frame.base == 0 && frame.parts >= 2;
        frame.rows += 1;
        let empty = self.measured.pieces[index].lines > 1 && (!after_head || defined);
        self.line(column, empty);
    }

    fn comment(&mut self, index: usize) -> usize {
        let piece = self.measured.pieces[index];
        let comment = self.measured.text_of(index).trim_end();
        if piece.lines == 0 && index > 0 {
            let before = self.measured.pieces[index - 1].span.end;
            let (at, column, paragraph) = (self.text.len(), self.column, self.paragraph);
            self.comments.push(Trailing::new(self.measured.text, piece.span, before, at, column, paragraph));
        } else {
            let frame = self.frame();
            let value = frame.key == Some(0);
            let column = frame.indent + if value { 2 } else { 0 };
            self.line_for(index, column);
        }
        self.text.push_str(comment);
        self.ended = true;
        index + 1
    }

    fn close(&mut self, index: usize) -> usize {
        if self.ended {
            let base = self.frame().base;
            self.frame().rows += 1;
            self.line(base, false);
        }
        self.text.push(')');
        self.column += 1;
        if self.stack.len() > 1 {
            let tall = self.stack.pop().is_some_and(|frame| frame.rows > 0);
            let frame = self.frame();
            frame.tall |= tall;
            // A list is tall if a list in it is.
            frame.rows += u32::from(tall && frame.style != Style::Top);
        }
        index + 1
    }

    /// Writes an atom or a list that fits, or opens one that does not.
    fn part(&mut self, index: usize) -> usize {
        let measured = self.measured;
        let top = self.stack.len() == 1;
        let gap = self.gap(index);
        match gap {
            Gap::None => {}
            Gap::Blank => {
                self.text.push(' ');
                self.column += 1;
            }
            Gap::Line(column) => self.line_for(index, column),
        }
        let column = self.column;
        let is_key = measured.pieces[index].kind == TokenKind::Keyword;
        let hyphen = measured.is_hyphen(index);
        let frame = self.frame();
        if frame.style == Style::Aligned && frame.headed && frame.parts == 1 && gap == Gap::Blank {
            frame.indent = column;
        }
        let of_key = match frame.style {
            Style::Keys if frame.key.is_some() && gap == Gap::Blank => Some(frame.indent),
            Style::Block if frame.parts == 1 && frame.beside == 2 && gap == Gap::Blank => Some(frame.base),
            _ => None,
        };
        if is_key && frame.parts > 0 {
            frame.key = Some(0);
        } else if let Some(values) = &mut frame.key {
            *values += 1;
        }
        frame.typed = frame.hyphen;
        frame.hyphen = hyphen && frame.parts >= frame.types_from;
        frame.tall = false;
        frame.parts += 1;
        if let Some(list) = measured.list(index) {
            let step = top && !list.holds_lists && !list.forced;
            if list.forced || !(step || column + measured.width(index, list.close) <= WIDTH) {
                self.stack.push(Frame::of(list, column, of_key));
                self.text.push('(');
                self.column += 1;
                return index + 1;
            }
            self.flat(index, list.close);
            return list.close + 1;
        }
        self.flat(index, index);
        index + 1
    }

    /// Writes pieces on one line.
    fn flat(&mut self, first: usize, last: usize) {
        let mut after_open = true;
        for index in first..=last {
            let kind = self.measured.pieces[index].kind;
            if !after_open && kind != TokenKind::Close {
                self.text.push(' ');
            }
            self.text.push_str(self.measured.text_of(index));
            after_open = kind == TokenKind::Open;
        }
        let (start, end) = (&self.measured.pieces[first], &self.measured.pieces[last]);
        self.column += self.measured.text_of(first).chars().count() + end.end - start.end;
    }

    /// Whether the part at `index`, with the type after it, fits on a line in `column`.
    fn fits(&self, index: usize, column: usize) -> bool {
        let measured = self.measured;
        let mut last = measured.last_of(index);
        let forced = measured.list(index).is_some_and(|list| list.forced);
        let behind = |i: usize| measured.pieces.get(i).is_some_and(|p| p.kind != TokenKind::Close);
        if behind(last + 1) && measured.is_hyphen(last + 1) && behind(last + 2) {
            last = measured.last_of(last + 2);
        }
        !forced && column + measured.width(index, last) <= WIDTH
    }

    fn gap(&self, index: usize) -> Gap {
        let frame = self.stack.last().expect("the outermost frame is never popped");
        let piece = &self.measured.pieces[index];
        let line = Gap::Line(frame.indent);
        if self.ended {
            let value = frame.key == Some(0) && piece.kind != TokenKind::Keyword;
            return Gap::Line(frame.indent + if value { 2 } else { 0 });
        }
        if frame.style == Style::Top {
            return self.gap_outside(index, frame);
        }
        if frame.parts == 0 {
            return Gap::None;
        }
        if frame.hyphen || (frame.parts >= frame.types_from && self.measured.is_hyphen(index)) {
            return Gap::Blank;
        }
        let kept = piece.lines > 0 || frame.tall;
        match frame.style {
            Style::Keys if piece.kind == TokenKind::Keyword => line,
            Style::Keys => match frame.key {
                None if kept && frame.parts >= frame.beside => line,
                None => Gap::Blank,
                Some(0) if self.is_better_below(index, frame.indent + 2) => Gap::Line(frame.indent + 2),
                Some(0) => Gap::Blank,
                Some(_) if kept || !self.fits(index, self.column + 1) => Gap::Line(frame.indent + 2),
                Some(_) => Gap::Blank,
            },
            _ if frame.parts < frame.beside => Gap::Blank,
            Style::Rows => line,
            Style::Block if frame.parts == frame.beside => line,
            _ => {
                let split = match frame.split {
                    Split::Nothing => false,
                    Split::EveryPart => true,
                    Split::EveryType => frame.typed,
                };
                if kept || split || !self.fits(index, self.column + 1) { line } else { Gap::Blank }
            }
        }
    }

    /// Whether a key's value fits on a line of its own and not beside the key.
    fn is_better_below(&self, index: usize, column: usize) -> bool {
        self.measured.list(index).is_some_and(|list| list.rules.shape != Shape::Junction)
            && !self.fits(index, self.column + 1)
            && self.fits(index, column)
    }

    fn gap_outside(&self, index: usize, frame: &Frame) -> Gap {
        let piece = &self.measured.pieces[index];
        let defines = self.measured.list(index).is_some_and(|list| list.rules.shape == Shape::Define);
        if index == 0 {
            Gap::None
        } else if piece.lines > 0 || frame.tall || defines {
            Gap::Line(0)
        } else if piece.glued
            && piece.kind != TokenKind::Open
            && self.measured.pieces[index - 1].kind != TokenKind::Close
        {
            Gap::None
        } else {
            Gap::Blank
        }
    }
}
