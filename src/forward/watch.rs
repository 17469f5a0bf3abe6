//! The commands of other ground stations as rows of the ledger: repetitions are one row, and floods are bounded.

use std::collections::BTreeMap;
use std::time::Duration;

use super::answers::{Answered, StationAnswer, answer_in};
use super::commands::Deed;
use crate::ledger::{ForeignCommand, ForeignId, RowState, StationId};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Vehicle, VehicleId};
use crate::wire::{Content, MavAddress};

/// The time within which the same command of a station to a vehicle is a repetition.
const SAME_WITHIN: Duration = Duration::from_secs(60);
/// The maximum number of rows that one station adds for one vehicle within [`BURST`]; further commands share one row.
const BURST_MOST: usize = 6;
const BURST: Duration = Duration::from_secs(10);
/// The minimum time between two reports of a row, except those of a new answer.
const REPORT_EVERY: Duration = Duration::from_secs(1);
/// The minimum time between two reports of a row of setpoints, whose repetitions are not news.
const STEERING_EVERY: Duration = Duration::from_secs(60);
/// The number of pairs of station and vehicle at which the pairs without recent commands are
/// forgotten, at most once in [`REPORT_EVERY`]; while there are as many, further pairs are left
/// out.
const MOST_EXCHANGES: usize = 512;

/// A vehicle and a station that has commanded it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Exchange {
    vehicle: VehicleId,
    station: StationId,
}

/// A row that is still open for repetitions and answers.
#[derive(Debug, Clone)]
struct WatchedRow {
    /// The action; `None` for the row that further commands of a burst share.
    deed: Option<Deed>,
    row: ForeignCommand,
    /// Whether the command itself was seen; otherwise it is known only from its answers, and each
    /// answer counts as one command.
    is_seen: bool,
    /// Whether its first answer was reported.
    is_answered: bool,
    reported_at: Option<Duration>,
    has_news: bool,
}

/// Watches the commands of other stations.
#[derive(Debug)]
pub struct StationWatch {
    own: MavAddress,
    /// The rows of each exchange; the row that was commanded last is at the end, apart from
    /// steering.
    exchanges: BTreeMap<Exchange, Vec<WatchedRow>>,
    next: u32,
    /// When old exchanges were forgotten last.
    cleared_at: Option<Duration>,
}

impl StationWatch {
    /// A watch for a console with this address.
    pub fn new(own: MavAddress) -> Self {
        Self {
            own,
            exchanges: BTreeMap::new(),
            next: 0,
            cleared_at: None,
        }
    }

    /// Notes a station's command to a vehicle. Returns its row if that is to be reported now.
    pub fn commanded(
        &mut self,
        station: StationId,
        deed: &Deed,
        to: &Vehicle,
        now: Duration,
    ) -> Option<ForeignCommand> {
        let exchange = Exchange {
            vehicle: to.id,
            station,
        };
        let watched = self.row(exchange, deed, to, now)?;
        watched.is_seen = true;
        if *deed == Deed::Steering {
            // A stream of setpoints is one action, and has no answer.
            watched.row.count = 1;
            watched.row.state = RowState::SentOnly;
        } else {
            watched.row.count = watched.row.count.saturating_add(1);
            watched.row.state = RowState::Sent;
            watched.row.explanation = None;
        }
        watched.report(now)
    }

    /// Notes a vehicle's answer to a station. Returns the row of its command if that is to be reported now.
    pub fn answered(
        &mut self,
        content: &Content,
        from: &Vehicle,
        now: Duration,
    ) -> Option<ForeignCommand> {
        let answer = answer_in(content, self.own)?;
        let Some(station) = answer.station else {
            return self.heard_by_all(&answer, from.id, now);
        };
        let exchange = Exchange {
            vehicle: from.id,
            station,
        };
        if let Some(watched) = self.answered_row(exchange, &answer, now) {
            if !watched.is_seen && !watched.continues() {
                watched.row.count = watched.row.count.saturating_add(1);
                watched.row.last_at = now;
            }
            watched.answer(&answer);
            return watched.report_answer(now);
        }
        // Its command came another way.
        let watched = self.row(exchange, &answer.to.deed()?, from, now)?;
        watched.row.count = watched.row.count.saturating_add(1);
        watched.answer(&answer);
        watched.report_answer(now)
    }

