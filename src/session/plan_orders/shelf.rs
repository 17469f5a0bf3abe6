//! The interface through which a session accesses plan files.

use std::fmt::Debug;
use std::time::Duration;

use crate::commands::protected_item;
use crate::notice::Notice;
use crate::plan::{Document, FileFormat, ListKind};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// The content of a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlanOnFile {
    pub document: Document,
    /// The assumptions made in reading each of its lists, such as heights that the file lacks.
    pub notes: Vec<(ListKind, Text)>,
}

/// Reads and writes files of plans, fences and rally points. Names are as the user typed them.
pub trait PlanShelf: Debug + Send + Sync {
    /// The content of a file.
    ///
    /// # Errors
    /// A text that names the file, and the place of the first fault.
    fn read(&self, file: &str) -> Result<PlanOnFile, Text>;

    /// Writes a new file and returns its path; no file is replaced.
    ///
    /// # Errors
    /// The file exists already or cannot be written.
    fn write(&self, file: &str, kind: ListKind, document: &Document) -> Result<String, Text>;

    /// Keeps the list of a vehicle while another one is sent, so that it is not lost if this
    /// program ends. A list that is already kept is not replaced, because it is the complete one.
    /// Returns whether the list is kept now.
    fn keep(&self, vehicle: VehicleId, kind: ListKind, document: &Document) -> bool;

    /// Removes the kept list of a vehicle, if there is one.
    fn release(&self, vehicle: VehicleId, kind: ListKind);

    /// The kept lists of a vehicle, each with its file.
    fn kept(&self, vehicle: VehicleId) -> Vec<(ListKind, String)>;
}

/// The plan files of a flight that counts: a plan with items that move home or switch the fence is
/// refused.
#[derive(Debug)]
pub struct GuardedShelf<S>(pub S);

impl<S: PlanShelf> PlanShelf for GuardedShelf<S> {
    fn read(&self, file: &str) -> Result<PlanOnFile, Text> {
        let content = self.0.read(file)?;
        match protected_item(&content.document) {
            None => Ok(content),
            Some(item) => Err(item.refusal()),
        }
    }

    fn write(&self, file: &str, kind: ListKind, document: &Document) -> Result<String, Text> {
        self.0.write(file, kind, document)
    }

    fn keep(&self, vehicle: VehicleId, kind: ListKind, document: &Document) -> bool {
        self.0.keep(vehicle, kind, document)
    }

    fn release(&self, vehicle: VehicleId, kind: ListKind) {
        self.0.release(vehicle, kind);
    }

    fn kept(&self, vehicle: VehicleId) -> Vec<(ListKind, String)> {
        self.0.kept(vehicle)
    }
}

/// The format of a file to write, by its name: `QGC WPL 110` with one list, unless the extension
/// names another format.
pub(crate) fn format_of(file: &str, kind: ListKind) -> Option<FileFormat> {
    let name = file.rsplit(['/', '\\']).next().unwrap_or_default();
    let Some((_, ending)) = name.rsplit_once('.') else {
        return Some(FileFormat::Wpl(kind));
    };
    Some(match FileFormat::of_ending(ending)? {
        FileFormat::Wpl(_) => FileFormat::Wpl(kind),
        other => other,
    })
}

/// The notices about interrupted transfers to a vehicle, whose old lists are still kept.
pub(super) fn broken_off(
    shelf: &dyn PlanShelf,
    vehicle: VehicleId,
    now: Duration,
) -> impl Iterator<Item = Notice> {
    let kept = shelf.kept(vehicle).into_iter();
    kept.map(move |(kind, file)| {
        let verb = kind.name();
        let content = shelf.read(&file);
        let text = if content.is_ok_and(|content| content.document.list(kind).is_empty()) {
            text!("plan-broken-off-empty", verb = verb)
        } else {
            text!("plan-broken-off", verb = verb, file = file)
        };
        Notice::about(vehicle, now, Severity::Warning, text)
    })
}
