//! `sortie records export`: a record in formats of other programs, and its review.

use std::path::Path;

use clap::ValueEnum;

use super::RecordsCommands;
use crate::cli::Failure;
use crate::replay::{ExportFormat, Replay, export};
use crate::review::{ReviewedFlight, markdown};
use crate::store::{is_stream, write_new_output};
use crate::text;
use crate::text::utc_of;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum RecordFormat {
    Csv,
    Kml,
    Gpx,
    Geojson,
    Mcap,
    Md,
}

impl RecordFormat {
    /// The export format; `None` for the review.
    fn of_recording(self) -> Option<ExportFormat> {
        match self {
            Self::Csv => Some(ExportFormat::Csv),
            Self::Kml => Some(ExportFormat::Kml),
            Self::Gpx => Some(ExportFormat::Gpx),
            Self::Geojson => Some(ExportFormat::GeoJson),
            Self::Mcap => Some(ExportFormat::Mcap),
            Self::Md => None,
        }
    }
}

impl RecordsCommands<'_> {
    pub(super) fn export(
        &self,
        named: &str,
        format: RecordFormat,
        output: &Path,
    ) -> Result<(), Failure> {
        let files = self.find(named)?;
        let replay = self.read(&files)?;
        let written = match format.of_recording() {
            Some(format) => export(replay.film(), replay.moments(), format, output),
            None => write_new_output(output, &self.review(&replay))
                .map(|()| None)
                .map_err(|error| (&error).into()),
        };
        let warning =
            written.map_err(|fault| Failure::Failed(anyhow::anyhow!(self.locale.text(&fault))))?;
        // The reader of a stream gets only the recording.
        if !is_stream(output) {
            let text = text!("export-done", path = output.display().to_string());
            say!("{}", self.locale.text(&text))?;
        }
        if let Some(warning) = warning {
            tell!("{}", self.locale.text(&warning));
        }
        Ok(())
    }

    /// The review of a recording, as Markdown.
    fn review(&self, replay: &Replay) -> String {
        let film = replay.film();
        let flown = film.run().and_then(|run| run.head.flown().ok());
        let title = match &flown {
            Some(mission) => self.locale.text(&mission.title),
            None => film.name(),
        };
        let report = replay.report();
        let flight = ReviewedFlight {
            title: &title,
            began: &utc_of(film.began_unix_us()),
            brief: flown.as_ref().map(|it| &it.summary.brief),
            report: report.as_deref(),
            moments: replay.moments(),
            clock: film.clock(),
        };
        markdown(replay.reviewed(), flight, &self.locale)
    }
}