    /// The row that an answer is for: the one that has waited longest, or else the one that was
    /// commanded last. Answers to commands of the same number cannot be told apart otherwise. If a
    /// command is known only from its answers, the next answer repeats it only if no other command
    /// came between.
    fn answered_row(
        &mut self,
        exchange: Exchange,
        answer: &StationAnswer,
        now: Duration,
    ) -> Option<&mut WatchedRow> {
        let rows = self.exchanges.get_mut(&exchange)?;
        let newest = newest_command(rows).map(|at| rows[at].row.id);
        let fits = |watched: &&mut WatchedRow| {
            let of_burst = matches!(answer.to, Answered::Command(_)) && watched.is_seen;
            let deed = watched.deed.as_ref();
            let is_open = watched.is_seen || watched.continues() || newest == Some(watched.row.id);
            is_open && watched.is_recent(now) && deed.map_or(of_burst, |it| answer.to.fits(it))
        };
        let order = |watched: &&mut WatchedRow| {
            let waits = watched.row.state == RowState::Sent;
            let at = watched.row.last_at;
            (
                !waits,
                if waits {
                    at
                } else {
                    Duration::MAX.saturating_sub(at)
                },
            )
        };
        rows.iter_mut().filter(fits).min_by_key(order)
    }

    /// The row that a parameter's value answers. Every station hears the value, so this is the row
    /// of the station that has set this value, otherwise a row that still waits for an answer. A
    /// value sent before the change marks a row as refused; the right value then marks it as
    /// accepted.
    fn heard_by_all(
        &mut self,
        answer: &StationAnswer,
        vehicle: VehicleId,
        now: Duration,
    ) -> Option<ForeignCommand> {
        let rows = self.exchanges.iter_mut();
        let of_vehicle = rows.filter(|(exchange, _)| exchange.vehicle == vehicle);
        let ranked = of_vehicle.flat_map(|(_, rows)| rows).filter_map(|watched| {
            let fits = watched.deed.as_ref().is_some_and(|it| answer.to.fits(it));
            let is_wanted = watched.other_value(answer).is_none();
            let state = watched.row.state;
            let is_open = state == RowState::Sent || (is_wanted && state == RowState::Refused);
            (fits && is_open && watched.is_recent(now)).then_some((!is_wanted, watched))
        });
        let (_, watched) = ranked.min_by_key(|(is_other, _)| *is_other)?;
        watched.answer(answer);
        watched.report_answer(now)
    }

    /// The rows with changes that were held back and are due now. Old rows are forgotten.
    pub fn due(&mut self, now: Duration) -> Vec<ForeignCommand> {
        let rows = self.exchanges.values_mut().flatten();
        let waiting = rows.filter(|watched| watched.has_news);
        let due = waiting.filter_map(|watched| watched.report(now)).collect();
        self.forget_old(now);
        due
    }

    /// The row of an action: the newest row if it is of the same action, otherwise a new row, or
    /// the shared row of a burst; `None` without room for another pair of vehicle and station. Rows
    /// are in the order of their commands, so `RTL` between two `GUIDED` is not the newest one.
    /// Steering continues beside commands, and has one row.
    fn row(
        &mut self,
        exchange: Exchange,
        deed: &Deed,
        of: &Vehicle,
        now: Duration,
    ) -> Option<&mut WatchedRow> {
        self.make_room(now);
        let is_full = self.exchanges.len() >= MOST_EXCHANGES;
        if is_full && !self.exchanges.contains_key(&exchange) {
            return None;
        }
        let rows = self.exchanges.entry(exchange).or_default();
        rows.retain(|watched| watched.is_recent(now));
        let begun = |watched: &&WatchedRow| now.saturating_sub(watched.row.at) < BURST;
        let is_steering = *deed == Deed::Steering;
        let is_burst = !is_steering && rows.iter().filter(begun).count() >= BURST_MOST;
        if let Some(at) = known_row(rows, deed, is_burst) {
            // It is the newest one now.
            let mut known = rows.remove(at);
            known.row.last_at = now;
            rows.push(known);
            return rows.last_mut();
        }
        let deed = (!is_burst).then(|| deed.clone());
        let what = deed
            .as_ref()
            .map_or_else(|| text!("foreign-further"), |deed| deed.words(of));
        let id = ForeignId(self.next);
        self.next = self.next.wrapping_add(1);
        rows.push(WatchedRow::new(deed, begin(id, exchange, what, now)));
        rows.last_mut()
    }

