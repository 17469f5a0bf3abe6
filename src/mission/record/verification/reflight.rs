//! The simulated vehicles of a record, repeated.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;

use mavlink::dialects::ardupilotmega::{MavCmd, MavMessage, MavResult};

use crate::mission::is_due;
use crate::mission::record::observed::ObservedVehicle;
use crate::mission::saying::TextListener;
use crate::record::{Entered, InputLine, StoredInputs, fingerprint, has_fingerprint};
use crate::session::Session;
use crate::sim::{Airframe, PortId, STEP, World, WorldConfig};
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::wire::{AUTOPILOT_COMPONENT, Content, Decoder, Frame, SystemId};

/// The longest delay before a console shows a vehicle's telemetry.
pub(super) const SHOWN_WITHIN: Duration = Duration::from_millis(2500);
/// The longest delay of telemetry through a bad radio.
pub(super) const LATE_AT_MOST: Duration = Duration::from_secs(30);
/// The highest speed-up of a session.
const FASTEST: f64 = 100.0;
/// The time between the sessions' checks of their deadlines.
const SESSION_POLL: Duration = Duration::from_millis(50);

/// A difference between a record and its flight.
#[derive(Debug, Clone, PartialEq)]
pub struct Divergence {
    pub at: Duration,
    /// The vehicle concerned, if any.
    pub vehicle: Option<VehicleId>,
    /// A description of the difference.
    pub what: Text,
}

/// A difference at a simulated time.
pub(super) fn differs(at: Duration, vehicle: Option<VehicleId>, what: Text) -> Divergence {
    Divergence { at, vehicle, what }
}

/// The simulated vehicles of a record, repeated.
pub(super) struct Reflight {
    pub(super) world: World,
    lines: Vec<InputLine>,
    pub(super) damage: Option<Text>,
    /// Whether the log's only fault is a missing end.
    pub(super) is_cut: bool,
    /// The speed-up of time over the wall clock.
    pub(super) pace: f64,
    next: usize,
    /// The step of the last fingerprints that were compared.
    compared: u64,
    connections: BTreeMap<u64, (PortId, Decoder)>,
    pub(super) witnesses: Vec<Witness>,
    bytes: Vec<u8>,
}

impl Reflight {
    /// Creates the vehicles of a log; an error text if that is impossible.
    pub(super) fn new(config: &mut WorldConfig, inputs: &StoredInputs) -> Result<Self, Text> {
        if !inputs.head.fits(config) {
            return Err(text!("verify-other-start"));
        }
        let files = inputs.head.airframes.iter();
        let own: Vec<Arc<Airframe>> = files
            .map(|file| Airframe::from_json(&file.to_string()))
            .map(|read| read.map(|(airframe, _)| Arc::new(airframe)))
            .collect::<Result<_, _>>()
            .map_err(|error| Text::verbatim(error.to_string()))?;
        if !own.is_empty() {
            config.airframes = own;
        }
        config.boot = inputs.head.world().boot;
        let world = World::new(config);
        let systems = (1..=SystemId::MAX).take(world.vehicles());
        Ok(Self {
            witnesses: systems.map(Witness::new).collect(),
            world,
            lines: inputs.lines.clone(),
            damage: inputs.damage.clone(),
            is_cut: inputs.is_cut(),
            pace: 1.0,
            next: 0,
            compared: 0,
            connections: BTreeMap::new(),
            bytes: Vec::new(),
        })
    }

    /// The simulated time that the log covers.
    pub(super) fn lasts(&self) -> Duration {
        self.lines.last().map_or(Duration::ZERO, InputLine::at)
    }

    /// Flies on up to a step, which the log must cover.
    pub(super) fn fly_to(&mut self, step: u64) -> Result<(), Divergence> {
        let last = self.lines.last().map_or(0, |line| line.s);
        let beyond = LATE_AT_MOST.as_nanos() / STEP.as_nanos();
        if u128::from(step) > u128::from(last) + beyond {
            return Err(self.differs(None, text!("verify-beyond-inputs")));
        }
        while self.world.steps() < step {
            self.enter()?;
            self.world.step();
            self.hear();
        }
        Ok(())
    }

    /// Flies on to the end of the log.
    pub(super) fn finish(&mut self) -> Result<(), Divergence> {
        let last = self.lines.last().map_or(0, |line| line.s);
        self.fly_to(last)?;
        self.enter()?;
        match self.damage.take() {
            Some(damage) => Err(self.differs(None, damage)),
            None => Ok(()),
        }
    }

    /// Applies the inputs that the log has for the current step, and compares the fingerprints.
    fn enter(&mut self) -> Result<(), Divergence> {
        while let Some(line) = self.lines.get(self.next)
            && line.s == self.world.steps()
        {
            let is_unproved = line.what == Entered::End && self.compared != line.s;
            if let Entered::State(prints) = &line.what {
                self.compare(prints)?;
                self.compared = line.s;
            }
            if is_unproved {
                return Err(self.differs(None, text!("verify-no-state")));
            }
            let line = &self.lines[self.next];
            let unfit = || self.differs(None, text!("verify-unfit-input"));
            let inputs = line.inputs().ok_or_else(unfit)?;
            for input in inputs {
                if !self.world.enter(&input) {
                    return Err(self.differs(None, text!("verify-unfit-input")));
                }
            }
            self.connect();
            self.next += 1;
        }
        self.require_state()
    }

