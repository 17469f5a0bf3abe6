//! Requests about instances: start, list, stop.

use std::sync::Arc;
use std::time::Duration;

use axum::Json;
use axum::extract::{Request, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse as _, Response};
use serde::{Deserialize, Serialize};
use tokio::sync::OwnedSemaphorePermit;
use utoipa::{IntoParams, ToSchema};

use super::body::{self, PathNumber, Query};
use super::{ServiceProblem, ServiceState};
use crate::hangar::{HangarRefusal, Instance, InstanceId, Launch, OutputLine, SitlStage};

/// The default and the longest wait for readiness, in seconds.
const READY_S: u32 = 60;
const READY_MAX_S: u32 = 300;
/// How long an answer waits for an instance's exposed port.
const PORT_OPENED: Duration = Duration::from_secs(1);
/// The default number of lines of output.
const LINES: usize = 100;

/// The query parameters of a request that waits for readiness.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(super) struct ReadyWait {
    /// Seconds to wait: 60 by default, 300 at most.
    timeout_s: Option<u32>,
}

/// The requested lines of output.
#[derive(Debug, Deserialize, IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(super) struct Excerpt {
    /// The maximum number of lines: 100 by default.
    lines: Option<usize>,
    /// Return only the lines after those of an earlier answer: the value of its `next`.
    since: Option<u64>,
}

/// The output of an instance.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Printed {
    /// The lines, oldest first.
    pub lines: Vec<OutputLine>,
    /// The `since` that requests only the lines after these.
    pub next: u64,
}

#[utoipa::path(post, path = "/vehicles", request_body = Launch, responses(
    (status = 201, description = "It is being started", body = Instance,
        headers(("location" = String, description = "Its address"))),
    (status = 400, description = "The body is not a valid launch", body = ServiceProblem),
    (status = 409, description = "The number is taken", body = ServiceProblem),
    (status = 413, description = "The body is too long", body = ServiceProblem),
    (status = 415, description = "The type of the body is not JSON", body = ServiceProblem),
    (status = 503, description = "The hangar is full, or has no program for it", body = ServiceProblem),
))]
pub(super) async fn launch(
    State(state): State<Arc<ServiceState>>,
    request: Request,
) -> Result<Response, ServiceProblem> {
    let launch = body::json(request, state.setup.bounds).await?;
    let instance = state.launch(launch).await?;
    let place = format!("/vehicles/{}", instance.id);
    Ok((
        StatusCode::CREATED,
        [(header::LOCATION, place)],
        Json(instance),
    )
        .into_response())
}

#[utoipa::path(get, path = "/vehicles", responses(
    (status = 200, description = "All instances, including those that have ended by themselves", body = Vec<Instance>),
))]
pub(super) async fn list(State(state): State<Arc<ServiceState>>) -> Json<Vec<Instance>> {
    Json(state.instances().values().cloned().collect())
}

#[utoipa::path(get, path = "/vehicles/{id}", params(("id" = u16, Path, description = "Its number")), responses(
    (status = 200, description = "Its state", body = Instance),
    (status = 404, description = "No such instance", body = ServiceProblem),
))]
pub(super) async fn one(
    State(state): State<Arc<ServiceState>>,
    PathNumber(id): PathNumber,
) -> Result<Json<Instance>, ServiceProblem> {
    state.instance(id).map(Json)
}

#[utoipa::path(delete, path = "/vehicles/{id}", params(("id" = u16, Path, description = "Its number")), responses(
    (status = 204, description = "Its process is gone"),
    (status = 404, description = "No such instance", body = ServiceProblem),
))]
pub(super) async fn remove(
    State(state): State<Arc<ServiceState>>,
    PathNumber(id): PathNumber,
) -> Result<StatusCode, ServiceProblem> {
    state.stop(id).await?;
    Ok(StatusCode::NO_CONTENT)
}

/// Ends an instance's process, if there is one, and starts it again.
#[utoipa::path(post, path = "/vehicles/{id}/restart", params(("id" = u16, Path, description = "Its number")), responses(
    (status = 202, description = "It is being restarted", body = Instance),
    (status = 404, description = "No such instance", body = ServiceProblem),
))]
pub(super) async fn restart(
    State(state): State<Arc<ServiceState>>,
    PathNumber(id): PathNumber,
) -> Result<(StatusCode, Json<Instance>), ServiceProblem> {
    state.hangar.restart(id).await?;
    Ok((StatusCode::ACCEPTED, Json(state.instance(id)?)))
}

