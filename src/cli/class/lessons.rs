//! `sortie class lessons`: the lesson plans.

use std::process::ExitCode;

use crate::cli::Failure;
use crate::cli::settings::CliSettings;
use crate::lesson_plan::{Lesson, LessonSetting};
use crate::store;
use crate::text;
use crate::text::{Locale, Text};

/// Prints the lesson plans, one per line; of one with faults, why it cannot be begun.
pub(super) fn lessons(settings: &CliSettings) -> Result<ExitCode, Failure> {
    let locale = Locale::new(settings.language());
    let missions = store::lesson_missions();
    let setting = LessonSetting {
        missions: &missions,
        locale: &locale,
    };
    say!("{}", locale.text(&text!("lessons-title")))?;
    let mut is_faulty = false;
    for source in store::lessons() {
        let name = source.stem();
        match Lesson::parse(name, &source.text, &setting) {
            Ok(lesson) => {
                let line = text!(
                    "class-lesson-named",
                    name = name,
                    title = lesson.title,
                    about = lesson.about
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
