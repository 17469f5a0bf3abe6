//! Recordings as files that other programs open: all vehicles and all messages at once.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::Film;
use crate::link::{TlogPiece, TlogRecord};
use crate::moment::Moment;
use crate::store;
use crate::text;
use crate::text::Text;

mod mcap;
mod tables;
mod track;
mod tracks;

/// A file format for other programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportFormat {
    /// A folder with a table for each kind of message.
    Csv,
    /// Tracks with times, for globes.
    Kml,
    /// Tracks with times, for maps.
    Gpx,
    /// Tracks and moments, for maps.
    GeoJson,
    /// All messages as JSON, and the positions, for `Foxglove`.
    Mcap,
}

/// Writes a recording completely or not at all, as a file or as a folder of tables. Existing files
/// are not replaced. A stream (standard output as `-`, a device, a FIFO) is written to directly.
/// Returns a warning if the file has no content to show.
///
/// # Errors
/// The recording cannot be read or the file cannot be written, or the path exists already, or is a
/// stream although the format needs a folder.
pub fn export(
    film: &Film,
    moments: &[Moment],
    format: ExportFormat,
    to: &Path,
) -> Result<Option<Text>, Text> {
    let shown = || to.display().to_string();
    let unwritable = |error: io::Error| {
        let error = error.to_string();
        text!("export-unwritable", path = shown(), error = error)
    };
    let is_stream = store::is_stream(to);
    if to.exists() && !is_stream {
        return Err(text!("export-exists", path = shown()));
    }
    let written = match format {
        ExportFormat::Csv if is_stream => {
            return Err(text!("export-needs-folder", path = shown()));
        }
        ExportFormat::Csv => whole(to, |part| tables::write(film, part)),
        ExportFormat::Mcap => match store::open_stream(to).map_err(|error| Text::from(&error))? {
            Some(stream) => mcap::stream(film, stream),
            None => whole(to, |part| mcap::write(film, part)),
        },
        ExportFormat::Kml => return write_tracks(film, to, |all| tracks::kml(film, all, moments)),
        ExportFormat::Gpx => return write_tracks(film, to, |all| tracks::gpx(film, all, moments)),
        ExportFormat::GeoJson => {
            return write_tracks(film, to, |all| Ok(tracks::geo_json(film, all, moments)));
        }
    };
    written.map(|()| None).map_err(unwritable)
}

/// Writes the tracks of a recording; returns a warning if there are none.
fn write_tracks(
    film: &Film,
    to: &Path,
    format: impl FnOnce(&track::Tracks) -> io::Result<String>,
) -> Result<Option<Text>, Text> {
    let tracks = track::tracks(film)?;
    let text = format(&tracks).map_err(|error| {
        let (path, error) = (to.display().to_string(), error.to_string());
        text!("export-unwritable", path = path, error = error)
    })?;
    store::write_new_output(to, &text).map_err(|error| Text::from(&error))?;
    Ok(tracks.is_empty().then(|| text!("export-no-positions")))
}

/// Writes a file or a folder under a temporary name next to the final one, and renames it once it
/// is complete. If the path is a symbolic link, the link stays and its target is written.
fn whole(to: &Path, write: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    let target = store::end_of_links(to)?;
    let last = target.file_name().ok_or(io::ErrorKind::InvalidInput)?;
    let name = last.to_string_lossy();
    let part = target.with_file_name(format!(".{name}.{}.part", std::process::id()));
    let written = write(&part).and_then(|()| fs::rename(&part, &target));
    if written.is_err() {
        // If the partial file cannot be removed either, its disk is gone.
        drop(if part.is_dir() {
            fs::remove_dir_all(&part)
        } else {
            fs::remove_file(&part)
        });
    }
    written
}

/// The records of a recording, with their times of day corrected for pauses; damaged ones are
/// skipped.
pub(super) fn records(film: &Film) -> Result<impl Iterator<Item = TlogRecord>, Text> {
    let pieces = film.reader(0, None)?.map_while(Result::ok);
    let began = film.began_unix_us();
    Ok(pieces.filter_map(move |piece| match piece {
        // A tlog of another program may begin before its journal does.
        TlogPiece::Record(record) if record.unix_us < began => Some(record),
        TlogPiece::Record(record) => {
            let at = Duration::from_micros(record.unix_us - began);
            let unix_us = film.unix_us(at);
            Some(TlogRecord { unix_us, ..record })
        }
        TlogPiece::Damage { .. } => None,
    }))
}

/// A new file with a buffer, because many small writes would be slow.
fn create(path: PathBuf) -> io::Result<io::BufWriter<std::fs::File>> {
    let file = std::fs::File::create_new(path)?;
    Ok(io::BufWriter::with_capacity(256 * 1024, file))
}
