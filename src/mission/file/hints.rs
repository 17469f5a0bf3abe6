//! `[[hints]]`: advice that is shown by itself, or given when it is asked for.

use serde::Deserialize;
use toml::Spanned;

use super::{Draft, Faults};
use crate::mission::{Clue, Hint, NEXT_CELL, Phase};

/// Advice as the file has it: shown by itself, or to be asked for.
pub(super) enum Advice {
    Shown(Hint),
    Asked(Clue),
}

/// One `[[hints]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct HintFile {
    phase: Option<Phase>,
    level: Option<Spanned<u8>>,
    objective: Option<Spanned<String>>,
    text: Spanned<String>,
    text_uk: Option<Spanned<String>>,
}

impl HintFile {
    /// It, if it can be given; what is wrong with it is added.
    pub fn checked(self, draft: &Draft, faults: &mut Faults) -> Option<Advice> {
        let no_cells = draft.surveys.is_empty() && faults.found.is_empty();
        for written in std::iter::once(&self.text).chain(&self.text_uk) {
            let text = written.get_ref();
            let rest = text.replace(NEXT_CELL, "");
            if rest.contains(['{', '}']) {
                let message = format!("a hint knows one placeholder only: `{NEXT_CELL}`");
                faults.add(written.span(), message);
            }
            if rest.len() < text.len() && no_cells {
                let message = format!("`{NEXT_CELL}` needs an objective of kind `sample_cells`");
                faults.add(written.span(), message);
            }
        }
        let place = self.text.span();
        let text = faults.written(self.text, self.text_uk, "text_uk");
        let Some(level) = self.level else {
            // Shown by itself, so it has to be said when.
            let Some(phase) = self.phase else {
                faults.add(place, "a hint needs a `phase` to be shown in, or a `level`");
                return None;
            };
            return Some(Advice::Shown(Hint { phase, text }));
        };
        if !(1..=3).contains(level.get_ref()) {
            faults.add(level.span(), "`level` must be 1, 2 or 3");
        }
        if let Some(id) = &self.objective
            && !draft.declared.contains(id.get_ref())
        {
            let known: Vec<&str> = draft.declared.iter().map(String::as_str).collect();
            faults.unknown("objective", id, &known);
        }
        Some(Advice::Asked(Clue {
            level: level.into_inner(),
            phase: self.phase,
            objective: self.objective.map(Spanned::into_inner),
            text,
        }))
    }
}
