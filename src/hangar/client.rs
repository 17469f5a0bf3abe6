//! A hangar elsewhere, by its HTTP service.
//!
//! - `address` is where it is; `call` sends one request; `follow` keeps up with its events; `pump` carries a vehicle's
//!   bytes, for ever.

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

/// How long a hangar may take to be reached, and to answer a simple question.
const ANSWER: Duration = Duration::from_secs(10);
/// How much waits for one who reads a vehicle's bytes slowly.
const PIPE_LEN: usize = 64 * 1024;

/// Why a hangar elsewhere does not do what it is asked.
#[derive(Debug, thiserror::Error)]
pub enum ClientError {
    #[error(
        "{address} cannot be reached ({source}): is `sortie hangar` running there? From another host: `ssh -L PORT:127.0.0.1:PORT HOST`"
    )]
    Unreachable {
        address: HangarAddress,
        source: io::Error,
    },
    /// It does not answer in time.
    #[error("{address} has not answered within {seconds} s")]
    Late {
        address: HangarAddress,
        /// How long was waited.
        seconds: u64,
    },
    /// The answer is not that of a hangar.
    #[error("{address} answers, but it is not a sortie hangar ({why})")]
    NotAHangar {
        address: HangarAddress,
        /// How that is known.
        why: String,
    },
    /// It wants a token, or another one.
    #[error(
        "{address} wants its token ({why}): copy its token file here and name it with --hangar-token FILE"
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

/// A hangar elsewhere. Cheap to clone; a connection is made for each request.
#[derive(Debug, Clone)]
pub struct RemoteHangar {
    address: HangarAddress,
    token: Option<HangarToken>,
    /// The run of the service that is meant; requests to another one are refused by it.
    life: Option<String>,
}

impl fmt::Display for RemoteHangar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.address.fmt(f)
    }
}

impl RemoteHangar {
    /// A hangar at an address. Its token is needed unless it is on this host and of this user.
    pub fn new(address: HangarAddress, token: Option<HangarToken>) -> Self {
        Self {
            address,
            token,
            life: None,
        }
    }

    /// The same hangar as long as it is not started anew: the numbers of its instances mean others then.
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

    /// What it says about itself.
    ///
    /// # Errors
    /// Why it does not.
    pub async fn status(&self) -> Result<Status, ClientError> {
        self.ask(Method::GET, "/status", None).await
    }

    /// Starts an instance.
    ///
    /// # Errors
    /// Why it does not.
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
    /// Why it does not tell.
    pub async fn instances(&self) -> Result<Vec<Instance>, ClientError> {
        self.ask(Method::GET, "/vehicles", None).await
    }

    /// Ends an instance.
    ///
    /// # Errors
    /// Why it does not.
    pub async fn stop(&self, id: InstanceId) -> Result<(), ClientError> {
        let path = format!("/vehicles/{id}");
        self.exchange(Method::DELETE, &path, None).await.map(drop)
    }

    /// Ends an instance's process and starts it again.
    ///
    /// # Errors
    /// Why it does not.
    pub async fn restart(&self, id: InstanceId) -> Result<(), ClientError> {
        let path = format!("/vehicles/{id}/restart");
        self.exchange(Method::POST, &path, None).await.map(drop)
    }

    /// What an instance has printed, from the line with this number on, as far as it is kept.
    ///
    /// # Errors
    /// Why it does not tell.
    pub async fn output(&self, id: InstanceId, since: u64) -> Result<Vec<OutputLine>, ClientError> {
        let path = format!("/vehicles/{id}/output?since={since}&lines={}", u16::MAX);
        let Printed { lines, .. } = self.ask(Method::GET, &path, None).await?;
        Ok(lines)
    }

    /// Follows the instances until cancelled; connects again when the connection is lost.
    pub fn follow(&self, cancel: CancellationToken) -> watch::Receiver<HangarView> {
        let (sender, view) = watch::channel(HangarView::default());
        tokio::spawn(follow::run(self.clone(), sender, cancel));
        view
    }

    /// The bytes of an instance's serial 0, until cancelled or dropped. A connection that is lost is made again,
    /// later and later; bytes that come meanwhile are lost, as on a radio.
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
            .map_err(|error| self.not_a_hangar(format!("its answer makes no sense: {error}")))
    }
}
