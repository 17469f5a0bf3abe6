//! Rubrics: TOML files with the categories and elements that an instructor grades.

use serde::Deserialize;
use toml::Spanned;

use super::EvidenceKind;
use crate::diagnostic::Diagnostic;
use crate::lesson_plan::Findings;
use crate::text;
use crate::text::Text;

/// The version of the format.
const SCHEMA: i64 = 1;
/// The first-level keys of a rubric, by which a file is known to be one.
pub const RUBRIC_KEYS: [&str; 6] = [
    "schema",
    "title",
    "title_uk",
    "about",
    "about_uk",
    "categories",
];
/// The permitted numbers of categories: an instructor cannot keep more in mind during a flight.
const CATEGORIES: std::ops::RangeInclusive<usize> = 4..=6;
/// The maximum number of elements in a category.
const MOST_ELEMENTS: usize = 9;

/// The categories and elements that are graded.
#[derive(Debug, Clone, PartialEq)]
pub struct Rubric {
    /// The name under which grades refer to it.
    pub name: String,
    pub title: Text,
    /// What the rubric is for.
    pub about: Text,
    pub categories: Vec<RubricCategory>,
    /// Texts without a translation, which are not faults.
    pub untranslated: Vec<Diagnostic>,
}

/// Elements that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct RubricCategory {
    pub id: String,
    pub title: Text,
    pub elements: Vec<RubricElement>,
}

/// What gets one grade.
#[derive(Debug, Clone, PartialEq)]
pub struct RubricElement {
    pub id: String,
    pub title: Text,
    /// What is observed if the trainee does it well.
    pub good: Vec<Text>,
    /// What is observed if the trainee does it poorly.
    pub poor: Vec<Text>,
    /// What the record is asked for.
    pub evidence: Vec<EvidenceKind>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenRubric {
    schema: Spanned<i64>,
    title: Spanned<String>,
    title_uk: Option<Spanned<String>>,
    about: Spanned<String>,
    about_uk: Option<Spanned<String>>,
    categories: Spanned<Vec<WrittenCategory>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenCategory {
    id: Spanned<String>,
    title: Spanned<String>,
    title_uk: Option<Spanned<String>>,
    elements: Spanned<Vec<WrittenElement>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenElement {
    id: Spanned<String>,
    title: Spanned<String>,
    title_uk: Option<Spanned<String>>,
    good: Spanned<Vec<Spanned<String>>>,
    good_uk: Option<Spanned<Vec<Spanned<String>>>>,
    poor: Spanned<Vec<Spanned<String>>>,
    poor_uk: Option<Spanned<Vec<Spanned<String>>>>,
    #[serde(default)]
    evidence: Vec<Spanned<String>>,
}

impl Rubric {
    /// Reads a rubric. `name` is the name under which grades refer to it.
    ///
    /// # Errors
    /// The faults with their positions: the first one of the structure, otherwise all.
    pub fn parse(name: &str, source: &str) -> Result<Self, Vec<Diagnostic>> {
        let written: WrittenRubric =
            toml::from_str(source).map_err(|error| vec![Diagnostic::from_toml(&error)])?;
        let mut findings = Findings::default();
        if *written.schema.get_ref() != SCHEMA {
            let found = *written.schema.get_ref();
            let fault = text!("rubric-schema", found = found, known = SCHEMA);
            findings.fault(written.schema.span(), fault);
        }
        let title = findings.text(&written.title, written.title_uk.as_ref(), "title_uk");
        let about = findings.text(&written.about, written.about_uk.as_ref(), "about_uk");
        let all = written.categories.get_ref();
        if !CATEGORIES.contains(&all.len()) {
            let fault = text!("rubric-categories", found = all.len());
            findings.fault(written.categories.span(), fault);
        }
        let mut ids = Ids::default();
        let categories = all
            .iter()
            .map(|it| it.read(&mut ids, &mut findings))
            .collect();
        Ok(Self {
            name: name.to_owned(),
            title,
            about,
            categories,
            untranslated: findings.untranslated()?,
        })
    }

    /// The elements of all categories, in their order.
    pub fn elements(&self) -> impl Iterator<Item = &RubricElement> {
        self.categories.iter().flat_map(|it| &it.elements)
    }
}

/// The ids that a file has used so far.
#[derive(Default)]
struct Ids(Vec<String>);

impl Ids {
    /// An id, which must be a short word, and the only one of its kind.
    fn take(&mut self, written: &Spanned<String>, findings: &mut Findings) -> String {
        let id = written.get_ref().clone();
        let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        if id.is_empty() || id.len() > 24 || !id.chars().all(is_plain) {
            findings.fault(written.span(), text!("rubric-id"));
        } else if self.0.contains(&id) {
            findings.fault(written.span(), text!("rubric-id-twice", id = id.as_str()));
        }
        self.0.push(id.clone());
        id
    }
}

impl WrittenCategory {
    fn read(&self, ids: &mut Ids, findings: &mut Findings) -> RubricCategory {
        let all = self.elements.get_ref();
        if all.is_empty() || all.len() > MOST_ELEMENTS {
            let fault = text!("rubric-elements", found = all.len(), most = MOST_ELEMENTS);
            findings.fault(self.elements.span(), fault);
        }
        RubricCategory {
            id: ids.take(&self.id, findings),
            title: findings.text(&self.title, self.title_uk.as_ref(), "title_uk"),
            elements: all.iter().map(|it| it.read(ids, findings)).collect(),
        }
    }
}

impl WrittenElement {
    fn read(&self, ids: &mut Ids, findings: &mut Findings) -> RubricElement {
        RubricElement {
            id: ids.take(&self.id, findings),
            title: findings.text(&self.title, self.title_uk.as_ref(), "title_uk"),
            good: markers(&self.good, self.good_uk.as_ref(), "good_uk", findings),
            poor: markers(&self.poor, self.poor_uk.as_ref(), "poor_uk", findings),
            evidence: self.evidence_kinds(findings),
        }
    }

    fn evidence_kinds(&self, findings: &mut Findings) -> Vec<EvidenceKind> {
        let mut kinds = Vec::new();
        for written in &self.evidence {
            let word = written.get_ref().as_str();
            let known = EvidenceKind::by_name(word);
            if known.is_none() {
                let fault = Diagnostic::new(written.span(), text!("rubric-evidence", name = word));
                let names = EvidenceKind::named().map(|(name, _)| name);
                findings.faults.push(fault.with_nearest(word, names));
            }
            kinds.extend(known);
        }
        kinds
    }
}

/// Observable markers with their translations.
fn markers(
    english: &Spanned<Vec<Spanned<String>>>,
    ukrainian: Option<&Spanned<Vec<Spanned<String>>>>,
    key: &str,
    findings: &mut Findings,
) -> Vec<Text> {
    let all = english.get_ref();
    if all.is_empty() {
        findings.fault(english.span(), text!("rubric-markers"));
    }
    if let Some(translated) = ukrainian
        && translated.get_ref().len() != all.len()
    {
        let count = translated.get_ref().len();
        let fault = text!("rubric-translations", found = count, count = all.len());
        findings.fault(translated.span(), fault);
    }
    let translations = ukrainian.map(Spanned::get_ref);
    let translation = |at: usize| translations.and_then(|all| all.get(at));
    (0..)
        .zip(all)
        .map(|(at, text)| findings.text(text, translation(at), key))
        .collect()
}

#[cfg(test)]
mod tests;
