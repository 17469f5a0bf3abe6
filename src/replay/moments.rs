//! Finds the notable moments of a recording.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Duration;

use crate::alert::AlertKind;
use crate::app::State;
use crate::app::event::{Event, SessionEvent, VehicleEvent};
use crate::ledger::{LedgerEntry, Risk, RowState, RowUpdate};
use crate::mission::Progress;
use crate::moment::{Moment, MomentKind};
use crate::pilot_in_command::Person;
use crate::record::{DeskRecord, MissionClock};
use crate::scoring::{EventKind, Report};
use crate::text;
use crate::text::Text;
use crate::vehicle::{Mode, Vehicle, VehicleId};

mod separation;

use separation::{Approach, NEAR_MARGIN_M, Pair};

/// Events of several vehicles within this time are merged into one moment.
const TOGETHER: Duration = Duration::from_millis(1500);
/// The maximum number of moments that are kept.
const MOST: usize = 10_000;

/// Finds moments while the recording is read.
#[derive(Debug, Default)]
pub(super) struct Lookout {
    found: Vec<Moment>,
    /// Increases whenever the moments change.
    revision: u64,
    /// The last revision returned.
    given: Option<u64>,
    alerts: BTreeSet<(VehicleId, AlertKind)>,
    vehicles: BTreeMap<VehicleId, KnownVehicle>,
    pairs: BTreeMap<Pair, Approach>,
    /// The distance below which the approach of two vehicles becomes a moment, in metres.
    near_m: f64,
    /// The smallest distance of the flight so far.
    nearest: Option<(Pair, Approach)>,
    reached: Vec<bool>,
    barred: Vec<BarredLine>,
    clock: Arc<MissionClock>,
    report: Option<Arc<Report>>,
}

#[derive(Debug, Clone, Copy, Default)]
struct KnownVehicle {
    mode: Option<Mode>,
    is_armed: bool,
}

/// A line that was refused because another person flies the vehicle.
#[derive(Debug)]
struct BarredLine {
    /// When it was refused first.
    at: Duration,
    /// Who gave it; `None` for the user of the console.
    by: Option<Person>,
    /// The line, with the reason.
    text: Text,
    /// How often it was refused.
    count: u32,
}

impl BarredLine {
    fn shown(&self) -> Text {
        if self.count < 2 {
            return self.text.clone();
        }
        text!("moment-times", what = self.text.clone(), count = self.count)
    }
}

impl Lookout {
    /// A lookout at the beginning of a recording; `separation_m` is the required separation between
    /// vehicles, in metres.
    pub fn new(clock: Arc<MissionClock>, separation_m: f64) -> Self {
        Self {
            clock,
            near_m: separation_m + NEAR_MARGIN_M,
            ..Self::default()
        }
    }

    /// The moments so far, if they have changed since the last call.
    pub fn found(&mut self) -> Option<Vec<Moment>> {
        let is_news = self.given.replace(self.revision) != Some(self.revision);
        is_news.then(|| self.found.clone())
    }

