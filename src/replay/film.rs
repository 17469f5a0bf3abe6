//! A recording and its related files.

use std::fs::File;
use std::io::{Seek as _, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use crate::app::event::Started;
use crate::app::state::{Activity, ReplayView};
use crate::crew::CrewViewpoint;
use crate::dataflash::JoinedLog;
use crate::link::{TlogPiece, TlogSalvage};
use crate::mission::record::Stored;
use crate::moment::Moment;
use crate::record::{
    DayClock, Journal, JournalFit, JournalLine, JournalNeighbours, MissionClock, Subject,
};
use crate::review::Review;
use crate::store::{RecordFiles, read_run, unread};
use crate::text;
use crate::text::Text;

/// The size of the end of a recording that is searched for its last record, in bytes.
const TAIL_LEN: u64 = 64 * 1024;
const LONGEST_US: u64 = 7 * 24 * 3600 * 1_000_000;

/// An open recording. It does not change while it is replayed, unless it is still being made.
#[derive(Debug)]
pub struct Film {
    files: RecordFiles,
    frames: PathBuf,
    journal: Option<Journal>,
    clock: Arc<MissionClock>,
    run: Option<Stored>,
    review: Review,
    review_fault: Option<Text>,
    logs: Vec<JoinedLog>,
    /// The faults of the journal, the run and the logs that were left out.
    faults: Vec<Text>,
    began_unix_us: u64,
    day: Arc<DayClock>,
    length: Duration,
    /// Whether the recording is still being made.
    grows: bool,
}

impl Film {
    /// Opens a recording that is still being made.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn open_growing(path: &Path) -> Result<Self, Text> {
        Ok(Self {
            grows: true,
            ..Self::open(path)?
        })
    }

    /// Whether the recording is still being made.
    pub fn grows(&self) -> bool {
        self.grows
    }

    /// Opens a recording by one of its files.
    ///
    /// # Errors
    /// The recording cannot be read, or has no frame.
    pub fn open(path: &Path) -> Result<Self, Text> {
        let files = RecordFiles::beside(path);
        let frames = files.frames.clone().ok_or_else(|| no_frames(path))?;
        let span = TlogSpan::read(&frames)?;
        // The frames of a flight can be replayed without its journal and its score.
        let mut faults = Vec::new();
        let run = files.run.as_deref().map(read_stored).and_then(|read| {
            let unreadable = |fault| text!("replay-without-run", fault = fault);
            read.map_err(|fault| faults.push(unreadable(fault))).ok()
        });
        let journal = own_journal(&files, span, run.as_ref()).unwrap_or_else(|fault| {
            faults.push(text!("replay-without-journal", fault = fault));
            None
        });
        let head = journal.as_ref().map(|it| &it.head);
        let stored = files.read_review();
        let review = match &stored {
            Ok(Some(review)) => review.clone(),
            Ok(None) | Err(_) => Review::of(head),
        };
        let began_unix_us = head.map_or(span.first_unix_us, |it| it.began_unix_us);
        let (logs, log_faults) = files.read_joined();
        faults.extend(log_faults);
        let clock = Arc::new(journal.as_ref().map(MissionClock::of).unwrap_or_default());
        let day = Arc::new(journal.as_ref().map(DayClock::of).unwrap_or_default());
        let lines = journal.iter().flat_map(|it| &it.lines);
        let told = lines.last().map_or(Duration::ZERO, JournalLine::at);
        Ok(Self {
            files,
            frames,
            journal,
            clock,
            run,
            review,
            review_fault: stored.err(),
            logs,
            faults,
            began_unix_us,
            day,
            length: span.length_from(began_unix_us).max(told),
            grows: false,
        })
    }

    pub fn name(&self) -> String {
        self.files.stem.clone()
    }

    pub fn files(&self) -> &RecordFiles {
        &self.files
    }

    /// The time of its beginning: microseconds since 1970 (UTC).
    pub fn began_unix_us(&self) -> u64 {
        self.began_unix_us
    }

    /// The time of day at a time in the recording: microseconds since 1970 (UTC).
    pub fn unix_us(&self, at: Duration) -> u64 {
        self.day.unix_us(self.began_unix_us, at)
    }

    /// The length of the recording.
    pub fn length(&self) -> Duration {
        self.length
    }

    /// The mission's clock; empty if no mission was flown.
    pub fn clock(&self) -> &Arc<MissionClock> {
        &self.clock
    }

    /// The initial view of its replay, without moments and review.
    pub fn view(&self) -> ReplayView {
        let mut view = ReplayView::new(self.name(), self.began_unix_us, self.length);
        view.clock = Arc::clone(&self.clock);
        view.day = Arc::clone(&self.day);
        view.is_live = self.grows;
        view
    }

    /// Who looks at whose flight, if it is the copy of a member of a crew.
    pub fn viewpoint(&self) -> Option<CrewViewpoint> {
        self.files.viewpoint(&self.journal.as_ref()?.head)
    }

    /// Its journal, if recorded.
    pub fn journal(&self) -> Option<&Journal> {
        self.journal.as_ref()
    }

    /// The faults of its journal, its run, its review and its logs.
    pub fn damage(&self) -> impl Iterator<Item = Text> {
        // Of one that is still being made, the last lines may not be whole yet.
        let is_read = !self.grows;
        let journal = self.journal.as_ref().filter(|_| is_read).into_iter();
        let journal = journal.flat_map(Journal::faults);
        let run = self.run.as_ref().filter(|_| is_read);
        let run = run.and_then(Stored::damaged_line);
        let run = run.map(|fault| text!("replay-run-damaged", fault = fault.clone()));
        let faults = self.faults.iter().cloned();
        journal
            .chain(run)
            .chain(self.review_fault.clone())
            .chain(faults)
    }

    /// Why the review next to it could not be read, if so.
    pub fn review_fault(&self) -> Option<&Text> {
        self.review_fault.as_ref()
    }

    /// Its stored review, or an empty one.
    pub fn review(&self) -> &Review {
        &self.review
    }

    /// The bookmarks as they were set while it was recorded, earliest first.
    pub fn bookmarks(&self) -> Vec<Moment> {
        let journal = self.journal.iter();
        journal.flat_map(Journal::bookmarks).collect()
    }

    /// The logs that have been joined to the recording.
    pub fn logs(&self) -> &[JoinedLog] {
        &self.logs
    }

    /// The recorded run, if a mission was flown.
    pub fn run(&self) -> Option<&Stored> {
        self.run.as_ref()
    }

    /// The separation required of its vehicles in the air, in metres.
    pub fn separation_m(&self) -> f64 {
        let mission = self.run.as_ref().and_then(|run| run.head.flown().ok());
        let rules = mission.map(|it| it.swarm_rules()).unwrap_or_default();
        rules.separation_m
    }

    /// Reads its frames from an offset in the file at which a record begins.
    ///
    /// # Errors
    /// The file is gone.
    pub fn reader(&self, offset: u64, last_us: Option<u64>) -> Result<TlogSalvage<File>, Text> {
        let open = || {
            let mut file = File::open(&self.frames)?;
            file.seek(SeekFrom::Start(offset))?;
            let salvage = TlogSalvage::at(file, offset, last_us);
            Ok(if self.grows {
                salvage.growing()
            } else {
                salvage
            })
        };
        open().map_err(|error: std::io::Error| unread(&self.frames, &error))
    }

    /// Its session, as the console shows it.
    pub fn started(&self) -> Started {
        let mission = self.run.as_ref().and_then(|run| run.head.flown().ok());
        let head = self.journal.as_ref().map(|it| &it.head);
        let mut started = Started {
            activity: Activity::Connected {
                addresses: vec![self.name()],
            },
            mission: None,
            places: head.map(|it| it.places.clone()).unwrap_or_default(),
            areas: Vec::new(),
            processes: None,
            speedup: head.map_or(1.0, |it| it.speedup),
            is_again: false,
        };
        if let (Some(mission), Some(run)) = (mission, &self.run) {
            started.activity = Activity::Mission {
                id: mission.id.clone(),
                title: mission.title.clone(),
                stake: run.head.stake,
            };
            started.places = mission.places();
            started.areas = mission.areas();
            started.mission = Some(Box::new(mission.listing()));
            return started;
        }
        match head.map(|it| &it.subject) {
            Some(Subject::Free) => started.activity = Activity::Free,
            Some(Subject::Connected(addresses)) => {
                started.activity = Activity::Connected {
                    addresses: addresses.clone(),
                };
            }
            Some(Subject::Mission(_)) | None => {}
        }
        started
    }
}

