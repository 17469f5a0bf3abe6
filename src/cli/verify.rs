//! `sortie verify`: flies a record again and compares the result with the record.

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use clap::Args;
use serde::Serialize;

use super::Failure;
use super::settings::CliSettings;
use crate::mission::Mission;
use crate::mission::record::{Divergence, Rescored, Stored, refly};
use crate::notice::sanitised;
use crate::record::{Head, StoredInputs, Subject};
use crate::scoring::{FlightBackend, FlownBy, MissionFile};
use crate::store::{self, RecordFiles, RecordPublicKey, RecordSignature, read_run};
use crate::text;
use crate::text::{Locale, Text, clock, figure};
use crate::vehicle::VehicleId;

/// Options of `sortie verify`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    sortie verify                              the newest record of the console\n  \
    sortie verify 3 --json\n  \
    sortie verify 3 --public-key keys/minisign.pub\n  \
    sortie verify runs/2026-11-20T14-03-22Z_01-air-sample_4711-00.run.jsonl")]
pub(super) struct VerifyArguments {
    /// The number in `sortie records list`, or a file of the record.
    #[arg(default_value = "1")]
    record: String,
    /// Require a signature with this key: the text of a minisign public key, or its file.
    #[arg(long, value_name = "KEY")]
    public_key: Option<String>,
    /// Print one JSON document instead of text.
    #[arg(long)]
    json: bool,
}

/// The result of a verification.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
enum Verdict {
    /// The repeated flight matches the record.
    Verified,
    /// The repeated flight differs from the record.
    Differs,
    /// The repeated flight differs, and another program has flown the original.
    OtherProgram,
    /// The mission in the record differs from this program's mission of the same name.
    OtherMission,
    /// The flight cannot be repeated; its score was checked against its telemetry instead.
    Rescored,
}

/// The result as a document, with units in the names.
#[derive(Debug, Serialize)]
struct VerifyDocument {
    verdict: Verdict,
    /// The id of the mission that was compared, and its seed; `None` without a mission.
    mission: Option<String>,
    seed: Option<u64>,
    /// The score that follows from the record; `None` without a mission.
    score: Option<u16>,
    /// The score that the record states.
    recorded_score: Option<u16>,
    /// The first difference between flight and record, in simulated seconds.
    at_s: Option<f64>,
    vehicle: Option<VehicleId>,
    /// The kind of difference, in English.
    what: Option<String>,
    flown_by: Option<FlyingHand>,
    /// The program that flew the original, as the record states.
    program: String,
    /// The pilot's profile and the date of the flight, as the record states; `None` without a mission.
    profile: Option<String>,
    when: Option<String>,
    /// The fields of this document that are only stated in the record: no comparison covers them.
    unproved: &'static [&'static str],
    #[serde(flatten)]
    signature: SignatureDocument,
    /// The instructor's desk that witnessed the flight.
    witnessed: Option<String>,
    #[serde(skip)]
    words: Text,
    #[serde(skip)]
    is_good: bool,
}

/// Whether the files of a record are signed.
#[derive(Debug, Default, Serialize)]
struct SignatureDocument {
    signature: SignatureState,
    /// The id of the key, in hexadecimal digits.
    signed_with: Option<String>,
    /// The comment in the signature, once it is checked.
    signed_comment: Option<String>,
}

