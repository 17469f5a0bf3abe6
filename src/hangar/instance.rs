//! One instance's task: its process, its connection, its stages and its end.

use std::collections::VecDeque;
use std::io;
use std::path::PathBuf;
use std::process::ExitStatus;
use std::sync::Arc;
use std::time::Duration;

use tokio::io::{AsyncBufReadExt as _, AsyncRead, BufReader};
use tokio::net::TcpListener;
use tokio::process::Child;
use tokio::sync::{mpsc, oneshot};
use tokio::time::{Instant as Moment, interval};

use super::probe::Probe;
use super::relay::{Read, Relay};
use super::{Instance, InstanceId, Refusal, Request, Shared, Stage, launcher};
use crate::sitl::{Door, Recipe};

/// How often an instance that boots is asked how far it is.
const PROBE_EVERY: Duration = Duration::from_millis(50);
/// Simulated seconds per second until an instance is ready: a real boot takes 42 s.
const BOOT_SPEEDUP: f64 = 10.0;
/// Lines of output that are kept for telling why an instance has ended.
const LINES_KEPT: usize = 50;

/// Starts an instance and its task.
///
/// # Errors
/// Its folder or its listener cannot be made.
pub(super) async fn begin(
    id: InstanceId,
    recipe: Recipe,
    program: PathBuf,
    requests: mpsc::Receiver<Request>,
    shared: Arc<Shared>,
) -> Result<(), Refusal> {
    let folder = shared.config.folder.join(format!("vehicle-{id:03}"));
    let refuse = |what: String| move |source: io::Error| Refusal::Host { id, what, source };
    std::fs::create_dir_all(&folder).map_err(refuse(format!("make {}", folder.display())))?;
    let listener = TcpListener::bind(("127.0.0.1", 0))
        .await
        .map_err(refuse("listen on 127.0.0.1".to_owned()))?;
    let boot = Recipe {
        speedup: recipe.speedup.max(BOOT_SPEEDUP),
        ..recipe.clone()
    };
    let address = listener
        .local_addr()
        .map_err(refuse("listen on 127.0.0.1".to_owned()))?;
    let command = boot.command_line(Door::Outwards(address));
    for (name, text) in &command.files {
        let path = folder.join(name);
        std::fs::write(&path, text).map_err(refuse(format!("write {}", path.display())))?;
    }
    let shown = Instance {
        id,
        kind: recipe.kind,
        system: recipe.system,
        stage: Stage::Queued,
        parameters: [0, 0],
        pid: None,
        restarts: 0,
        attached: false,
        memory_bytes: 0,
        cpu_ms: 0,
        fault: None,
        last_output: Vec::new(),
        folder: folder.display().to_string(),
        port: None,
    };
    shared.show(&shown);
    let order = Order {
        program,
        arguments: command.arguments,
        folder,
    };
    let task = Task {
        shown,
        order,
        speedup: recipe.speedup,
        listener,
        relay: Relay::default(),
        shared,
    };
    tokio::spawn(task.run(requests));
    Ok(())
}

struct Order {
    program: PathBuf,
    arguments: Vec<String>,
    folder: PathBuf,
}

struct Task {
    shown: Instance,
    order: Order,
    speedup: f64,
    listener: TcpListener,
    relay: Relay,
    shared: Arc<Shared>,
}

/// Why a process is no more.
enum End {
    /// It has ended by itself.
    Fault(String),
    /// It was ended for good.
    Stopped(Option<oneshot::Sender<()>>),
    /// It was ended to be started again.
    Restart,
}

impl Task {
    async fn run(mut self, mut requests: mpsc::Receiver<Request>) {
        let done = loop {
            let end = match self.start().await {
                Ok(child) => self.live(child, &mut requests).await,
                Err(error) => End::Fault(format!(
                    "cannot start {}: {error}",
                    self.order.program.display()
                )),
            };
            self.relay.disconnect();
            self.shown.pid = None;
            match end {
                End::Stopped(done) => break done,
                End::Restart => self.shown.restarts += 1,
                End::Fault(reason) => {
                    self.shown.fault = Some(reason);
                    self.set_stage(Stage::Ended);
                    match self.lie(&mut requests).await {
                        Some(done) => break done,
                        None => self.shown.restarts += 1,
                    }
                }
            }
        };
        self.shared.forget(self.shown.id);
        if let Some(done) = done {
            // Whoever asked may have left.
            let _ = done.send(());
        }
    }

