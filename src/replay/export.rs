//! Recordings as files that other programs open: all vehicles and all messages at once.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::Film;
use crate::link::{TlogPiece, TlogRecord};
use crate::moment::Moment;
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

/// Writes a recording completely or not at all, as a file or as a folder of tables. Existing files are not replaced.
/// Returns a warning if the file has no content to show.
///
/// # Errors
/// The recording cannot be read or the file cannot be written, or the path exists already.
pub fn export(
    film: &Film,
    moments: &[Moment],
    format: ExportFormat,
    to: &Path,
) -> Result<Option<Text>, Text> {
    let unwritable = |error: &dyn std::fmt::Display| {
        let (path, error) = (to.display().to_string(), error.to_string());
        text!("export-unwritable", path = path, error = error)
    };
    if to.exists() {
        return Err(text!("export-exists", path = to.display().to_string()));
    }
    match format {
        ExportFormat::Csv => {
            whole(to, |part| tables::write(film, part)).map_err(|error| unwritable(&error))?;
        }
        ExportFormat::Mcap => {
            whole(to, |part| mcap::write(film, part)).map_err(|error| unwritable(&error))?;
        }
        ExportFormat::Kml | ExportFormat::Gpx | ExportFormat::GeoJson => {
            let tracks = track::tracks(film)?;
            let written = match format {
                ExportFormat::Kml => tracks::kml(film, &tracks, moments),
                ExportFormat::Gpx => tracks::gpx(film, &tracks, moments),
                ExportFormat::GeoJson | ExportFormat::Csv | ExportFormat::Mcap => {
                    Ok(tracks::geo_json(film, &tracks, moments))
                }
            };
            let text = written.map_err(|error| unwritable(&error))?;
            crate::store::write(to, &text, false).map_err(|error| Text::from(&error))?;
            if tracks.is_empty() {
                return Ok(Some(text!("export-no-positions")));
            }
        }
    }
    Ok(None)
}

/// Writes a file or a folder under a temporary name next to the final one, and renames it once it is complete.
fn whole(to: &Path, write: impl FnOnce(&Path) -> io::Result<()>) -> io::Result<()> {
    let last = to.file_name().ok_or(io::ErrorKind::InvalidInput)?;
    let name = last.to_string_lossy();
    let part = to.with_file_name(format!(".{name}.{}.part", std::process::id()));
    let written = write(&part).and_then(|()| fs::rename(&part, to));
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

/// The records of a recording by the time of day; damaged ones are skipped.
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
