//! `sortie bench class`: an instructor's desk and its seats, as processes on this machine.
//!
//! The desk runs in a terminal, and the seats are plain consoles whose vehicles fly, or only say what such consoles
//! would say. Everything is seen from outside: an order from the key that gives it to the line that the seat shows, and
//! the age of the board from a trainee's command to its text on the desk's screen.

use std::ffi::OsString;
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use anyhow::Context as _;
use clap::Args;
use serde::Serialize;

use super::super::Failure;
use super::super::seat::refused;
use super::cost::{self, Machine};
use super::terminal::{Terminal, own_program};
use crate::carrier::{ClassPlace, NewClass, make_class};
use seats::Seats;
use simulated::SimulatedSeats;

mod seats;
mod simulated;

/// The longest wait for the desk to open, and for all seats to join.
const STARTING: Duration = Duration::from_secs(120);
/// How long an order and a command are watched.
const ROUND: Duration = Duration::from_secs(2);
/// How long to look for the output of one side before the other's is read. Times are taken when output arrives.
const GLANCE: Duration = Duration::from_millis(20);
/// What the seats fly, and the time that each line takes.
const FLIGHT: [(&str, u64); 3] = [("all guided", 3), ("all arm", 4), ("all takeoff 10", 10)];
/// Headings in degrees of the commands that are looked for on the board. Every digit differs from the one that it
/// replaces, so that the desk writes all three in one piece.
const HEADINGS: [&str; 3] = ["123", "231", "312"];

/// Options of `sortie bench class`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie bench class\n  \
    sortie bench class --network                      over Zenoh, as on several machines\n  \
    sortie bench class --seats 300 --simulated        the desk alone, with seats that only report\n  \
    sortie bench class --seats 4 --vehicles 1 --seconds 10 --json")]
pub(in crate::cli) struct BenchClassArguments {
    /// Start this many seats.
    #[arg(long, default_value_t = 30, value_parser = clap::value_parser!(u16).range(1..=500))]
    seats: u16,
    /// Fly this many vehicles at each seat.
    #[arg(long, default_value_t = 16, value_parser = clap::value_parser!(u8).range(1..=100))]
    vehicles: u8,
    /// Measure for this many seconds, once all vehicles fly.
    #[arg(long, default_value_t = 60, value_parser = clap::value_parser!(u16).range(2..=3600))]
    seconds: u16,
    /// Connect the seats as on several machines, through a port of this host.
    #[arg(long)]
    network: bool,
    /// Simulate the seats: they report and answer orders, but have no consoles and no vehicles.
    #[arg(long)]
    simulated: bool,
    /// Print one JSON document instead of the table.
    #[arg(long)]
    json: bool,
}

/// How the seats find the desk.
struct Way {
    /// The name or the path of the class at the desk, and its options.
    desk: Vec<OsString>,
    /// The class of each seat.
    seats: Vec<OsString>,
    /// Where the desk listens; `None` if it is a socket in the folder of the class.
    listen: Option<String>,
}

/// What a desk costs, and how fast the class is.
#[derive(Debug, Serialize)]
struct ClassCost {
    /// `unix` or `zenoh`.
    carrier: &'static str,
    seats: u16,
    /// Whether the seats have neither consoles nor vehicles.
    simulated: bool,
    vehicles: u8,
    window_s: f64,
    desk_core_percent: f64,
    desk_memory_mb: f64,
    /// The share of the whole machine that was busy: figures of a busy machine say little.
    machine_busy_percent: Option<f64>,
    /// The bytes per second between the desk and all seats, in both directions; `None` where they cannot be seen, which
    /// is between consoles and a desk on one host. Over a network they include what the network's protocols add.
    traffic_bytes_per_s: Option<f64>,
    order: Delays,
    board: Delays,
}

/// The delays of one kind, in milliseconds.
#[derive(Debug, Serialize)]
struct Delays {
    count: usize,
    /// The number of those that never ended.
    lost: usize,
    median_ms: f64,
    p99_ms: f64,
    most_ms: f64,
}