/// The times of the first and of the last frame of a tlog, in microseconds since 1970 (UTC).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TlogSpan {
    pub first_unix_us: u64,
    pub last_unix_us: u64,
}

impl TlogSpan {
    /// Reads the first and the last frame of a tlog of any length.
    ///
    /// # Errors
    /// The file cannot be read, or has no frame.
    pub fn read(path: &Path) -> Result<Self, Text> {
        let unreadable = |error| unread(path, &error);
        let none = || text!("replay-no-tlog", file = path.display().to_string());
        let file = File::open(path).map_err(unreadable)?;
        let len = file.metadata().map_err(unreadable)?.len();
        let first = times(file).next().ok_or_else(none)?;
        let mut tail = File::open(path).map_err(unreadable)?;
        let from = len.saturating_sub(TAIL_LEN);
        tail.seek(SeekFrom::Start(from)).map_err(unreadable)?;
        // If the clock was set in the meantime, the length is known only once the recording has been indexed.
        let plausible = times(tail).filter(|us| us.abs_diff(first) < LONGEST_US);
        Ok(Self {
            first_unix_us: first,
            last_unix_us: plausible.max().unwrap_or(first).max(first),
        })
    }

    /// The span of a record's frames, if they can be read.
    pub fn of(files: &RecordFiles) -> Option<Self> {
        Self::read(files.frames.as_deref()?).ok()
    }

    /// The length, counted from a time of day.
    pub fn length_from(self, began_unix_us: u64) -> Duration {
        Duration::from_micros(self.last_unix_us.saturating_sub(began_unix_us))
    }
}

fn times(file: File) -> impl Iterator<Item = u64> {
    let pieces = TlogSalvage::new(file).map_while(Result::ok);
    pieces.filter_map(|piece| match piece {
        TlogPiece::Record(record) => Some(record.unix_us),
        TlogPiece::Damage { .. } => None,
    })
}

fn no_frames(path: &Path) -> Text {
    let name = path.display().to_string();
    if path.is_file() {
        text!("replay-no-frames", file = name)
    } else {
        text!("replay-no-file", file = name)
    }
}

/// The journal of a recording; an error if it is unreadable, or belongs to a different flight.
fn own_journal(
    files: &RecordFiles,
    span: TlogSpan,
    run: Option<&Stored>,
) -> Result<Option<Journal>, Text> {
    let Some(journal) = files.read_journal()? else {
        return Ok(None);
    };
    let beside = JournalNeighbours {
        mission: run.map(|run| run.head.mission.as_str()),
        first_unix_us: Some(span.first_unix_us),
    };
    let misfit = JournalFit::of(&journal.head, beside).fault();
    misfit.map_or(Ok(Some(journal)), Err)
}

fn read_stored(path: &Path) -> Result<Stored, Text> {
    let text = read_run(path).map_err(|error| unread(path, &error))?;
    Stored::read(&text)
}