    /// Handles the events of one step and the resulting state of the console.
    pub fn watch(&mut self, now: Duration, events: &[Event], state: &State) {
        let mut has_moved = false;
        for event in events {
            match event {
                Event::Vehicle(VehicleEvent::Telemetry(vehicle)) => {
                    has_moved = true;
                    self.see(now, vehicle);
                }
                Event::Vehicle(VehicleEvent::Row(row)) => self.judge(row, state),
                Event::Vehicle(VehicleEvent::Given {
                    at,
                    line,
                    risk: Risk::Unsafe | Risk::SkipsChecks,
                    by,
                    vehicles,
                    ..
                }) => self.add(Moment {
                    at: *at,
                    vehicles: vehicles.clone(),
                    kind: MomentKind::Event,
                    by: by.clone(),
                    text: line.as_str().into(),
                }),
                Event::Session(SessionEvent::Mission(progress)) => self.count(now, progress),
                Event::Session(SessionEvent::MissionEnded(report)) => self.close(report),
                Event::Session(SessionEvent::Instructed(order)) => self.notice(now, order),
                Event::Vehicle(
                    VehicleEvent::Parameters { .. }
                    | VehicleEvent::Folder(_)
                    | VehicleEvent::Given { .. }
                    | VehicleEvent::Foreign(_)
                    | VehicleEvent::Paths(_)
                    | VehicleEvent::Pilots(_)
                    | VehicleEvent::Rehearsed(_),
                )
                | Event::Session(
                    SessionEvent::Started(_)
                    | SessionEvent::Ended
                    | SessionEvent::Paused(_)
                    | SessionEvent::Speedup(_)
                    | SessionEvent::Recalled(_)
                    | SessionEvent::Ghost(_),
                )
                | Event::Terminal(_)
                | Event::Program(_)
                | Event::Tick { .. }
                | Event::Link(_)
                | Event::Process(_)
                | Event::Replay(_)
                | Event::Career(_)
                | Event::Class(_)
                | Event::Crew(_)
                | Event::File(_)
                | Event::Tried(_)
                | Event::Notice(_)
                | Event::NoticesDropped(_)
                | Event::Answer(_)
                | Event::Failed(_) => {}
            }
        }
        if has_moved {
            self.measure(now, state);
        }
        self.alarm(now, state);
    }

    /// The result of the mission, once it is over.
    pub fn report(&self) -> Option<Arc<Report>> {
        self.report.clone()
    }

    /// Adds a moment; nearly simultaneous ones of several vehicles are merged.
    fn add(&mut self, moment: Moment) {
        let place = self.found.partition_point(|it| it.at <= moment.at);
        let recent = self.found[..place].iter_mut().rev();
        let mut same = recent
            .take_while(|it| moment.at.saturating_sub(it.at) < TOGETHER)
            .filter(|it| (it.kind, &it.by, &it.text) == (moment.kind, &moment.by, &moment.text));
        if let Some(known) = same.next() {
            known.vehicles.extend(moment.vehicles);
            known.vehicles.sort_unstable();
            known.vehicles.dedup();
            self.revision += 1;
        } else if self.found.len() < MOST {
            self.found.insert(place, moment);
            self.revision += 1;
        }
    }

    fn see(&mut self, at: Duration, vehicle: &Vehicle) {
        let Some(heartbeat) = vehicle.heartbeat else {
            return;
        };
        let now = KnownVehicle {
            mode: Some(heartbeat.mode),
            is_armed: heartbeat.armed,
        };
        let Some(before) = self.vehicles.insert(vehicle.id, now) else {
            return;
        };
        let mut add = |kind, text| {
            self.add(Moment {
                at,
                vehicles: vec![vehicle.id],
                kind,
                by: None,
                text,
            });
        };
        if before.is_armed != now.is_armed {
            let text = if now.is_armed {
                text!("moment-armed")
            } else {
                text!("moment-disarmed")
            };
            add(MomentKind::Arming, text);
        }
        if before.mode != now.mode {
            let mode = vehicle.name_of(heartbeat.mode);
            add(MomentKind::Mode, text!("moment-mode", mode = mode));
        }
    }

    fn judge(&mut self, row: &RowUpdate, state: &State) {
        let entry = state.session().ledger().entry(row.entry);
        if let Some(entry) = entry.filter(|_| row.state.is_failure()) {
            self.refuse(row, entry);
        }
    }

