//! The socket of the interface for programs.
//!
//! Each connection has a task that reads requests and one that writes answers. A request takes a
//! place in the queue of answers before it is passed to the console, so that a program that does
//! not read its answers cannot send more requests, and news is held back while a program is behind.
//! Neither the console nor another program is delayed.

use std::collections::{BTreeMap, VecDeque};
use std::path::{Path, PathBuf};
use std::time::Duration;

use tokio::io::{AsyncWriteExt as _, BufReader};
use tokio::sync::mpsc;
use tokio::sync::mpsc::error::TrySendError;
use tokio_util::sync::CancellationToken;

use super::Console;
use crate::api::{
    Accepted, Call, Client, Fault, INTERFACE, LONGEST_LINE, Message, RecordView, Request, Welcome,
    present,
};
use crate::app::State;
use crate::app::effect::{ProgramAnswer, ProgramFault};
use crate::app::event::{Event, ProgramLine};
use crate::carrier::lines::{ReadLine, read_line};
use crate::notice::Notice;
use crate::store::{RecordFiles, Records};
use crate::text;
use crate::text::{Locale, Text};
use crate::vehicle::Severity;

mod socket;

#[cfg(test)]
mod tests;

/// The maximum number of programs at once; further ones are turned away.
const MOST_PROGRAMS: usize = 64;
/// The length of a program's queue of answers.
const OUTBOX: usize = 256;
/// News is held back while a program's queue has less room than this.
const ROOM_FOR_NEWS: usize = OUTBOX / 2;
/// How long the console waits, when it ends, for programs to read their last news.
const LAST_PATIENCE: Duration = Duration::from_millis(500);
/// The maximum number of requests, from all programs together, that wait for the console.
const CALLS_KEPT: usize = 64;

/// The options of the socket.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ApiOptions {
    pub socket: PathBuf,
    /// Whether programs may give commands.
    pub commands: bool,
}

/// The programs that use the console.
pub(super) struct Programs {
    arrivals: Option<mpsc::Receiver<Arrival>>,
    connected: BTreeMap<ProgramId, Program>,
    commands: bool,
    socket: PathBuf,
    ending: CancellationToken,
    writers: mpsc::Receiver<()>,
    listener: Option<socket::Listener>,
}

/// The state shared by the connections.
#[derive(Clone)]
struct Exchange {
    arrived: mpsc::Sender<Arrival>,
    /// Ends the connections once their queues are empty.
    ending: CancellationToken,
    /// A copy is held by each connection until it has written everything.
    writing: mpsc::Sender<()>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct ProgramId(u64);

/// An event of a connection.
pub(super) enum Arrival {
    Opened(ProgramId, mpsc::Sender<String>),
    Line {
        from: ProgramId,
        line: Result<String, LineFault>,
        /// The reserved place for the answer in the queue.
        reply: mpsc::OwnedPermit<String>,
    },
    Closed(ProgramId),
    /// A program for which there is no place; it is sent the reason.
    Crowded(mpsc::Sender<String>),
}

/// Why a line cannot be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LineFault {
    TooLong,
    NotUtf8,
}

impl LineFault {
    fn text(self) -> Text {
        match self {
            Self::TooLong => text!("api-too-long", most = LONGEST_LINE),
            Self::NotUtf8 => text!("api-not-utf8"),
        }
    }
}

struct Program {
    client: Client,
    outbox: mpsc::Sender<String>,
    /// News for which the queue had no room. It is the remainder of one batch: further news waits
    /// until it has been sent.
    held: VecDeque<String>,
    /// Whether the user has been notified that the program gives commands.
    is_noticed: bool,
}

impl Program {
    /// Sends the news in order, as far as the queue has room, and holds the remaining news.
    fn send(&mut self, news: &[Message]) {
        self.held.extend(news.iter().map(Message::line));
        while let Some(line) = self.held.pop_front() {
            if let Err(TrySendError::Full(line)) = self.outbox.try_send(line) {
                self.held.push_front(line);
                return;
            }
        }
    }

    /// Ends the connection once everything has been sent, or after [`LAST_PATIENCE`].
    fn end(self) {
        tokio::spawn(tokio::time::timeout(LAST_PATIENCE, async move {
            for line in self.held {
                if self.outbox.send(line).await.is_err() {
                    return;
                }
            }
        }));
    }
}

