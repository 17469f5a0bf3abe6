//! One repeat: start, wait, fly, measure, end.

use std::thread::sleep;
use std::time::{Duration, Instant};

use super::cost::{self, Machine};
use super::progress::Progress;
use super::sample::Sample;
use super::strain::Strain;
use super::swarm::{STREAMS, Simulators, Spent, Swarm};
use super::track::Tracks;
use crate::commands::{Command, Destination, Heading};
use crate::geo::LatLon;
use crate::session::WANTED_STREAMS;
use crate::vehicle::Vehicle;

/// How often vehicles are looked at: several times between two messages at 10 Hz.
const LOOK_EVERY: Duration = Duration::from_millis(20);
/// `SYS_STATUS` and `EKF_STATUS_REPORT`: they tell when a vehicle can be armed, and are not streamed afterwards.
const FOR_READINESS: [u32; 2] = [1, 193];
/// What the vehicles are told first.
const TAKEOFF_M: f64 = 10.0;
/// How far to the north, and how high, they are sent then.
const TARGET_NORTH_M: f64 = 1000.0;
const TARGET_HEIGHT_M: f64 = 200.0;
/// A vehicle that has come so far from where it stood is on its way.
const MOVED_M: f64 = 2.0;
/// It has so long for that.
const MOVED_WITHIN: Duration = Duration::from_secs(20);
/// How long vehicles may take until they can be armed, and how much longer for each of them.
const READY_WITHIN: Duration = Duration::from_secs(90);
const READY_WITHIN_EACH: Duration = Duration::from_secs(3);

/// How a repeat goes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plan {
    /// How long to measure.
    pub window: Duration,
    /// The time between two kinds of commands.
    pub spacing: Duration,
}

impl Plan {
    /// How long a repeat takes when its vehicles can be armed.
    pub fn lasts(&self) -> Duration {
        self.window + 4 * self.spacing
    }
}

/// One repeat with so many vehicles.
///
/// # Errors
/// Why the vehicles could not be started, or did not become ready; or why nothing could be measured.
pub(super) fn trial(
    simulators: &Simulators,
    vehicles: u16,
    plan: Plan,
    progress: &mut Progress,
) -> anyhow::Result<Sample> {
    let mut swarm = Swarm::start(simulators, vehicles)?;
    let outcome = Trial {
        swarm: &mut swarm,
        plan,
        progress,
    }
    .run();
    swarm.end();
    outcome
}

struct Trial<'a> {
    swarm: &'a mut Swarm,
    plan: Plan,
    progress: &'a mut Progress,
}

impl Trial<'_> {
    fn run(mut self) -> anyhow::Result<Sample> {
        self.wait_until_ready()?;
        self.progress.booted();
        let starts = self.places();
        if !starts.is_empty() {
            self.fly();
        }
        let void = self.wait_until_moved(&starts);
        let mut sample = self.measure()?;
        sample.void = void.or_else(|| self.who_stood_still(&starts));
        Ok(sample)
    }

    fn wait_until_ready(&mut self) -> anyhow::Result<()> {
        let begun = Instant::now();
        loop {
            for id in self.swarm.hear() {
                for message in FOR_READINESS {
                    let rate_hz = 1.0;
                    let command = Command::MessageInterval { message, rate_hz };
                    self.swarm.order(id, command);
                }
            }
            let (ready, all) = self.swarm.ready()?;
            if ready == all {
                return Ok(());
            }
            self.progress.say(&format!("{ready} of {all} can be armed"));
            if begun.elapsed() > READY_WITHIN + READY_WITHIN_EACH * all as u32 {
                let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
                let load = load.split(' ').next().unwrap_or("?").to_owned();
                anyhow::bail!(
                    "{ready} of {all} vehicles could be armed after {:.0} s (load of the machine: {load})",
                    begun.elapsed().as_secs_f64()
                );
            }
            sleep(LOOK_EVERY);
        }
    }

    /// Only what is to be measured is streamed; then the vehicles are sent on their way.
    fn fly(&mut self) {
        self.progress.say("streams");
        let others = WANTED_STREAMS.iter().map(|stream| stream.message);
        let others = others.filter(|id| STREAMS.iter().all(|stream| stream.message != *id));
        for message in others {
            let rate_hz = 0.0;
            self.swarm
                .order_all(|_| Command::MessageInterval { message, rate_hz });
        }
        for stream in STREAMS {
            self.swarm.order_all(|_| Command::MessageInterval {
                message: stream.message,
                rate_hz: stream.rate_hz,
            });
        }
        let name = || "GUIDED".to_owned();
        self.command("GUIDED", |_| Command::SetMode { name: name() });
        self.command("arm", |_| Command::Arm);
        let altitude_m = TAKEOFF_M;
        self.command("take off", |_| Command::Takeoff { altitude_m });
        self.command("target", target);
    }

    fn command(&mut self, name: &str, command: impl Fn(&Vehicle) -> Command) {
        self.progress.say(name);
        self.swarm.order_all(command);
        self.watch(self.plan.spacing, |_| {});
    }

    /// Lets time pass, and takes looks.
    fn watch(&mut self, lasting: Duration, mut look: impl FnMut(&Swarm)) {
        let until = Instant::now() + lasting;
        while Instant::now() < until {
            self.swarm.hear();
            look(self.swarm);
            sleep(LOOK_EVERY.min(until.saturating_duration_since(Instant::now())));
        }
    }

    /// Where the vehicles are, and their heights above home.
    fn places(&self) -> Vec<Option<(LatLon, f64)>> {
        let mut places = Vec::new();
        self.swarm.each(|_, vehicle| places.push(place(vehicle)));
        places
    }

    /// Waits until all vehicles are on their way; says which are not.
    fn wait_until_moved(&mut self, starts: &[Option<(LatLon, f64)>]) -> Option<String> {
        let begun = Instant::now();
        loop {
            let void = self.who_stood_still(starts);
            if void.is_none() || begun.elapsed() > MOVED_WITHIN {
                return void;
            }
            self.progress.say("waiting until all have moved");
            self.watch(Duration::from_millis(200), |_| {});
        }
    }

    fn who_stood_still(&self, starts: &[Option<(LatLon, f64)>]) -> Option<String> {
        let places = self.places();
        let still = places.iter().zip(starts).filter(|(now, then)| {
            !now.zip(**then).is_some_and(|((at, height), (from, low))| {
                at.distance_m(from).hypot(height - low) >= MOVED_M
            })
        });
        let still = still.count();
        let refusal = self.swarm.refusal().map(|why| format!(" ({why})"));
        (still > 0).then(|| {
            format!(
                "{still} of {} vehicles did not move{}",
                starts.len(),
                refusal.unwrap_or_default()
            )
        })
    }

    fn measure(&mut self) -> anyhow::Result<Sample> {
        self.progress.say("measuring");
        let mut tracks = Tracks::default();
        let before = Mark::now(self.swarm)?;
        let window = self.plan.window;
        self.watch(window, |swarm| {
            swarm.each(|index, vehicle| tracks.see(index, vehicle));
        });
        let after = Mark::now(self.swarm)?;
        let mut sample = after.since(&before);
        sample.gaps = tracks.gaps();
        sample.factor = tracks.factor();
        sample.memory_bytes = self.swarm.memory_bytes();
        Ok(sample)
    }
}