/// The result of checking the signatures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
enum SignatureState {
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
enum FlyingHand {
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

/// Verifies a record. The exit code shows whether its score is reliable.
pub(super) fn verify(
    options: &VerifyArguments,
    settings: &CliSettings,
) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let files = settings.find_record(&options.record)?;
    let invalid = |fault: Text| {
        let named = Text::joined(": ", vec![files.stem.as_str().into(), fault]);
        Failure::Invalid(format!("sortie: {}", locale.text(&named)))
    };
    let mut document = judge(&files).map_err(invalid)?;
    let key = options.public_key.as_deref().map(RecordPublicKey::read);
    let key = key
        .transpose()
        .map_err(|error| invalid(Text::from(&error)))?;
    document.add_signature(files.signature(key.as_ref()), key.is_some());
    if options.json {
        say!("{}", serde_json::to_string_pretty(&document)?)?;
    } else {
        say!("{}", locale.text(&document.words))?;
    }
    Ok(document.exit_code())
}

fn judge(files: &RecordFiles) -> Result<VerifyDocument, Text> {
    let read = |path: &Path| read_run(path).map_err(|error| Text::verbatim(error.to_string()));
    let inputs = files.inputs.as_deref().map(read).transpose()?;
    let inputs = inputs.as_deref().map(StoredInputs::read).transpose()?;
    let journal = files.head().ok();
    let Some(run) = files.run.as_deref() else {
        return judge_free(journal.as_ref(), inputs.as_ref());
    };
    let stored = Stored::read(&read(run)?)?;
    let head = &stored.head;
    let mission = head.flown()?;
    let document = judge_run(&stored, &mission, inputs.as_ref(), journal.as_ref())?;
    let document = VerifyDocument {
        mission: Some(mission.id),
        seed: Some(head.seed),
        score: Some(stored.rescore()?.report.score),
        recorded_score: stored.end().map(|end| end.score),
        flown_by: head.flown_by.map(FlyingHand::from),
        profile: head.profile.clone(),
        when: Some(head.when.clone()),
        ..document
    };
    Ok(document.stating(&["program", "profile", "when", "flown_by"]))
}

/// Compares a flight without a mission, of which only the flight itself can be repeated.
fn judge_free(head: Option<&Head>, inputs: Option<&StoredInputs>) -> Result<VerifyDocument, Text> {
    let is_free = head.is_none_or(|head| head.subject == Subject::Free);
    let (Some(inputs), true) = (inputs, is_free) else {
        return Err(text!("verify-no-inputs"));
    };
    let difference = refly(&mut inputs.head.world(), inputs);
    let program = inputs.head.program.clone();
    let document = match difference.or_else(|| contradiction(head?, inputs)) {
        None => VerifyDocument {
            words: text!("verify-verified-flight", length = clock(inputs.lasts())),
            is_good: true,
            ..VerifyDocument::new(Verdict::Verified, program)
        },
        Some(difference) => VerifyDocument::differing(difference, program),
    };
    Ok(document.stating(&["program"]))
}

/// The difference if the journal of a flight names another program than its input log.
fn contradiction(head: &Head, inputs: &StoredInputs) -> Option<Divergence> {
    let [one, other] = [&head.program, &inputs.head.program].map(String::as_str);
    let what = || text!("verify-programs", one = one, other = other);
    (one != other).then(|| at_the_start(what()))
}

/// A difference that concerns the record as a whole.
fn at_the_start(what: Text) -> Divergence {
    Divergence {
        at: Duration::ZERO,
        vehicle: None,
        what,
    }
}

fn judge_run(
    stored: &Stored,
    mission: &Mission,
    inputs: Option<&StoredInputs>,
    journal: Option<&Head>,
) -> Result<VerifyDocument, Text> {
    let head = &stored.head;
    let is_known = match store::mission_file(mission) {
        MissionFile::Course | MissionFile::Own => true,
        MissionFile::OtherRevision | MissionFile::Altered => false,
    };
    // The head names the mission apart from its text.
    if !is_known || head.mission != mission.id || head.revision != mission.rev {
        return Ok(VerifyDocument::of_other_mission(stored));
    }
    let inputs = inputs.filter(|_| head.backend == FlightBackend::Embedded);
    let verification = inputs.map(|inputs| stored.verify(inputs)).transpose()?;
    let difference = verification
        .as_ref()
        .and_then(|it| it.difference.clone())
        .or_else(|| stored.misstatement(journal).map(at_the_start));
    let program = head.program.clone();
    Ok(match (difference, verification) {
        (Some(difference), _) => VerifyDocument::differing(difference, program),
        (None, Some(verification)) => VerifyDocument {
            words: text!(
                "verify-verified",
                mission = mission.id.as_str(),
                seed = head.seed.to_string(),
                score = verification.rescored.report.score
            ),
            is_good: true,
            ..VerifyDocument::new(Verdict::Verified, program)
        },
        (None, None) => rescored(&stored.rescore()?, head.backend, program),
    })
}

/// The result for a flight that cannot be repeated: of ArduPilot, or without its inputs.
fn rescored(rescored: &Rescored, backend: FlightBackend, program: String) -> VerifyDocument {
    let score = rescored.report.score;
    let is_same = rescored.before.is_some_and(|before| before.score == score);
    let words = match (backend, is_same) {
        (FlightBackend::Embedded, _) => text!("verify-inputs-missing", score = score),
        (FlightBackend::ArduPilot, true) => text!("verify-rescored", score = score),
        (FlightBackend::ArduPilot, false) => text!("verify-rescored-other", score = score),
    };
    VerifyDocument {
        words,
        is_good: is_same && backend == FlightBackend::ArduPilot,
        ..VerifyDocument::new(Verdict::Rescored, program)
    }
}

impl VerifyDocument {
    fn new(verdict: Verdict, program: String) -> Self {
        Self {
            verdict,
            mission: None,
            seed: None,
            score: None,
            recorded_score: None,
            at_s: None,
            vehicle: None,
            what: None,
            flown_by: None,
            program,
            profile: None,
            when: None,
            unproved: &[],
            signature: SignatureDocument::default(),
            witnessed: None,
            words: Text::default(),
            is_good: false,
        }
    }

    fn of_other_mission(stored: &Stored) -> Self {
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

    /// Success only for a flight that matches its record, or whose telemetry gives the recorded score.
    fn exit_code(&self) -> ExitCode {
        ExitCode::from(u8::from(!self.is_good))
    }

    /// Names the fields that no comparison covers, if the record is good otherwise.
    fn stating(mut self, unproved: &'static [&'static str]) -> Self {
        if !self.is_good {
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

    /// Adds the result of the signatures. With a requested key, every file must be signed by it.
    fn add_signature(&mut self, found: RecordSignature, is_wanted: bool) {
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
        let is_fine = matches!(state, SignatureState::Valid | SignatureState::Unchecked);
        self.is_good &= is_fine;
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

    fn differing(difference: Divergence, program: String) -> Self {
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