impl Delays {
    fn of(mut seen: Vec<Duration>, expected: usize) -> Self {
        seen.sort_unstable();
        let at = |share: f64| {
            let place = (share * seen.len().saturating_sub(1) as f64).round() as usize;
            seen.get(place)
                .map_or(f64::NAN, |it| it.as_secs_f64() * 1e3)
        };
        Self {
            count: seen.len(),
            lost: expected.saturating_sub(seen.len()),
            median_ms: at(0.5),
            p99_ms: at(0.99),
            most_ms: at(1.0),
        }
    }
}

pub(in crate::cli) fn class(options: &BenchClassArguments) -> Result<ExitCode, Failure> {
    let folder = std::env::temp_dir().join(format!("sortie-class-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("class"))?;
    let measured = measure(options, &folder);
    drop(std::fs::remove_dir_all(&folder));
    let cost = measured?;
    if options.json {
        say!("{}", serde_json::to_string(&cost)?)?;
    } else {
        print(&cost)?;
    }
    let is_whole = cost.order.lost == 0 && cost.board.lost == 0;
    Ok(ExitCode::from(u8::from(!is_whole)))
}

fn print(cost: &ClassCost) -> Result<(), Failure> {
    let ClassCost {
        carrier,
        seats,
        vehicles,
        ..
    } = cost;
    say!(
        "{seats} {kind} with {vehicles} flying vehicles each, over {:.0} s, carrier {carrier}",
        cost.window_s,
        kind = if cost.simulated {
            "simulated seats"
        } else {
            "seats"
        },
    )?;
    say!(
        "desk: {:.1} % of a core, {:.0} MB",
        cost.desk_core_percent,
        cost.desk_memory_mb
    )?;
    if let Some(busy) = cost.machine_busy_percent {
        say!("all processors of the machine: {busy:.0} % busy")?;
    }
    if let Some(bytes) = cost.traffic_bytes_per_s {
        let of_one = bytes / f64::from(*seats);
        say!(
            "traffic: {:.1} kB/s, {:.2} kB/s per seat",
            bytes / 1e3,
            of_one / 1e3
        )?;
    }
    say!("delay, ms                  count   lost   median     99 %     most")?;
    for (name, delays) in [
        ("order to effect", &cost.order),
        ("command to the board", &cost.board),
    ] {
        say!(
            "{name:<24} {:>7} {:>6} {:>8.0} {:>8.0} {:>8.0}",
            delays.count,
            delays.lost,
            delays.median_ms,
            delays.p99_ms,
            delays.most_ms
        )?;
    }
    Ok(())
}

fn measure(options: &BenchClassArguments, folder: &Path) -> Result<ClassCost, Failure> {
    let class = folder.join("class");
    let way = if options.network {
        Way::over_a_network(options, folder)?
    } else {
        Way {
            desk: vec![class.clone().into()],
            seats: vec![class.clone().into(); usize::from(options.seats)],
            listen: None,
        }
    };
    let mut room = ClassRoom::open(options, folder, &way)?;
    room.gather()?;
    if !options.simulated {
        for (line, seconds) in FLIGHT {
            room.seats.give_all(line)?;
            room.pass(Duration::from_secs(seconds));
        }
    }
    let desk = room.desk.process();
    let (begun, spent) = (Instant::now(), cost::of_process(desk)?);
    let (machine, bytes) = (Machine::now(), room.bytes(options.network));
    let (mut orders, mut board) = (Vec::new(), Vec::new());
    let rounds = usize::from(options.seconds).div_ceil(ROUND.as_secs() as usize);
    for round in 0..rounds {
        room.round(round, &mut orders, &mut board)?;
    }
    let window = begun.elapsed();
    let spent = cost::of_process(desk)?.saturating_sub(spent);
    let busy = machine.and_then(|before| Some(Machine::now()?.busy_percent_since(before)));
    let bytes = bytes.and_then(|before| room.bytes(options.network)?.checked_sub(before));
    Ok(ClassCost {
        carrier: if options.network { "zenoh" } else { "unix" },
        seats: options.seats,
        simulated: options.simulated,
        vehicles: options.vehicles,
        window_s: window.as_secs_f64(),
        desk_core_percent: spent.as_secs_f64() / window.as_secs_f64() * 100.0,
        desk_memory_mb: cost::most_memory_of(desk)? as f64 / 1e6,
        machine_busy_percent: busy,
        traffic_bytes_per_s: bytes.map(|bytes| bytes as f64 / window.as_secs_f64()),
        order: Delays::of(orders, rounds * usize::from(options.seats)),
        board: Delays::of(board, rounds),
    })
}

impl Way {
    /// Makes a class on several machines, all of which are this one.
    fn over_a_network(options: &BenchClassArguments, folder: &Path) -> Result<Self, Failure> {
        let free = TcpListener::bind("127.0.0.1:0")?;
        let listen = free.local_addr()?.to_string();
        let class = folder.join("network");
        let new = NewClass {
            name: "bench",
            seats: options.seats,
            addresses: std::slice::from_ref(&listen),
        };
        let lines = make_class(&new, &class).map_err(refused)?;
        Ok(Self {
            desk: vec![class.into(), "--listen".into(), listen.clone().into()],
            seats: lines.into_iter().map(PathBuf::into_os_string).collect(),
            listen: Some(listen),
        })
    }

    /// Whether the desk is open.
    fn is_open(&self, folder: &Path) -> bool {
        match &self.listen {
            Some(listen) => TcpStream::connect(listen).is_ok(),
            None => folder.join("class/desk").exists(),
        }
    }
}

/// The desk and the seats of one class.
struct ClassRoom {
    desk: Terminal,
    seats: Seats,
    /// What the seats run on, if they are simulated.
    simulated: Option<SimulatedSeats>,
}

/// A command for one seat.
struct Probe {
    line: String,
    /// Its part that is looked for on the board.
    sought: String,
}

impl ClassRoom {
    fn open(options: &BenchClassArguments, folder: &Path, way: &Way) -> anyhow::Result<Self> {
        let mut desk = own_program(&folder.join("desk"))?;
        desk.args(["class", "open"]).args(&way.desk);
        // Without colours, no number of a colour is taken for a heading.
        desk.args(["--theme", "monochrome"]);
        let mut desk = Terminal::begin(desk)?;
        let begun = Instant::now();
        while !way.is_open(folder) {
            anyhow::ensure!(begun.elapsed() < STARTING, "the desk does not open");
            desk.next(GLANCE);
        }
        let simulated = options
            .simulated
            .then(|| SimulatedSeats::start(options.vehicles))
            .transpose()?;
        let seats = Seats::start(way.seats.len(), |seat, output| {
            let class = &way.seats[seat];
            if let Some(simulated) = &simulated {
                let place = ClassPlace::named(&class.to_string_lossy(), None)?;
                return Ok(simulated.seat(place, seat, output));
            }
            let mut console = own_program(&folder.join(format!("seat{seat}")))?;
            console.args(["fly", "--plain", "--no-record", "--vehicles"]);
            console.arg(options.vehicles.to_string());
            console.arg("--class").arg(class);
            Ok(seats::console(console, seat, output)?)
        });
        Ok(Self {
            desk,
            seats: seats.context("a seat does not start")?,
            simulated,
        })
    }

    /// The bytes that the desk and the seats have exchanged so far, if they can be seen.
    fn bytes(&self, network: bool) -> Option<u64> {
        if network {
            return cost::loopback_bytes();
        }
        self.simulated.as_ref().map(SimulatedSeats::bytes)
    }

    /// The command of a round.
    fn probe(&self, round: usize) -> Probe {
        if self.simulated.is_some() {
            // One letter, so that no part of it stands on the screen already.
            let letter = char::from(b'a' + (round % 26) as u8);
            let line: String = std::iter::repeat_n(letter, 6).collect();
            return Probe {
                sought: line.clone(),
                line,
            };
        }
        let heading = HEADINGS[round / self.seats.count() % HEADINGS.len()];
        Probe {
            line: format!("all yaw {heading}"),
            sought: heading.to_owned(),
        }
    }

    /// Waits until all seats have joined: until each has shown a message.
    fn gather(&mut self) -> anyhow::Result<()> {
        let begun = Instant::now();
        let mut here = vec![false; self.seats.count()];
        for number in 0.. {
            let text = format!("join-{number:04}");
            self.say_to_all(&text)?;
            let until = Instant::now() + ROUND;
            while Instant::now() < until && here.contains(&false) {
                self.desk.next(GLANCE);
                for line in self.seats.lines() {
                    here[line.seat] |= line.text.contains("join-");
                }
            }
            let missing = here.iter().filter(|is_here| !**is_here).count();
            if missing == 0 {
                break;
            }
            anyhow::ensure!(begun.elapsed() < STARTING, "{missing} seats did not join");
        }
        Ok(())
    }

    /// Gives an order to all seats, and a command at one of them; adds the delays of what was seen.
    fn round(
        &mut self,
        number: usize,
        orders: &mut Vec<Duration>,
        board: &mut Vec<Duration>,
    ) -> anyhow::Result<()> {
        let text = format!("bench-{number:04}");
        let ordered = Instant::now();
        self.say_to_all(&text)?;
        let count = self.seats.count();
        let probe = self.probe(number);
        // The delay varies, so that commands do not fall into step with the seat's reports.
        let command_at = ordered + Duration::from_millis((number as u64 * 137) % 500);
        let (mut commanded, mut shown, mut is_seen) = (None, Vec::new(), false);
        let mut heard = vec![false; count];
        while ordered.elapsed() < ROUND {
            if commanded.is_none() && Instant::now() >= command_at {
                commanded = Some(Instant::now());
                self.seats.give(number % count, &probe.line)?;
            }
            for line in self.seats.lines() {
                if line.text.contains(&text) && !std::mem::replace(&mut heard[line.seat], true) {
                    orders.push(line.at.saturating_duration_since(ordered));
                }
            }
            let output = self.desk.next(GLANCE);
            let (Some(output), Some(begun)) = (output, commanded.filter(|_| !is_seen)) else {
                continue;
            };
            shown.extend_from_slice(&output.bytes);
            let mut places = shown.windows(probe.sought.len());
            is_seen = places.any(|place| place == probe.sought.as_bytes());
            if is_seen {
                board.push(output.at.saturating_duration_since(begun));
            }
        }
        Ok(())
    }

    fn say_to_all(&mut self, text: &str) -> std::io::Result<()> {
        let line = format!(":class message @all {text}\r");
        self.desk.press(line.as_bytes())
    }

    /// Lets time pass, and reads what both sides show meanwhile.
    fn pass(&mut self, time: Duration) {
        let until = Instant::now() + time;
        while Instant::now() < until {
            self.desk.next(GLANCE);
            self.seats.lines().for_each(drop);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_that_never_end_are_counted_and_do_not_hide() {
        let seen = (1..=100).map(Duration::from_millis).collect();
        let delays = Delays::of(seen, 103);
        assert_eq!((delays.count, delays.lost), (100, 3));
        assert!((delays.median_ms - 51.0).abs() < 1e-9);
        assert!((delays.p99_ms - 99.0).abs() < 1e-9);
        assert!((delays.most_ms - 100.0).abs() < 1e-9);
        let none = Delays::of(Vec::new(), 2);
        assert_eq!(none.lost, 2);
        assert!(none.median_ms.is_nan());
    }
}
