//! The notices, newest last; identical ones within a short time are folded into one line.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::time::Duration;

use super::FlightView;
use crate::alert::AlertKind;
use crate::notice::{Notice, NoticeSource};
use crate::text;
use crate::vehicle::{Severity, VehicleId};

pub const LINES_KEPT: usize = 1000;
/// How long after a line's first notice the line also counts identical ones.
const FOLD_TIME: Duration = Duration::from_secs(10);

/// The maximum number of lines for texts of one vehicle within [`FOLD_TIME`]: as many as it sends
/// when it starts.
const TEXTS_OF_ONE: usize = 10;
/// The maximum number of lines for texts of all vehicles together within [`FOLD_TIME`].
const TEXTS_OF_ALL: usize = 30;

/// The number of lines searched for an identical notice, to limit the cost of a flood.
const LINES_SEARCHED: usize = 50;

/// One line: a text, its count, and its vehicles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NoticeLine {
    /// The first notice of the line.
    pub notice: Notice,
    /// The number of notices counted on the line.
    pub count: u32,
    pub vehicles: BTreeSet<VehicleId>,
    /// The time of the last notice on the line.
    last: Duration,
    /// The session time of the first notice, once the session is over.
    kept_time: Option<Duration>,
    content: LineContent,
}

/// The notices that a line represents.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LineContent {
    /// One notice and its repetitions.
    Notice,
    /// The texts of vehicles that are counted but not listed.
    UnlistedTexts,
}

impl NoticeLine {
    /// Whether the line holds a vehicle's text, or counts unlisted texts.
    pub fn is_of_vehicle(&self) -> bool {
        match self.content {
            LineContent::Notice => self.notice.source == NoticeSource::Vehicle,
            LineContent::UnlistedTexts => true,
        }
    }

    /// The session time of the line's first notice; for a notice from an earlier session, that
    /// session's time.
    pub fn time(&self, session: &FlightView) -> Duration {
        self.kept_time
            .unwrap_or_else(|| session.time(self.notice.at))
    }

    fn count(&mut self, notice: &Notice) {
        self.count += 1;
        self.vehicles.extend(notice.vehicle);
        self.last = notice.at;
    }
}

/// The list of notices.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct NoticeLog {
    lines: VecDeque<NoticeLine>,
    total: u64,
    /// The times of each vehicle's newest [`TEXTS_OF_ONE`] texts, oldest first.
    texts: BTreeMap<VehicleId, VecDeque<Duration>>,
    /// The times of the texts listed within [`FOLD_TIME`], oldest first.
    listed: VecDeque<Duration>,
    /// Notices that were dropped because the console was busy.
    pub(in crate::app) dropped: u64,
}

impl NoticeLog {
    /// Notices that were dropped because the console was busy.
    pub fn dropped(&self) -> u64 {
        self.dropped
    }

    /// Adds a notice. If an identical one was added recently, the new one is counted on its line, unless its vehicle
    /// has sent another text since: the order of one vehicle's texts is kept. The line keeps its time and place.
    pub fn push(&mut self, notice: Notice) {
        if let Some(line) = self.open_line(&notice) {
            line.count(&notice);
        } else if self.is_flooded(&notice) {
            self.count_unlisted(&notice);
        } else {
            self.list(notice, LineContent::Notice);
        }
    }

    /// Whether a kind of alert of a vehicle has been reported since `since`. Lines older than
    /// `FOLD_TIME` before that cannot contain such a report, so they are not searched.
    pub fn reports(&self, kind: AlertKind, vehicle: VehicleId, since: Duration) -> bool {
        let may_report = |line: &&NoticeLine| line.notice.at.saturating_add(FOLD_TIME) >= since;
        let mut newest_first = self.lines.iter().rev().take_while(may_report);
        newest_first.any(|line| {
            let is_of = line.notice.kind == Some(kind) && line.vehicles.contains(&vehicle);
            is_of && line.last >= since
        })
    }

    /// Keeps the times of all lines by the clock of a session that ends.
    pub(in crate::app) fn keep_times(&mut self, session: &FlightView) {
        for line in &mut self.lines {
            line.kept_time = Some(line.time(session));
        }
    }

