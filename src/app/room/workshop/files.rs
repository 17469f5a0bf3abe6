//! Designs by name, and in files.

use super::shelf::{self, ListedDesign};
use crate::app::State;
use crate::app::action::{Action, WorkshopAction};
use crate::app::effect::{CareerEffect, Effect, Effects, FileEffect, FileKind};
use crate::app::state::{Consequence, Purpose};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;
use crate::workshop::Design;

/// Asks for the name under which to store the design.
pub(super) fn ask_save(state: &mut State) {
    if state.training.career.is_none() {
        let key = state.key(Action::Workshop(WorkshopAction::ExportDesign));
        return state.say(Severity::Warning, text!("bench-no-profile", key = key));
    }
    let name = state.rooms.workshop.bench.design().name.clone();
    state.prompt(Purpose::SaveDesign, name);
}

/// Asks for the name of a copy of `design`, or of the design on the bench if it is `None`.
pub(super) fn ask_copy(state: &mut State, design: Option<Design>) {
    if state.training.career.is_none() {
        let key = state.key(Action::Workshop(WorkshopAction::ExportDesign));
        return state.say(Severity::Warning, text!("bench-no-profile", key = key));
    }
    let bench = &state.rooms.workshop.bench;
    let name = design.unwrap_or_else(|| bench.design().clone()).name;
    let entered = format!("{name} 2");
    state.prompt(Purpose::CopyDesign(name), entered);
}

/// Asks for a new name for `design`, or for the design on the bench if it is `None`.
pub(super) fn ask_rename(state: &mut State, design: Option<Design>) {
    let bench = &state.rooms.workshop.bench;
    let name = design.unwrap_or_else(|| bench.design().clone()).name;
    state.prompt(Purpose::RenameDesign(name.clone()), name);
}

/// Asks for the name of a copy of the design under the list's cursor.
pub(super) fn ask_copy_listed(state: &mut State) {
    if let Some(listed) = shelf::under_cursor(state) {
        ask_copy(state, Some(listed.design));
    }
}

/// Asks for another name for the design under the list's cursor.
pub(super) fn ask_rename_listed(state: &mut State) {
    match shelf::under_cursor(state) {
        Some(ListedDesign {
            design,
            is_own: true,
        }) => ask_rename(state, Some(design)),
        Some(_) => shelf::refuse(state),
        None => {}
    }
}

/// Asks for the file to write the design to.
pub(super) fn ask_export(state: &mut State) {
    let name = &state.rooms.workshop.bench.design().name;
    let letter = |c: char| {
        if c.is_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '-'
        }
    };
    let path = format!("{}.toml", name.chars().map(letter).collect::<String>());
    state.prompt(Purpose::ExportDesign, path);
}

/// Asks for a file to read a design from.
pub(super) fn ask_import(state: &mut State) {
    state.prompt(Purpose::ImportDesign, "");
}

/// Stores the design under a name. Another design of that name is replaced only after a question.
///
/// # Errors
/// The name is not valid.
pub fn saved_as(state: &mut State, name: &str) -> Result<Effects, Text> {
    let design = state.rooms.workshop.bench.design().named(name)?;
    let bench = &mut state.rooms.workshop.bench;
    let origin = bench.origin().map(str::to_owned);
    let is_other = origin.as_deref() != Some(design.name.as_str());
    bench.rename(design.clone(), origin);
    if is_other && is_taken(state, &design.name) {
        ask_overwrite(state, design);
        return Ok(Effects::none());
    }
    state.say(
        Severity::Notice,
        text!("bench-saved", name = design.name.as_str()),
    );
    Ok(Effects::from(Effect::Career(CareerEffect::KeepDesign(
        design,
    ))))
}

