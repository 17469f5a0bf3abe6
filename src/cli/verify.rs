//! `sortie verify`: flies a record again and compares the result with the record.

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use clap::Args;

use self::document::{FlyingHand, Reliance, Verdict, VerifyDocument};
use super::Failure;
use super::settings::CliSettings;
use crate::campaign::without_end;
use crate::mission::Mission;
use crate::mission::record::{Divergence, Head, RecordExtent, Rescored, Stored, refly};
use crate::record::{Journal, JournalFit, JournalNeighbours, StoredInputs, Subject};
use crate::replay::TlogSpan;
use crate::scoring::{FlightBackend, MissionFile};
use crate::store::{self, DeskKey, RecordFiles, RecordPublicKey, check_seal, read_run};
use crate::text;
use crate::text::{Locale, Text, clock};

mod document;

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
    /// Require a signature, or the seal of a desk, with this key: the text of a minisign public key, or its file.
    #[arg(long, value_name = "KEY")]
    public_key: Option<String>,
    /// Print one JSON document instead of text.
    #[arg(long)]
    json: bool,
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
    let key = options
        .public_key
        .as_deref()
        .map(RecordPublicKey::read)
        .transpose()
        .map_err(|error| invalid(Text::from(&error)))?;
    let own = settings.data.path().and_then(DeskKey::public_in);
    let seal = check_seal(
        &files,
        key.as_ref().map(RecordPublicKey::text).or(own).as_deref(),
    );
    // The seal has the hashes of all files.
    let needs_signature = key.is_some() && seal.is_none();
    document.add_signature(
        files.signature(key.as_ref().filter(|_| seal.is_none())),
        needs_signature,
    );
    if let Some(seal) = seal {
        document.add_seal(seal);
    }
    if options.json {
        say!("{}", serde_json::to_string_pretty(&document)?)?;
    } else {
        say!("{}", locale.text(&document.words))?;
    }
    Ok(document.exit_code())
}

fn judge(files: &RecordFiles) -> Result<VerifyDocument, Text> {
    if files.is_written() {
        return Err(text!("records-in-use", name = files.stem.as_str()));
    }
    let read = |path: &Path| read_run(path).map_err(|error| Text::verbatim(error.to_string()));
    let text = files.inputs.as_deref().map(read).transpose()?;
    let inputs = text.as_deref().map(StoredInputs::read).transpose()?;
    let (journal, faults) = read_journal(files);
    let Some(run) = files.run.as_deref() else {
        let judged = judge_free(journal.as_ref(), inputs.as_ref())?;
        return Ok(judged.with_faults(faults));
    };
    let stored = Stored::read(&read(run)?)?;
    let head = &stored.head;
    let mission = head.flown()?;
    let judged = judge_run(&stored, &mission, inputs.as_ref(), journal.as_ref())?;
    // A flight without an end has no score.
    let score = match judged.reliance {
        Reliance::Unfinished => None,
        Reliance::Good | Reliance::Bad => Some(scored(&stored)?.report.score),
    };
    let document = VerifyDocument {
        mission: Some(mission.id),
        seed: Some(head.seed),
        score,
        recorded_score: stored.end().map(|end| end.score),
        flown_by: head.flown_by.map(FlyingHand::from),
        profile: head.profile.clone(),
        when: Some(head.when.clone()),
        ..judged
    };
    let unproved = document.verdict.unproved();
    Ok(document.stating(unproved).with_faults(faults))
}

/// The journal of a record if it can be read, and its faults.
fn read_journal(files: &RecordFiles) -> (Option<Journal>, Vec<Text>) {
    let journal = match files.read_journal() {
        Ok(journal) => journal,
        Err(fault) => {
            let path = files.journal.as_deref().and_then(Path::file_name);
            let name = path.unwrap_or_default().to_string_lossy().into_owned();
            return (None, vec![Text::joined(": ", vec![name.into(), fault])]);
        }
    };
    // The run is compared with the journal as part of the verdict.
    let beside = JournalNeighbours {
        mission: None,
        first_unix_us: TlogSpan::of(files).map(|it| it.first_unix_us),
    };
    let misfit = |journal: &Journal| JournalFit::of(&journal.head, beside).fault();
    let misfit = journal.as_ref().and_then(misfit);
    let faults = journal.iter().flat_map(Journal::faults).chain(misfit);
    let found = faults.collect();
    (journal, found)
}

/// Compares a flight without a mission: there is no score, so only the flight itself is repeated.
fn judge_free(
    journal: Option<&Journal>,
    inputs: Option<&StoredInputs>,
) -> Result<VerifyDocument, Text> {
    let is_free = journal.is_none_or(|it| it.head.subject == Subject::Free);
    let (Some(inputs), true) = (inputs, is_free) else {
        return Err(text!("verify-no-inputs"));
    };
    if !inputs.has_fingerprints() {
        return Err(text!("verify-no-states"));
    }
    let difference = refly(&mut inputs.head.world(), inputs);
    let program = inputs.head.program.clone();
    let length = clock(inputs.lasts());
    let (verdict, words) = if inputs.is_whole() {
        let whole = text!("verify-verified-flight", length = length);
        (Verdict::Verified, whole)
    } else {
        let part = text!("verify-verified-part", length = length);
        (Verdict::VerifiedPart, part)
    };
    let document = match difference.or_else(|| contradiction(journal?, inputs)) {
        None => VerifyDocument {
            words,
            reliance: Reliance::Good,
            ..VerifyDocument::new(verdict, program)
        },
        Some(difference) => VerifyDocument::differing(difference, program),
    };
    Ok(document.stating(&["program"]))
}

