//! The files of the vehicle under the cursor (MAVFTP): its folders, and the commands that copy, remove and check files.
//!
//! The room gives lines of the command language, so that each is a row of the ledger.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crossterm::event::KeyCode;

use crate::app::State;
use crate::app::action::{Action, FilesAction, Step, ViewAction};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, Press, does, hint, key};
use crate::app::room::fly;
use crate::app::room::{Answer, Room, RoomModel, RoomRequest, footer_keys};
use crate::app::state::Purpose;
use crate::commands::{Act, Command, FileCommand, Order, folder_of, last_part, path_in};
use crate::ledger::{EntryId, LedgerRow, RowState, RowUpdate};
use crate::session::{FtpEntry, ListedFolder};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// The maximum number of listed folders that are kept; beyond that, all are dropped.
const FOLDERS_KEPT: usize = 500;
/// The maximum number of commands about files that are remembered.
const ORDERS_KEPT: usize = 50;
const ROOT: &str = "/";

/// A folder of a vehicle.
type Place = (VehicleId, String);

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Files {
    /// The folder that is shown; empty for the root.
    folder: String,
    /// The name under the cursor; if it is gone, the cursor is on the first entry.
    cursor: String,
    /// The entries of the folders that vehicles have listed.
    folders: BTreeMap<Place, Vec<FtpEntry>>,
    /// The folders that were requested since they last changed.
    asked: BTreeSet<Place>,
    /// The newest commands about files, oldest first.
    orders: VecDeque<(EntryId, FileCommand)>,
}

impl Files {
    /// The folder that is shown.
    pub fn folder(&self) -> &str {
        match self.folder.as_str() {
            "" => ROOT,
            folder => folder,
        }
    }

    /// The entries of the folder that is shown; `None` if the vehicle has not listed it.
    pub fn entries(&self, vehicle: VehicleId) -> Option<&[FtpEntry]> {
        let entries = self.folders.get(&self.place(vehicle))?;
        Some(entries.as_slice())
    }

    /// The index of the entry under the cursor.
    pub fn cursor_row(&self, vehicle: VehicleId) -> usize {
        let entries = self.entries(vehicle).unwrap_or_default();
        let at = entries.iter().position(|entry| entry.name == self.cursor);
        at.unwrap_or(0)
    }

    /// The newest commands about files, newest first.
    pub fn orders(&self) -> impl Iterator<Item = EntryId> + '_ {
        self.orders.iter().rev().map(|(entry, _)| *entry)
    }

    /// The newest command that lists the folder that is shown.
    pub fn listing(&self) -> Option<EntryId> {
        let mut newest = self.orders.iter().rev();
        let lists = |command: &FileCommand| match command {
            FileCommand::List { folder } => folder == self.folder(),
            FileCommand::Get { .. }
            | FileCommand::Put { .. }
            | FileCommand::Remove { .. }
            | FileCommand::MakeFolder { .. }
            | FileCommand::Checksum { .. }
            | FileCommand::Documentation
            | FileCommand::Stop => false,
        };
        newest
            .find(|(_, command)| lists(command))
            .map(|(entry, _)| *entry)
    }

    fn place(&self, vehicle: VehicleId) -> Place {
        (vehicle, self.folder().to_owned())
    }

    fn under_cursor(&self, vehicle: VehicleId) -> Option<&FtpEntry> {
        self.entries(vehicle)?.get(self.cursor_row(vehicle))
    }

    fn enter(&mut self, folder: String) {
        self.folder = folder;
        self.cursor.clear();
    }

    /// Shows the folder that contains the shown one; false at the root.
    fn leave(&mut self) -> bool {
        if self.folder() == ROOT {
            return false;
        }
        let child = last_part(self.folder()).to_owned();
        self.folder = folder_of(self.folder());
        self.cursor = child;
        true
    }

    /// Lists a folder again, because it may have changed.
    fn spoil(&mut self, place: &Place) {
        self.asked.remove(place);
    }
}