/// Stores a copy of a design under another name; if the design is on the bench, the copy replaces
/// it there.
///
/// # Errors
/// The name is not valid, or is taken.
pub fn copied(state: &mut State, of: &str, name: &str) -> Result<Effects, Text> {
    let bench = &state.rooms.workshop.bench;
    let is_listed = state.rooms.workshop.page == super::Page::Designs;
    let listed = named(state, of).filter(|_| is_listed).cloned();
    let is_bench = listed.is_none();
    let copy = listed
        .unwrap_or_else(|| bench.design().clone())
        .named(name)?;
    if is_taken(state, &copy.name) {
        return Err(text!("bench-name-taken", name = copy.name.as_str()));
    }
    if is_bench {
        state.rooms.workshop.bench.rename(copy.clone(), None);
    }
    let name = copy.name.as_str();
    state.say(Severity::Notice, text!("bench-saved", name = name));
    Ok(Effects::from(Effect::Career(CareerEffect::KeepDesign(
        copy,
    ))))
}

/// Renames one of the trainee's own designs, also on the bench.
///
/// # Errors
/// The name is not valid, or taken.
pub fn renamed(state: &mut State, old: &str, name: &str) -> Result<Effects, Text> {
    let bench = &state.rooms.workshop.bench;
    let is_listed = state.rooms.workshop.page == super::Page::Designs;
    let is_bench = bench.design().name == old;
    let stored_as = if is_listed { Some(old) } else { bench.origin() };
    let kept = stored_as
        .and_then(|stored_as| own(state, stored_as))
        .cloned();
    let design = bench.design().named(name)?;
    let name = design.name.clone();
    let is_same = kept.as_ref().is_some_and(|kept| same(&kept.name, &name));
    if !is_same && is_taken(state, &name) {
        return Err(text!("bench-name-taken", name = name));
    }
    if is_bench {
        let origin = kept.as_ref().map(|_| name.clone());
        state.rooms.workshop.bench.rename(design, origin);
    }
    let Some(kept) = kept.filter(|kept| kept.name != name) else {
        return Ok(Effects::none());
    };
    let design = kept.named(&name)?;
    Ok(Effects::from(Effect::Career(CareerEffect::RenameDesign {
        from: kept.name,
        design,
    })))
}

/// Writes the design to a file.
///
/// # Errors
/// The path is empty.
pub fn exported(state: &State, path: &str) -> Result<Effects, Text> {
    Ok(Effects::from(Effect::File(FileEffect::Write {
        kind: FileKind::Design,
        path: path_of(path)?,
        text: state.rooms.workshop.bench.design().to_toml(),
        replace: false,
    })))
}

/// Reads a design from a file.
///
/// # Errors
/// The path is empty.
pub fn imported(path: &str) -> Result<Effects, Text> {
    Ok(Effects::from(Effect::File(FileEffect::Read {
        kind: FileKind::Design,
        path: path_of(path)?,
    })))
}

/// Handles a file that has been read: opens its design, or shows the first fault.
pub fn read(state: &mut State, path: &str, content: &str) {
    match Design::from_toml(content) {
        Ok(design) => shelf::open(state, design),
        Err(faults) => {
            let lines = faults.iter().map(|fault| fault.text(path, content));
            if let Some(first) = lines.into_iter().next() {
                state.say(Severity::Error, first);
            }
        }
    }
}

/// The design with this name; the trainee's own designs take precedence over shared ones.
fn named<'a>(state: &'a State, name: &str) -> Option<&'a Design> {
    let mut all = shelf::stored(state).into_iter();
    all.find(|it| it.design.name == name).map(|it| it.design)
}

fn own<'a>(state: &'a State, name: &str) -> Option<&'a Design> {
    let career = state.training.career.as_ref()?;
    career.designs.iter().find(|it| same(&it.name, name))
}

fn is_taken(state: &State, name: &str) -> bool {
    own(state, name).is_some()
}

/// Whether a profile treats two names as the same; case is ignored.
fn same(one: &str, other: &str) -> bool {
    one.eq_ignore_ascii_case(other)
}

fn ask_overwrite(state: &mut State, design: Design) {
    let question = text!("bench-ask-overwrite", name = design.name.as_str());
    let reason = text!("bench-ask-overwrite-reason");
    let effect = Effect::Career(CareerEffect::KeepDesign(design));
    state.ask(question, reason, Consequence::Effect(effect));
}

fn path_of(entered: &str) -> Result<String, Text> {
    let path = entered.trim();
    if path.is_empty() {
        return Err(text!("parameters-no-path"));
    }
    Ok(path.to_owned())
}
