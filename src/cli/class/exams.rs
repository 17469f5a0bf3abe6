//! `sortie class exams` and `sortie class key`: the exams, and the key that seals their results.

use std::process::ExitCode;

use crate::cli::Failure;
use crate::cli::settings::CliSettings;
use crate::exam_plan::ExamFile;
use crate::store::{self, DeskKey};
use crate::text;
use crate::text::{Locale, Text};

/// Prints the exams, one per line; of one with faults, why it cannot be held.
pub(super) fn exams(settings: &CliSettings) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let course = store::course();
    say!("{}", locale.text(&text!("exams-title")))?;
    let mut is_faulty = false;
    for source in store::exams() {
        let name = source.stem();
        match ExamFile::parse(name, &source.text, &course) {
            Ok(exam) => {
                let (title, about) = (exam.title, exam.about);
                let line = text!(
                    "class-lesson-named",
                    name = name,
                    title = title,
                    about = about
                );
                say!("{}", locale.text(&line))?;
            }
            Err(faults) => {
                is_faulty = true;
                for fault in &faults {
                    let line: Text = fault.text(&source.name, &source.text);
                    tell!("sortie: {}", locale.text(&line));
                }
            }
        }
    }
    Ok(ExitCode::from(u8::from(is_faulty)))
}

/// Prints the public key of the desk.
pub(super) fn key(settings: &CliSettings) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let Some(public) = settings.data.path().and_then(DeskKey::public_in) else {
        let none = locale.text(&text!("class-key-none"));
        return Err(Failure::Invalid(format!("sortie: {none}")));
    };
    let fingerprint = DeskKey::fingerprint(&public);
    let key = text!("class-key-public", key = public);
    say!("{}", locale.text(&key))?;
    let line = text!("class-key-fingerprint", fingerprint = fingerprint);
    say!("{}", locale.text(&line))?;
    Ok(ExitCode::SUCCESS)
}
