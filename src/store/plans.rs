//! Files of plans, fences and rally points.

use std::path::{Path, PathBuf};

use super::names::unread;
use super::regular::read_regular;
use super::{Source, StoreError, read_bytes, sharing, user_path, write};
use crate::plan::{Document, Fault, FileFormat, ListKind, ReadOptions};
use crate::preflight::{self, note_words};
use crate::session::{PlanOnFile, PlanShelf, format_of};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;

/// The maximum size of the file of a kept list, in bytes: a hundred times that of a plan with all
/// the items that a vehicle can carry.
const LONGEST: u64 = 16 * 1024 * 1024;

/// Reads the text of a plan file of at most 1 MiB; of an archive (KMZ), the KML in it.
///
/// # Errors
/// The file does not exist, cannot be read, is too large or is not text.
pub fn read_plan_text(path: &Path) -> Result<Source, StoreError> {
    let bytes = read_bytes(path, "file-plan")?;
    let name = path.display().to_string();
    match crate::plan::source_text(&bytes) {
        Ok(text) => Ok(Source { name, text }),
        Err(fault) => Err(StoreError::Faulty {
            file: Source {
                name,
                text: String::new(),
            },
            faults: vec![preflight::fault(&fault)],
        }),
    }
}

/// The files of plans on this machine; names are relative to the working directory.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PlanFiles {
    /// The folder for lists that are kept while others are sent; `None` keeps none.
    kept: Option<PathBuf>,
}

impl PlanFiles {
    /// The plan files; kept lists are in the program's data folder.
    pub fn keeping_in(data: Option<&Path>) -> Self {
        Self {
            kept: data.map(|data| data.join("plans")),
        }
    }

    /// The file of a kept list: `3-plan.waypoints`.
    fn file(&self, vehicle: VehicleId, kind: ListKind) -> Option<PathBuf> {
        let name = match kind {
            ListKind::Plan => "plan.waypoints",
            ListKind::Fence => "fence.fence",
            ListKind::Rally => "rally.rally",
        };
        let folder = self.kept.as_ref()?;
        Some(folder.join(format!("{vehicle}-{name}")))
    }

    /// Creates the folder for kept lists; returns whether it exists now.
    fn make_folder(&self) -> bool {
        let Some(folder) = &self.kept else {
            return false;
        };
        let above = folder.parent().unwrap_or(folder);
        sharing::folder_within(above, folder).is_ok()
    }
}

impl PlanShelf for PlanFiles {
    fn read(&self, file: &str) -> Result<PlanOnFile, Text> {
        let path = user_path(file);
        let bytes = read_regular(&path, LONGEST).map_err(|error| unread(&path, &error))?;
        crate::plan::read(&bytes, &ReadOptions::default())
            .map(|loaded| PlanOnFile {
                notes: loaded
                    .notes
                    .iter()
                    .map(|it| (it.list, note_words(&it.kind)))
                    .collect(),
                document: loaded.document,
            })
            .map_err(|(text, faults)| faulty(file, &text, faults.first()))
    }

    fn write(&self, file: &str, kind: ListKind, document: &Document) -> Result<String, Text> {
        let path = user_path(file);
        let format = format_of(file, kind);
        let format = format.ok_or_else(|| text!("refused-plan-extension", file = file))?;
        let text = crate::plan::write(document, format)
            .map_err(|_| text!("refused-plan-format", file = file))?;
        save(&path, &text)?;
        Ok(path.display().to_string())
    }

    fn keep(&self, vehicle: VehicleId, kind: ListKind, document: &Document) -> bool {
        let Some(file) = self.file(vehicle, kind).filter(|_| self.make_folder()) else {
            return false;
        };
        let text = crate::plan::write(document, FileFormat::Wpl(kind));
        text.is_ok_and(|text| write(&file, &text, false).is_ok())
    }

    fn release(&self, vehicle: VehicleId, kind: ListKind) {
        if let Some(file) = self.file(vehicle, kind) {
            // A file that cannot be removed is reported again when the vehicle is next heard.
            let _ = std::fs::remove_file(file);
        }
    }

    fn kept(&self, vehicle: VehicleId) -> Vec<(ListKind, String)> {
        let files = ListKind::ALL.into_iter().filter_map(|kind| {
            let file = self.file(vehicle, kind)?;
            file.is_file().then(|| (kind, file.display().to_string()))
        });
        files.collect()
    }
}

/// Why a file is not a plan.
fn faulty(file: &str, text: &str, fault: Option<&Fault>) -> Text {
    let Some(fault) = fault.filter(|_| !text.trim().is_empty()) else {
        return text!("refused-plan-blank", file = file);
    };
    let fault = preflight::fault(fault);
    let (line, column) = fault.line_column(text);
    text!(
        "refused-plan-file",
        file = file,
        line = line,
        column = column,
        fault = &fault.message
    )
}

