//! Reads what clients send: bodies, numbers in paths, queries.

use std::str::FromStr;

use axum::extract::Request;
use axum::http::{StatusCode, header};
use http_body_util::{BodyExt as _, LengthLimitError, Limited};
use serde::de::DeserializeOwned;

use super::{Bounds, Problem};
use crate::hangar::InstanceId;

/// The JSON of a request's body.
///
/// # Errors
/// It is none, or too long, or takes too long to come, or says what cannot be.
pub(super) async fn json<T: DeserializeOwned>(
    request: Request,
    bounds: Bounds,
) -> Result<T, Problem> {
    let kind = request.headers().get(header::CONTENT_TYPE);
    let kind = kind.and_then(|kind| kind.to_str().ok()).unwrap_or_default();
    let essence = kind.split(';').next().unwrap_or_default().trim();
    if !essence.eq_ignore_ascii_case("application/json") {
        let error = format!("the body is said to be `{essence}`; expected application/json");
        return Err(Problem::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, error)
            .hint("send the header `Content-Type: application/json`"));
    }
    let bytes = read(request, bounds).await?;
    serde_json::from_slice(&bytes).map_err(|error| {
        Problem::new(StatusCode::BAD_REQUEST, format!("the body: {error}"))
            .hint("GET /openapi.json describes what is expected")
    })
}

async fn read(request: Request, bounds: Bounds) -> Result<Vec<u8>, Problem> {
    let too_long = || {
        let error = format!("the body is longer than {} bytes", bounds.request_bytes);
        Problem::new(StatusCode::PAYLOAD_TOO_LARGE, error)
    };
    let told = request.headers().get(header::CONTENT_LENGTH);
    let told = told.and_then(|len| len.to_str().ok()?.parse::<u64>().ok());
    if told.is_some_and(|len| len > bounds.request_bytes as u64) {
        return Err(too_long());
    }
    let body = Limited::new(request.into_body(), bounds.request_bytes);
    match tokio::time::timeout(bounds.body, body.collect()).await {
        Ok(Ok(all)) => Ok(all.to_bytes().to_vec()),
        Ok(Err(error)) if error.is::<LengthLimitError>() => Err(too_long()),
        Ok(Err(error)) => {
            let error = format!("the body does not come: {error}");
            Err(Problem::new(StatusCode::BAD_REQUEST, error))
        }
        Err(_) => {
            let error = format!("the body has not come within {:?}", bounds.body);
            Err(Problem::new(StatusCode::REQUEST_TIMEOUT, error))
        }
    }
}

/// An instance's number, as it stands in a path.
pub(super) fn id(text: &str) -> Result<InstanceId, Problem> {
    text.parse().map_err(|_| {
        let error = format!("`{text}` is no instance: expected a number from 1 to 65535");
        Problem::new(StatusCode::BAD_REQUEST, error)
    })
}

/// A number of the query. The query knows no other names than those `known`.
pub(super) fn number<T: FromStr>(
    request: &Request,
    name: &str,
    known: &[&str],
) -> Result<Option<T>, Problem> {
    let query = request.uri().query().unwrap_or_default();
    let refuse = |error: String| Problem::new(StatusCode::BAD_REQUEST, error);
    let mut found = None;
    for pair in query.split('&').filter(|pair| !pair.is_empty()) {
        let (key, value) = pair.split_once('=').unwrap_or((pair, ""));
        if !known.contains(&key) {
            let error = format!(
                "the query: `{key}` is unknown, expected {}",
                known.join(", ")
            );
            return Err(refuse(error));
        }
        if key == name {
            let number = value.parse();
            found = Some(number.map_err(|_| {
                refuse(format!(
                    "the query: `{value}` is no number that {name} can be"
                ))
            })?);
        }
    }
    Ok(found)
}
