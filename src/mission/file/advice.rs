//! `[[hints]]`: advice shown automatically, or on request.

use super::condition::condition;
use crate::mission::format::{FileTable, NameKind, text, whole, word};
use crate::mission::{Clue, Hint, MissionAdvice, NEXT_CELL, Phase};
use crate::text;
use crate::text::Text;

/// One piece of advice of either kind.
pub(super) enum OneAdvice {
    Shown(Hint),
    Asked(Clue),
}

/// Separates automatic advice from advice on request.
pub(super) fn of(all: Vec<OneAdvice>) -> MissionAdvice {
    let mut advice = MissionAdvice {
        gives_hints: true,
        ..MissionAdvice::default()
    };
    for one in all {
        match one {
            OneAdvice::Shown(hint) => advice.hints.push(hint),
            OneAdvice::Asked(clue) => advice.clues.push(clue),
        }
    }
    advice
}

pub(super) fn advice(table: &mut FileTable<'_>) -> Option<OneAdvice> {
    let phase = table.may(
        "phase",
        word(&Phase::WORDS),
        "without `level`, the hint appears automatically in this phase: on the ground, armed, in the air, or with only the landing left",
    );
    let level = table.may(
        "level",
        whole(1, 3, ""),
        "the trainee has to request the hint (`1 hint`), which costs a share of the score: 1 (a question to think about) \
         2 %, 2 (where to look) 5 %, 3 (how to do it) 10 %, and at most 30 % in all; on the first try only 3 costs \
         points, and in missions of tier 0 none does; the lowest level is given first",
    );
    let objective_form = text("id of an objective");
    let objective = table.may(
        "objective",
        objective_form,
        "the hint is available until this is met",
    );
    let until = table.may(
        "until",
        condition(),
        "a condition as in events; of the automatic hints of a phase, the first whose `until` does not hold \
         is shown",
    );
    let text = hint_text(table)?;
    let Some(level) = level else {
        // Automatic advice needs a phase.
        let Some(phase) = phase else {
            table.fault_of("text", text!("fault-hint-phase"));
            return None;
        };
        return Some(OneAdvice::Shown(Hint { phase, until, text }));
    };
    if until.is_some() {
        table.fault_of("until", text!("fault-hint-until"));
    }
    if let Some(id) = &objective {
        table.draft().check_declared(NameKind::Objective, id);
    }
    Some(OneAdvice::Asked(Clue {
        // At most 3, so it fits.
        level: u8::try_from(level).unwrap_or(u8::MAX),
        phase,
        objective: objective.map(toml::Spanned::into_inner),
        text,
    }))
}

/// The text of a hint; only the next cell to sample may be left open in it.
fn hint_text(table: &mut FileTable<'_>) -> Option<Text> {
    let english = table.need(
        "text",
        text(""),
        "text of the hint; `{next_cell}` is replaced by the next cell to sample",
    );
    let ukrainian = table.may("text_uk", text(""), "the same in Ukrainian");
    let no_cells = table.draft().surveys.is_empty() && table.draft().faults.is_empty();
    for written in english.iter().chain(&ukrainian) {
        let text = written.get_ref();
        let rest = text.replace(NEXT_CELL, "");
        if rest.contains(['{', '}']) {
            let message = text!("fault-hint-placeholder", known = NEXT_CELL);
            table.draft().faults.add(written.span(), message);
        }
        if rest.len() < text.len() && no_cells {
            let message = text!("fault-hint-cells", known = NEXT_CELL);
            table.draft().faults.add(written.span(), message);
        }
    }
    let faults = &mut table.draft().faults;
    Some(faults.translated(english?, ukrainian, "text_uk"))
}