    /// Forgets old rows if there are many.
    fn make_room(&mut self, now: Duration) {
        let is_early = self
            .cleared_at
            .is_some_and(|at| now.saturating_sub(at) < REPORT_EVERY);
        if self.exchanges.len() >= MOST_EXCHANGES && !is_early {
            self.cleared_at = Some(now);
            self.forget_old(now);
        }
    }

    fn forget_old(&mut self, now: Duration) {
        self.exchanges.retain(|_, rows| {
            rows.retain(|watched| watched.is_recent(now));
            !rows.is_empty()
        });
    }
}

/// The index of the row that was commanded last, apart from steering; `None` without such a row.
fn newest_command(rows: &[WatchedRow]) -> Option<usize> {
    rows.iter().rposition(|watched| !watched.is_steering())
}

/// The index of the row that an action repeats, or of the common row of a burst; `None` if the
/// action needs a new row.
fn known_row(rows: &[WatchedRow], deed: &Deed, is_burst: bool) -> Option<usize> {
    if *deed == Deed::Steering {
        return rows.iter().position(WatchedRow::is_steering);
    }
    let newest = newest_command(rows).filter(|&at| rows[at].deed.as_ref() == Some(deed));
    let common = || rows.iter().position(|watched| watched.deed.is_none());
    newest.or_else(|| if is_burst { common() } else { None })
}

fn begin(id: ForeignId, exchange: Exchange, what: Text, now: Duration) -> ForeignCommand {
    ForeignCommand {
        id,
        station: exchange.station,
        vehicle: exchange.vehicle,
        at: now,
        last_at: now,
        what,
        count: 0,
        state: RowState::Sent,
        explanation: None,
    }
}

impl WatchedRow {
    fn new(deed: Option<Deed>, row: ForeignCommand) -> Self {
        Self {
            deed,
            row,
            is_seen: false,
            is_answered: false,
            reported_at: None,
            has_news: true,
        }
    }

    fn is_recent(&self, now: Duration) -> bool {
        now.saturating_sub(self.row.last_at) < SAME_WITHIN
    }

    fn is_steering(&self) -> bool {
        self.deed == Some(Deed::Steering)
    }

    /// Whether the next answer is about the same command, since the vehicle has only reported progress so far.
    fn continues(&self) -> bool {
        matches!(self.row.state, RowState::InProgress(_))
    }

    /// The value of a parameter in an answer, if it differs from the value that was set.
    fn other_value(&self, answer: &StationAnswer) -> Option<f32> {
        match (&answer.to, &self.deed) {
            (Answered::Parameter(_, value), Some(Deed::Parameter(_, wanted))) => {
                (value.to_bits() != wanted.to_bits()).then_some(*value)
            }
            _ => None,
        }
    }

    fn answer(&mut self, answer: &StationAnswer) {
        (self.row.state, self.row.explanation) = match self.other_value(answer) {
            Some(value) => (
                RowState::Refused,
                Some(text!("foreign-stays", value = value.to_string())),
            ),
            None => (
                answer.ending.state,
                Some(answer.ending.text.clone()).filter(|text| !text.is_empty()),
            ),
        };
    }

    /// Reports the row, unless it was reported a moment ago.
    fn report(&mut self, now: Duration) -> Option<ForeignCommand> {
        self.has_news = true;
        let every = if self.is_steering() {
            STEERING_EVERY
        } else {
            REPORT_EVERY
        };
        let is_due = self
            .reported_at
            .is_none_or(|at| now.saturating_sub(at) >= every);
        is_due.then(|| self.tell(now))
    }

    /// Reports an answer: the first one at once, later ones unless the row was reported a moment
    /// ago.
    fn report_answer(&mut self, now: Duration) -> Option<ForeignCommand> {
        if std::mem::replace(&mut self.is_answered, true) {
            self.report(now)
        } else {
            Some(self.tell(now))
        }
    }

    fn tell(&mut self, now: Duration) -> ForeignCommand {
        self.has_news = false;
        self.reported_at = Some(now);
        self.row.clone()
    }
}
