//! Files of drafts, the lists on board vehicles, and uploads to them.

use std::sync::Arc;

use super::{change, view};
use crate::app::State;
use crate::app::effect::{Effect, Effects, FileEffect, FileKind};
use crate::app::state::Consequence;
use crate::draft::Draft;
use crate::notice::Notice;
use crate::plan::{
    self, ContentHash, Document, FileFormat, Home, Item, ListKind, Note, ReadOptions,
};
use crate::preflight;
use crate::session::format_of;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, Transfer, Vehicle, VehicleId};
use crate::vehicle_id::ranges;

/// The extension for a file name without one; this format holds all lists.
const ENDING: &str = "plan";

/// The file name to propose for a draft: that of its file; without a file, the draft's name with an
/// extension that can be written.
pub(super) fn proposed(draft: &Draft) -> String {
    if let Some(file) = draft.file() {
        file.to_owned()
    } else if ending(draft.name()).is_some() {
        draft.name().to_owned()
    } else {
        // Archives can be read but not written.
        let name = draft.name().trim_end_matches(".kmz");
        format!("{name}.{ENDING}")
    }
}

fn has_extension(path: &str) -> bool {
    let name = path.rsplit(['/', '\\']).next().unwrap_or_default();
    name.contains('.')
}

fn ending(path: &str) -> Option<FileFormat> {
    let (_, ending) = path.rsplit_once('.')?;
    FileFormat::of_ending(ending)
}

/// Asks the shell to read a file; its content becomes a draft.
pub(super) fn open(path: String) -> Effects {
    Effects::from(Effect::File(FileEffect::Read {
        kind: FileKind::Plan,
        path,
    }))
}

/// Handles a file that has been read: it becomes the current draft, under the name of the file.
/// Faults are shown.
pub fn read(state: &mut State, path: &str, content: &str) {
    if content.trim().is_empty() {
        return state.say(Severity::Error, text!("refused-plan-blank", file = path));
    }
    match plan::read(content.as_bytes(), &ReadOptions::default()) {
        Ok(loaded) => {
            let mut document = loaded.document;
            document.home = document.home.or_else(|| change::home(state));
            let document = Arc::new(document);
            // Compressed files can be read only.
            let draft = match ending(path) {
                Some(_) => Draft::of_file(path, document),
                None => Draft::new(path, document, None).kept(),
            };
            fill(state, [draft]);
            say_summary(state);
            say_notes(state, path, &loaded.notes);
        }
        Err((text, faults)) => {
            let fault = faults.first().map(preflight::fault);
            let Some(fault) = fault else {
                return;
            };
            let (line, column) = fault.line_column(&text);
            let message = text!(
                "draft-file-faulty",
                path = path,
                line = line,
                column = column,
                fault = &fault.message
            );
            state.say(Severity::Error, message);
        }
    }
}

/// Opens drafts, such as one for each vehicle, and shows the first of them.
pub fn fill(state: &mut State, drafts: impl IntoIterator<Item = Draft>) {
    state.rooms.plans.drafts.put(drafts);
    state.rooms.plans.tried = None;
    change::look_at(state, ListKind::Plan);
    view::fit(state);
    view::point_at_item(state);
}

/// Shows the content of the current draft on the last line.
pub(super) fn say_summary(state: &mut State) {
    if let Some(draft) = state.rooms.plans.drafts.current() {
        let holds = preflight::summary(draft.document());
        let text = text!("draft-holds", name = draft.name(), holds = holds);
        state.say(Severity::Info, text);
    }
}

/// Writes the current draft to a file; without a path, to the file that it was read from or last
/// written to. That file is replaced without a question.
///
/// # Errors
/// There is no draft, the draft is empty, or the format is unknown or cannot hold the draft.
pub(super) fn save(state: &mut State, path: Option<String>) -> Result<Effects, Text> {
    let draft = state.rooms.plans.drafts.current();
    let draft = draft.ok_or_else(|| text!("draft-none"))?;
    let path = path.unwrap_or_else(|| proposed(draft));
    let document = Arc::clone(draft.document());
    let Some(first) = document.kinds().next() else {
        return Err(text!("draft-empty"));
    };
    let (path, format) = match format_of(&path, first) {
        // Without an extension, a format that holds all lists.
        _ if !has_extension(&path) => (format!("{path}.{ENDING}"), FileFormat::QgcPlan),
        Some(format) => (path, format),
        None => return Err(text!("refused-plan-extension", file = path)),
    };
    let text =
        plan::write(&document, format).map_err(|_| text!("refused-plan-format", file = &path))?;
    let replace = draft.file() == Some(&path);
    state.rooms.plans.saving = Some((path.clone(), draft.name().to_owned(), document));
    Ok(Effects::from(Effect::File(FileEffect::Write {
        kind: FileKind::Plan,
        path,
        text,
        replace,
    })))
}

/// Records that a file was written.
pub fn written(state: &mut State, path: &str) {
    let room = &mut state.rooms.plans;
    let saved = room.saving.take_if(|(saving, ..)| saving == path);
    if let Some((path, name, document)) = saved {
        room.drafts.note_saved(&name, &path, document);
    }
}

/// Warns of the data that a file lacks, each kind once.
fn say_notes(state: &mut State, path: &str, notes: &[Note]) {
    let mut words: Vec<Text> = Vec::new();
    for note in notes.iter().map(|note| preflight::note_words(&note.kind)) {
        if !words.contains(&note) {
            words.push(note);
        }
    }
    if words.is_empty() {
        return;
    }
    let notes = Text::joined("; ", words);
    let text = text!("draft-noted", path = path, notes = notes);
    state.say(Severity::Warning, text.clone());
    let notice = Notice::general(state.now, Severity::Warning, text);
    state.notices.push(notice);
}