    /// Checks that the log has the fingerprints that are due at this step.
    fn require_state(&self) -> Result<(), Divergence> {
        let step = self.world.steps();
        let is_within = self.lines.last().is_some_and(|last| step < last.s);
        if has_fingerprint(step) && is_within && self.compared != step {
            return Err(self.differs(None, text!("verify-no-state")));
        }
        Ok(())
    }

    /// Starts to read from new connections, and stops reading from ended ones.
    fn connect(&mut self) {
        match self.lines[self.next].what {
            Entered::On(vehicle, connection, _) => {
                let port = PortId::numbered(vehicle, connection);
                self.connections.insert(connection, (port, Decoder::new()));
            }
            Entered::Off(_, connection) => drop(self.connections.remove(&connection)),
            Entered::Pace(pace) => self.pace = pace.clamp(1.0, FASTEST),
            Entered::In(_) | Entered::State(_) | Entered::End => {}
        }
    }

    fn compare(&self, prints: &[String]) -> Result<(), Divergence> {
        if prints.len() != self.world.vehicles() {
            return Err(self.differs(None, text!("verify-other-state")));
        }
        for (vehicle, print) in prints.iter().enumerate() {
            if *print != fingerprint(&self.world, vehicle) {
                let id = self.witnesses[vehicle].session.vehicle().id;
                return Err(self.differs(Some(id), text!("verify-other-state")));
            }
        }
        Ok(())
    }

    fn hear(&mut self) {
        let now = self.world.now();
        for (port, decoder) in self.connections.values_mut() {
            self.bytes.clear();
            self.world.take_output(*port, &mut self.bytes);
            decoder.push(&self.bytes);
            let witness = &mut self.witnesses[port.vehicle()];
            while let Some(frame) = decoder.next_frame() {
                witness.hear(&frame, now);
            }
        }
        for witness in &mut self.witnesses {
            witness.pass(now);
        }
    }

    pub(super) fn differs(&self, vehicle: Option<VehicleId>, what: Text) -> Divergence {
        differs(self.world.now(), vehicle, what)
    }
}

/// The telemetry of a repeated vehicle, for comparison.
pub(super) struct Witness {
    pub(super) session: Session,
    /// Its known states, each with the time from which it held.
    shown: VecDeque<(Duration, ObservedVehicle)>,
    listener: TextListener,
    texts: VecDeque<(Duration, String)>,
    /// The times at which the vehicle refused operator commands.
    refused: Vec<Duration>,
}

impl Witness {
    fn new(system: SystemId) -> Self {
        Self {
            session: Session::new(system, AUTOPILOT_COMPONENT, Duration::ZERO),
            shown: VecDeque::new(),
            listener: TextListener::default(),
            texts: VecDeque::new(),
            refused: Vec::new(),
        }
    }

    fn hear(&mut self, frame: &Frame, now: Duration) {
        if let Content::Message(MavMessage::COMMAND_ACK(ack)) = &frame.content {
            let is_refused = !matches!(
                ack.result,
                MavResult::MAV_RESULT_ACCEPTED | MavResult::MAV_RESULT_IN_PROGRESS
            );
            let is_counted = is_refused && is_order(ack.command);
            self.refused.extend(is_counted.then_some(now));
        }
        self.session.receive(frame, now);
    }

    fn pass(&mut self, now: Duration) {
        if is_due(now, SESSION_POLL) {
            self.session.poll(now);
        }
        drop(self.session.take_outgoing());
        drop(self.session.take_reports());
        let vehicle = self.session.vehicle();
        let known = ObservedVehicle::of(vehicle.id, vehicle);
        if self.shown.back().is_none_or(|(_, last)| *last != known) {
            self.shown.push_back((now, known));
        }
        let said = self.listener.listen(vehicle).iter();
        self.texts.extend(said.map(|text| (now, text.text.clone())));
        let old = now.saturating_sub(LATE_AT_MOST + SHOWN_WITHIN);
        while self.shown.get(1).is_some_and(|(since, _)| *since < old) {
            self.shown.pop_front();
        }
        while self.texts.front().is_some_and(|(at, _)| *at < old) {
            self.texts.pop_front();
        }
    }

    /// How many operator commands the vehicle had refused by a time.
    pub(super) fn refusals(&self, until: Duration) -> u32 {
        let counted = self.refused.iter().filter(|at| **at <= until);
        u32::try_from(counted.count()).unwrap_or(u32::MAX)
    }

    /// Whether the vehicle has sent a text since a time.
    pub(super) fn has_said(&self, text: &str, since: Duration) -> bool {
        let mut texts = self.texts.iter();
        texts.any(|(at, said)| *at >= since && said == text)
    }

    /// The vehicle's states between two times.
    pub(super) fn known(
        &self,
        from: Duration,
        to: Duration,
    ) -> impl Iterator<Item = &ObservedVehicle> + Clone {
        let replaced = self.shown.iter().map(|(since, _)| *since).skip(1);
        let known = self.shown.iter().zip(replaced.chain([Duration::MAX]));
        known
            .filter(move |((since, _), until)| *since <= to && *until > from)
            .map(|((_, known), _)| known)
    }
}

/// Whether a command comes from the operator. A console also sends its own commands, whose refusals are not in the
/// ledger.
fn is_order(command: MavCmd) -> bool {
    !matches!(
        command,
        MavCmd::MAV_CMD_SET_MESSAGE_INTERVAL
            | MavCmd::MAV_CMD_REQUEST_MESSAGE
            | MavCmd::MAV_CMD_DO_CHANGE_SPEED
    )
}
