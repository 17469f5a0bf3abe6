//! The simple requests of the paper that this program builds on: start, stop and readiness by a vehicle's number, all
//! with GET, answered with a line of text or, if the client accepts it, with JSON.

use std::fmt::Write as _;
use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse as _, Response};

use super::body::PathNumber;
use super::{ServiceProblem, ServiceState, vehicles};
use crate::hangar::{Instance, Launch, SitlStage};

/// Starts a copter with this number at SITL's usual place.
#[utoipa::path(get, operation_id = "plain_start", path = "/start/{id}", params(("id" = u16, Path, description = "Its number")), responses(
    (status = 201, description = "It is being started", body = Instance, content_type = "application/json"),
    (status = 409, description = "The number is taken", body = ServiceProblem),
    (status = 503, description = "The hangar is full, or has no program for it", body = ServiceProblem),
))]
pub(super) async fn start(
    State(state): State<Arc<ServiceState>>,
    PathNumber(id): PathNumber,
    headers: HeaderMap,
) -> Result<Response, ServiceProblem> {
    let launch = Launch {
        id: Some(id),
        ..Launch::default()
    };
    let instance = state.launch(launch).await?;
    let line = format!("{} started\n", instance.id);
    Ok((StatusCode::CREATED, either(&headers, line, &instance)).into_response())
}

/// Ends the instance with this number.
#[utoipa::path(get, operation_id = "plain_stop", path = "/stop/{id}", params(("id" = u16, Path, description = "Its number")), responses(
    (status = 200, description = "Its process is gone", body = String, content_type = "text/plain"),
    (status = 404, description = "No such instance", body = ServiceProblem),
))]
pub(super) async fn stop(
    State(state): State<Arc<ServiceState>>,
    PathNumber(id): PathNumber,
    headers: HeaderMap,
) -> Result<Response, ServiceProblem> {
    state.stop(id).await?;
    let json = serde_json::json!({ "id": id });
    Ok(either(&headers, format!("{id} stopped\n"), &json))
}

/// The stage of the instance with this number, without waiting.
#[utoipa::path(get, operation_id = "plain_ready", path = "/ready/{id}", params(("id" = u16, Path, description = "Its number")), responses(
    (status = 200, description = "It can be armed", body = Instance, content_type = "application/json"),
    (status = 202, description = "Not yet; the answer shows its stage", body = Instance, content_type = "application/json"),
    (status = 404, description = "No such instance", body = ServiceProblem),
    (status = 410, description = "It has ended", body = ServiceProblem),
))]
pub(super) async fn ready(
    State(state): State<Arc<ServiceState>>,
    PathNumber(id): PathNumber,
    headers: HeaderMap,
) -> Result<Response, ServiceProblem> {
    state.instance(id)?;
    let (status, Json(instance)) = vehicles::readiness(&state, id)?;
    let line = line(&instance);
    Ok((status, either(&headers, line, &instance)).into_response())
}

/// The instances, a line for each.
#[utoipa::path(get, operation_id = "plain_list", path = "/list", responses(
    (status = 200, description = "Number, stage, exposed port and fault", body = String, content_type = "text/plain"),
))]
pub(super) async fn list(State(state): State<Arc<ServiceState>>, headers: HeaderMap) -> Response {
    let all = state.instances();
    let lines = all.values().map(line).collect();
    let json: Vec<&Instance> = all.values().collect();
    either(&headers, lines, &json)
}

/// An instance as a line: number, stage, exposed port, and remarks.
fn line(instance: &Instance) -> String {
    let mut line = format!("{} {}", instance.id, instance.stage.word());
    let [have, of] = instance.parameters;
    if instance.stage == SitlStage::Heartbeat && of > 0 {
        // Writing to a string cannot fail.
        let _ = write!(line, " (parameters {have}/{of})");
    }
    if let Some(port) = instance.port {
        let _ = write!(line, " tcp:127.0.0.1:{port}");
    }
    if let Some(fault) = &instance.fault {
        let _ = write!(line, ": {fault}");
    }
    line.push('\n');
    line
}

fn either<T: serde::Serialize>(headers: &HeaderMap, text: String, json: &T) -> Response {
    let accepted = headers
        .get(header::ACCEPT)
        .and_then(|kinds| kinds.to_str().ok());
    if accepted.is_some_and(|kinds| kinds.contains("application/json")) {
        return Json(json).into_response();
    }
    text.into_response()
}
