//! One request and the wait for its answer.

use std::time::Duration;

use super::FtpFault;
use super::packet::{FtpAnswer, FtpRequest};

/// A request counts as lost after this long, or after one and a half round trips if that is longer.
const SILENCE: Duration = Duration::from_millis(500);
/// Unanswered requests make the next wait longer, up to this factor.
const LONGEST_WAIT: u32 = 4;
/// The wait doubles after this many unanswered requests.
const PATIENT_FOR: u32 = 4;

/// A request that is repeated until it is answered. It keeps its number: a server that has carried it out already sends
/// the same answer again.
#[derive(Debug, Clone)]
pub(super) struct Exchange {
    request: FtpRequest,
    begun: Option<Duration>,
    sent_at: Duration,
    tries: u32,
    patience: Duration,
}

impl Exchange {
    pub fn new(request: FtpRequest, patience: Duration) -> Self {
        Self {
            request,
            begun: None,
            sent_at: Duration::ZERO,
            tries: 0,
            patience,
        }
    }

    pub fn request(&self) -> &FtpRequest {
        &self.request
    }

    pub fn is_answered_by(&self, answer: &FtpAnswer) -> bool {
        self.begun.is_some()
            && answer.is_of(self.request.opcode)
            && answer.sequence == (self.request.sequence as u16).wrapping_add(1)
    }

    /// The request, if it is due.
    ///
    /// # Errors
    /// [`FtpFault::Silent`] once the time limit is over.
    pub fn poll(
        &mut self,
        round_trip: Duration,
        now: Duration,
    ) -> Result<Option<&FtpRequest>, FtpFault> {
        let begun = *self.begun.get_or_insert(now);
        if now >= begun + self.patience {
            return Err(FtpFault::Silent);
        }
        let doubled = (1 << (self.tries / PATIENT_FOR).min(8)).min(LONGEST_WAIT);
        let wait = SILENCE.max(round_trip * 3 / 2) * doubled;
        if self.tries > 0 && now < self.sent_at + wait {
            return Ok(None);
        }
        self.tries += 1;
        self.sent_at = now;
        Ok(Some(&self.request))
    }
}
