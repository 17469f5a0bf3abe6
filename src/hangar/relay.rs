//! Carries bytes between an instance and whoever is attached to it.

use std::io;

use futures_util::FutureExt as _;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _, DuplexStream};
use tokio::net::TcpStream;

/// How much waits for one who is attached and does not read; beyond that bytes are lost, as on a radio.
const PIPE_LEN: usize = 64 * 1024;
const READ_LEN: usize = 4096;

/// What the relay has read.
pub(super) enum Read {
    /// Bytes of the instance.
    Instance(Vec<u8>),
    /// The instance has closed its connection.
    InstanceGone,
    /// Bytes of the one who is attached; they have been passed on.
    Attached,
    /// Nobody is attached any more.
    AttachedGone,
}

/// The two ends, each of which may be missing.
#[derive(Default)]
pub(super) struct Relay {
    instance: Option<TcpStream>,
    attached: Option<DuplexStream>,
}

impl Relay {
    pub fn is_attached(&self) -> bool {
        self.attached.is_some()
    }

    /// A new other end for whoever wants to be attached; `None` if somebody is.
    pub fn attach(&mut self) -> Option<DuplexStream> {
        if self.is_attached() {
            return None;
        }
        let (ours, theirs) = tokio::io::duplex(PIPE_LEN);
        self.attached = Some(ours);
        Some(theirs)
    }

    /// The instance has connected.
    pub fn connect(&mut self, stream: TcpStream) {
        // Commands are small and must not wait for one another; failing that they only come later.
        let _ = stream.set_nodelay(true);
        self.instance = Some(stream);
    }

    /// Forgets the instance's connection.
    pub fn disconnect(&mut self) {
        self.instance = None;
    }

    /// Sends bytes to the instance, if it is there and takes them.
    pub fn send(&mut self, bytes: &[u8]) {
        if let Some(instance) = &self.instance {
            let _ = instance.try_write(bytes);
        }
    }

    /// Waits for bytes from either end, and passes them on. Losing the future loses no bytes.
    pub async fn read(&mut self) -> io::Result<Read> {
        let (mut from_instance, mut from_attached) = ([0; READ_LEN], [0; READ_LEN]);
        let instance = async {
            match &mut self.instance {
                Some(instance) => instance.read(&mut from_instance).await,
                None => std::future::pending().await,
            }
        };
        let attached = async {
            match &mut self.attached {
                Some(attached) => attached.read(&mut from_attached).await,
                None => std::future::pending().await,
            }
        };
        let (len, is_instance) = tokio::select! {
            len = instance => (len.unwrap_or(0), true),
            len = attached => (len.unwrap_or(0), false),
        };
        Ok(match (len, is_instance) {
            (0, true) => {
                self.instance = None;
                Read::InstanceGone
            }
            (0, false) => {
                self.attached = None;
                Read::AttachedGone
            }
            (len, true) => {
                let bytes = &from_instance[..len];
                if let Some(attached) = &mut self.attached {
                    let _ = attached.write(bytes).now_or_never();
                }
                Read::Instance(bytes.to_vec())
            }
            (len, false) => {
                self.send(&from_attached[..len]);
                Read::Attached
            }
        })
    }
}
