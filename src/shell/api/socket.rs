//! A Unix socket that only its owner can use.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use tokio::net::{UnixListener, UnixStream};
use tokio::sync::Semaphore;
use tokio::task::JoinHandle;

use super::{Exchange, MOST_PROGRAMS, ProgramId, converse, shown};
use crate::carrier::socket::{self, SocketFault};
use crate::text;

/// Accepts connections until it is dropped; then it removes the socket.
pub struct Listener {
    path: PathBuf,
    task: JoinHandle<()>,
}

impl Listener {
    /// Opens the socket.
    ///
    /// # Errors
    /// The path is taken by another program or another file, or the socket cannot be created there.
    pub fn open(path: &Path, exchange: Exchange) -> anyhow::Result<Self> {
        let listener = socket::open(path, 0o600).map_err(|fault| not_opened(path, &fault))?;
        Ok(Self {
            path: path.to_owned(),
            task: tokio::spawn(accept(listener, exchange)),
        })
    }
}

impl Drop for Listener {
    fn drop(&mut self) {
        self.task.abort();
        // It may have been removed already.
        drop(fs::remove_file(&self.path));
    }
}

fn not_opened(path: &Path, fault: &SocketFault) -> anyhow::Error {
    let socket = shown(path);
    let text = match fault {
        SocketFault::NoSocket => text!("api-no-socket", socket = socket),
        SocketFault::InUse => text!("api-in-use", socket = socket),
        SocketFault::Io(error) => {
            text!("api-not-open", socket = socket, error = error.to_string())
        }
    };
    anyhow::anyhow!(text.to_string())
}

async fn accept(listener: UnixListener, exchange: Exchange) {
    let places = Arc::new(Semaphore::new(MOST_PROGRAMS));
    for number in 0.. {
        let Ok((stream, _)) = listener.accept().await else {
            // No file descriptors are left until a connection ends.
            tokio::task::yield_now().await;
            continue;
        };
        // Beyond the maximum number of programs, the connection is closed.
        let Ok(place) = Arc::clone(&places).try_acquire_owned() else {
            continue;
        };
        let exchange = exchange.clone();
        tokio::spawn(async move {
            serve(stream, ProgramId(number), exchange).await;
            drop(place);
        });
    }
}

async fn serve(stream: UnixStream, id: ProgramId, exchange: Exchange) {
    let (read, write) = stream.into_split();
    converse(id, read, write, exchange).await;
}
