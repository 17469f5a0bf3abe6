//! A connection to the console's socket for programs.

use std::io::{BufRead as _, BufReader, Write as _};
use std::os::unix::net::UnixStream;
use std::path::Path;

use serde::Deserialize;
use serde_json::Value;

use super::Failure;
use crate::api::Request;

/// A line of the console: its kind, and its content.
pub(super) struct ConsoleLine {
    pub kind: String,
    pub content: Value,
    /// The line as it was sent.
    pub text: String,
}

impl ConsoleLine {
    /// The content, deserialized into the type of its kind.
    ///
    /// # Errors
    /// The content does not fit the type, for example because the console has another version of
    /// the interface.
    pub fn read<'a, T: Deserialize<'a>>(&'a self) -> Result<T, Failure> {
        T::deserialize(&self.content).map_err(|error| {
            Failure::Failed(anyhow::anyhow!("cannot read `{}`: {error}", self.text))
        })
    }
}

impl ConsoleLine {
    /// The text of a `fault`, as a failure.
    pub fn fault(&self) -> Failure {
        let text = self.content["message"].as_str().unwrap_or(&self.text);
        Failure::Failed(anyhow::anyhow!("{text}"))
    }
}

/// The receiving half of a connection to a console.
pub(super) struct ApiReader(BufReader<UnixStream>);

pub(super) struct ApiConnection {
    reader: ApiReader,
    write: UnixStream,
    sent: u64,
}

impl ApiConnection {
    /// Connects to a console.
    ///
    /// # Errors
    /// No console listens on the socket.
    pub fn open(socket: &Path) -> Result<Self, Failure> {
        let opened = UnixStream::connect(socket).and_then(|write| Ok((write.try_clone()?, write)));
        let (read, write) = opened.map_err(|error| {
            let path = socket.display();
            Failure::Failed(anyhow::anyhow!(
                "cannot connect to {path}: {error}; start a console with --api {path}"
            ))
        })?;
        Ok(Self {
            reader: ApiReader(BufReader::new(read)),
            write,
            sent: 0,
        })
    }

    /// Sends a request, and returns its number.
    ///
    /// # Errors
    /// The console has closed the connection.
    pub fn send(&mut self, request: &Request) -> Result<u64, Failure> {
        self.sent += 1;
        let mut value = serde_json::to_value(request)?;
        value["id"] = self.sent.into();
        writeln!(self.write, "{value}")?;
        Ok(self.sent)
    }

    /// The next line; `None` once the console has closed the connection.
    ///
    /// # Errors
    /// The line is not a message of a console.
    pub fn next(&mut self) -> Result<Option<ConsoleLine>, Failure> {
        self.reader.next()
    }

    /// Splits the connection into its receiving and its sending half, to be used at the same time.
    pub fn split(self) -> (ApiReader, UnixStream) {
        (self.reader, self.write)
    }
}

impl ApiReader {
    /// The next line; `None` once the console has closed the connection.
    ///
    /// # Errors
    /// The line is not a message of a console.
    pub fn next(&mut self) -> Result<Option<ConsoleLine>, Failure> {
        let mut text = String::new();
        if self.0.read_line(&mut text)? == 0 {
            return Ok(None);
        }
        let text = text.trim_end().to_owned();
        let value: Value = serde_json::from_str(&text)?;
        let Value::Object(fields) = value else {
            return Err(Failure::Failed(anyhow::anyhow!("not a message: {text}")));
        };
        let Some((kind, content)) = fields.into_iter().next() else {
            return Err(Failure::Failed(anyhow::anyhow!("an empty message")));
        };
        Ok(Some(ConsoleLine {
            kind,
            content,
            text,
        }))
    }
}
