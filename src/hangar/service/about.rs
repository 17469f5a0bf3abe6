//! Answers the request for the service's status.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use futures_util::FutureExt as _;

use super::{ServiceState, Status};

/// The version, the programs that can be started, the capacity, and the processes that an earlier run left behind.
#[utoipa::path(get, path = "/status", responses(
    (status = 200, description = "The status of the service", body = Status),
))]
pub(super) async fn status(State(state): State<Arc<ServiceState>>) -> Json<Status> {
    // For a moment after the start, the leftovers are still being ended.
    let leftovers = state.hangar.leftovers().now_or_never().unwrap_or_default();
    Json(Status {
        version: env!("SORTIE_VERSION").to_owned(),
        life: state.life.clone(),
        programs: state.setup.programs.clone(),
        capacity: state.hangar.capacity(),
        limits: state.setup.limits,
        restart: state.setup.restart,
        leftovers: leftovers.iter().map(ToString::to_string).collect(),
    })
}
