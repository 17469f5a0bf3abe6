//! The hangar as an HTTP service.
//!
//! - `accept` accepts connections up to a limit, and closes slow ones; `patient` closes those that
//!   do not read.
//! - `guard` controls access: by the token, or on loopback by the owner of the program at the other
//!   end.
//! - `vehicles`, `paper`, `about`, `events` and `tunnel` answer; `problem` is the answer to a
//!   failed request.
//! - `openapi` describes the service; `expose` opens a port for each instance on request.

use std::collections::BTreeMap;
use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use rand::TryRng as _;
use rand::rngs::SysRng;
use serde::{Deserialize, Serialize};
use tokio::net::TcpListener;
use tokio::sync::{Semaphore, watch};
use tokio_util::sync::CancellationToken;
use utoipa::ToSchema;

use super::process::Connection;
use super::token::HangarToken;
use super::{Capacity, Hangar, HangarLimits, Instance, InstanceId, Instances, Restart};
use crate::sitl::SitlKind;

mod about;
mod accept;
mod body;
mod events;
mod expose;
mod guard;
mod openapi;
mod paper;
mod patient;
mod problem;
mod tunnel;
mod vehicles;

pub use events::{InstanceChange, InstanceSnapshot, changes};
pub use problem::ServiceProblem;
pub use vehicles::Printed;

/// The default port of a hangar.
pub const PORT: u16 = 5700;
/// The protocol that a connection is upgraded to for a vehicle's bytes.
pub const MAVLINK: &str = "mavlink";
/// How long connections may take to end with the service.
const GRACE: Duration = Duration::from_secs(1);

/// Finds the user id of the program at the other end of a connection on this host, from the addresses of both ends.
pub type Owner = fn(SocketAddr, SocketAddr) -> Option<u32>;

/// The user id of the program at the other end, according to the system's list of connections;
/// `None` if it is unknown.
pub fn owner(peer: SocketAddr, local: SocketAddr) -> Option<u32> {
    Connection { peer, local }.user()
}

/// The settings of a service.
#[derive(Debug, Clone)]
pub struct ServiceSetup {
    /// The token that admits any client.
    pub token: HangarToken,
    /// Whether the token is required even on loopback from programs of the same user.
    pub require_token: bool,
    /// Whether each instance's MAVLink is also exposed on a TCP port on loopback.
    pub expose: bool,
    /// The limits for clients.
    pub bounds: ServiceBounds,
    /// Finds a connection's owner.
    pub owner: Owner,
    /// The programs, for display.
    pub programs: Vec<Program>,
    /// Whether instances that end on their own are restarted.
    pub restart: Restart,
    /// The limits of the hangar.
    pub limits: HangarLimits,
}

/// The limits of a service for its clients.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ServiceBounds {
    /// The maximum number of connections at once, not counting tunnels.
    pub connections: usize,
    /// The maximum number of connections that wait for events.
    pub waiting: usize,
    /// The maximum size of a request's body, in bytes.
    pub request_bytes: usize,
    /// How long a connection may be silent, or take for a request's head.
    pub head: Duration,
    /// How long a request's body may take.
    pub body: Duration,
    /// How long a client may leave its answer unread.
    pub stall: Duration,
    /// The time between keep-alive messages to followers of the events.
    pub keep_alive: Duration,
}

impl Default for ServiceBounds {
    fn default() -> Self {
        Self {
            connections: 64,
            waiting: 48,
            request_bytes: 64 * 1024,
            head: Duration::from_secs(10),
            body: Duration::from_secs(10),
            stall: Duration::from_secs(30),
            keep_alive: Duration::from_secs(10),
        }
    }
}

/// A program that can be started.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Program {
    /// The kind of vehicle.
    pub kind: SitlKind,
    /// The path of the program.
    pub file: String,
    /// The name and version that the program reports.
    pub identity: String,
}

/// The answer to `GET /status`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
pub struct Status {
    /// The version of the program.
    pub version: String,
    /// Identifies this run of the service; it changes with every restart.
    pub life: String,
    /// The programs that can be started.
    pub programs: Vec<Program>,
    /// The used and the free capacity.
    pub capacity: Capacity,
    /// The limits of the hangar.
    pub limits: HangarLimits,
    /// Whether instances that end on their own are restarted.
    pub restart: Restart,
    /// Processes that an earlier run of the service left behind.
    pub leftovers: Vec<String>,
}

