//! Moves lines between Zenoh and a port.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use ring::signature::Ed25519KeyPair;
use serde::de::DeserializeOwned;
use sortie_class::protocol::{self, LONGEST_LINE, LineFault};
use tokio::sync::mpsc;
use tokio::time::{Instant, MissedTickBehavior, interval};
use zenoh::pubsub::Publisher;
use zenoh::qos::CongestionControl;
use zenoh::{Session, Wait as _};

use super::flow::{Flow, WINDOW};
use super::frame::{Frame, FrameKind, LONGEST_BODY};

/// The time after which a connection has ended without a word of the other side.
pub(super) const SILENCE: Duration = Duration::from_secs(4);
/// The time after which a side says that it is still there.
const BEAT: Duration = Duration::from_secs(1);
/// How often the two times are looked at.
const LOOK: Duration = Duration::from_millis(500);
/// The maximum number of frames that wait to be read: the parts of the lines of the window, and frames without lines.
pub(super) const INBOX: usize = 6 * WINDOW as usize;

/// The frames of one connection that have arrived.
pub(super) type Inbox = mpsc::Receiver<Vec<u8>>;

/// One side of a connection.
pub(super) struct Conversation {
    publisher: Arc<Publisher<'static>>,
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

/// What the other side has said.
struct Heard {
    /// When it last said something.
    at: Instant,
    /// The parts of the line that is not complete yet.
    begun: Vec<u8>,
    /// Lines that the console has not taken yet, oldest first.
    waiting: VecDeque<Vec<u8>>,
    /// Whether it has ended the connection.
    is_over: bool,
}

impl Heard {
    fn new() -> Self {
        Self {
            at: Instant::now(),
            begun: Vec::new(),
            waiting: VecDeque::new(),
            is_over: false,
        }
    }

    fn take_in(&mut self, frame: Frame) {
        self.at = Instant::now();
        match frame.kind {
            FrameKind::Part | FrameKind::Line => {
                self.begun.extend(frame.body);
                // One that is too long is passed on as it is, and refused by its reader.
                if frame.kind == FrameKind::Line || self.begun.len() > LONGEST_LINE {
                    self.waiting.push_back(std::mem::take(&mut self.begun));
                }
            }
            FrameKind::Bye => self.is_over = true,
            FrameKind::Beat | FrameKind::Hello | FrameKind::Open => {}
        }
    }
}

impl Conversation {
    pub async fn new(session: &Session, parties: Parties) -> zenoh::Result<Self> {
        let publisher = session.declare_publisher(parties.own_key.clone());
        // By default, Zenoh drops what its queue has no room for.
        let publisher = publisher.congestion_control(CongestionControl::Block);
        Ok(Self {
            publisher: Arc::new(publisher.await?),
            signer: parties.signer,
            own_key: parties.own_key,
            other: parties.other,
            other_key: parties.other_key,
            flow: Flow::default(),
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

    /// Sends bytes. If they get lost, the other side misses their number. Zenoh blocks the thread while its queue has no
    /// room, so it gets a thread of its own, and only this connection waits.
    pub async fn put(&self, bytes: Vec<u8>) {
        let publisher = Arc::clone(&self.publisher);
        let put = move || drop(publisher.put(bytes).wait());
        drop(tokio::task::spawn_blocking(put).await);
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

    /// Passes lines in both directions until one side ends the connection, nothing is heard, a line cannot be read, or
    /// the port is gone.
    pub async fn pass<M: DeserializeOwned, A>(
        mut self,
        mut inbox: Inbox,
        mut lines: mpsc::Receiver<String>,
        arrived: &mpsc::Sender<A>,
        arrival: impl Fn(Result<M, LineFault>) -> A,
    ) {
        let mut look = interval(LOOK);
        look.set_missed_tick_behavior(MissedTickBehavior::Delay);
        let mut heard = Heard::new();
        while !(heard.is_over && heard.waiting.is_empty()) {
            tokio::select! {
                bytes = inbox.recv(), if !heard.is_over => {
                    match bytes.and_then(|bytes| self.hear(&bytes)) {
                        Some(frame) => heard.take_in(frame),
                        None => break,
                    }
                }
                permit = arrived.reserve(), if !heard.waiting.is_empty() => {
                    let (Ok(permit), Some(line)) = (permit, heard.waiting.pop_front()) else {
                        break;
                    };
                    let message = protocol::read(&line);
                    let is_faulty = message.is_err();
                    permit.send(arrival(message));
                    if is_faulty {
                        break;
                    }
                    self.note_taken().await;
                }
                line = lines.recv(), if self.flow.has_room() && !heard.is_over => match line {
                    Some(line) => self.say_line(line.as_bytes()).await,
                    None => break,
                },
                _ = look.tick() => {
                    if heard.at.elapsed() >= SILENCE {
                        break;
                    }
                    self.stay().await;
                }
                () = arrived.closed() => break,
            }
        }
        self.say(FrameKind::Bye, Vec::new()).await;
    }

    async fn say_line(&mut self, line: &[u8]) {
        let mut parts = line.chunks(LONGEST_BODY).peekable();
        while let Some(part) = parts.next() {
            let is_last = parts.peek().is_none();
            let kind = if is_last {
                FrameKind::Line
            } else {
                FrameKind::Part
            };
            self.say(kind, part.to_vec()).await;
        }
    }

    /// The console has taken a line; the other side hears of it before it has to wait.
    async fn note_taken(&mut self) {
        self.flow.take();
        if self.flow.has_to_tell() {
            self.say(FrameKind::Beat, Vec::new()).await;
        }
    }

    /// Says that this side is still there, if it has said nothing else.
    async fn stay(&mut self) {
        if self.spoke_at.elapsed() >= BEAT {
            self.say(FrameKind::Beat, Vec::new()).await;
        }
    }
}
