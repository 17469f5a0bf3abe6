//! The body of a stand-in: a vehicle of the embedded simulator with the options and the conduct of SITL.

use std::fs;
use std::io::{ErrorKind, Read as _, Write as _};
use std::net::{SocketAddr, TcpStream};
use std::path::Path;
use std::process::{Command, Stdio, exit};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use mavlink::dialects::ardupilotmega::{COMMAND_LONG_DATA, MavCmd, MavMessage, PARAM_SET_DATA};
use sortie::geo::LatLon;
use sortie::sim::{Airframe, BootPace, PortId, STEP, Start, World, WorldConfig};
use sortie::wire::{Encoder, GROUND_STATION_COMPONENT, GROUND_STATION_SYSTEM};

use super::{Behaviour, CRASH_FILE, LIFE, MEMORY_FILE};

/// How long the stand-in waits for bytes before the next steps of its world.
const ROUND: Duration = Duration::from_millis(5);
/// The maximum lost time (of a stopped process or a busy machine) that is caught up at once.
const CATCH_UP: Duration = Duration::from_millis(250);
/// The bytes that [`Behaviour::FloodsItsOutput`] prints at once, 20 times a second: a megabyte a second.
const FLOOD_LEN: usize = 50_000;

/// The values of the options.
pub struct Program {
    behaviour: Behaviour,
    door: SocketAddr,
    system: u8,
    speedup: f64,
    start: Start,
    airframe: Option<Airframe>,
    parameters: Vec<(String, f32)>,
}

fn fail(what: &str) -> ! {
    println!("{what}");
    exit(1)
}

impl Program {
    pub fn new(behaviour: Behaviour, arguments: &str) -> Self {
        let words: Vec<&str> = arguments.lines().collect();
        if words.contains(&"--help") || words.contains(&"-h") {
            println!("Options:\n\t--help|-h                display this help information");
            println!(
                "\t--model|-M MODEL         set simulation model\n\tnot ArduPilot: a stand-in"
            );
            exit(0);
        }
        let value = |option: &str| {
            let place = words.iter().position(|word| *word == option)?;
            words.get(place + 1).copied()
        };
        let Some(model) = value("--model") else {
            fail("You must specify a vehicle model.  Options are:\n  quad\n  x\n  hexa");
        };
        let door = value("--serial0").and_then(|door| door.strip_prefix("tcpclient:"));
        let Some(door) = door.and_then(|door| door.parse().ok()) else {
            fail("the stand-in needs --serial0 tcpclient:ADDRESS:PORT");
        };
        let number = |option, usual| value(option).map_or(usual, |text| text.parse().expect("it"));
        Self {
            behaviour,
            door,
            system: number("--sysid", 1.0) as u8,
            speedup: number("--speedup", 1.0),
            start: start(value("--home").unwrap_or("-35.363262,149.165237,584,0")),
            airframe: model.split_once(':').map(|(_, path)| airframe(path)),
            parameters: parameters(value("--defaults")),
        }
    }

    pub fn run(self) -> ! {
        let starts = count_start();
        println!("Setting SIM_SPEEDUP={}", self.speedup);
        println!("Starting sketch 'ArduCopter'");
        match self.behaviour {
            Behaviour::ExitsBeforeConnecting => {
                println!("the stand-in gives up");
                exit(3);
            }
            Behaviour::FailsAtFirst(times) if starts <= u64::from(times) => {
                println!("start {starts} fails");
                exit(4);
            }
            Behaviour::NeverConnects => loop {
                thread::sleep(LIFE);
            },
            Behaviour::HasChildren => {
                let mut child = Command::new("sleep");
                let child = child.arg("300").stdout(Stdio::null()).spawn();
                println!("child {}", child.expect("it starts").id());
            }
            Behaviour::FloodsItsOutput => drop(thread::spawn(flood)),
            _ => {}
        }
        let stream = connect(self.door);
        if self.behaviour == Behaviour::StaysSilent {
            let _open = stream;
            loop {
                std::hint::spin_loop();
            }
        }
        Flight::new(self, stream).run()
    }

    /// The vehicle, with its parameters and its system id, before its boot.
    fn world(&self) -> World {
        let mut world = World::new(&WorldConfig {
            airframes: self.airframe.clone().map(Arc::new).into_iter().collect(),
            boot: if self.behaviour == Behaviour::BootsSlowly {
                BootPace::Realistic
            } else {
                BootPace::Quick
            },
            ..WorldConfig::row(1, self.start)
        });
        let port = world.connect(0);
        let mut settings = self.parameters.clone();
        settings.push(("SIM_SPEEDUP".to_owned(), self.speedup as f32));
        if self.behaviour == Behaviour::NeverReady {
            settings.push(("SIM_GPS_DISABLE".to_owned(), 1.0));
        }
        settings.push(("SYSID_THISMAV".to_owned(), f32::from(self.system)));
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(GROUND_STATION_SYSTEM, GROUND_STATION_COMPONENT);
        for (name, value) in settings {
            let message = MavMessage::PARAM_SET(PARAM_SET_DATA {
                target_system: 1,
                target_component: 1,
                param_id: name.as_str().into(),
                param_value: value,
                ..PARAM_SET_DATA::default()
            });
            encoder.encode_message(&message, &mut bytes);
        }
        let reboot = MavMessage::COMMAND_LONG(COMMAND_LONG_DATA {
            target_system: 1,
            target_component: 1,
            command: MavCmd::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN,
            param1: 1.0,
            ..COMMAND_LONG_DATA::default()
        });
        encoder.encode_message(&reboot, &mut bytes);
        // A new vehicle does not receive messages in its first steps.
        for _ in 0..5 {
            world.step();
        }
        world.receive(port, &bytes);
        for _ in 0..1000 {
            if world.is_open(port) {
                world.step();
            }
        }
        assert!(!world.is_open(port), "it has rebooted");
        world.disconnect(port);
        world
    }
}

