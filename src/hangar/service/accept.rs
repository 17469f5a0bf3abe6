//! Accepts connections, and closes slow ones and those beyond the limit.

use std::convert::Infallible;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use axum::response::IntoResponse as _;
use axum::{Extension, Router};
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper::{Request, StatusCode};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::task::JoinSet;
use tokio::time::timeout;

use super::guard::ConnectionEnds;
use super::patient::Patient;
use super::{ServiceProblem, ServiceState, expose, router};

/// The maximum size of a request's head, and of a connection's buffer, in bytes.
const HEAD_MAX: usize = 16 * 1024;
/// How long a rejected client may take to send its request and to read the answer.
const STOP_WITHIN: Duration = Duration::from_secs(1);
/// How long to wait when the system accepts no more connections.
const PAUSE: Duration = Duration::from_millis(100);

/// Accepts connections until cancelled; returns those that are still open.
pub(super) async fn run(listener: &TcpListener, state: &Arc<ServiceState>) -> JoinSet<()> {
    let mut tasks = JoinSet::new();
    if state.setup.expose {
        tasks.spawn(expose::run(Arc::clone(state)));
    }
    let router = router(state);
    let room = Arc::new(Semaphore::new(state.setup.bounds.connections));
    // Rejected connections also need a slot until they have received the 503.
    let rejected = Arc::new(Semaphore::new(state.setup.bounds.connections));
    loop {
        tokio::select! {
            () = state.cancel.cancelled() => return tasks,
            accepted = listener.accept() => match accepted {
                Ok((stream, peer)) => {
                    let ends = ends_of(&stream, peer);
                    let free = Arc::clone(&room).try_acquire_owned().ok();
                    let permit = free.filter(|_| may_enter(&room, ends.as_ref(), state));
                    if let Some((permit, ends)) = permit.zip(ends) {
                        let (router, state) = (router.clone(), Arc::clone(state));
                        tasks.spawn(async move {
                            talk(stream, ends, router, &state).await;
                            drop(permit);
                        });
                    } else if let Ok(permit) = Arc::clone(&rejected).try_acquire_owned() {
                        tasks.spawn(turn_away(stream, permit));
                    }
                }
                Err(_) => tokio::time::sleep(PAUSE).await,
            },
            Some(_) = tasks.join_next() => {}
        }
    }
}

fn ends_of(stream: &TcpStream, peer: SocketAddr) -> Option<ConnectionEnds> {
    let local = stream.local_addr().ok()?;
    Some(ConnectionEnds::new(peer, local))
}

/// Whether there is room for a connection. Half of the room is reserved for the user's own programs
/// on this host.
fn may_enter(room: &Semaphore, ends: Option<&ConnectionEnds>, state: &ServiceState) -> bool {
    let is_half_full = room.available_permits() < state.setup.bounds.connections / 2;
    let is_own = || ends.is_some_and(|ends| ends.is_own(state.setup.owner));
    !state.on_loopback || !is_half_full || is_own()
}

/// Answers the requests of one connection. After an upgrade to a tunnel it no longer counts towards
/// the limit.
async fn talk(stream: TcpStream, ends: ConnectionEnds, router: Router, state: &ServiceState) {
    // Answers are small and must not wait for one another; without this option, they are only slower.
    let _ = stream.set_nodelay(true);
    let bounds = state.setup.bounds;
    let service = router.layer(Extension(Arc::new(ends)));
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(bounds.head)
        .max_buf_size(HEAD_MAX)
        .serve_connection(
            TokioIo::new(Patient::new(stream, bounds.stall)),
            TowerToHyperService::new(service),
        )
        .with_upgrades();
    tokio::pin!(connection);
    // How a client disconnects does not matter.
    tokio::select! {
        _ = connection.as_mut() => return,
        () = state.cancel.cancelled() => connection.as_mut().graceful_shutdown(),
    }
    let _ = connection.await;
}

/// Answers the first request with 503 and closes the connection.
async fn turn_away(stream: TcpStream, _permit: OwnedSemaphorePermit) {
    let refuse = service_fn(|_: Request<Incoming>| async {
        let problem = ServiceProblem::new(StatusCode::SERVICE_UNAVAILABLE, "too many connections");
        Ok::<_, Infallible>(problem.hint("later").into_response())
    });
    let connection = http1::Builder::new()
        .keep_alive(false)
        .max_buf_size(HEAD_MAX)
        .serve_connection(TokioIo::new(stream), refuse);
    let _ = timeout(STOP_WITHIN, connection).await;
}