impl Programs {
    /// Opens the socket, if one is wanted.
    ///
    /// # Errors
    /// The socket cannot be opened, or another program answers on it.
    pub fn open(options: Option<&ApiOptions>) -> anyhow::Result<Self> {
        let (writing, writers) = mpsc::channel(1);
        let ending = CancellationToken::new();
        let mut programs = Self {
            writers,
            ending: ending.clone(),
            arrivals: None,
            connected: BTreeMap::new(),
            commands: false,
            socket: PathBuf::new(),
            listener: None,
        };
        if let Some(options) = options {
            let (arrived, arrivals) = mpsc::channel(CALLS_KEPT);
            let exchange = Exchange {
                arrived,
                ending,
                writing,
            };
            programs.listener = Some(socket::Listener::open(&options.socket, exchange)?);
            programs.arrivals = Some(arrivals);
            programs.commands = options.commands;
            programs.socket.clone_from(&options.socket);
        }
        Ok(programs)
    }

    /// Waits for the next arrival; without a socket, it waits forever.
    pub async fn next(&mut self) -> Arrival {
        if let Some(arrivals) = &mut self.arrivals
            && let Some(arrival) = arrivals.recv().await
        {
            return arrival;
        }
        std::future::pending().await
    }

    /// Sends every program its news.
    pub fn tell(&mut self, state: &State) {
        for program in self.connected.values_mut() {
            program.send(&[]);
            if program.held.is_empty() && program.outbox.capacity() >= ROOM_FOR_NEWS {
                let news = program.client.news(state, state.wall());
                program.send(&news);
            }
        }
    }

    /// Sends every program its last news and closes the socket.
    pub async fn close(mut self, state: &State) {
        for (_, mut program) in std::mem::take(&mut self.connected) {
            let news = program.client.last_news(state, state.wall());
            program.send(&news);
            program.end();
        }
        self.listener = None;
        self.arrivals = None;
        self.ending.cancel();
        // The console does not wait for a program that does not read.
        drop(tokio::time::timeout(LAST_PATIENCE, self.writers.recv()).await);
    }

    fn opened(&mut self, id: ProgramId, outbox: mpsc::Sender<String>) {
        let welcome = Message::Welcome(Welcome {
            sortie: env!("SORTIE_VERSION").to_owned(),
            interface: INTERFACE,
            commands: self.commands,
        });
        drop(outbox.try_send(welcome.line()));
        let program = Program {
            client: Client::default(),
            outbox,
            held: VecDeque::new(),
            is_noticed: false,
        };
        self.connected.insert(id, program);
    }
}

impl Console {
    /// Registers or drops a connection, or answers a request.
    pub(super) async fn serve(&mut self, programs: &mut Programs, arrival: Arrival) {
        match arrival {
            Arrival::Opened(id, outbox) => programs.opened(id, outbox),
            Arrival::Closed(id) => drop(programs.connected.remove(&id)),
            Arrival::Crowded(outbox) => {
                let reason = text!("api-crowded", most = MOST_PROGRAMS);
                let fault = Fault::new(None, self.app.state().locale().text(&reason));
                drop(outbox.try_send(Message::Fault(fault).line()));
            }
            Arrival::Line { from, line, reply } => {
                let locale = self.app.state().locale().clone();
                let call = line
                    .map_err(|fault| Fault::new(None, locale.text(&fault.text())))
                    .and_then(|line| Call::read(&line, &locale));
                let answer = match call {
                    Ok(call) => self.answer(programs, from, call).await,
                    Err(fault) => Err(fault),
                };
                reply.send(answer.unwrap_or_else(Message::Fault).line());
            }
        }
    }

    async fn answer(
        &mut self,
        programs: &mut Programs,
        from: ProgramId,
        Call { id, request }: Call,
    ) -> Result<Message, Fault> {
        let accepted = |entry, text| Message::Accepted(Accepted { id, entry, text });
        match request {
            Request::Get { what, vehicle } => {
                present(self.app.state(), id, what, vehicle, || self.record_views())
            }
            Request::Watch { what, every_s } => {
                if let Some(program) = programs.connected.get_mut(&from) {
                    program.client.watch(what, every_s, self.app.state());
                }
                Ok(accepted(None, None))
            }
            Request::Say { .. } if !programs.commands => {
                let locale = self.app.state().locale();
                Err(Fault::new(id, locale.text(&text!("api-read-only"))))
            }
            Request::Say { line, confirm } => {
                let said = ProgramLine {
                    line,
                    confirmed: confirm,
                };
                self.feed(Event::Program(said)).await;
                match self.program_answer.take() {
                    Some(Err(fault)) => Err(refused(id, &fault, self.app.state().locale())),
                    Some(Ok(ProgramAnswer { entry, text })) => {
                        self.note_commands(programs, from);
                        if let (Some(entry), Some(program)) =
                            (entry, programs.connected.get_mut(&from))
                        {
                            program.client.follow(entry);
                        }
                        let text = text.map(|text| self.app.state().locale().text(&text));
                        Ok(accepted(entry.map(|entry| entry.0), text))
                    }
                    None => Ok(accepted(None, None)),
                }
            }
        }
    }