/// Waits until an instance can be armed.
#[utoipa::path(get, path = "/vehicles/{id}/ready", params(
    ("id" = u16, Path, description = "Its number"), ReadyWait
), responses(
    (status = 200, description = "It can be armed", body = Instance),
    (status = 202, description = "Not within that time; the answer shows its stage", body = Instance),
    (status = 404, description = "No such instance", body = ServiceProblem),
    (status = 410, description = "It has ended", body = ServiceProblem),
    (status = 503, description = "Too many connections are waiting", body = ServiceProblem),
))]
pub(super) async fn ready(
    State(state): State<Arc<ServiceState>>,
    PathNumber(id): PathNumber,
    Query(wait): Query<ReadyWait>,
) -> Result<(StatusCode, Json<Instance>), ServiceProblem> {
    let seconds = wait.timeout_s.unwrap_or(READY_S);
    if seconds > READY_MAX_S {
        let error = format!("the query: timeout_s is {READY_MAX_S} at most, not {seconds}");
        return Err(ServiceProblem::new(StatusCode::BAD_REQUEST, error)
            .hint("repeat the request afterwards"));
    }
    state.instance(id)?;
    let _permit = state.wait()?;
    let mut seen = state.hangar.instances();
    let over = |instance: &Instance| [SitlStage::Ready, SitlStage::Ended].contains(&instance.stage);
    let waiting = seen.wait_for(|all| all.get(&id).is_none_or(over));
    let limit = Duration::from_secs(seconds.into());
    tokio::select! {
        _ = tokio::time::timeout(limit, waiting) => {}
        () = state.cancel.cancelled() => return Err(HangarRefusal::Closing.into()),
    }
    readiness(&state, id)
}

/// The stage of an instance, with the matching HTTP status.
pub(super) fn readiness(
    state: &ServiceState,
    id: InstanceId,
) -> Result<(StatusCode, Json<Instance>), ServiceProblem> {
    let gone = |why: String| {
        ServiceProblem::new(StatusCode::GONE, format!("instance {id} has ended{why}"))
    };
    let instance = state.instance(id).map_err(|_| gone(String::new()))?;
    match instance.stage {
        SitlStage::Ready => Ok((StatusCode::OK, Json(instance))),
        SitlStage::Ended => {
            let why = instance.fault.map(|fault| format!(": {fault}"));
            Err(gone(why.unwrap_or_default())
                .hint(format!("GET /vehicles/{id}/output shows its output")))
        }
        SitlStage::Queued
        | SitlStage::Process
        | SitlStage::Heartbeat
        | SitlStage::Parameters
        | SitlStage::Position
        | SitlStage::Stopping => Ok((StatusCode::ACCEPTED, Json(instance))),
    }
}

/// The output of an instance.
#[utoipa::path(get, path = "/vehicles/{id}/output", params(
    ("id" = u16, Path, description = "Its number"), Excerpt
), responses(
    (status = 200, description = "The last lines", body = Printed),
    (status = 404, description = "No such instance", body = ServiceProblem),
))]
pub(super) async fn output(
    State(state): State<Arc<ServiceState>>,
    PathNumber(id): PathNumber,
    Query(excerpt): Query<Excerpt>,
) -> Result<Json<Printed>, ServiceProblem> {
    let lines = excerpt.lines.unwrap_or(LINES);
    let since = excerpt.since.unwrap_or(0);
    let mut all = state.hangar.output(id, since)?;
    let next = all.last().map_or(since, |line| line.number + 1);
    let lines = all.split_off(all.len().saturating_sub(lines));
    Ok(Json(Printed { lines, next }))
}

impl ServiceState {
    /// Starts an instance, even if the client stops waiting.
    pub(super) async fn launch(
        self: &Arc<Self>,
        launch: Launch,
    ) -> Result<Instance, ServiceProblem> {
        let state = Arc::clone(self);
        let begun = tokio::spawn(async move { state.hangar.launch(launch).await });
        let id = begun.await.map_err(|_| HangarRefusal::Closing)??;
        if self.setup.expose {
            let mut ports = self.ports.subscribe();
            let opened = ports.wait_for(|ports| ports.contains_key(&id));
            // A port that could not be opened is left out.
            let _ = tokio::time::timeout(PORT_OPENED, opened).await;
        }
        self.instance(id)
    }

    /// Ends an instance, even if the client stops waiting.
    pub(super) async fn stop(self: &Arc<Self>, id: InstanceId) -> Result<(), ServiceProblem> {
        let state = Arc::clone(self);
        let begun = tokio::spawn(async move { state.hangar.stop(id).await });
        Ok(begun.await.map_err(|_| HangarRefusal::Closing)??)
    }

    /// Reserves a place among the waiting connections.
    pub(super) fn wait(&self) -> Result<OwnedSemaphorePermit, ServiceProblem> {
        Arc::clone(&self.waiting).try_acquire_owned().map_err(|_| {
            let error = format!(
                "{} connections are waiting, which is the limit",
                self.setup.bounds.waiting
            );
            ServiceProblem::new(StatusCode::SERVICE_UNAVAILABLE, error)
                .hint("one GET /events covers all instances")
        })
    }
}
