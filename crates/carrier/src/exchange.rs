//! Moves lines between a stream and a port.

use std::time::Duration;

use serde::de::DeserializeOwned;
use tokio::io::{AsyncRead, AsyncWrite, AsyncWriteExt as _, BufReader};
use tokio::sync::mpsc;
use tokio::time::timeout;

use super::lines::{ReadLine, read_line};
use sortie_class::protocol::{self, LONGEST_LINE, LineFault};

/// How long a peer may take to read a line once nobody sends any more.
const GRACE: Duration = Duration::from_secs(2);

/// Passes lines in both directions until the stream ends, a line cannot be read, or the port is gone. The reader waits
/// while the port has no room, so a peer that floods the connection delays only itself.
pub(super) async fn exchange<M: DeserializeOwned, A>(
    read: impl AsyncRead + Unpin,
    write: impl AsyncWrite + Unpin,
    lines: mpsc::Receiver<String>,
    arrived: &mpsc::Sender<A>,
    arrival: impl Fn(Result<M, LineFault>) -> A,
) {
    tokio::select! {
        biased;
        // First, because the other one ends at once when the port is gone.
        () = pass_out(lines, write) => {}
        () = pass_in(read, arrived, arrival) => {}
    }
}

async fn pass_in<M: DeserializeOwned, A>(
    read: impl AsyncRead + Unpin,
    arrived: &mpsc::Sender<A>,
    arrival: impl Fn(Result<M, LineFault>) -> A,
) {
    let mut read = BufReader::new(read);
    while let Some(line) = read_line(&mut read, LONGEST_LINE).await {
        let message = match line {
            ReadLine::TooLong => Err(LineFault::TooLong),
            ReadLine::Line(bytes) => protocol::read(&bytes),
        };
        let is_faulty = message.is_err();
        if arrived.send(arrival(message)).await.is_err() || is_faulty {
            return;
        }
    }
}

/// Writes lines until all senders are gone or the stream ends. Once they are gone, a peer that does not read keeps the
/// connection only for a while.
async fn pass_out(mut lines: mpsc::Receiver<String>, mut write: impl AsyncWrite + Unpin) {
    while let Some(line) = lines.recv().await {
        let written = write.write_all(line.as_bytes());
        tokio::pin!(written);
        loop {
            match timeout(GRACE, &mut written).await {
                Ok(Ok(())) => break,
                Ok(Err(_)) => return,
                Err(_) if lines.is_closed() => return,
                Err(_) => {}
            }
        }
    }
}
