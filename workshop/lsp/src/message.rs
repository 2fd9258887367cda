//! Parses a frame's bytes as a message of JSON-RPC.
//!
//! Problem: a malformed message must be answered too, with its id if it has one; `lsp_server::Message` as a
//! serde type only says that no variant matches. Idea: read JSON first, then look at which of `id`,
//! `method`, `result` and `error` are present. Source: JSON-RPC 2.0, §4 and §5.

use lsp_server::{ErrorCode, Message, Notification, Request, RequestId, Response};
use serde_json::Value;

/// The bytes of a frame are not a valid message.
#[derive(Clone, Debug)]
pub(crate) struct Malformed {
    /// The id of the request that it may have been.
    pub(crate) id: Option<RequestId>,
    pub(crate) code: ErrorCode,
    /// The reason, for the client's log.
    pub(crate) reason: String,
}

/// The message in a frame.
///
/// # Errors
/// What is wrong with it, in the form of its answer.
pub(crate) fn parse(body: &[u8]) -> Result<Message, Malformed> {
    let value: Value = serde_json::from_slice(body).map_err(|error| Malformed {
        id: None,
        code: ErrorCode::ParseError,
        reason: format!("a message is not JSON: {error}"),
    })?;
    let Value::Object(mut fields) = value else {
        return Err(invalid(None, "a message is not an object"));
    };
    let given_id = fields.remove("id");
    let id = match &given_id {
        None | Some(Value::Null) => None,
        Some(id) => match serde_json::from_value::<RequestId>(id.clone()) {
            Ok(id) => Some(id),
            Err(_) => return Err(invalid(None, "an id is neither a string nor a 32 bit integer")),
        },
    };
    let params = fields.remove("params").unwrap_or_default();
    match (fields.remove("method"), id) {
        (Some(Value::String(method)), Some(id)) => Ok(Request { id, method, params }.into()),
        (Some(Value::String(method)), None) if given_id.is_none() => {
            Ok(Notification { method, params }.into())
        }
        (Some(_), id) => Err(invalid(id, "a method is not a string, or a request has no id")),
        (None, Some(id)) => match (fields.remove("result"), fields.remove("error")) {
            (Some(result), None) => Ok(Response::new_ok(id, result).into()),
            (_, Some(error)) => Ok(refused(id, &error).into()),
            (None, None) => Err(invalid(Some(id), "a message has neither method nor result nor error")),
        },
        // The client could not read a request of the server; the protocol has no answer to that.
        (None, None) => Err(invalid(None, "a message has neither method nor id")),
    }
}

fn refused(id: RequestId, error: &Value) -> Response {
    let code = error.get("code").and_then(Value::as_i64).and_then(|code| i32::try_from(code).ok());
    let message = error.get("message").and_then(Value::as_str).unwrap_or_default();
    Response::new_err(id, code.unwrap_or(ErrorCode::UnknownErrorCode as i32), message.to_owned())
}

fn invalid(id: Option<RequestId>, reason: &str) -> Malformed {
    Malformed { id, code: ErrorCode::InvalidRequest, reason: reason.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};
    use proptest::prelude::*;

    fn check(body: &str, expected: &Expect) {
        let said = match parse(body.as_bytes()) {
            Ok(message) => serde_json::to_string(&message).expect("it is JSON"),
            Err(Malformed { id, code, reason }) => format!("{id:?} {code:?} {reason}"),
        };
        expected.assert_eq(&said);
    }

    #[test]
    fn messages_are_told_apart() {
        check(r#"{"id":1,"method":"a","params":{}}"#, &expect![[r#"{"id":1,"method":"a","params":{}}"#]]);
        check(r#"{"id":"x","method":"a"}"#, &expect![[r#"{"id":"x","method":"a"}"#]]);
        check(r#"{"method":"a","params":null}"#, &expect![[r#"{"method":"a"}"#]]);
        check(r#"{"id":1,"result":null}"#, &expect![[r#"{"id":1,"result":null}"#]]);
        check(
            r#"{"id":1,"error":{"code":-1,"message":"no"}}"#,
            &expect![[r#"{"id":1,"error":{"code":-1,"message":"no"}}"#]],
        );
    }

    #[test]
    fn what_is_none_says_why() {
        check(
            r#"{"id":1,"#,
            &expect!["None ParseError a message is not JSON: EOF while parsing a value at line 1 column 8"],
        );
        check("[]", &expect!["None InvalidRequest a message is not an object"]);
        check(
            r#"{"id":7,"method":3}"#,
            &expect![[
                r#"Some(RequestId(I32(7))) InvalidRequest a method is not a string, or a request has no id"#
            ]],
        );
        check(
            r#"{"id":1.5,"method":"a"}"#,
            &expect!["None InvalidRequest an id is neither a string nor a 32 bit integer"],
        );
        check(
            r#"{"id":null,"method":"a"}"#,
            &expect!["None InvalidRequest a method is not a string, or a request has no id"],
        );
        check(
            r#"{"id":1}"#,
            &expect![[
                r#"Some(RequestId(I32(1))) InvalidRequest a message has neither method nor result nor error"#
            ]],
        );
    }

    proptest! {
        #[test]
        fn anything_is_read_or_refused(body in proptest::collection::vec(any::<u8>(), 0..60)) {
            let _ = parse(&body);
        }
    }
}
