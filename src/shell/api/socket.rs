//! A Unix socket that only its owner can use.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use tokio::io::{AsyncRead, AsyncWrite, AsyncWriteExt as _};
use tokio::net::{UnixListener, UnixStream};
use tokio::sync::{Semaphore, mpsc};
use tokio::task::JoinHandle;
use tokio::time::timeout;

use super::{Arrival, Exchange, MOST_PROGRAMS, ProgramId, converse, shown};
use crate::carrier::socket::{self, SocketFault};
use crate::text;

/// The maximum number of programs that are turned away at once.
const MOST_TURNED_AWAY: usize = 16;
/// How long a program that is turned away has to read the reason.
const FAREWELL: Duration = Duration::from_secs(2);

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
    let farewells = Arc::new(Semaphore::new(MOST_TURNED_AWAY));
    for number in 0.. {
        let Ok((stream, _)) = listener.accept().await else {
            // No file descriptors are left until a connection ends.
            tokio::task::yield_now().await;
            continue;
        };
        let exchange = exchange.clone();
        let Ok(place) = Arc::clone(&places).try_acquire_owned() else {
            // Beyond this number as well, the connection is closed without a word.
            if let Ok(turn) = Arc::clone(&farewells).try_acquire_owned() {
                tokio::spawn(async move {
                    let (read, write) = stream.into_split();
                    drop(timeout(FAREWELL, turn_away(read, write, exchange)).await);
                    drop(turn);
                });
            }
            continue;
        };
        tokio::spawn(async move {
            serve(stream, ProgramId(number), exchange).await;
            drop(place);
        });
    }
}

/// Tells a program why it is not connected. Its requests are read until it closes the connection, because closing with
/// unread requests would discard the reason.
async fn turn_away(
    mut read: impl AsyncRead + Unpin,
    mut write: impl AsyncWrite + Unpin,
    exchange: Exchange,
) {
    let (outbox, mut reason) = mpsc::channel(1);
    if exchange
        .arrived
        .send(Arrival::Crowded(outbox))
        .await
        .is_err()
    {
        return;
    }
    let Some(line) = reason.recv().await else {
        return;
    };
    let written = write.write_all(format!("{line}\n").as_bytes()).await;
    if written.is_ok() && write.shutdown().await.is_ok() {
        drop(tokio::io::copy(&mut read, &mut tokio::io::sink()).await);
    }
}

async fn serve(stream: UnixStream, id: ProgramId, exchange: Exchange) {
    let (read, write) = stream.into_split();
    converse(id, read, write, exchange).await;
}

#[cfg(test)]
mod tests {
    use std::io::{BufRead as _, BufReader, Write as _};
    use std::os::unix::net::UnixStream as Blocking;

    use tokio_util::sync::CancellationToken;

    use super::*;

    #[tokio::test(flavor = "multi_thread", worker_threads = 2)]
    async fn the_program_for_which_there_is_no_place_is_told_why() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("api");
        let (arrived, mut arrivals) = mpsc::channel(4);
        let exchange = Exchange {
            arrived,
            ending: CancellationToken::new(),
            writing: mpsc::channel(1).0,
        };
        let _listener = Listener::open(&path, exchange).expect("a socket");
        let mut connected = Vec::new();
        for _ in 0..MOST_PROGRAMS {
            connected.push(Blocking::connect(&path).expect("connected"));
            let arrival = arrivals.recv().await;
            assert!(matches!(arrival, Some(Arrival::Opened(..))));
        }
        let mut last = Blocking::connect(&path).expect("connected");
        last.write_all(b"a request\n").expect("written");
        let Some(Arrival::Crowded(outbox)) = arrivals.recv().await else {
            panic!("a place beyond the last");
        };
        outbox.send("no place".to_owned()).await.expect("awaited");
        let lines = BufReader::new(last).lines();
        let told: Vec<String> = lines.map(|line| line.expect("no reset")).collect();
        assert_eq!(told, ["no place"]);
    }
}
