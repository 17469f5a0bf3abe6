//! A vehicle's bytes over the service's own connection: one port, one token, and no access for others.

use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse as _, Response};
use hyper_util::rt::TokioIo;
use tokio::io::{AsyncRead, AsyncWrite, DuplexStream, copy_bidirectional};
use tokio_util::sync::CancellationToken;

use super::body::PathNumber;
use super::{MAVLINK, ServiceProblem, ServiceState};

/// The bytes of a vehicle's serial 0.
#[utoipa::path(get, path = "/vehicles/{id}/mavlink", params(
    ("id" = u16, Path, description = "Its number"),
    ("upgrade" = String, Header, description = "`mavlink`, with `Connection: upgrade`"),
), responses(
    (status = 101, description = "From here on the connection carries the vehicle's bytes, also after a restart"),
    (status = 404, description = "No such instance", body = ServiceProblem),
    (status = 409, description = "Another client is attached to it", body = ServiceProblem),
    (status = 426, description = "The request contains no upgrade", body = ServiceProblem),
))]
pub(super) async fn open(
    State(state): State<Arc<ServiceState>>,
    PathNumber(id): PathNumber,
    mut request: Request,
) -> Result<Response, ServiceProblem> {
    state.instance(id)?;
    if !asks_for_upgrade(request.headers()) {
        let error = "this address serves bytes, not documents";
        let problem = ServiceProblem::new(StatusCode::UPGRADE_REQUIRED, error)
            .hint("send the headers `Connection: upgrade` and `Upgrade: mavlink`");
        return Ok(upgrade_headers(problem.into_response()));
    }
    let pipe = state.hangar.attach(id).await?;
    let upgrade = hyper::upgrade::on(&mut request);
    let cancel = state.cancel.clone();
    tokio::spawn(async move {
        // If the client leaves earlier, the vehicle is released.
        if let Ok(upgraded) = upgrade.await {
            carry(pipe, TokioIo::new(upgraded), &cancel).await;
        }
    });
    Ok(upgrade_headers(
        StatusCode::SWITCHING_PROTOCOLS.into_response(),
    ))
}

fn asks_for_upgrade(headers: &HeaderMap) -> bool {
    let says = |name: header::HeaderName, word: &str| {
        let value = headers.get(name).and_then(|value| value.to_str().ok());
        value.is_some_and(|value| {
            value
                .split(',')
                .any(|part| part.trim().eq_ignore_ascii_case(word))
        })
    };
    says(header::CONNECTION, "upgrade") && says(header::UPGRADE, MAVLINK)
}

fn upgrade_headers(mut response: Response) -> Response {
    let headers = response.headers_mut();
    headers.insert(header::CONNECTION, HeaderValue::from_static("upgrade"));
    headers.insert(header::UPGRADE, HeaderValue::from_static(MAVLINK));
    response
}

/// Carries bytes both ways until one end closes.
pub(super) async fn carry(
    mut pipe: DuplexStream,
    mut other: impl AsyncRead + AsyncWrite + Unpin,
    cancel: &CancellationToken,
) {
    tokio::select! {
        _ = copy_bidirectional(&mut pipe, &mut other) => {}
        () = cancel.cancelled() => {}
    }
}