const HINTS: &[KeyHint] = &[
    hint(&[Action::Submit], "files-hint-open"),
    hint(
        &[Action::Files(FilesAction::ParentFolder)],
        "files-hint-parent",
    ),
    hint(&[Action::Files(FilesAction::GetFile)], "files-hint-get"),
    hint(&[Action::Files(FilesAction::PutFile)], "files-hint-put"),
    hint(
        &[Action::Files(FilesAction::RemoveFile)],
        "files-hint-remove",
    ),
    hint(
        &[Action::Files(FilesAction::MakeFolder)],
        "files-hint-folder",
    ),
    hint(&[Action::Files(FilesAction::CheckFile)], "files-hint-check"),
    hint(
        &[
            Action::View(ViewAction::PreviousVehicle),
            Action::View(ViewAction::NextVehicle),
        ],
        "parameters-hint-vehicle",
    ),
    footer_keys::HELP,
];

impl RoomModel for Files {
    const KEYS: &'static [KeyRow] = &[
        does(ENTER, Action::Submit),
        does(ESCAPE, Action::Escape),
        does(Press::Plain(KeyCode::Right), Action::Submit),
        does(
            Press::Plain(KeyCode::Left),
            Action::Files(FilesAction::ParentFolder),
        ),
        does(
            Press::Plain(KeyCode::Backspace),
            Action::Files(FilesAction::ParentFolder),
        ),
        does(key('g'), Action::Files(FilesAction::GetFile)),
        does(key('u'), Action::Files(FilesAction::PutFile)),
        does(key('x'), Action::Files(FilesAction::RemoveFile)),
        does(key('m'), Action::Files(FilesAction::MakeFolder)),
        does(key('s'), Action::Files(FilesAction::CheckFile)),
        does(key('r'), Action::Files(FilesAction::ListAgain)),
        does(key('['), Action::View(ViewAction::PreviousVehicle)),
        does(key(']'), Action::View(ViewAction::NextVehicle)),
    ];

    fn hints(_state: &State) -> &'static [KeyHint] {
        HINTS
    }

    fn step(state: &mut State, step: Step) -> Answer {
        let vehicle = state.session.choice.cursor?;
        let room = &mut state.rooms.files;
        let count = room.entries(vehicle).map_or(0, <[FtpEntry]>::len);
        let at = step.apply(room.cursor_row(vehicle), count);
        let name = room.entries(vehicle).and_then(|entries| entries.get(at));
        if let Some(name) = name.map(|entry| entry.name.clone()) {
            room.cursor = name;
        }
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        let vehicle = state.session.choice.cursor?;
        let room = &mut state.rooms.files;
        let Some(entry) = room.under_cursor(vehicle).cloned() else {
            return Some(Vec::new());
        };
        let path = path_in(room.folder(), &entry.name);
        if entry.size.is_some() {
            return Some(vec![RoomRequest::Write(get_line(vehicle, &path))]);
        }
        room.enter(path);
        Some(Vec::new())
    }

    fn escape(state: &mut State) -> Answer {
        state.hush();
        if !state.rooms.files.leave() && state.session.activity.is_some() {
            state.room = Room::Fly;
        }
        Some(Vec::new())
    }

    fn view(state: &mut State, action: ViewAction) -> Answer {
        match action {
            ViewAction::NextVehicle => fly::move_cursor(state, Step::Down),
            ViewAction::PreviousVehicle => fly::move_cursor(state, Step::Up),
            ViewAction::Filter
            | ViewAction::Sort
            | ViewAction::SortReverse
            | ViewAction::NextPage
            | ViewAction::Window => return None,
        }
        Some(Vec::new())
    }
}

pub(super) fn act(state: &mut State, action: FilesAction) -> Vec<RoomRequest> {
    let Some(vehicle) = state.session.choice.cursor else {
        return Vec::new();
    };
    let room = &mut state.rooms.files;
    let folder = room.folder().to_owned();
    let entry = room.under_cursor(vehicle).cloned();
    let path = entry.as_ref().map(|entry| path_in(&folder, &entry.name));
    let file = path
        .clone()
        .filter(|_| entry.is_some_and(|it| it.size.is_some()));
    let request = match action {
        FilesAction::ParentFolder => {
            room.leave();
            None
        }
        FilesAction::ListAgain => {
            let place = room.place(vehicle);
            room.spoil(&place);
            None
        }
        FilesAction::GetFile => file.map(|path| RoomRequest::Write(get_line(vehicle, &path))),
        FilesAction::PutFile => {
            state.prompt(Purpose::PutFile { vehicle, folder }, "");
            None
        }
        FilesAction::RemoveFile => path.map(|path| {
            let end = if file.is_some() { "" } else { ROOT };
            RoomRequest::Give(format!("{vehicle} ftp remove {path}{end}"))
        }),
        FilesAction::MakeFolder => {
            let line = format!("{vehicle} ftp mkdir {}", path_in(&folder, ""));
            Some(RoomRequest::Write(line))
        }
        FilesAction::CheckFile => {
            file.map(|path| RoomRequest::Give(format!("{vehicle} ftp checksum {path}")))
        }
    };
    request.into_iter().collect()
}

