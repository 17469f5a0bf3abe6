//! Lesson plans: TOML files with the steps of a lesson, which an instructor's desk goes through with its seats.
//!
//! A plan is read and checked at once, with the missions that its steps fly: conditions name only what the mission
//! has, injects are among those that it permits, and every way through the steps leads to an end.
//!
//! # How the parts fit
//! `written` is the file as it is written, `steps` reads its steps, `orders` their lines, and `ways` checks where the
//! steps lead. How a seat goes through a plan is in the library [`class`](crate::class).

use std::collections::BTreeMap;
use std::sync::Arc;

use toml::Spanned;

use crate::class::LessonPlan;
use crate::diagnostic::Diagnostic;
use crate::mission::Mission;
use crate::text;
use crate::text::{Language, Locale, Text};

mod orders;
mod steps;
mod ways;
mod written;

#[cfg(test)]
mod tests;

use written::WrittenLesson;

/// The version of the format.
const SCHEMA: i64 = 1;
/// The first-level keys of a plan, by which a file is known to be one.
pub const LESSON_KEYS: [&str; 6] = ["schema", "title", "title_uk", "about", "about_uk", "steps"];

/// A lesson with its texts.
#[derive(Debug, Clone, PartialEq)]
pub struct Lesson {
    pub plan: Arc<LessonPlan>,
    pub title: Text,
    /// What the lesson is for.
    pub about: Text,
    /// What the instructor reads at each step, in the order of the steps.
    pub notes: Vec<Text>,
    /// Texts without a translation, which are not faults.
    pub untranslated: Vec<Diagnostic>,
}

/// All lesson plans that can be read.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LessonList {
    pub good: Vec<Arc<Lesson>>,
    pub faulty: Vec<FaultyLesson>,
}

/// A lesson plan with faults.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FaultyLesson {
    pub name: String,
    /// The path of the plan, for `sortie check`.
    pub file: String,
}

/// The texts of the missions that lessons may fly, by id.
#[derive(Debug, Default)]
pub struct LessonMissions(BTreeMap<String, String>);

impl LessonMissions {
    /// The missions in these files; of several with the same id, the first one.
    pub fn of<'a>(texts: impl IntoIterator<Item = &'a str>) -> Self {
        let mut missions = BTreeMap::new();
        for text in texts {
            if let Some(id) = Mission::id_of(text) {
                missions.entry(id).or_insert_with(|| text.to_owned());
            }
        }
        Self(missions)
    }

    fn ids(&self) -> Vec<&str> {
        self.0.keys().map(String::as_str).collect()
    }

    /// The mission with this id; `None` if its file has faults, which are not those of the lesson.
    fn mission(&self, id: &str) -> Option<Mission> {
        Mission::parse(self.0.get(id)?).ok()
    }
}

/// What a plan is read with.
pub struct LessonSetting<'a> {
    pub missions: &'a LessonMissions,
    /// The language of the messages to trainees.
    pub locale: &'a Locale,
}

/// What is found while a plan is read.
#[derive(Debug, Default)]
pub(crate) struct Findings {
    pub(crate) faults: Vec<Diagnostic>,
    untranslated: Vec<Diagnostic>,
    is_translated: bool,
}

impl Lesson {
    /// Reads a lesson plan. `name` is the name by which the desk knows it.
    ///
    /// # Errors
    /// The faults with their positions: the first one of the structure, otherwise all.
    pub fn parse(
        name: &str,
        source: &str,
        setting: &LessonSetting<'_>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let written: WrittenLesson =
            toml::from_str(source).map_err(|error| vec![Diagnostic::from_toml(&error)])?;
        let mut findings = Findings::default();
        if *written.schema.get_ref() != SCHEMA {
            let found = *written.schema.get_ref();
            let fault = text!("lesson-schema", found = found, known = SCHEMA);
            findings.fault(written.schema.span(), fault);
        }
        let title = findings.text(&written.title, written.title_uk.as_ref(), "title_uk");
        let about = findings.text(&written.about, written.about_uk.as_ref(), "about_uk");
        let (steps, notes) = steps::read(&written.steps, setting, &mut findings);
        ways::check(&written.steps, &steps, &mut findings);
        let untranslated = findings.untranslated()?;
        let name = name.into();
        Ok(Self {
            plan: Arc::new(LessonPlan { name, steps }),
            title,
            about,
            notes,
            untranslated,
        })
    }
}

impl Findings {
    /// The texts without a translation.
    ///
    /// # Errors
    /// The faults, in the order of their places.
    pub(crate) fn untranslated(self) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
        let Self {
            mut faults,
            mut untranslated,
            is_translated,
        } = self;
        if !faults.is_empty() {
            faults.sort_by_key(|fault| fault.span.start);
            return Err(faults);
        }
        if !is_translated {
            untranslated.truncate(1);
            let all = |note: &mut Diagnostic| note.message = text!("lesson-english-only");
            untranslated.iter_mut().for_each(all);
        }
        Ok(untranslated)
    }

    pub(crate) fn fault(&mut self, place: std::ops::Range<usize>, message: Text) {
        self.faults.push(Diagnostic::new(place, message));
    }

    /// A text with its translation under the key `key`.
    pub(crate) fn text(
        &mut self,
        english: &Spanned<String>,
        ukrainian: Option<&Spanned<String>>,
        key: &str,
    ) -> Text {
        for text in std::iter::once(english).chain(ukrainian) {
            if text.get_ref().trim().is_empty() {
                self.fault(text.span(), text!("lesson-text-empty"));
            }
        }
        self.is_translated |= ukrainian.is_some();
        if ukrainian.is_none() {
            let note = text!("mission-untranslated", key = key);
            let note = Diagnostic::new(english.span(), note);
            self.untranslated.push(note);
        }
        let ukrainian = ukrainian.map(|words| (Language::Ukrainian, trimmed(words)));
        Text::written(trimmed(english), ukrainian)
    }
}

/// The words of a text, without the breaks of its lines.
fn trimmed(text: &Spanned<String>) -> String {
    let words: Vec<&str> = text.get_ref().split_whitespace().collect();
    words.join(" ")
}
