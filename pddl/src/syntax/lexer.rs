//! Text to tokens, with nom.
//!
//! The lexer works on bytes. Every byte that ends a word is ASCII, so a token never splits a UTF-8
//! character, and bytes above 127 belong to a word or a comment. The lexer reports no errors: an invalid
//! name is still a word, and lowering reports what it expected there.
//!
//! It follows how people write: `-type` and `-2d` are a hyphen and a name, `<?x` an operator and a variable,
//! `?x?y` two variables. Cost: one pass, no backtracking over more than one word.

use nom::branch::alt;
use nom::bytes::complete::{tag, take, take_while, take_while1};
use nom::combinator::{map, recognize, value};
use nom::sequence::pair;
use nom::{IResult, Parser};

use super::token::TokenKind;

const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// The length of the first token of `input`, which is not empty, and its kind.
pub(super) fn first_token(input: &[u8]) -> (usize, TokenKind) {
    match token(input) {
        Ok((rest, kind)) => (input.len() - rest.len(), kind),
        // The alternatives accept every byte; this arm makes the function total.
        Err(_) => (1, TokenKind::Name),
    }
}

/// The next token; its first byte says which kind it is.
fn token(input: &[u8]) -> IResult<&[u8], TokenKind> {
    match input.first() {
        Some(b'(') => value(TokenKind::Open, take(1usize)).parse(input),
        Some(b')') => value(TokenKind::Close, take(1usize)).parse(input),
        Some(b'?') => value(TokenKind::Variable, pair(take(1usize), take_while(is_word))).parse(input),
        Some(b':') => value(TokenKind::Keyword, pair(take(1usize), take_while(is_word))).parse(input),
        Some(b';') => value(TokenKind::Comment, take_while(|b| b != b'\n' && b != b'\r')).parse(input),
        Some(b'<' | b'=' | b'>') => {
            value(TokenKind::Name, take_while1(|b| matches!(b, b'<' | b'=' | b'>'))).parse(input)
        }
        Some(b'-') => hyphen(input),
        Some(&byte) if is_blank(byte) => value(TokenKind::Whitespace, take_while1(is_blank)).parse(input),
        _ => alt((value(TokenKind::Whitespace, tag(BYTE_ORDER_MARK)), word)).parse(input),
    }
}

fn word(input: &[u8]) -> IResult<&[u8], TokenKind> {
    let kind = |word| if is_number(word) { TokenKind::Number } else { TokenKind::Name };
    map(take_while1(is_word), kind).parse(input)
}

/// A hyphen that does not start a number stands alone: no name starts with one.
fn hyphen(input: &[u8]) -> IResult<&[u8], TokenKind> {
    let (rest, word) = recognize(pair(tag(&b"-"[..]), take_while(is_word))).parse(input)?;
    Ok(if is_number(word) { (rest, TokenKind::Number) } else { (&input[1..], TokenKind::Name) })
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | 0x0B | 0x0C)
}

fn is_word(byte: u8) -> bool {
    !is_blank(byte) && !matches!(byte, b'(' | b')' | b';' | b'?')
}

/// Whether the whole word is a finite decimal number. `1-2`, `3d` and `0x1` are names.
fn is_number(word: &[u8]) -> bool {
    let unsigned = word.strip_prefix(b"-").or_else(|| word.strip_prefix(b"+")).unwrap_or(word);
    let starts = match unsigned {
        [b'.', digit, ..] => digit.is_ascii_digit(),
        [digit, ..] => digit.is_ascii_digit(),
        [] => false,
    };
    starts
        && unsigned.iter().all(|b| b.is_ascii_digit() || matches!(b, b'.' | b'e' | b'E' | b'-' | b'+'))
        && std::str::from_utf8(word).ok().and_then(|w| w.parse::<f64>().ok()).is_some_and(f64::is_finite)
}

#[cfg(test)]
mod tests {
    use super::TokenKind;
    use crate::syntax::Tokens;

    fn kinds(text: &str) -> Vec<(TokenKind, &str)> {
        Tokens::of(text)
            .filter(|(k, _)| *k != TokenKind::Whitespace)
            .map(|(k, s)| (k, &text[s.range()]))
            .collect()
    }

    #[test]
    fn words_by_their_kind() {
        use TokenKind::{Comment, Keyword, Name, Number, Variable};
        assert_eq!(
            kinds("at ?x :init 5 -1.5 .5 1e-3 3d 1-2 -t -2d <?y ?a?b 1e999 ;ü\r\n- <= x"),
            [
                (Name, "at"),
                (Variable, "?x"),
                (Keyword, ":init"),
                (Number, "5"),
                (Number, "-1.5"),
                (Number, ".5"),
                (Number, "1e-3"),
                (Name, "3d"),
                (Name, "1-2"),
                (Name, "-"),
                (Name, "t"),
                (Name, "-"),
                (Name, "2d"),
                (Name, "<"),
                (Variable, "?y"),
                (Variable, "?a"),
                (Variable, "?b"),
                (Name, "1e999"),
                (Comment, ";ü"),
                (Name, "-"),
                (Name, "<="),
                (Name, "x"),
            ]
        );
    }
}
