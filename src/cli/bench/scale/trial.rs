//! One repeat: start, wait, fly, measure, end.

use std::thread::sleep;
use std::time::{Duration, Instant};

use super::instances::SitlBench;
use super::progress::ScaleProgress;
use super::sample::ScaleSample;
use super::swarm::{STREAMS, ScaleSwarm, interval};
use crate::commands::{ArmingCommand, Command, Destination, FlightCommand, Heading, MotionCommand};
use crate::geo::LatLon;
use crate::session::{Stream, WANTED_STREAMS};
use crate::vehicle::Vehicle;

/// The interval of reading the vehicles' messages.
const LOOK_EVERY: Duration = Duration::from_millis(20);
const TAKEOFF_M: f64 = 10.0;
/// The distance from a vehicle to its target, which is due north.
const TARGET_NORTH_M: f64 = 1000.0;
/// The height of the second command's target.
const TARGET_HEIGHT_M: f64 = 200.0;
/// The minimum movement, up or north, of a vehicle that has obeyed, in metres.
const MOVED_M: f64 = 2.0;
/// How long all vehicles may take to obey, besides the time between two commands.
const OBEYED_WITHIN: Duration = Duration::from_secs(20);
/// How long vehicles may take until they can be armed.
const READY_WITHIN: Duration = Duration::from_secs(90);
/// The time that each vehicle adds to [`READY_WITHIN`].
const READY_WITHIN_EACH: Duration = Duration::from_secs(3);

/// The plan of a repeat.
#[derive(Debug, Clone, Copy)]
pub(super) struct TrialPlan {
    /// The length of the measurement.
    pub window: Duration,
    /// The minimum time between two kinds of commands.
    pub spacing: Duration,
}

impl TrialPlan {
    /// The duration of a repeat after its vehicles can be armed.
    pub fn lasts(&self) -> Duration {
        self.window + 4 * self.spacing
    }
}

/// Runs one repeat with a number of vehicles.
///
/// # Errors
/// The vehicles could not be started or did not become ready, or nothing could be measured.
pub(super) fn trial(
    bench: Option<&SitlBench>,
    vehicles: u16,
    plan: TrialPlan,
    progress: &mut ScaleProgress,
) -> anyhow::Result<ScaleSample> {
    let mut trial = ScaleTrial {
        swarm: ScaleSwarm::start(bench, vehicles)?,
        plan,
        progress,
    };
    trial.get_ready()?;
    let void = if vehicles > 0 { trial.fly() } else { None };
    let mut sample = trial.measure()?;
    sample.void = void;
    Ok(sample)
}

struct ScaleTrial<'a> {
    swarm: ScaleSwarm<'a>,
    plan: TrialPlan,
    progress: &'a mut ScaleProgress,
}