fn save(path: &Path, text: &str) -> Result<(), Text> {
    write(path, text, false).map_err(|error| match error {
        StoreError::Exists { .. } => {
            text!("refused-plan-exists", file = path.display().to_string())
        }
        other => Text::from(&other),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: &str = "QGC WPL 110\n\
        0\t1\t0\t16\t0\t0\t0\t0\t50.4501\t30.5234\t170\t1\n\
        1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t20\t1\n";

    #[test]
    fn a_file_is_read_and_a_new_one_written_and_none_is_replaced() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name).display().to_string();
        std::fs::write(path("a.waypoints"), PLAN).expect("written");
        let document = PlanFiles::default()
            .read(&path("a.waypoints"))
            .expect("valid");
        let document = document.document;
        assert_eq!(document.plan.len(), 1);
        for name in ["b.waypoints", "b.plan", "b.kml", "b.geojson", "b"] {
            let written = PlanFiles::default().write(&path(name), ListKind::Plan, &document);
            let again = PlanFiles::default().read(&written.expect("written"));
            assert_eq!(again.expect("valid").document.plan.len(), 1, "{name}");
            let taken = PlanFiles::default().write(&path(name), ListKind::Plan, &document);
            assert!(taken.is_err(), "{name}");
        }
    }

    #[test]
    fn an_unknown_extension_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.xyz").display().to_string();
        let written = PlanFiles::default().write(&path, ListKind::Plan, &Document::default());
        let reason = written.expect_err("unknown").to_string();
        assert!(reason.contains("unknown extension"), "{reason}");
        assert!(!folder.path().join("a.xyz").exists());
    }

    fn zip(name: &str, content: &[u8], stated: u32) -> Vec<u8> {
        let size = (content.len() as u32).to_le_bytes();
        let length = (name.len() as u16).to_le_bytes();
        let mut file = b"PK\x03\x04".to_vec();
        file.extend([0; 14]);
        file.extend([size, size].concat());
        file.extend([length, [0; 2]].concat());
        file.extend([name.as_bytes(), content].concat());
        let directory_at = file.len() as u32;
        file.extend(b"PK\x01\x02");
        file.extend([0; 16]);
        file.extend([size, stated.to_le_bytes()].concat());
        file.extend(length);
        file.extend([0; 16]);
        file.extend(name.as_bytes());
        file.extend(b"PK\x05\x06");
        file.extend([0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0]);
        file.extend(directory_at.to_le_bytes());
        file.extend([0; 2]);
        file
    }

    #[test]
    fn an_archive_is_read_like_the_document_in_it_and_one_that_unpacks_to_too_much_is_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let kml = b"<kml><Placemark><LineString><coordinates>30.52,50.45 30.53,50.45</coordinates>\
                    </LineString></Placemark></kml>";
        let read = |stated| {
            let path = folder.path().join("area.kmz");
            std::fs::write(&path, zip("doc.kml", kml, stated)).expect("written");
            read_plan_text(&path)
        };
        let source = read(kml.len() as u32).expect("an archive");
        assert_eq!(source.text.as_bytes(), kml);
        let fault = read(17 * 1024 * 1024).expect_err("too much");
        assert!(fault.to_string().contains("area.kmz"), "{fault}");
    }

    #[test]
    fn faults_have_their_place() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("bad.waypoints");
        std::fs::write(&file, format!("{PLAN}2\t0\tx\n")).expect("written");
        let fault = PlanFiles::default().read(&file.display().to_string());
        let text = fault.expect_err("a fault").to_string();
        assert!(text.contains('4'), "{text}");
        assert!(PlanFiles::default().read("/nowhere/at/all").is_err());
    }

    #[test]
    fn a_kept_list_stays_until_it_is_released() {
        let data = tempfile::tempdir().expect("a folder");
        let files = PlanFiles::keeping_in(Some(data.path()));
        let source = data.path().join("a.waypoints").display().to_string();
        std::fs::write(&source, PLAN).expect("written");
        let document = files.read(&source).expect("valid").document;
        assert!(files.keep(3, ListKind::Plan, &document));
        assert!(
            !files.keep(3, ListKind::Plan, &Document::default()),
            "the first one stays"
        );
        assert!(files.keep(3, ListKind::Rally, &Document::default()));
        let kept = PlanFiles::keeping_in(Some(data.path())).kept(3);
        let kinds: Vec<ListKind> = kept.iter().map(|(kind, _)| *kind).collect();
        assert_eq!(kinds, [ListKind::Plan, ListKind::Rally]);
        assert_eq!(
            files.read(&kept[0].1).expect("valid").document.plan,
            document.plan
        );
        assert!(
            files
                .read(&kept[1].1)
                .expect("valid")
                .document
                .rally
                .is_empty()
        );
        assert_eq!(files.kept(4), []);
        files.release(3, ListKind::Plan);
        files.release(3, ListKind::Plan);
        assert_eq!(files.kept(3).len(), 1);
        let nowhere = PlanFiles::default();
        assert!(!nowhere.keep(3, ListKind::Plan, &document) && nowhere.kept(3).is_empty());
    }
}
