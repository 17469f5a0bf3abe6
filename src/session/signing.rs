//! Orders that set up, rotate or remove a vehicle's signing key: each is a transaction.
//!
//! A new key is written to the key file before it is sent to the vehicle. The order is accepted once
//! a frame of the vehicle is signed with the new key (after a removal: is unsigned), and done once
//! the vehicle answers a later request with such a frame. If no answer comes, the earlier key is
//! sent again; the console keeps both.

use std::fmt::Debug;
use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavMessage, TIMESYNC_DATA};

use super::{Output, VehicleCommand};
use crate::commands::Command;
use crate::ledger::{RowEnding, RowState, RowUpdate};
use crate::notice::{Notice, NoticeSource};
use crate::signing::{SentKey, SigningChange};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Vehicle};
use crate::wire::{Content, Frame, MavAddress, Outgoing, Seal, SystemId};

/// How many times a key is sent.
const TRIES: u8 = 5;
/// The time between two attempts.
const SEND_EVERY: Duration = Duration::from_secs(1);
/// The time between two questions, and the time limit for an answer to any of them.
const ASK_EVERY: Duration = Duration::from_millis(500);
const ANSWER_WITHIN: Duration = Duration::from_secs(5);
/// How many times the earlier key is sent.
const TIMES_BACK: u8 = 3;

/// The interface through which a session manages signing keys.
pub trait KeyDesk: Debug + Send + Sync {
    /// Prepares a change; its key is in the file afterwards.
    ///
    /// # Errors
    /// The key cannot be made or written; nothing must be sent then.
    fn begin(&self, vehicle: SystemId, change: SigningChange) -> Result<(), Text>;

    /// Whether frames without a valid signature are ignored.
    fn requires_signatures(&self) -> bool;

    /// The message that gives a vehicle a key or removes its key; `None` if there is no such key.
    fn message(&self, vehicle: MavAddress, which: SentKey) -> Option<Outgoing>;

    /// Notes that the vehicle has proved a change.
    ///
    /// # Errors
    /// The proof cannot be written; the file still has the key.
    fn proved(&self, vehicle: SystemId, change: SigningChange) -> Result<(), Text>;
}

/// The signing of one vehicle.
#[derive(Debug, Clone, Default)]
pub(super) struct VehicleSigning {
    desk: Option<Arc<dyn KeyDesk>>,
    /// The signature of the autopilot's last frame.
    shown: Option<Seal>,
    job: Option<SigningJob>,
}

#[derive(Debug, Clone)]
struct SigningJob {
    order: VehicleCommand,
    change: SigningChange,
    phase: SigningPhase,
    tries: u8,
    /// The last warning of the vehicle since the key was sent.
    warning: Option<Text>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SigningPhase {
    /// The key is sent until the vehicle's frames show that it was taken.
    Sending { next_at: Duration },
    /// The vehicle is asked until it answers.
    Asking { since: Duration, next_at: Duration },
    /// The earlier key is sent.
    Reverting { left: u8, next_at: Duration },
}

impl VehicleSigning {
    /// Uses the keys of this desk from now on; without one, there is no signing.
    pub fn use_desk(&mut self, desk: Option<Arc<dyn KeyDesk>>) {
        self.desk = desk;
    }

    pub fn is_busy(&self) -> bool {
        self.job.is_some()
    }

    pub fn order(
        &mut self,
        order: VehicleCommand,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        let Command::Signing(change) = order.command else {
            return;
        };
        let begun = match self.refusal(change, vehicle) {
            Some(reason) => Err(reason),
            None => self.desk.as_ref().map_or_else(
                || Err(text!("refused-signing-here")),
                |desk| desk.begin(vehicle.system, change),
            ),
        };
        if let Err(reason) = begun {
            output.row(order.unsent(vehicle.id, RowState::Refused, reason, now));
            return;
        }
        self.job = Some(SigningJob {
            order,
            change,
            phase: SigningPhase::Sending { next_at: now },
            tries: 0,
            warning: None,
        });
    }

    fn refusal(&self, change: SigningChange, vehicle: &Vehicle) -> Option<Text> {
        let signs = self.shown.is_some_and(Seal::is_right);
        // A port that takes unsigned frames, such as USB, takes a new key instead of an unknown one.
        let needs_its_key = change != SigningChange::SetUp;
        let Some(desk) = &self.desk else {
            return Some(text!("refused-signing-here"));
        };
        if change == SigningChange::Remove && desk.requires_signatures() {
            // Its unsigned frames would be ignored, and with them the proof that the key is gone.
            Some(text!("refused-signing-required"))
        } else if vehicle.armed() {
            Some(text!("refused-signing-armed"))
        } else if self.job.is_some() {
            Some(text!("refused-signing-busy"))
        } else if needs_its_key && self.shown == Some(Seal::Foreign) {
            Some(text!("refused-signing-foreign"))
        } else {
            match change {
                SigningChange::SetUp if signs => Some(text!("refused-signing-has-key")),
                SigningChange::Rotate | SigningChange::Remove if !signs => {
                    Some(text!("refused-signing-without-key"))
                }
                SigningChange::SetUp | SigningChange::Rotate | SigningChange::Remove => None,
            }
        }
    }

