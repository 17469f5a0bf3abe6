//! Takes connections and hangs up on those that are too many or too slow.

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use axum::{Extension, Router};
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::task::JoinSet;

use super::guard::Line;
use super::patient::Patient;
use super::{Desk, expose, router};

/// Bytes of a request's head, and of what is buffered of a connection.
const HEAD_MAX: usize = 16 * 1024;
/// How long one who cannot be served may take to hear so.
const FAREWELL: Duration = Duration::from_secs(1);
/// How long to wait when the system gives no more connections.
const PAUSE: Duration = Duration::from_millis(100);
const TOO_MANY: &[u8] = b"HTTP/1.1 503 Service Unavailable\r\n\
    content-type: application/json\r\nretry-after: 1\r\nconnection: close\r\ncontent-length: 48\r\n\r\n\
    {\"error\":\"too many connections\",\"hint\":\"later\"}\n";

/// Takes connections until cancelled; returns those that are still there.
pub(super) async fn run(listener: &TcpListener, desk: &Arc<Desk>) -> JoinSet<()> {
    let mut tasks = JoinSet::new();
    if desk.setup.expose {
        tasks.spawn(expose::run(Arc::clone(desk)));
    }
    let router = router(desk);
    let room = Arc::new(Semaphore::new(desk.setup.bounds.connections));
    // Those who are told that there is no room need some room as well.
    let porch = Arc::new(Semaphore::new(desk.setup.bounds.connections));
    loop {
        tokio::select! {
            () = desk.cancel.cancelled() => return tasks,
            accepted = listener.accept() => match accepted {
                Ok((stream, peer)) => {
                    if let Ok(permit) = Arc::clone(&room).try_acquire_owned() {
                        tasks.spawn(talk(stream, peer, (router.clone(), permit), Arc::clone(desk)));
                    } else if let Ok(permit) = Arc::clone(&porch).try_acquire_owned() {
                        tasks.spawn(turn_away(stream, permit));
                    }
                }
                Err(_) => tokio::time::sleep(PAUSE).await,
            },
            Some(_) = tasks.join_next() => {}
        }
    }
}

/// Answers the requests of one connection. A tunnel that it becomes is no longer counted.
async fn talk(
    stream: TcpStream,
    peer: SocketAddr,
    (router, _permit): (Router, OwnedSemaphorePermit),
    desk: Arc<Desk>,
) {
    // Answers are small and must not wait for one another; failing that they only come later.
    let _ = stream.set_nodelay(true);
    let Ok(local) = stream.local_addr() else {
        return;
    };
    let bounds = desk.setup.bounds;
    let service = router.layer(Extension(Arc::new(Line::new(peer, local))));
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(bounds.head)
        .max_buf_size(HEAD_MAX)
        .serve_connection(
            TokioIo::new(Patient::new(stream, bounds.stall)),
            TowerToHyperService::new(service),
        )
        .with_upgrades();
    let mut connection = std::pin::pin!(connection);
    // How a client leaves is its own affair.
    tokio::select! {
        _ = connection.as_mut() => return,
        () = desk.cancel.cancelled() => connection.as_mut().graceful_shutdown(),
    }
    let _ = connection.await;
}

/// Says that there is no room, and waits until that is heard: closing a connection with unread bytes would take
/// the words back.
async fn turn_away(mut stream: TcpStream, _permit: OwnedSemaphorePermit) {
    let told = async {
        stream.write_all(TOO_MANY).await?;
        stream.shutdown().await?;
        let mut rest = [0; 1024];
        while stream.read(&mut rest).await? > 0 {}
        io::Result::Ok(())
    };
    let _ = tokio::time::timeout(FAREWELL, told).await;
}