fn place(vehicle: &Vehicle) -> Option<(LatLon, f64)> {
    vehicle
        .global
        .map(|global| (global.at_point, global.altitude_m))
}

fn target(vehicle: &Vehicle) -> Command {
    let here = vehicle.global.map(|global| global.at_point);
    Command::Goto {
        destination: Destination::Global {
            at_point: here
                .unwrap_or(LatLon::new(0.0, 0.0))
                .moved(TARGET_NORTH_M, 0.0),
            altitude_m: Some(TARGET_HEIGHT_M),
        },
        heading: Heading::Auto,
    }
}

/// Where all meters stand.
struct Mark {
    at: Instant,
    spent: Spent,
    messages: (u64, u64, u64),
    machine: Machine,
}

impl Mark {
    fn now(swarm: &Swarm) -> anyhow::Result<Self> {
        Ok(Self {
            at: Instant::now(),
            spent: swarm.spent()?,
            messages: swarm.messages(),
            machine: Machine::now().unwrap_or_default(),
        })
    }

    fn since(&self, before: &Self) -> Sample {
        let ms =
            |after: Duration, before: Duration| after.saturating_sub(before).as_secs_f64() * 1e3;
        let window_s = (self.at - before.at).as_secs_f64();
        let percent = |ms: f64| ms / 10.0 / window_s;
        let pairs = self.spent.model.iter().zip(&before.spent.model);
        let model: Vec<f64> = pairs.map(|(&after, &before)| ms(after, before)).collect();
        let sim_ms = ms(self.spent.sim, before.spent.sim);
        let sim_thread = self.spent.sim_thread.zip(before.spent.sim_thread);
        let relay = self.spent.relay.zip(before.spent.relay);
        let missing = self.messages.1.saturating_sub(before.messages.1);
        let lost_before = self.messages.2.saturating_sub(before.messages.2);
        Sample {
            window_s,
            sim_ms,
            model_ms: model.iter().sum(),
            relay_ms: relay.map(|(after, before)| ms(after, before)),
            messages: self.messages.0.saturating_sub(before.messages.0),
            strain: Strain {
                cores: std::thread::available_parallelism().map_or(1, usize::from),
                machine_busy_percent: self.machine.busy_percent_since(before.machine),
                sim_percent: percent(sim_ms),
                sim_thread_percent: sim_thread.map(|(after, before)| percent(ms(after, before))),
                model_thread_percent: percent(model.iter().copied().fold(0.0, f64::max)),
                lost_in_console: missing.saturating_sub(lost_before),
                lost_before,
                memory_available_percent: cost::memory_available_percent(),
            },
            ..Sample::default()
        }
    }
}
