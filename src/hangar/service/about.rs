//! What the service says about itself.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use futures_util::FutureExt as _;

use super::{Desk, Status};

/// The version, what can be started, how full it is, and what was left behind by an earlier life.
#[utoipa::path(get, path = "/status", responses(
    (status = 200, description = "How the service is doing", body = Status),
))]
pub(super) async fn status(State(desk): State<Arc<Desk>>) -> Json<Status> {
    // They are still being ended for a moment after the start.
    let leftovers = desk.hangar.leftovers().now_or_never().unwrap_or_default();
    Json(Status {
        version: env!("SORTIE_VERSION").to_owned(),
        life: desk.life.clone(),
        programs: desk.setup.programs.clone(),
        capacity: desk.hangar.capacity(),
        limits: desk.setup.limits,
        restart: desk.setup.restart,
        leftovers: leftovers.iter().map(ToString::to_string).collect(),
    })
}

/// This description.
#[utoipa::path(get, path = "/openapi.json", responses(
    (status = 200, description = "The description of the service in OpenAPI 3.1", body = serde_json::Value),
))]
pub(super) async fn openapi() -> Json<utoipa::openapi::OpenApi> {
    Json(super::openapi::document())
}
