//! Refusals of a hangar.

use std::io;

use super::InstanceId;
use super::client::ClientError;
use crate::text;
use crate::text::Text;

/// Why a hangar refuses a request.
#[derive(Debug, thiserror::Error)]
pub enum HangarRefusal {
    /// No instance has that number.
    #[error("no instance {0}: the list shows those that run")]
    Unknown(InstanceId),
    /// The number is taken.
    #[error("instance {0} exists already: stop it first, or choose another number")]
    Taken(InstanceId),
    /// The hangar is full.
    #[error("{0} instances are running, which is the limit: stop some, or raise the limit")]
    Full(u16),
    /// No program for this kind of vehicle is known.
    #[error(
        "no {0} was found: name one with `--arducopter` or `SORTIE_ARDUCOPTER`, or put it on the PATH"
    )]
    NoProgram(&'static str),
    /// The request is not valid.
    #[error("{0}")]
    Invalid(String),
    /// A program is already attached to the instance.
    #[error("another client is attached to instance {0} already")]
    Attached(InstanceId),
    /// The host does not allow the instance to start.
    #[error("cannot start instance {id}: {what}: {source}")]
    Host {
        id: InstanceId,
        what: String,
        source: io::Error,
    },
    /// The hangar is being closed.
    #[error("the hangar is closing")]
    Closing,
    /// A remote hangar refuses.
    #[error("hangar {hangar}: {source}")]
    Far {
        hangar: String,
        /// Its answer, or the reason why there is none.
        source: ClientError,
    },
}

impl From<&HangarRefusal> for Text {
    fn from(refusal: &HangarRefusal) -> Self {
        match refusal {
            HangarRefusal::Unknown(id) => text!("hangar-unknown", id = *id),
            HangarRefusal::Taken(id) => text!("hangar-taken", id = *id),
            HangarRefusal::Full(limit) => text!("hangar-full", limit = *limit),
            HangarRefusal::NoProgram(program) => text!("hangar-no-program", program = *program),
            HangarRefusal::Invalid(reason) => Self::verbatim(reason.clone()),
            HangarRefusal::Attached(id) => text!("hangar-attached", id = *id),
            HangarRefusal::Host { id, what, source } => {
                text!(
                    "hangar-host",
                    id = *id,
                    what = what,
                    error = source.to_string()
                )
            }
            HangarRefusal::Closing => text!("hangar-closing"),
            HangarRefusal::Far { hangar, source } => {
                text!("hangar-far", hangar = hangar, error = Self::from(source))
            }
        }
    }
}
