//! The result of a verification, as a document and in words.

use std::process::ExitCode;

use serde::Serialize;

use crate::exam_seal::{FlownAgain, SealCheck};
use crate::mission::record::{Divergence, Stored};
use crate::notice::sanitised;
use crate::scoring::FlownBy;
use crate::store::RecordSignature;
use crate::text;
use crate::text::{Text, figure};
use crate::vehicle::VehicleId;

/// The result of a verification.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Verdict {
    /// The repeated flight matches the record.
    Verified,
    /// The repeated flight matches the record of a free flight as far as its input log goes; the
    /// log has no end.
    VerifiedPart,
    /// The repeated flight matches the record of a mission that was left, as far as the record goes: it has no score.
    VerifiedLeft,
    /// The repeated flight matches the record of a mission that was cut off, or whose console was killed.
    VerifiedCut,
    /// The repeated flight differs from the record.
    Differs,
    /// The repeated flight differs, and another program has flown the original.
    OtherProgram,
    /// The mission in the record differs from this program's mission of the same name.
    OtherMission,
    /// The flight cannot be repeated; its score was checked against its telemetry instead.
    Rescored,
}

impl Verdict {
    /// The fields of the document that a mission's record states without proof. Only the journal
    /// states whether a mission was left or cut off.
    pub(super) fn unproved(self) -> &'static [&'static str] {
        match self {
            Self::VerifiedLeft => &["program", "profile", "when", "flown_by", "attempt", "left"],
            Self::Verified
            | Self::VerifiedPart
            | Self::VerifiedCut
            | Self::Differs
            | Self::OtherProgram
            | Self::OtherMission
            | Self::Rescored => &["program", "profile", "when", "flown_by", "attempt"],
        }
    }
}

/// How far a result can be relied on, which decides the exit code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reliance {
    /// The record is reliable.
    Good,
    /// The record is reliable as far as it goes, but the end of the flight, which may have been
    /// bad, is missing.
    Unfinished,
    /// The record differs from the flight, or nothing confirms it.
    Bad,
}

/// The result as a document, with units in the names.
#[derive(Debug, Serialize)]
pub(super) struct VerifyDocument {
    pub(super) verdict: Verdict,
    /// The id of the mission that was compared; `None` without a mission.
    pub(super) mission: Option<String>,
    /// The seed of the mission that was compared.
    pub(super) seed: Option<u64>,
    /// The score that follows from the record; `None` without a mission.
    pub(super) score: Option<u16>,
    /// The score that the record states.
    pub(super) recorded_score: Option<u16>,
    /// The mission time up to which a record without an end was compared, in seconds.
    pub(super) to_s: Option<f64>,
    /// The time of the first difference between flight and record, in simulated seconds.
    pub(super) at_s: Option<f64>,
    pub(super) vehicle: Option<VehicleId>,
    /// The kind of difference, in English.
    pub(super) what: Option<String>,
    pub(super) flown_by: Option<FlyingHand>,
    /// The program that flew the original, as the record states.
    pub(super) program: String,
    /// The pilot's profile, as the record states; `None` without a mission.
    pub(super) profile: Option<String>,
    /// The date of the flight.
    pub(super) when: Option<String>,
    /// The fields of this document that are only stated in the record: no comparison covers them.
    pub(super) unproved: &'static [&'static str],
    #[serde(flatten)]
    pub(super) signature: SignatureDocument,
    /// The seal of the desk, if it is a try of an exam.
    pub(super) seal: Option<SealCheck>,
    #[serde(skip)]
    pub(super) words: Text,
    /// The faults of the journal, in English.
    pub(super) faults: Vec<String>,
    #[serde(skip)]
    pub(super) reliance: Reliance,
}

/// Whether the files of a record are signed.
#[derive(Debug, Default, Serialize)]
pub(super) struct SignatureDocument {
    signature: SignatureState,
    /// The id of the key, in hexadecimal digits.
    signed_with: Option<String>,
    /// The comment in the signature, once it is checked.
    signed_comment: Option<String>,
}

/// The result of checking the signatures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum SignatureState {
    #[default]
    None,
    /// No key was given, so nothing was checked.
    Unchecked,
    Valid,
    Invalid,
    /// Some files are not signed.
    Partial,
}

/// The source of the flight's commands: a person or a script.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum FlyingHand {
    Hand,
    Script,
    Bundled,
}

impl From<FlownBy> for FlyingHand {
    fn from(flown_by: FlownBy) -> Self {
        match flown_by {
            FlownBy::Hand => Self::Hand,
            FlownBy::Script => Self::Script,
            FlownBy::BundledPilot => Self::Bundled,
        }
    }
}

impl VerifyDocument {
    pub(super) fn new(verdict: Verdict, program: String) -> Self {
        Self {
            verdict,
            mission: None,
            seed: None,
            score: None,
            recorded_score: None,
            to_s: None,
            at_s: None,
            vehicle: None,
            what: None,
            flown_by: None,
            program,
            profile: None,
            when: None,
            unproved: &[],
            signature: SignatureDocument::default(),
            seal: None,
            words: Text::default(),
            faults: Vec::new(),
            reliance: Reliance::Bad,
        }
    }

