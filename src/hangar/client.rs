//! A remote hangar, through its HTTP service.
//!
//! - `address` is its address; `call` sends one request; `follow` receives its events; `pump` carries a vehicle's
//!   bytes and reconnects.

use std::fmt;
use std::io;
use std::time::Duration;

use hyper::{Method, StatusCode};
use serde::de::DeserializeOwned;
use tokio::io::DuplexStream;
use tokio::sync::watch;
use tokio_util::sync::CancellationToken;

use super::service::{Printed, ServiceProblem, Status};
use super::{HangarToken, Instance, InstanceId, Launch, OutputLine};
use crate::text;
use crate::text::Text;

mod address;
mod call;
mod follow;
mod pump;

pub use address::{HangarAddress, HangarAddressError};
pub use follow::HangarView;

/// The maximum time to reach a hangar, and to wait for a simple answer.
const ANSWER: Duration = Duration::from_secs(10);
/// The size of the buffer for a slow reader of a vehicle's bytes, in bytes.
const PIPE_LEN: usize = 64 * 1024;

/// Why a request to a remote hangar failed.
#[derive(Debug, thiserror::Error)]
pub enum ClientError {
    #[error(
        "{address} cannot be reached ({source}): is `sortie hangar` running there? From another host: `ssh -L PORT:127.0.0.1:PORT HOST`"
    )]
    Unreachable {
        address: HangarAddress,
        source: io::Error,
    },
    /// The service does not answer in time.
    #[error("{address} has not answered within {seconds} s")]
    Late {
        address: HangarAddress,
        seconds: u64,
    },
    /// The answer is not that of a hangar.
    #[error("{address} answers, but it is not a sortie hangar ({why})")]
    NotAHangar { address: HangarAddress, why: String },
    /// The service requires a token, or a different one.
    #[error(
        "{address} requires a token ({why}): copy its token file to this machine and add `--hangar-token FILE`"
    )]
    Unauthorised { address: HangarAddress, why: String },
    #[error("{}", problem.error)]
    Refused {
        status: u16,
        problem: ServiceProblem,
    },
}

impl From<&ClientError> for Text {
    fn from(error: &ClientError) -> Self {
        match error {
            ClientError::Unreachable { address, source } => text!(
                "hangar-far-unreachable",
                address = address.to_string(),
                error = source.to_string()
            ),
            ClientError::Late { address, seconds } => text!(
                "hangar-far-late",
                address = address.to_string(),
                seconds = *seconds as i64
            ),
            ClientError::NotAHangar { address, why } => {
                text!(
                    "hangar-far-other",
                    address = address.to_string(),
                    error = why
                )
            }
            ClientError::Unauthorised { address, why } => {
                text!(
                    "hangar-far-token",
                    address = address.to_string(),
                    error = why
                )
            }
            ClientError::Refused { problem, .. } => Self::verbatim(problem.error.clone()),
        }
    }
}

/// A remote hangar. Cheap to clone; every request has its own connection.
#[derive(Debug, Clone)]
pub struct RemoteHangar {
    address: HangarAddress,
    token: Option<HangarToken>,
    /// The run of the service to which the requests are addressed; other runs refuse them.
    life: Option<String>,
}

impl fmt::Display for RemoteHangar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.address.fmt(f)
    }
}

impl RemoteHangar {
    /// A hangar at an address. A token is needed unless the hangar is on this host and runs as the
    /// same user.
    pub fn new(address: HangarAddress, token: Option<HangarToken>) -> Self {
        Self {
            address,
            token,
            life: None,
        }
    }

    /// The same hangar, restricted to one run of the service: after a restart, the numbers belong to other instances.
    #[must_use]
    pub fn in_life(&self, life: &str) -> Self {
        Self {
            life: Some(life.to_owned()),
            ..self.clone()
        }
    }

    pub fn address(&self) -> &HangarAddress {
        &self.address
    }

    /// The service's status.
    ///
    /// # Errors
    /// The hangar does not answer.
    pub async fn status(&self) -> Result<Status, ClientError> {
        self.ask(Method::GET, "/status", None).await
    }

    /// Starts an instance.
    ///
    /// # Errors
    /// The hangar refuses or does not answer.
    pub async fn launch(&self, launch: &Launch) -> Result<Instance, ClientError> {
        let body = serde_json::to_vec(launch).map_err(|error| ClientError::Refused {
            status: StatusCode::BAD_REQUEST.as_u16(),
            problem: ServiceProblem::new(StatusCode::BAD_REQUEST, error.to_string()),
        })?;
        self.ask(Method::POST, "/vehicles", Some(body)).await
    }

    /// The instances.
    ///
    /// # Errors
    /// The hangar does not answer.
    pub async fn instances(&self) -> Result<Vec<Instance>, ClientError> {
        self.ask(Method::GET, "/vehicles", None).await
    }

    /// Ends an instance.
    ///
    /// # Errors
    /// The hangar refuses or does not answer.
    pub async fn stop(&self, id: InstanceId) -> Result<(), ClientError> {
        let path = format!("/vehicles/{id}");
        self.exchange(Method::DELETE, &path, None).await.map(drop)
    }

    /// Ends an instance's process and starts it again.
    ///
    /// # Errors
    /// The hangar refuses or does not answer.
    pub async fn restart(&self, id: InstanceId) -> Result<(), ClientError> {
        let path = format!("/vehicles/{id}/restart");
        self.exchange(Method::POST, &path, None).await.map(drop)
    }

    /// An instance's output, starting with the line of this number if it is still stored.
    ///
    /// # Errors
    /// The hangar does not answer.
    pub async fn output(&self, id: InstanceId, since: u64) -> Result<Vec<OutputLine>, ClientError> {
        let path = format!("/vehicles/{id}/output?since={since}&lines={}", u16::MAX);
        let Printed { lines, .. } = self.ask(Method::GET, &path, None).await?;
        Ok(lines)
    }

    /// Follows the instances until cancelled; reconnects when the connection is lost.
    pub fn follow(&self, cancel: CancellationToken) -> watch::Receiver<HangarView> {
        let (sender, view) = watch::channel(HangarView::default());
        tokio::spawn(follow::run(self.clone(), sender, cancel));
        view
    }

    /// The bytes of an instance's serial 0, until cancelled or dropped. A lost connection is
    /// reopened at growing intervals; bytes in between are lost, as on a radio link.
    pub fn tunnel(&self, id: InstanceId, cancel: CancellationToken) -> DuplexStream {
        let (ours, theirs) = tokio::io::duplex(PIPE_LEN);
        tokio::spawn(pump::run(self.clone(), id, ours, cancel));
        theirs
    }

    async fn ask<T: DeserializeOwned>(
        &self,
        method: Method,
        path: &str,
        body: Option<Vec<u8>>,
    ) -> Result<T, ClientError> {
        let bytes = self.exchange(method, path, body).await?;
        serde_json::from_slice(&bytes)
            .map_err(|error| self.not_a_hangar(format!("its answer is not valid: {error}")))
    }
}