struct ServiceState {
    hangar: Hangar,
    setup: ServiceSetup,
    life: String,
    /// Whether only this host can connect.
    on_loopback: bool,
    waiting: Arc<Semaphore>,
    ports: watch::Sender<BTreeMap<InstanceId, u16>>,
    cancel: CancellationToken,
}

/// Serves a hangar until cancelled; then ends its instances.
///
/// # Errors
/// The listener's address is unknown, or the system provides no random numbers.
pub async fn serve(
    listener: TcpListener,
    hangar: Hangar,
    setup: ServiceSetup,
    cancel: CancellationToken,
) -> io::Result<()> {
    let address = listener.local_addr()?;
    let life = SysRng.try_next_u64().map_err(io::Error::other)?;
    let state = Arc::new(ServiceState {
        on_loopback: address.ip().is_loopback(),
        life: format!("{life:016x}"),
        waiting: Arc::new(Semaphore::new(setup.bounds.waiting)),
        ports: watch::Sender::default(),
        cancel: cancel.child_token(),
        hangar,
        setup,
    });
    let mut connections = accept::run(&listener, &state).await;
    drop(listener);
    state.cancel.cancel();
    let all = async { while connections.join_next().await.is_some() {} };
    // Connections that are still busy after that are closed.
    let _ = tokio::time::timeout(GRACE, all).await;
    connections.shutdown().await;
    state.hangar.close().await;
    Ok(())
}

fn router(state: &Arc<ServiceState>) -> Router {
    let guard = axum::middleware::from_fn_with_state(Arc::clone(state), guard::check);
    table()
        .into_iter()
        .fold(Router::new(), |router, (path, methods)| {
            router.route(path, methods)
        })
        .fallback(problem::no_such_path)
        .method_not_allowed_fallback(problem::no_such_method)
        .layer(guard)
        .with_state(Arc::clone(state))
}

/// Every path with its handler.
fn table() -> Vec<(&'static str, axum::routing::MethodRouter<Arc<ServiceState>>)> {
    use axum::routing::{MethodRouter, get, post};
    // HEAD is usually answered like GET; here it would have the effect of GET.
    let acts = |methods: MethodRouter<Arc<ServiceState>>| methods.head(problem::not_by_head);
    vec![
        ("/vehicles", get(vehicles::list).post(vehicles::launch)),
        (
            "/vehicles/{id}",
            get(vehicles::one).delete(vehicles::remove),
        ),
        ("/vehicles/{id}/restart", post(vehicles::restart)),
        ("/vehicles/{id}/ready", get(vehicles::ready)),
        ("/vehicles/{id}/output", get(vehicles::output)),
        ("/vehicles/{id}/mavlink", acts(get(tunnel::open))),
        ("/events", get(events::follow)),
        ("/status", get(about::status)),
        ("/openapi.json", get(openapi::openapi)),
        ("/start/{id}", acts(get(paper::start))),
        ("/stop/{id}", acts(get(paper::stop))),
        ("/ready/{id}", get(paper::ready)),
        ("/list", get(paper::list)),
    ]
}

impl ServiceState {
    fn instances(&self) -> Instances {
        self.dressed(&self.hangar.instances().borrow())
    }

    /// The instances with their exposed ports.
    fn dressed(&self, all: &Instances) -> Instances {
        let ports = self.ports.borrow();
        if ports.is_empty() {
            return Arc::clone(all);
        }
        let dress = |(id, instance): (&InstanceId, &Instance)| {
            let port = ports.get(id).copied();
            let instance = Instance {
                port,
                ..instance.clone()
            };
            (*id, instance)
        };
        Arc::new(all.iter().map(dress).collect())
    }

    fn instance(&self, id: InstanceId) -> Result<Instance, ServiceProblem> {
        self.instances()
            .get(&id)
            .cloned()
            .ok_or_else(|| ServiceProblem::from(super::HangarRefusal::Unknown(id)))
    }
}