/// The difference if the journal of a flight and its input log name different programs, or the journal has an end
/// that the log lacks.
fn contradiction(journal: &Journal, inputs: &StoredInputs) -> Option<Divergence> {
    let [one, other] = [&journal.head.program, &inputs.head.program].map(String::as_str);
    if one != other {
        return Some(at_the_start(text!(
            "verify-programs",
            one = one,
            other = other
        )));
    }
    (journal.is_whole() && !inputs.is_whole()).then(|| Divergence {
        at: inputs.lasts(),
        vehicle: None,
        what: text!("verify-no-end"),
    })
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
    journal: Option<&Journal>,
) -> Result<VerifyDocument, Text> {
    let head = &stored.head;
    if !is_known(head, mission) {
        return Ok(VerifyDocument::of_other_mission(stored));
    }
    let repeatable = inputs.filter(|_| head.backend == FlightBackend::Embedded);
    let verification = repeatable.map(|inputs| stored.verify(inputs)).transpose()?;
    let difference = verification
        .as_ref()
        .and_then(|it| it.difference.clone())
        .or_else(|| {
            let journal = journal.map(|it| &it.head);
            stored.misstatement(journal, inputs).map(at_the_start)
        });
    let program = head.program.clone();
    Ok(match (difference, verification) {
        (Some(difference), _) => VerifyDocument::differing(difference, program),
        (None, Some(verification)) => match verification.extent {
            RecordExtent::Whole => VerifyDocument {
                words: verified(stored, mission, verification.rescored.report.score),
                reliance: Reliance::Good,
                ..VerifyDocument::new(Verdict::Verified, program)
            },
            RecordExtent::Part { to, went_on } => {
                let is_left = !went_on && journal.is_some_and(Journal::is_whole);
                unfinished(stored, to, is_left)
            }
        },
        (None, None) => rescored(stored, program)?,
    })
}

/// Whether the mission in a record is this program's or the user's own, and matches the id and the
/// revision that the head states separately.
fn is_known(head: &Head, mission: &Mission) -> bool {
    match store::mission_file(mission) {
        MissionFile::Course | MissionFile::Own => {
            head.mission == mission.id && head.revision == mission.rev
        }
        MissionFile::OtherRevision | MissionFile::Altered => false,
    }
}

/// The result for a flight that matches its record as far as it goes. It has no score: it was left,
/// as its journal states, or the record was cut off.
fn unfinished(stored: &Stored, to: Duration, is_left: bool) -> VerifyDocument {
    let head = &stored.head;
    let (mission, seed) = (head.mission.as_str(), head.seed.to_string());
    let (verdict, words) = if is_left {
        let left = text!(
            "verify-left",
            at = clock(to),
            mission = mission,
            seed = seed
        );
        (Verdict::VerifiedLeft, left)
    } else {
        let cut = text!("verify-cut", at = clock(to), mission = mission, seed = seed);
        (Verdict::VerifiedCut, cut)
    };
    VerifyDocument {
        // The checksum would be in the end of the record, which is missing.
        words: Text::joined("\n", vec![words, text!("verify-no-checksum")]),
        to_s: Some(to.as_secs_f64()),
        reliance: Reliance::Unfinished,
        ..VerifyDocument::new(verdict, head.program.clone())
    }
}

/// The text for a flight that matches its record.
fn verified(stored: &Stored, mission: &Mission, score: u16) -> Text {
    let mut words = vec![text!(
        "verify-verified",
        mission = mission.id.as_str(),
        seed = stored.head.seed.to_string(),
        score = score
    )];
    if !stored.has_checksum() {
        words.push(text!("verify-no-checksum"));
    }
    if store::mission_file(mission) == MissionFile::Own {
        words.push(text!("verify-own-mission"));
    }
    Text::joined("\n", words)
}

/// The score that follows from a record, as the career counts it.
fn scored(stored: &Stored) -> Result<Rescored, Text> {
    let head = &stored.head;
    stored.rescore(without_end(head.stake, head.flown_by))
}

/// The result for a flight that cannot be repeated: one with ArduPilot, or one without its inputs.
fn rescored(stored: &Stored, program: String) -> Result<VerifyDocument, Text> {
    let Rescored { report, before } = scored(stored)?;
    let (score, backend) = (report.score, stored.head.backend);
    let is_same = before.is_some_and(|before| before.score == score);
    let result = match (backend, is_same) {
        (FlightBackend::Embedded, _) => text!("verify-inputs-missing", score = score),
        (FlightBackend::ArduPilot, true) => text!("verify-rescored", score = score),
        (FlightBackend::ArduPilot, false) => text!("verify-rescored-other", score = score),
    };
    let mut words = vec![result];
    if !stored.has_checksum() {
        words.push(text!("verify-no-checksum"));
    }
    Ok(VerifyDocument {
        words: Text::joined("\n", words),
        reliance: match backend {
            FlightBackend::ArduPilot if is_same => Reliance::Good,
            FlightBackend::ArduPilot | FlightBackend::Embedded => Reliance::Bad,
        },
        ..VerifyDocument::new(Verdict::Rescored, program)
    })
}
