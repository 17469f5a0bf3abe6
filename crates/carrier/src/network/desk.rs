//! The desk's end.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use ring::signature::Ed25519KeyPair;
use sortie_class::{ConnectionId, SEATS};
use tokio::net::{TcpSocket, lookup_host};
use tokio::sync::mpsc;
use tokio::task::JoinSet;
use zenoh::pubsub::Subscriber;
use zenoh::sample::Sample;

use super::config::CONSOLES_OF_A_SEAT;
use super::conversation::{Conversation, INBOX, Inbox, Parties};
use super::folder::NetworkDesk;
use super::frame::{Frame, FrameKind, signer};
use super::{Channel, OpenSession, config};
use crate::fault::{ClassFault, NetworkFault};
use crate::host::own_user_name;
use crate::ports::{CarrierPeer, DeskArrival, DeskPort, Outbox};

/// The maximum number of arrivals, from all connections together, that wait for the console.
const ARRIVALS: usize = 64;
/// The maximum number of greetings that wait to be answered: one of each seat. Seats repeat theirs.
const GREETINGS: usize = SEATS;
/// How long the end of the desk waits for all its connections to say goodbye.
const GOODBYE: Duration = Duration::from_millis(500);

/// Opens the desk of a class on several machines.
///
/// # Errors
/// Its address cannot be listened at.
pub(crate) async fn open(desk: &NetworkDesk) -> Result<DeskPort, ClassFault> {
    let settings = config::of_desk(desk)?;
    let address = || desk.listen.clone();
    // Zenoh's own words for a failure may contain its settings, and so the key.
    let not_open = |_| NetworkFault::NotStarted(address());
    let free = find_free(&desk.listen).await;
    free.map_err(|error| NetworkFault::NotOpen {
        address: address(),
        error,
    })?;
    let signer = Arc::new(signer(&desk.keys.key.0)?);
    let session = OpenSession::open(settings).await.map_err(not_open)?;
    let (switch, greetings) = Switch::new();
    let switch = Arc::new(switch);
    let heard = hear_seats(&session, desk, &switch).await;
    let subscribers = heard.map_err(not_open)?;
    let (arrived, arrivals) = mpsc::channel(ARRIVALS);
    let reception = Reception {
        desk: desk.clone(),
        session,
        signer,
        switch,
    };
    let task = tokio::spawn(async move {
        reception.admit(greetings, &arrived).await;
        drop(subscribers);
        reception.session.close().await;
    });
    Ok(DeskPort { arrivals, task })
}

/// Checks that an address can be listened at, without listening: seats would take that for a desk.
async fn find_free(listen: &str) -> io::Result<()> {
    for address in lookup_host(listen).await? {
        let socket = if address.is_ipv4() {
            TcpSocket::new_v4()?
        } else {
            TcpSocket::new_v6()?
        };
        socket.set_reuseaddr(true)?;
        socket.bind(address)?;
    }
    Ok(())
}

/// Which seat has which connection open.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Caller {
    seat: String,
    /// The random number of the connection.
    number: String,
}

/// The first frame of a connection, not read yet.
struct Greeting {
    caller: Caller,
    bytes: Vec<u8>,
}

/// Passes frames to their connections.
struct Switch {
    lines: Mutex<SwitchLines>,
    greeted: mpsc::Sender<Greeting>,
}

#[derive(Default)]
struct SwitchLines {
    open: BTreeMap<Caller, mpsc::Sender<Vec<u8>>>,
    /// The seats with a greeting that waits to be answered. Another one of them is dropped, so that a seat that floods
    /// the desk with greetings does not keep the others out.
    waiting: BTreeSet<String>,
}

impl Switch {
    fn new() -> (Self, mpsc::Receiver<Greeting>) {
        let (greeted, greetings) = mpsc::channel(GREETINGS);
        let lines = Mutex::default();
        (Self { lines, greeted }, greetings)
    }

    fn lines(&self) -> MutexGuard<'_, SwitchLines> {
        self.lines.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes a frame in, without waiting: it is called by the thread that reads for all seats.
    fn pass(&self, caller: Caller, bytes: Vec<u8>) {
        let mut lines = self.lines();
        match lines.open.get(&caller) {
            // A greeting is repeated until it is answered.
            Some(_) if Frame::may_be_hello(&bytes) => {}
            Some(inbox) => {
                let has_room = inbox.try_send(bytes).is_ok();
                // Nobody who keeps to the window fills it.
                if !has_room {
                    lines.open.remove(&caller);
                }
            }
            None if Frame::may_be_hello(&bytes) && !lines.waiting.contains(&caller.seat) => {
                let seat = caller.seat.clone();
                if self.greeted.try_send(Greeting { caller, bytes }).is_ok() {
                    lines.waiting.insert(seat);
                }
            }
            None => {}
        }
    }

    /// Opens a connection; `None` if the seat or the class has too many.
    fn connect(&self, caller: &Caller) -> Option<Inbox> {
        let open = &mut self.lines().open;
        let of_seat = open.keys().filter(|it| it.seat == caller.seat).count();
        if open.contains_key(caller) || of_seat >= CONSOLES_OF_A_SEAT || open.len() >= SEATS {
            return None;
        }
        let (sender, inbox) = mpsc::channel(INBOX);
        open.insert(caller.clone(), sender);
        Some(inbox)
    }

    fn disconnect(&self, caller: &Caller) {
        self.lines().open.remove(caller);
    }

