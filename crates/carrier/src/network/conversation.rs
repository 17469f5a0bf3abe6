//! Moves lines between Zenoh and a port.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use ring::signature::Ed25519KeyPair;
use serde::de::DeserializeOwned;
use sortie_class::protocol::{self, LineFault};
use tokio::sync::mpsc;
use tokio::time::{Instant, MissedTickBehavior, interval};
use zenoh::Session;
use zenoh::pubsub::Publisher;
use zenoh::qos::CongestionControl;

use super::flow::{Flow, WINDOW};
use super::frame::{Frame, FrameKind};

/// The time after which a connection has ended without a word of the other side.
pub(super) const SILENCE: Duration = Duration::from_secs(4);
/// The time after which a side says that it is still there.
const KEEP_ALIVE: Duration = Duration::from_secs(1);
/// How often the two times are checked.
const POLL: Duration = Duration::from_millis(500);
/// The maximum number of frames that wait to be read: lines of the window, and frames without lines.
pub(super) const INBOX: usize = 4 * WINDOW as usize;

/// The frames of one connection that have arrived.
pub(super) type Inbox = mpsc::Receiver<Vec<u8>>;

/// One side of a connection.
pub(super) struct Conversation {
    publisher: Publisher<'static>,
    signer: Arc<Ed25519KeyPair>,
    own_key: String,
    /// The public key of the other side.
    other: Vec<u8>,
    other_key: String,
    flow: Flow,
    spoke_at: Instant,
}

/// Who signs on which key, and who answers on which.
pub(super) struct Parties {
    pub signer: Arc<Ed25519KeyPair>,
    pub own_key: String,
    pub other: Vec<u8>,
    pub other_key: String,
}

impl Conversation {
    /// A conversation in which the frames of `flow` have been sent and received.
    pub async fn new(session: &Session, parties: Parties, flow: Flow) -> zenoh::Result<Self> {
        let publisher = session.declare_publisher(parties.own_key.clone());
        // A frame that the queue has no room for is dropped, which ends the connection: the sender never waits.
        let publisher = publisher.congestion_control(CongestionControl::Drop);
        Ok(Self {
            publisher: publisher.await?,
            signer: parties.signer,
            own_key: parties.own_key,
            other: parties.other,
            other_key: parties.other_key,
            flow,
            spoke_at: Instant::now(),
        })
    }

    /// The next frame, signed.
    pub fn sealed(&mut self, kind: FrameKind, body: Vec<u8>) -> Vec<u8> {
        self.spoke_at = Instant::now();
        self.flow
            .frame(kind, body)
            .seal(&self.signer, &self.own_key)
    }

    /// Sends bytes. If they get lost, the other side misses their number.
    pub async fn put(&self, bytes: Vec<u8>) {
        drop(self.publisher.put(bytes).await);
    }

    pub async fn say(&mut self, kind: FrameKind, body: Vec<u8>) {
        let bytes = self.sealed(kind, body);
        self.put(bytes).await;
    }

    /// Reads the next frame of the other side; `None` if it is of somebody else, or not the next one.
    pub fn hear(&mut self, bytes: &[u8]) -> Option<Frame> {
        let frame = Frame::open(bytes, &self.other, &self.other_key)?;
        self.flow.admit(&frame).then_some(frame)
    }

    /// Says that this side is still there, if it has said nothing for a while.
    async fn keep_alive(&mut self) {
        if self.spoke_at.elapsed() >= KEEP_ALIVE {
            self.say(FrameKind::KeepAlive, Vec::new()).await;
        }
    }

    /// Counts a line that the console has taken, and says so before the other side has to wait.
    async fn acknowledge(&mut self) {
        self.flow.take();
        if self.flow.has_to_tell() {
            self.say(FrameKind::KeepAlive, Vec::new()).await;
        }
    }

    /// Passes lines in both directions until one side ends the connection, nothing is heard, a line cannot be read, or
    /// the port is gone.
    pub async fn pass<M: DeserializeOwned, A>(
        mut self,
        mut inbox: Inbox,
        mut lines: mpsc::Receiver<String>,
        arrived: &mpsc::Sender<A>,
        arrival: impl Fn(Result<M, LineFault>) -> A,
    ) {
        let mut poll = interval(POLL);
        poll.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut heard = Heard::nothing();
        while !heard.is_all_taken() {
            let goes_on = tokio::select! {
                bytes = inbox.recv(), if !heard.has_left => self.take_in(bytes, &mut heard),
                permit = arrived.reserve(), if !heard.lines.is_empty() => match permit {
                    Ok(permit) => self.hand_over(&mut heard, permit, &arrival).await,
                    Err(_) => false,
                },
                line = lines.recv(), if self.flow.has_room() && !heard.has_left => {
                    self.say_line(line).await
                }
                _ = poll.tick() => {
                    self.keep_alive().await;
                    heard.at.elapsed() < SILENCE
                }
                () = arrived.closed() => false,
            };
            if !goes_on {
                break;
            }
        }
        self.say(FrameKind::Bye, Vec::new()).await;
    }

    /// Takes in a frame; `false` if the other side is gone or has sent what it may not.
    fn take_in(&mut self, bytes: Option<Vec<u8>>, heard: &mut Heard) -> bool {
        let Some(frame) = bytes.and_then(|bytes| self.hear(&bytes)) else {
            return false;
        };
        heard.note(frame);
        true
    }

    /// Hands a line over to the console; `false` if it is no message.
    async fn hand_over<M: DeserializeOwned, A>(
        &mut self,
        heard: &mut Heard,
        permit: mpsc::Permit<'_, A>,
        arrival: &impl Fn(Result<M, LineFault>) -> A,
    ) -> bool {
        let Some(line) = heard.lines.pop_front() else {
            return true;
        };
        let message = protocol::read(&line);
        let is_message = message.is_ok();
        permit.send(arrival(message));
        if is_message {
            self.acknowledge().await;
        }
        is_message
    }

    /// Sends a line of the console; `false` if it has no more.
    async fn say_line(&mut self, line: Option<String>) -> bool {
        match line {
            Some(line) => self.say(FrameKind::Line, line.into_bytes()).await,
            None => return false,
        }
        true
    }
}

/// What the other side has said.
struct Heard {
    /// When it last said something.
    at: Instant,
    /// The lines that the console has not taken yet.
    lines: VecDeque<Vec<u8>>,
    /// Whether it has ended the connection.
    has_left: bool,
}

impl Heard {
    fn nothing() -> Self {
        Self {
            at: Instant::now(),
            lines: VecDeque::new(),
            has_left: false,
        }
    }

    fn note(&mut self, frame: Frame) {
        self.at = Instant::now();
        match frame.kind {
            FrameKind::Line => self.lines.push_back(frame.body),
            FrameKind::Bye => self.has_left = true,
            FrameKind::KeepAlive | FrameKind::Hello | FrameKind::Open => {}
        }
    }

    /// Whether nothing more comes.
    fn is_all_taken(&self) -> bool {
        self.has_left && self.lines.is_empty()
    }
}
