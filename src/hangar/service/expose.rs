//! A TCP port on loopback for each instance, for ground stations without support for tokens.

use std::collections::BTreeMap;
use std::sync::Arc;

use tokio::net::TcpListener;
use tokio_util::sync::{CancellationToken, DropGuard};

use super::ServiceState;
use super::patient::Patient;
use super::tunnel::carry;
use crate::hangar::InstanceId;

/// Opens a port for each instance, and closes it with the instance.
pub(super) async fn run(state: Arc<ServiceState>) {
    let mut doors: BTreeMap<InstanceId, DropGuard> = BTreeMap::new();
    let mut seen = state.hangar.instances();
    loop {
        let all = seen.borrow_and_update().clone();
        doors.retain(|id, _| all.contains_key(id));
        state.ports.send_if_modified(|ports| {
            let before = ports.len();
            ports.retain(|id, _| all.contains_key(id));
            ports.len() != before
        });
        for &id in all.keys() {
            if doors.contains_key(&id) {
                continue;
            }
            // Without a free port, the vehicle is still available through its tunnel.
            if let Some(door) = open(&state, id).await {
                doors.insert(id, door);
            }
        }
        tokio::select! {
            changed = seen.changed() => if changed.is_err() { return },
            () = state.cancel.cancelled() => return,
        }
    }
}

async fn open(state: &Arc<ServiceState>, id: InstanceId) -> Option<DropGuard> {
    let listener = TcpListener::bind(("127.0.0.1", 0)).await.ok()?;
    let port = listener.local_addr().ok()?.port();
    state.ports.send_modify(|ports| {
        ports.insert(id, port);
    });
    let cancel = state.cancel.child_token();
    tokio::spawn(serve(listener, Arc::clone(state), id, cancel.clone()));
    Some(cancel.drop_guard())
}

/// Serves the vehicle's bytes to one client at a time; others are disconnected.
async fn serve(
    listener: TcpListener,
    state: Arc<ServiceState>,
    id: InstanceId,
    cancel: CancellationToken,
) {
    loop {
        let stream = tokio::select! {
            accepted = listener.accept() => match accepted {
                Ok((stream, _)) => stream,
                Err(_) => return,
            },
            () = cancel.cancelled() => return,
        };
        let _ = stream.set_nodelay(true);
        if let Ok(pipe) = state.hangar.attach(id).await {
            let cancel = cancel.clone();
            let stream = Patient::new(stream, state.setup.bounds.stall);
            tokio::spawn(async move { carry(pipe, stream, &cancel).await });
        }
    }
}
