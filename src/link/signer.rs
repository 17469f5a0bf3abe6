//! The keyring in use: shared by all links, and written to its file ahead of the timestamps.

use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{SystemTime, UNIX_EPOCH};

use rand::TryRng as _;
use rand::rngs::SysRng;

use super::LinkId;
use crate::session::KeyDesk;
use crate::signing::{EPOCH_UNIX_S, Keyring, SECOND, SecretKey, SentKey, SigningChange};
use crate::store::{KeyFile, KeyFileFault};
use crate::text;
use crate::text::Text;
use crate::wire::{Frame, MavAddress, Outgoing, Seal, SigningKey, Stamp, SystemId};

/// The signing of a program. All clones share one keyring.
#[derive(Clone)]
pub struct Signer(Arc<SignerInner>);

struct SignerInner {
    ring: Mutex<Keyring>,
    /// The file, or why there is none.
    file: Mutex<Result<KeyFile, Text>>,
    clock: Box<dyn Fn() -> u64 + Send + Sync>,
    /// Whether frames without a valid signature are ignored.
    is_required: bool,
}

impl fmt::Debug for Signer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let required = self.0.is_required;
        f.debug_struct("Signer")
            .field("is_required", &required)
            .finish_non_exhaustive()
    }
}

/// The time of this machine as a timestamp of a signature: units of 10 µs since 2015 (UTC).
pub fn signing_clock() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    let micros = since.map_or(0, |since| since.as_micros());
    let units = u64::try_from(micros / 10).unwrap_or(u64::MAX);
    units.saturating_sub(EPOCH_UNIX_S * SECOND)
}

impl Signer {
    /// The signing with the keys of a file, or without keys if the file cannot be used or there is
    /// no folder for it.
    pub fn new(
        opened: Result<(KeyFile, Keyring), Text>,
        is_required: bool,
        clock: impl Fn() -> u64 + Send + Sync + 'static,
    ) -> Self {
        let (file, ring) = match opened {
            Ok((file, ring)) => (Ok(file), ring),
            Err(fault) => (Err(fault), Keyring::default()),
        };
        Self(Arc::new(SignerInner {
            ring: Mutex::new(ring),
            file: Mutex::new(file),
            clock: Box::new(clock),
            is_required,
        }))
    }

    /// The signing on one link.
    pub(super) fn on(&self, address: &str, id: LinkId) -> SignedLink {
        SignedLink {
            signer: self.clone(),
            address: address.into(),
            // Timestamps are unique in this program, so two links may share a number.
            id: id.0 as u8,
        }
    }

    /// Writes the keyring if that is necessary.
    fn save(&self, is_needed: impl Fn(&Keyring) -> bool) -> Result<(), Text> {
        // Only one thread writes at a time, so that no older text replaces a newer one.
        let mut file = self.0.file.lock().unwrap_or_else(PoisonError::into_inner);
        let (text, reserved) = {
            let mut ring = self.ring();
            if !is_needed(&ring) {
                return Ok(());
            }
            ring.write((self.0.clock)())
        };
        let written = match &mut *file {
            Ok(file) => file
                .write(&text)
                .map_err(|fault: KeyFileFault| Text::from(&fault)),
            Err(fault) => Err(fault.clone()),
        };
        match &written {
            Ok(()) => self.ring().written(reserved),
            Err(fault) => {
                tracing::error!("signing keys: {fault}");
                self.ring().unwritten();
            }
        }
        written
    }

    /// Writes the keyring now if the stamps of the file are used up, otherwise in the background if that is due.
    fn keep_ahead(&self, is_spent: bool) {
        if is_spent {
            // Frames are sent even if the disk is full, because losing contact would be worse.
            drop(self.save(Keyring::is_spent));
            return;
        }
        let signer = self.clone();
        match tokio::runtime::Handle::try_current() {
            Ok(runtime) => {
                runtime.spawn_blocking(move || drop(signer.save(Keyring::is_due)));
            }
            Err(_) => drop(self.save(Keyring::is_due)),
        }
    }

