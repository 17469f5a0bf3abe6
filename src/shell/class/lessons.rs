//! The files of lesson plans.

use std::sync::Arc;

use crate::app::event::ClassEvent;
use crate::diagnostic::first_shown;
use crate::lesson_plan::{FaultyLesson, Lesson, LessonList, LessonSetting};
use crate::shell::Console;
use crate::store::{self, Source};
use crate::text::{Locale, Text};

impl Console {
    /// Reads all lesson plans.
    pub(super) fn list_lessons(&mut self) {
        let missions = store::lesson_missions();
        let setting = LessonSetting {
            missions: &missions,
            locale: self.app.state().locale(),
        };
        let mut list = LessonList::default();
        for it in store::lessons() {
            let name = it.stem();
            match Lesson::parse(name, &it.text, &setting) {
                Ok(lesson) => list.good.push(Arc::new(lesson)),
                Err(_) => list.faulty.push(FaultyLesson {
                    name: name.to_owned(),
                    file: it.name,
                }),
            }
        }
        self.post(ClassEvent::Lessons(list));
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