    /// Adds the failure of a line.
    fn refuse(&mut self, row: &RowUpdate, entry: &LedgerEntry) {
        let (line, by) = (entry.line.as_str(), entry.by.as_ref());
        let outcome = row.state.text();
        let text = match &row.explanation {
            // The reason for a refusal already shows that it is one.
            Some(why) if row.state == RowState::Refused => {
                text!("moment-refused", line = line, outcome = why.clone())
            }
            Some(why) => text!(
                "moment-refused-why",
                line = line,
                outcome = outcome,
                why = why.clone()
            ),
            None => text!("moment-refused", line = line, outcome = outcome),
        };
        let is_barred = row.state == RowState::Barred;
        if is_barred && self.count_again(by, &text) {
            return;
        }
        let by = by.cloned();
        if is_barred {
            self.barred.push(BarredLine {
                at: row.at,
                by: by.clone(),
                text: text.clone(),
                count: 1,
            });
        }
        self.add(Moment {
            at: row.at,
            vehicles: vec![row.vehicle],
            kind: if is_barred {
                MomentKind::Barred
            } else {
                MomentKind::Refusal
            },
            by,
            text,
        });
    }

    /// Counts a line that was barred before, at the moment when it was first; returns whether there is such a moment.
    fn count_again(&mut self, by: Option<&Person>, text: &Text) -> bool {
        let mut all = self.barred.iter_mut();
        let known = all.find(|it| it.by.as_ref() == by && it.text == *text);
        let Some(known) = known else {
            return false;
        };
        let before = known.shown();
        known.count += 1;
        let mut found = self.found.iter_mut();
        let moment = found.find(|it| it.at == known.at && it.by == known.by && it.text == before);
        if let Some(moment) = moment {
            moment.text = known.shown();
            self.revision += 1;
        }
        true
    }

    /// Adds the alerts that have been raised.
    fn alarm(&mut self, at: Duration, state: &State) {
        let open = state.session().alerts().open();
        let mut now = BTreeSet::new();
        for (vehicle, one) in open {
            let key = (vehicle, one.alert.kind);
            now.insert(key);
            if !self.alerts.contains(&key) {
                self.add(Moment {
                    at,
                    vehicles: vec![vehicle],
                    kind: MomentKind::Alert,
                    by: None,
                    text: one.alert.text.clone(),
                });
            }
        }
        self.alerts = now;
    }

    fn count(&mut self, at: Duration, progress: &Progress) {
        self.reached.resize(progress.objectives.len(), false);
        let objectives = progress.objectives.iter().zip(&mut self.reached);
        let news = objectives.filter_map(|(objective, was)| {
            let is = objective.is_reached();
            (!std::mem::replace(was, is) && is).then(|| objective.title.clone())
        });
        let changed: Vec<Text> = news.collect();
        for title in changed {
            self.add(Moment {
                at,
                vehicles: Vec::new(),
                kind: MomentKind::Objective,
                by: None,
                text: text!("moment-objective", objective = title),
            });
        }
    }

    /// Adds an order of the instructor that changed who flies, or what was flown.
    fn notice(&mut self, at: Duration, order: &DeskRecord) {
        if order.changes_flight() {
            self.add(Moment {
                at,
                vehicles: Vec::new(),
                kind: MomentKind::Event,
                by: None,
                text: order.text(),
            });
        }
    }

    /// Adds moments that only the mission's report contains: broken rules, alerts of the mission, events and injects.
    fn close(&mut self, report: &Report) {
        for event in &report.events {
            let kind = match event.kind {
                EventKind::Rule => MomentKind::Rule,
                // The console's own alerts about vehicles are in its state.
                EventKind::Alert if event.vehicle.is_none() || event.about.is_some() => {
                    MomentKind::Alert
                }
                EventKind::MissionEvent | EventKind::Inject => MomentKind::Event,
                EventKind::Objective
                | EventKind::Alert
                | EventKind::Answer
                | EventKind::Rejected
                | EventKind::Hint
                | EventKind::Phase
                | EventKind::Sample
                | EventKind::Load
                | EventKind::Pause => continue,
            };
            let elapsed = Duration::try_from_secs_f64(event.at_s).unwrap_or_default();
            self.add(Moment {
                at: self.clock.record_time(elapsed).unwrap_or_default(),
                vehicles: event.vehicle.into_iter().collect(),
                kind,
                by: None,
                text: event.text.clone(),
            });
        }
        self.report = Some(Arc::new(report.clone()));
        self.revision += 1;
    }
}

#[cfg(test)]
mod tests;
