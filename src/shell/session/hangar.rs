//! The processes of a session's vehicles, launched by a task so that the screen does not block.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use tokio::sync::{mpsc, watch};
use tokio_util::sync::CancellationToken;

use super::RunningSession;
use crate::app::event::{Event, ProcessEvent};
use crate::app::state::Instance;
use crate::hangar::{
    self, Hangars, InstancePlace, Launch, LaunchedVehicle, OutputLine, Seen, SitlSource,
};
use crate::language::ProcessDeed;
use crate::link::Transport;
use crate::notice::sanitised;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

mod usage;

use usage::{ProcessUsage, shown};

/// How long to wait for an earlier session's processes before new ones start.
const ENDING_PATIENCE: Duration = Duration::from_secs(5);
/// The time between reads of a process's output.
const LOOK_EVERY: Duration = Duration::from_millis(500);
/// The maximum number of waiting events.
const NEWS_KEPT: usize = 64;

enum ProcessNews {
    Opened(Arc<Hangars>),
    /// All vehicles are launched; these are their links.
    Launched(Vec<LaunchedVehicle>),
    NotLaunched(Text),
    Failed(Text),
    /// The output of a vehicle's process, beginning with the line of this number.
    Printed(VehicleId, u64, Vec<OutputLine>),
}

/// The processes of a session. Dropping it ends them.
pub(super) struct Processes {
    pub count: usize,
    news: mpsc::Receiver<ProcessNews>,
    sender: mpsc::Sender<ProcessNews>,
    hangars: Option<Arc<Hangars>>,
    seen: Option<watch::Receiver<Seen>>,
    usage: BTreeMap<InstancePlace, ProcessUsage>,
    restarts: BTreeMap<VehicleId, u32>,
    looking: Option<Looking>,
}

/// The process whose output is on the screen.
#[derive(Debug)]
struct Looking {
    vehicle: VehicleId,
    /// The number of the next line.
    next: u64,
    asked_at: Option<Duration>,
    is_asked: bool,
}

/// Processes that are ending.
#[derive(Debug, Default)]
pub(in crate::shell) struct SessionEnding(Option<watch::Receiver<Seen>>);

impl SessionEnding {
    /// Waits until the processes have ended, for at most `patience`.
    pub async fn over(self, patience: Duration) {
        if let Some(mut seen) = self.0 {
            // They are also gone if the sender is gone.
            let gone = seen.wait_for(|all| all.is_empty());
            drop(tokio::time::timeout(patience, gone).await);
        }
    }
}

impl Processes {
    /// Starts to launch vehicles once earlier processes are gone, or `ENDING_PATIENCE` has passed.
    pub fn launch(
        source: SitlSource,
        launches: Vec<Launch>,
        before: SessionEnding,
        cancel: CancellationToken,
    ) -> Self {
        let count = launches.len();
        let (sender, news) = mpsc::channel(NEWS_KEPT);
        let told = sender.clone();
        tokio::spawn(async move {
            let launched = async {
                before.over(ENDING_PATIENCE).await;
                if let Err(reason) = open_and_launch(&source, launches, &told).await {
                    drop(
                        told.send(ProcessNews::NotLaunched(text!(
                            "hangar-failed",
                            reason = reason
                        )))
                        .await,
                    );
                }
            };
            tokio::select! {
                () = cancel.cancelled() => {}
                () = launched => {}
            }
        });
        Self {
            count,
            news,
            sender,
            hangars: None,
            seen: None,
            usage: BTreeMap::new(),
            restarts: BTreeMap::new(),
            looking: None,
        }
    }

    fn hear(&mut self) -> Option<ProcessNews> {
        let news = self.news.try_recv().ok()?;
        if let ProcessNews::Opened(hangars) = &news {
            self.seen = Some(hangars.instances());
            self.hangars = Some(Arc::clone(hangars));
        }
        Some(news)
    }

    fn changed(&mut self, now: Duration) -> Option<Vec<Instance>> {
        let seen = self.seen.as_mut()?;
        if !seen.has_changed().unwrap_or(false) {
            return None;
        }
        let all = Arc::clone(&seen.borrow_and_update());
        let names = self
            .hangars
            .as_ref()
            .map(|hangars| hangars.names())
            .unwrap_or_default();
        let usage = &mut self.usage;
        let mut shown: Vec<Instance> = all
            .iter()
            .map(|(place, instance)| {
                let used = usage
                    .entry(*place)
                    .or_insert(ProcessUsage::of(instance.cpu_ms, now));
                let host = names
                    .get(place.hangar)
                    .map(String::as_str)
                    .unwrap_or_default();
                shown(instance, host, used.note(instance.cpu_ms, now))
            })
            .collect();
        shown.sort_by_key(|instance| instance.vehicle);
        Some(shown)
    }

    /// Stops or restarts the process of a vehicle; a failure is reported.
    fn order(&self, deed: ProcessDeed, vehicle: VehicleId) {
        let Some((hangars, place)) = self.place(vehicle) else {
            return;
        };
        let sender = self.sender.clone();
        tokio::spawn(async move {
            let outcome = match deed {
                ProcessDeed::Restart => hangars.restart(place).await,
                ProcessDeed::Stop => hangars.stop(place).await,
            };
            if let Err(refusal) = outcome {
                drop(sender.send(ProcessNews::Failed(Text::from(&refusal))).await);
            }
        });
    }