    async fn start(&mut self) -> io::Result<Child> {
        self.shown.fault = None;
        self.shown.last_output.clear();
        self.set_stage(Stage::Queued);
        let order = launcher::Order {
            program: self.order.program.clone(),
            arguments: self.order.arguments.clone(),
            folder: self.order.folder.clone(),
        };
        let child = self.shared.launcher.launch(order).await?;
        self.shown.pid = child.id();
        self.set_stage(Stage::Process);
        Ok(child)
    }

    /// Waits for what becomes of a process that runs.
    async fn live(&mut self, mut child: Child, requests: &mut mpsc::Receiver<Request>) -> End {
        let begun = Moment::now();
        let mut probe = Probe::new(self.shown.system, self.speedup, begun.elapsed());
        let mut lines = Lines::of(&mut child);
        let mut ticks = interval(PROBE_EVERY);
        loop {
            tokio::select! {
                () = self.shared.cancel.cancelled() => {
                    end(&mut child).await;
                    return End::Stopped(None);
                }
                request = requests.recv() => match request {
                    Some(Request::Attach(answer)) => drop(answer.send(self.relay.attach())),
                    Some(Request::Restart) => {
                        end(&mut child).await;
                        return End::Restart;
                    }
                    Some(Request::Stop(done)) => {
                        self.set_stage(Stage::Stopping);
                        end(&mut child).await;
                        return End::Stopped(Some(done));
                    }
                    None => return End::Stopped(None),
                },
                status = child.wait() => {
                    self.shown.last_output = lines.last();
                    return End::Fault(reason(status));
                }
                Ok((stream, _)) = self.listener.accept() => {
                    self.relay.connect(stream);
                    probe = Probe::new(self.shown.system, self.speedup, begun.elapsed());
                }
                read = self.relay.read() => if let Ok(Read::Instance(bytes)) = read {
                    probe.hear(&bytes, begun.elapsed());
                },
                _ = ticks.tick() => {}
                () = lines.read() => {}
            }
            if probe.stage() < Stage::Ready {
                let bytes = probe.say(begun.elapsed());
                self.relay.send(&bytes);
            }
            self.shown.parameters = probe.parameters();
            self.shown.attached = self.relay.is_attached();
            self.set_stage(probe.stage());
        }
    }

    /// Waits for somebody to start or to stop it; `None` if it is to be started.
    async fn lie(
        &mut self,
        requests: &mut mpsc::Receiver<Request>,
    ) -> Option<Option<oneshot::Sender<()>>> {
        loop {
            tokio::select! {
                () = self.shared.cancel.cancelled() => return Some(None),
                request = requests.recv() => match request {
                    Some(Request::Attach(answer)) => drop(answer.send(self.relay.attach())),
                    Some(Request::Restart) => return None,
                    Some(Request::Stop(done)) => return Some(Some(done)),
                    None => return Some(None),
                },
            }
        }
    }

    fn set_stage(&mut self, stage: Stage) {
        self.shown.stage = stage;
        self.shared.show(&self.shown);
    }
}

/// Ends a process and waits until it is gone.
async fn end(child: &mut Child) {
    // Failing means that it has ended.
    drop(child.kill().await);
}

fn reason(status: io::Result<ExitStatus>) -> String {
    match status {
        Ok(status) => format!("it has ended ({status})"),
        Err(error) => format!("it cannot be watched: {error}"),
    }
}

type Reader = tokio::io::Lines<BufReader<Box<dyn AsyncRead + Send + Unpin>>>;

/// What a process prints.
struct Lines {
    readers: Vec<Reader>,
    last: VecDeque<String>,
}

impl Lines {
    fn of(child: &mut Child) -> Self {
        let mut readers = Vec::new();
        let mut add =
            |pipe: Box<dyn AsyncRead + Send + Unpin>| readers.push(BufReader::new(pipe).lines());
        if let Some(out) = child.stdout.take() {
            add(Box::new(out));
        }
        if let Some(err) = child.stderr.take() {
            add(Box::new(err));
        }
        Self {
            readers,
            last: VecDeque::new(),
        }
    }

    fn last(&mut self) -> Vec<String> {
        self.last.iter().cloned().collect()
    }

    async fn read(&mut self) {
        let Some(reader) = self.readers.first_mut() else {
            return std::future::pending().await;
        };
        match reader.next_line().await {
            Ok(Some(line)) => {
                if self.last.len() == LINES_KEPT {
                    self.last.pop_front();
                }
                self.last.push_back(line);
            }
            _ => drop(self.readers.remove(0)),
        }
    }
}
