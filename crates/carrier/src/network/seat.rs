//! A seat's end.

use std::sync::Arc;
use std::time::Duration;

use sortie_class::protocol::DeskMessage;
use tokio::net::TcpStream;
use tokio::sync::mpsc;
use tokio::time::timeout;
use zenoh::pubsub::Subscriber;
use zenoh::sample::Sample;

use super::conversation::{Conversation, INBOX, Inbox, Parties, SILENCE};
use super::flow::Flow;
use super::frame::{FrameKind, fresh_number, signer};
use super::{Channel, OpenSession, config};
use crate::calling::{self, WayToDesk};
use crate::fault::{ClassFault, NetworkFault};
use crate::join_line::JoinLine;
use crate::ports::{CarrierPeer, SeatArrival, SeatPort};

/// How often a greeting is repeated.
const GREET_AGAIN: Duration = Duration::from_millis(500);
/// The time for a connection to show that somebody is at an address.
const PROBE: Duration = Duration::from_secs(1);
/// The maximum length of the instructor's name.
const LONGEST_NAME: usize = 64;

/// Connects to the desk of a join line, and again whenever the connection ends.
pub(crate) fn join(line: JoinLine) -> SeatPort {
    calling::join(line)
}

impl WayToDesk<DeskMessage> for JoinLine {
    type Call = Call;

    async fn call(&self) -> Result<Option<(Call, CarrierPeer)>, ClassFault> {
        Ok(call(self).await?)
    }

    async fn pass(
        &self,
        call: Call,
        lines: mpsc::Receiver<String>,
        arrived: &mpsc::Sender<SeatArrival>,
    ) {
        let Call {
            conversation,
            inbox,
            subscriber,
            session,
        } = call;
        conversation
            .pass(inbox, lines, arrived, SeatArrival::Line)
            .await;
        drop(subscriber);
        session.close().await;
    }
}

/// A connection that the desk has opened.
pub(crate) struct Call {
    conversation: Conversation,
    inbox: Inbox,
    subscriber: Subscriber<()>,
    session: OpenSession,
}

/// Calls the desk at one address after the other; `None` if nobody is there. Zenoh would stay with the first one.
async fn call(line: &JoinLine) -> Result<Option<(Call, CarrierPeer)>, NetworkFault> {
    let mut stranger = None;
    for address in &line.addresses {
        // Without a probe, an attempt at an address where nobody is takes minutes.
        let Ok(Ok(_)) = timeout(PROBE, TcpStream::connect(address)).await else {
            continue;
        };
        match OpenSession::open(config::of_seat(line, address)?).await {
            Ok(session) => return call_over(session, line).await,
            Err(_) => stranger = Some(NetworkFault::NotTheDesk(address.clone())),
        }
    }
    stranger.map_or(Ok(None), Err)
}

async fn call_over(
    session: OpenSession,
    line: &JoinLine,
) -> Result<Option<(Call, CarrierPeer)>, NetworkFault> {
    let Channel { up, down } = Channel::new(&line.class, &line.seat, &fresh_number()?);
    let parties = Parties {
        signer: Arc::new(signer(&line.key)?),
        own_key: up,
        other: line.desk_key.clone(),
        other_key: down,
    };
    match greet(session, parties).await {
        Ok(Some(call)) => Ok(Some(call)),
        Ok(None) => Err(NetworkFault::Unknown {
            class: line.class.clone(),
            seat: line.seat.clone(),
        }),
        // The desk has closed meanwhile.
        Err(_) => Ok(None),
    }
}

/// Greets the desk until it answers; `None` if it does not.
async fn greet(
    session: OpenSession,
    parties: Parties,
) -> zenoh::Result<Option<(Call, CarrierPeer)>> {
    let (sender, mut inbox) = mpsc::channel(INBOX);
    // Only a desk that does not keep to the window fills it, and then the missing frame ends the connection.
    let take =
        move |sample: Sample| drop(sender.try_send(sample.payload().to_bytes().into_owned()));
    let subscriber = session.get()?.declare_subscriber(parties.other_key.clone());
    let subscriber = subscriber.callback(take).await?;
    let mut conversation = Conversation::new(session.get()?, parties, Flow::default()).await?;
    let hello = conversation.sealed(FrameKind::Hello, Vec::new());
    let answer = async {
        loop {
            conversation.put(hello.clone()).await;
            if let Ok(answer) = timeout(GREET_AGAIN, inbox.recv()).await {
                return answer;
            }
        }
    };
    let answer = timeout(SILENCE, answer).await.ok().flatten();
    let answer = answer.and_then(|bytes| conversation.hear(&bytes));
    let Some(open) = answer.filter(|it| it.kind == FrameKind::Open) else {
        return Ok(None);
    };
    let user = String::from_utf8_lossy(&open.body);
    let user = user.chars().filter(|c| !c.is_control()).take(LONGEST_NAME);
    let desk = CarrierPeer {
        user: user.collect(),
    };
    let call = Call {
        conversation,
        inbox,
        subscriber,
        session,
    };
    Ok(Some((call, desk)))
}
