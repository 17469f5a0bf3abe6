//! One instance's task: its process, its connection, its stages and its end.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{mpsc, oneshot};
use tokio::time::{Instant as Moment, sleep_until};

use super::launcher::{LaunchError, LaunchOrder, RunningProcess};
use super::output::ProcessOutput;
use super::process::{Belongs, Connection};
use super::progress::StartProgress;
use super::relay::{Passed, Relay};
use super::restarts::Restarts;
use super::{HangarShared, Instance, InstanceRequest, SitlStage};

mod begin;
mod ending;
mod meter;

pub(super) use begin::begin;
use ending::{remark, stacks, words};
use meter::InstanceMeter;

/// The time between queries to a booting instance.
const PROBE_EVERY: Duration = Duration::from_millis(50);
/// The interval of the checks that no event triggers.
const LOOK_EVERY: Duration = Duration::from_secs(1);
/// The number of lines of output shown when an instance has ended.
const LINES_SHOWN: usize = 20;

struct InstanceTask {
    shown: Instance,
    order: LaunchOrder,
    speedup: f64,
    /// How long it may run without an attached program.
    idle: Option<Duration>,
    unattended_since: Moment,
    restarts: Restarts,
    listener: TcpListener,
    relay: Relay,
    output: ProcessOutput,
    /// The stacks of earlier crashes, which say nothing about the current process.
    earlier_stacks: BTreeSet<String>,
    requests: mpsc::Receiver<InstanceRequest>,
    shared: Arc<HangarShared>,
}

enum InstanceEvent {
    /// A request to end the instance permanently, with the channel that notifies the requester.
    Over(Option<oneshot::Sender<()>>),
    Restart,
    Passed(Passed),
    Connected(TcpStream),
    /// The wait is over, or there is nothing to do.
    Nothing,
}

/// The end of a process, or of the attempt to start it.
enum ProcessEnd {
    /// It ended without a request, after having been ready for this long.
    Fault(String, Duration),
    /// It cannot be started, and another attempt would not help.
    Hopeless(String),
    /// The process was ended permanently.
    Stopped(Option<oneshot::Sender<()>>),
    /// The process was ended to be started again.
    Restart,
}

impl InstanceTask {
    async fn run(mut self) {
        let done = loop {
            let end = match self.start().await {
                Ok(running) => self.live(running).await,
                Err(end) => end,
            };
            self.forget_process();
            let wait = match end {
                ProcessEnd::Stopped(done) => break done,
                ProcessEnd::Restart => {
                    self.shown.restarts += 1;
                    continue;
                }
                ProcessEnd::Fault(reason, ready_for) => {
                    self.shown.fault = Some(reason);
                    self.restarts.failed(ready_for)
                }
                ProcessEnd::Hopeless(reason) => {
                    self.shown.fault = Some(reason);
                    None
                }
            };
            match self.lie(wait).await {
                Some(done) => break done,
                None => self.shown.restarts += 1,
            }
        };
        self.shared.roster.forget(self.shown.id);
        if let Some(done) = done {
            // The requester may no longer be waiting.
            let _ = done.send(());
        }
    }

    /// Waits for the instance's turn, and starts the process.
    async fn start(&mut self) -> Result<RunningProcess, ProcessEnd> {
        self.shown.fault = None;
        self.shown.hint = None;
        self.shown.last_output.clear();
        self.earlier_stacks = stacks(&self.order.folder);
        self.show(SitlStage::Queued);
        let shared = Arc::clone(&self.shared);
        let launching = shared.launcher.launch(self.order.clone());
        tokio::pin!(launching);
        loop {
            let event = tokio::select! {
                begun = &mut launching => return self.started(begun),
                event = self.event(Moment::now() + LOOK_EVERY) => event,
            };
            match event {
                InstanceEvent::Over(done) => return Err(ProcessEnd::Stopped(done)),
                // The instance is already starting.
                InstanceEvent::Restart
                | InstanceEvent::Passed(_)
                | InstanceEvent::Connected(_)
                | InstanceEvent::Nothing => {}
            }
            self.show(SitlStage::Queued);
        }
    }