    /// The greeting of a seat has been answered, or not: it may send another one.
    fn listen_again(&self, seat: &str) {
        self.lines().waiting.remove(seat);
    }
}

/// Listens to all seats of the class, each on its own keys: one wildcard for all would be told to the seats, whose
/// rights do not include it.
async fn hear_seats(
    session: &OpenSession,
    desk: &NetworkDesk,
    switch: &Arc<Switch>,
) -> zenoh::Result<Vec<Subscriber<()>>> {
    let mut subscribers = Vec::new();
    for seat in desk.keys.seats.keys() {
        let key = Channel::of_seat(&desk.keys.class, seat).up;
        let (switch, seat) = (Arc::clone(switch), seat.clone());
        let pass = move |sample: Sample| {
            let number = sample.key_expr().as_str().rsplit('/').nth(1);
            let caller = Caller {
                seat: seat.clone(),
                number: number.unwrap_or_default().to_owned(),
            };
            switch.pass(caller, sample.payload().to_bytes().into_owned());
        };
        subscribers.push(
            session
                .get()?
                .declare_subscriber(key)
                .callback(pass)
                .await?,
        );
    }
    Ok(subscribers)
}

/// Answers greetings.
struct Reception {
    desk: NetworkDesk,
    session: OpenSession,
    signer: Arc<Ed25519KeyPair>,
    switch: Arc<Switch>,
}

impl Reception {
    /// Serves seats until the console is gone.
    async fn admit(
        &self,
        mut greetings: mpsc::Receiver<Greeting>,
        arrived: &mpsc::Sender<DeskArrival>,
    ) {
        let mut connections = JoinSet::new();
        let mut number = 0;
        loop {
            let greeting = tokio::select! {
                greeting = greetings.recv() => greeting,
                () = arrived.closed() => break,
            };
            let Some(Greeting { caller, bytes }) = greeting else {
                break;
            };
            while connections.try_join_next().is_some() {}
            number += 1;
            let opened = self.greet(&caller, &bytes).await;
            self.switch.listen_again(&caller.seat);
            if let Ok(Some(opened)) = opened {
                let (arrived, switch) = (arrived.clone(), Arc::clone(&self.switch));
                connections.spawn(async move {
                    serve(opened, ConnectionId(number), &caller, &arrived).await;
                    switch.disconnect(&caller);
                });
            }
        }
        let goodbye = async { while connections.join_next().await.is_some() {} };
        drop(tokio::time::timeout(GOODBYE, goodbye).await);
    }

    /// Opens the connection of a seat; `None` if it may not have one.
    async fn greet(
        &self,
        caller: &Caller,
        bytes: &[u8],
    ) -> zenoh::Result<Option<(Conversation, Inbox)>> {
        let Some(seat) = self.desk.keys.seats.get(&caller.seat) else {
            return Ok(None);
        };
        let Channel { up, down } =
            Channel::new(&self.desk.keys.class, &caller.seat, &caller.number);
        let parties = Parties {
            signer: Arc::clone(&self.signer),
            own_key: down,
            other: seat.0.clone(),
            other_key: up,
        };
        let mut conversation = Conversation::new(self.session.get()?, parties).await?;
        let hello = conversation.hear(bytes);
        if hello.is_none_or(|it| it.kind != FrameKind::Hello) {
            return Ok(None);
        }
        let inbox = self.switch.connect(caller);
        Ok(inbox.map(|inbox| (conversation, inbox)))
    }
}

async fn serve(
    (mut conversation, inbox): (Conversation, Inbox),
    connection: ConnectionId,
    caller: &Caller,
    arrived: &mpsc::Sender<DeskArrival>,
) {
    let (outbox, lines) = Outbox::new();
    let user = caller.seat.clone();
    let opened = DeskArrival::Opened {
        connection,
        peer: CarrierPeer { user },
        outbox,
    };
    if arrived.send(opened).await.is_err() {
        return;
    }
    let instructor = own_user_name().into_bytes();
    conversation.say(FrameKind::Open, instructor).await;
    let line = |line| DeskArrival::Line {
        from: connection,
        line,
    };
    conversation.pass(inbox, lines, arrived, line).await;
    drop(arrived.send(DeskArrival::Closed(connection)).await);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::certificates;

    #[test]
    fn a_seat_that_floods_the_desk_with_greetings_does_not_keep_another_out() {
        let (switch, mut greetings) = Switch::new();
        let key = certificates::desk("9-A").expect("a key").key;
        let signer = signer(&key).expect("a key");
        let greet = |seat: &str, number: u32| {
            let bytes = Frame {
                kind: FrameKind::Hello,
                number: 0,
                taken: 0,
                body: Vec::new(),
            };
            let caller = Caller {
                seat: seat.to_owned(),
                number: number.to_string(),
            };
            switch.pass(caller, bytes.seal(&signer, "key"));
        };
        for number in 0..10_000 {
            greet("seat-01", number);
        }
        greet("seat-02", 7);
        let mut next = || greetings.try_recv().map(|it| it.caller.seat);
        assert_eq!(next().as_deref(), Ok("seat-01"));
        assert_eq!(next().as_deref(), Ok("seat-02"));
        assert!(next().is_err());
        switch.listen_again("seat-01");
        greet("seat-01", 10_001);
        assert_eq!(next().as_deref(), Ok("seat-01"));
    }
}
