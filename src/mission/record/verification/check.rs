//! The comparison of a record with its flight, step by step.

use std::collections::BTreeMap;
use std::time::Duration;

use super::other_program;
use super::reflight::{Divergence, LATE_AT_MOST, Reflight, SHOWN_WITHIN, differs};
use crate::mission::TICK;
use crate::mission::record::line::ShownVehicles;
use crate::mission::record::observed::ObservedVehicle;
use crate::mission::record::{Reenactment, Stored};
use crate::record::StoredInputs;
use crate::session::Want;
use crate::sim::STEP;
use crate::text;
use crate::vehicle::VehicleId;

mod ending;
mod wanted;

use wanted::WantedParameter;

/// The maximum by which the mission's clock may be ahead of the simulator step recorded with it.
const NOTED_WITHIN: Duration = Duration::from_millis(100);

/// Compares a record with its flight, step by step.
pub(super) struct RecordCheck {
    reenactment: Reenactment,
    reflight: Reflight,
    recorded: BTreeMap<VehicleId, ObservedVehicle>,
    /// Vehicles with a bad radio, and the time until which its effects may last.
    muffled: BTreeMap<VehicleId, Duration>,
    /// The mission's latest demands on simulators.
    wanted: BTreeMap<(VehicleId, &'static str), WantedParameter>,
    /// The timing of the record, once its first line is read.
    clock: Option<RecordClock>,
    /// Mission time of the last step compared.
    ticked: Duration,
    /// Simulated time of the last line compared.
    seen_to: Duration,
    went_on: bool,
}

#[derive(Clone, Copy)]
struct RecordClock {
    /// Whether the simulator had its own clock.
    is_paced: bool,
    /// The mission time and the simulator time in the first line.
    mission: Duration,
    simulated: Duration,
}

impl RecordClock {
    fn of(shown: &ShownVehicles<'_>) -> Self {
        Self {
            is_paced: shown.simulated.is_some(),
            mission: shown.mission,
            simulated: shown.simulated.unwrap_or(shown.mission),
        }
    }

    /// How far the clocks of the mission and the simulator have drifted apart, from the first line
    /// to this one.
    fn drift(&self, shown: &ShownVehicles<'_>) -> Duration {
        let now = Self::of(shown);
        let mission = now.mission.saturating_sub(self.mission);
        let simulated = now.simulated.saturating_sub(self.simulated);
        mission.abs_diff(simulated)
    }
}

impl RecordCheck {
    pub(super) fn new(reenactment: Reenactment, reflight: Reflight) -> Self {
        Self {
            reenactment,
            reflight,
            recorded: BTreeMap::new(),
            muffled: BTreeMap::new(),
            wanted: BTreeMap::new(),
            clock: None,
            ticked: Duration::ZERO,
            seen_to: Duration::ZERO,
            went_on: false,
        }
    }

    /// Compares the lines of a record in order. A record without an end is compared as far as it
    /// and its input log go.
    pub(super) fn run(&mut self, stored: &Stored) -> Result<(), Divergence> {
        let is_open = stored.is_open();
        for line in stored.lines.iter() {
            match line.shown() {
                Some(shown) if is_open && self.is_beyond_cut(&shown) => break,
                Some(shown) => self.take(&shown)?,
                // Until the end, steps without a line show nothing new.
                None if line.end().is_some() && !self.is_paced() => {
                    let end = Duration::from_millis(line.time().unwrap_or_default());
                    self.pass(end + TICK)?;
                }
                None => {}
            }
        }
        // A console's log may lack its last line. The record was still compared up to its end, so a missing input would
        // have been noticed.
        if self.reflight.is_cut && (is_open || self.is_paced()) {
            self.reflight.damage = None;
        }
        if is_open {
            self.compare_wanted()?;
            self.went_on = self.goes_on()?;
        }
        self.reflight.finish()?;
        match stored.damaged_line().filter(|_| !is_open) {
            Some(damage) => Err(self.reflight.differs(None, damage.clone())),
            None => Ok(()),
        }
    }

    /// Compares the states in a line with the repeated flight.
    fn take(&mut self, shown: &ShownVehicles<'_>) -> Result<(), Divergence> {
        let at = shown.simulated.unwrap_or(shown.mission);
        let clock = *self.clock.get_or_insert(RecordClock::of(shown));
        let late = |real: Duration| real.mul_f64(self.reflight.pace).min(LATE_AT_MOST);
        let (back, ahead) = (late(SHOWN_WITHIN), late(NOTED_WITHIN));
        if clock.is_paced != shown.simulated.is_some() || clock.drift(shown) > back {
            return Err(differs(at, None, text!("verify-other-clock")));
        }
        let (back, ahead) = if clock.is_paced {
            // Steps without a line may have changed a radio.
            self.follow(shown.mission.saturating_sub(TICK), at);
            self.wait(at, back, ahead)?;
            (back, ahead)
        } else {
            self.pass(shown.mission)?;
            (Duration::ZERO, Duration::ZERO)
        };
        let until = at + ahead;
        self.reflight.fly_to(steps(until))?;
        for change in shown.vehicles {
            let known = self.recorded.entry(change.id());
            known.or_insert_with(|| change.clone()).update(change);
            self.compare(change, at.saturating_sub(LATE_AT_MOST), until)?;
        }
        self.compare_all(at, at.saturating_sub(back), until)?;
        (self.ticked, self.seen_to) = (shown.mission, at);
        self.follow(shown.mission, at);
        Ok(())
    }

