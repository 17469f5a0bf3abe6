//! The network breaks while flights go on.

use std::sync::Arc;
use std::time::Duration;

use sortie_class::protocol::{DeskMessage, SeatMessage};
use sortie_class::{
    ConnectionId, Consent, Deed, Desk, DeskLine, Happening, Insight, OrderState, Outcome, Picture,
    Piece, PieceRequest, Seat, SeatLine, SeatRecord, SeatReport, SeatSource, TryHead,
};
use tokio::io::copy_bidirectional;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;
use tokio::task::JoinSet;
use tokio::time::{Instant, timeout};

use super::*;
use crate::ports::{DeskArrival, DeskPort, Outbox, SeatArrival, SeatPort};

/// How long a test waits for what must happen.
const PATIENCE: Duration = Duration::from_secs(60);

/// What a network does with the bytes on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Weather {
    Fine,
    /// Bytes go nowhere, and nobody is told.
    Silent,
    /// Connections break at once.
    Broken,
}

/// A network between seats and their desk.
struct Net {
    weather: watch::Sender<Weather>,
    _tasks: JoinSet<()>,
}

impl Net {
    /// Listens at one address and leads to another one.
    async fn between(listen: &str, desk: &str) -> Self {
        let listener = TcpListener::bind(listen).await.expect("a port");
        let (weather, seen) = watch::channel(Weather::Fine);
        let desk: Arc<str> = desk.into();
        let mut tasks = JoinSet::new();
        tasks.spawn(async move {
            let mut lines = JoinSet::new();
            while let Ok((seat, _)) = listener.accept().await {
                lines.spawn(lead(seat, Arc::clone(&desk), seen.clone()));
            }
        });
        Self {
            weather,
            _tasks: tasks,
        }
    }

    fn turn(&self, weather: Weather) {
        self.weather.send_replace(weather);
    }
}

async fn lead(mut seat: TcpStream, desk: Arc<str>, mut weather: watch::Receiver<Weather>) {
    let now = *weather.borrow();
    if now == Weather::Fine
        && let Ok(mut to_desk) = TcpStream::connect(&*desk).await
    {
        let cut = async {
            let seen = weather.wait_for(|it| *it != Weather::Fine).await;
            seen.map(|it| *it).ok()
        };
        tokio::select! {
            _ = copy_bidirectional(&mut seat, &mut to_desk) => {}
            it = cut => if it == Some(Weather::Silent) {
                silence(weather).await;
            }
        }
    } else if now == Weather::Silent {
        silence(weather).await;
    }
}

/// The sockets stay open, but nothing passes until the silence is over; then they break.
async fn silence(mut weather: watch::Receiver<Weather>) {
    drop(weather.wait_for(|it| *it != Weather::Silent).await);
}

struct Idle;

impl SeatSource for Idle {
    fn report(&self) -> SeatReport {
        SeatReport::default()
    }

    fn picture(&self) -> Option<Picture> {
        None
    }

    fn insight(&self) -> Option<Insight> {
        None
    }

    fn head(&self) -> Option<TryHead> {
        None
    }

    fn piece(&self, _: &PieceRequest) -> Option<Piece> {
        None
    }
}

/// A seat and a desk as the console has them.
struct Room {
    start: Instant,
    seat_port: SeatPort,
    seat: Seat,
    seat_line: Option<(Outbox, SeatLine)>,
    /// The orders that were carried out.
    obeyed: Vec<Deed>,
    desk_port: DeskPort,
    desk: Desk,
    desk_lines: Vec<(ConnectionId, String, Outbox, DeskLine)>,
    times_lost: usize,
}

impl Room {
    async fn new(desk: &NetworkDesk, line: JoinLine) -> Self {
        Self {
            start: Instant::now(),
            seat_port: join(line),
            seat: Seat::new(5, Consent::Given),
            seat_line: None,
            obeyed: Vec::new(),
            desk_port: open(desk).await.expect("it opens"),
            desk: Desk::new(9, "9-A".into(), "petro".into()),
            desk_lines: Vec::new(),
            times_lost: 0,
        }
    }

    fn now(&self) -> Duration {
        self.start.elapsed()
    }

    /// Lets both consoles run until something is seen.
    async fn until(&mut self, what: &str, seen: impl Fn(&Self) -> bool) {
        let run = async {
            while !seen(self) {
                tokio::select! {
                    Some(arrival) = self.seat_port.next() => self.at_seat(arrival),
                    Some(arrival) = self.desk_port.next() => self.at_desk(arrival),
                    () = tokio::time::sleep(Duration::from_millis(20)) => {}
                }
                self.tell();
            }
        };
        timeout(PATIENCE, run).await.expect(what);
    }

    fn at_seat(&mut self, arrival: SeatArrival) {
        match arrival {
            SeatArrival::Found { desk, outbox } => {
                self.seat.find(&desk.user);
                self.seat_line = Some((outbox, SeatLine::default()));
            }
            SeatArrival::Line(line) => {
                let message = line.expect("a message");
                if let Some((_, line)) = &mut self.seat_line {
                    line.hear(&message);
                }
                match message {
                    DeskMessage::Welcome {
                        class,
                        name,
                        instructor,
                        ..
                    } => self.seat.enter(class, name, &instructor),
                    DeskMessage::Order(order) if self.seat.is_new(&order) => {
                        self.obeyed.push(order.deed.clone());
                        self.seat.settle(None, order, Outcome::Done, None);
                    }
                    _ => {}
                }
            }
            SeatArrival::Lost => {
                self.seat.lose();
                self.seat_line = None;
                self.times_lost += 1;
            }
            // While the network is silent, something answers that is not the desk.
            SeatArrival::Refused(_) => {}
        }
    }