    /// The vehicles whose processes have been restarted since the last call.
    fn started_again(&mut self, instances: &[Instance]) -> Vec<VehicleId> {
        let mut again = Vec::new();
        for instance in instances {
            let known = self
                .restarts
                .entry(instance.vehicle)
                .or_insert(instance.restarts);
            if *known < instance.restarts {
                again.push(instance.vehicle);
            }
            *known = instance.restarts;
        }
        again
    }

    /// Requests the output of a vehicle's process; it arrives as [`ProcessNews::Printed`].
    fn look(&mut self, wanted: Option<VehicleId>, now: Duration) {
        let Some(vehicle) = wanted else {
            self.looking = None;
            return;
        };
        let Some((hangars, place)) = self.place(vehicle) else {
            return;
        };
        let known = self.looking.take().filter(|one| one.vehicle == vehicle);
        let looking = self.looking.insert(known.unwrap_or(Looking {
            vehicle,
            next: 0,
            asked_at: None,
            is_asked: false,
        }));
        let is_due = looking.asked_at.is_none_or(|at| now >= at + LOOK_EVERY);
        if looking.is_asked || !is_due {
            return;
        }
        (looking.asked_at, looking.is_asked) = (Some(now), true);
        let (sender, next) = (self.sender.clone(), looking.next);
        tokio::spawn(async move {
            // Without an answer, nothing more is shown.
            let lines = hangars.output(place, next).await.unwrap_or_default();
            drop(
                sender
                    .send(ProcessNews::Printed(vehicle, next, lines))
                    .await,
            );
        });
    }

    /// Takes a process's output, if it is still on the screen.
    fn printed(&mut self, vehicle: VehicleId, from: u64, lines: &[OutputLine]) -> Option<Event> {
        let mut process = self.looking.as_mut();
        let looking = process.take_if(|one| (one.vehicle, one.next) == (vehicle, from))?;
        looking.is_asked = false;
        looking.next = lines.last()?.number + 1;
        let printed = ProcessEvent::Printed {
            vehicle,
            anew: from == 0,
            lines: lines.iter().map(|line| sanitised(&line.text)).collect(),
        };
        Some(printed.into())
    }

    fn place(&self, vehicle: VehicleId) -> Option<(Arc<Hangars>, InstancePlace)> {
        let seen = self.seen.as_ref()?.borrow();
        let mine = |(_, instance): &&(InstancePlace, hangar::Instance)| {
            VehicleId::from(instance.system) == vehicle
        };
        let (place, _) = seen.iter().find(mine)?;
        Some((self.hangars.clone()?, *place))
    }

    /// A handle to wait for the processes to end after `self` is dropped.
    pub fn ending(&self) -> SessionEnding {
        SessionEnding(self.seen.clone())
    }
}

impl RunningSession {
    /// A handle to wait for the session's processes to end after `self` is dropped.
    pub fn ending(&self) -> SessionEnding {
        let processes = self.processes.as_ref();
        processes.map_or_else(SessionEnding::default, Processes::ending)
    }

    /// Stops or restarts the process of a vehicle.
    pub fn process(&self, deed: ProcessDeed, vehicle: VehicleId) {
        if let Some(processes) = &self.processes {
            processes.order(deed, vehicle);
        }
    }

    /// Requests the output of the process of `wanted`, the vehicle whose output is on the screen,
    /// if any.
    pub fn look_at_output(&mut self, wanted: Option<VehicleId>, now: Duration) {
        if let Some(processes) = &mut self.processes {
            processes.look(wanted, now);
        }
    }

    /// The news of the vehicles' processes.
    pub(super) fn hear_processes(&mut self, now: Duration) -> Vec<Event> {
        let Some(processes) = &mut self.processes else {
            return Vec::new();
        };
        let mut events = Vec::new();
        while let Some(news) = processes.hear() {
            let event = match news {
                ProcessNews::Opened(_) => None,
                ProcessNews::Launched(launched) => {
                    let mut pipes = launched
                        .into_iter()
                        .map(|one| Transport::Sitl(one.system.into(), one.pipe));
                    let refused = pipes.find_map(|pipe| self.fleet.connect(pipe).err());
                    refused.map(|reason| Event::Failed(reason.into()))
                }
                ProcessNews::NotLaunched(text) => Some(ProcessEvent::NotLaunched(text).into()),
                ProcessNews::Failed(text) => Some(Event::Failed(text)),
                ProcessNews::Printed(vehicle, from, lines) => {
                    processes.printed(vehicle, from, &lines)
                }
            };
            events.extend(event);
        }
        if let Some(instances) = processes.changed(now) {
            for vehicle in processes.started_again(&instances) {
                // A fleet that cannot take this call detects the restart by the vehicle's clock.
                let _ = self.fleet.restarted(vehicle);
            }
            events.push(ProcessEvent::Instances(instances).into());
        }
        events
    }
}

async fn open_and_launch(
    source: &SitlSource,
    launches: Vec<Launch>,
    told: &mpsc::Sender<ProcessNews>,
) -> Result<(), Text> {
    let hangars = Arc::new(source.open()?);
    // A receiver that is gone has cancelled this too.
    drop(told.send(ProcessNews::Opened(Arc::clone(&hangars))).await);
    let launched = hangars
        .launch(launches)
        .await
        .map_err(|refusal| Text::from(&refusal))?;
    drop(told.send(ProcessNews::Launched(launched)).await);
    Ok(())
}
