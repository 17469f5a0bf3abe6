//! The files of lesson plans.

use std::sync::Arc;

use crate::app::event::ClassEvent;
use crate::diagnostic::first_shown;
use crate::lesson_plan::{Lesson, LessonSetting};
use crate::shell::Console;
use crate::store::{self, Source};
use crate::text::{Locale, Text};

impl Console {
    /// Reads all lesson plans; those with faults are left out.
    pub(super) fn list_lessons(&mut self) {
        let missions = store::lesson_missions();
        let setting = LessonSetting {
            missions: &missions,
            locale: self.app.state().locale(),
        };
        let lessons = store::lessons().into_iter();
        let read = lessons.filter_map(|it| {
            let lesson = Lesson::parse(it.stem(), &it.text, &setting);
            let name = it.name.as_str();
            let read = lesson.inspect_err(|_| tracing::warn!(name, "a lesson plan has faults"));
            read.ok().map(Arc::new)
        });
        let read = read.collect();
        self.post(ClassEvent::Lessons(read));
    }

    /// Reads a lesson plan for seats.
    pub(super) fn read_lesson(&mut self, name: String, seats: Vec<usize>) {
        let lesson = read(&name, self.app.state().locale());
        self.post(ClassEvent::LessonRead {
            lesson: lesson.map(Arc::new),
            name,
            seats,
        });
    }
}

/// A lesson plan by its name or its path.
fn read(name: &str, locale: &Locale) -> Result<Lesson, Text> {
    let source = store::lesson(name).map_err(|error| Text::from(&error))?;
    let missions = store::lesson_missions();
    let setting = LessonSetting {
        missions: &missions,
        locale,
    };
    let known_as = known_as(name, &source);
    Lesson::parse(&known_as, &source.text, &setting).map_err(|faults| {
        let (shown, rest) = first_shown(&faults);
        let lines = shown.iter().map(|it| it.text(&source.name, &source.text));
        Text::joined("\n", lines.chain(rest).collect())
    })
}

/// The name under which journals know a plan, and under which a desk that is opened elsewhere finds it again.
fn known_as(name: &str, source: &Source) -> String {
    match std::path::absolute(&source.name) {
        Ok(path) if path.is_file() && name.contains(['/', '.']) => path.display().to_string(),
        _ => source.stem().to_owned(),
    }
}