    fn ring(&self) -> MutexGuard<'_, Keyring> {
        // A panic loses at most the last change.
        self.0.ring.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The signing on one link, whose address is part of the name of a key.
#[derive(Debug, Clone)]
pub struct SignedLink {
    signer: Signer,
    address: Arc<str>,
    id: u8,
}

impl SignedLink {
    /// Checks the signature of a received frame.
    pub(super) fn check(&self, frame: &Frame, bytes: &[u8]) -> Seal {
        if !frame.seal.is_signature() {
            return frame.seal;
        }
        let (seal, is_due) = {
            let mut ring = self.signer.ring();
            let seal = ring.check(&self.address, frame, bytes);
            (seal, seal.is_right() && ring.take_due())
        };
        if is_due {
            self.signer.keep_ahead(false);
        }
        seal
    }

    /// Whether a frame with this signature may change a vehicle.
    pub(super) fn admits(&self, seal: Seal) -> bool {
        !self.signer.0.is_required || seal.is_right()
    }

    /// The signatures for a message to a vehicle, or to all `heard` ones; none if it is sent unsigned.
    pub(super) fn seal(
        &self,
        to: Option<SystemId>,
        heard: impl IntoIterator<Item = SystemId>,
    ) -> Vec<(SigningKey, Stamp)> {
        let stamp = Stamp {
            link: self.id,
            timestamp: (self.signer.0.clock)(),
        };
        let (seals, is_spent, is_due) = {
            let mut ring = self.signer.ring();
            let mut systems: Vec<SystemId> = match to {
                Some(system) => vec![system],
                None => heard.into_iter().collect(),
            };
            if systems.is_empty() {
                // Some vehicles are silent until they receive a message.
                systems = ring.keyed(&self.address).collect();
            }
            let seals = ring.seal(&self.address, systems, stamp);
            let is_used = !seals.is_empty();
            let is_spent = is_used && ring.is_spent();
            (seals, is_spent, is_used && ring.take_due())
        };
        if is_spent || is_due {
            self.signer.keep_ahead(is_spent);
        }
        seals
    }

    /// The vehicles of the link whose frames should be signed.
    pub(super) fn keyed(&self) -> Vec<SystemId> {
        self.signer.ring().keyed(&self.address).collect()
    }

    /// Whether frames are signed, or have to be.
    pub(super) fn is_used(&self) -> bool {
        self.is_required() || self.signer.ring().keyed(&self.address).next().is_some()
    }

    /// Whether frames without a valid signature are ignored.
    pub(super) fn is_required(&self) -> bool {
        self.signer.0.is_required
    }
}

impl KeyDesk for SignedLink {
    fn begin(&self, vehicle: SystemId, change: SigningChange) -> Result<(), Text> {
        let mut fresh = [0; 32];
        SysRng
            .try_fill_bytes(&mut fresh)
            .map_err(|error| text!("signing-no-random", error = error.to_string()))?;
        let key = SecretKey::new(fresh);
        self.signer
            .ring()
            .begin(&self.address, vehicle, change, key);
        self.signer.save(|_| true)
    }

    fn requires_signatures(&self) -> bool {
        self.is_required()
    }

    fn message(&self, vehicle: MavAddress, which: SentKey) -> Option<Outgoing> {
        let now = (self.signer.0.clock)();
        let message = self
            .signer
            .ring()
            .message(&self.address, vehicle, which, now);
        // The message's timestamp must be within the range stored in the file.
        drop(self.signer.save(Keyring::is_spent));
        message
    }

    fn proved(&self, vehicle: SystemId, change: SigningChange) -> Result<(), Text> {
        self.signer.ring().proved(&self.address, vehicle, change);
        self.signer.save(|_| true)
    }
}