/// The lists that a vehicle has on board, as far as they have been read.
fn on_board(vehicle: &Vehicle) -> Option<Document> {
    let plans = &vehicle.plans;
    let plan = plans.plan.content.as_deref();
    let first = plan.and_then(|plan| plan.items.first().filter(|_| plan.home_first));
    let fence = plans.fence.content.as_deref();
    let rally = plans.rally.content.as_deref();
    let document = Document {
        home: first.map(|home| Home {
            x: home.x,
            y: home.y,
            z: home.z,
        }),
        plan: plan.map(|plan| plan.flown().to_vec()).unwrap_or_default(),
        fence: fence.map(|fence| fence.items.clone()).unwrap_or_default(),
        rally: rally.map(|rally| rally.items.clone()).unwrap_or_default(),
        origin: None,
    };
    let is_any = document.kinds().next().is_some();
    is_any.then_some(document)
}

/// The name of the draft for a vehicle.
pub(super) fn name_of(vehicle: VehicleId) -> String {
    format!("vehicle-{vehicle}")
}

/// Opens the lists on board these vehicles, one draft for each vehicle.
///
/// # Errors
/// No list of these vehicles has been read.
pub(super) fn take(state: &mut State, vehicles: &[VehicleId]) -> Result<(), Text> {
    let known = vehicles.iter().filter_map(|id| {
        let document = on_board(state.session.vehicles.get(id)?)?;
        let draft = Draft::new(name_of(*id), Arc::new(document), Some(*id));
        Some(draft.kept())
    });
    let drafts: Vec<Draft> = known.collect();
    if drafts.is_empty() {
        let vehicles = ranges(vehicles.iter().copied());
        return Err(text!("draft-nothing-on-board", vehicles = vehicles));
    }
    fill(state, drafts);
    Ok(())
}

pub(super) fn take_by_key(state: &mut State) {
    let vehicles = state.addressed();
    match take(state, &vehicles) {
        Ok(()) => say_summary(state),
        Err(reason) => state.say(Severity::Warning, reason),
    }
}

/// The lines that upload each list of a draft to vehicles; the draft's name takes the place of a
/// file name. If the draft has a plan, its fence and its rally points are left out if all the
/// vehicles carry them already.
///
/// # Errors
/// The draft is empty.
pub fn uploads(state: &State, draft: &Draft, vehicles: &[VehicleId]) -> Result<Vec<String>, Text> {
    let targets = ranges(vehicles.iter().copied());
    let document = draft.document();
    let is_new = |kind: &ListKind| {
        document.plan.is_empty() || !is_carried(state, document.list(*kind), *kind, vehicles)
    };
    let lines: Vec<String> = document
        .kinds()
        .filter(is_new)
        .map(|kind| {
            let list = kind.name();
            format!("{targets} {list} upload {}", draft.name())
        })
        .collect();
    if lines.is_empty() {
        return Err(text!("draft-empty"));
    }
    Ok(lines)
}

/// Whether all these vehicles already carry a fence or these rally points. Always false for a plan, which is sent again
/// because the vehicle may have to begin it anew.
fn is_carried(state: &State, list: &[Item], kind: ListKind, vehicles: &[VehicleId]) -> bool {
    let mark = ContentHash::of(list);
    vehicles.iter().all(|id| {
        let Some(vehicle) = state.session.vehicles.get(id) else {
            return false;
        };
        let plans = &vehicle.plans;
        let (transfer, held) = match kind {
            ListKind::Plan => return false,
            ListKind::Fence => {
                let held = plans.fence.content.as_ref();
                (plans.fence.transfer, held.map(|it| it.items.as_slice()))
            }
            ListKind::Rally => {
                let held = plans.rally.content.as_ref();
                (plans.rally.transfer, held.map(|it| it.items.as_slice()))
            }
        };
        transfer == Transfer::Done && held.is_some_and(|held| ContentHash::of(held) == mark)
    })
}

/// Whether nothing would be lost if the program ended now.
pub fn is_kept(state: &State) -> bool {
    let drafts = state.rooms.plans.drafts.all();
    drafts.iter().all(|draft| is_elsewhere(state, draft))
}

/// Whether the content of a draft is also in a file, or on board its vehicle.
pub fn is_elsewhere(state: &State, draft: &Draft) -> bool {
    if draft.is_kept() {
        return true;
    }
    let vehicle = draft
        .vehicle()
        .and_then(|id| state.session.vehicles.get(&id));
    let Some(carried) = vehicle.and_then(|vehicle| on_board(vehicle)) else {
        return false;
    };
    let document = draft.document();
    let is_same =
        |kind| ContentHash::of(document.list(kind)) == ContentHash::of(carried.list(kind));
    document.kinds().all(is_same)
}

/// Closes the current draft; asks first if its content is nowhere else.
///
/// # Errors
/// There is no draft.
pub fn ask_close(state: &mut State) -> Result<(), Text> {
    let draft = state.rooms.plans.drafts.current();
    let draft = draft.ok_or_else(|| text!("draft-none"))?;
    if is_elsewhere(state, draft) {
        close(state);
    } else {
        let question = text!("draft-ask-close", name = draft.name());
        let reason = text!("draft-ask-close-reason");
        state.ask(question, reason, Consequence::CloseDraft);
    }
    Ok(())
}

/// Closes the current draft.
pub fn close(state: &mut State) {
    state.rooms.plans.drafts.close();
    change::look_at(state, ListKind::Plan);
}