    fn started(
        &mut self,
        begun: Result<RunningProcess, LaunchError>,
    ) -> Result<RunningProcess, ProcessEnd> {
        match begun {
            Ok(running) => {
                self.shown.pid = Some(running.pid());
                self.note_process(running.pid());
                self.show(SitlStage::Process);
                Ok(running)
            }
            Err(LaunchError::Closed) => Err(ProcessEnd::Stopped(None)),
            Err(error) if error.may_pass() => {
                Err(ProcessEnd::Fault(error.to_string(), Duration::ZERO))
            }
            Err(error) => Err(ProcessEnd::Hopeless(error.to_string())),
        }
    }

    /// Records the process, so that the next hangar finds it if this one does not end it.
    fn note_process(&self, pid: u32) {
        let (id, program) = (self.shown.id, &self.order.program);
        if let Err(error) = self.shared.run.note(id, pid, program) {
            self.output.note(&format!("sortie: {error}"));
        }
    }

    fn forget_process(&mut self) {
        self.shared.run.forget(self.shown.id);
        self.relay.disconnect();
        self.shown.pid = None;
        self.shown.memory_bytes = 0;
        self.shown.hint = None;
    }

    async fn live(&mut self, mut running: RunningProcess) -> ProcessEnd {
        let begun = Moment::now();
        let pid = running.pid();
        let following = self.output.follow(&mut running);
        let mut progress = StartProgress::new(self.shown.system, self.speedup, Duration::ZERO);
        let mut meter = InstanceMeter::new(pid);
        loop {
            let every = if progress.is_asking() {
                PROBE_EVERY
            } else {
                LOOK_EVERY
            };
            let event = tokio::select! {
                status = running.wait() => {
                    following.finish().await;
                    return ProcessEnd::Fault(words(status), progress.ready_for(begun.elapsed()));
                }
                event = self.event(Moment::now() + every) => event,
            };
            let now = begun.elapsed();
            match event {
                InstanceEvent::Over(done) => {
                    self.end(&mut running).await;
                    return ProcessEnd::Stopped(done);
                }
                InstanceEvent::Restart => {
                    self.end(&mut running).await;
                    self.restarts.forgive();
                    return ProcessEnd::Restart;
                }
                InstanceEvent::Connected(stream) => {
                    if self.admit(stream, pid) {
                        progress.connected(now);
                    }
                }
                InstanceEvent::Passed(Passed::Instance) => progress.hear(self.relay.said(), now),
                InstanceEvent::Passed(Passed::InstanceGone) => progress.disconnected(now),
                InstanceEvent::Passed(_) | InstanceEvent::Nothing => {}
            }
            self.proceed(&mut progress, &mut meter, now);
        }
    }

    /// Sends the instance the next queries, and publishes its state.
    fn proceed(&mut self, progress: &mut StartProgress, meter: &mut InstanceMeter, now: Duration) {
        let bytes = progress.say(self.relay.is_attached(), now);
        self.relay.send(&bytes);
        if meter.read(now) {
            self.shown.memory_bytes = meter.memory_bytes();
            self.shown.cpu_ms = meter.cpu_ms();
            self.shown.hint = progress.lack(now).map(|lack| self.diagnosis(lack, meter));
        }
        self.shown.parameters = progress.parameters();
        self.show(progress.stage(now));
    }

