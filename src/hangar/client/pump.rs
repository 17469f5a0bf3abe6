//! Carries a vehicle's bytes, across lost connections.

use std::time::Duration;

use hyper::Method;
use hyper::header;
use hyper::upgrade::Upgraded;
use hyper_util::rt::TokioIo;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, DuplexStream};
use tokio::time::{sleep, timeout};
use tokio_util::sync::CancellationToken;

use super::{ANSWER, ClientError, RemoteHangar};
use crate::hangar::InstanceId;
use crate::hangar::service::MAVLINK;

const READ_LEN: usize = 4096;
/// The time without progress after which a connection is considered dead.
const STALL: Duration = Duration::from_secs(10);

/// A growing delay between attempts.
#[derive(Debug)]
pub(super) struct Backoff(Duration);

impl Default for Backoff {
    fn default() -> Self {
        Self(Self::FIRST)
    }
}

impl Backoff {
    const FIRST: Duration = Duration::from_millis(100);
    const LAST: Duration = Duration::from_secs(5);

    /// Resets the delay after a success.
    pub fn reset(&mut self) {
        self.0 = Self::FIRST;
    }

    pub async fn pause(&mut self) {
        sleep(self.0).await;
        self.0 = (self.0 * 2).min(Self::LAST);
    }
}

/// Carries bytes until cancelled or until the other end of the pipe is dropped.
pub(super) async fn run(
    remote: RemoteHangar,
    id: InstanceId,
    mut pipe: DuplexStream,
    cancel: CancellationToken,
) {
    let mut backoff = Backoff::default();
    let carrying = async {
        loop {
            let opened = timeout(ANSWER, open(&remote, id)).await;
            if let Ok(Ok(upgraded)) = opened {
                backoff.reset();
                if carry(&mut pipe, upgraded).await == Lost::Pipe {
                    return;
                }
            }
            // Without a receiver, bytes are dropped; this also shows when the sender ends.
            tokio::select! {
                () = backoff.pause() => {}
                () = swallow(&mut pipe) => return,
            }
        }
    };
    tokio::select! {
        () = carrying => {}
        () = cancel.cancelled() => {}
    }
}

async fn open(remote: &RemoteHangar, id: InstanceId) -> Result<Upgraded, ClientError> {
    let path = format!("/vehicles/{id}/mavlink");
    let mut request = remote.request(Method::GET, &path, None)?;
    let headers = request.headers_mut();
    let upgrade = header::HeaderValue::from_static("upgrade");
    headers.insert(header::CONNECTION, upgrade);
    headers.insert(header::UPGRADE, header::HeaderValue::from_static(MAVLINK));
    let response = remote.send(request).await?;
    hyper::upgrade::on(response)
        .await
        .map_err(|error| remote.unreachable(std::io::Error::other(error)))
}

#[derive(Debug, PartialEq, Eq)]
enum Lost {
    Connection,
    Pipe,
}

async fn carry(pipe: &mut DuplexStream, upgraded: Upgraded) -> Lost {
    let (mut pipe_in, mut pipe_out) = tokio::io::split(pipe);
    let (mut line_in, mut line_out) = tokio::io::split(TokioIo::new(upgraded));
    let out = async {
        let mut bytes = [0; READ_LEN];
        loop {
            match pipe_in.read(&mut bytes).await {
                Ok(0) | Err(_) => return Lost::Pipe,
                Ok(len) => {
                    if !matches!(
                        timeout(STALL, line_out.write_all(&bytes[..len])).await,
                        Ok(Ok(()))
                    ) {
                        return Lost::Connection;
                    }
                }
            }
        }
    };
    let back = async {
        let mut bytes = [0; READ_LEN];
        loop {
            match line_in.read(&mut bytes).await {
                Ok(0) | Err(_) => return Lost::Connection,
                Ok(len) => {
                    if pipe_out.write_all(&bytes[..len]).await.is_err() {
                        return Lost::Pipe;
                    }
                }
            }
        }
    };
    tokio::select! {
        lost = out => lost,
        lost = back => lost,
    }
}

/// Reads and discards until the other end is closed.
async fn swallow(pipe: &mut DuplexStream) {
    let mut bytes = [0; READ_LEN];
    while pipe.read(&mut bytes).await.is_ok_and(|len| len > 0) {}
}
