//! Parses requests: bodies, numbers in paths, queries.

use axum::extract::{self, FromRequestParts, Path, Request};
use axum::http::request::Parts;
use axum::http::{StatusCode, header};
use http_body_util::{BodyExt as _, LengthLimitError, Limited};
use serde::de::DeserializeOwned;

use super::{ServiceBounds, ServiceProblem};
use crate::hangar::InstanceId;

/// The JSON of a request's body.
///
/// # Errors
/// The body is not JSON, or it is too long, too slow or not valid.
pub(super) async fn json<T: DeserializeOwned>(
    request: Request,
    bounds: ServiceBounds,
) -> Result<T, ServiceProblem> {
    let kind = request
        .headers()
        .get(header::CONTENT_TYPE)
        .and_then(|kind| kind.to_str().ok())
        .unwrap_or_default();
    let essence = kind.split(';').next().unwrap_or_default().trim();
    if !essence.eq_ignore_ascii_case("application/json") {
        let error = format!("the type of the body is `{essence}`; expected application/json");
        return Err(
            ServiceProblem::new(StatusCode::UNSUPPORTED_MEDIA_TYPE, error)
                .hint("send the header `Content-Type: application/json`"),
        );
    }
    let bytes = read(request, bounds).await?;
    // An array would be accepted in place of a struct's named fields.
    if bytes.trim_ascii_start().first() == Some(&b'[') {
        let error = "the body: a list; expected an object at line 1 column 1";
        return Err(ServiceProblem::new(StatusCode::BAD_REQUEST, error));
    }
    serde_json::from_slice(&bytes).map_err(|error| {
        ServiceProblem::new(StatusCode::BAD_REQUEST, format!("the body: {error}"))
            .hint("GET /openapi.json describes what is expected")
    })
}

async fn read(request: Request, bounds: ServiceBounds) -> Result<Vec<u8>, ServiceProblem> {
    let too_long = || {
        let error = format!("the body is longer than {} bytes", bounds.request_bytes);
        ServiceProblem::new(StatusCode::PAYLOAD_TOO_LARGE, error)
    };
    let told = request
        .headers()
        .get(header::CONTENT_LENGTH)
        .and_then(|len| len.to_str().ok()?.parse::<u64>().ok());
    if told.is_some_and(|len| len > bounds.request_bytes as u64) {
        return Err(too_long());
    }
    let body = Limited::new(request.into_body(), bounds.request_bytes);
    match tokio::time::timeout(bounds.body, body.collect()).await {
        Ok(Ok(all)) => Ok(all.to_bytes().to_vec()),
        Ok(Err(error)) if error.is::<LengthLimitError>() => Err(too_long()),
        Ok(Err(error)) => {
            let error = format!("the body cannot be received: {error}");
            Err(ServiceProblem::new(StatusCode::BAD_REQUEST, error))
        }
        Err(_) => {
            let error = format!("the body was not received within {:?}", bounds.body);
            Err(ServiceProblem::new(StatusCode::REQUEST_TIMEOUT, error))
        }
    }
}

/// The instance's number from the path of a request.
pub(super) struct PathNumber(pub InstanceId);

impl<S: Send + Sync> FromRequestParts<S> for PathNumber {
    type Rejection = ServiceProblem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, ServiceProblem> {
        let text = Path::<String>::from_request_parts(parts, state).await;
        let Path(text) = text
            .map_err(|rejection| ServiceProblem::new(rejection.status(), rejection.body_text()))?;
        text.parse().map(Self).map_err(|_| {
            let error = format!("`{text}` is not an instance: expected a number from 1 to 65535");
            ServiceProblem::new(StatusCode::BAD_REQUEST, error)
        })
    }
}

/// The parameters of a query; unknown ones are refused.
pub(super) struct Query<T>(pub T);

impl<S: Send + Sync, T: DeserializeOwned> FromRequestParts<S> for Query<T> {
    type Rejection = ServiceProblem;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, ServiceProblem> {
        match extract::Query::try_from_uri(&parts.uri) {
            Ok(extract::Query(said)) => Ok(Self(said)),
            Err(rejection) => Err(
                ServiceProblem::new(rejection.status(), rejection.body_text())
                    .hint("GET /openapi.json describes what is expected"),
            ),
        }
    }
}
