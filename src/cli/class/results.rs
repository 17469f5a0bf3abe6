//! The results of a class from the records of the instructor's data folder.

use std::time::{SystemTime, UNIX_EPOCH};

use crate::campaign::MissionCourse;
use crate::carrier::own_user_name;
use crate::class_results::{ClassResults, ClassTrainee, TryWithoutRecord};
use crate::cli::Failure;
use crate::cli::settings::CliSettings;
use crate::store::{self, ClassRecords, ExamNotes, class_trainees, day_of};
use crate::text;
use crate::text::Locale;

/// A class whose records were read.
pub(super) struct ReadClass {
    /// The name of the class.
    pub name: String,
    pub trainees: Vec<ClassTrainee>,
    /// The tries of exams of which no record was handed in.
    pub missing: Vec<TryWithoutRecord>,
    pub course: MissionCourse,
    /// The present day, in days since 1970 (UTC).
    pub day: i64,
    pub locale: Locale,
}

/// The name of the class at a path, or with a name.
pub(super) fn class_name(name_or_path: &str) -> &str {
    let mut parts = name_or_path.rsplit('/');
    parts.find(|it| !it.is_empty()).unwrap_or(name_or_path)
}

/// The name and the records of a class, by default the user's own.
///
/// # Errors
/// Nothing was ever handed in to the class.
pub(super) fn records_of(
    named: Option<&str>,
    settings: &CliSettings,
    locale: &Locale,
) -> Result<(String, ClassRecords), Failure> {
    settings.data.require(locale)?;
    let refused = |text| Failure::Invalid(format!("sortie: {}", locale.text(&text)));
    let data = settings.data.path();
    let data = data.ok_or_else(|| refused(text!("career-nowhere")))?;
    let own = own_user_name();
    let name = class_name(named.unwrap_or(&own));
    let records = ClassRecords::within(data, name);
    if !records.exist() {
        let known = ClassRecords::classes(data);
        return Err(refused(if known.is_empty() {
            text!("class-no-records", class = name)
        } else {
            text!(
                "class-no-records-known",
                class = name,
                known = known.join(", ")
            )
        }));
    }
    Ok((name.to_owned(), records))
}

/// The present time, in seconds since 1970.
fn since_1970() -> u64 {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    since.unwrap_or_default().as_secs()
}

impl ReadClass {
    /// Reads the records of the class with this name, by default the user's own; names those that cannot be read.
    ///
    /// # Errors
    /// Nothing was ever handed in to the class.
    pub fn read(named: Option<&str>, settings: &CliSettings) -> Result<Self, Failure> {
        let locale = Locale::new(settings.language());
        let (name, records) = records_of(named, settings, &locale)?;
        let course = store::course();
        let (exams, damaged) = ExamNotes::of(&records).all(&course, 0);
        let (trainees, faults) = class_trainees(&records, &exams);
        for fault in damaged.into_iter().chain(faults) {
            tell!("sortie: {}", locale.text(&fault));
        }
        Ok(Self {
            name,
            missing: TryWithoutRecord::of(&exams, &trainees, since_1970()),
            trainees,
            course,
            day: day_of(SystemTime::now()),
            locale,
        })
    }

    pub fn results(&self) -> ClassResults {
        ClassResults::of(&self.course, &self.trainees, self.day)
    }
}
