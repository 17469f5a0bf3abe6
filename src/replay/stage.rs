//! The vehicles of a recording, which repeat their telemetry.

use std::collections::BTreeMap;
use std::fs::File;
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use super::growth::Growth;
use super::{FRAME, Film};
use crate::app::event::{Event, LinkEvent, SessionEvent, VehicleEvent};
use crate::app::room::messages::{LinkTraffic, TrafficRequest};
use crate::crew::{CrewRecord, CrewViewpoint};
use crate::ledger::{EntryId, RowUpdate};
use crate::link::{TlogDamage, TlogPiece, TlogRecord, TlogSalvage};
use crate::mission::Progress;
use crate::notice::Notice;
use crate::pilot_in_command::Person;
use crate::record::{EntryLine, Happening, InstructorPart, JournalLine, PathLine};
use crate::text::Text;
use crate::vehicle::Severity;

mod actor;
mod mission;
mod scene;
mod traffic;

use mission::MissionStage;
use scene::Scene;

/// After this long without a record, the recording counts as having a gap, in which vehicles do not count as lost.
const GAP: Duration = Duration::from_secs(2);
/// Smaller steps back in time only pause the clock.
const STEP_BACK_US: i64 = 1_000_000;
/// A longer gap means that the clock was set.
const LONGEST_GAP_US: i64 = 3600 * 1_000_000;
/// The number of a recording's only link.
pub(super) const LINK: u16 = 0;

/// The vehicles, the mission and the traffic of a recording at one moment.
#[derive(Debug)]
pub(super) struct Stage {
    film: Arc<Film>,
    reader: TlogSalvage<File>,
    /// A record that has been read but is not due yet.
    pending: Option<TlogRecord>,
    cast: Cast,
    mission: Option<MissionStage>,
    /// The files of a recording that is still being made.
    growth: Option<Growth>,
    /// The member of a crew who looks, and the host; `None` for the flight of the console's own user.
    viewpoint: Option<CrewViewpoint>,
    heard: u64,
    damage: TlogDamage,
    /// The read error that ended the file before its last byte, if any.
    cut: Option<Text>,
}

/// The state of a stage, to return to later.
#[derive(Debug, Clone)]
pub(super) struct Cast {
    now: Duration,
    scene: Scene,
    next_line: usize,
    /// The index of the next journal line to check for a radio state.
    radio_line: usize,
    elapsed: Duration,
    /// Whether the mission's report has been returned.
    is_over: bool,
    last_heard: Duration,
    /// The correction of the file's times if the clock was set.
    skew_us: i64,
    is_at_end: bool,
    /// The commands so far: the ledger's numbers, by the journal's numbers.
    given: BTreeMap<u32, u32>,
    gap: Option<Duration>,
    /// The offset of the next record in the file, and the time of the record before it.
    offset: u64,
    last_us: Option<u64>,
}

impl Stage {
    /// A stage at the beginning of a recording.
    ///
    /// # Errors
    /// The file is gone.
    pub fn new(film: &Arc<Film>) -> Result<Self, Text> {
        let mut growth = film
            .grows()
            .then(|| Growth::begin(film.files()))
            .transpose()?;
        let mission = match &mut growth {
            Some(growth) => MissionStage::growing(&growth.run()),
            None => film.run().and_then(MissionStage::new),
        };
        Ok(Self {
            reader: film.reader(0, None)?,
            film: Arc::clone(film),
            pending: None,
            cast: Cast {
                now: Duration::ZERO,
                scene: Scene::default(),
                next_line: 0,
                radio_line: 0,
                elapsed: Duration::ZERO,
                is_over: false,
                last_heard: Duration::ZERO,
                skew_us: 0,
                is_at_end: false,
                given: BTreeMap::new(),
                gap: None,
                offset: 0,
                last_us: None,
            },
            mission,
            growth,
            viewpoint: film.viewpoint(),
            heard: 0,
            damage: TlogDamage::default(),
            cut: None,
        })
    }

    /// The time up to which the recording has been played.
    pub fn now(&self) -> Duration {
        self.cast.now
    }

    /// The length of the current gap, if any.
    pub fn gap(&self) -> Option<Duration> {
        self.cast.gap
    }

    /// The current gap, from the last record before it to the first one after it.
    pub fn gap_section(&self) -> Option<Range<Duration>> {
        let from = self.cast.last_heard;
        self.cast.gap.map(|lasts| from..from + lasts)
    }

    /// The number of MAVLink frames received since the stage was built.
    pub fn heard(&self) -> u64 {
        self.heard
    }

    /// The state, to return to later.
    pub fn cast(&self) -> Cast {
        self.cast.clone()
    }

    /// Restores the state of a key frame.
    pub fn restore(&mut self, cast: Cast) {
        // If the file is gone, the recording ends here.
        if let Ok(reader) = self.film.reader(cast.offset, cast.last_us) {
            self.reader = reader;
        }
        self.pending = None;
        self.cast = cast;
        if let Some(mission) = &mut self.mission {
            mission.go_to(self.cast.elapsed);
        }
    }

