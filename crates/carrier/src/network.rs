//! The carrier on several machines, over Eclipse Zenoh.
//!
//! The desk is a router that listens at one address, and every seat is a client of it: no discovery, no gossip, no
//! other routers. A connection has two keys, `sortie/1/CLASS/SEAT/NUMBER/up` and `…/down`, where NUMBER is drawn at
//! random by the seat. Each carries signed frames ([`frame`]) in one direction.
//!
//! # What protects what
//! - TLS with certificates on both sides: only seats of the class and the desk talk at all. The seat trusts the desk's
//!   certificate and, because Zenoh always does, public authorities; so this alone does not prove the desk.
//! - Zenoh's access list ([`config`]) denies by default. A certificate may send to its own `up`, and hear its own
//!   `down`.
//! - Every frame is signed by its sender's key and has the number that follows the last one. The signature covers
//!   the key of the connection, and so the class, the seat, the random number and the direction. A frame of somebody
//!   else, of another connection, or one that is repeated, late or missing ends the connection. A seat says nothing but
//!   its greeting before the desk has signed an answer to its random number.
//!
//! # How lines flow
//! A connection is a numbered stream. Zenoh drops frames for which its queue has no room, and when a link breaks and it
//! makes another one; the next frame that arrives then has the wrong number, and ends the connection. On a link that lasts,
//! nothing has to be dropped: each side sends at most [`flow::WINDOW`] lines that the other has not taken yet, which fit
//! into the queue. So a seat that does not read holds up nobody else, and nothing blocks. Whoever says nothing for a second
//! says that it is still there, and after [`conversation::SILENCE`] without a word a connection has ended.
//!
//! The TLS link of Zenoh 1.10.2 is replaced by `third-party/zenoh-link-tls`: with the published one, links break by
//! themselves when both sides send much at the same time.
//!
//! # How the parts fit
//! - `folder` is the class on disk, and `certificates` makes keys and certificates.
//! - `frame` signs, `flow` counts, `conversation` moves lines between a port and Zenoh.
//! - `desk` and `seat` are the two ends, and `config` are their settings of Zenoh. `switch` passes what arrives at the desk
//!   to its connections, and limits what a seat may send.

mod certificates;
mod config;
mod conversation;
mod desk;
mod flow;
mod folder;
mod frame;
mod seat;
mod switch;

#[cfg(test)]
pub(crate) mod tests;

pub(crate) use desk::open;
pub use folder::NetworkDesk;
pub(crate) use folder::{make, remove_seat};
pub(crate) use seat::join;

use std::time::Duration;

use tokio::sync::oneshot;
use tokio::time::timeout;
use zenoh::{Session, Wait as _};

/// How long the end of a connection waits for its session to be closed.
const CLOSING: Duration = Duration::from_millis(500);

/// A session that is closed when it is dropped, by a thread of its own: closing may take long or hang.
struct OpenSession(Option<Session>);

impl OpenSession {
    async fn open(config: zenoh::Config) -> zenoh::Result<Self> {
        Ok(Self(Some(zenoh::open(config).await?)))
    }

    fn get(&self) -> zenoh::Result<&Session> {
        self.0.as_ref().ok_or_else(|| "closed".into())
    }

    /// Closes the session, and waits a moment until what was sent has left.
    async fn close(mut self) {
        let closed = self.begin_to_close();
        drop(timeout(CLOSING, closed).await);
    }

    fn begin_to_close(&mut self) -> oneshot::Receiver<()> {
        let session = self.0.take();
        let (done, closed) = oneshot::channel();
        let close = move || {
            drop(session.map(|it| it.close().wait()));
            // Nobody may wait any more.
            let _ = done.send(());
        };
        let thread = std::thread::Builder::new().name("class-close".to_owned());
        // Without a thread the session is closed here, when the closure is dropped.
        drop(thread.spawn(close));
        closed
    }
}

impl Drop for OpenSession {
    fn drop(&mut self) {
        if self.0.is_some() {
            drop(self.begin_to_close());
        }
    }
}

/// The keys of one connection.
struct Channel {
    up: String,
    down: String,
}

impl Channel {
    fn new(class: &str, seat: &str, number: &str) -> Self {
        let key = format!("sortie/1/{class}/{seat}/{number}");
        Self {
            up: format!("{key}/up"),
            down: format!("{key}/down"),
        }
    }

    /// The keys of all connections of a seat.
    fn of_seat(class: &str, seat: &str) -> Self {
        Self::new(class, seat, "*")
    }
}
