//! What happens, as it happens.

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

use super::{Desk, Problem};
use crate::hangar::{Instance, InstanceId, Instances};

/// How things are when somebody begins to follow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct Snapshot {
    /// Names this run of the service.
    pub life: String,
    /// The instances.
    pub vehicles: Vec<Instance>,
}

/// What has happened to an instance.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// It is new, or something about it is.
    Vehicle(Box<Instance>),
    /// It is no more.
    Gone(InstanceId),
}

/// What has happened between two looks at the instances, by their numbers; those that are no more come first, for
/// others may have their numbers later.
pub fn changes(before: &Instances, after: &Instances) -> Vec<Change> {
    let gone = before.keys().filter(|id| !after.contains_key(id));
    let new = after
        .iter()
        .filter(|(id, instance)| before.get(id) != Some(instance));
    gone.map(|&id| Change::Gone(id))
        .chain(new.map(|(_, instance)| Change::Vehicle(Box::new(instance.clone()))))
        .collect()
}

/// Follows the instances.
#[utoipa::path(get, path = "/events", responses(
    (status = 200, content_type = "text/event-stream", body = String, description =
        "First an event `snapshot` (`life` and `vehicles`), then one for each change: `vehicle` with the instance, \
         or `gone` with its `id`. Who reads slowly is told the latest only."),
    (status = 503, description = "Too many wait already", body = Problem),
))]
pub(super) async fn follow(State(desk): State<Arc<Desk>>) -> Result<Response, Problem> {
    let permit = desk.wait()?;
    let keep_alive = KeepAlive::new().interval(desk.setup.bounds.keep_alive);
    let events = stream(desk, permit);
    Ok(Sse::new(events).keep_alive(keep_alive).into_response())
}

/// One who follows.
struct Follower {
    desk: Arc<Desk>,
    seen: watch::Receiver<Instances>,
    /// What was told last; nothing before the snapshot.
    told: Option<Instances>,
    waiting: VecDeque<Change>,
    _permit: OwnedSemaphorePermit,
}

fn stream(
    desk: Arc<Desk>,
    permit: OwnedSemaphorePermit,
) -> impl Stream<Item = Result<Event, Infallible>> {
    let follower = Follower {
        seen: desk.hangar.instances(),
        desk,
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
                let snapshot = Snapshot {
                    life: self.desk.life.clone(),
                    vehicles: now.values().cloned().collect(),
                };
                return Event::default().event("snapshot").json_data(snapshot).ok();
            };
            tokio::select! {
                changed = self.seen.changed() => changed.ok()?,
                () = self.desk.cancel.cancelled() => return None,
            }
            let now = self.look();
            self.waiting = changes(&told, &now).into();
        }
    }

    fn look(&mut self) -> Instances {
        let now = self.seen.borrow_and_update().clone();
        let now = self.desk.dressed(&now);
        self.told = Some(Arc::clone(&now));
        now
    }
}

fn event(change: &Change) -> Option<Event> {
    match change {
        Change::Vehicle(instance) => Event::default().event("vehicle").json_data(instance),
        Change::Gone(id) => Event::default()
            .event("gone")
            .json_data(serde_json::json!({ "id": id })),
    }
    .ok()
}
