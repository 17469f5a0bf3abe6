//! The subjects that one program watches, and the states that it has been sent.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Duration;

use super::{
    AircraftView, Ended, EntryView, Fault, ForeignView, ForwardView, LedgerState, LinkView,
    LinksState, Message, MissionState, MissionView, NoticeView, ParameterView, PlanView,
    RecordView, RowView, StateList, Subject, Topic, USUAL_WATCH_S, VehicleView,
};
use crate::app::State;
use crate::ledger::{EntryId, ForeignId, LedgerEntry};
use crate::text;
use crate::vehicle::{Vehicle, VehicleId, Vehicles};

/// A program at the other end of a connection.
#[derive(Debug, Clone, Default)]
pub struct Client {
    watched: BTreeSet<Topic>,
    every: Duration,
    /// When the watched subjects were sent last, by the wall clock.
    sent_at: Option<Duration>,
    commands: CommandNews,
    /// The number of notices listed when the program was last sent any.
    notices: u64,
    vehicles: Vehicles,
    mission: Option<MissionView>,
    knows_mission: bool,
}

impl Client {
    /// Watches these subjects from now on; their present states are sent with the next news.
    pub fn watch(
        &mut self,
        topics: impl IntoIterator<Item = Topic>,
        every_s: Option<f64>,
        state: &State,
    ) {
        *self = Self {
            watched: topics.into_iter().collect(),
            every: Duration::from_secs_f64(every_s.unwrap_or(USUAL_WATCH_S)),
            notices: state.notices().listed(),
            commands: CommandNews {
                next: state.session().ledger().next(),
                foreign: foreign_views(state).collect(),
                ..std::mem::take(&mut self.commands)
            },
            ..Self::default()
        };
    }

    /// Reports the rows of a command that the program has given, until the command has ended.
    pub fn follow(&mut self, entry: EntryId) {
        self.commands.open.insert(entry);
    }

    /// The changes since the last call, even if the interval between two states is not over yet.
    pub fn last_news(&mut self, state: &State, wall: Duration) -> Vec<Message> {
        self.sent_at = None;
        self.news(state, wall)
    }

    /// The changes since the last call that concern the program.
    pub fn news(&mut self, state: &State, wall: Duration) -> Vec<Message> {
        let mut news = Vec::new();
        let all = self.watched.contains(&Topic::Ledger);
        self.commands.news(state, all, &mut news);
        let is_due = self
            .sent_at
            .is_none_or(|sent_at| wall.saturating_sub(sent_at) >= self.every);
        if is_due && !self.watched.is_empty() {
            self.sent_at = Some(wall);
            self.states(state, &mut news);
        }
        news
    }

    fn states(&mut self, state: &State, news: &mut Vec<Message>) {
        if self.watched.contains(&Topic::Notices) {
            let log = state.notices();
            if log.listed() < self.notices {
                // Another session has begun, with a list of its own.
                self.notices = 0;
            }
            let views = log.listed_after(self.notices);
            news.extend(views.map(|line| Message::Notice(NoticeView::new(line, state.locale()))));
            self.notices = log.listed();
        }
        if self.watched.contains(&Topic::Vehicles) {
            news.extend(self.changed_vehicles(state.session().vehicles()));
        }
        if self.watched.contains(&Topic::Mission) {
            let mission = mission(state);
            if mission != self.mission || !self.knows_mission {
                self.knows_mission = true;
                self.mission.clone_from(&mission);
                news.push(Message::Mission(MissionState { id: None, mission }));
            }
        }
    }

    fn changed_vehicles(&mut self, now: &Vehicles) -> Option<Message> {
        let is_same = |(id, vehicle): &(&VehicleId, &Arc<Vehicle>)| {
            let known = self.vehicles.get(id);
            known.is_some_and(|known| Arc::ptr_eq(known, vehicle))
        };
        let changed = now.iter().filter(|one| !is_same(one));
        let list: Vec<_> = changed
            .map(|(_, vehicle)| VehicleView::from(&**vehicle))
            .collect();
        self.vehicles.clone_from(now);
        (!list.is_empty()).then_some(Message::Vehicles(StateList { id: None, list }))
    }
}

/// The commands whose rows are reported.
#[derive(Debug, Clone, Default)]
struct CommandNews {
    /// The entries that are followed and have not ended.
    open: BTreeSet<EntryId>,
    /// The rows of open entries, as they were sent last.
    sent: BTreeMap<EntryId, BTreeMap<VehicleId, RowView>>,
    /// The first entry that has not been looked at.
    next: EntryId,
    /// The commands of other stations, as they were sent last.
    foreign: BTreeMap<ForeignId, ForeignView>,
    /// The revision of the ledger that was looked at last.
    revision: Option<u64>,
}

