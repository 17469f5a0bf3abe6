//! Moves lines between a stream and a port.

use serde::de::DeserializeOwned;
use tokio::io::{AsyncRead, AsyncWrite, AsyncWriteExt as _, BufReader};
use tokio::sync::mpsc;

use super::lines::{ReadLine, read_line};
use sortie_class::protocol::{self, LONGEST_LINE, LineFault};

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
        () = pass_in(read, arrived, arrival) => {}
        () = pass_out(lines, write) => {}
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

/// Writes lines until all senders are gone or the stream ends.
async fn pass_out(mut lines: mpsc::Receiver<String>, mut write: impl AsyncWrite + Unpin) {
    while let Some(line) = lines.recv().await {
        if write.write_all(line.as_bytes()).await.is_err() {
            return;
        }
    }
}
