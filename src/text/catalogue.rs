//! The messages of each language: one file per subject.

use super::Language;

macro_rules! catalogue {
    ($($area:literal),* $(,)?) => {
        const ENGLISH: &[(&str, &str)] = &[
            $(($area, include_str!(concat!("../../locales/en/", $area, ".ftl")))),*
        ];
        const UKRAINIAN: &[(&str, &str)] = &[
            $(($area, include_str!(concat!("../../locales/uk/", $area, ".ftl")))),*
        ];
    };
}

catalogue! {
    "alerts",
    "api",
    "basics",
    "bench",
    "campaign",
    "career",
    "class",
    "common",
    "config",
    "console",
    "crew",
    "debrief",
    "doctor",
    "drafts",
    "exams",
    "faults",
    "fleet",
    "fly",
    "ftp",
    "grading",
    "hangar",
    "hazards",
    "logs",
    "home",
    "lessons",
    "links",
    "signing",
    "map",
    "messages",
    "mission",
    "parameters",
    "plain",
    "plans",
    "rooms",
    "scoring",
    "standing",
    "swarm",
    "terminal",
    "threats",
    "vehicle",
    "files",
    "finds",
    "grammar",
    "outcomes",
    "refusals",
    "replay",
    "review",
    "telemetry",
    "transport",
    "verbs",
    "watching",
    "workshop",
}

/// The message files of a language: subject and contents.
pub fn messages(language: Language) -> &'static [(&'static str, &'static str)] {
    match language {
        Language::English => ENGLISH,
        Language::Ukrainian => UKRAINIAN,
    }
}
