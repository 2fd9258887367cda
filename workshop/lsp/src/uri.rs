//! URIs of documents, and the paths in them.
//!
//! Problem: clients write the same file in several ways (`file:///c%3A/a%20b`, `file:///C:/a b`), and a
//! document need not be a file (`untitled:Untitled-1`). Idea: the key of a document is its path,
//! `/`-separated and decoded, or its whole URI if it is not a file. `documents` remembers the client's
//! spelling of an open document and returns it unchanged. Invariant: `path(uri_of(path))` is the path.
//! Source: RFC 3986 and RFC 8089.

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};

/// Characters that are not escaped in a path.
const ENCODED: &AsciiSet = &NON_ALPHANUMERIC
    .remove(b'/')
    .remove(b'-')
    .remove(b'_')
    .remove(b'.')
    .remove(b'~')
    .remove(b'+')
    .remove(b'@');

/// The key of a document: the path of a file, or the whole URI of anything else.
pub(crate) fn path(uri: &str) -> String {
    let Some(rest) = uri.strip_prefix("file://") else { return uri.to_owned() };
    // `file://localhost/x` is `/x`; any other host stays in the path, as in Windows.
    let rest = match rest.strip_prefix("localhost/") {
        Some(rest) => format!("/{rest}"),
        None if rest.starts_with('/') => rest.to_owned(),
        None => format!("//{rest}"),
    };
    let rest = rest.split(['?', '#']).next().unwrap_or(&rest);
    let decoded: Vec<u8> = percent_decode_str(rest).collect();
    let decoded = String::from_utf8(decoded).unwrap_or_else(|_| rest.to_owned());
    without_slash_before_drive(&decoded)
}

/// `/c:/x` is `C:/x`: Windows ignores the case of drives, and clients disagree about it.
fn without_slash_before_drive(path: &str) -> String {
    match path.as_bytes() {
        [b'/', drive, b':', ..] if drive.is_ascii_alphabetic() => {
            format!("{}{}", char::from(drive.to_ascii_uppercase()), &path[2..])
        }
        _ => path.to_owned(),
    }
}

/// The URI of a document.
pub(crate) fn uri_of(path: &str) -> String {
    if let Some(shared) = path.strip_prefix("//") {
        let (host, rest) = shared.split_once('/').unwrap_or((shared, ""));
        return format!("file://{host}/{}", utf8_percent_encode(rest, ENCODED));
    }
    if is_file(path) {
        let slash = if path.starts_with('/') { "" } else { "/" };
        return format!("file://{slash}{}", utf8_percent_encode(path, ENCODED));
    }
    path.to_owned()
}

/// Whether a document is a file, so that it can have neighbours.
pub(crate) fn is_file(path: &str) -> bool {
    path.starts_with('/') || matches!(path.as_bytes(), [drive, b':', b'/', ..] if drive.is_ascii_alphabetic())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn clients_disagree_and_mean_the_same() {
        for (uri, expected) in [
            ("file:///a/b.pddl", "/a/b.pddl"),
            ("file://localhost/a/b.pddl", "/a/b.pddl"),
            ("file:///a%20b/%C3%A9.pddl", "/a b/é.pddl"),
            ("file:///a b/é.pddl", "/a b/é.pddl"),
            ("file:///c%3A/x.pddl", "C:/x.pddl"),
            ("file:///C:/x.pddl", "C:/x.pddl"),
            ("file://host/share/x.pddl", "//host/share/x.pddl"),
            ("untitled:Untitled-1", "untitled:Untitled-1"),
            ("file:///100%25/%zz.pddl", "/100%/%zz.pddl"),
        ] {
            assert_eq!(path(uri), expected);
        }
        assert_eq!(uri_of("/a b/é#1.pddl"), "file:///a%20b/%C3%A9%231.pddl");
        assert_eq!(uri_of("C:/x.pddl"), "file:///C%3A/x.pddl");
        assert_eq!(uri_of("untitled:1"), "untitled:1");
        assert!(!is_file("untitled:1"));
    }

    proptest! {
        #[test]
        fn a_path_survives(name in "/[a-z/]?.{0,20}") {
            prop_assume!(!name.starts_with("//") && without_slash_before_drive(&name) == name);
            prop_assert_eq!(path(&uri_of(&name)), name);
        }

        #[test]
        fn any_uri_has_a_path(uri in ".{0,20}") {
            path(&uri);
            path(&format!("file://{uri}"));
        }
    }
}
