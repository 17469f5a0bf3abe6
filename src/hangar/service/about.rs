//! What the service says about itself.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;

use super::{Desk, Status};

/// The version, what can be started, how full it is, and what was left behind by an earlier life.
#[utoipa::path(get, path = "/status", responses(
    (status = 200, description = "How the service is doing", body = Status),
))]
pub(super) async fn status(State(desk): State<Arc<Desk>>) -> Json<Status> {
    Json(Status {
        version: env!("SORTIE_VERSION").to_owned(),
        life: desk.life.clone(),
        programs: desk.setup.programs.clone(),
        capacity: desk.hangar.capacity(),
        limits: desk.setup.limits,
        restart: desk.setup.restart,
        leftovers: desk.setup.leftovers.clone(),
    })
}

/// This description.
#[utoipa::path(get, path = "/openapi.json", responses(
    (status = 200, description = "The description of the service in OpenAPI 3.1", body = serde_json::Value),
))]
pub(super) async fn openapi() -> Json<utoipa::openapi::OpenApi> {
    Json(super::openapi::document())
}
