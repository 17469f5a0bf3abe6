//! `sortie records show`: one record with its files and moments.

use std::path::PathBuf;

use serde::Serialize;

use super::{ListedRecord, RecordsCommands};
use crate::cli::Failure;
use crate::cli::table::{Side, TextTable};
use crate::moment::Moment;
use crate::record::MissionClock;
use crate::store::RecordFiles;
use crate::text;
use crate::text::clock;
use crate::vehicle_id::ranges;

/// A record as a document.
#[derive(Debug, Serialize)]
struct ShownRecord {
    #[serde(flatten)]
    record: ListedRecord,
    frames: Option<PathBuf>,
    journal: Option<PathBuf>,
    run: Option<PathBuf>,
    signatures: Vec<PathBuf>,
    moments: Vec<ShownMoment>,
}

#[derive(Debug, Serialize)]
struct ShownMoment {
    at_s: f64,
    /// The mission time in seconds; absent without a mission.
    #[serde(skip_serializing_if = "Option::is_none")]
    mission_s: Option<f64>,
    kind: &'static str,
    vehicles: Vec<u16>,
    text: String,
}

impl ShownMoment {
    fn new(moment: &Moment, clock: &MissionClock) -> Self {
        let mission = clock.mission_time(moment.at);
        Self {
            at_s: moment.at.as_secs_f64(),
            mission_s: mission.map(|it| it.as_secs_f64()),
            kind: moment.kind.name(),
            vehicles: moment.vehicles.clone(),
            text: moment.text.to_string(),
        }
    }
}

impl RecordsCommands<'_> {
    pub(super) fn show(&self, named: &str, json: bool) -> Result<(), Failure> {
        let files = self.find(named)?;
        let replay = self.read(&files)?;
        let times = replay.film().clock();
        let moments = replay.moments().iter();
        let place = |it: &RecordFiles| it.frames.as_deref()?.canonicalize().ok();
        let number = self.numbered().find(|(_, it)| place(it) == place(&files));
        let record = self.listed(number.map(|(number, _)| number), &files);
        if json {
            let shown = ShownRecord {
                record,
                signatures: files.signatures(),
                frames: files.frames,
                journal: files.journal,
                run: files.run,
                moments: moments.map(|it| ShownMoment::new(it, times)).collect(),
            };
            say!("{}", serde_json::to_string_pretty(&shown)?)?;
            return Ok(());
        }
        let seed = record.seed.map(|seed| text!("records-seed", seed = seed));
        say!("{}", self.table(&[record]).plain().trim_end())?;
        if let Some(seed) = seed {
            say!("  {}", self.locale.text(&seed))?;
        }
        for fault in replay.damage() {
            say!("{}", self.locale.text(&fault))?;
        }
        let review = files.review.is_file().then_some(&files.review);
        let parts = [&files.frames, &files.journal, &files.run, &files.inputs];
        for path in parts
            .into_iter()
            .flatten()
            .chain(review)
            .chain(&files.joined_paths())
            .chain(&files.signatures())
        {
            say!("  {}", path.display())?;
        }
        say!("")?;
        self.say_moments(replay.moments(), times)
    }

    pub(super) fn say_moments(
        &self,
        moments: &[Moment],
        times: &MissionClock,
    ) -> Result<(), Failure> {
        let columns = [
            (text!("records-at"), Side::Right),
            (text!("records-mission-time"), Side::Right),
            (text!("records-kind"), Side::Left),
            (text!("records-vehicles"), Side::Left),
            (text!("records-what"), Side::Left),
        ];
        let mut table = TextTable::new(&self.locale, &columns);
        for moment in moments {
            table.push(vec![
                clock(moment.at),
                times
                    .mission_time(moment.at)
                    .map_or_else(String::new, clock),
                self.locale.text(&moment.kind.text()),
                ranges(moment.vehicles.iter().copied()),
                self.locale.text(&moment.text),
            ]);
        }
        say!("{}", table.plain().trim_end())?;
        Ok(())
    }
}