impl ScaleTrial<'_> {
    fn get_ready(&mut self) -> anyhow::Result<()> {
        let begun = Instant::now();
        loop {
            self.swarm.hear();
            let (ready, all) = self.swarm.ready()?;
            if ready == all {
                self.progress.booted();
                return Ok(());
            }
            self.progress.say(&format!("{ready} of {all} can be armed"));
            if begun.elapsed() > READY_WITHIN + READY_WITHIN_EACH * all as u32 {
                let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
                anyhow::bail!(
                    "{ready} of {all} vehicles could be armed after {} s (load of the machine: {})",
                    begun.elapsed().as_secs(),
                    load.split(' ').next().unwrap_or("?")
                );
            }
            sleep(LOOK_EVERY);
        }
    }

    /// Makes the vehicles fly; returns a text about those that have not obeyed, or `None` if all
    /// have.
    fn fly(&mut self) -> Option<String> {
        self.progress.say("streams");
        // Only the measured messages are streamed.
        let others = WANTED_STREAMS
            .iter()
            .map(|stream| stream.message)
            .filter(|id| STREAMS.iter().all(|stream| stream.message != *id))
            .map(|message| Stream {
                message,
                rate_hz: 0.0,
            });
        for stream in others.chain(STREAMS.iter().copied()) {
            self.swarm.order(|_| interval(stream));
        }
        let is_guided = |vehicle: &Vehicle| vehicle.mode().is_some_and(|mode| mode.is("GUIDED"));
        let name = || "GUIDED".to_owned();
        let guided = self.command(
            "GUIDED",
            |_| Command::Flight(FlightCommand::SetMode { name: name() }),
            is_guided,
        );
        let armed = guided.or_else(|| {
            self.command(
                "arm",
                |_| Command::Arming(ArmingCommand::Arm),
                Vehicle::armed,
            )
        });
        let altitude_m = TAKEOFF_M;
        let takeoff = |_: &Vehicle| Command::Flight(FlightCommand::Takeoff { altitude_m });
        let is_up = |vehicle: &Vehicle| vehicle.altitude_m() >= Some(MOVED_M);
        let up = armed.or_else(|| self.command("take off", takeoff, is_up));
        up.or_else(|| self.send())
    }

    /// Sends the vehicles to a distant place; returns a text with the number that have not moved.
    fn send(&mut self) -> Option<String> {
        self.progress.say("target");
        let starts = self.swarm.each(position);
        self.swarm.order(target);
        self.listen(self.plan.spacing);
        self.wait("to move", |swarm| {
            let ways = swarm.each(position).into_iter().zip(&starts);
            let is_under_way = |(now, then): (Option<LatLon>, &Option<LatLon>)| {
                now.zip(*then)
                    .is_some_and(|(now, then)| now.distance_m(then) >= MOVED_M)
            };
            ways.map(is_under_way).collect()
        })
    }

    /// Gives a command, waits for the spacing, and then for the effect; returns a text with the
    /// number of vehicles that have not obeyed.
    fn command(
        &mut self,
        name: &str,
        command: impl Fn(&Vehicle) -> Command,
        has_obeyed: impl Fn(&Vehicle) -> bool,
    ) -> Option<String> {
        self.progress.say(name);
        self.swarm.order(command);
        self.listen(self.plan.spacing);
        self.wait(name, |swarm| swarm.each(&has_obeyed))
    }

    /// Waits until `are_good` returns true for all vehicles; returns a text if that takes longer
    /// than [`OBEYED_WITHIN`].
    fn wait(
        &mut self,
        name: &str,
        are_good: impl Fn(&ScaleSwarm<'_>) -> Vec<bool>,
    ) -> Option<String> {
        let begun = Instant::now();
        loop {
            let good = are_good(&self.swarm);
            let behind = good.iter().filter(|is_good| !**is_good).count();
            if behind == 0 {
                return None;
            }
            self.progress
                .say(&format!("{name}: waiting for {behind} of {}", good.len()));
            if begun.elapsed() > OBEYED_WITHIN {
                let refusal = self
                    .swarm
                    .refusal()
                    .map(|why| format!(" ({why})"))
                    .unwrap_or_default();
                let all = good.len();
                return Some(format!(
                    "{behind} of {all} vehicles did not carry out {name}{refusal}"
                ));
            }
            self.listen(LOOK_EVERY);
        }
    }

    fn listen(&mut self, lasting: Duration) {
        let until = Instant::now() + lasting;
        while Instant::now() < until {
            self.swarm.hear();
            sleep(LOOK_EVERY.min(until.saturating_duration_since(Instant::now())));
        }
    }

    fn measure(&mut self) -> anyhow::Result<ScaleSample> {
        self.progress.say("measuring");
        let before = self.swarm.mark()?;
        self.listen(self.plan.window);
        // An ended process would otherwise only show as a gap in the figures.
        self.swarm.ready()?;
        Ok(ScaleSample::between(&before, &self.swarm.mark()?))
    }
}

fn position(vehicle: &Vehicle) -> Option<LatLon> {
    Some(vehicle.global?.at_point)
}

fn target(vehicle: &Vehicle) -> Command {
    let here = position(vehicle).unwrap_or(LatLon::new(0.0, 0.0));
    Command::Motion(MotionCommand::Goto {
        destination: Destination::Global {
            at_point: here.moved(TARGET_NORTH_M, 0.0),
            altitude_m: Some(TARGET_HEIGHT_M),
        },
        heading: Heading::Auto,
    })
}