    fn at_desk(&mut self, arrival: DeskArrival) {
        let now = self.now();
        match arrival {
            DeskArrival::Opened {
                connection,
                peer,
                outbox,
            } => {
                let line = DeskLine::default();
                self.desk_lines.push((connection, peer.user, outbox, line));
            }
            DeskArrival::Line { from, line } => {
                let message: SeatMessage = line.expect("a message");
                let known = self.desk_lines.iter().find(|it| it.0 == from);
                let user = known.expect("a connection").1.clone();
                self.desk.hear(from, &user, message, now).expect("admitted");
            }
            DeskArrival::Closed(connection) => {
                self.desk_lines.retain(|it| it.0 != connection);
                self.desk.leave(connection, now);
            }
        }
    }

    fn tell(&mut self) {
        let now = self.now();
        if let Some((outbox, line)) = &mut self.seat_line {
            while outbox.has_room()
                && let Some(message) = line.next(&self.seat, &Idle, now)
            {
                outbox.send(&message);
            }
        }
        for (connection, _, outbox, line) in &mut self.desk_lines {
            while outbox.has_room()
                && let Some(message) = line.next(&self.desk, *connection, now)
            {
                outbox.send(&message);
            }
        }
    }

    fn note(&mut self, count: usize) {
        for _ in 0..count {
            let line = "all takeoff 10".into();
            self.seat.note(Some(1.0), Happening::Command { line });
        }
    }

    /// Whether the desk has all that happened at the seat.
    fn is_complete(&self) -> bool {
        let last = self.seat.journal().last();
        let of_seat = self.desk.seats().first();
        of_seat.is_some_and(|it| it.is_here() && it.journal.last() == last)
    }
}

async fn split(weather: Weather) {
    let (_parent, lab) = lab(1);
    let free = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let listen = free.local_addr().expect("an address").to_string();
    drop(free);
    let net = Net::between(&listen, &lab.listen).await;
    let line = JoinLine {
        addresses: vec![listen],
        ..lab.line(1)
    };
    let mut room = Room::new(&lab.desk(), line).await;
    room.note(100);
    room.until("the journal arrives", Room::is_complete).await;
    net.turn(weather);
    room.note(500);
    room.until("both sides notice", |room| {
        room.times_lost > 0 && room.desk.seats().iter().all(|it| !it.is_here())
    })
    .await;
    room.note(500);
    let now = room.now();
    room.desk.give(&[0], &Deed::Freeze, now);
    net.turn(Weather::Fine);
    room.until("the rest of the journal arrives", |room| {
        let orders = room.desk.seats().iter().flat_map(SeatRecord::orders);
        let mut waiting = orders.filter(|it| it.state == OrderState::Waiting);
        room.is_complete() && waiting.next().is_none()
    })
    .await;
    assert_eq!(room.desk.seats().len(), 1, "it is the same seat");
    assert!(room.seat.journal().last() >= 1100);
    assert_eq!(room.obeyed, [Deed::Freeze], "carried out once");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn after_a_silent_split_nothing_of_the_journal_is_missing() {
    split(Weather::Silent).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn after_connections_break_nothing_of_the_journal_is_missing() {
    split(Weather::Broken).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_desk_that_opens_again_gets_the_whole_journal() {
    let (_parent, lab) = lab(1);
    let mut room = Room::new(&lab.desk(), lab.line(1)).await;
    room.note(300);
    room.until("the journal arrives", Room::is_complete).await;
    // As after a kill: the new desk knows nothing.
    let (_, arrivals) = tokio::sync::mpsc::channel(1);
    let task = tokio::spawn(async {});
    let none = DeskPort { arrivals, task };
    std::mem::replace(&mut room.desk_port, none).close().await;
    room.note(300);
    room.desk = Desk::new(10, "9-A".into(), "petro".into());
    room.desk_lines.clear();
    room.until("the seat notices", |room| room.times_lost > 0)
        .await;
    room.desk_port = open(&lab.desk()).await.expect("it opens again");
    room.until("the whole journal arrives", Room::is_complete)
        .await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_desk_at_an_address_of_ip_version_6_is_found() {
    let (_parent, lab) = lab_at("[::1]", 1);
    let mut room = Room::new(&lab.desk(), lab.line(1)).await;
    room.until("it is found", Room::is_complete).await;
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_seat_tries_one_address_after_the_other() {
    let (_parent, lab) = lab(1);
    let free = || std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = |it: &std::net::TcpListener| it.local_addr().expect("an address").to_string();
    // At one of them nobody listens; at another one somebody does, who never answers.
    let (gone, silent) = (address(&free()), free());
    let line = JoinLine {
        addresses: vec![gone, address(&silent), lab.listen.clone()],
        ..lab.line(1)
    };
    let mut room = Room::new(&lab.desk(), line).await;
    room.until("it is found", Room::is_complete).await;
}