    /// The recorded flights, newest first.
    fn record_views(&self) -> Vec<RecordView> {
        let records = self.options.preferences.records.as_ref();
        let files = records.map(Records::list).unwrap_or_default();
        let path = |path: &PathBuf| path.display().to_string();
        let view = |files: RecordFiles| RecordView {
            frames: files.frames.as_ref().map(path),
            run: files.run.as_ref().map(path),
            bytes: files.bytes,
            name: files.stem,
        };
        files.into_iter().rev().map(view).collect()
    }

    /// Notifies the user once that a program gives commands.
    fn note_commands(&mut self, programs: &mut Programs, from: ProgramId) {
        let Some(program) = programs.connected.get_mut(&from) else {
            return;
        };
        if !std::mem::replace(&mut program.is_noticed, true) {
            let socket = programs.socket.display().to_string();
            let text = text!("api-commands", socket = socket);
            self.post(Notice::general(self.clock.now(), Severity::Notice, text));
        }
    }
}

fn refused(id: Option<u64>, refusal: &ProgramFault, locale: &Locale) -> Fault {
    let ProgramFault { fault, asks } = refusal;
    Fault {
        help: fault.help.as_ref().map(|help| locale.text(help)),
        span: Some([fault.span.start, fault.span.end]),
        asks: *asks,
        ..Fault::new(id, locale.text(&fault.message))
    }
}

/// Serves one connection until it ends.
async fn converse(
    id: ProgramId,
    read: impl tokio::io::AsyncRead + Unpin,
    write: impl tokio::io::AsyncWrite + Unpin + Send + 'static,
    exchange: Exchange,
) {
    let Exchange {
        arrived,
        ending,
        writing,
    } = exchange;
    let (outbox, lines) = mpsc::channel(OUTBOX);
    let cancel = CancellationToken::new();
    if arrived
        .send(Arrival::Opened(id, outbox.clone()))
        .await
        .is_err()
    {
        return;
    }
    let written = cancel.clone();
    tokio::spawn(async move {
        pass_out(lines, write, written).await;
        drop(writing);
    });
    let requests = pass_in(id, read, &outbox, &arrived);
    tokio::select! {
        () = requests => {}
        () = cancel.cancelled() => {}
        () = ending.cancelled() => return,
    }
    drop(arrived.send(Arrival::Closed(id)).await);
}

/// Writes lines until the queue or the connection ends.
async fn pass_out(
    mut lines: mpsc::Receiver<String>,
    mut write: impl tokio::io::AsyncWrite + Unpin,
    ended: CancellationToken,
) {
    while let Some(mut line) = lines.recv().await {
        line.push('\n');
        if write.write_all(line.as_bytes()).await.is_err() {
            break;
        }
    }
    ended.cancel();
}

/// Passes the lines of a program to the console until the connection ends, or a line is too long.
async fn pass_in(
    id: ProgramId,
    read: impl tokio::io::AsyncRead + Unpin,
    outbox: &mpsc::Sender<String>,
    arrived: &mpsc::Sender<Arrival>,
) {
    let mut read = BufReader::new(read);
    loop {
        let line = match read_line(&mut read, LONGEST_LINE).await {
            None => return,
            Some(ReadLine::TooLong) => Err(LineFault::TooLong),
            Some(ReadLine::Line(bytes)) => String::from_utf8(bytes).map_err(|_| LineFault::NotUtf8),
        };
        let is_too_long = line == Err(LineFault::TooLong);
        if line.as_ref().is_ok_and(|line| line.trim().is_empty()) {
            continue;
        }
        let Ok(reply) = outbox.clone().reserve_owned().await else {
            return;
        };
        let line = Arrival::Line {
            from: id,
            line,
            reply,
        };
        if arrived.send(line).await.is_err() || is_too_long {
            return;
        }
    }
}

fn shown(path: &Path) -> String {
    path.display().to_string()
}
