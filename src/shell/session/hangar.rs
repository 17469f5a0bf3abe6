//! The processes of a session's vehicles. A task launches them, so that the screen does not wait.

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

/// How long the processes of an earlier session may take to end before new ones are started.
const ENDING_PATIENCE: Duration = Duration::from_secs(5);
/// What a process prints is looked at so often.
const LOOK_EVERY: Duration = Duration::from_millis(500);
/// Things that may wait to be told.
const NEWS_KEPT: usize = 64;

/// What comes of launching, and of what is asked of processes.
enum ProcessNews {
    /// The hangars are open.
    Opened(Arc<Hangars>),
    /// All vehicles are launched; these are their links.
    Launched(Vec<LaunchedVehicle>),
    /// They could not be launched.
    NotLaunched(Text),
    /// Something could not be done.
    Failed(Text),
    /// What a vehicle's process has printed, from the line with this number on.
    Printed(VehicleId, u64, Vec<OutputLine>),
}

/// The processes of a session. Dropping it ends them.
pub(super) struct Processes {
    /// How many there are to be.
    pub count: usize,
    news: mpsc::Receiver<ProcessNews>,
    sender: mpsc::Sender<ProcessNews>,
    hangars: Option<Arc<Hangars>>,
    seen: Option<watch::Receiver<Seen>>,
    usage: BTreeMap<InstancePlace, ProcessUsage>,
    /// How often each was started again.
    restarts: BTreeMap<VehicleId, u32>,
    looking: Option<Looking>,
}

/// The process whose output is looked at.
#[derive(Debug)]
struct Looking {
    vehicle: VehicleId,
    /// The number of the line that comes next.
    next: u64,
    /// When it was asked for last.
    asked_at: Option<Duration>,
    is_asked: bool,
}

/// Processes that are being ended.
#[derive(Debug, Default)]
pub(in crate::shell) struct SessionEnding(Option<watch::Receiver<Seen>>);

impl SessionEnding {
    /// Waits until they are gone, for a while.
    pub async fn over(self, patience: Duration) {
        if let Some(mut seen) = self.0 {
            // They are gone too when nobody is left to tell of them.
            let gone = seen.wait_for(|all| all.is_empty());
            drop(tokio::time::timeout(patience, gone).await);
        }
    }
}

impl Processes {
    /// Begins to launch vehicles, once the processes before them are gone.
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

    /// What there is to tell.
    fn hear(&mut self) -> Option<ProcessNews> {
        let news = self.news.try_recv().ok()?;
        if let ProcessNews::Opened(hangars) = &news {
            self.seen = Some(hangars.instances());
            self.hangars = Some(Arc::clone(hangars));
        }
        Some(news)
    }

    /// How the processes are doing, if that has changed.
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

    /// The vehicles whose processes were started again since they were looked at last.
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

    /// Looks at what the process of a vehicle prints; it is told as [`ProcessNews::Printed`].
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
            // Of one that does not tell nothing more is shown.
            let lines = hangars.output(place, next).await.unwrap_or_default();
            drop(
                sender
                    .send(ProcessNews::Printed(vehicle, next, lines))
                    .await,
            );
        });
    }

    /// Takes over what a process has printed, if it is still looked at.
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

    /// Where the process of a vehicle is.
    fn place(&self, vehicle: VehicleId) -> Option<(Arc<Hangars>, InstancePlace)> {
        let seen = self.seen.as_ref()?.borrow();
        let mine = |(_, instance): &&(InstancePlace, hangar::Instance)| {
            VehicleId::from(instance.system) == vehicle
        };
        let (place, _) = seen.iter().find(mine)?;
        Some((self.hangars.clone()?, *place))
    }

    /// Tells when the processes are gone, once this is dropped.
    pub fn ending(&self) -> SessionEnding {
        SessionEnding(self.seen.clone())
    }
}

impl RunningSession {
    /// What of the session takes a while to end, once this is dropped.
    pub fn ending(&self) -> SessionEnding {
        let processes = self.processes.as_ref();
        processes.map_or_else(SessionEnding::default, Processes::ending)
    }

    /// Has the process of a vehicle ended or started again.
    pub fn process(&self, deed: ProcessDeed, vehicle: VehicleId) {
        if let Some(processes) = &self.processes {
            processes.order(deed, vehicle);
        }
    }

    /// Looks at what the process of a vehicle prints, if one is wanted.
    pub fn look_at_output(&mut self, wanted: Option<VehicleId>, now: Duration) {
        if let Some(processes) = &mut self.processes {
            processes.look(wanted, now);
        }
    }

    /// What has become of the vehicles' processes.
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
                        .map(|vehicle| Transport::Pipe(vehicle.pipe));
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
                // A fleet that cannot keep up sees it by the vehicle's clock.
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
    // Whoever does not want to hear it any more has cancelled this too.
    drop(told.send(ProcessNews::Opened(Arc::clone(&hangars))).await);
    let launched = hangars
        .launch(launches)
        .await
        .map_err(|refusal| Text::from(&refusal))?;
    drop(told.send(ProcessNews::Launched(launched)).await);
    Ok(())
}
