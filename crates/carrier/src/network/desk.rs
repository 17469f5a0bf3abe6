//! The desk's end.

use std::io;
use std::sync::Arc;
use std::time::Duration;

use ring::signature::Ed25519KeyPair;
use sortie_class::ConnectionId;
use tokio::net::{TcpSocket, lookup_host};
use tokio::sync::mpsc;
use tokio::task::JoinSet;
use tokio::time::timeout;
use zenoh::pubsub::Subscriber;
use zenoh::sample::Sample;

use super::conversation::{Conversation, Inbox, Parties};
use super::flow::Flow;
use super::folder::NetworkDesk;
use super::frame::{Frame, FrameKind, is_number, signer};
use super::switch::{Caller, Greeting, Switch, TakenPlace};
use super::{Channel, OpenSession, config};
use crate::fault::{ClassFault, NetworkFault, StartFault};
use crate::host::own_user_name;
use crate::ports::{ARRIVALS, CarrierPeer, DeskArrival, DeskPort, Outbox};

/// How long the end of the desk waits for all its connections to say goodbye. With the time for the session to close,
/// it is less than the port waits.
const GOODBYE: Duration = Duration::from_millis(300);
/// The time for Zenoh to start.
const START: Duration = Duration::from_secs(10);

/// Opens the desk of a class on several machines.
///
/// # Errors
/// Its address cannot be listened at.
pub(crate) async fn open(desk: &NetworkDesk) -> Result<DeskPort, ClassFault> {
    find_free(&desk.listen).await?;
    let signer = Arc::new(signer(&desk.keys.key.0)?);
    let session = start(desk).await?;
    let (switch, greetings) = Switch::new();
    let switch = Arc::new(switch);
    let heard = hear_seats(&session, desk, &switch).await;
    let subscribers = heard.map_err(|_| not_started(desk, StartFault::Ended))?;
    let (arrived, arrivals) = mpsc::channel(ARRIVALS);
    let acceptor = Acceptor {
        desk: desk.clone(),
        session,
        signer,
        switch,
    };
    let task = tokio::spawn(async move {
        acceptor.run(greetings, &arrived).await;
        drop(subscribers);
        acceptor.session.close().await;
    });
    Ok(DeskPort { arrivals, task })
}

fn not_started(desk: &NetworkDesk, fault: StartFault) -> NetworkFault {
    let address = desk.listen.clone();
    NetworkFault::NotStarted { address, fault }
}

/// Starts Zenoh. Its own words for a failure may contain its settings, and so the key: they are not passed on.
async fn start(desk: &NetworkDesk) -> Result<OpenSession, NetworkFault> {
    let opening = OpenSession::open(config::of_desk(desk)?);
    match timeout(START, opening).await {
        Ok(Ok(session)) => Ok(session),
        Ok(Err(_)) => {
            // Somebody may have taken the address meanwhile.
            find_free(&desk.listen).await?;
            Err(not_started(desk, StartFault::Certificates))
        }
        Err(_) => Err(not_started(desk, StartFault::Timeout)),
    }
}

/// Checks that an address can be listened at.
async fn find_free(listen: &str) -> Result<(), NetworkFault> {
    bind(listen).await.map_err(|error| NetworkFault::NotOpen {
        address: listen.to_owned(),
        error: error.into(),
    })
}

/// Takes an address for a moment, without listening: seats would take that for a desk.
async fn bind(listen: &str) -> io::Result<()> {
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
            if let Some(number) = number.filter(|it| is_number(it)) {
                let caller = Caller {
                    seat: seat.clone(),
                    number: number.to_owned(),
                };
                switch.pass(caller, sample.payload().to_bytes().into_owned());
            }
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
struct Acceptor {
    desk: NetworkDesk,
    session: OpenSession,
    signer: Arc<Ed25519KeyPair>,
    switch: Arc<Switch>,
}

/// A connection that the desk has opened.
struct Call {
    conversation: Conversation,
    inbox: Inbox,
    place: TakenPlace,
}

impl Acceptor {
    /// Serves seats until the console is gone.
    async fn run(
        &self,
        mut greetings: mpsc::Receiver<Greeting>,
        arrived: &mpsc::Sender<DeskArrival>,
    ) {
        let mut calls = JoinSet::new();
        let mut number = 0;
        loop {
            let greeting = tokio::select! {
                greeting = greetings.recv() => greeting,
                () = arrived.closed() => break,
            };
            let Some(greeting) = greeting else {
                break;
            };
            while calls.try_join_next().is_some() {}
            number += 1;
            let seat = greeting.caller.seat.clone();
            let call = self.accept(greeting).await;
            self.switch.listen_again(&seat);
            if let Ok(Some(call)) = call {
                let arrived = arrived.clone();
                calls.spawn(async move { call.serve(ConnectionId(number), &arrived).await });
            }
        }
        let goodbye = async { while calls.join_next().await.is_some() {} };
        drop(timeout(GOODBYE, goodbye).await);
    }

    /// Opens the connection of a seat; `None` if it may not have one. Nothing is told to Zenoh before the signature was
    /// checked.
    async fn accept(&self, greeting: Greeting) -> zenoh::Result<Option<Call>> {
        let Greeting { caller, bytes } = greeting;
        let keys = &self.desk.keys;
        let Some(seat) = keys.seats.get(&caller.seat) else {
            return Ok(None);
        };
        let Channel { up, down } = Channel::new(&keys.class, &caller.seat, &caller.number);
        let mut flow = Flow::default();
        let hello = Frame::open(&bytes, &seat.0, &up);
        let hello = hello.filter(|it| it.kind == FrameKind::Hello && flow.admit(it));
        let Some(inbox) = hello.and_then(|_| self.switch.connect(&caller)) else {
            return Ok(None);
        };
        let switch = Arc::clone(&self.switch);
        let place = TakenPlace { switch, caller };
        let parties = Parties {
            signer: Arc::clone(&self.signer),
            own_key: down,
            other: seat.0.clone(),
            other_key: up,
        };
        let conversation = Conversation::new(self.session.get()?, parties, flow).await?;
        Ok(Some(Call {
            conversation,
            inbox,
            place,
        }))
    }
}

impl Call {
    async fn serve(self, connection: ConnectionId, arrived: &mpsc::Sender<DeskArrival>) {
        let Self {
            mut conversation,
            inbox,
            place,
        } = self;
        let (outbox, lines) = Outbox::new();
        let user = place.caller.seat.clone();
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
}