    pub(super) fn of_other_mission(stored: &Stored) -> Self {
        let head = &stored.head;
        let hash = format!("{:016x}", crate::hash::fnv1a(head.source.as_bytes()));
        let words = text!(
            "verify-other-mission",
            mission = head.mission.as_str(),
            hash = hash
        );
        Self {
            words,
            ..Self::new(Verdict::OtherMission, head.program.clone())
        }
    }

    /// Success only for a flight that matches its record, or whose telemetry gives the recorded
    /// score. A mission's record without an end has its own code, so that removing a bad end does
    /// not give success.
    pub(super) fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self.reliance {
            Reliance::Good => 0,
            Reliance::Bad => 1,
            Reliance::Unfinished => 3,
        })
    }

    /// Adds the faults of the journal, which are not part of the comparison.
    pub(super) fn with_faults(mut self, faults: Vec<Text>) -> Self {
        self.faults = faults.iter().map(ToString::to_string).collect();
        let words = std::iter::once(std::mem::take(&mut self.words));
        self.words = Text::joined("\n", words.chain(faults).collect());
        self
    }

    /// Names the fields that no comparison covers, if the record is good otherwise.
    pub(super) fn stating(mut self, unproved: &'static [&'static str]) -> Self {
        if self.reliance == Reliance::Bad {
            return self;
        }
        let program = sanitised(&self.program);
        let stated = match (&self.profile, &self.when) {
            (Some(profile), Some(when)) => text!(
                "verify-stated",
                program = program,
                profile = sanitised(profile),
                when = sanitised(when)
            ),
            (None, Some(when)) => text!(
                "verify-stated-guest",
                program = program,
                when = sanitised(when)
            ),
            (_, None) => text!("verify-stated-free", program = program),
        };
        self.words = Text::joined("\n", vec![self.words, stated]);
        self.unproved = unproved;
        self
    }

    /// Adds the result of checking the signatures. If a key was requested, every file must be
    /// signed with it.
    pub(super) fn add_signature(&mut self, found: RecordSignature, is_wanted: bool) {
        let (state, text) = match &found {
            RecordSignature::None if is_wanted => (SignatureState::None, text!("sign-none")),
            RecordSignature::None => return,
            RecordSignature::Unchecked { key } => (
                SignatureState::Unchecked,
                text!("sign-unchecked", key = key.as_str()),
            ),
            RecordSignature::Valid { key, comment } => (
                SignatureState::Valid,
                text!(
                    "sign-valid",
                    key = key.as_str(),
                    comment = sanitised(&comment.replace('\t', ", "))
                ),
            ),
            RecordSignature::Invalid { file, fault } => (
                SignatureState::Invalid,
                text!(
                    "sign-invalid",
                    file = file.as_str(),
                    why = Text::from(fault)
                ),
            ),
            RecordSignature::Partial { file } => (
                SignatureState::Partial,
                text!("sign-partial", file = file.as_str()),
            ),
        };
        self.words = Text::joined("\n", vec![std::mem::take(&mut self.words), text]);
        if !matches!(state, SignatureState::Valid | SignatureState::Unchecked) {
            self.reliance = Reliance::Bad;
        }
        self.signature.signature = state;
        match found {
            RecordSignature::Unchecked { key } => self.signature.signed_with = Some(key),
            RecordSignature::Valid { key, comment } => {
                self.signature.signed_with = Some(key);
                self.signature.signed_comment = Some(comment);
            }
            RecordSignature::None
            | RecordSignature::Invalid { .. }
            | RecordSignature::Partial { .. } => {}
        }
    }

    /// Adds the seal of the desk. One that does not fit makes the record unreliable.
    pub(super) fn add_seal(&mut self, mut seal: SealCheck) {
        if let Some((mission, seed)) = self.mission.as_deref().zip(self.seed) {
            let score = self.score;
            seal.compare(&FlownAgain {
                mission,
                seed,
                score,
            });
        }
        self.words = Text::joined("\n", vec![std::mem::take(&mut self.words), seal.text()]);
        if seal.fault.is_some() {
            self.reliance = Reliance::Bad;
        }
        self.seal = Some(seal);
    }

    pub(super) fn differing(difference: Divergence, program: String) -> Self {
        let Divergence { at, vehicle, what } = difference;
        let seconds = figure(at.as_secs_f64(), 2);
        let whose = match vehicle {
            Some(vehicle) => text!("verify-of-vehicle", vehicle = vehicle, what = &what),
            None => what.clone(),
        };
        let (verdict, words) = if program == env!("SORTIE_VERSION") {
            (
                Verdict::Differs,
                text!("verify-differs", seconds = seconds, what = whose),
            )
        } else {
            let text = text!(
                "verify-other-program",
                program = program.as_str(),
                seconds = seconds,
                what = whose
            );
            (Verdict::OtherProgram, text)
        };
        Self {
            at_s: Some(at.as_secs_f64()),
            vehicle,
            what: Some(what.to_string()),
            words,
            ..Self::new(verdict, program)
        }
    }
}