    /// The same stage, seen by a member of a crew.
    pub fn seen_from(self, viewpoint: CrewViewpoint) -> Self {
        Self {
            viewpoint: Some(viewpoint),
            ..self
        }
    }

    /// Who flies what before anybody has got a vehicle, if a member of a crew looks.
    pub fn begun(&self) -> Option<Event> {
        let viewpoint = self.viewpoint.as_ref()?;
        Some(VehicleEvent::Pilots(viewpoint.begun()).into())
    }

    /// Reads what has been added to a recording that is still being made.
    pub fn grow(&mut self) {
        let Some(growth) = &mut self.growth else {
            return;
        };
        growth.grow_journal();
        let lines = growth.run();
        if let Some(mission) = &mut self.mission {
            mission.flight.grow(&lines);
        }
    }

    /// Advances by one frame, and returns its events.
    pub fn step(&mut self) -> Vec<Event> {
        let until = self.cast.now + FRAME;
        self.hear(until);
        self.change_radio(until);
        self.cast.now = until;
        let is_gap = self.cast.gap.is_some();
        let mut events = self.cast.scene.tell(until, is_gap);
        events.extend(self.read_journal(until));
        events.extend(self.summarise(until));
        events
    }

    /// The events of journal lines that were added after their time had been played: while the clock of a flight stands
    /// still, its lines have the same time.
    pub fn read_late(&mut self) -> Vec<Event> {
        self.read_journal(self.cast.now)
    }

    /// Passes all frames before a time to the vehicles.
    fn hear(&mut self, until: Duration) {
        loop {
            let before = (self.reader.offset(), self.reader.last_us());
            if self.pending.is_none() {
                (self.cast.offset, self.cast.last_us) = before;
                self.pending = self.next_record();
            }
            let Some(unix_us) = self.pending.as_ref().map(|it| it.unix_us) else {
                self.cast.gap = None;
                self.cast.is_at_end = true;
                break;
            };
            let at = self.time_of(unix_us);
            if at >= until {
                let silent = at.saturating_sub(self.cast.last_heard);
                self.cast.gap = (silent >= GAP).then_some(silent);
                break;
            }
            if let Some(record) = self.pending.take() {
                self.heard += 1;
                let silent = at.saturating_sub(self.cast.last_heard);
                if silent >= GAP {
                    self.cast.scene.rest(silent);
                }
                self.cast.last_heard = at;
                self.change_radio(at);
                self.cast.scene.take_in(&record.bytes, at);
            }
        }
    }

    /// Whether the recording has ended.
    pub fn is_over(&self) -> bool {
        self.cast.is_at_end && self.cast.next_line >= self.lines().len()
    }

    /// Converts a timestamp to a time in the recording. If the recorder's clock was set, the next
    /// record counts as one second later than the last.
    fn time_of(&mut self, unix_us: u64) -> Duration {
        let cast = &mut self.cast;
        let since_us = unix_us.saturating_sub(self.film.began_unix_us());
        let raw_us = i64::try_from(since_us).unwrap_or(i64::MAX);
        let last_us = i64::try_from(cast.last_heard.as_micros()).unwrap_or(i64::MAX);
        let mut at_us = raw_us.saturating_add(cast.skew_us);
        if !(last_us - STEP_BACK_US..last_us.saturating_add(LONGEST_GAP_US)).contains(&at_us) {
            at_us = last_us + 1_000_000;
            cast.skew_us = at_us.saturating_sub(raw_us);
        }
        Duration::from_micros(u64::try_from(at_us).unwrap_or(0)).max(cast.last_heard)
    }

    fn next_record(&mut self) -> Option<TlogRecord> {
        loop {
            match self.reader.next()? {
                Ok(TlogPiece::Record(record)) => return Some(record),
                Ok(TlogPiece::Damage { offset, len }) => self.damage.note(offset, len),
                Err(error) => {
                    self.cut = Some(Text::from(&error));
                    return None;
                }
            }
        }
    }

    /// The faults of the frames that have been read since the stage was built.
    pub fn damage(&self) -> Vec<Text> {
        self.damage
            .reason()
            .into_iter()
            .chain(self.cut.clone())
            .collect()
    }

    fn lines(&self) -> &[JournalLine] {
        lines(&self.film, self.growth.as_ref())
    }

    /// Applies the journal's radio states up to a time, so that each frame passes through the radio of its time.
    fn change_radio(&mut self, until: Duration) {
        let lines = lines(&self.film, self.growth.as_ref());
        while let Some(line) = lines.get(self.cast.radio_line)
            && line.at() <= until
        {
            self.cast.radio_line += 1;
            if let Happening::Loss(loss) = &line.what {
                self.cast.scene.change_radio(loss);
            }
        }
    }

