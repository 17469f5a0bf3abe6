//! Carries bytes between an instance and the attached program. Neither side ever waits for the
//! other: bytes that one side does not read are dropped in whole pieces, as on a radio link.

use std::future::poll_fn;
use std::pin::Pin;
use std::task::{Context, Poll, ready};

use tokio::io::{AsyncRead, AsyncWrite, DuplexStream, ReadBuf};
use tokio::net::TcpStream;

/// Bytes kept for an attached client that does not read.
const PIPE_LEN: usize = 64 * 1024;
/// Bytes kept for an instance that does not read.
const BACKLOG_LEN: usize = 64 * 1024;
/// The maximum number of bytes per read. It is the capacity of a pipe, so a whole write is read at
/// once, and the hangar's own frames do not split another frame.
const READ_LEN: usize = PIPE_LEN;

/// The result of a step of the relay.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Passed {
    /// The instance has sent bytes, which are in [`Relay::said`].
    Instance,
    /// The instance has closed its connection.
    InstanceGone,
    /// The attached program has sent bytes.
    Attached,
    /// The program is no longer attached.
    AttachedGone,
}

/// An end, and the bytes waiting to be written to it.
struct RelayEnd<S> {
    stream: S,
    waiting: Vec<u8>,
    room: usize,
}

impl<S: AsyncRead + AsyncWrite + Unpin> RelayEnd<S> {
    fn new(stream: S, room: usize) -> Self {
        Self {
            stream,
            waiting: Vec::new(),
            room,
        }
    }

    /// Queues bytes: all of them, or none if too many wait.
    fn put(&mut self, bytes: &[u8]) {
        if self.waiting.len() + bytes.len() <= self.room.max(bytes.len()) {
            self.waiting.extend_from_slice(bytes);
        }
    }

    /// Writes as much as is accepted; an error means that the end is gone.
    fn poll_flush(&mut self, context: &mut Context<'_>) -> Result<(), ()> {
        while !self.waiting.is_empty() {
            match Pin::new(&mut self.stream).poll_write(context, &self.waiting) {
                Poll::Ready(Ok(len)) if len > 0 => drop(self.waiting.drain(..len)),
                Poll::Ready(_) => return Err(()),
                Poll::Pending => return Ok(()),
            }
        }
        Ok(())
    }

    /// Reads into `space`; `None` at the end of the stream, and after an error.
    fn poll_read<'a>(
        &mut self,
        context: &mut Context<'_>,
        space: &'a mut [u8],
    ) -> Poll<Option<&'a [u8]>> {
        let mut buffer = ReadBuf::new(space);
        let read = ready!(Pin::new(&mut self.stream).poll_read(context, &mut buffer));
        let len = read.map_or(0, |()| buffer.filled().len());
        Poll::Ready((len > 0).then(|| &space[..len]))
    }
}

/// The two ends, each of which may be missing.
pub(super) struct Relay {
    instance: Option<RelayEnd<TcpStream>>,
    attached: Option<RelayEnd<DuplexStream>>,
    space: Vec<u8>,
    said: usize,
}

impl Default for Relay {
    fn default() -> Self {
        Self {
            instance: None,
            attached: None,
            space: vec![0; READ_LEN],
            said: 0,
        }
    }
}

impl Relay {
    pub fn is_attached(&self) -> bool {
        self.attached.is_some()
    }

    /// Whether the instance has connected.
    pub fn is_connected(&self) -> bool {
        self.instance.is_some()
    }

    /// A new pipe for a program to attach; `None` if a program is attached.
    pub fn attach(&mut self) -> Option<DuplexStream> {
        if self.is_attached() {
            return None;
        }
        let (ours, theirs) = tokio::io::duplex(PIPE_LEN);
        // Only pieces that did not fit into the pipe wait.
        self.attached = Some(RelayEnd::new(ours, 0));
        Some(theirs)
    }

    /// Sets the instance's connection.
    pub fn connect(&mut self, stream: TcpStream) {
        // Commands are small and must not wait for one another; without this option they are only slower.
        let _ = stream.set_nodelay(true);
        self.instance = Some(RelayEnd::new(stream, BACKLOG_LEN));
    }

    /// Drops the instance's connection.
    pub fn disconnect(&mut self) {
        self.instance = None;
    }

    /// Sends bytes to the instance, if it is connected and reads.
    pub fn send(&mut self, bytes: &[u8]) {
        if let Some(instance) = &mut self.instance {
            instance.put(bytes);
        }
    }

    /// The latest bytes from the instance.
    pub fn said(&self) -> &[u8] {
        self.space.get(..self.said).unwrap_or_default()
    }

    /// Writes waiting bytes, and passes on the next ones from either end. Dropping the future loses no bytes.
    pub async fn pass(&mut self) -> Passed {
        poll_fn(|context| self.poll_pass(context)).await
    }

    fn poll_pass(&mut self, context: &mut Context<'_>) -> Poll<Passed> {
        let Self {
            instance,
            attached,
            space,
            said,
        } = self;
        if let Some(there) = instance
            && let Poll::Ready(bytes) = there.poll_read(context, space)
        {
            let Some(bytes) = bytes else {
                *instance = None;
                return Poll::Ready(Passed::InstanceGone);
            };
            *said = bytes.len();
            if let Some(attached) = attached {
                attached.put(bytes);
                // Reading, not writing, shows whether the program is still attached.
                let _ = attached.poll_flush(context);
            }
            return Poll::Ready(Passed::Instance);
        }
        if let Some(there) = attached
            && let Poll::Ready(bytes) = there.poll_read(context, space)
        {
            let Some(bytes) = bytes else {
                *attached = None;
                return Poll::Ready(Passed::AttachedGone);
            };
            if let Some(instance) = instance {
                instance.put(bytes);
                let _ = instance.poll_flush(context);
            }
            *said = 0;
            return Poll::Ready(Passed::Attached);
        }
        if let Some(instance) = instance {
            let _ = instance.poll_flush(context);
        }
        if let Some(attached) = attached {
            let _ = attached.poll_flush(context);
        }
        Poll::Pending
    }
}

#[cfg(test)]
mod tests;
