//! JSON-RPC 2.0, as far as the Model Context Protocol uses it: one message per line.

use serde_json::{Map, Value, json};

/// The fields of a message's `params`.
pub type Params = Map<String, Value>;

/// The error codes of JSON-RPC that a server uses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RpcCode {
    NotJson = -32700,
    InvalidRequest = -32600,
    UnknownMethod = -32601,
    InvalidParams = -32602,
}

/// A message of the client.
#[derive(Debug, Clone, PartialEq)]
pub enum Incoming {
    Request(RpcRequest),
    Notification {
        method: String,
        params: Params,
    },
    /// An answer; it is ignored, because the server requests nothing.
    Answer,
}

/// A request, which needs exactly one answer.
#[derive(Debug, Clone, PartialEq)]
pub struct RpcRequest {
    /// A string or a number.
    pub id: Value,
    pub method: String,
    pub params: Params,
}

/// Reads a line of JSON-RPC.
///
/// # Errors
/// The line is not a valid message; the error is the answer to send.
pub fn read(line: &[u8]) -> Result<Incoming, Value> {
    let value: Value = serde_json::from_slice(line)
        .map_err(|fault| error(Value::Null, RpcCode::NotJson, &format!("not JSON: {fault}")))?;
    let Value::Object(mut fields) = value else {
        let message = "expected one object per line; batches are not supported";
        return Err(error(Value::Null, RpcCode::InvalidRequest, message));
    };
    let method = fields.remove("method");
    if method.is_none() && (fields.contains_key("result") || fields.contains_key("error")) {
        return Ok(Incoming::Answer);
    }
    let given_id = fields.remove("id");
    let id = given_id.clone().filter(is_name);
    let refuse = |code, message| error(id.clone().unwrap_or_default(), code, message);
    if fields.get("jsonrpc").and_then(Value::as_str) != Some("2.0") {
        return Err(refuse(RpcCode::InvalidRequest, "`jsonrpc` must be \"2.0\""));
    }
    if id.is_none() && given_id.is_some() {
        let message = "`id` must be a string or a number";
        return Err(refuse(RpcCode::InvalidRequest, message));
    }
    let Some(Value::String(method)) = method else {
        let message = "`method` must be a string";
        return Err(refuse(RpcCode::InvalidRequest, message));
    };
    let params = match fields.remove("params") {
        None => Params::new(),
        Some(Value::Object(params)) => params,
        Some(_) if id.is_none() => Params::new(),
        Some(_) => return Err(refuse(RpcCode::InvalidParams, "`params` must be an object")),
    };
    Ok(match id {
        Some(id) => Incoming::Request(RpcRequest { id, method, params }),
        None => Incoming::Notification { method, params },
    })
}

/// Whether a value is valid as the id of a request or as a progress token.
pub fn is_name(value: &Value) -> bool {
    value.is_string() || value.is_number()
}

/// The answer to a request that was carried out.
pub fn result(id: Value, content: Value) -> Value {
    let mut answer = json!({"jsonrpc": "2.0"});
    answer["id"] = id;
    answer["result"] = content;
    answer
}

/// The answer to a request that cannot be carried out; `id` is null if the request's id could not
/// be read.
pub fn error(id: Value, code: RpcCode, message: &str) -> Value {
    let mut answer = json!({"jsonrpc": "2.0", "error": {"code": code as i32, "message": message}});
    answer["id"] = id;
    answer
}