    /// The number of lines listed so far, including those dropped since.
    pub fn listed(&self) -> u64 {
        self.total
    }

    /// The lines listed after the first `count`, oldest first, without those dropped since.
    pub fn listed_after(&self, count: u64) -> impl Iterator<Item = &NoticeLine> {
        let new = usize::try_from(self.total.saturating_sub(count)).unwrap_or(usize::MAX);
        let known = self.lines.len().saturating_sub(new);
        self.lines.range(known..)
    }

    fn list(&mut self, notice: Notice, content: LineContent) {
        self.total += 1;
        self.lines.push_back(NoticeLine {
            count: 1,
            vehicles: notice.vehicle.into_iter().collect(),
            last: notice.at,
            kept_time: None,
            notice,
            content,
        });
        if self.lines.len() > LINES_KEPT {
            self.lines.pop_front();
        }
    }

    /// Whether a text exceeds the limit for its vehicle or for all vehicles; it would then crowd
    /// out the console's own notices.
    fn is_flooded(&mut self, notice: &Notice) -> bool {
        let is_text = notice.source == NoticeSource::Vehicle;
        let Some(vehicle) = notice.vehicle.filter(|_| is_text) else {
            return false;
        };
        let is_over = |at: &Duration| notice.at.saturating_sub(*at) > FOLD_TIME;
        while self.listed.front().is_some_and(is_over) {
            self.listed.pop_front();
        }
        let own = self.texts.entry(vehicle).or_default();
        while own.front().is_some_and(is_over) {
            own.pop_front();
        }
        let is_flood = own.len() >= TEXTS_OF_ONE || self.listed.len() >= TEXTS_OF_ALL;
        own.push_back(notice.at);
        if own.len() > TEXTS_OF_ONE {
            own.pop_front();
        }
        if !is_flood {
            self.listed.push_back(notice.at);
        }
        is_flood
    }

    /// Counts a text on the line for unlisted texts, which stays open during the flood.
    fn count_unlisted(&mut self, notice: &Notice) {
        let mut newest_first = self.lines.iter_mut().rev().take(LINES_SEARCHED);
        let open = newest_first.find(|line| {
            let is_open = notice.at.saturating_sub(line.last) <= FOLD_TIME;
            is_open && line.content == LineContent::UnlistedTexts
        });
        if let Some(line) = open {
            line.count(notice);
        } else {
            let vehicle = notice.vehicle;
            let notice = Notice::general(notice.at, Severity::Warning, text!("heard-flood"));
            self.list(Notice { vehicle, ..notice }, LineContent::UnlistedTexts);
        }
    }

    /// The line that a notice joins, if any.
    fn open_line(&mut self, notice: &Notice) -> Option<&mut NoticeLine> {
        let is_recent =
            |line: &&mut NoticeLine| notice.at.saturating_sub(line.notice.at) <= FOLD_TIME;
        let newest_first = self.lines.iter_mut().rev().take(LINES_SEARCHED);
        for line in newest_first.take_while(is_recent) {
            let alike = line.notice.text == notice.text && line.notice.severity == notice.severity;
            if alike && line.notice.vehicle.is_some() == notice.vehicle.is_some() {
                return Some(line);
            }
            let is_since = match notice.vehicle {
                Some(vehicle) => line.vehicles.contains(&vehicle),
                None => line.vehicles.is_empty(),
            };
            if is_since {
                return None;
            }
        }
        None
    }

