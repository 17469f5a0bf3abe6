//! Follows the events of a hangar.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use http_body_util::BodyExt as _;
use hyper::Method;
use hyper::body::Incoming;
use serde::Deserialize;
use tokio::sync::watch;
use tokio::time::timeout;
use tokio_util::sync::CancellationToken;

use super::pump::Backoff;
use super::{ANSWER, ClientError, RemoteHangar};
use crate::hangar::service::InstanceSnapshot;
use crate::hangar::{Instance, InstanceId, Instances};

/// A hangar that is silent for this long is considered dead, since it sends something at least every 10 s.
const SILENCE: Duration = Duration::from_secs(25);
/// The maximum size of one event, in bytes.
const EVENT_MAX: usize = 8 * 1024 * 1024;

/// The known state of a hangar.
#[derive(Debug, Clone, Default)]
pub struct HangarView {
    /// The run of the service; `None` before the first contact.
    pub life: Option<String>,
    /// Its instances, as last received.
    pub instances: Instances,
    /// Why the connection is lost, if it is.
    pub lost: Option<Arc<ClientError>>,
}

/// Follows the events until cancelled or until the receiver is gone.
pub(super) async fn run(
    remote: RemoteHangar,
    view: watch::Sender<HangarView>,
    cancel: CancellationToken,
) {
    let mut backoff = Backoff::default();
    let following = async {
        loop {
            let error = follow(&remote, &view, &mut backoff).await;
            view.send_modify(|view| view.lost = Some(Arc::new(error)));
            backoff.pause().await;
        }
    };
    tokio::select! {
        () = following => {}
        () = view.closed() => {}
        () = cancel.cancelled() => {}
    }
}

/// Follows one connection until it is lost, and returns the reason.
async fn follow(
    remote: &RemoteHangar,
    view: &watch::Sender<HangarView>,
    backoff: &mut Backoff,
) -> ClientError {
    let opened = async {
        let request = remote.request(Method::GET, "/events", None)?;
        remote.send(request).await
    };
    let response = match timeout(ANSWER, opened).await {
        Ok(Ok(response)) => response,
        Ok(Err(error)) => return error,
        Err(_) => return remote.late(ANSWER),
    };
    let mut body = response.into_body();
    let mut events = Events::default();
    loop {
        let bytes = match timeout(SILENCE, next_bytes(&mut body)).await {
            Ok(Ok(bytes)) => bytes,
            Ok(Err(why)) => return remote.unreachable(std::io::Error::other(why)),
            Err(_) => return remote.late(SILENCE),
        };
        for (name, data) in events.push(&bytes) {
            if let Err(why) = take_in(view, &name, &data) {
                return remote.not_a_hangar(why);
            }
            backoff.reset();
        }
        if events.len() > EVENT_MAX {
            return remote.not_a_hangar("one of its events is too long".to_owned());
        }
    }
}

async fn next_bytes(body: &mut Incoming) -> Result<Vec<u8>, String> {
    loop {
        match body.frame().await {
            Some(Ok(frame)) => {
                if let Ok(bytes) = frame.into_data() {
                    return Ok(bytes.to_vec());
                }
            }
            Some(Err(error)) => return Err(error.to_string()),
            None => return Err("it has ended the connection".to_owned()),
        }
    }
}

fn take_in(view: &watch::Sender<HangarView>, name: &str, data: &str) -> Result<(), String> {
    #[derive(Deserialize)]
    struct Gone {
        id: InstanceId,
    }
    let wrong = |error: serde_json::Error| format!("its event {name} is not valid: {error}");
    match name {
        "snapshot" => {
            let InstanceSnapshot { life, vehicles } = serde_json::from_str(data).map_err(wrong)?;
            let all: BTreeMap<_, _> = vehicles.into_iter().map(|one| (one.id, one)).collect();
            view.send_replace(HangarView {
                life: Some(life),
                instances: Arc::new(all),
                lost: None,
            });
        }
        "vehicle" => {
            let instance: Instance = serde_json::from_str(data).map_err(wrong)?;
            view.send_modify(|view| {
                Arc::make_mut(&mut view.instances).insert(instance.id, instance);
            });
        }
        "gone" => {
            let Gone { id } = serde_json::from_str(data).map_err(wrong)?;
            view.send_modify(|view| drop(Arc::make_mut(&mut view.instances).remove(&id)));
        }
        // An unknown event, from a newer hangar.
        _ => {}
    }
    Ok(())
}

/// A parser of `text/event-stream`.
#[derive(Debug, Default)]
struct Events {
    bytes: Vec<u8>,
    name: String,
    data: String,
}

impl Events {
    /// Adds bytes; returns the names and the data of complete events.
    fn push(&mut self, bytes: &[u8]) -> Vec<(String, String)> {
        let mut found = Vec::new();
        self.bytes.extend_from_slice(bytes);
        let mut from = 0;
        while let Some(len) = self.bytes[from..].iter().position(|&byte| byte == b'\n') {
            let line = String::from_utf8_lossy(&self.bytes[from..from + len]).into_owned();
            from += len + 1;
            if let Some(event) = self.line(line.trim_end_matches('\r')) {
                found.push(event);
            }
        }
        self.bytes.drain(..from);
        found
    }

    /// The size of the incomplete event, in bytes.
    fn len(&self) -> usize {
        self.bytes.len() + self.data.len()
    }

    fn line(&mut self, line: &str) -> Option<(String, String)> {
        if line.is_empty() {
            let event = (
                std::mem::take(&mut self.name),
                std::mem::take(&mut self.data),
            );
            return (!event.1.is_empty()).then_some(event);
        }
        // A line that begins with a colon is a comment.
        let (field, value) = line.split_once(':').unwrap_or((line, ""));
        let value = value.strip_prefix(' ').unwrap_or(value);
        match field {
            "event" => value.clone_into(&mut self.name),
            "data" => {
                if !self.data.is_empty() {
                    self.data.push('\n');
                }
                self.data.push_str(value);
            }
            _ => {}
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_are_found_however_the_bytes_are_cut() {
        let stream = ": hello\n\nevent: a\ndata: 1\n\ndata:2\r\ndata: 3\r\n\r\nevent: b\n\nevent: c\ndata: \u{457}\n\n";
        let expected = [("a", "1"), ("", "2\n3"), ("c", "\u{457}")];
        let expected: Vec<_> = expected
            .map(|(name, data)| (name.to_owned(), data.to_owned()))
            .into();
        for len in 1..stream.len() {
            let mut events = Events::default();
            let found: Vec<_> = stream
                .as_bytes()
                .chunks(len)
                .flat_map(|bytes| events.push(bytes))
                .collect();
            assert_eq!(found, expected, "in pieces of {len}");
            assert_eq!(events.len(), 0);
        }
    }
}
