//! The stream of events.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::sync::Arc;

use axum::extract::State;
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse as _, Response};
use futures_util::Stream;
use futures_util::stream::unfold;
use serde::{Deserialize, Serialize};
use tokio::sync::{OwnedSemaphorePermit, watch};
use utoipa::ToSchema;

use super::{ServiceProblem, ServiceState};
use crate::hangar::{Instance, InstanceId, Instances};

/// The state at the start of a stream.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
#[schema(as = Snapshot)]
pub struct InstanceSnapshot {
    /// Identifies this run of the service.
    pub life: String,
    /// All instances and their state.
    pub vehicles: Vec<Instance>,
}

/// A change that the stream of events reports.
#[derive(Debug, Clone, PartialEq)]
pub enum InstanceChange {
    /// The instance is new, or has changed.
    Vehicle(Box<Instance>),
    Gone(InstanceId),
}

/// The changes between two states of the instances; removed ones come first, since their numbers may be reused.
pub fn changes(before: &Instances, after: &Instances) -> Vec<InstanceChange> {
    let gone = before.keys().filter(|id| !after.contains_key(id));
    let new = after
        .iter()
        .filter(|(id, instance)| before.get(id) != Some(instance));
    gone.map(|&id| InstanceChange::Gone(id))
        .chain(new.map(|(_, instance)| InstanceChange::Vehicle(Box::new(instance.clone()))))
        .collect()
}

#[utoipa::path(get, path = "/events", responses(
    (status = 200, content_type = "text/event-stream", body = String, description =
        "First an event `snapshot` (`life` and `vehicles`), then one for each change: `vehicle` with the instance, \
         or `gone` with its `id`. A slow reader receives only the latest state."),
    (status = 503, description = "Too many connections are waiting", body = ServiceProblem),
))]
pub(super) async fn follow(
    State(state): State<Arc<ServiceState>>,
) -> Result<Response, ServiceProblem> {
    let permit = state.wait()?;
    let keep_alive = KeepAlive::new().interval(state.setup.bounds.keep_alive);
    let events = stream(state, permit);
    Ok(Sse::new(events).keep_alive(keep_alive).into_response())
}

struct Follower {
    state: Arc<ServiceState>,
    seen: watch::Receiver<Instances>,
    /// The last state sent; `None` before the snapshot.
    told: Option<Instances>,
    waiting: VecDeque<InstanceChange>,
    _permit: OwnedSemaphorePermit,
}

fn stream(
    state: Arc<ServiceState>,
    permit: OwnedSemaphorePermit,
) -> impl Stream<Item = Result<Event, Infallible>> {
    let follower = Follower {
        seen: state.hangar.instances(),
        state,
        told: None,
        waiting: VecDeque::new(),
        _permit: permit,
    };
    unfold(follower, async |mut follower| {
        let event = follower.next().await?;
        Some((Ok(event), follower))
    })
}

impl Follower {
    async fn next(&mut self) -> Option<Event> {
        loop {
            if let Some(change) = self.waiting.pop_front() {
                return event(&change);
            }
            let Some(told) = self.told.clone() else {
                let now = self.look();
                let snapshot = InstanceSnapshot {
                    life: self.state.life.clone(),
                    vehicles: now.values().cloned().collect(),
                };
                return Event::default().event("snapshot").json_data(snapshot).ok();
            };
            tokio::select! {
                changed = self.seen.changed() => changed.ok()?,
                () = self.state.cancel.cancelled() => return None,
            }
            let now = self.look();
            self.waiting = changes(&told, &now).into();
        }
    }

    fn look(&mut self) -> Instances {
        let seen = self.seen.borrow_and_update().clone();
        let now = self.state.dressed(&seen);
        self.told = Some(Arc::clone(&now));
        now
    }
}

fn event(change: &InstanceChange) -> Option<Event> {
    match change {
        InstanceChange::Vehicle(instance) => Event::default().event("vehicle").json_data(instance),
        InstanceChange::Gone(id) => Event::default()
            .event("gone")
            .json_data(serde_json::json!({ "id": id })),
    }
    .ok()
}