    fn is_paced(&self) -> bool {
        self.clock.is_some_and(|clock| clock.is_paced)
    }

    /// Flies on to a line's time, on the simulator's own clock, and checks that the vehicles keep
    /// the recorded state until then.
    fn wait(&mut self, until: Duration, back: Duration, ahead: Duration) -> Result<(), Divergence> {
        if self.recorded.is_empty() {
            return Ok(());
        }
        let mut at = self.seen_to + TICK;
        while at < until {
            self.reflight.fly_to(steps(at + ahead))?;
            self.compare_all(at, at.saturating_sub(back), at + ahead)?;
            at += TICK;
        }
        Ok(())
    }

    /// Runs the steps before a mission time that have no line, and checks that the vehicles keep
    /// the recorded state. The simulator's time is the mission's here.
    fn pass(&mut self, until: Duration) -> Result<(), Divergence> {
        while self.ticked + TICK < until {
            self.ticked += TICK;
            let at = self.ticked;
            self.reflight.fly_to(steps(at))?;
            self.compare_all(at, at, at)?;
            self.follow(at, at);
        }
        Ok(())
    }

    /// Compares all recorded values of the vehicles with a good radio.
    fn compare_all(&self, at: Duration, from: Duration, to: Duration) -> Result<(), Divergence> {
        for (id, recorded) in &self.recorded {
            if self.muffled.get(id).is_none_or(|until| *until < at) {
                self.compare(recorded, from, to)?;
            }
        }
        Ok(())
    }

    /// Notes the mission's demands on radios and simulator parameters.
    fn follow(&mut self, mission: Duration, at: Duration) {
        drop(self.reenactment.advance(mission));
        for (vehicle, want) in self.reenactment.take_wants() {
            match want {
                Want::Radio(fault) => {
                    let is_bad = fault.loss > 0.0 || !fault.delay.is_zero();
                    let until = if is_bad {
                        Duration::MAX
                    } else {
                        at + LATE_AT_MOST
                    };
                    self.muffled.insert(vehicle, until);
                }
                Want::Parameter { name, value } => {
                    let wanted = self.wanted.entry((vehicle, name)).or_default();
                    wanted.want(value, at);
                    wanted.forget(self.seen_to);
                }
                // The recorded frames put the lists on board; a different plan would lead to a
                // different flight. Missions refuse tests of the radio.
                Want::Lists(_) | Want::RadioTest(_) => {}
            }
        }
    }

    /// Checks that the simulator's weather and faults were set as the mission demands.
    fn compare_wanted(&self) -> Result<(), Divergence> {
        for ((id, name), wanted) in &self.wanted {
            let mut witnesses = self.reflight.witnesses.iter();
            let Some(vehicle) = witnesses.position(|it| it.session.vehicle().id == *id) else {
                continue;
            };
            let is_set = self.reflight.world.parameter(vehicle, name);
            if !wanted.permits(is_set, self.seen_to) {
                let what = text!("verify-other-parameter", name = *name);
                return Err(self.reflight.differs(Some(*id), what));
            }
        }
        Ok(())
    }

    /// Checks that the vehicle had this state at some time in an interval.
    fn compare(
        &self,
        recorded: &ObservedVehicle,
        from: Duration,
        to: Duration,
    ) -> Result<(), Divergence> {
        let id = recorded.id();
        let mut witnesses = self.reflight.witnesses.iter();
        let witness = witnesses
            .find(|witness| witness.session.vehicle().id == id)
            .ok_or_else(|| differs(to, Some(id), text!("verify-no-vehicle")))?;
        let mut said = recorded.said().iter();
        if !said.all(|text| witness.has_said(text, from)) {
            return Err(differs(to, Some(id), text!("verify-other-text")));
        }
        match recorded.unseen(&witness.known(from, to)) {
            Some(what) => Err(differs(to, Some(id), what)),
            None => Ok(()),
        }
    }

    /// Checks that the record and its input log name the same program.
    pub(super) fn compare_programs(
        &self,
        stored: &Stored,
        inputs: &StoredInputs,
    ) -> Result<(), Divergence> {
        let (one, other) = (&stored.head.program, &inputs.head.program);
        if one == other {
            return Ok(());
        }
        Err(self.reflight.differs(None, other_program(one, other)))
    }
}

fn steps(at: Duration) -> u64 {
    (at.as_nanos() / STEP.as_nanos()) as u64
}