    /// Waits for the next event. Dropping the future loses nothing.
    async fn event(&mut self, until: Moment) -> InstanceEvent {
        let idle_at = match self.idle {
            Some(idle) if !self.relay.is_attached() => Some(self.unattended_since + idle),
            _ => None,
        };
        tokio::select! {
            () = self.shared.cancel.cancelled() => InstanceEvent::Over(None),
            request = self.requests.recv() => match request {
                Some(InstanceRequest::Attach(answer)) => {
                    let pipe = self.relay.attach();
                    self.shown.refused += u32::from(pipe.is_none());
                    drop(answer.send(pipe));
                    InstanceEvent::Nothing
                }
                Some(InstanceRequest::Restart) => InstanceEvent::Restart,
                Some(InstanceRequest::Stop(done)) => InstanceEvent::Over(Some(done)),
                None => InstanceEvent::Over(None),
            },
            passed = self.relay.pass() => {
                if passed == Passed::AttachedGone {
                    self.unattended_since = Moment::now();
                }
                InstanceEvent::Passed(passed)
            }
            // Connections are accepted only once it is known which process may connect.
            Ok((stream, _)) = self.listener.accept(), if self.shown.pid.is_some() => {
                InstanceEvent::Connected(stream)
            }
            () = sleep_until(idle_at.map_or(until, |at| at.min(until))) => {
                if idle_at.is_some_and(|at| at <= Moment::now()) {
                    InstanceEvent::Over(None)
                } else {
                    InstanceEvent::Nothing
                }
            }
        }
    }

    /// Accepts a connection if it is the instance's own; returns whether it is.
    fn admit(&mut self, stream: TcpStream, pid: u32) -> bool {
        let belongs = Connection::of(&stream).map(|connection| connection.is_of_process(pid));
        let is_own = match belongs {
            Some(Belongs::Yes) => true,
            // Some systems do not report the owner; then an existing connection is kept.
            Some(Belongs::Unknown) => !self.relay.is_connected(),
            Some(Belongs::No) | None => false,
        };
        if is_own {
            // The running program may differ from the one started: a script may have been replaced
            // by the program that it starts.
            self.note_process(pid);
            self.relay.connect(stream);
        } else {
            self.shown.refused += 1;
        }
        is_own
    }

    async fn end(&mut self, running: &mut RunningProcess) {
        self.show(SitlStage::Stopping);
        // An error means that the process has ended.
        drop(running.end().await);
    }

    /// Waits for a restart; `Some` if the instance must be forgotten.
    async fn lie(&mut self, wait: Option<Duration>) -> Option<Option<oneshot::Sender<()>>> {
        let last = self.output.last(LINES_SHOWN);
        self.shown.last_output = last.into_iter().map(|line| line.text).collect();
        let again_at = wait.map(|wait| Moment::now() + wait);
        self.shown.hint = self.remark(wait);
        if wait.is_none() {
            self.shared.roster.lay_down(self.shown.id);
        }
        loop {
            self.show(SitlStage::Ended);
            let now = Moment::now();
            if again_at.is_some_and(|at| at <= now) {
                return None;
            }
            let until = now + LOOK_EVERY;
            match self.event(again_at.map_or(until, |at| at.min(until))).await {
                InstanceEvent::Over(done) => return Some(done),
                InstanceEvent::Restart => {
                    self.restarts.forgive();
                    return None;
                }
                InstanceEvent::Passed(_) | InstanceEvent::Connected(_) | InstanceEvent::Nothing => {
                }
            }
        }
    }

    /// What happens after the end of the process, and the file with its stack if it has left one.
    fn remark(&self, wait: Option<Duration>) -> Option<String> {
        let next = match wait {
            Some(wait) => Some(format!("is started again in {} s", wait.as_secs())),
            None if self.restarts.is_given_up() => {
                Some("has failed five times in a row and is not started again".to_owned())
            }
            None => None,
        };
        let stacks = stacks(&self.order.folder);
        remark(next, stacks.difference(&self.earlier_stacks).next())
    }

    fn diagnosis(&self, lack: String, meter: &InstanceMeter) -> String {
        let mut told = lack + &meter.told();
        if let Some(line) = self.output.last(1).pop() {
            told.push_str("; its last output: ");
            told.push_str(&line.text);
        }
        told
    }

    fn show(&mut self, stage: SitlStage) {
        self.shown.stage = stage;
        self.shown.attached = self.relay.is_attached();
        self.shared.roster.show(&self.shown);
    }
}