impl CommandNews {
    /// Adds the changed rows of the commands that are followed, or of all commands if `all` is
    /// true.
    fn news(&mut self, state: &State, all: bool, news: &mut Vec<Message>) {
        let ledger = state.session().ledger();
        if self.revision == Some(ledger.revision()) {
            return;
        }
        self.revision = Some(ledger.revision());
        if ledger.next() < self.next {
            // Another session has begun, with a ledger of its own.
            *self = Self {
                revision: self.revision,
                ..Self::default()
            };
        }
        if all {
            let new = ledger
                .entries()
                .rev()
                .take_while(|entry| entry.id >= self.next);
            self.open.extend(new.map(|entry| entry.id));
        }
        self.next = ledger.next();
        if all {
            self.foreign_news(state, news);
        }
        let open = std::mem::take(&mut self.open);
        for id in open {
            // An entry of an earlier session, or one that the ledger has dropped, has no news.
            let Some(entry) = ledger.entry(id) else {
                self.sent.remove(&id);
                continue;
            };
            self.entry(state, entry, news);
            if entry.is_final() {
                self.sent.remove(&id);
                news.push(Message::Ended(Ended {
                    entry: id.0,
                    done: entry.rows.iter().all(|row| row.state.is_success()),
                }));
            } else {
                self.open.insert(id);
            }
        }
    }

    fn foreign_news(&mut self, state: &State, news: &mut Vec<Message>) {
        let now: BTreeMap<ForeignId, ForeignView> = foreign_views(state).collect();
        let is_new = |(id, view): &(&ForeignId, &ForeignView)| self.foreign.get(id) != Some(view);
        let changed = now.iter().filter(is_new);
        news.extend(changed.map(|(_, view)| Message::Foreign(view.clone())));
        self.foreign = now;
    }

    fn entry(&mut self, state: &State, entry: &LedgerEntry, news: &mut Vec<Message>) {
        let sent = self.sent.entry(entry.id).or_default();
        for row in &entry.rows {
            let view = RowView::new(entry, row, state.locale());
            if sent.get(&row.vehicle) != Some(&view) {
                sent.insert(row.vehicle, view.clone());
                news.push(Message::Row(view));
            }
        }
    }
}

fn foreign_views(state: &State) -> impl Iterator<Item = (ForeignId, ForeignView)> {
    let commands = state.session().ledger().foreign();
    commands.map(|command| (command.id, ForeignView::new(command, state.locale())))
}

fn mission(state: &State) -> Option<MissionView> {
    let session = state.session();
    let progress = session.mission()?;
    Some(MissionView::new(
        progress,
        session.places(),
        session.is_over(),
        state.locale(),
    ))
}

/// The present state of a subject, as an answer to the request with this number. `records` lists
/// the recorded flights.
///
/// # Errors
/// The subject belongs to one vehicle, and the request names no vehicle or an unknown one.
pub fn present(
    state: &State,
    id: Option<u64>,
    what: Subject,
    vehicle: Option<VehicleId>,
    records: impl FnOnce() -> Vec<RecordView>,
) -> Result<Message, Fault> {
    let (session, locale) = (state.session(), state.locale());
    Ok(match what {
        Subject::Vehicles => {
            let vehicles = session.vehicles().values();
            let list = vehicles.map(|vehicle| VehicleView::from(&**vehicle));
            Message::Vehicles(StateList::new(id, list))
        }
        Subject::Notices => {
            let lines = state.notices().lines();
            let list = lines.map(|line| NoticeView::new(line, locale));
            Message::Notices(StateList::new(id, list))
        }
        Subject::Ledger => {
            let (entries, foreign) = (session.ledger().entries(), session.ledger().foreign());
            Message::Ledger(LedgerState {
                id,
                list: entries.map(|entry| EntryView::new(entry, locale)).collect(),
                foreign: foreign.map(|it| ForeignView::new(it, locale)).collect(),
            })
        }
        Subject::Mission => Message::Mission(MissionState {
            id,
            mission: mission(state),
        }),
        Subject::Links => {
            let (links, forwards) = (session.links().iter(), session.forwards().iter());
            Message::Links(LinksState {
                id,
                list: links.map(|it| LinkView::new(it, locale)).collect(),
                forwards: forwards.map(|it| ForwardView::new(it, locale)).collect(),
            })
        }
        Subject::Traffic => {
            let tracked = session.traffic().tracked().iter();
            let list = tracked.map(|it| AircraftView::new(it, state.now()));
            Message::Traffic(StateList::new(id, list))
        }
        Subject::Parameters => {
            let vehicle = named(state, id, vehicle)?.id;
            let known = state.rooms().parameters().lists().get(&vehicle);
            let views = known.iter().flat_map(|known| {
                known.list.iter().map(|(name, parameter)| {
                    let default = known.list.default_of(name);
                    let document = state.documents_of(Some(vehicle)).get(name);
                    ParameterView::new(name, parameter, default, document)
                })
            });
            Message::Parameters(StateList::new(id, views))
        }
        Subject::Plan => Message::Plan(PlanView::new(id, named(state, id, vehicle)?)),
        Subject::Records => Message::Records(StateList::new(id, records())),
    })
}

fn named(state: &State, id: Option<u64>, vehicle: Option<VehicleId>) -> Result<&Vehicle, Fault> {
    let fault = |text| Fault::new(id, state.locale().text(&text));
    let vehicle = vehicle.ok_or_else(|| fault(text!("api-which-vehicle")))?;
    let known = state.session().vehicles().get(&vehicle);
    known
        .map(Arc::as_ref)
        .ok_or_else(|| fault(text!("order-no-vehicle", vehicle = vehicle)))
}
