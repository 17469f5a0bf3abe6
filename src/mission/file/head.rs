//! What stands in a mission file before its first section.

use serde::Deserialize;
use toml::Spanned;

use super::Faults;

/// The only version of the format so far.
const SCHEMA: u32 = 1;
/// Tags, and authors.
const MOST_NAMES: usize = 20;
/// Characters of one of them.
const LONGEST_NAME: usize = 60;

/// What stands before the first section.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HeadFile {
    schema: Spanned<u32>,
    pub id: Spanned<String>,
    pub rev: u32,
    pub title: Spanned<String>,
    pub title_uk: Option<Spanned<String>>,
    #[serde(default)]
    pub tier: u8,
    #[serde(default = "none")]
    pub tags: Spanned<Vec<String>>,
    #[serde(default = "none")]
    pub authors: Spanned<Vec<String>>,
    pub brief: Spanned<String>,
    pub brief_uk: Option<Spanned<String>>,
    pub drill_of: Option<Spanned<String>>,
}

impl HeadFile {
    /// The same; faults in it have been added.
    pub fn checked(self, faults: &mut Faults) -> Self {
        if *self.schema.get_ref() != SCHEMA {
            faults.add(
                self.schema.span(),
                format!("this program reads schema {SCHEMA} only"),
            );
        }
        for id in std::iter::once(&self.id).chain(&self.drill_of) {
            if !is_mission_id(id.get_ref()) {
                faults.add(
                    id.span(),
                    "a mission's id is 1 to 40 small letters, digits and `-`",
                );
            }
        }
        if let Some(of) = self.drill_of.as_ref().filter(|of| **of == self.id) {
            faults.add(of.span(), "a mission is no drill of itself");
        }
        self.check_names(faults);
        for (title, key) in [
            (Some(&self.title), "title"),
            (self.title_uk.as_ref(), "title_uk"),
        ] {
            let Some(title) = title else { continue };
            if !(1..=60).contains(&title.get_ref().chars().count()) {
                let fault = format!("`{key}` must have 1 to 60 characters");
                faults.add(title.span(), fault);
            }
        }
        self
    }

    /// Tags and authors.
    fn check_names(&self, faults: &mut Faults) {
        for names in [&self.tags, &self.authors] {
            let long = |name: &String| name.chars().count() > LONGEST_NAME;
            if names.get_ref().len() > MOST_NAMES || names.get_ref().iter().any(long) {
                let fault = format!("{MOST_NAMES} names of {LONGEST_NAME} characters are the most");
                faults.add(names.span(), fault);
            }
        }
    }
}

fn none() -> Spanned<Vec<String>> {
    Spanned::new(0..0, Vec::new())
}

/// Whether it can name a mission.
pub(super) fn is_mission_id(id: &str) -> bool {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    (1..=40).contains(&id.len()) && id.chars().all(plain)
}