/// A running stand-in.
struct Flight {
    program: Program,
    world: World,
    port: PortId,
    /// The connection; like SITL, the stand-in does not open another one once it is closed.
    stream: Option<TcpStream>,
}

impl Flight {
    fn new(program: Program, stream: TcpStream) -> Self {
        let mut world = program.world();
        let port = world.connect(0);
        Self {
            program,
            world,
            port,
            stream: Some(stream),
        }
    }

    fn run(mut self) -> ! {
        let begun = self.world.now();
        let mut last = Instant::now();
        let mut owed = Duration::ZERO;
        loop {
            self.read();
            let now = Instant::now();
            let pace = self.world.wanted_speedup().unwrap_or(1.0);
            owed += (now - last).min(CATCH_UP).mul_f64(pace);
            last = now;
            while owed >= STEP {
                owed -= STEP;
                self.world.step();
            }
            self.write();
            if !self.world.is_open(self.port) {
                self.stream = Some(connect(self.program.door));
                self.port = self.world.connect(0);
            }
            let lived = self.world.now().saturating_sub(begun);
            let crashes = match self.program.behaviour {
                Behaviour::CrashesAfter(seconds) => lived >= Duration::from_secs(seconds.into()),
                _ => false,
            };
            if crashes || fs::remove_file(CRASH_FILE).is_ok() {
                eprintln!("ERROR: Floating point exception - aborting");
                std::process::abort();
            }
        }
    }

    fn read(&mut self) {
        let mut bytes = [0; 4096];
        match self.stream.as_mut().map(|stream| stream.read(&mut bytes)) {
            Some(Ok(len)) if len > 0 => self.world.receive(self.port, &bytes[..len]),
            Some(Err(error))
                if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {}
            None => thread::sleep(ROUND),
            Some(_) => self.stream = None,
        }
    }

    fn write(&mut self) {
        let mut bytes = Vec::new();
        self.world.take_output(self.port, &mut bytes);
        if let Some(stream) = &mut self.stream
            && stream.write_all(&bytes).is_err()
        {
            self.stream = None;
        }
    }
}

fn connect(door: SocketAddr) -> TcpStream {
    let Ok(mut stream) = TcpStream::connect(door) else {
        fail("connect failed");
    };
    stream
        .set_read_timeout(Some(ROUND))
        .and_then(|()| stream.set_nodelay(true))
        .expect("a socket");
    let greeting = b"\n\nInit ArduCopter V4.6.0-stand-in\n\nFree RAM: 131072\n";
    stream.write_all(greeting).expect("it has been accepted");
    stream
}

fn flood() {
    let junk = "#################################################\n".repeat(FLOOD_LEN / 50);
    while std::io::stdout().write_all(junk.as_bytes()).is_ok() {
        thread::sleep(Duration::from_millis(50));
    }
}

/// How many times a stand-in has been started in this folder, including this time.
fn count_start() -> u64 {
    let memory = fs::OpenOptions::new()
        .append(true)
        .create(true)
        .open(MEMORY_FILE);
    let Ok(mut memory) = memory else {
        fail("cannot write eeprom.bin");
    };
    if memory.write_all(b".").is_err() {
        fail("cannot write eeprom.bin");
    }
    memory.metadata().map_or(0, |memory| memory.len())
}

fn start(home: &str) -> Start {
    let numbers: Vec<f64> = home
        .split(',')
        .map_while(|part| part.parse().ok())
        .collect();
    let [lat, lon, altitude_amsl_m, heading_deg] = numbers[..] else {
        fail("Home location format should be: lat,lng,alt,yaw");
    };
    Start {
        at: LatLon::new(lat, lon),
        altitude_amsl_m,
        heading_deg,
    }
}

/// Reads the airframe file. The real SITL panics at an absolute path, and then hangs forever.
fn airframe(path: &str) -> Airframe {
    let text = fs::read_to_string(path).ok();
    let text = text.filter(|_| Path::new(path).is_relative());
    let airframe = text.and_then(|text| Airframe::from_json(&text).ok());
    airframe.map_or_else(
        || {
            println!("PANIC: failed to load frame {path}");
            loop {
                thread::sleep(LIFE);
            }
        },
        |(airframe, _)| airframe,
    )
}

fn parameters(path: Option<&str>) -> Vec<(String, f32)> {
    let text = path.map_or_else(String::new, |path| {
        fs::read_to_string(path).unwrap_or_else(|_| fail("Unable to open defaults file"))
    });
    text.lines()
        .filter_map(|line| line.split_once([' ', ',', '\t']))
        .filter_map(|(name, value)| Some((name.to_owned(), value.trim().parse().ok()?)))
        .collect()
}
