//! `sortie mcp`: tools for language models, by the Model Context Protocol over standard input and
//! output.
//!
//! The submodules do no input or output; this module contains the threads that read, and the
//! connection to the console. The connection is opened with the first call, and again with the
//! first call after it was lost, because clients start the bridge before the console.

use std::io::{self, BufRead, Read as _, Write as _};
use std::net::Shutdown;
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

use clap::Args;
use serde_json::Value;

use super::Failure;
use super::socket::{ApiConnection, ApiReader, ConsoleLine};
use crate::text::{Language, Locale, Text};
use bridge::{Bridge, BridgeMessage, MOST_CALLS};

mod bridge;
mod rpc;
mod tools;

#[cfg(test)]
mod tests;

/// The maximum length of a line from the client, in bytes; longer lines are cut off.
const LONGEST_CLIENT_LINE: u64 = 1 << 20;
/// The number of events that may wait for the bridge.
const WAITING_EVENTS: usize = 16;

/// Options of `sortie mcp`.
#[derive(Debug, Args)]
pub(super) struct McpArguments {
    /// The socket of the console, as given with --api or --api-read-only.
    #[arg(long, value_name = "SOCKET")]
    api: PathBuf,
    /// Offer a tool that gives commands; otherwise all tools are read-only. Needs a console with --api.
    #[arg(long)]
    allow_commands: bool,
}

enum McpEvent {
    Client(Vec<u8>),
    ClientEnded(io::Result<()>),
    Console(ConsoleLine),
    ConsoleEnded(String),
}

/// The bridge with its connections.
struct McpServer<'a> {
    bridge: Bridge,
    socket: &'a Path,
    events: SyncSender<McpEvent>,
    /// The queue of lines for the console, while it is connected.
    console: Option<SyncSender<String>>,
}

/// Serves the client until its input ends.
pub(super) fn serve(arguments: &McpArguments) -> Result<ExitCode, Failure> {
    let (events, inbox) = sync_channel(WAITING_EVENTS);
    let from_client = events.clone();
    thread::spawn(move || read_client(&from_client));
    let mut server = McpServer {
        bridge: Bridge::new(arguments.allow_commands),
        socket: &arguments.api,
        events,
        console: None,
    };
    for event in inbox {
        match event {
            McpEvent::Client(line) => match server.bridge.hear_client(&line) {
                None => {}
                Some(BridgeMessage::ToClient(message)) => send(&message)?,
                Some(BridgeMessage::ToConsole(request)) => server.ask(request)?,
            },
            McpEvent::ClientEnded(outcome) => {
                outcome?;
                break;
            }
            McpEvent::Console(line) => {
                let message = server.bridge.hear_console(&line.kind, line.content);
                send_all(message.as_slice())?;
            }
            McpEvent::ConsoleEnded(reason) => {
                server.console = None;
                send_all(&server.bridge.lose_console(&reason))?;
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}

impl McpServer<'_> {
    /// Sends a request to the console, connecting first if necessary; if no console can be reached,
    /// all open calls fail.
    fn ask(&mut self, request: String) -> io::Result<()> {
        if self.console.is_none() {
            match connect(self.socket, &self.events) {
                Ok(lines) => self.console = Some(lines),
                Err(reason) => return send_all(&self.bridge.lose_console(&reason)),
            }
        }
        if let Some(lines) = &self.console {
            // The queue has room for the requests of all open calls. If the connection has just been lost, the event of
            // its end follows.
            drop(lines.try_send(request));
        }
        Ok(())
    }
}

fn send_all(messages: &[Value]) -> io::Result<()> {
    messages.iter().try_for_each(send)
}

/// Writes a message as one line: unchanged, because a client compares numbers and tokens, and
/// without line ends, because serialized JSON contains none.
fn send(message: &Value) -> io::Result<()> {
    writeln!(io::stdout(), "{message}")
}

fn read_client(events: &SyncSender<McpEvent>) {
    let mut input = io::stdin().lock();
    let outcome = loop {
        match next_line(&mut input) {
            Ok(None) => break Ok(()),
            Ok(Some(line)) => {
                if events.send(McpEvent::Client(line)).is_err() {
                    return;
                }
            }
            Err(error) => break Err(error),
        }
    };
    drop(events.send(McpEvent::ClientEnded(outcome)));
}

/// The next line, cut off at the maximum length; `None` at the end of the input.
fn next_line(input: &mut impl BufRead) -> io::Result<Option<Vec<u8>>> {
    let mut line = Vec::new();
    let mut limited = input.by_ref().take(LONGEST_CLIENT_LINE);
    if limited.read_until(b'\n', &mut line)? == 0 {
        return Ok(None);
    }
    if limited.limit() == 0 && !line.ends_with(b"\n") {
        input.skip_until(b'\n')?;
    }
    Ok(Some(line))
}

/// Connects to the console, and returns the queue of lines for it.
fn connect(socket: &Path, events: &SyncSender<McpEvent>) -> Result<SyncSender<String>, String> {
    let connection = ApiConnection::open(socket).map_err(reason)?;
    let (reader, writer) = connection.split();
    // Writing has a thread of its own: a console that waits for its messages to be read would block the bridge.
    let (lines, queue) = sync_channel(MOST_CALLS);
    thread::spawn(move || write_console(&queue, writer));
    let from_console = events.clone();
    thread::spawn(move || read_console(reader, &from_console));
    Ok(lines)
}

fn write_console(lines: &Receiver<String>, mut writer: UnixStream) {
    for line in lines {
        if writeln!(writer, "{line}").is_err() {
            break;
        }
    }
    // Ends the reader, too; an error means that the connection is closed already.
    drop(writer.shutdown(Shutdown::Both));
}

fn read_console(mut reader: ApiReader, events: &SyncSender<McpEvent>) {
    let end = loop {
        match reader.next() {
            // No call has this fault: the console gives the reason why it closes the connection.
            Ok(Some(line)) if line.kind == "fault" && line.content["id"].is_null() => {
                break reason(line.fault());
            }
            Ok(Some(line)) => {
                if events.send(McpEvent::Console(line)).is_err() {
                    return;
                }
            }
            Ok(None) => break "the console has closed the connection".to_owned(),
            Err(failure) => break reason(failure),
        }
    };
    drop(events.send(McpEvent::ConsoleEnded(end)));
}

fn reason(failure: Failure) -> String {
    let english = Locale::new(Language::English);
    match failure {
        Failure::Failed(error) => format!("{error:#}"),
        Failure::Invalid(text) | Failure::Shown(text) => text,
        Failure::Wrong(texts) => english.text(&Text::joined("\n", texts)),
        Failure::Faulty(fault) => fault.explained(&english),
    }
}