    /// The lines, oldest first.
    pub fn lines(&self) -> impl DoubleEndedIterator<Item = &NoticeLine> + ExactSizeIterator {
        self.lines.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn notice(vehicle: VehicleId, text: &str) -> Notice {
        Notice {
            at: Duration::ZERO,
            vehicle: Some(vehicle),
            severity: Severity::Info,
            kind: None,
            source: NoticeSource::Vehicle,
            text: text.into(),
        }
    }

    #[test]
    fn equal_texts_of_interleaved_vehicles_become_one_line() {
        let mut log = NoticeLog::default();
        for (vehicle, text) in [(1, "a"), (2, "a"), (1, "a"), (2, "b"), (3, "a"), (2, "a")] {
            log.push(notice(vehicle, text));
        }
        let counts: Vec<_> = log
            .lines()
            .map(|line| {
                (
                    line.notice.text.to_string(),
                    line.count,
                    line.vehicles.len(),
                )
            })
            .collect();
        let counted = |text: &str, count, vehicles| (text.to_owned(), count, vehicles);
        assert_eq!(
            counts,
            [counted("a", 4, 3), counted("b", 1, 1), counted("a", 1, 1)],
            "2 has said something else before it said that again"
        );
    }

    #[test]
    fn an_alert_is_found_behind_any_number_of_later_notices() {
        let mut log = NoticeLog::default();
        let s = Duration::from_secs;
        log.push(Notice {
            at: s(100),
            kind: Some(AlertKind::LinkLost),
            source: NoticeSource::Program,
            ..notice(1, "link lost")
        });
        for number in 0..LINES_SEARCHED + 10 {
            let text = number.to_string().into();
            log.push(Notice::general(s(101), Severity::Info, text));
        }
        assert!(log.reports(AlertKind::LinkLost, 1, s(98)));
        assert!(!log.reports(AlertKind::LinkLost, 2, s(98)));
        assert!(!log.reports(AlertKind::Battery, 1, s(98)));
        assert!(!log.reports(AlertKind::LinkLost, 1, s(101)), "before that");
    }

    #[test]
    fn a_line_keeps_its_time_and_takes_in_nothing_that_comes_much_later() {
        let mut log = NoticeLog::default();
        for at_s in [0, 8, 10, 11] {
            let at = Duration::from_secs(at_s);
            log.push(Notice {
                at,
                ..notice(1, "a")
            });
        }
        let lines: Vec<_> = log
            .lines()
            .map(|line| (line.notice.at.as_secs(), line.count))
            .collect();
        assert_eq!(lines, [(0, 3), (11, 1)]);
    }

    #[test]
    fn a_flood_of_texts_takes_few_lines_as_long_as_it_lasts() {
        let mut log = NoticeLog::default();
        let own = Notice::general(Duration::ZERO, Severity::Info, "the console's own".into());
        log.push(own);
        for number in 0..3000_u64 {
            log.push(Notice {
                at: Duration::from_millis(number * 10),
                ..notice(1 + (number % 3) as VehicleId, &format!("text {number}"))
            });
        }
        let lines: Vec<_> = log.lines().collect();
        assert_eq!(lines[0].notice.text.to_string(), "the console's own");
        let unlisted: Vec<_> = lines
            .iter()
            .filter(|it| it.content == LineContent::UnlistedTexts)
            .collect();
        assert_eq!(lines.len(), 1 + 3 * TEXTS_OF_ONE + 1, "{lines:?}");
        assert_eq!(unlisted.len(), 1, "one flood, one line");
        assert_eq!(unlisted[0].count as usize, 3000 - 3 * TEXTS_OF_ONE);
        assert_eq!(unlisted[0].vehicles.len(), 3);
    }

    #[test]
    fn many_vehicles_together_are_a_flood_and_a_start_is_none() {
        let mut log = NoticeLog::default();
        for vehicle in 1..=200 {
            log.push(notice(vehicle, &format!("text {vehicle}")));
        }
        assert_eq!(log.lines().len(), TEXTS_OF_ALL + 1);
        let mut start = NoticeLog::default();
        for number in 0..TEXTS_OF_ONE {
            start.push(notice(1, &format!("text {number}")));
        }
        assert_eq!(start.lines().len(), TEXTS_OF_ONE);
        assert!(
            start
                .lines()
                .all(|line| line.content == LineContent::Notice)
        );
    }

    #[test]
    fn the_list_stays_bounded() {
        let mut log = NoticeLog::default();
        for number in 0..LINES_KEPT + 5 {
            let text = number.to_string().into();
            let own = Notice::general(Duration::ZERO, Severity::Info, text);
            log.push(own);
        }
        assert_eq!(log.lines().len(), LINES_KEPT);
        assert_eq!(
            log.lines().next().map(|line| &line.notice.text),
            Some(&"5".into())
        );
    }
}
