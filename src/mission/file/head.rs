//! The keys of a mission file before its first section.

use toml::Spanned;
use toml::de::DeValue;

use crate::mission::MissionSummary;
use crate::mission::format::{Draft, FileShape, FileTable, FileValue, list, text_by, whole};
use crate::text;
use crate::text::Text;

/// The only version of the format.
const SCHEMA: u32 = 1;
/// The maximum number of tags, and the maximum number of authors, that a mission may have.
const MOST_NAMES: usize = 20;

/// The keys before the first section.
pub(super) struct FileHead {
    pub id: String,
    pub rev: u32,
    pub title: Text,
    pub summary: MissionSummary,
}

impl FileHead {
    pub fn need(table: &mut FileTable<'_>) -> Option<Self> {
        let schema = table.need("schema", SchemaVersion, "version of the format");
        let id_form = mission_id();
        let id = table.need(
            "id",
            id_form,
            "unique id; in shipped missions, the file name without its ending",
        );
        let rev = table.need(
            "rev",
            whole(0, u32::MAX, ""),
            "results are compared only within one revision; raise it when a change makes the mission harder or easier",
        );
        let title = title(table);
        let brief = table.need_text("brief", "briefing text, shown before takeoff");
        let tier = table.or(
            "tier",
            whole(0, 255, ""),
            0,
            "difficulty, 0 (first steps) to 3",
        );
        let mut names = |key, about| {
            let names = list(
                text_by("up to 60 characters", is_short, TOO_LONG),
                0,
                MOST_NAMES,
            );
            table.may(key, names, about).unwrap_or_default()
        };
        let tags = names("tags", "subjects of the mission");
        let authors = names("authors", "names of the authors");
        let drill_of = table.may(
            "drill_of",
            mission_id(),
            "id of the mission that this drill prepares for",
        );
        if drill_of.is_some() && drill_of == id {
            table.fault_of("drill_of", text!("fault-own-drill"));
        }
        schema?;
        // At most 255, so it fits.
        let tier = u8::try_from(tier).unwrap_or(u8::MAX);
        table.draft().tier = tier;
        Some(Self {
            id: id?.into_inner(),
            rev: rev?,
            title: title?,
            summary: MissionSummary {
                brief: brief?,
                tier,
                tags: tags.into_iter().map(Spanned::into_inner).collect(),
                authors: authors.into_iter().map(Spanned::into_inner).collect(),
                drill_of: drill_of.map(Spanned::into_inner),
            },
        })
    }
}

fn title(table: &mut FileTable<'_>) -> Option<Text> {
    const FORM: &str = "1 to 60 characters";
    let fits = |title: &str| !title.is_empty() && is_short(title);
    let english_form = text_by(FORM, fits, "fault-title");
    let english = table.need("title", english_form, "title shown to trainees");
    let ukrainian_form = text_by(FORM, fits, "fault-title-uk");
    let ukrainian = table.may("title_uk", ukrainian_form, "the same in Ukrainian");
    let faults = &mut table.draft().faults;
    Some(faults.translated(english?, ukrainian, "title_uk"))
}

const TOO_LONG: &str = "fault-name-long";

fn is_short(name: &str) -> bool {
    name.chars().count() <= 60
}

/// The value of a mission's id, with the rule for its characters.
pub(super) const fn mission_id() -> crate::mission::format::TextValue {
    text_by(
        "1 to 40 lower-case letters, digits and `-`",
        is_mission_id,
        "fault-mission-id",
    )
}

/// Whether a text is valid as a mission's id.
pub(super) fn is_mission_id(id: &str) -> bool {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    (1..=40).contains(&id.len()) && id.chars().all(plain)
}

/// The version of the format; this program reads only one.
struct SchemaVersion;

impl FileValue for SchemaVersion {
    type Out = ();

    fn shape(&self) -> FileShape {
        FileShape::Whole(SCHEMA, SCHEMA, "")
    }

    fn read(&self, _: &str, written: Spanned<DeValue<'_>>, draft: &mut Draft) -> Option<()> {
        let place = written.span();
        let version: u32 = draft.faults.read(written)?;
        if version != SCHEMA {
            let fault = text!("fault-schema", known = SCHEMA);
            draft.faults.add(place, fault);
        }
        Some(())
    }
}
