//! The general file of a vehicle's metadata, which names the other files (`general.schema.json`), and the addresses of
//! files on board (`mftp://`).

use serde::Deserialize;

use crate::text;
use crate::text::Text;

/// The scheme of files on the vehicle.
const ON_BOARD: &str = "mftp://";

/// What a file of metadata is about; others are not read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum MetadataKind {
    Parameters,
    Events,
}

/// A file that the general file names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MetadataFile {
    pub kind: MetadataKind,
    pub place: MetadataPlace,
    /// The checksum under which it can be cached.
    pub checksum: Option<u32>,
}

/// Where a file of metadata is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MetadataPlace {
    /// On the vehicle's autopilot, under this path.
    OnBoard(String),
    /// Elsewhere, under this address.
    Elsewhere(String),
}

#[derive(Deserialize)]
struct General {
    #[serde(rename = "metadataTypes", default)]
    types: Vec<FileEntry>,
}

#[derive(Deserialize)]
struct FileEntry {
    #[serde(rename = "type")]
    kind: u32,
    #[serde(default)]
    uri: String,
    #[serde(rename = "fileCrc")]
    checksum: Option<u32>,
    #[serde(rename = "uriFallback", default)]
    fallback: String,
}

/// The files about parameters and events that a general file names, parameters first.
///
/// # Errors
/// It is not JSON of the expected form.
pub fn general(source: &str) -> Result<Vec<MetadataFile>, Text> {
    let general: General = serde_json::from_str(source)
        .map_err(|error| text!("documentation-json", fault = error.to_string()))?;
    let mut files: Vec<MetadataFile> = general.types.iter().filter_map(file).collect();
    files.sort_by_key(|file| file.kind);
    files.dedup_by_key(|file| file.kind);
    Ok(files)
}

fn file(entry: &FileEntry) -> Option<MetadataFile> {
    let kind = match entry.kind {
        1 => MetadataKind::Parameters,
        4 => MetadataKind::Events,
        _ => return None,
    };
    let first = MetadataPlace::of(&entry.uri);
    // A file on board fits the vehicle, and needs no internet.
    let place = match MetadataPlace::of(&entry.fallback) {
        Some(place @ MetadataPlace::OnBoard(_))
            if !matches!(first, Some(MetadataPlace::OnBoard(_))) =>
        {
            place
        }
        other => first.or(other)?,
    };
    Some(MetadataFile {
        kind,
        place,
        checksum: entry.checksum,
    })
}

impl MetadataPlace {
    /// The place of an address; `None` if the address is empty.
    pub fn of(address: &str) -> Option<Self> {
        let address = address.trim();
        if address.is_empty() {
            return None;
        }
        let is_on_board = address.get(..ON_BOARD.len());
        if !is_on_board.is_some_and(|scheme| scheme.eq_ignore_ascii_case(ON_BOARD)) {
            return Some(Self::Elsewhere(address.to_owned()));
        }
        let path = &address[ON_BOARD.len()..];
        // `[;comp=1]` names the component; 1 is the autopilot.
        let path = match path.strip_prefix("[;comp=") {
            None => path,
            Some(named) => match named.split_once(']') {
                Some(("1", path)) => path,
                _ => return Some(Self::Elsewhere(address.to_owned())),
            },
        };
        (!path.is_empty()).then(|| Self::OnBoard(path.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_files_of_px4_are_found() {
        let source = r#"{"version": 1, "metadataTypes": [
            {"type": 5, "uri": "mftp:///etc/extras/actuators.json.xz", "fileCrc": 9},
            {"type": 4, "uri": "mftp:///etc/extras/all_events.json.xz", "fileCrc": 4027143211},
            {"type": 1, "uri": "https://example.org/parameters.json.xz", "fileCrc": 7,
             "uriFallback": "mftp:///etc/extras/parameters.json.xz"}]}"#;
        let on_board = |path: &str| MetadataPlace::OnBoard(path.to_owned());
        assert_eq!(
            general(source),
            Ok(vec![
                MetadataFile {
                    kind: MetadataKind::Parameters,
                    place: on_board("/etc/extras/parameters.json.xz"),
                    checksum: Some(7),
                },
                MetadataFile {
                    kind: MetadataKind::Events,
                    place: on_board("/etc/extras/all_events.json.xz"),
                    checksum: Some(4_027_143_211),
                },
            ])
        );
        assert!(general("[").is_err());
        assert_eq!(general("{}"), Ok(Vec::new()));
    }

    #[test]
    fn addresses_name_the_autopilot_or_another_place() {
        let of = |address| MetadataPlace::of(address);
        let path = Some(MetadataPlace::OnBoard("/a.json".to_owned()));
        assert_eq!(of("MFTP:///a.json"), path);
        assert_eq!(of("mftp://[;comp=1]/a.json"), path);
        for other in ["mftp://[;comp=100]/a.json", "mftp://[;comp=1", "https://a"] {
            let elsewhere = Some(MetadataPlace::Elsewhere(other.to_owned()));
            assert_eq!(of(other), elsewhere);
        }
        assert_eq!((of("  "), of("mftp://")), (None, None));
    }
}
