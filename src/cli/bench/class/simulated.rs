//! Seats without consoles and vehicles: only what a class says is real.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::Sender;
use std::time::{Duration, Instant};

use tokio::runtime::{Builder, Runtime};
use tokio::sync::mpsc::{self, UnboundedReceiver, UnboundedSender};
use tokio::time::{MissedTickBehavior, interval};

use super::seats::{SeatInput, SeatOutput};
use crate::carrier::{ClassPlace, Outbox, SeatArrival};
use crate::class::protocol::{self, DeskMessage};
use crate::class::{
    Consent, Danger, DangerKind, Deed, FlightReport, Insight, LastCommand, Outcome, Picture, Piece,
    PieceRequest, Seat, SeatLine, SeatReport, SeatSource, Stage, TryHead,
};

/// The time between two looks at what is to be said, as at the frame rate of a console.
const TICK: Duration = Duration::from_millis(33);
/// How long a command puts the seat at the top of the board, by a danger that it reports.
const DANGER_FOR: Duration = Duration::from_secs(1);

/// The bytes that seats have said and heard.
pub(super) type Bytes = Arc<AtomicU64>;

/// Many seats in this process, on one thread.
pub(super) struct SimulatedSeats {
    runtime: Runtime,
    vehicles: u16,
    bytes: Bytes,
}

/// The keyboard of one of them.
struct Keyboard(UnboundedSender<String>);

impl SeatInput for Keyboard {
    fn give(&mut self, line: &str) -> io::Result<()> {
        self.0.send(line.to_owned()).map_err(io::Error::other)
    }
}

impl SimulatedSeats {
    pub fn start(vehicles: u8) -> io::Result<Self> {
        let runtime = Builder::new_multi_thread()
            .worker_threads(1)
            .thread_name("seats")
            .enable_all()
            .build()?;
        Ok(Self {
            runtime,
            vehicles: vehicles.into(),
            bytes: Bytes::default(),
        })
    }

    /// The bytes of all lines so far, in both directions.
    pub fn bytes(&self) -> u64 {
        self.bytes.load(Ordering::Relaxed)
    }

    /// A seat that joins the class, and says on `output` which messages it gets.
    pub fn seat(
        &self,
        place: ClassPlace,
        number: usize,
        output: Sender<SeatOutput>,
    ) -> Box<dyn SeatInput> {
        let (keyboard, typed) = mpsc::unbounded_channel();
        let seat = SimulatedSeat {
            number,
            state: Seat::new(number as u64 + 1, Consent::Given),
            flight: SimulatedFlight::begin(self.vehicles),
            open: None,
            bytes: Arc::clone(&self.bytes),
            output,
        };
        self.runtime.spawn(seat.live(place, typed));
        Box::new(Keyboard(keyboard))
    }
}

struct SimulatedSeat {
    number: usize,
    state: Seat,
    flight: SimulatedFlight,
    /// The connection to the desk.
    open: Option<(Outbox, SeatLine)>,
    bytes: Bytes,
    output: Sender<SeatOutput>,
}

impl SimulatedSeat {
    async fn live(mut self, place: ClassPlace, mut typed: UnboundedReceiver<String>) {
        let mut port = place.join();
        let mut ticks = interval(TICK);
        ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
        loop {
            tokio::select! {
                arrival = port.next() => match arrival {
                    Some(arrival) => self.hear(arrival),
                    None => return,
                },
                line = typed.recv() => match line {
                    Some(line) => self.flight.command = Some((line, Instant::now())),
                    None => return,
                },
                _ = ticks.tick() => {}
            }
            self.say();
        }
    }

    fn hear(&mut self, arrival: SeatArrival) {
        match arrival {
            SeatArrival::Found { desk, outbox } => {
                self.state.find(&desk.user);
                self.open = Some((outbox, SeatLine::default()));
            }
            SeatArrival::Line(Ok(message)) => self.obey(message),
            SeatArrival::Lost => {
                self.state.lose();
                self.open = None;
            }
            SeatArrival::Line(Err(_)) | SeatArrival::Refused(_) => {}
        }
    }

    fn obey(&mut self, message: DeskMessage) {
        self.count(&protocol::line(&message));
        if let Some((_, line)) = &mut self.open {
            line.hear(&message);
        }
        match message {
            DeskMessage::Welcome {
                class,
                name,
                instructor,
                ..
            } => self.state.enter(class, name, &instructor),
            DeskMessage::Order(order) if self.state.is_new(&order) => {
                if let Deed::Message { text } = &order.deed {
                    let (seat, text) = (self.number, text.as_str().to_owned());
                    let at = Instant::now();
                    drop(self.output.send(SeatOutput { seat, at, text }));
                }
                let clock = self.flight.clock();
                self.state
                    .settle(Some(clock.as_secs_f64()), order, Outcome::Done, None);
            }
            _ => {}
        }
    }

    /// Says what the desk does not know yet.
    fn say(&mut self) {
        let Some((outbox, line)) = &mut self.open else {
            return;
        };
        let now = self.flight.clock();
        let mut said = String::new();
        while outbox.has_room()
            && let Some(message) = line.next(&self.state, &self.flight, now)
        {
            outbox.send(&message);
            said += &protocol::line(&message);
        }
        self.count(&said);
    }

    fn count(&self, lines: &str) {
        self.bytes.fetch_add(lines.len() as u64, Ordering::Relaxed);
    }
}

/// A flight of which only the report exists.
struct SimulatedFlight {
    begun: Instant,
    vehicles: u16,
    /// The last command, and when it was given.
    command: Option<(String, Instant)>,
}

impl SimulatedFlight {
    fn begin(vehicles: u16) -> Self {
        Self {
            begun: Instant::now(),
            vehicles,
            command: None,
        }
    }

    fn clock(&self) -> Duration {
        self.begun.elapsed()
    }
}

impl SeatSource for SimulatedFlight {
    fn report(&self) -> SeatReport {
        let clock_s = self.clock().as_secs_f64();
        let command = self.command.as_ref();
        let is_new = command.is_some_and(|(_, at)| at.elapsed() < DANGER_FOR);
        let flight = FlightReport {
            stage: Stage::Flying,
            clock_s,
            vehicles: self.vehicles,
            airborne: self.vehicles,
            danger: is_new.then_some(Danger {
                kind: DangerKind::Fence,
                in_s: 5.0,
            }),
            least_separation_m: Some(5.0 + clock_s % 10.0),
            workload_percent: Some((clock_s as u64 % 100) as u8),
            last_command: command.map(|(line, at)| LastCommand {
                line: line.as_str().into(),
                age_s: at.elapsed().as_secs_f64(),
            }),
            ..FlightReport::default()
        };
        SeatReport {
            flight: Some(flight),
            screen: Some([120, 40]),
            ..SeatReport::default()
        }
    }

    fn picture(&self) -> Option<Picture> {
        None
    }

    fn insight(&self) -> Option<Insight> {
        None
    }

    fn piece(&self, _: &PieceRequest) -> Option<Piece> {
        None
    }

    fn head(&self) -> Option<TryHead> {
        None
    }
}