    /// Handles a frame of the vehicle's autopilot.
    pub fn receive(
        &mut self,
        frame: &Frame,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        if !frame.is_verified() {
            return;
        }
        // A replayed frame says nothing about the key that the vehicle has now.
        if !matches!(frame.seal, Seal::Old(_)) {
            self.shown = Some(frame.seal);
        }
        let Some(job) = &mut self.job else {
            return;
        };
        match job.phase {
            SigningPhase::Sending { .. } if job.tries > 0 && job.change.shows_in(frame.seal) => {
                job.phase = SigningPhase::Asking {
                    since: now,
                    next_at: now,
                };
                job.report(RowState::Accepted, None, vehicle, now, output);
            }
            SigningPhase::Asking { since, .. } if is_answer(frame, since) => {
                if job.change.shows_in(frame.seal) {
                    self.prove(vehicle, now, output);
                } else {
                    // The earlier frame was forged or late.
                    job.phase = SigningPhase::Sending { next_at: now };
                }
            }
            SigningPhase::Sending { .. }
            | SigningPhase::Asking { .. }
            | SigningPhase::Reverting { .. } => {}
        }
    }

    /// Stores the vehicle's warnings, which may explain a refusal.
    pub fn hear_texts(&mut self, notices: &[Notice]) {
        let Some(job) = self.job.as_mut().filter(|job| job.tries > 0) else {
            return;
        };
        let mut warnings = notices.iter().rev().filter(|notice| {
            notice.source == NoticeSource::Vehicle && notice.severity <= Severity::Warning
        });
        if let Some(warning) = warnings.next() {
            job.warning = Some(warning.text.clone());
        }
    }

    /// Advances time: sends keys and questions, and ends the order.
    pub fn poll(&mut self, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        let (Some(job), Some(desk)) = (&mut self.job, &self.desk) else {
            return;
        };
        if let Err(RowEnding { state, text }) = job.advance(desk.as_ref(), vehicle, now, output) {
            job.report(state, Some(text), vehicle, now, output);
            self.job = None;
        }
    }

    fn prove(&mut self, vehicle: &Vehicle, now: Duration, output: &mut Output) {
        let (Some(job), Some(desk)) = (self.job.take(), &self.desk) else {
            return;
        };
        let proved = match job.change {
            SigningChange::SetUp => text!("outcome-signing-set-up"),
            SigningChange::Rotate => text!("outcome-signing-rotated"),
            SigningChange::Remove => text!("outcome-signing-removed"),
        };
        let words = match desk.proved(vehicle.system, job.change) {
            Ok(()) => proved,
            Err(fault) => Text::joined("; ", vec![proved, fault]),
        };
        job.report(RowState::Done, Some(words), vehicle, now, output);
    }
}

impl SigningJob {
    /// Takes the step that is due. The end of the order is returned as an error.
    fn advance(
        &mut self,
        desk: &dyn KeyDesk,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) -> Result<(), RowEnding> {
        match &mut self.phase {
            SigningPhase::Sending { next_at } if now >= *next_at => {
                if self.tries >= TRIES {
                    return Err(self.not_taken());
                }
                *next_at = now + SEND_EVERY;
                self.tries += 1;
                let key = desk.message(vehicle.address(), self.change.forward());
                output.messages.extend(key);
                self.report(RowState::Sent, None, vehicle, now, output);
            }
            SigningPhase::Asking { since, next_at } if now >= *next_at => {
                if now >= *since + ANSWER_WITHIN {
                    self.phase = SigningPhase::Reverting {
                        left: TIMES_BACK,
                        next_at: now,
                    };
                    return Ok(());
                }
                *next_at = now + ASK_EVERY;
                output.messages.push(question(vehicle.address(), *since));
            }
            SigningPhase::Reverting { left, next_at } if now >= *next_at => {
                if *left == 0 {
                    return Err(RowEnding::new(
                        RowState::TimedOut,
                        text!(
                            "outcome-signing-reverted",
                            seconds = ANSWER_WITHIN.as_secs()
                        ),
                    ));
                }
                *left -= 1;
                *next_at = now + ASK_EVERY;
                let key = desk.message(vehicle.address(), self.change.back());
                output.messages.extend(key);
            }
            SigningPhase::Sending { .. }
            | SigningPhase::Asking { .. }
            | SigningPhase::Reverting { .. } => {}
        }
        Ok(())
    }

    fn not_taken(&self) -> RowEnding {
        match &self.warning {
            Some(warning) => RowEnding::new(
                RowState::Refused,
                text!("outcome-signing-refused", reason = warning.clone()),
            ),
            None => RowEnding::new(
                RowState::TimedOut,
                text!("outcome-signing-not-taken", tries = self.tries),
            ),
        }
    }

    fn report(
        &self,
        state: RowState,
        explanation: Option<Text>,
        vehicle: &Vehicle,
        now: Duration,
        output: &mut Output,
    ) {
        output.row(RowUpdate {
            entry: self.order.entry,
            vehicle: vehicle.id,
            state,
            tries: self.tries,
            at: now,
            explanation,
        });
    }
}

/// A question that only the addressed vehicle answers, and whose answer repeats `since`, the time
/// when the vehicle took the key.
fn question(vehicle: MavAddress, since: Duration) -> Outgoing {
    MavMessage::TIMESYNC(TIMESYNC_DATA {
        tc1: 0,
        ts1: nonce(since),
        target_system: vehicle.system,
        target_component: vehicle.component,
    })
    .into()
}

/// A negative number, so that no measurement of the round trip uses the same number.
fn nonce(since: Duration) -> i64 {
    -1 - i64::try_from(since.as_nanos()).unwrap_or(i64::MAX - 1)
}

fn is_answer(frame: &Frame, since: Duration) -> bool {
    let Content::Message(MavMessage::TIMESYNC(sync)) = &frame.content else {
        return false;
    };
    sync.tc1 != 0 && sync.ts1 == nonce(since)
}

#[cfg(test)]
mod tests;