    fn read_journal(&mut self, until: Duration) -> Vec<Event> {
        let mut events = Vec::new();
        while let Some(line) = self.lines().get(self.cast.next_line).cloned()
            && line.at() < until
        {
            self.cast.next_line += 1;
            match &line.what {
                Happening::Entry(entry) => {
                    let count = self.cast.given.len() as u32;
                    self.cast.given.insert(entry.id, count);
                    let by = self.viewpoint_of(entry.by.as_ref());
                    events.push(opened(entry, by, line.at()));
                }
                Happening::Row(row) => {
                    // A row whose command is missing belongs to no entry.
                    if let Some(&entry) = self.cast.given.get(&row.id) {
                        let entry = EntryId(entry);
                        let update = RowUpdate {
                            entry,
                            ..row.update(line.at())
                        };
                        events.push(VehicleEvent::Row(update).into());
                    }
                }
                Happening::Foreign(foreign) => {
                    events.push(VehicleEvent::Foreign(foreign.command(line.at())).into());
                }
                Happening::Notice(notice) => events.push(notice.notice(line.at()).into()),
                Happening::Desk(order) => {
                    events.push(SessionEvent::Instructed(Box::new(order.clone())).into());
                }
                Happening::Crew(crew) => events.extend(self.told_of_crew(crew, line.at())),
                Happening::Mission { ms } => {
                    let elapsed = Duration::from_millis(*ms);
                    events.extend(self.fly(elapsed, line.at()));
                }
                Happening::Paths(paths) => {
                    let paths = paths.iter().map(PathLine::path).collect();
                    events.push(VehicleEvent::Paths(paths).into());
                }
                // No frame follows it in this step.
                Happening::Loss(loss) => self.cast.scene.change_radio(loss),
                Happening::Speedup { .. }
                | Happening::Paused { .. }
                | Happening::Bookmark { .. }
                | Happening::End => {}
            }
        }
        events
    }

    /// Who gave a command, as the user of this console sees it.
    fn viewpoint_of(&self, by: Option<&Person>) -> Option<Person> {
        match &self.viewpoint {
            Some(viewpoint) => viewpoint.by(by),
            None => by.cloned(),
        }
    }

    /// A change in the crew, and who flies what after it.
    fn told_of_crew(&self, line: &CrewRecord, at: Duration) -> Vec<Event> {
        let pilots = match &self.viewpoint {
            Some(viewpoint) => viewpoint.pilots(line),
            None => line.pilots(),
        };
        let text = line.change.text(self.viewpoint.as_ref());
        let notice = text.map(|text| Notice::general(at, Severity::Notice, text).into());
        notice
            .into_iter()
            .chain([VehicleEvent::Pilots(pilots).into()])
            .collect()
    }

    fn fly(&mut self, elapsed: Duration, now: Duration) -> Vec<Event> {
        let Some(mission) = &mut self.mission else {
            return Vec::new();
        };
        mission.elapsed = elapsed;
        self.cast.elapsed = elapsed;
        let said = mission.flight.advance(elapsed).into_iter();
        let mut events: Vec<Event> = said
            .map(|notice| Event::Notice(Notice { at: now, ..notice }))
            .collect();
        // Steps without a change have a line only once a second, so the run of a flight that was left may stop before
        // its clock does.
        let progress = Progress {
            elapsed,
            ..mission.flight.flight().progress()
        };
        events.push(SessionEvent::Mission(Box::new(progress)).into());
        let is_left = mission.flight.is_over()
            && self.growth.is_none()
            && self.film.clock().mission_time(Duration::MAX) <= Some(elapsed);
        let has_ended = mission.flight.flight().is_over() || is_left;
        if has_ended && !self.cast.is_over {
            self.cast.is_over = true;
            let mut report = mission.flight.report();
            report.instructor = self
                .film
                .journal()
                .map(InstructorPart::of)
                .unwrap_or_default();
            if let Some(viewpoint) = &self.viewpoint {
                report.seen_from(viewpoint);
            }
            events.push(SessionEvent::MissionEnded(Box::new(report)).into());
        }
        events
    }

    /// The state of the recording's link, once a second.
    fn summarise(&mut self, now: Duration) -> Option<Event> {
        let summary = self.cast.scene.summary(&self.film, now)?;
        Some(LinkEvent::Summaries(vec![summary]).into())
    }

    /// The current traffic, for the *Messages* room.
    pub fn inspect(&mut self, request: &TrafficRequest) -> LinkTraffic {
        let (name, now) = (self.film.name(), self.cast.now);
        self.cast.scene.inspect(request, name, now)
    }
}

impl Cast {
    /// The time up to which the recording has been played.
    pub fn at(&self) -> Duration {
        self.now
    }
}

/// The lines of the journal, as far as they have been read.
fn lines<'a>(film: &'a Film, growth: Option<&'a Growth>) -> &'a [JournalLine] {
    let journal = growth.map_or_else(|| film.journal(), |growth| Some(&growth.journal));
    journal.map_or(&[], |it| &it.lines)
}

fn opened(entry: &EntryLine, by: Option<Person>, at: Duration) -> Event {
    VehicleEvent::Given {
        at,
        line: entry.line.clone(),
        verb: entry.verb,
        risk: entry.risk,
        by,
        vehicles: entry.vehicles.clone(),
    }
    .into()
}