/// The line that copies a file to this machine.
fn get_line(vehicle: VehicleId, path: &str) -> String {
    format!("{vehicle} ftp get {path} to {}", last_part(path))
}

/// The line that copies a file of this machine into a vehicle's folder.
///
/// # Errors
/// The name is empty.
pub fn put_line(vehicle: VehicleId, folder: &str, file: &str) -> Result<String, Text> {
    let file = file.trim();
    if file.is_empty() {
        return Err(text!("parameters-no-path"));
    }
    Ok(format!(
        "{vehicle} ftp put {file} to {}",
        path_in(folder, "")
    ))
}

/// The line that lists the folder on the screen, if it has not been requested since it last changed.
pub fn wanted(state: &mut State) -> Option<String> {
    let is_idle = state.room == Room::Files && state.overlay.is_none() && state.replay.is_none();
    let vehicle = state.session.choice.cursor.filter(|_| is_idle)?;
    let known = state.session.vehicles.get(&vehicle)?;
    if known.link.lost || state.session.is_paused() {
        return None;
    }
    let room = &mut state.rooms.files;
    let is_new = room.asked.insert(room.place(vehicle));
    is_new.then(|| format!("{vehicle} ftp list {}", room.folder()))
}

/// Remembers a command about files.
pub fn note_order(state: &mut State, order: &Order, entry: EntryId) {
    let Act::Command(Command::File(command)) = &order.act else {
        return;
    };
    let room = &mut state.rooms.files;
    if room.orders.len() == ORDERS_KEPT {
        room.orders.pop_front();
    }
    room.orders.push_back((entry, command.clone()));
}

/// Stores the entries of a folder.
pub fn listed(state: &mut State, listed: ListedFolder) {
    let room = &mut state.rooms.files;
    if room.folders.len() >= FOLDERS_KEPT {
        room.folders.clear();
        room.asked.clear();
    }
    let place = (listed.vehicle, listed.folder);
    room.asked.insert(place.clone());
    room.folders.insert(place, listed.entries);
}

/// Drops a vehicle's folders.
pub(in crate::app) fn forget(state: &mut State, vehicle: VehicleId) {
    let room = &mut state.rooms.files;
    room.folders.retain(|(id, _), _| *id != vehicle);
    room.asked.retain(|(id, _)| *id != vehicle);
}

/// Reports the end of a command about files on the last line, and lists a folder again that it has changed.
pub fn advanced(state: &mut State, row: &RowUpdate) {
    let mut orders = state.rooms.files.orders.iter();
    let Some((_, command)) = orders.find(|(entry, _)| *entry == row.entry) else {
        return;
    };
    if !row.state.is_final() {
        return;
    }
    let changed = match command {
        FileCommand::Put { path, .. }
        | FileCommand::Remove { path }
        | FileCommand::MakeFolder { path } => Some((row.vehicle, folder_of(path))),
        FileCommand::List { .. } => return,
        FileCommand::Get { .. }
        | FileCommand::Checksum { .. }
        | FileCommand::Documentation
        | FileCommand::Stop => None,
    };
    if let Some(place) = changed {
        state.rooms.files.spoil(&place);
    }
    if state.room == Room::Files {
        let severity = match row.state {
            RowState::Done => Severity::Info,
            _ => Severity::Warning,
        };
        let text = row.explanation.clone();
        state.say(severity, text.unwrap_or_else(|| row.state.text()));
    }
}

/// The ledger's row of a command about files.
pub fn outcome(state: &State, entry: EntryId, vehicle: VehicleId) -> Option<&LedgerRow> {
    let entry = state.session.commands.ledger.entry(entry)?;
    entry.rows.iter().find(|row| row.vehicle == vehicle)
}
