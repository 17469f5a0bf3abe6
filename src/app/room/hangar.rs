//! The hangar: the processes that simulate the vehicles, their state and their output.

use crate::app::State;
use crate::app::action::{Action, HangarAction, Step};
use crate::app::effect::{Effect, Effects, SessionEffect};
use crate::app::keymap::{ENTER, ESCAPE, KeyHint, KeyRow, does, hint, key};
use crate::app::room::{Answer, Room, RoomModel, RoomRequest, footer_keys};
use crate::app::state::{Consequence, Instance, SitlStage};
use crate::language::ProcessDeed;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};

/// The state of the room.
#[derive(Debug, Clone, Default)]
pub struct Hangar {
    /// The index of the process under the cursor.
    pub(in crate::app) cursor: usize,
    /// Whether the output of the process under the cursor fills the screen.
    pub(in crate::app) opened: bool,
    /// The number of newest lines scrolled out of view.
    pub(in crate::app) back: usize,
}

impl Hangar {
    /// The index of the process under the cursor.
    pub fn cursor(&self) -> usize {
        self.cursor
    }

    /// Whether the output of the process under the cursor fills the screen.
    pub fn is_opened(&self) -> bool {
        self.opened
    }

    /// The number of newest lines scrolled out of view.
    pub fn back(&self) -> usize {
        self.back
    }
}

/// The process under the cursor.
pub fn under_cursor(state: &State) -> Option<&Instance> {
    let instances = &state.session.hangar.as_ref()?.instances;
    instances.get(state.rooms.hangar.cursor)
}

/// The vehicle whose process output is needed: that of the process under the cursor while the room
/// is shown.
pub fn wanted(state: &State) -> Option<VehicleId> {
    let shown = under_cursor(state).filter(|_| state.room == Room::Hangar);
    shown.map(|instance| instance.vehicle)
}

const HINTS: &[KeyHint] = &[
    footer_keys::COMMAND,
    footer_keys::HELP,
    footer_keys::MOVE,
    hint(&[Action::Submit], "hangar-key-output"),
    hint(
        &[Action::Hangar(HangarAction::RestartProcess)],
        "hangar-key-restart",
    ),
    hint(
        &[Action::Hangar(HangarAction::StopProcess)],
        "hangar-key-stop",
    ),
    hint(&[Action::Show(Room::Fly)], "links-key-fly"),
    hint(&[Action::Leave], "hangar-key-leave"),
];

impl RoomModel for Hangar {
    const KEYS: &'static [KeyRow] = &[
        does(ENTER, Action::Submit),
        does(ESCAPE, Action::Escape),
        does(key('r'), Action::Hangar(HangarAction::RestartProcess)),
        does(key('x'), Action::Hangar(HangarAction::StopProcess)),
        does(key('q'), Action::Leave),
    ];

    fn hints(_state: &State) -> &'static [KeyHint] {
        HINTS
    }

    fn step(state: &mut State, step: Step) -> Answer {
        let hangar = state.session.hangar.as_ref();
        let shown = under_cursor(state).zip(hangar);
        let lines = shown.map_or(0, |(instance, hangar)| hangar.output(instance).len());
        let count = hangar.map_or(0, |hangar| hangar.instances.len());
        let room = &mut state.rooms.hangar;
        if room.opened {
            let last = lines.saturating_sub(1);
            room.back = last - step.apply(last - room.back.min(last), lines);
        } else {
            room.cursor = step.apply(room.cursor, count);
            room.back = 0;
        }
        Some(Vec::new())
    }

    fn submit(state: &mut State) -> Answer {
        if under_cursor(state).is_some() {
            let room = &mut state.rooms.hangar;
            room.opened = !room.opened;
            room.back = 0;
        }
        Some(Vec::new())
    }

    fn escape(state: &mut State) -> Answer {
        Some(escape(state))
    }

    fn entered(state: &mut State) {
        let crashed = state.session.hangar.as_ref().and_then(|hangar| {
            let mut all = hangar.instances.iter();
            all.position(Instance::has_crashed)
        });
        if let Some(at) = crashed
            && !under_cursor(state).is_some_and(Instance::has_crashed)
        {
            state.rooms.hangar.cursor = at;
        }
    }
}

pub(super) fn act(state: &mut State, action: HangarAction) -> Vec<RoomRequest> {
    let deed = match action {
        HangarAction::RestartProcess => ProcessDeed::Restart,
        HangarAction::StopProcess => ProcessDeed::Stop,
    };
    let vehicle = under_cursor(state).map(|instance| instance.vehicle);
    vehicle.map_or_else(Vec::new, |vehicle| requested(state, deed, vehicle))
}

fn requested(state: &mut State, deed: ProcessDeed, vehicle: VehicleId) -> Vec<RoomRequest> {
    let effects = order(state, deed, vehicle).into_iter();
    effects.map(RoomRequest::Effect).collect()
}

/// Restarts or stops a vehicle's process; asks first while the vehicle is armed.
pub fn order(state: &mut State, deed: ProcessDeed, vehicle: VehicleId) -> Effects {
    let instance = state
        .session
        .hangar
        .as_ref()
        .and_then(|hangar| hangar.of(vehicle));
    let Some(instance) = instance else {
        state.say(
            Severity::Warning,
            text!("hangar-no-process", vehicle = vehicle),
        );
        return Effects::none();
    };
    let runs = instance.stage < SitlStage::Stopping;
    let known = state.session.vehicles.get(&vehicle);
    let is_armed = runs && known.is_some_and(|vehicle| vehicle.armed());
    let effect = Effect::Session(SessionEffect::Process(deed, vehicle));
    let (question, done) = words(deed, vehicle);
    if deed == ProcessDeed::Stop
        && let Some(hangar) = state.session.hangar.as_mut().filter(|hangar| !hangar.begun)
    {
        // A stopped process is no longer expected.
        hangar.expected = hangar.expected.saturating_sub(1);
    }
    if is_armed {
        state.ask(
            question,
            text!("hangar-ask-armed"),
            Consequence::Effect(effect),
        );
        return Effects::none();
    }
    state.say(Severity::Notice, done);
    Effects::from(effect)
}

/// The question before an action on a process, and the notice after it.
fn words(deed: ProcessDeed, vehicle: VehicleId) -> (Text, Text) {
    match deed {
        ProcessDeed::Restart => (
            text!("hangar-ask-restart", vehicle = vehicle),
            text!("hangar-restarting", vehicle = vehicle),
        ),
        ProcessDeed::Stop => (
            text!("hangar-ask-stop", vehicle = vehicle),
            text!("hangar-stopping", vehicle = vehicle),
        ),
    }
}

/// Closes the output; otherwise leaves the room, or the session while vehicles are still starting, or goes to *Home*
/// without one.
fn escape(state: &mut State) -> Vec<RoomRequest> {
    state.hush();
    if state.rooms.hangar.opened {
        state.rooms.hangar.opened = false;
    } else if state.session.is_starting() || state.session.activity.is_none() {
        return vec![RoomRequest::Leave];
    } else {
        state.room = Room::Fly;
    }
    Vec::new()
}

/// Keeps the cursor in range when there are fewer processes.
pub fn keep_cursor(state: &mut State) {
    let hangar = state.session.hangar.as_ref();
    let count = hangar.map_or(0, |hangar| hangar.instances.len());
    let room = &mut state.rooms.hangar;
    room.cursor = room.cursor.min(count.saturating_sub(1));
}
